//! What a widget is over the plane of (scalar, gradient magnitude), without ranges and window: its value, its mean along
//! a line, and bounds of it.

use glam::Vec2;

use crate::cpu::widgets::gaussian::{Gaussian, gaussian_product_mean};
use crate::cpu::widgets::knots::Knots;
use crate::cpu::widgets::line::extremes;
use crate::cpu::widgets::waves::{arch_at, arch_mean, cosine_at, cosine_mean, triangle_at, triangle_mean};

/// By how much phases of a cell are widened, in units of what f32 tells apart there.
const PHASE_HAIR: f32 = 1e-6;

/// A shape on normalised axes.
#[derive(Clone, Debug)]
pub enum Profile {
    /// 1 everywhere.
    Uniform,
    /// A bell.
    Gaussian(Gaussian),
    /// A wave.
    Wave(Phase, Wave),
    /// Piecewise linear.
    Ramp(Knots),
}

/// What repeats.
#[derive(Clone, Copy, Debug)]
pub enum Wave {
    /// Tents that fill this part of every period.
    Triangle {
        /// In (0, 1].
        duty: f32,
    },
    /// `(1 - cos 2 pi p) / 2`.
    Cosine,
    /// `|sin pi p|`.
    Arch,
    /// The same, on the arches that begin at an even phase only.
    Half,
}

/// Periods along a direction, from a point where the phase is next to nothing: what is added there keeps its digits.
#[derive(Clone, Copy, Debug)]
pub struct Phase {
    /// Per unit of (scalar, gradient magnitude).
    pub per: Vec2,
    /// The point.
    pub center: Vec2,
    /// The phase there.
    pub rest: f32,
}

impl Phase {
    /// The phase at a point.
    #[inline(always)]
    pub fn at(&self, p: Vec2) -> f32 {
        self.per.dot(p - self.center) + self.rest
    }
}

impl Profile {
    /// The value at a point of the support.
    pub fn at(&self, p: Vec2) -> f32 {
        match self {
            Self::Uniform => 1.0,
            Self::Gaussian(gaussian) => gaussian.at(p),
            Self::Wave(phase, wave) => wave.at(phase.at(p)),
            Self::Ramp(knots) => knots.value(knots.along(p)),
        }
    }

    /// Mean from p to q, all of it in the support, times a linear weight. Exact but for rounding; never a difference of
    /// antiderivatives.
    pub fn mean(&self, p: Vec2, q: Vec2, weights: [f32; 2]) -> f32 {
        match self {
            Self::Uniform => 0.5 * (weights[0] + weights[1]),
            Self::Gaussian(gaussian) => gaussian_product_mean(gaussian.whitened(p), gaussian.whitened(q), weights),
            Self::Wave(phase, wave) => wave.mean([phase.at(p), phase.at(q)], weights),
            Self::Ramp(knots) => knots.mean(knots.along(p), knots.along(q), weights),
        }
    }

    /// Least and largest from p to q, all of it in the support.
    pub fn range(&self, p: Vec2, q: Vec2) -> [f32; 2] {
        match self {
            Self::Uniform => [1.0; 2],
            Self::Gaussian(gaussian) => gaussian.range(p, q),
            Self::Wave(phase, wave) => {
                let (a, b) = (phase.at(p), phase.at(q));
                wave.range(a.min(b), a.max(b))
            }
            Self::Ramp(knots) => knots.range(knots.along(p), knots.along(q)),
        }
    }

    /// Not exceeded between the corners.
    pub fn bound(&self, corners: [Vec2; 4]) -> f32 {
        match self {
            Self::Uniform => 1.0,
            Self::Gaussian(gaussian) => gaussian.bound(corners),
            Self::Wave(phase, wave) => {
                let [low, high] = extremes(corners.map(|c| phase.at(c)));
                let hair = PHASE_HAIR * (1.0 + phase.per.abs().element_sum());
                wave.range(low - hair, high + hair)[1]
            }
            Self::Ramp(knots) => knots.bound(extremes(corners.map(|c| knots.along(c)))),
        }
    }

    /// Gradient magnitudes matter.
    pub fn is_bivariate(&self) -> bool {
        match self {
            Self::Uniform => false,
            Self::Gaussian(gaussian) => gaussian.whiten.iter().any(|row| row.y != 0.0),
            Self::Wave(phase, _) => phase.per.y != 0.0,
            Self::Ramp(knots) => knots.direction.y != 0.0,
        }
    }
}

impl Wave {
    fn at(self, phase: f32) -> f32 {
        match self {
            Self::Triangle { duty } => triangle_at(phase, duty),
            Self::Cosine => cosine_at(phase),
            Self::Arch => arch_at(phase, false),
            Self::Half => arch_at(phase, true),
        }
    }

    fn mean(self, phases: [f32; 2], weights: [f32; 2]) -> f32 {
        match self {
            Self::Triangle { duty } => triangle_mean(phases, weights, duty),
            Self::Cosine => cosine_mean(phases, weights),
            Self::Arch => arch_mean(phases, weights, false),
            Self::Half => arch_mean(phases, weights, true),
        }
    }

    fn range(self, low: f32, high: f32) -> [f32; 2] {
        let (a, b) = (self.at(low), self.at(high));
        // Peaks lie at halves, of every second arch where the others are 0.
        let peak = match self {
            Self::Half => (0.5 * high - 0.25).floor() > (0.5 * low - 0.25).floor(),
            _ => (high + 0.5).floor() > (low + 0.5).floor(),
        };
        let valley = high.floor() > low.floor();
        [if valley { 0.0 } else { a.min(b) }, if peak { 1.0 } else { a.max(b) }]
    }
}
