//! The device of the tests that draw, and what they ask of it.
//!
//! They stand in binaries named `gpu_...`, so that a machine without a graphics driver leaves them out by name and says
//! so (`cargo nextest run -E 'not binary(/^gpu_/)'`); where they run, having no adapter is a failure.

use std::sync::{Arc, Mutex, PoisonError};
use std::thread::ThreadId;

use tetralux::gpu::{DeviceChoice, Gpu, GpuRenderer};
use tetralux::image::Image;
use tetralux::renderer::{Frame, Method, OrderMethod, Rendered, Renderer as _, Settings};
use tetralux::scene::{Camera, Optics, TransferFunction};
use tetralux::tet::TetMesh;

/// The software adapter, whose arithmetic is the same everywhere, unless `TETRALUX_GPU=hardware` asks for another.
pub fn choice() -> DeviceChoice {
    let asked = std::env::var("TETRALUX_GPU").unwrap_or_else(|_| "software".into());
    match asked.as_str() {
        "software" => DeviceChoice::Software,
        "hardware" => DeviceChoice::Hardware,
        _ => panic!(
            "TETRALUX_GPU={asked}: this test draws with `software` or `hardware`; to leave out all tests that do, \
             cargo nextest run -E 'not binary(/^gpu_/)'"
        ),
    }
}

/// The methods that project cells: what holds for one holds for the other, within the same limits.
pub const PROJECTIONS: [Method; 2] = [Method::Project, Method::CellCast];

/// Defaults, by a method, and sorted by centroids whatever the scene.
pub fn by(method: Method) -> Settings {
    Settings { method, order: OrderMethod::Centroid, ..Settings::default() }
}

/// Defaults, but sorted by centroids whatever the scene.
pub fn by_centroids() -> Settings {
    by(Method::Project)
}

/// The thread's device: a test's renderers share it, and with it the kernels. Those of tests before go, because software
/// adapters keep what they drew with.
pub fn device() -> Gpu {
    static OPEN: Mutex<Vec<(ThreadId, Gpu)>> = Mutex::new(Vec::new());
    const MOST: usize = 4;
    let mut open = OPEN.lock().unwrap_or_else(PoisonError::into_inner);
    let thread = std::thread::current().id();
    if let Some((_, gpu)) = open.iter().find(|(of, _)| *of == thread) {
        return gpu.clone();
    }
    let gpu = Gpu::new(choice()).unwrap_or_else(|e| panic!("{e}"));
    if open.len() == MOST {
        open.remove(0);
    }
    open.push((thread, gpu.clone()));
    gpu
}

/// A renderer on it.
pub fn renderer(mesh: &Arc<TetMesh>, settings: Settings) -> GpuRenderer {
    GpuRenderer::new(device(), mesh.clone(), settings).unwrap_or_else(|e| panic!("{e}"))
}

/// One frame without background.
pub fn draw(renderer: &mut GpuRenderer, camera: &Camera, transfer: &TransferFunction, size: [u32; 2]) -> Rendered {
    let frame = Frame { camera, transfer, optics: &Optics::PLAIN, size, background: [0.0; 4] };
    renderer.render(&frame, false).unwrap_or_else(|e| panic!("{e}"))
}

/// Cells left after `stage`.
pub fn cells(rendered: &Rendered, stage: &str) -> u64 {
    let found = rendered.stats.cells.iter().find(|(name, _)| name == stage);
    found.unwrap_or_else(|| panic!("no stage {stage} in {:?}", rendered.stats.cells)).1
}

/// Pixels that differ in any bit, and the first of them.
pub fn bits_that_differ(a: &Image, b: &Image) -> Option<String> {
    if [a.width, a.height] != [b.width, b.height] {
        return Some(format!("{}x{} and {}x{} pixels", a.width, a.height, b.width, b.height));
    }
    let differ = |(p, q): &(&[f32; 4], &[f32; 4])| p.map(f32::to_bits) != q.map(f32::to_bits);
    let count = a.pixels.iter().zip(&b.pixels).filter(differ).count();
    let (at, (p, q)) = a.pixels.iter().zip(&b.pixels).enumerate().find(|(_, pair)| differ(pair))?;
    Some(format!("{count} pixels differ, the first is number {at}: {p:?} and {q:?}"))
}

/// Fails unless the pictures have the same bits, and unless one flipped bit would have been seen.
pub fn assert_same_bits(a: &Image, b: &Image, what: &str) {
    if let Some(difference) = bits_that_differ(a, b) {
        panic!("{what}: {difference}");
    }
    let mut planted = b.clone();
    let middle = planted.pixels.len() / 2;
    planted.pixels[middle][1] = f32::from_bits(planted.pixels[middle][1].to_bits() ^ 1);
    assert!(bits_that_differ(a, &planted).is_some(), "{what}: a flipped bit went unnoticed");
    assert!(a.pixels.iter().any(|p| p[3] > 0.01), "{what}: nothing is seen");
}
