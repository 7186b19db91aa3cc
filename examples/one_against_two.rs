//! One field classified twice: by the scalar alone, by scalar and gradient magnitude, and the difference of the two
//! pictures.
//!
//! `cargo run --release --example one_against_two -- examples/data/fire_ug.vtu -o one_against_two.png`
//!
//! Without a file: the density of a hydrogen orbital.

#![expect(clippy::print_stdout, reason = "a program")]

#[path = "common/mod.rs"]
mod common;

use tetralux::image::{Comparison, PngEncoding};
use tetralux::mesh::synth::Sample;
use tetralux::scene::{Scene, TransferFunction, Widget, WidgetShape};
use tetralux::{Error, Result};

use common::{Asked, beside, mesh, picture, set};

/// Widgets for the generated density, whose two kinds of lobes share densities and differ in how fast they fall.
const STAND_IN: [(&str, &str); 2] = [
    ("transfer.units", "normalized"),
    (
        "transfer.widget",
        "[{shape = 'gaussian', center = [0.15, 0.6], sigma = [0.05, 0.1], color = '#ffd75e', extinction = 1}, \
         {shape = 'gaussian', center = [0.15, 0.15], sigma = [0.05, 0.1], color = '#2f8fd0', extinction = 1}]",
    ),
];
/// White pixels between the pictures.
const GAP: u32 = 8;
/// What the difference is multiplied by: both pictures keep below 1.
const SCALE: f32 = 2.0;

/// The same widget at every gradient magnitude.
fn without_gradient(widget: &Widget) -> Result<Widget> {
    let WidgetShape::Gaussian { center, sigma, angle: 0.0 } = widget.shape else {
        return Err(Error::Asked("widgets of this program are Gaussians without an angle: change the scene".into()));
    };
    // A sixteenth of sigma apart, chords of the Gaussian err by (1/16)^2 / 8 = 5e-4 of its peak.
    let knots = (-80..=80).map(|i| {
        let sigmas = f64::from(i) / 16.0;
        [center[0] + sigmas * sigma[0], (-0.5 * sigmas * sigmas).exp()]
    });
    let shape = WidgetShape::Ramp { direction: [1.0, 0.0], knots: knots.collect() };
    Ok(Widget { gradient_range: None, window: None, shape, ..widget.clone() })
}

/// The scene with its function reduced to the scalar.
fn reduced(scene: &Scene) -> Result<Scene> {
    let mut scene = scene.clone();
    if let Some(TransferFunction::Widgets(widgets)) = scene.transfer.as_mut().map(|t| &mut t.function) {
        *widgets = widgets.iter().map(without_gradient).collect::<Result<_>>()?;
    }
    Ok(scene)
}

/// Renders what is asked for; returns what was done.
///
/// # Errors
/// Files that cannot be read or written; scenes that are wrong, or have other widgets than Gaussians.
pub fn run(arguments: impl IntoIterator<Item = String>) -> Result<String> {
    let asked = Asked::parse("one_against_two", arguments)?;
    let more: Vec<_> = match &asked.mesh {
        Some(_) => Vec::new(),
        None => STAND_IN.iter().map(|(key, value)| set(key, value)).collect(),
    };
    let two = asked.scene(&more)?;
    let one = reduced(&two)?;
    let (mesh, told) = mesh(asked.mesh.as_ref(), two.field.as_deref(), Sample::Hydrogen, 60_000)?;
    let (by_scalar, drawn) = picture(&mesh, &one, asked.device)?;
    let (by_both, _) = picture(&mesh, &two, asked.device)?;
    let comparison = Comparison::new(&by_scalar, &by_both)?;
    let difference = comparison.difference_picture(SCALE);
    beside(&[by_scalar, by_both, difference], GAP)?.write(&asked.output, PngEncoding::Srgb)?;
    let differ = 100.0 * comparison.above_8_bit;
    Ok(format!(
        "{told}\nby scalar, by both, {SCALE} x difference ({differ:.1} % of the pixels differ by more than 1/255), \
         drawn on {drawn}: {}",
        asked.output.display()
    ))
}

fn main() -> Result<()> {
    println!("{}", run(std::env::args().skip(1))?);
    Ok(())
}
