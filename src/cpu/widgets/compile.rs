//! From the scene's widgets to normalised axes and mesh lengths: all that is computed in f64, before it is narrowed.

use std::f64::consts::SQRT_2;

use glam::{Vec2, Vec4};

use crate::cpu::widgets::any::AnyWidget;
use crate::cpu::widgets::gaussian::Gaussian;
use crate::cpu::widgets::knots::{KnotPiece, Knots};
use crate::cpu::widgets::plain::PlainWidget;
use crate::cpu::widgets::profile::{Phase, Profile, Wave};
use crate::error::{Error, Result};
use crate::scene::{SinusoidVariant, Widget, WidgetShape};
use crate::tet::Axis;

/// Normalised values lie between these whatever rounding does: of what is piecewise linear, no more is kept.
const DOMAIN: [f64; 2] = [-0.25, 1.25];

/// How data values become what segments are made of.
#[derive(Clone, Copy, Debug)]
pub struct Axes {
    /// Of the scalar.
    pub scalar: Axis,
    /// Of the gradient magnitude.
    pub gradient: Axis,
    /// See [`crate::tet::TetMesh`].
    pub data_per_mesh: f64,
    /// By how much ranges are widened, normalised.
    pub range_hair: f64,
}

impl Axes {
    /// A direction and the constant that make `direction . data` of normalised values.
    fn along(&self, direction: [f64; 2]) -> ([f64; 2], f64) {
        let [a, b] = direction;
        ([a / self.scalar.scale, b / self.gradient.scale], a * self.scalar.low + b * self.gradient.low)
    }
}

/// The widgets, if all are uniform or Gaussian and none has a window.
///
/// # Errors
/// A value that f32 cannot hold.
pub fn plain_widgets(widgets: &[Widget], axes: &Axes) -> Result<Option<Vec<PlainWidget>>> {
    let is_plain =
        |w: &Widget| w.window.is_none() && matches!(w.shape, WidgetShape::Uniform | WidgetShape::Gaussian { .. });
    if !widgets.iter().all(is_plain) {
        return Ok(None);
    }
    widgets.iter().enumerate().map(|(index, w)| plain_widget(index, w, axes)).collect::<Result<_>>().map(Some)
}

/// The widgets that are anywhere between the axes' ends.
///
/// # Errors
/// A value that f32 cannot hold.
pub fn any_widgets(widgets: &[Widget], axes: &Axes) -> Result<Vec<AnyWidget>> {
    let mut kept = Vec::with_capacity(widgets.len());
    for (index, w) in widgets.iter().enumerate() {
        kept.extend(any_widget(index, w, axes)?);
    }
    Ok(kept)
}

fn plain_widget(index: usize, w: &Widget, axes: &Axes) -> Result<PlainWidget> {
    let range = |range: Option<[f64; 2]>, axis: Axis| {
        let ends = range.map(|[low, high]| {
            // Ends belong to the range: a hair wider, since values at the ends are computed.
            [axis.apply(low) - axes.range_hair, axis.apply(high) + axes.range_hair].map(|e| e.clamp(-1.0, 2.0) as f32)
        });
        // One that holds every value cuts nothing.
        ends.filter(|[low, high]| *low >= 0.0 || *high <= 1.0)
    };
    let gaussian = match w.shape {
        WidgetShape::Gaussian { center, sigma, angle } => Some(gaussian(center, sigma, angle, axes)),
        _ => None,
    };
    let [r, g, b] = w.color.map(|c| c as f32);
    let (color, extinction) = (Vec4::new(r, g, b, 0.0), (w.extinction * axes.data_per_mesh) as f32);
    let center = gaussian.map_or(Vec2::ZERO, |g| g.center);
    if !(color.is_finite() && center.is_finite() && extinction.is_finite()) {
        return Err(Error::Asked(format!(
            "widget {index}: its centre, colour or extinction is beyond f32 on this mesh (centre {center}, extinction \
             {extinction})"
        )));
    }
    Ok(PlainWidget {
        color,
        extinction,
        gaussian,
        scalar: range(w.scalar_range, axes.scalar),
        gradient: range(w.gradient_range, axes.gradient),
    })
}

fn gaussian(center: [f64; 2], sigma: [f64; 2], angle: f64, axes: &Axes) -> Gaussian {
    let (sin, cos) = angle.sin_cos();
    let [a, b] = sigma.map(|s| 1.0 / (SQRT_2 * s));
    // Data units per normalised unit.
    let (us, ug) = (1.0 / axes.scalar.scale, 1.0 / axes.gradient.scale);
    // Narrower than any f32 can tell; keeps squares finite.
    let row = |x: f64, y: f64| Vec2::new(x.clamp(-1e12, 1e12) as f32, y.clamp(-1e12, 1e12) as f32);
    Gaussian {
        center: Vec2::new(axes.scalar.apply(center[0]) as f32, axes.gradient.apply(center[1]) as f32),
        whiten: [row(cos * a * us, sin * a * ug), row(-sin * b * us, cos * b * ug)],
    }
}

