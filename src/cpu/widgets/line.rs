//! A ray in one cell, as transfer functions see it.

use glam::Vec2;

/// A straight line in the plane of (scalar, gradient magnitude), both normalised, and its length in mesh units.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// At the eye's side.
    pub front: Vec2,
    /// At the far side.
    pub back: Vec2,
    /// Mesh units.
    pub length: f32,
}

impl Line {
    /// At `x` from 0 (front) to 1, exact at both ends.
    pub fn at(&self, x: f32) -> Vec2 {
        Vec2::new(blend(self.front.x, self.back.x, x), blend(self.front.y, self.back.y, x))
    }
}

/// Between the ends, exact at both.
#[inline(always)]
pub fn blend(front: f32, back: f32, x: f32) -> f32 {
    let change = back - front;
    if x > 0.5 { back - (1.0 - x) * change } else { front + x * change }
}

/// The part of `within` (start, end; of 0..1) where `front + x (back - front)` lies in the range; empty where start > end.
pub fn clip_to_range(within: [f32; 2], front: f32, back: f32, [low, high]: [f32; 2]) -> [f32; 2] {
    let change = back - front;
    if change.abs() < 1e-30 {
        return if front >= low && front <= high { within } else { [1.0, 0.0] };
    }
    let (x_low, x_high) = ((low - front) / change, (high - front) / change);
    [within[0].max(x_low.min(x_high)), within[1].min(x_low.max(x_high))]
}

/// Least and largest.
pub fn extremes(values: [f32; 4]) -> [f32; 2] {
    let [a, b, c, d] = values;
    [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]
}
