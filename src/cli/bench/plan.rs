//! What is to be measured: meshes, scenes, views and sizes, and the contenders on them, from a TOML file (docs/bench.md).

use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::Deserialize;

use crate::cli::args::{Device, IntegralChoice, Method, Order, SourceArgs};
use crate::cli::load;
use crate::error::{Error, Result};
use crate::mesh::synth::Sample;
use crate::scene::{Camera, Optics, Scene, TransferFunction};
use crate::tet::{FieldChoice, HexSplit, TetMesh};

/// A plan's file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Plan {
    /// Frames to time, after those that are not counted.
    pub repeats: usize,
    /// Width and height, pixels.
    pub sizes: Vec<[u32; 2]>,
    pub mesh: Vec<MeshEntry>,
    pub scene: Vec<SceneEntry>,
    pub view: Vec<ViewEntry>,
    matrix: Vec<Matrix>,
    /// Where the plan stands: its files are named from there.
    #[serde(skip)]
    folder: PathBuf,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MeshEntry {
    pub name: String,
    file: Option<PathBuf>,
    /// Of the folder that `--data` names.
    data: Option<PathBuf>,
    sample: Option<String>,
    tetrahedra: Option<usize>,
    field: Option<String>,
}

/// A scene's `transfer`, `lighting` and `silhouette`: scalars and gradients from 0 to 1 over the mesh's ranges, extinctions
/// per diagonal of its bounding box, so that one function fits all meshes.
#[derive(Debug, Deserialize)]
pub(super) struct SceneEntry {
    pub name: String,
    #[serde(flatten)]
    keys: toml::Table,
}

/// A scene's `camera`, fitted to each mesh; or an eye within.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ViewEntry {
    pub name: String,
    /// The eye, as shares of the bounding box along x, y and z, that looks towards its middle.
    at: Option<[f64; 3]>,
    #[serde(default)]
    camera: toml::Table,
}

/// Contenders, and what they are measured on: all where nothing is named.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Matrix {
    devices: Vec<Device>,
    methods: Vec<Method>,
    integrals: Vec<String>,
    #[serde(default = "auto_only")]
    orders: Vec<Order>,
    #[serde(default)]
    meshes: Vec<String>,
    #[serde(default)]
    scenes: Vec<String>,
    #[serde(default)]
    views: Vec<String>,
    #[serde(default)]
    sizes: Vec<[u32; 2]>,
}

fn auto_only() -> Vec<Order> {
    vec![Order::Auto]
}

/// A program's choices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Choice {
    pub device: Device,
    pub method: Method,
    pub integral: IntegralChoice,
    pub order: Order,
}

/// A picture to make.
pub(super) struct Shot {
    pub camera: Camera,
    pub transfer: TransferFunction,
    pub optics: Optics,
}

impl Plan {
    /// Reads a plan and finds everything wrong that can be found without its meshes.
    ///
    /// # Errors
    /// [`Error::Io`], or [`Error::Malformed`] naming the line or the entry.
    pub fn read(path: &Path) -> Result<Self> {
        let text = std::fs::read_to_string(path).map_err(|source| Error::io(path, source))?;
        let mut plan: Self = toml::from_str(&text).map_err(|e| {
            let line = e.span().map(|span| text[..span.start.min(text.len())].matches('\n').count() + 1);
            let place = line.map(|line| format!("line {line}: ")).unwrap_or_default();
            Error::malformed(path, format!("{place}{}", e.message()))
        })?;
        plan.folder = path.parent().unwrap_or(Path::new("")).to_owned();
        plan.check().map_err(|what| Error::malformed(path, what))?;
        Ok(plan)
    }

    fn check(&self) -> Result<(), String> {
        if self.repeats == 0 {
            return Err("repeats: at least one frame has to be timed".into());
        }
        if self.sizes.iter().flatten().any(|&side| side == 0) {
            return Err("sizes: every side needs a pixel".into());
        }
        for mesh in &self.mesh {
            let sources = [mesh.file.is_some(), mesh.data.is_some(), mesh.sample.is_some()];
            if sources.iter().filter(|given| **given).count() != 1 {
                return Err(format!("mesh '{}': one of file, data and sample is needed", mesh.name));
            }
            if mesh.sample.is_some() != mesh.tetrahedra.is_some() {
                return Err(format!("mesh '{}': tetrahedra go with a sample", mesh.name));
            }
            if let Some(sample) = &mesh.sample {
                sample.parse::<Sample>().map_err(|e| format!("mesh '{}': {e}", mesh.name))?;
            }
        }
        let names = |entries: &mut dyn Iterator<Item = &String>| entries.cloned().collect::<Vec<String>>();
        let meshes = names(&mut self.mesh.iter().map(|m| &m.name));
        let scenes = names(&mut self.scene.iter().map(|s| &s.name));
        let views = names(&mut self.view.iter().map(|v| &v.name));
        for (what, names) in [("mesh", &meshes), ("scene", &scenes), ("view", &views)] {
            if let Some(twice) = names.iter().enumerate().find(|(i, name)| names[..*i].contains(name)) {
                return Err(format!("two {what} entries are called '{}'", twice.1));
            }
        }
        for scene in &self.scene {
            for view in &self.view {
                scene_of(scene, view).map_err(|e| format!("scene '{}', view '{}': {e}", scene.name, view.name))?;
            }
        }
        for matrix in &self.matrix {
            let known = [(&matrix.meshes, &meshes), (&matrix.scenes, &scenes), (&matrix.views, &views)];
            for (named, known) in known {
                if let Some(unknown) = named.iter().find(|name| !known.contains(name)) {
                    return Err(format!("matrix: there is no '{unknown}' among {}", known.join(", ")));
                }
            }
            if let Some(size) = matrix.sizes.iter().find(|size| !self.sizes.contains(size)) {
                return Err(format!("matrix: {}x{} is not among sizes", size[0], size[1]));
            }
            for integral in &matrix.integrals {
                integral.parse::<IntegralChoice>().map_err(|e| format!("matrix: {e}"))?;
            }
        }
        Ok(())
    }