/// `None` where nothing of the widget is between the axes' ends.
fn any_widget(index: usize, w: &Widget, axes: &Axes) -> Result<Option<AnyWidget>> {
    let mut plain = plain_widget(index, w, axes)?;
    let wave = |direction, offset, period, wave| {
        let mut phase = phase(direction, offset, period, axes);
        if matches!(wave, Wave::Half) {
            // Two arches a period, of which one counts.
            phase.per *= 2.0;
            phase.rest *= 2.0;
        }
        if phase.per.is_finite() && phase.center.is_finite() && phase.rest.is_finite() {
            return Ok(Some(Profile::Wave(phase, wave)));
        }
        Err(Error::Asked(format!("widget {index}: its period or offset is beyond f32 on this mesh ({phase:?})")))
    };
    let piecewise = |direction, list| match knots(direction, list, axes) {
        Some(knots) if !knots.is_finite() => {
            Err(Error::Asked(format!("widget {index}: its knots are beyond f32 on this mesh")))
        }
        knots => Ok(knots),
    };
    let profile = match w.shape {
        WidgetShape::Uniform => Some(Profile::Uniform),
        WidgetShape::Gaussian { .. } => plain.gaussian.take().map(Profile::Gaussian),
        WidgetShape::Triangle { direction, offset, period, duty } => {
            wave(direction, offset, period, Wave::Triangle { duty: duty as f32 })?
        }
        WidgetShape::Sinusoid { direction, offset, period, variant } => match variant {
            SinusoidVariant::Cos => wave(direction, offset, period, Wave::Cosine)?,
            SinusoidVariant::Arch => wave(direction, offset, period, Wave::Arch)?,
            SinusoidVariant::Half => wave(direction, offset, period, Wave::Half)?,
        },
        WidgetShape::Ramp { direction, ref knots } => piecewise(direction, knots)?.map(Profile::Ramp),
    };
    let window = match &w.window {
        None => None,
        Some(window) => match piecewise(window.direction, &window.knots)? {
            None => return Ok(None),
            knots => knots,
        },
    };
    Ok(profile.map(|profile| AnyWidget { plain, profile, window }))
}

/// From the nearest zero; whole periods are left out.
fn phase(direction: [f64; 2], offset: f64, period: f64, axes: &Axes) -> Phase {
    let (along, shift) = axes.along(direction);
    let per = along.map(|a| (a / period).clamp(-1e30, 1e30));
    let constant = (shift - offset) / period;
    let at = |p: [f64; 2]| per[0] * p[0] + per[1] * p[1] + constant;
    let middle = [axes.scalar.middle(), axes.gradient.middle()];
    let whole = at(middle).round();
    // From the middle, straight to the nearest zero.
    let squared = per[0] * per[0] + per[1] * per[1];
    let back = (at(middle) - whole) / squared;
    let center = [0, 1].map(|i| (middle[i] - back * per[i]) as f32);
    let rest = at(center.map(f64::from)) - whole;
    Phase { per: Vec2::from(per.map(|p| p as f32)), center: Vec2::from(center), rest: rest as f32 }
}

/// What lies in the domain; `None` if nothing does.
fn knots(direction: [f64; 2], knots: &[[f64; 2]], axes: &Axes) -> Option<Knots> {
    let (along, shift) = axes.along(direction);
    // Of length one, if not so by chance already: knots of any unit fit f32 then.
    let length = along[0].hypot(along[1]);
    let unit = if (0.1..=10.0).contains(&length) { 1.0 } else { 1.0 / length };
    let along = along.map(|a| a * unit);
    let ends = along.map(|a| DOMAIN.map(|x| a * x));
    let low: f64 = ends.iter().map(|[a, b]| a.min(*b)).sum();
    let high: f64 = ends.iter().map(|[a, b]| a.max(*b)).sum();
    let mut pieces = Vec::new();
    for pair in knots.windows(2) {
        let &[[from, at_from], [to, at_to]] = pair else { continue };
        let [u_from, u_to] = [from, to].map(|u| (u - shift) * unit);
        if u_to < low || u_from > high {
            continue;
        }
        let value = |u: f64| at_from + (at_to - at_from) * ((u - u_from) / (u_to - u_from)).clamp(0.0, 1.0);
        let ends = [u_from.max(low), u_to.min(high)];
        pieces.push(KnotPiece { ends: ends.map(|u| u as f32), values: ends.map(|u| value(u) as f32) });
    }
    let support = [pieces.first()?.ends[0], pieces.last()?.ends[1]];
    Some(Knots { direction: Vec2::from(along.map(|a| a as f32)), pieces, support })
}
