//! Illustration: layers of a triangle wave, drawn by their outlines. What faces the eye is faded, so that layers within
//! layers stay visible without cutting anything away.
//!
//! `cargo run --release --example illustrative_silhouettes -- disk_out_ref.vtu -o silhouettes.png`
//!
//! Without a file: the tangle quartic.

#![expect(clippy::print_stdout, reason = "a program")]

#[path = "common/mod.rs"]
mod common;

use tetralux::Result;
use tetralux::image::PngEncoding;
use tetralux::mesh::synth::Sample;

use common::{Asked, mesh, picture, set};

/// Layers for the generated field, which fills its box and is largest at the corners.
const STAND_IN: (&str, &str) = (
    "transfer.widget",
    "[{shape = 'triangle', period = 0.03, duty = 0.2, scalar_range = [0, 0.1], color = '#1c4f7c', extinction = 30}]",
);

/// Renders what is asked for; returns what was done.
///
/// # Errors
/// Files that cannot be read or written; scenes that are wrong.
pub fn run(arguments: impl IntoIterator<Item = String>) -> Result<String> {
    let asked = Asked::parse("illustrative_silhouettes", arguments)?;
    let more = if asked.mesh.is_none() { vec![set(STAND_IN.0, STAND_IN.1)] } else { Vec::new() };
    let scene = asked.scene(&more)?;
    let (mesh, told) = mesh(asked.mesh.as_ref(), scene.field.as_deref(), Sample::Tangle, 60_000)?;
    let (image, drawn) = picture(&mesh, &scene, asked.device)?;
    image.write(&asked.output, PngEncoding::Srgb)?;
    Ok(format!("{told}\ndrawn on {drawn}: {}", asked.output.display()))
}

fn main() -> Result<()> {
    println!("{}", run(std::env::args().skip(1))?);
    Ok(())
}
