//! Mean transmittance over a piece of a ray, `T = int_0^1 exp(-tau(x)) dx`, of one Gaussian or one wave. Where emission is
//! not weighted by extinction (Song et al. 2009, Eq. 4) the piece's colour is `c D T`, D its length.
//!
//! The twin, in f32 and with the look-ups, of `shaders/math/unweighted.wgsl`. With the visible length `J(u)` from `u` to
//! a fixed end, the part from `u1` to `u2` is `J(u1) - exp(-tau) J(u2)`, tau the depth between: no exponential grows, which
//! is what the published form `exp(P erf B) (T(P, A D + B) - T(P, B))` fails by.

use std::f32::consts::{PI, TAU};

use super::{GAUSSIAN_END, Interpolation, Kind, MOST_STRENGTH};

/// Nodes in (0, 1) of the 5-point Gauss-Legendre rule (`gauss_legendre_five` of `tables/coefficients.json`).
pub const SHORT_NODES: [f32; 5] = [0.046_910_077, 0.230_765_34, 0.5, 0.769_234_66, 0.953_089_95];

/// Its weights.
const SHORT_WEIGHTS: [f32; 5] = [0.118_463_44, 0.239_314_34, 0.284_444_45, 0.239_314_34, 0.118_463_44];

/// True for a piece shorter than 1 (in the table's own length) and thinner than 1. The error of a look-up is divided by the
/// length, so these take quadrature, and nothing else needs to: a short piece that is not thin sees little of its length.
pub fn is_short(extent: f32, depth: f32) -> bool {
    extent < 1.0 && depth < 1.0
}

/// The mean transmittance of a short piece from its exact depths up to [`SHORT_NODES`].
pub fn mean_transmittance_short(depths: [f32; 5]) -> f32 {
    SHORT_WEIGHTS.iter().zip(depths).map(|(w, depth)| w * (-depth).exp()).sum()
}

/// The part of a piece where a Gaussian is not nothing, in its whitened coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussianSpan {
    /// Length in front of -4: transparent.
    pub clear_front: f32,
    /// Length beyond 4: transparent too.
    pub clear_back: f32,
    /// The second arguments of [`Kind::GaussianJ`] at both ends, in [-4, 4].
    pub ends: [f32; 2],
}

/// The span of `[start, start + extent]`. No difference of far coordinates: they would leave nothing of `extent`.
pub fn gaussian_span(start: f32, extent: f32) -> GaussianSpan {
    let end = GAUSSIAN_END as f32;
    let stop = start + extent;
    GaussianSpan {
        clear_front: (-end - start).clamp(0.0, extent),
        clear_back: (stop - end).clamp(0.0, extent),
        ends: [start.clamp(-end, end), stop.clamp(-end, end)],
    }
}

/// `(clear front + J(v1) - exp(-depth) (J(v2) - clear back)) / extent`: `visible` are the values at [`GaussianSpan::ends`].
pub fn mean_transmittance_gaussian_from(visible: [f32; 2], span: GaussianSpan, extent: f32, depth: f32) -> f32 {
    let rest = (-depth).exp();
    let seen = span.clear_front + (visible[0] - rest * visible[1]) + rest * span.clear_back;
    (seen / extent).clamp(0.0, 1.0)
}

/// The mean transmittance of a piece through the Gaussian `exp(-q^2 - v^2)`, whose whitened coordinate along the ray runs
/// from `start` to `start + extent`.
///
/// `strength` is `P = D kappa exp(-q^2) sqrt(pi) / (2 extent)`, D the piece's length and kappa the peak's extinction;
/// `depth_up_to(x)` is the optical depth of the piece's first share x in [0, 1].
/// Error at most 3e-4 (measured, `tables/README.md`); `None` at strengths of 1e3 or more, where the table ends (unless the
/// piece is short): such a piece wants depth-rescaled linear parts.
pub fn mean_transmittance_gaussian(
    start: f32,
    extent: f32,
    strength: f32,
    depth_up_to: impl Fn(f32) -> f32,
    interpolation: Interpolation,
) -> Option<f32> {
    let depth = depth_up_to(1.0);
    if is_short(extent, depth) {
        return Some(mean_transmittance_short(SHORT_NODES.map(depth_up_to)));
    }
    if !has_table(strength) {
        return None;
    }
    let span = gaussian_span(start, extent);
    let visible = span.ends.map(|v| Kind::GaussianJ.table().lookup_f32([strength, v], interpolation));
    Some(mean_transmittance_gaussian_from(visible, span, extent, depth))
}

