//! Uniform and Gaussian widgets without windows.

use glam::{Vec2, Vec4};
use pulp::Simd;

use crate::cpu::lanes::Floats;
use crate::cpu::segment::{LaneMedium, Medium, Seen, SeenLanes, Segments};
use crate::cpu::widgets::gaussian::{Gaussian, gaussian_mean};
use crate::cpu::widgets::lane_optics;
use crate::cpu::widgets::line::extremes;

/// A widget on normalised axes.
#[derive(Clone, Copy, Debug)]
pub struct PlainWidget {
    /// Linear RGB.
    pub color: Vec4,
    /// 1 / mesh length.
    pub extinction: f32,
    /// None for a uniform profile.
    pub gaussian: Option<Gaussian>,
    /// Closed range of the scalar.
    pub scalar: Option<[f32; 2]>,
    /// Closed range of the gradient magnitude.
    pub gradient: Option<[f32; 2]>,
}

/// A sum of widgets. Depths are exact and add; the colours are weighted by their depths.
#[derive(Clone, Debug, Default)]
pub struct PlainWidgets {
    /// In no order.
    pub widgets: Vec<PlainWidget>,
}

impl LaneMedium for PlainWidgets {
    type Kept<S: Simd> = ();

    fn kept<S: Simd>(&self, _: S) {}

    #[inline(always)]
    fn segments<S: Simd>(&self, (): &mut (), segments: &Segments<S>) -> SeenLanes<S> {
        let zero = segments.length.all(0.0);
        let (mut depth, mut emission) = (zero, [zero; 3]);
        for widget in &self.widgets {
            let d = widget.depths(segments);
            depth = depth + d;
            for (sum, color) in emission.iter_mut().zip(widget.color.to_array()) {
                *sum = d.mul_add(zero.all(color), *sum);
            }
        }
        let phi = lane_optics::phi_one(depth);
        SeenLanes { color: [emission[0] * phi, emission[1] * phi, emission[2] * phi], opacity: depth * phi }
    }
}

impl Medium for PlainWidgets {
    fn segment(&self, front: [f32; 2], back: [f32; 2], length: f32) -> Seen {
        self.segments(&mut (), &Segments::one(front, back, length)).one()
    }
}

/// The parts of `within` where a line lies in the range, all lanes': see
/// [`clip_to_range`](super::line::clip_to_range).
#[inline(always)]
fn clip_lanes<S: Simd>(
    within: [Floats<S>; 2],
    front: Floats<S>,
    back: Floats<S>,
    [low, high]: [f32; 2],
) -> [Floats<S>; 2] {
    let (low, high, change) = (front.all(low), front.all(high), back - front);
    let [zero, one] = [0.0, 1.0].map(|value| front.all(value));
    let (x_low, x_high) = ((low - front).over(change), (high - front).over(change));
    let crossing = [within[0].max(x_low.min(x_high)), within[1].min(x_low.max(x_high))];
    let is_level = front.all(1e-30).above(change.abs());
    let outside = low.above(front) | front.above(high);
    let level = [outside.floats(one, within[0]), outside.floats(zero, within[1])];
    [is_level.floats(level[0], crossing[0]), is_level.floats(level[1], crossing[1])]
}

impl PlainWidget {
    /// The optical depths of all lanes' segments.
    #[inline(always)]
    fn depths<S: Simd>(&self, segments: &Segments<S>) -> Floats<S> {
        let Segments { which, front, back, length, .. } = *segments;
        let [zero, one] = [0.0, 1.0].map(|value| length.all(value));
        let mut inside = [zero, one];
        if let Some(range) = self.scalar {
            inside = clip_lanes(inside, front[0], back[0], range);
        }
        if let Some(range) = self.gradient {
            inside = clip_lanes(inside, front[1], back[1], range);
        }
        let share = inside[1] - inside[0];
        let is_seen = which & share.above(zero);
        let mean = match &self.gaussian {
            None => one,
            Some(gaussian) => {
                let at = |i: usize, x: Floats<S>| (back[i] - front[i]).mul_add(x, front[i]);
                let whitened = |x| gaussian.whitened_lanes([at(0, x), at(1, x)]);
                let (front, back) = (whitened(inside[0]), whitened(inside[1]));
                let (mut means, is_short) = lane_optics::short_gaussian_means(front, back);
                let is_long = is_seen & !is_short;
                if is_long.any() {
                    for lane in is_long.lanes() {
                        let ends = [front, back].map(|p| Vec2::new(p[0].values()[lane], p[1].values()[lane]));
                        means.values_mut()[lane] = gaussian_mean(ends[0], ends[1]);
                    }
                }
                means
            }
        };
        // Absurd extinctions stay finite.
        let most = (length * one.all(self.extinction)).min(one.all(1e25));
        is_seen.floats(most * share * mean, zero)
    }

    /// Extinction and emission between the corners do not exceed it.
    pub fn bound(&self, corners: [Vec2; 4]) -> f32 {
        let beyond = |range: Option<[f32; 2]>, values: [f32; 4]| {
            let [low, high] = extremes(values);
            range.is_some_and(|[from, to]| high < from || low > to)
        };
        if beyond(self.scalar, corners.map(|c| c.x)) || beyond(self.gradient, corners.map(|c| c.y)) {
            return 0.0;
        }
        let peak = self.gaussian.map_or(1.0, |gaussian| gaussian.bound(corners));
        self.extinction * self.color.max_element().max(1.0) * peak
    }

    /// Gradient magnitudes matter.
    pub fn is_bivariate(&self) -> bool {
        self.gradient.is_some() || self.gaussian.is_some_and(|g| g.whiten.iter().any(|row| row.y != 0.0))
    }
}
