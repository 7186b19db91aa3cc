//! Time steps and fields on the same tetrahedra: what a renderer that is kept saves.
//!
//! `cargo run --release --example time_steps -- [TETRAHEDRA] [--device cpu|gpu|software]`
//!
//! A mesh is written to a file and loaded as at a program's start. Then its other field is shown, and then the mesh moves:
//! neither cuts cells, looks for neighbours, or uploads what stays. Times are printed; what they are worth, in
//! docs/rays.md.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program")]

use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DVec3;
use tetralux::cpu::CpuRenderer;
use tetralux::gpu::{DeviceChoice, Gpu, RayCaster};
use tetralux::image::Image;
use tetralux::mesh::synth::Sample;
use tetralux::mesh::write::write_vtu;
use tetralux::mesh::{self, Association, DataArray, Mesh, ReadOptions};
use tetralux::renderer::{Frame, Renderer, Settings};
use tetralux::scene::Scene;
use tetralux::tet::{Census, FieldChoice, HexSplit, TetMesh};
use tetralux::{Error, Result};

/// A renderer whose mesh can be replaced.
enum Caster {
    Cpu(Box<CpuRenderer>),
    Gpu(Box<RayCaster>),
}

impl Caster {
    fn new(device: &str, mesh: Arc<TetMesh>) -> Result<Self> {
        let settings = Settings::default();
        let on = |choice| Ok(Self::Gpu(Box::new(RayCaster::new(Gpu::new(choice)?, Arc::clone(&mesh), settings)?)));
        match device {
            "cpu" => Ok(Self::Cpu(Box::new(CpuRenderer::new(mesh, settings)?))),
            "gpu" => on(DeviceChoice::Any),
            "software" => on(DeviceChoice::Software),
            _ => Err(Error::Asked(format!("there is no device '{device}': cpu, gpu or software"))),
        }
    }

    fn replace(&mut self, mesh: Arc<TetMesh>) -> Result<()> {
        match self {
            Self::Cpu(renderer) => renderer.replace(mesh),
            Self::Gpu(renderer) => renderer.replace(mesh),
        }
    }

    fn picture(&mut self, mesh: &TetMesh) -> Result<Image> {
        let renderer: &mut dyn Renderer = match self {
            Self::Cpu(renderer) => &mut **renderer,
            Self::Gpu(renderer) => &mut **renderer,
        };
        let scene = Scene::parse("[image]\nwidth = 256\nheight = 256", &[])?;
        let (camera, transfer) = scene.resolve(mesh)?;
        let (optics, size) = (&scene.optics, scene.size);
        let frame = Frame { camera: &camera, transfer: &transfer, optics, size, background: [0.0; 4] };
        Ok(renderer.render(&frame, false)?.image)
    }
}

/// A mesh with two fields.
fn two_fields(tetrahedra: usize) -> Mesh {
    let mut mesh = Sample::Tangle.mesh(tetrahedra);
    let values = mesh.points.iter().map(|p| (3.0 * p.x).sin() + p.y * p.z).collect();
    let name = "second".to_owned();
    mesh.arrays.push(DataArray { name, association: Association::Point, components: 1, values });
    mesh
}

fn read(file: &Path, field: &str) -> Result<Mesh> {
    let options = ReadOptions { arrays: mesh::ArrayChoice::One(Some(field.to_owned())), ..ReadOptions::default() };
    mesh::read(file, &options)
}

/// What came of it, as told.
pub fn run(arguments: impl IntoIterator<Item = String>) -> Result<Vec<(String, Duration)>> {
    let (mut tetrahedra, mut device) = (200_000, "cpu".to_owned());
    let mut arguments = arguments.into_iter();
    while let Some(argument) = arguments.next() {
        match argument.parse() {
            Ok(count) => tetrahedra = count,
            Err(_) if argument == "--device" => device = arguments.next().unwrap_or_default(),
            Err(_) => return Err(Error::Asked(format!("'{argument}' is neither a number nor --device"))),
        }
    }
    let folder = std::env::temp_dir().join(format!("tetralux-time-steps-{}", std::process::id()));
    std::fs::create_dir_all(&folder).map_err(|e| Error::write(&folder, e))?;
    let told = steps(&folder.join("mesh.vtu"), tetrahedra, &device);
    std::fs::remove_dir_all(&folder).map_err(|e| Error::write(&folder, e))?;
    told
}

fn steps(file: &Path, tetrahedra: usize, device: &str) -> Result<Vec<(String, Duration)>> {
    let first = two_fields(tetrahedra);
    let field = first.arrays[0].name.clone();
    write_vtu(&first, file)?;
    drop(first);
    let mut told = Vec::new();
    let start = Instant::now();
    let (mesh, census): (TetMesh, Census) =
        TetMesh::new(read(file, &field)?, &FieldChoice::parse(&field), HexSplit::default())?;
    let mesh = Arc::new(mesh);
    let mut caster = Caster::new(device, Arc::clone(&mesh))?;
    told.push(("full load".to_owned(), start.elapsed()));
    let before = caster.picture(&mesh)?;

    let start = Instant::now();
    let other = read(file, "second")?;
    told.push(("reading another field".to_owned(), start.elapsed()));
    let start = Instant::now();
    let second = Arc::new(mesh.with_field(&census, other, &FieldChoice::parse("second"))?);
    told.push(("its gradients".to_owned(), start.elapsed()));
    let start = Instant::now();
    caster.replace(Arc::clone(&second))?;
    told.push(("giving it to the renderer".to_owned(), start.elapsed()));
    let other = caster.picture(&second)?;

    let mut moved = read(file, &field)?;
    moved.points.iter_mut().for_each(|p| *p += DVec3::new(0.1 * p.y * p.y, 0.0, 0.05 * p.x));
    let start = Instant::now();
    let moved = Arc::new(mesh.with_field(&census, moved, &FieldChoice::parse(&field))?);
    told.push(("gradients of points that moved".to_owned(), start.elapsed()));
    let start = Instant::now();
    caster.replace(Arc::clone(&moved))?;
    told.push(("giving them to the renderer".to_owned(), start.elapsed()));
    let after = caster.picture(&moved)?;
    if before == other || before == after {
        return Err(Error::Device("internal: another field or place changed nothing".into()));
    }
    Ok(told)
}

fn main() -> ExitCode {
    match run(std::env::args().skip(1)) {
        Ok(told) => {
            for (what, time) in told {
                println!("{:>9.1} ms  {what}", 1e3 * time.as_secs_f64());
            }
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}
