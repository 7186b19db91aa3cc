//! Every integral on one scene with a thin band, and those of widgets on one with two colours, held against the f64
//! reference: the picture and the tables of `docs/integrals.md`.
//!
//! `cargo run --release --example integrals_page -- docs/integrals.png [WIDTHxHEIGHT]`
//!
//! The picture has a row for each integral, in the table's order: what it draws, and its difference to the reference
//! composed in the same order of cells, 16 times; of the first scene alone. The tables are printed.

#![expect(clippy::print_stdout, reason = "a program")]

#[path = "common/mod.rs"]
mod common;

use std::path::PathBuf;
use std::sync::Arc;

use tetralux::gpu::{DeviceChoice, Gpu, GpuRenderer};
use tetralux::image::{Comparison, Image, PngEncoding};
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::plan::order::centroid_depth;
use tetralux::renderer::{Frame, Renderer as _, SegmentIntegral, Settings};
use tetralux::scene::Scene;
use tetralux::{Error, Result};

use common::{beside, set};

const MESH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/data/fire_ug.vtu");
/// A 1D function with a thin band.
pub const THIN_BAND: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/scenes/thin_band.toml");
/// Two overlapping widgets.
pub const TWO_COLORS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/scenes/two_colors.toml");
/// In the page's order.
pub const INTEGRALS: [&str; 8] = [
    "vertex-linear",
    "mean-scalar",
    "preintegrated",
    "partial",
    "partial-direct",
    "analytic",
    "segmented:10",
    "adaptive:1e-3",
];
/// Those that integrate sums of widgets: all but the table of 1D functions.
pub fn of_widgets() -> Vec<&'static str> {
    INTEGRALS.into_iter().filter(|name| *name != "preintegrated").collect()
}

const GAP: u32 = 4;
/// What differences are multiplied by.
const SCALE: f32 = 16.0;

/// The picture, and the table's rows: integral, and how far its picture is from the reference.
///
/// # Errors
/// Files that cannot be read, no graphics device.
pub fn page(
    scene: &str,
    integrals: &[&'static str],
    size: Option<[u32; 2]>,
) -> Result<(Image, Vec<(&'static str, Comparison)>)> {
    let mut more = Vec::new();
    if let Some([width, height]) = size {
        more = vec![set("image.width", &width.to_string()), set("image.height", &height.to_string())];
    }
    let scene = Scene::read(Some(scene.as_ref()), &more)?;
    // Never the stand-in: there is a file.
    let (mesh, _) = common::mesh(Some(&PathBuf::from(MESH)), scene.field.as_deref(), Sample::Tangle, 0)?;
    let (camera, transfer) = scene.resolve(&mesh)?;
    let background = scene.premultiplied_background();
    let frame = Frame { camera: &camera, transfer: &transfer, optics: &scene.optics, size: scene.size, background };
    let keys: Vec<f64> = centroid_depth(&mesh, &camera);
    let want = Oracle::new(Arc::clone(&mesh)).render_in_order(&frame, &keys)?;
    let mut rows = Vec::new();
    let mut columns = [Vec::new(), Vec::new()];
    for (i, &name) in integrals.iter().enumerate() {
        let integral: SegmentIntegral = name.parse()?;
        let settings = Settings { integral, ..Settings::default() };
        let mut renderer = GpuRenderer::new(Gpu::new(DeviceChoice::Any)?, Arc::clone(&mesh), settings)?;
        let got = renderer.render(&frame, false)?.image;
        let comparison = Comparison::new(&got, &want)?;
        let pair = beside(&[got, comparison.difference_picture(SCALE)], GAP)?;
        columns[i / integrals.len().div_ceil(2)].push(pair);
        rows.push((name, comparison));
    }
    // An odd number leaves a place empty.
    if let ([left, right], Some(first)) = (&columns, columns[0].first())
        && left.len() > right.len()
    {
        let blank = Image { pixels: vec![[1.0; 4]; first.pixels.len()], ..first.clone() };
        columns[1].push(blank);
    }
    let sheet = beside(&columns.map(|pairs| stack(&pairs)), 2 * GAP)?;
    Ok((sheet, rows))
}

/// Pictures of one width below each other.
fn stack(pictures: &[Image]) -> Image {
    let width = pictures.first().map_or(0, |p| p.width);
    let mut pixels = Vec::new();
    for (i, picture) in pictures.iter().enumerate() {
        if i > 0 {
            pixels.resize(pixels.len() + (width * GAP) as usize, [1.0; 4]);
        }
        pixels.extend_from_slice(&picture.pixels);
    }
    let height = (pixels.len() / width.max(1) as usize) as u32;
    Image { width, height, pixels }
}

fn main() -> Result<()> {
    let mut arguments = std::env::args().skip(1);
    let output = arguments.next().unwrap_or_else(|| "integrals.png".into());
    let size = arguments.next().map(|text| {
        let size = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
        size.ok_or_else(|| Error::Asked(format!("'{text}' is no size as 240x160")))
    });
    let size = size.transpose()?;
    let (image, rows) = page(THIN_BAND, &INTEGRALS, size)?;
    image.write(output.as_ref(), PngEncoding::Srgb)?;
    print(&rows);
    let (_, rows) = page(TWO_COLORS, &of_widgets(), size)?;
    print(&rows);
    Ok(())
}

fn print(rows: &[(&str, Comparison)]) {
    println!("\n| integral | PSNR, dB | 99.9th percentile | largest |\n| --- | --- | --- | --- |");
    for (name, c) in rows {
        println!("| `{name}` | {:.1} | {:.1e} | {:.1e} |", c.psnr, c.percentile_99_9, c.max);
    }
}
