//! Uniform and Gaussian widgets without windows.

use glam::{Vec2, Vec4};

use crate::cpu::segment::{Medium, Seen};
use crate::cpu::widgets::gaussian::{Gaussian, gaussian_mean};
use crate::cpu::widgets::line::{clip_to_range, extremes};
use crate::cpu::widgets::optics::phi_one;

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

impl Medium for PlainWidgets {
    #[inline(always)]
    fn segment(&self, front: [f32; 2], back: [f32; 2], length: f32) -> Seen {
        let (front, back) = (Vec2::from(front), Vec2::from(back));
        let (mut depth, mut emission) = (0.0, Vec4::ZERO);
        for widget in &self.widgets {
            let d = widget.depth(front, back, length);
            depth += d;
            emission += d * widget.color;
        }
        let phi = phi_one(depth);
        (emission * phi).with_w(depth * phi)
    }
}

impl PlainWidget {
    /// The optical depth of a segment.
    #[inline]
    pub fn depth(&self, front: Vec2, back: Vec2, length: f32) -> f32 {
        let mut inside = [0.0, 1.0];
        if let Some(range) = self.scalar {
            inside = clip_to_range(inside, front.x, back.x, range);
        }
        if let Some(range) = self.gradient {
            inside = clip_to_range(inside, front.y, back.y, range);
        }
        let share = inside[1] - inside[0];
        if share <= 0.0 {
            return 0.0;
        }
        let mean = match &self.gaussian {
            None => 1.0,
            Some(g) => gaussian_mean(g.whitened(front.lerp(back, inside[0])), g.whitened(front.lerp(back, inside[1]))),
        };
        // Absurd extinctions stay finite.
        (self.extinction * length).min(1e25) * share * mean
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
