//! A widget of any shape, with its ranges and its window, and the sum of such.

use glam::{Vec2, Vec4};

use crate::cpu::segment::{Medium, Seen};
use crate::cpu::widgets::knots::Knots;
use crate::cpu::widgets::line::{Line, blend, clip_to_range, extremes};
use crate::cpu::widgets::optics::phi_one;
use crate::cpu::widgets::plain::PlainWidget;
use crate::cpu::widgets::profile::Profile;

/// Any widget on normalised axes.
#[derive(Clone, Debug)]
pub struct AnyWidget {
    /// Colour, extinction and ranges; without a profile.
    pub plain: PlainWidget,
    /// The shape.
    pub profile: Profile,
    /// Multiplies the profile.
    pub window: Option<Knots>,
}

impl AnyWidget {
    /// The part of `within` (start, end) where the widget is; empty where start >= end.
    #[inline]
    pub fn active_part(&self, line: &Line, within: [f32; 2]) -> [f32; 2] {
        let mut part = within;
        if let Some(range) = self.plain.scalar {
            part = clip_to_range(part, line.front.x, line.back.x, range);
        }
        if let Some(range) = self.plain.gradient {
            part = clip_to_range(part, line.front.y, line.back.y, range);
        }
        if let Some(window) = &self.window {
            part = clip_to_range(part, window.along(line.front), window.along(line.back), window.support);
        }
        if let Profile::Ramp(knots) = &self.profile {
            part = clip_to_range(part, knots.along(line.front), knots.along(line.back), knots.support);
        }
        part
    }

    /// The optical depth over `part`, where all of it is the widget's ([`Self::active_part`]). Exact but for rounding.
    #[inline]
    pub fn part_depth(&self, line: &Line, part: [f32; 2]) -> f32 {
        let mean_share = match &self.window {
            Some(window) => self.windowed_share(window, line, part),
            None => (part[1] - part[0]) * self.profile.mean(line.at(part[0]), line.at(part[1]), [1.0, 1.0]),
        };
        // Absurd extinctions stay finite.
        (self.plain.extinction * line.length).min(1e25) * mean_share.max(0.0)
    }

    /// The integral of profile times window over `part`, a piece of the window at a time.
    fn windowed_share(&self, window: &Knots, line: &Line, part: [f32; 2]) -> f32 {
        let (u_front, u_back) = (window.along(line.front), window.along(line.back));
        let is_level = (u_back - u_front).abs() < 1e-30;
        let mut sum = 0.0;
        for piece in &window.pieces {
            let inner = clip_to_range(part, u_front, u_back, piece.ends);
            if inner[1] > inner[0] {
                let weights = inner.map(|x| piece.at(blend(u_front, u_back, x)));
                let mean = self.profile.mean(line.at(inner[0]), line.at(inner[1]), weights);
                sum += (inner[1] - inner[0]) * mean;
                // Where two pieces meet, a level segment lies in both.
                if is_level {
                    break;
                }
            }
        }
        sum
    }

    /// Profile times window at a point where the widget is.
    pub fn at(&self, p: Vec2) -> f32 {
        let weight = self.window.as_ref().map_or(1.0, |window| window.value(window.along(p)));
        weight * self.profile.at(p)
    }

    /// Least and largest profile times window from p to q, all of it where the widget is.
    pub fn range(&self, p: Vec2, q: Vec2) -> [f32; 2] {
        let [low, high] = self.profile.range(p, q);
        let window = self.window.as_ref().map_or([1.0; 2], |window| window.range(window.along(p), window.along(q)));
        [low * window[0], high * window[1]]
    }

    /// Extinction and emission between the corners do not exceed it.
    pub fn bound(&self, corners: [Vec2; 4]) -> f32 {
        let window = self.window.as_ref();
        let window = window.map_or(1.0, |w| w.bound(extremes(corners.map(|c| w.along(c)))));
        self.plain.bound(corners) * self.profile.bound(corners) * window
    }

    /// Gradient magnitudes matter.
    pub fn is_bivariate(&self) -> bool {
        let by_window = self.window.as_ref().is_some_and(|window| window.direction.y != 0.0);
        by_window || self.plain.is_bivariate() || self.profile.is_bivariate()
    }
}

/// A sum of widgets. Depths are exact and add; the colours are weighted by their depths, which is exact for one.
#[derive(Clone, Debug, Default)]
pub struct AnyWidgets {
    /// In no order.
    pub widgets: Vec<AnyWidget>,
}

impl Medium for AnyWidgets {
    #[inline]
    fn segment(&self, front: [f32; 2], back: [f32; 2], length: f32) -> Seen {
        let line = Line { front: front.into(), back: back.into(), length };
        let (mut depth, mut emission) = (0.0, Vec4::ZERO);
        for widget in &self.widgets {
            let part = widget.active_part(&line, [0.0, 1.0]);
            if part[1] > part[0] {
                let d = widget.part_depth(&line, part);
                depth += d;
                emission += d * widget.plain.color;
            }
        }
        let phi = phi_one(depth);
        (emission * phi).with_w(depth * phi)
    }
}
