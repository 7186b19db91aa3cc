//! Transfer functions on normalised axes and mesh lengths, in f32.

use glam::{Vec2, Vec4};

use crate::cpu::axis::Axis;
use crate::cpu::segment::{CurveMedium, Gaussian, Medium as _, Piece, WidgetMedium, WidgetsMedium};
use crate::error::{Error, Result};
use crate::scene::{Curve, TransferFunction, Widget, WidgetShape};
use crate::space::Interval;

/// By how much ranges are widened, normalised: fields at the ends are means of f32 values, and err by about as much.
const RANGE_HAIR: f64 = 1e-7;

/// A transfer function that segments can be integrated with.
#[derive(Clone, Debug)]
pub enum Compiled {
    Curve(CurveMedium),
    Widgets(WidgetsMedium),
}

impl Compiled {
    /// `data_per_mesh`: see [`crate::tet::TetMesh`].
    ///
    /// # Errors
    /// What this engine does not integrate; a value that f32 cannot hold.
    pub fn new(transfer: &TransferFunction, scalar: Axis, gradient: Axis, data_per_mesh: f64) -> Result<Self> {
        known(transfer)?;
        Ok(match transfer {
            TransferFunction::Curve(curve) => Self::Curve(compile_curve(curve, scalar, data_per_mesh)?),
            TransferFunction::Widgets(list) => {
                let widgets = list.iter().enumerate();
                let compile = |(i, w)| widget(i, w, scalar, gradient, data_per_mesh);
                Self::Widgets(WidgetsMedium { widgets: widgets.map(compile).collect::<Result<_>>()? })
            }
        })
    }

    /// Gradient magnitudes matter.
    pub fn is_bivariate(&self) -> bool {
        match self {
            Self::Curve(_) => false,
            Self::Widgets(medium) => medium
                .widgets
                .iter()
                .any(|w| w.gradient.is_some() || w.gaussian.is_some_and(|g| g.whiten.iter().any(|row| row.y != 0.0))),
        }
    }
}

/// One segment in a mesh whose fields span just the segment's values: premultiplied colour and opacity. Ends are (scalar,
/// gradient magnitude), all in data units. How the engine's arithmetic is checked, a segment at a time.
///
/// # Errors
/// What the engine does not integrate.
pub fn integrate(transfer: &TransferFunction, front: [f64; 2], back: [f64; 2], length: f64) -> Result<[f32; 4]> {
    let [scalar, gradient] = [0, 1].map(|i| Axis::of(Interval::of([front[i], back[i]])));
    // Mesh units in which the segment is within f32's range, whatever the data's are.
    let data_per_mesh = length.max(f64::MIN_POSITIVE);
    let [front, back] = [front, back].map(|[s, g]| [scalar.apply(s) as f32, gradient.apply(g) as f32]);
    let (hint, length) = (&mut 0, (length / data_per_mesh) as f32);
    let seen = match Compiled::new(transfer, scalar, gradient, data_per_mesh)? {
        Compiled::Curve(medium) => medium.segment(hint, front, back, length),
        Compiled::Widgets(medium) => medium.segment(hint, front, back, length),
    };
    Ok(seen.to_array())
}

/// Whether this engine integrates every part of it.
///
/// # Errors
/// The first part that it does not.
pub fn known(transfer: &TransferFunction) -> Result<()> {
    let TransferFunction::Widgets(widgets) = transfer else { return Ok(()) };
    for (index, widget) in widgets.iter().enumerate() {
        let what = match widget.shape {
            _ if widget.window.is_some() => "a window",
            WidgetShape::Triangle { .. } => "a triangle wave",
            WidgetShape::Sinusoid { .. } => "a sinusoid",
            WidgetShape::Ramp { .. } => "a ramp",
            WidgetShape::Uniform | WidgetShape::Gaussian { .. } => continue,
        };
        return Err(Error::Asked(format!("widget {index}: {what} cannot be cast on the CPU yet: use --device oracle")));
    }
    Ok(())
}

