//! Feature enhancement with a function of scalar and gradient magnitude: the shock before a blunt fin and the vortex at
//! its foot, which no interval of density alone separates from the boundary layer.
//!
//! `cargo run --release --example feature_enhancement -- bluntfin.vtu -o fin.png`
//!
//! Without a file: potential flow past a sphere, with its stagnation point and its fast belt.

#![expect(clippy::print_stdout, reason = "a program")]

#[path = "common/mod.rs"]
mod common;

use tetralux::Result;
use tetralux::image::PngEncoding;
use tetralux::mesh::synth::Sample;

use common::{Asked, mesh, picture, set};

/// Widgets for the generated flow, in place of the scene's: its stagnation points and its belt of low pressure.
const STAND_IN: [(&str, &str); 2] = [
    ("camera", "{azimuth = -125, elevation = 25, zoom = 7}"),
    (
        "transfer.widget",
        "[{shape = 'gaussian', center = [0.7, 0.9], sigma = [0.12, 0.4], color = '#4f9be8', extinction = 6}, \
     {shape = 'gaussian', center = [-0.9, 0.9], sigma = [0.15, 0.6], color = '#ff7a2a', extinction = 6}]",
    ),
];

/// Renders what is asked for; returns what was done.
///
/// # Errors
/// Files that cannot be read or written; scenes that are wrong.
pub fn run(arguments: impl IntoIterator<Item = String>) -> Result<String> {
    let asked = Asked::parse("feature_enhancement", arguments)?;
    let more: Vec<_> = match &asked.mesh {
        Some(_) => Vec::new(),
        None => STAND_IN.iter().map(|(key, value)| set(key, value)).collect(),
    };
    let scene = asked.scene(&more)?;
    let (mesh, told) = mesh(asked.mesh.as_ref(), scene.field.as_deref(), Sample::SphereFlow, 60_000)?;
    let (image, drawn) = picture(&mesh, &scene, asked.device)?;
    image.write(&asked.output, PngEncoding::Srgb)?;
    Ok(format!("{told}\ndrawn on {drawn}: {}", asked.output.display()))
}

fn main() -> Result<()> {
    println!("{}", run(std::env::args().skip(1))?);
    Ok(())
}
