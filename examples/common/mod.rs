//! What the worked uses share: their arguments, a mesh from a file or a generated one, pictures by the best renderer at
//! hand, and pictures side by side.
#![allow(dead_code, reason = "every program uses a part of it")]

use std::path::PathBuf;
use std::sync::Arc;

use tetralux::gpu::{DeviceChoice, Gpu, GpuRenderer};
use tetralux::image::Image;
use tetralux::mesh::synth::Sample;
use tetralux::mesh::{self, ReadOptions};
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, Renderer as _, Settings};
use tetralux::scene::{Override, Scene};
use tetralux::tet::{BuildOptions, FieldChoice, TetMesh};
use tetralux::{Error, Result};

/// What may draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Device {
    /// A graphics device where there is one that can, the f64 reference otherwise.
    Auto,
    /// The f64 reference.
    Oracle,
}

/// `[MESH] [-o PICTURE] [--scene FILE] [--size WxH] [--device auto|oracle]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// The mesh's file; a generated mesh where `None`.
    pub mesh: Option<PathBuf>,
    /// Where the picture goes.
    pub output: PathBuf,
    /// The scene's file.
    pub scene: PathBuf,
    /// Pixels; the scene's where `None`.
    pub size: Option<[u32; 2]>,
    pub device: Device,
}

impl Asked {
    /// Reads arguments; `name` is the program's, its scene's and its picture's.
    ///
    /// # Errors
    /// Arguments that are none.
    pub fn parse(name: &str, arguments: impl IntoIterator<Item = String>) -> Result<Self> {
        let refuse = |what: &str| {
            let usage = "[MESH] [-o PICTURE] [--scene FILE] [--size WxH] [--device auto|oracle]";
            Error::Asked(format!("{what}; usage: {name} {usage}"))
        };
        let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/scenes");
        let mut asked = Self {
            mesh: None,
            output: format!("{name}.png").into(),
            scene: format!("{scenes}/{name}.toml").into(),
            size: None,
            device: Device::Auto,
        };
        let mut arguments = arguments.into_iter();
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().ok_or_else(|| refuse(&format!("'{argument}' needs a value")));
            match argument.as_str() {
                "-o" | "--output" => asked.output = value()?.into(),
                "--scene" => asked.scene = value()?.into(),
                "--size" => {
                    let text = value()?;
                    let size = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
                    asked.size = Some(size.ok_or_else(|| refuse(&format!("'{text}' is no size as 640x480")))?);
                }
                "--device" => {
                    asked.device = match value()?.as_str() {
                        "auto" => Device::Auto,
                        "oracle" => Device::Oracle,
                        other => return Err(refuse(&format!("'{other}' is no device"))),
                    }
                }
                flag if flag.starts_with('-') => return Err(refuse(&format!("'{flag}' is unknown"))),
                _ if asked.mesh.is_some() => return Err(refuse("two meshes are one too many")),
                path => asked.mesh = Some(path.into()),
            }
        }
        Ok(asked)
    }

    /// The scene, at the size that was asked for, with further settings over it.
    ///
    /// # Errors
    /// A file that cannot be read or is wrong.
    pub fn scene(&self, more: &[Override]) -> Result<Scene> {
        let mut overrides = more.to_vec();
        if let Some([width, height]) = self.size {
            overrides.push(set("image.width", &width.to_string()));
            overrides.push(set("image.height", &height.to_string()));
        }
        Scene::read(Some(&self.scene), &overrides)
    }
}

/// A scene's key set by the program.
pub fn set(key: &str, value: &str) -> Override {
    Override { key: key.into(), value: value.into(), origin: format!("{key} = {value}") }
}

/// The mesh of `file` with its array `field` (the first one where `None`); where there is no file, the generated
/// `stand_in` of about `tets` tetrahedra. Also tells which it was.
///
/// # Errors
/// A file that cannot be read, or has no such array.
pub fn mesh(
    file: Option<&PathBuf>,
    field: Option<&str>,
    stand_in: Sample,
    tets: usize,
) -> Result<(Arc<TetMesh>, String)> {
    let (raw, field, told) = match file {
        Some(path) => (mesh::read(path, &ReadOptions::default())?, field, path.display().to_string()),
        None => {
            let told = format!("no mesh was given: the generated mesh '{}' stands in", stand_in.name());
            (stand_in.mesh(tets), Some(stand_in.array()), told)
        }
    };
    let choice = field.map_or_else(FieldChoice::default, FieldChoice::parse);
    let (mesh, _) = TetMesh::new(raw, &choice, BuildOptions::default())?;
    let told = format!("{told}: field {}, {} tetrahedra", mesh.field, mesh.tets.len());
    Ok((Arc::new(mesh), told))
}

/// The scene's picture of `mesh`, over its background, and what drew it.
///
/// # Errors
/// What the scene asks for and no renderer can do.
pub fn picture(mesh: &Arc<TetMesh>, scene: &Scene, device: Device) -> Result<(Image, String)> {
    let (camera, transfer) = scene.resolve(&**mesh)?;
    let background = scene.premultiplied_background();
    let frame = Frame { camera: &camera, transfer: &transfer, optics: &scene.optics, size: scene.size, background };
    let on_device = || {
        let mut renderer = GpuRenderer::new(Gpu::new(DeviceChoice::Any)?, Arc::clone(mesh), Settings::default())?;
        renderer.render(&frame, false)
    };
    let reference = || Oracle::new(Arc::clone(mesh)).render(&frame, false);
    match device {
        Device::Oracle => reference().map(|r| (r.image, r.stats.adapter)),
        Device::Auto => match on_device() {
            Ok(rendered) => Ok((rendered.image, rendered.stats.adapter)),
            // The reference draws everything that a scene may ask for.
            Err(why) => reference().map(|r| (r.image, format!("{} ({why})", r.stats.adapter))),
        },
    }
}

/// Pictures of one size side by side, `gap` white pixels between them.
///
/// # Errors
/// Pictures of different heights.
pub fn beside(pictures: &[Image], gap: u32) -> Result<Image> {
    let height = pictures.first().map_or(0, |p| p.height);
    if let Some(other) = pictures.iter().find(|p| p.height != height) {
        let heights = format!("{height} and {}", other.height);
        return Err(Error::Asked(format!("pictures of different heights cannot stand side by side: {heights} pixels")));
    }
    let gaps = gap * (pictures.len() as u32).saturating_sub(1);
    let mut sheet = Image::new(pictures.iter().map(|p| p.width).sum::<u32>() + gaps, height);
    sheet.pixels.fill([1.0; 4]);
    let mut left = 0;
    for picture in pictures {
        for (row, pixels) in (0_u32..).zip(picture.pixels.chunks(picture.width.max(1) as usize)) {
            let start = (row * sheet.width + left) as usize;
            sheet.pixels[start..start + pixels.len()].copy_from_slice(pixels);
        }
        left += picture.width + gap;
    }
    Ok(sheet)
}
