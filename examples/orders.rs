//! Every order of cells on one's meshes, held against the f64 reference: the table of `docs/order.md`.
//!
//! `cargo run --release --example orders -- [MESH FIELD]... [--depth D] [--size WxH]`
//!
//! The function is 20 thin bands of all colours, of optical depth D over the mesh's diagonal [10]: any exchange of two
//! cells shows. Two views from outside, in perspective and parallel, and one from inside: shares are of all of them,
//! errors are the worst of them, times the median of three frames each of a camera that moves.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program")]

#[path = "common/mod.rs"]
mod common;
#[path = "../tests/common/rainbow.rs"]
mod rainbow;

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use glam::DVec3;
use tetralux::gpu::{DeviceChoice, Gpu, GpuRenderer, RayCaster};
use tetralux::image::{Comparison, Image};
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::plan::order::Inversions;
use tetralux::renderer::{Frame, Method, OrderMethod, Renderer, Settings};
use tetralux::scene::{Camera, Optics, Projection, TransferFunction};
use tetralux::tet::TetMesh;
use tetralux::{Error, Result};

const BANDS: u32 = 20;
const FRAMES: usize = 3;
const ORDERS: [OrderMethod; 5] =
    [OrderMethod::Centroid, OrderMethod::Power, OrderMethod::Mpvonc, OrderMethod::Exact, OrderMethod::PerPixel];

/// What is asked.
struct Asked {
    meshes: Vec<(PathBuf, String)>,
    depth: f64,
    size: [u32; 2],
}

/// A line of the table.
#[derive(Debug)]
pub struct Row {
    /// The order, or `raycast`.
    pub name: String,
    /// Of neighbours; of all views.
    pub inversions: Option<Inversions>,
    /// The worst of the views.
    pub psnr: f64,
    /// The worst of the views.
    pub percentile_99_9: f64,
    /// The worst of the views.
    pub max: f64,
    /// Median over frames and views.
    pub frame: Duration,
    /// Of the device.
    pub bytes: u64,
}

fn parse(arguments: impl IntoIterator<Item = String>) -> Result<Asked> {
    let mut asked = Asked { meshes: Vec::new(), depth: 10.0, size: [512, 512] };
    let mut arguments = arguments.into_iter();
    let refuse = |what: &str| Error::Asked(format!("{what}; usage: orders [MESH FIELD]... [--depth D] [--size WxH]"));
    while let Some(argument) = arguments.next() {
        let value = arguments.next().ok_or_else(|| refuse(&format!("'{argument}' is followed by nothing")))?;
        match argument.as_str() {
            "--depth" => asked.depth = value.parse().map_err(|_| refuse(&format!("'{value}' is no depth")))?,
            "--size" => {
                let size = value.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
                asked.size = size.ok_or_else(|| refuse(&format!("'{value}' is no size")))?;
            }
            _ => asked.meshes.push((argument.into(), value)),
        }
    }
    Ok(asked)
}

fn cameras(mesh: &TetMesh) -> [Camera; 3] {
    let bounds = mesh.bounds_in_data();
    let (target, diagonal) = (bounds.center(), bounds.diagonal());
    let camera = |away: [f64; 3], projection| {
        let eye = target + diagonal * DVec3::from_array(away);
        Camera { eye, target, up: DVec3::Y, projection, near: None }
    };
    [
        camera([0.7, 0.45, 0.85], Projection::Perspective { fov_y: 0.8 }),
        camera([-0.5, 0.9, 0.3], Projection::Orthographic { height: 0.8 * diagonal }),
        camera([0.03, -0.02, 0.05], Projection::Perspective { fov_y: 1.2 }),
    ]
}

