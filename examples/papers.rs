//! What the papers timed, timed here: the tables of `docs/papers.md`.
//!
//! `cargo run --release --example papers -- DATA [--size WxH]`
//!
//! DATA is a folder with `structured/*.vti`, `tet/bluntfin_tet.vtu` and `tet/post_tet.vtu`; what it lacks gets a line that
//! says so. A camera goes around each of them in five steps; times are the median of the steps' frames, after one that is
//! not counted. Tetrahedra a second: nominal are those of the data, effective those that the function can show.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program")]

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use tetralux::cpu::CpuRenderer;
use tetralux::gpu::{DeviceChoice, Gpu, GpuRenderer, GridCaster, GridRenderer, RayCaster};
use tetralux::mesh::{self, ReadOptions};
use tetralux::renderer::{Frame, Method, OrderMethod, Renderer, SegmentIntegral, Settings};
use tetralux::scene::{Camera, Curve, CurveNode, Optics, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::{BuildOptions, Domain, FieldChoice, Grid, TetMesh};
use tetralux::{Error, Result};

const STEPS: u32 = 5;
const VOLUMES: [&str; 5] = ["fuel", "neghip", "hydrogen_atom", "bonsai", "aneurism"];
const MESHES: [(&str, &str); 2] = [("bluntfin_tet", "Density"), ("post_tet", "StagnationEnergy")];

/// What a camera's way around costs.
#[derive(Clone, Copy, Debug)]
pub struct Measure {
    /// Tetrahedra of the data.
    pub nominal: u64,
    /// Those that the function can show; `None` where rays do not tell.
    pub effective: Option<u64>,
    /// Median of the steps.
    pub frame: Duration,
    /// Share of the passes' time that is not spent on fragments.
    pub set_up: Option<f64>,
}

/// Colours along the scalar and extinctions that rise from nothing at `first` of the range, in straight lines between
/// `nodes` points: the optical depth over the diagonal is `depth` at the range's end.
pub fn curve(domain: &dyn Domain, nodes: u32, first: f64, depth: f64) -> TransferFunction {
    let (range, extent) = (domain.scalar_range(), domain.bounds_in_data().diagonal());
    let node = |i: u32| {
        let at = f64::from(i) / f64::from(nodes - 1);
        let shown = ((at - first) / (1.0 - first)).max(0.0);
        // No straight line between the nodes, or there would be fewer.
        let extinction = depth / extent * shown * (1.0 + 0.5 * (40.0 * at).sin());
        CurveNode { scalar: range.min + at * range.length(), color: [at, 0.8 - 0.5 * at, 1.0 - at], extinction }
    };
    TransferFunction::Curve(Curve { nodes: (0..nodes).map(node).collect() })
}

/// Two Gaussians of scalar and gradient magnitude.
pub fn gaussians(domain: &dyn Domain) -> TransferFunction {
    let (s, g, extent) = (domain.scalar_range(), domain.gradient_range(), domain.bounds_in_data().diagonal());
    let gaussian = |at: [f64; 2], color| {
        let center = [s.min + at[0] * s.length(), g.min + at[1] * g.length()];
        let sigma = [0.1 * s.length(), 0.15 * g.length()];
        Widget::new(WidgetShape::Gaussian { center, sigma, angle: 0.0 }, color, 30.0 / extent)
    };
    TransferFunction::Widgets(vec![gaussian([0.3, 0.1], [1.0, 0.5, 0.1]), gaussian([0.6, 0.3], [0.1, 0.4, 1.0])])
}

/// Times a renderer on a way around what it draws.
///
/// # Errors
/// What the renderer refuses.
pub fn measure(
    renderer: &mut dyn Renderer,
    domain: &dyn Domain,
    transfer: &TransferFunction,
    size: [u32; 2],
) -> Result<Measure> {
    let camera = |step: u32| {
        let turn = 0.6 + std::f64::consts::TAU * f64::from(step) / f64::from(STEPS);
        let aspect = f64::from(size[0]) / f64::from(size[1]);
        Camera::fit(&domain.bounds_in_data(), 1.0, [turn, 0.4], aspect, Projection::Perspective { fov_y: 0.5 })
    };
    let cameras: Vec<Camera> = (0..STEPS).map(camera).collect();
    let frame =
        |step: usize| Frame { camera: &cameras[step], transfer, optics: &Optics::PLAIN, size, background: [0.0; 4] };
    let first = renderer.render(&frame(0), true)?;
    let mut times = Vec::new();
    for step in 0..cameras.len() {
        times.push(renderer.render_only(&frame(step))?);
    }
    times.sort();
    let passes = &first.stats.passes;
    let spent = |of: &dyn Fn(&str) -> bool| -> f64 {
        passes.iter().filter(|p| of(&p.pass)).map(|p| p.time.as_secs_f64()).sum()
    };
    let (all, fragments) = (spent(&|_| true), spent(&|pass| pass == "raster"));
    let shown = first.stats.cells.iter().rev().find(|(stage, _)| stage.contains("drawn"));
    Ok(Measure {
        nominal: domain.tet_count(),
        effective: shown.map(|(_, count)| *count),
        frame: times[times.len() / 2],
        set_up: (fragments > 0.0).then(|| 1.0 - fragments / all),
    })
}

/// A line of a table.
pub fn line(name: &str, way: &str, measured: &Result<Measure>) -> String {
    let m = match measured {
        Ok(m) => m,
        Err(error) => return format!("| {name} | {way} | not drawn: {error} | | | | |"),
    };
    let per_second = |count: u64| format!("{:.2} M", count as f64 / m.frame.as_secs_f64() / 1e6);
    let effective = m.effective.map_or_else(|| "-".into(), per_second);
    let set_up = m.set_up.map_or_else(|| "-".into(), |share| format!("{:.0} %", 100.0 * share));
    let (fps, nominal) = (1.0 / m.frame.as_secs_f64(), per_second(m.nominal));
    format!("| {name} | {way} | {} | {fps:.2} | {nominal} | {effective} | {set_up} |", m.nominal)
}

fn head(title: &str) {
    println!("\n**{title}**\n");
    println!("| data | by | tetrahedra | fps | nominal, tet/s | effective, tet/s | set-up |");
    println!("| --- | --- | --- | --- | --- | --- | --- |");
}

fn gpu() -> Result<Gpu> {
    Gpu::new(DeviceChoice::Any)
}

/// Grids, by slabs and by rays.
///
/// # Errors
/// A file that cannot be read.
pub fn volume(name: &str, file: &Path, size: [u32; 2]) -> Result<Vec<String>> {
    let (grid, _) = Grid::new(mesh::read(file, &ReadOptions::default())?, &FieldChoice::default())?;
    let grid = Arc::new(grid);
    let transfer = curve(&*grid, 10, 0.15, 20.0);
    let projected = Settings { method: Method::Project, order: OrderMethod::Structured, ..Settings::default() };
    let by_slabs = GridRenderer::new(gpu()?, Arc::clone(&grid), projected)
        .and_then(|mut renderer| measure(&mut renderer, &*grid, &transfer, size));
    let by_rays = GridCaster::new(gpu()?, Arc::clone(&grid), Settings::default())
        .and_then(|mut renderer| measure(&mut renderer, &*grid, &transfer, size));
    Ok(vec![line(name, "project, structured", &by_slabs), line(name, "raycast", &by_rays)])
}

/// Meshes under functions of one variable, by rays and by cells.
///
/// # Errors
/// No graphics device.
pub fn univariate(name: &str, mesh: &Arc<TetMesh>, size: [u32; 2]) -> Result<Vec<String>> {
    let mut lines = Vec::new();
    let partial = SegmentIntegral::Partial { size: SegmentIntegral::PARTIAL_SIZE };
    let full = SegmentIntegral::PreIntegrated { size: SegmentIntegral::PREINTEGRATED_SIZE };
    for (nodes, integral) in [(10, full), (10, partial), (255, partial)] {
        let transfer = curve(&**mesh, nodes, 0.0, 10.0);
        let told = format!("{integral}, {nodes} control points");
        let settings = Settings { method: Method::RayCast, integral, ..Settings::default() };
        let cast = RayCaster::new(gpu()?, Arc::clone(mesh), settings)
            .and_then(|mut renderer| measure(&mut renderer, &**mesh, &transfer, size));
        lines.push(line(name, &format!("raycast, {told}"), &cast));
        let on_host = CpuRenderer::new(Arc::clone(mesh), settings)
            .and_then(|mut renderer| measure(&mut renderer, &**mesh, &transfer, size));
        lines.push(line(name, &format!("raycast on the CPU, {told}"), &on_host));
        for (method, order, word) in
            [(Method::CellCast, OrderMethod::Mpvonc, "cellcast"), (Method::Project, OrderMethod::Centroid, "project")]
        {
            let settings = Settings { method, order, integral, ..Settings::default() };
            let drawn = GpuRenderer::new(gpu()?, Arc::clone(mesh), settings)
                .and_then(|mut renderer| measure(&mut renderer, &**mesh, &transfer, size));
            lines.push(line(name, &format!("{word}, {order}, {told}"), &drawn));
        }
    }
    Ok(lines)
}

/// Meshes under functions of two variables, in closed form and cut into ten.
///
/// # Errors
/// No graphics device.
pub fn bivariate(name: &str, mesh: &Arc<TetMesh>, size: [u32; 2]) -> Result<Vec<String>> {
    let transfer = gaussians(&**mesh);
    let mut lines = Vec::new();
    for integral in [SegmentIntegral::Analytic, SegmentIntegral::Segmented { pieces: 10 }, SegmentIntegral::default()] {
        let settings =
            Settings { method: Method::Project, order: OrderMethod::Centroid, integral, ..Settings::default() };
        let drawn = GpuRenderer::new(gpu()?, Arc::clone(mesh), settings)
            .and_then(|mut renderer| measure(&mut renderer, &**mesh, &transfer, size));
        lines.push(line(name, &format!("project, {integral}"), &drawn));
    }
    let settings = Settings { method: Method::RayCast, ..Settings::default() };
    let on_host = CpuRenderer::new(Arc::clone(mesh), settings)
        .and_then(|mut renderer| measure(&mut renderer, &**mesh, &transfer, size));
    lines.push(line(name, &format!("raycast on the CPU, {}", settings.integral), &on_host));
    Ok(lines)
}

fn read(file: &Path, field: &str) -> Result<Arc<TetMesh>> {
    let raw = mesh::read(file, &ReadOptions::default())?;
    Ok(Arc::new(TetMesh::new(raw, &FieldChoice::parse(field), BuildOptions::default())?.0))
}

fn print(name: &str, lines: Result<Vec<String>>) {
    match lines {
        Ok(lines) => lines.iter().for_each(|l| println!("{l}")),
        Err(error) => println!("{}", line(name, "-", &Err(error))),
    }
}

fn parse(arguments: impl IntoIterator<Item = String>) -> Result<(PathBuf, [u32; 2])> {
    let refuse = |what: &str| Error::Asked(format!("{what}; usage: papers DATA [--size WxH]"));
    let (mut data, mut size) = (None, [512, 512]);
    let mut arguments = arguments.into_iter();
    while let Some(argument) = arguments.next() {
        if argument == "--size" {
            let value = arguments.next().ok_or_else(|| refuse("--size needs a value"))?;
            let parsed = value.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
            size = parsed.ok_or_else(|| refuse(&format!("'{value}' is no size")))?;
        } else if data.replace(argument.into()).is_some() {
            return Err(refuse("two folders are one too many"));
        }
    }
    Ok((data.ok_or_else(|| refuse("no folder is named"))?, size))
}

fn run() -> Result<()> {
    let (data, size) = parse(std::env::args().skip(1))?;
    head("Structured grids");
    for name in VOLUMES {
        print(name, volume(name, &data.join(format!("structured/{name}.vti")), size));
    }
    let meshes = MESHES.map(|(name, field)| (name, read(&data.join(format!("tet/{name}.vtu")), field)));
    for (title, table) in [
        ("Functions of one variable", univariate as fn(&str, &Arc<TetMesh>, [u32; 2]) -> Result<Vec<String>>),
        ("Functions of two variables", bivariate),
    ] {
        head(title);
        for (name, mesh) in &meshes {
            match mesh {
                Ok(mesh) => print(name, table(name, mesh, size)),
                Err(error) => println!("| {name} | - | not read: {error} | | | | |"),
            }
        }
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