/// True where the tables reach: false at [`MOST_STRENGTH`] and above, and for NaN.
pub fn has_table(strength: f32) -> bool {
    (0.0..MOST_STRENGTH as f32).contains(&strength)
}

/// The waves with a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wave {
    /// `|sin(pi p)|`, p in periods.
    Arch,
    /// `(1 - cos(2 pi p)) / 2`.
    Cosine,
}

impl Wave {
    /// The phase that one period runs through.
    pub const fn turn(self) -> f32 {
        match self {
            Self::Arch => PI,
            Self::Cosine => TAU,
        }
    }

    /// Its table of visible lengths.
    pub const fn kind(self) -> Kind {
        match self {
            Self::Arch => Kind::ArchK,
            Self::Cosine => Kind::CosineK,
        }
    }

    /// Depth of the rest of a period from `phase` in [0, turn], at strength 1: `1 + cos u`, or `(r - sin r) / 2` with
    /// `r = 2 pi - u`.
    pub fn rest(self, phase: f32) -> f32 {
        let left = self.turn() - phase;
        match self {
            Self::Arch => 2.0 * (0.5 * left).sin().powi(2),
            Self::Cosine => 0.5 * (left - left.sin()),
        }
    }
}

/// Where a piece lies in a wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaveSpan {
    /// Length as phase.
    pub extent: f32,
    /// Phases of both ends within their periods, in [0, turn]: the second arguments of the table.
    pub ends: [f32; 2],
    /// Starts of periods within the piece.
    pub starts: f32,
}

/// The span of a piece from `start` (in periods) over `periods` >= 0. Profiles are even: where the coordinate falls along
/// the ray, `start` is that of the mirrored wave, the negated coordinate.
pub fn wave_span(wave: Wave, start: f32, periods: f32) -> WaveSpan {
    let first = start - start.floor();
    let last = first + periods;
    let starts = last.floor();
    WaveSpan { extent: wave.turn() * periods, ends: [wave.turn() * first, wave.turn() * (last - starts)], starts }
}

/// `(K(u1) + exp(-rest) K(0) (1 - r^n) / (1 - r) - exp(-depth) K(u2)) / extent`: what is left of the first period, the `n`
/// periods that start within the piece as a geometric series of ratio `r = exp(-period)`, less what the last one has
/// beyond the piece. `visible` holds `K(u1), K(u2), K(0)`; `rest` and `period` are the depths of the first period's rest and
/// of a whole period.
pub fn mean_transmittance_wave_from(visible: [f32; 3], span: WaveSpan, rest: f32, period: f32, depth: f32) -> f32 {
    let [from_start, from_end, whole] = visible;
    let series = span.starts * phi_one(span.starts * period) / phi_one(period);
    let seen = from_start + (-rest).exp() * whole * series - (-depth).exp() * from_end;
    (seen / span.extent).clamp(0.0, 1.0)
}

/// The mean transmittance of a piece through any number of a wave's periods, from `start` over `periods` >= 0.
///
/// `strength` is `a = D kappa / extent`, D the piece's length, kappa the peak's extinction and the extent
/// [`Wave::turn`] times `periods`; `depth_up_to(x)` is the optical depth of the first share x.
/// Error at most 1e-3 (measured, `tables/README.md`); `None` as for [`mean_transmittance_gaussian`].
pub fn mean_transmittance_wave(
    wave: Wave,
    start: f32,
    periods: f32,
    strength: f32,
    depth_up_to: impl Fn(f32) -> f32,
    interpolation: Interpolation,
) -> Option<f32> {
    let span = wave_span(wave, start, periods);
    let depth = depth_up_to(1.0);
    if is_short(span.extent, depth) {
        return Some(mean_transmittance_short(SHORT_NODES.map(depth_up_to)));
    }
    if !has_table(strength) {
        return None;
    }
    let visible =
        [span.ends[0], span.ends[1], 0.0].map(|phase| wave.kind().table().lookup_f32([strength, phase], interpolation));
    let [rest, period] = [span.ends[0], 0.0].map(|phase| strength * wave.rest(phase));
    Some(mean_transmittance_wave_from(visible, span, rest, period, depth))
}

/// `(1 - exp(-t)) / t`, 1 at 0.
fn phi_one(t: f32) -> f32 {
    if t > 0.0 { -(-t).exp_m1() / t } else { 1.0 }
}
