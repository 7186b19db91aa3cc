//! The transfer function as a panel beside the picture, axes in data units.

use plotters::prelude::RGBColor;

use super::plot::{self, Axes};
use crate::error::{Error, Result};
use crate::image::{Image, srgb_from_linear};
use crate::scene::{Curve, TransferFunction, Widget, WidgetShape};
use crate::space::Interval;
use crate::tet::Domain;

/// Below this height, pixels, there is no room for axes.
pub(crate) const MIN_HEIGHT: u32 = 160;
const PAPER: [f32; 3] = [0.09, 0.09, 0.1];
const INK: RGBColor = RGBColor(225, 225, 225);

/// `image` with the panel at its right.
pub(crate) fn beside(image: &Image, mesh: &dyn Domain, transfer: &TransferFunction) -> Result<Image> {
    if image.height < MIN_HEIGHT {
        return Err(Error::Asked(format!(
            "a legend needs a picture at least {MIN_HEIGHT} pixels high, not {}",
            image.height
        )));
    }
    let panel = panel(image.height, mesh, transfer)?;
    let (left, right) = (image.width as usize, panel.width as usize);
    let rows = image.pixels.chunks_exact(left).zip(panel.pixels.chunks_exact(right));
    let pixels = rows.flat_map(|(a, b)| a.iter().chain(b)).copied().collect();
    Ok(Image { width: image.width + panel.width, height: image.height, pixels })
}

/// The panel alone; `height`: at least [`MIN_HEIGHT`].
pub(crate) fn panel(height: u32, mesh: &dyn Domain, transfer: &TransferFunction) -> Result<Image> {
    let width = (height / 2).clamp(240, 420);
    let side = (width - 90).min(height - 90) as i32;
    let (scalar, gradient) = (mesh.scalar_range(), mesh.gradient_range());
    let gradient_label = format!("|grad {}|", mesh.field());
    let (y, y_label) = match transfer {
        TransferFunction::Widgets(widgets) => {
            (Interval { max: gradient.max.min(reach(widgets, scalar, gradient)), ..gradient }, gradient_label.as_str())
        }
        TransferFunction::Curve(curve) => (Interval { min: 0.0, max: highest(curve, scalar) }, "extinction per length"),
    };
    let axes = Axes { frame: [65, 40, 65 + side, 40 + side], x: scalar, y, x_label: mesh.field(), y_label, ink: INK };
    plot::picture([width, height], |area| {
        area.fill(&display(PAPER))?;
        match transfer {
            TransferFunction::Widgets(widgets) => axes.fill(area, |s, g| Some(plane_color(transfer, widgets, s, g)))?,
            TransferFunction::Curve(curve) => axes.fill(area, |s, extinction| {
                let node = curve.at(s);
                (extinction <= node.extinction).then(|| display(encode(node.color)))
            })?,
        }
        axes.draw(area)
    })
}

/// The gradient magnitude beyond which no widget shows: gradients have long tails that would squeeze the rest.
fn reach(widgets: &[Widget], scalar: Interval, gradient: Interval) -> f64 {
    let of = |widget: &Widget| {
        let shape = match &widget.shape {
            WidgetShape::Uniform | WidgetShape::Triangle { .. } | WidgetShape::Sinusoid { .. } => f64::INFINITY,
            WidgetShape::Gaussian { center, sigma, angle } => {
                center[1] + 3.0 * (sigma[0] * angle.sin()).hypot(sigma[1] * angle.cos())
            }
            WidgetShape::Ramp { direction, knots } => highest_gradient(*direction, knots, scalar),
        };
        let window = widget.window.as_ref();
        let shape = window.map_or(shape, |w| shape.min(highest_gradient(w.direction, &w.knots, scalar)));
        widget.gradient_range.map_or(shape, |[_, high]| shape.min(1.1 * high))
    };
    let most = widgets.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    // Widgets that all lie below the range leave a frame with nothing in it.
    if most > gradient.min { most } else { gradient.max }
}

/// The largest gradient magnitude that the knots let through anywhere within `scalar`.
fn highest_gradient(direction: [f64; 2], knots: &[[f64; 2]], scalar: Interval) -> f64 {
    let (Some(first), Some(last)) = (knots.first(), knots.last()) else { return f64::INFINITY };
    // `low <= a s + b g <= high` at either end of the scalars.
    let at = |s: f64| {
        let ends = [first[0], last[0]].map(|u| (u - direction[0] * s) / direction[1]);
        ends[0].max(ends[1])
    };
    if direction[1] == 0.0 { f64::INFINITY } else { 1.1 * at(scalar.min).max(at(scalar.max)) }
}

/// The largest extinction within `scalar`; 1 where there is none.
fn highest(curve: &Curve, scalar: Interval) -> f64 {
    let inside = curve.nodes.iter().filter(|n| scalar.min <= n.scalar && n.scalar <= scalar.max).map(|n| n.extinction);
    let ends = [curve.at(scalar.min).extinction, curve.at(scalar.max).extinction];
    Some(inside.chain(ends).fold(0.0, f64::max)).filter(|e| *e > 0.0).unwrap_or(1.0)
}

/// The mean colour, fading into the paper with the root of the extinction, so that faint widgets are seen.
fn plane_color(transfer: &TransferFunction, widgets: &[Widget], s: f64, g: f64) -> RGBColor {
    let most = widgets.iter().map(|w| w.extinction).fold(0.0, f64::max);
    let (extinction, emission) = transfer.extinction_and_emission(s, g);
    if extinction <= 0.0 {
        return display(PAPER);
    }
    let strength = (extinction / most).min(1.0).sqrt() as f32;
    let color = encode(emission.map(|e| e / extinction));
    display(std::array::from_fn(|c| PAPER[c] + strength * (color[c] - PAPER[c])))
}

fn encode(linear: [f64; 3]) -> [f32; 3] {
    linear.map(|c| srgb_from_linear((c as f32).clamp(0.0, 1.0)))
}

fn display(srgb: [f32; 3]) -> RGBColor {
    let [r, g, b] = srgb.map(|c| (255.0 * c).round() as u8);
    RGBColor(r, g, b)
}