/// One line by one renderer.
fn row(name: String, renderer: &mut dyn Renderer, frames: &[(Frame<'_>, Image)]) -> Result<Row> {
    let mut row = Row {
        name,
        inversions: None,
        psnr: f64::INFINITY,
        percentile_99_9: 0.0,
        max: 0.0,
        frame: Duration::ZERO,
        bytes: 0,
    };
    let mut times = Vec::new();
    for (frame, want) in frames {
        let rendered = renderer.render(frame, true)?;
        let c = Comparison::new(&rendered.image, want)?;
        row.psnr = row.psnr.min(c.psnr);
        row.percentile_99_9 = row.percentile_99_9.max(c.percentile_99_9);
        row.max = row.max.max(c.max);
        if let Some(counted) = rendered.stats.inversions {
            row.inversions = Some(row.inversions.unwrap_or_default() + counted);
        }
        row.bytes = row.bytes.max(rendered.stats.buffers.iter().map(|b| b.bytes).sum());
        for step in 0..FRAMES {
            // A camera that moves, if by little: what depends on it is made anew.
            let eye = frame.camera.eye * (1.0 + 1e-9 * (step + 1) as f64);
            times.push(renderer.render_only(&Frame { camera: &Camera { eye, ..*frame.camera }, ..*frame })?);
        }
    }
    times.sort();
    row.frame = times[times.len() / 2];
    Ok(row)
}

/// All lines of one mesh.
///
/// # Errors
/// No graphics device, or one that refuses.
pub fn rows(mesh: &Arc<TetMesh>, depth: f64, size: [u32; 2]) -> Result<Vec<Row>> {
    let transfer: TransferFunction = rainbow::rainbow(mesh, BANDS, depth);
    let cameras = cameras(mesh);
    let oracle = Oracle::new(Arc::clone(mesh));
    let mut frames = Vec::new();
    for camera in &cameras {
        let frame = Frame { camera, transfer: &transfer, optics: &Optics::PLAIN, size, background: [0.0; 4] };
        frames.push((frame, oracle.image(&frame)?));
    }
    let gpu = || Gpu::new(DeviceChoice::Any);
    let mut rows = Vec::new();
    for order in ORDERS {
        let settings = Settings { method: Method::Project, order, ..Settings::default() };
        rows.push(row(order.to_string(), &mut GpuRenderer::new(gpu()?, Arc::clone(mesh), settings)?, &frames)?);
    }
    let settings = Settings { method: Method::RayCast, ..Settings::default() };
    rows.push(row("(raycast)".into(), &mut RayCaster::new(gpu()?, Arc::clone(mesh), settings)?, &frames)?);
    Ok(rows)
}

fn print(name: &str, mesh: &TetMesh, rows: &[Row]) {
    let tets = mesh.tets.len() as f64;
    println!("\n**{name}**, {tets} tetrahedra\n");
    println!("| order | wrong pairs | PSNR, dB | 99.9th percentile | largest | frame, s | bytes a tetrahedron |");
    println!("| --- | --- | --- | --- | --- | --- | --- |");
    for r in rows {
        let wrong = r.inversions.map_or_else(|| "-".to_owned(), |i| format!("{:.3} %", 100.0 * i.share()));
        let (seconds, bytes) = (r.frame.as_secs_f64(), r.bytes as f64 / tets);
        println!(
            "| {} | {wrong} | {:.1} | {:.1e} | {:.1e} | {seconds:.3} | {bytes:.0} |",
            r.name, r.psnr, r.percentile_99_9, r.max
        );
    }
}

fn run() -> Result<()> {
    let asked = parse(std::env::args().skip(1))?;
    let mut meshes = Vec::new();
    for (file, field) in asked.meshes {
        let name = file.file_stem().map_or_else(|| "mesh".into(), |stem| stem.to_string_lossy().into_owned());
        meshes.push((name, common::mesh(Some(&file), Some(&field), Sample::Tangle, 0)?.0));
    }
    if meshes.is_empty() {
        meshes.push(("tangle".into(), common::mesh(None, None, Sample::Tangle, 20_000)?.0));
    }
    for (name, mesh) in meshes {
        print(&name, &mesh, &rows(&mesh, asked.depth, asked.size)?);
    }
    Ok(())
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}
