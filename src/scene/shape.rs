//! The profiles that widgets are made of, each a function of (scalar, gradient magnitude) between 0 and 1.
//!
//! They are given by their definitions, for f64. A phase is `p = (direction . (s, g) - offset) / period`, and
//! `frac p = p - floor p`. Song et al. 2009, section 4, allow one peak a cell; here any number of them is meant.

use std::f64::consts::{PI, TAU};

/// The profile of a widget over (scalar, gradient magnitude).
#[derive(Clone, Debug, PartialEq)]
pub enum WidgetShape {
    /// 1 everywhere inside the ranges.
    Uniform,
    /// `exp(-(xi^2 / (2 sigma_s^2) + eta^2 / (2 sigma_g^2)))`, `xi = cos ds + sin dg`, `eta = -sin ds + cos dg`,
    /// `(ds, dg)` the distance from the centre.
    Gaussian {
        /// (scalar, gradient magnitude).
        center: [f64; 2],
        /// Standard deviations along the rotated axes, positive.
        sigma: [f64; 2],
        /// Counter-clockwise in the (s, g) plane, radians.
        angle: f64,
    },
    /// Peaks of equal distance: `max(0, 1 - |2 frac p - 1| / duty)`, 1 at `p = n + 1/2`. With a duty of 1 a triangle
    /// wave, 0 at whole `p`; below, isolated tents that fill this part of every period.
    Triangle {
        /// Not zero; of any length.
        direction: [f64; 2],
        /// Where a period begins, along `direction`.
        offset: f64,
        /// Positive, in units of `direction . (s, g)`.
        period: f64,
        /// In (0, 1].
        duty: f64,
    },
    /// A wave without corners, or with corners only where it is 0: see [`SinusoidVariant`].
    Sinusoid {
        /// Not zero; of any length.
        direction: [f64; 2],
        /// Where a period begins, along `direction`.
        offset: f64,
        /// Positive, in units of `direction . (s, g)`.
        period: f64,
        /// Which wave.
        variant: SinusoidVariant,
    },
    /// Linear in `u = direction . (s, g)` between the knots, 0 outside them.
    Ramp {
        /// Not zero; of any length.
        direction: [f64; 2],
        /// `[u, weight]`, at least two; `u` strictly increasing, weights not negative.
        knots: Vec<[f64; 2]>,
    },
}

/// Ways to make an extinction, which is never negative, of a sine. All are 0 at whole phases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SinusoidVariant {
    /// `(1 - cos 2 pi p) / 2`: smooth everywhere, one peak a period.
    #[default]
    Cos,
    /// `|sin pi p|`: one arch a period, with a corner between arches.
    Arch,
    /// `max(0, sin 2 pi p)`: an arch in the first half of every period, nothing in the second.
    Half,
}

/// A factor on a widget's profile: linear in `u = direction . (s, g)` between the knots, 0 outside them.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// Not zero; of any length.
    pub direction: [f64; 2],
    /// `[u, weight]`, at least two; `u` strictly increasing, weights not negative.
    pub knots: Vec<[f64; 2]>,
}

impl Window {
    /// The factor at `(scalar, gradient)`; `None` outside the knots.
    pub fn weight(&self, scalar: f64, gradient: f64) -> Option<f64> {
        piecewise(&self.knots, along(self.direction, scalar, gradient))
    }
}

impl WidgetShape {
    /// The profile at `(scalar, gradient)`: never negative; 1 at the maximum, but for ramps, whose knots say.
    pub fn profile(&self, scalar: f64, gradient: f64) -> f64 {
        match self {
            Self::Uniform => 1.0,
            Self::Gaussian { center, sigma, angle } => {
                let (sin, cos) = angle.sin_cos();
                let (ds, dg) = (scalar - center[0], gradient - center[1]);
                let (p, q) = ((cos * ds + sin * dg) / sigma[0], (cos * dg - sin * ds) / sigma[1]);
                (-0.5 * (p * p + q * q)).exp()
            }
            &Self::Triangle { direction, offset, period, duty } => {
                let part = fraction((along(direction, scalar, gradient) - offset) / period);
                (1.0 - (2.0 * part - 1.0).abs() / duty).max(0.0)
            }
            &Self::Sinusoid { direction, offset, period, variant } => {
                let part = fraction((along(direction, scalar, gradient) - offset) / period);
                match variant {
                    // (1 - cos 2x) / 2 without the loss of digits near 0.
                    SinusoidVariant::Cos => (PI * part).sin().powi(2),
                    SinusoidVariant::Arch => (PI * part).sin().abs(),
                    SinusoidVariant::Half => (TAU * part).sin().max(0.0),
                }
            }
            Self::Ramp { direction, knots } => {
                piecewise(knots, along(*direction, scalar, gradient)).unwrap_or_default()
            }
        }
    }

