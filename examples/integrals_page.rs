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
use tetralux::renderer::{Frame, OrderMethod, Renderer as _, SegmentIntegral, Settings};
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

/// An integral's row: its name, what it draws beside 16 times the difference to the reference, and how far that is.
pub type Row = (&'static str, Image, Comparison);

/// Rows of integrals on one scene.
///
/// # Errors
/// Files that cannot be read, no graphics device.
pub fn rows(scene: &str, integrals: &[&'static str], size: Option<[u32; 2]>) -> Result<Vec<Row>> {
    let mut more = Vec::new();
    if let Some([width, height]) = size {
        more = vec![set("image.width", &width.to_string()), set("image.height", &height.to_string())];
    }
    let scene = Scene::read(Some(scene.as_ref()), &more)?;
    // Never the stand-in: there is a file.
    let (mesh, _) = common::mesh(Some(&PathBuf::from(MESH)), scene.field.as_deref(), Sample::Tangle, 0)?;
    let (camera, transfer) = scene.resolve(&*mesh)?;
    let background = scene.premultiplied_background();
    let frame = Frame { camera: &camera, transfer: &transfer, optics: &scene.optics, size: scene.size, background };
    let keys: Vec<f64> = centroid_depth(&mesh, &camera);
    let want = Oracle::new(Arc::clone(&mesh)).render_in_order(&frame, &keys)?;
    let row = |&name: &&'static str| {
        let integral: SegmentIntegral = name.parse()?;
        let settings = Settings { integral, order: OrderMethod::Centroid, ..Settings::default() };
        let mut renderer = GpuRenderer::new(Gpu::new(DeviceChoice::Any)?, Arc::clone(&mesh), settings)?;
        let got = renderer.render(&frame, false)?.image;
        let comparison = Comparison::new(&got, &want)?;
        Ok((name, beside(&[got, comparison.difference_picture(SCALE)], GAP)?, comparison))
    };
    integrals.iter().map(row).collect()
}

/// The pictures of an even number of rows in two columns.
///
/// # Errors
/// Pictures of different sizes.
pub fn sheet(rows: &[Row]) -> Result<Image> {
    let pictures: Vec<Image> = rows.iter().map(|row| row.1.clone()).collect();
    let (left, right) = pictures.split_at(rows.len() / 2);
    beside(&[stack(left), stack(right)], 2 * GAP)
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
    let thin_band = rows(THIN_BAND, &INTEGRALS, size)?;
    sheet(&thin_band)?.write(output.as_ref(), PngEncoding::Srgb)?;
    print(&thin_band);
    print(&rows(TWO_COLORS, &of_widgets(), size)?);
    Ok(())
}

fn print(rows: &[Row]) {
    println!("\n| integral | PSNR, dB | 99.9th percentile | largest |\n| --- | --- | --- | --- |");
    for (name, _, c) in rows {
        println!("| `{name}` | {:.1} | {:.1e} | {:.1e} |", c.psnr, c.percentile_99_9, c.max);
    }
}
