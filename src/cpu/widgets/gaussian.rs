//! Gaussian profiles and their means over a line.

use glam::Vec2;
use pulp::Simd;

use crate::cpu::lanes::Floats;
use crate::cpu::widgets::line::extremes;
use crate::cpu::widgets::optics::{attenuation, erfcx};

/// `exp(-|m (p - center)|^2)`.
#[derive(Clone, Copy, Debug)]
pub struct Gaussian {
    /// (scalar, gradient magnitude).
    pub center: Vec2,
    /// Rows of m.
    pub whiten: [Vec2; 2],
}

impl Gaussian {
    /// From the centre, in units of sqrt(2) standard deviations.
    #[inline(always)]
    pub fn whitened(&self, p: Vec2) -> Vec2 {
        let from_center = p - self.center;
        Vec2::new(self.whiten[0].dot(from_center), self.whiten[1].dot(from_center))
    }

    /// The same of all lanes.
    #[inline(always)]
    pub fn whitened_lanes<S: Simd>(&self, p: [Floats<S>; 2]) -> [Floats<S>; 2] {
        let from_center = [p[0] - p[0].all(self.center.x), p[1] - p[1].all(self.center.y)];
        self.whiten.map(|row| from_center[0].mul_add(p[0].all(row.x), from_center[1] * p[1].all(row.y)))
    }

    /// Its value.
    pub fn at(&self, p: Vec2) -> f32 {
        attenuation(self.whitened(p).length_squared())
    }

    /// Least and largest from `p` to `q`.
    pub fn range(&self, p: Vec2, q: Vec2) -> [f32; 2] {
        let (a, b) = (self.whitened(p), self.whitened(q));
        let step = b - a;
        let nearest = a + (-a.dot(step) / step.length_squared().max(1e-30)).clamp(0.0, 1.0) * step;
        let far = a.length_squared().max(b.length_squared());
        [attenuation(far), attenuation(nearest.length_squared().min(a.length_squared()))]
    }

    /// Not exceeded between the corners.
    pub fn bound(&self, corners: [Vec2; 4]) -> f32 {
        let whitened = corners.map(|c| self.whitened(c));
        let distance = |values: [f32; 4]| {
            let [low, high] = extremes(values);
            low.max(-high).max(0.0)
        };
        let (x, y) = (distance(whitened.map(|p| p.x)), distance(whitened.map(|p| p.y)));
        (-(x * x + y * y)).exp()
    }
}

/// Mean of `exp(-|p|^2)` over the segment between two whitened points, `|p| <= 1e15`. Absolute error 2.6e-7.
pub fn gaussian_mean(front: Vec2, back: Vec2) -> f32 {
    product_mean(front, back, [1.0, 1.0])
}

/// The same times a weight that runs linearly between the weights of the ends.
pub fn gaussian_product_mean(front: Vec2, back: Vec2, weights: [f32; 2]) -> f32 {
    product_mean(front, back, weights)
}

/// Never a difference of error functions: scaled complements share no leading digits. Inlined so that weights of one cost
/// nothing.
#[inline(always)]
fn product_mean(front: Vec2, back: Vec2, weights: [f32; 2]) -> f32 {
    let step = back - front;
    let extent = step.length();
    // A segment without extent may run any way.
    let along = if extent > 1e-18 { step / extent.max(1e-18) } else { Vec2::X };
    // From the end nearer to the centre: rounding is relative to its coordinates.
    let from_back = back.length_squared() < front.length_squared();
    let near_end = if from_back { -back } else { front };
    let [near_weight, far_weight] = if from_back { [weights[1], weights[0]] } else { weights };
    let tilt = far_weight - near_weight;
    let v_start = near_end.dot(along);
    let across = near_end.perp_dot(along);
    let q = across * across;
    let v_end = v_start + extent;
    if extent < 1.0 && extent * (v_start + v_end).abs() < 2.0 {
        return short_product_mean(v_start, extent, q, near_weight, tilt);
    }
    let (a, b) = (v_start.abs().min(v_end.abs()), v_start.abs().max(v_end.abs()));
    let (edge_a, edge_b) = (attenuation(a * a + q), attenuation(b * b + q));
    let (tail_a, tail_b) = (edge_a * erfcx(a), edge_b * erfcx(b));
    let same_side = v_start * v_end > 0.0;
    let area = if same_side { tail_a - tail_b } else { 2.0 * attenuation(q) - tail_a - tail_b };
    let mean = 0.886_226_95 * area / extent;
    if tilt == 0.0 {
        return near_weight * mean;
    }
    // |v_start| is a: the near end.
    near_weight * mean + tilt * (0.5 * (edge_a - edge_b) / extent - v_start * mean).max(0.0) / extent
}

/// Over `[v, v + extent]` at distance `sqrt(q)`, for short extents: 5-point Gauss-Legendre.
#[inline(always)]
fn short_product_mean(v: f32, extent: f32, q: f32, weight: f32, tilt: f32) -> f32 {
    const NODES: [(f32, f32); 5] = [
        (0.046_910_077, 0.118_463_44),
        (0.230_765_34, 0.239_314_34),
        (0.5, 0.284_444_45),
        (0.769_234_66, 0.239_314_34),
        (0.953_089_9, 0.118_463_44),
    ];
    let parts = NODES.map(|(x, share)| (x, share * attenuation((v + extent * x) * (v + extent * x) + q)));
    let mean: f32 = parts.iter().map(|(_, part)| part).sum();
    if tilt == 0.0 {
        return weight * mean;
    }
    weight * mean + tilt * parts.iter().map(|(x, part)| x * part).sum::<f32>()
}
