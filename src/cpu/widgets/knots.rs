//! Piecewise-linear functions along a direction: ramps and windows. Twins of `shaders/math/ramp.wgsl` and of the knots of
//! `shaders/shared/widgets.wgsl`.

use glam::Vec2;

use crate::cpu::widgets::line::{blend, clip_to_range};

/// By how much a cell's bounds are widened, in units of u.
const HAIR: f32 = 1e-6;

/// Linear in `u = direction . p` between knots, 0 outside them.
#[derive(Clone, Debug)]
pub struct Knots {
    /// Of length 0.1 to 10.
    pub direction: Vec2,
    /// Between neighbouring knots; at least one, ascending, without gaps.
    pub pieces: Vec<KnotPiece>,
    /// The outer knots.
    pub support: [f32; 2],
}

/// Linear from one knot to the next.
#[derive(Clone, Copy, Debug)]
pub struct KnotPiece {
    /// The knots' u, ascending.
    pub ends: [f32; 2],
    /// The values there.
    pub values: [f32; 2],
}

impl KnotPiece {
    /// The value at u; the ends' values beyond them.
    pub fn at(&self, u: f32) -> f32 {
        let [low, high] = self.ends;
        let part = ((u - low) / (high - low).max(1e-30)).clamp(0.0, 1.0);
        self.values[0] + part * (self.values[1] - self.values[0])
    }
}

impl Knots {
    /// No value is beyond f32.
    pub fn is_finite(&self) -> bool {
        let finite = |values: [f32; 2]| values.iter().all(|v| v.is_finite());
        self.direction.is_finite() && self.pieces.iter().all(|piece| finite(piece.ends) && finite(piece.values))
    }

    /// The place of a point along the direction.
    #[inline(always)]
    pub fn along(&self, p: Vec2) -> f32 {
        self.direction.dot(p)
    }

    /// The value at u, which lies between the outer knots.
    pub fn value(&self, u: f32) -> f32 {
        let holder = self.pieces.iter().find(|piece| u <= piece.ends[1]).or(self.pieces.last());
        holder.map_or(0.0, |piece| piece.at(u))
    }

    /// Mean from `start` to `end`, both between the outer knots, times a linear weight.
    pub fn mean(&self, start: f32, end: f32, weights: [f32; 2]) -> f32 {
        if (end - start).abs() < 1e-30 {
            return 0.5 * (weights[0] + weights[1]) * self.value(start);
        }
        let of_piece = |piece: &KnotPiece| {
            let part = clip_to_range([0.0, 1.0], start, end, piece.ends);
            if part[1] <= part[0] {
                return 0.0;
            }
            let values = part.map(|x| piece.at(blend(start, end, x)));
            let tilted = part.map(|x| blend(weights[0], weights[1], x));
            (part[1] - part[0]) * linear_product_mean(values, tilted)
        };
        self.pieces.iter().map(of_piece).sum()
    }

    /// Least and largest from `start` to `end`, both between the outer knots.
    pub fn range(&self, start: f32, end: f32) -> [f32; 2] {
        let (a, b) = (self.value(start), self.value(end));
        let [low, high] = [start.min(end), start.max(end)];
        let knots = self.pieces.iter().filter(|piece| piece.ends[1] > low && piece.ends[1] < high);
        knots.fold([a.min(b), a.max(b)], |[least, most], piece| [least.min(piece.values[1]), most.max(piece.values[1])])
    }

    /// Not exceeded from `low` to `high`.
    pub fn bound(&self, [low, high]: [f32; 2]) -> f32 {
        let [from, to] = [self.support[0].max(low - HAIR), self.support[1].min(high + HAIR)];
        if from > to { 0.0 } else { self.range(from, to)[1] }
    }
}

/// The mean of the product of two linear functions, by their values at the ends: Simpson's rule is exact.
fn linear_product_mean(f: [f32; 2], g: [f32; 2]) -> f32 {
    (f[0] * g[0] + f[1] * g[1]) / 3.0 + (f[0] * g[1] + f[1] * g[0]) / 6.0
}
