//! Draws every shape of widget over (scalar, gradient magnitude): the picture of `docs/scene.md`.
//!
//! `cargo run --release --example widget_shapes -- docs/widgets.png`

use std::path::PathBuf;

use tetralux::image::{Image, PngEncoding};
use tetralux::scene::{Scene, TransferFunction, Widget};

/// Row by row in the picture; both axes run from 0 to 1.
const WIDGETS: [&str; 9] = [
    "shape = 'uniform'\nscalar_range = [0.2, 0.6]\ngradient_range = [0.3, 0.9]",
    "shape = 'gaussian'\ncenter = [0.5, 0.5]\nsigma = [0.25, 0.07]\nangle = 30",
    "shape = 'ramp'\ndirection = [1, 0.3]\nknots = [[0.2, 0], [0.5, 1], [0.6, 0.3], [0.9, 0.6]]",
    "shape = 'triangle'\nperiod = 0.25",
    "shape = 'triangle'\nperiod = 0.25\nduty = 0.3",
    "shape = 'triangle'\nperiod = 0.25\nwindow = {direction = [0, 1], knots = [[0.1, 0], [0.7, 1], [0.9, 1]]}",
    "shape = 'sinusoid'\nperiod = 0.3\ndirection = [2, 1]",
    "shape = 'sinusoid'\nperiod = 0.3\ndirection = [2, 1]\nvariant = 'arch'",
    "shape = 'sinusoid'\nperiod = 0.3\ndirection = [2, 1]\nvariant = 'half'",
];
/// Pixels along a tile's side, and between tiles.
const TILE: u32 = 144;
const GAP: u32 = 8;

fn widget(keys: &str) -> tetralux::Result<Widget> {
    let text = format!("[[transfer.widget]]\n{keys}\ncolor = '#ffd75e'\nextinction = 1\n");
    match Scene::parse(&text, &[])?.transfer.map(|choice| choice.function) {
        Some(TransferFunction::Widgets(mut widgets)) if widgets.len() == 1 => Ok(widgets.remove(0)),
        _ => Err(tetralux::Error::Asked("one widget was written, and something else was read".into())),
    }
}

fn main() -> tetralux::Result<()> {
    let output = std::env::args_os().nth(1).map_or_else(|| PathBuf::from("widgets.png"), PathBuf::from);
    let side = 3 * TILE + 4 * GAP;
    let mut image = Image::new(side, side);
    image.pixels.fill([1.0; 4]);
    for (index, keys) in (0..).zip(WIDGETS) {
        let widget = widget(keys)?;
        let (left, top) = (GAP + index % 3 * (TILE + GAP), GAP + index / 3 * (TILE + GAP));
        for (x, y) in (0..TILE).flat_map(|y| (0..TILE).map(move |x| (x, y))) {
            // The gradient magnitude grows upwards.
            let [s, g] = [x, TILE - 1 - y].map(|i| (f64::from(i) + 0.5) / f64::from(TILE));
            let strength = widget.extinction_at(s, g);
            let pixel = widget.color.map(|c| (0.01 + strength * c) as f32);
            image.pixels[((top + y) * side + left + x) as usize] = [pixel[0], pixel[1], pixel[2], 1.0];
        }
    }
    image.write(&output, PngEncoding::Srgb)
}