fn compile_curve(curve: &Curve, scalar: Axis, data_per_mesh: f64) -> Result<CurveMedium> {
    let mut nodes: Vec<(f64, [f64; 4])> = curve
        .nodes
        .iter()
        .map(|n| (scalar.apply(n.scalar), [n.color[0], n.color[1], n.color[2], n.extinction * data_per_mesh]))
        .collect();
    let ends = nodes.first().copied().zip(nodes.last().copied());
    let (first, last) = ends.unwrap_or(((0.0, [0.0; 4]), (0.0, [0.0; 4])));
    // Constant beyond the ends, and beyond every value.
    nodes.insert(0, (first.0.min(0.0) - 1.0, first.1));
    nodes.push((last.0.max(1.0) + 1.0, last.1));
    let mut pieces = Vec::with_capacity(nodes.len());
    for (index, pair) in nodes.windows(2).enumerate() {
        let ((from, low), (to, high)) = (pair[0], pair[1]);
        let slope: [f64; 4] = std::array::from_fn(|i| (high[i] - low[i]) / (to - from));
        let [start, slope] = [low, slope].map(|v| Vec4::from(v.map(|v| v as f32)));
        let piece = Piece { low: from as f32, high: to as f32, start, slope };
        // Nodes that f32 does not tell apart: a jump.
        if piece.low == piece.high {
            continue;
        }
        if !(start.is_finite() && slope.is_finite() && piece.low.is_finite() && piece.high.is_finite()) {
            return Err(Error::Asked(format!("curve: the nodes around piece {index} are beyond f32 on this mesh")));
        }
        pieces.push(piece);
    }
    Ok(CurveMedium { pieces })
}

fn widget(index: usize, w: &Widget, scalar: Axis, gradient: Axis, data_per_mesh: f64) -> Result<WidgetMedium> {
    let range = |range: Option<[f64; 2]>, axis: Axis| {
        let ends = range.map(|[low, high]| {
            // Ends belong to the range: a hair wider, since values at the ends are computed.
            [axis.apply(low) - RANGE_HAIR, axis.apply(high) + RANGE_HAIR].map(|e| e.clamp(-1.0, 2.0) as f32)
        });
        // One that holds every value cuts nothing.
        ends.filter(|[low, high]| *low >= 0.0 || *high <= 1.0)
    };
    let gaussian = match w.shape {
        WidgetShape::Gaussian { center, sigma, angle } => {
            let (sin, cos) = angle.sin_cos();
            let [a, b] = sigma.map(|s| 1.0 / (std::f64::consts::SQRT_2 * s));
            // Data units per normalised unit.
            let (us, ug) = (1.0 / scalar.scale, 1.0 / gradient.scale);
            // Narrower than any f32 can tell; keeps squares finite.
            let row = |x: f64, y: f64| Vec2::new(x.clamp(-1e12, 1e12) as f32, y.clamp(-1e12, 1e12) as f32);
            Some(Gaussian {
                center: Vec2::new(scalar.apply(center[0]) as f32, gradient.apply(center[1]) as f32),
                whiten: [row(cos * a * us, sin * a * ug), row(-sin * b * us, cos * b * ug)],
            })
        }
        _ => None,
    };
    let [r, g, b] = w.color.map(|c| c as f32);
    let (color, extinction) = (Vec4::new(r, g, b, 0.0), (w.extinction * data_per_mesh) as f32);
    let center = gaussian.map_or(Vec2::ZERO, |g| g.center);
    if !(color.is_finite() && center.is_finite() && extinction.is_finite()) {
        return Err(Error::Asked(format!(
            "widget {index}: its centre, colour or extinction is beyond f32 on this mesh (centre {center}, extinction \
             {extinction})"
        )));
    }
    Ok(WidgetMedium {
        color,
        extinction,
        gaussian,
        scalar: range(w.scalar_range, scalar),
        gradient: range(w.gradient_range, gradient),
    })
}