    /// Reads or makes a mesh.
    ///
    /// # Errors
    /// What its reader says; [`Error::Asked`] where it lies in a folder that was not named.
    pub fn load(&self, entry: &MeshEntry, data: Option<&Path>) -> Result<Arc<TetMesh>> {
        let field = entry.field.as_deref();
        if let (Some(sample), Some(tetrahedra)) = (&entry.sample, entry.tetrahedra) {
            let sample: Sample = sample.parse()?;
            let choice = FieldChoice::parse(field.unwrap_or(sample.array()));
            return Ok(Arc::new(TetMesh::new(sample.mesh(tetrahedra), &choice, HexSplit::default())?.0));
        }
        let path = match (&entry.file, &entry.data, data) {
            (Some(file), ..) => self.folder.join(file),
            (None, Some(file), Some(data)) => data.join(file),
            (None, ..) => {
                let text = format!("mesh '{}' lies in a folder of data: name it by --data FOLDER", entry.name);
                return Err(Error::Asked(text));
            }
        };
        Ok(Arc::new(load::tet_mesh(&SourceArgs::of(path), field)?.0))
    }

    /// Who is measured on a subject, each once.
    pub fn choices(&self, mesh: &str, scene: &str, view: &str, size: [u32; 2]) -> Vec<Choice> {
        let has = |names: &[String], name: &str| names.is_empty() || names.iter().any(|n| n == name);
        let mut choices: Vec<Choice> = Vec::new();
        let matrices = self.matrix.iter().filter(|m| {
            has(&m.meshes, mesh)
                && has(&m.scenes, scene)
                && has(&m.views, view)
                && (m.sizes.is_empty() || m.sizes.contains(&size))
        });
        for matrix in matrices {
            for (&device, &method) in matrix.devices.iter().flat_map(|d| matrix.methods.iter().map(move |m| (d, m))) {
                // Rays have no order.
                let casts = method == Method::Raycast || matches!(device, Device::Cpu | Device::Oracle);
                let orders = if casts { &[Order::Auto][..] } else { &matrix.orders };
                // Integrals were checked when the plan was read.
                for integral in matrix.integrals.iter().flat_map(|text| text.parse()) {
                    for &order in orders {
                        let choice = Choice { device, method, integral, order };
                        if !choices.contains(&choice) {
                            choices.push(choice);
                        }
                    }
                }
            }
        }
        choices
    }
}

/// A plan's scene from a view, of any mesh.
fn scene_of(scene: &SceneEntry, view: &ViewEntry) -> Result<Scene> {
    let mut keys = scene.keys.clone();
    if let Some(transfer) = keys.get_mut("transfer").and_then(toml::Value::as_table_mut) {
        transfer.insert("units".into(), "normalized".into());
    }
    keys.insert("camera".into(), view.camera.clone().into());
    if keys.contains_key("clip") {
        return Err(Error::Asked(format!(
            "scene '{}': a plan's meshes are measured whole: leave out clip",
            scene.name
        )));
    }
    Scene::parse(&keys.to_string(), &[])
}

/// What a camera sees of a mesh.
///
/// # Errors
/// What [`Scene::resolve`] says.
pub(super) fn shot(scene: &SceneEntry, view: &ViewEntry, size: [u32; 2], mesh: &TetMesh) -> Result<Shot> {
    let choice = Scene { size, ..scene_of(scene, view)? };
    let (mut camera, mut transfer) = choice.resolve(mesh)?;
    let bounds = mesh.bounds_in_data();
    if let Some(at) = view.at {
        camera.eye = bounds.min + glam::DVec3::from_array(at) * (bounds.max - bounds.min);
        camera.target = bounds.center();
        camera.up = glam::DVec3::Z;
    }
    let per_length = 1.0 / bounds.diagonal();
    match &mut transfer {
        TransferFunction::Widgets(widgets) => widgets.iter_mut().for_each(|w| w.extinction *= per_length),
        TransferFunction::Curve(curve) => curve.nodes.iter_mut().for_each(|n| n.extinction *= per_length),
    }
    Ok(Shot { camera, transfer, optics: choice.optics })
}
