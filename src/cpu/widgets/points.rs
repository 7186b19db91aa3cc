//! Integrals that know a function at points only. Twins of `shaders/shared/points.wgsl`.

use glam::{Vec2, Vec4};

use crate::cpu::curve::CurveMedium;
use crate::cpu::segment::{Medium, Seen};
use crate::cpu::widgets::any::AnyWidget;
use crate::cpu::widgets::line::Line;
use crate::cpu::widgets::optics::{attenuation, emission_weights, phi_one};

/// What a point is: emission (colour times extinction), and extinction in w, both per mesh length.
#[derive(Clone, Debug)]
pub enum Classifier {
    /// Of the scalar alone.
    Curve(CurveMedium),
    /// A sum.
    Widgets(Vec<AnyWidget>),
}

/// How points make a segment.
#[derive(Clone, Copy, Debug)]
pub enum PointRule {
    /// Mean extinction and colour of both ends (Shirley & Tuchman 1990).
    VertexLinear,
    /// Both at the mean of the ends.
    MeanScalar,
    /// Pieces of equal length, extinction and emission linear in each (Song et al. 2009, section 5).
    Segmented {
        /// At least 1.
        pieces: u32,
    },
}

/// A function by such a rule.
#[derive(Clone, Debug)]
pub struct PointMedium {
    /// The function.
    pub classifier: Classifier,
    /// The rule.
    pub rule: PointRule,
}

impl Classifier {
    /// Emission and extinction at a point.
    fn at(&self, p: Vec2) -> Vec4 {
        match self {
            Self::Curve(curve) => {
                let value = curve.at(p.x);
                (value * value.w).with_w(value.w)
            }
            Self::Widgets(widgets) => {
                // A line without extent is in a widget or is not.
                let line = Line { front: p, back: p, length: 1.0 };
                let holds = |w: &&AnyWidget| {
                    let part = w.active_part(&line, [0.0, 1.0]);
                    part[1] > part[0]
                };
                let value = |w: &AnyWidget| w.plain.extinction.min(1e25) * w.at(p) * w.plain.color.with_w(1.0);
                widgets.iter().filter(holds).map(value).sum()
            }
        }
    }

    /// Gradient magnitudes matter.
    pub fn is_bivariate(&self) -> bool {
        match self {
            Self::Curve(_) => false,
            Self::Widgets(widgets) => widgets.iter().any(AnyWidget::is_bivariate),
        }
    }
}

/// Emission over extinction; the other's where nothing absorbs.
pub fn color_of(point: Vec4, other: Vec4) -> Vec4 {
    let of = |v: Vec4| (v / v.w.max(1e-30)).with_w(0.0);
    if point.w > 1e-30 { of(point) } else { of(other) }
}

impl Medium for PointMedium {
    fn segment(&self, front: [f32; 2], back: [f32; 2], length: f32) -> Seen {
        let line = Line { front: front.into(), back: back.into(), length };
        // Over a length, finite.
        let at = |x: f32, length: f32| (self.classifier.at(line.at(x)) * length).min(Vec4::splat(1e25));
        match self.rule {
            PointRule::VertexLinear => {
                let (front, back) = (at(0.0, length), at(1.0, length));
                let depth = 0.5 * (front.w + back.w);
                let color = 0.5 * (color_of(front, back) + color_of(back, front));
                let opacity = depth * phi_one(depth);
                (color * opacity).with_w(opacity)
            }
            PointRule::MeanScalar => {
                let middle = at(0.5, length);
                middle * phi_one(middle.w)
            }
            PointRule::Segmented { pieces } => {
                let length = length / pieces as f32;
                let (mut color, mut seen) = (Vec4::ZERO, 1.0);
                let mut front = at(0.0, length);
                for i in 1..=pieces {
                    let back = at(i as f32 / pieces as f32, length);
                    let [front_share, back_share] = emission_weights(front.w, back.w);
                    color += seen * (front_share * front + back_share * back);
                    seen *= attenuation(0.5 * (front.w + back.w));
                    front = back;
                    if seen < 1e-7 {
                        break;
                    }
                }
                color.with_w(1.0 - seen)
            }
        }
    }
}