    /// Whether `(scalar, gradient)` belongs to the shape's support, over which it emits by the unweighted model: inside
    /// a ramp's knots, where tents of a duty below 1 and the half sine are above 0, and everywhere for the others,
    /// whose zeros have no width.
    pub fn supports(&self, scalar: f64, gradient: f64) -> bool {
        match self {
            Self::Triangle { duty, .. } if *duty < 1.0 => self.profile(scalar, gradient) > 0.0,
            Self::Sinusoid { variant: SinusoidVariant::Half, .. } => self.profile(scalar, gradient) > 0.0,
            Self::Ramp { direction, knots } => piecewise(knots, along(*direction, scalar, gradient)).is_some(),
            _ => true,
        }
    }
}

fn along(direction: [f64; 2], scalar: f64, gradient: f64) -> f64 {
    direction[0] * scalar + direction[1] * gradient
}

fn fraction(phase: f64) -> f64 {
    phase - phase.floor()
}

/// Linear between `[u, weight]` knots of increasing `u`; `None` outside them.
fn piecewise(knots: &[[f64; 2]], u: f64) -> Option<f64> {
    let above = knots.partition_point(|knot| knot[0] <= u);
    let &[from, low] = knots.get(above.checked_sub(1)?)?;
    match knots.get(above) {
        Some(&[to, high]) => Some(low + (high - low) * ((u - from) / (to - from))),
        None => (u == from).then_some(low),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_turns_counter_clockwise() {
        let angle = std::f64::consts::FRAC_PI_2;
        let shape = WidgetShape::Gaussian { center: [0.0, 0.0], sigma: [1.0, 10.0], angle };
        assert!(shape.profile(0.0, 3.0) < 0.02, "the narrow axis lies along the gradient");
        assert!(shape.profile(3.0, 0.0) > 0.9, "the wide axis lies along the scalar");
    }

    #[test]
    fn triangles_peak_between_whole_phases() {
        let wave = |duty| WidgetShape::Triangle { direction: [2.0, 1.0], offset: 1.0, period: 4.0, duty };
        // Phase 0, 1/4, 1/2, 3/4, 1 and -1/2 along the scalar.
        let at = |duty, phase: f64| wave(duty).profile(0.5 * (1.0 + 4.0 * phase), 0.0);
        assert_eq!([0.0, 0.25, 0.5, 0.75, 1.0, -0.5].map(|p| at(1.0, p)), [0.0, 0.5, 1.0, 0.5, 0.0, 1.0]);
        assert_eq!([0.0, 0.25, 0.375, 0.5, 0.75].map(|p| at(0.5, p)), [0.0, 0.0, 0.5, 1.0, 0.0]);
        assert_eq!(wave(1.0).profile(0.0, 3.0), 1.0, "the gradient counts by its own component");
        assert!(wave(1.0).supports(0.5, 0.0), "a zero without width is inside");
        assert!(!wave(0.5).supports(0.5, 0.0) && wave(0.5).supports(1.5, 0.0));
    }

    #[test]
    fn sinusoids_begin_at_whole_phases() {
        let wave = |variant| WidgetShape::Sinusoid { direction: [0.0, 1.0], offset: -1.0, period: 2.0, variant };
        let at = |variant, phase: f64| wave(variant).profile(9.0, 2.0 * phase - 1.0);
        let close = |got: [f64; 5], want: [f64; 5]| (0..5).all(|i| (got[i] - want[i]).abs() < 1e-15);
        let phases = [0.0, 1.0 / 6.0, 0.25, 0.5, 0.75];
        assert!(close(phases.map(|p| at(SinusoidVariant::Cos, p)), [0.0, 0.25, 0.5, 1.0, 0.5]));
        let root = 0.5f64.sqrt();
        assert!(close(phases.map(|p| at(SinusoidVariant::Arch, p)), [0.0, 0.5, root, 1.0, root]));
        assert!(close(phases.map(|p| at(SinusoidVariant::Half, p)), [0.0, 0.75f64.sqrt(), 1.0, 0.0, 0.0]));
        assert!(wave(SinusoidVariant::Half).supports(0.0, -0.5) && !wave(SinusoidVariant::Half).supports(0.0, 0.5));
        assert!(wave(SinusoidVariant::Cos).supports(0.0, -1.0));
    }

    #[test]
    fn ramps_and_windows_end_at_their_outer_knots() {
        let knots = vec![[1.0, 0.5], [2.0, 1.0], [4.0, 0.0]];
        let shape = WidgetShape::Ramp { direction: [0.5, 0.0], knots: knots.clone() };
        let window = Window { direction: [0.5, 0.0], knots };
        for (u, want) in [(0.99, None), (1.0, Some(0.5)), (1.5, Some(0.75)), (3.0, Some(0.5)), (4.0, Some(0.0))] {
            assert_eq!(window.weight(2.0 * u, 7.0), want, "{u}");
            assert_eq!(shape.profile(2.0 * u, 7.0), want.unwrap_or(0.0), "{u}");
            assert_eq!(shape.supports(2.0 * u, 7.0), want.is_some(), "{u}");
        }
        assert_eq!(window.weight(8.001, 0.0), None);
        assert_eq!(window.weight(f64::NAN, 0.0), None);
        assert_eq!(Window { direction: [1.0, 0.0], knots: vec![] }.weight(0.0, 0.0), None);
    }
}
