//! Transfer functions: extinction and colour over (scalar, gradient magnitude), in data units.

/// The profile of a widget over (scalar, gradient magnitude), 1 at its maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
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
}

/// One widget: extinction per unit length and colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widget {
    /// The profile.
    pub shape: WidgetShape,
    /// Linear RGB.
    pub color: [f64; 3],
    /// At the profile's maximum, 1 / data length, non-negative.
    pub extinction: f64,
    /// Zero outside this closed range of the scalar.
    pub scalar_range: Option<[f64; 2]>,
    /// Zero outside this closed range of the gradient magnitude.
    pub gradient_range: Option<[f64; 2]>,
}

/// A node of a 1D function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveNode {
    /// Position.
    pub scalar: f64,
    /// Linear RGB.
    pub color: [f64; 3],
    /// 1 / data length, non-negative.
    pub extinction: f64,
}

/// A 1D function of the scalar: colour and extinction each linear between the nodes and constant beyond the ends;
/// emission = colour x extinction.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// At least one; strictly increasing in `scalar`.
    pub nodes: Vec<CurveNode>,
}

/// A sum of widgets, or a 1D function.
#[derive(Clone, Debug, PartialEq)]
pub enum TransferFunction {
    /// Extinctions and emissions add.
    Widgets(Vec<Widget>),
    /// 1D.
    Curve(Curve),
}

impl WidgetShape {
    /// The profile at `(scalar, gradient)`: 1 at the maximum, never negative.
    pub fn profile(&self, scalar: f64, gradient: f64) -> f64 {
        match *self {
            Self::Uniform => 1.0,
            Self::Gaussian { center, sigma, angle } => {
                let (sin, cos) = angle.sin_cos();
                let (ds, dg) = (scalar - center[0], gradient - center[1]);
                let (p, q) = ((cos * ds + sin * dg) / sigma[0], (cos * dg - sin * ds) / sigma[1]);
                (-0.5 * (p * p + q * q)).exp()
            }
        }
    }
}

impl Widget {
    /// Extinction (1 / data length) at `(scalar, gradient)`; 0 outside the ranges, whose ends belong to them.
    pub fn extinction_at(&self, scalar: f64, gradient: f64) -> f64 {
        let inside = |range: Option<[f64; 2]>, v: f64| range.is_none_or(|[low, high]| low <= v && v <= high);
        if inside(self.scalar_range, scalar) && inside(self.gradient_range, gradient) {
            self.extinction * self.shape.profile(scalar, gradient)
        } else {
            0.0
        }
    }
}

impl Curve {
    /// Colour and extinction at `scalar`; transparent black for a curve without nodes.
    pub fn at(&self, scalar: f64) -> CurveNode {
        let above = self.nodes.partition_point(|node| node.scalar <= scalar);
        match (above.checked_sub(1).and_then(|i| self.nodes.get(i)), self.nodes.get(above)) {
            (Some(a), Some(b)) => {
                let weight = (scalar - a.scalar) / (b.scalar - a.scalar);
                let mix = |x: f64, y: f64| x + weight * (y - x);
                let color = std::array::from_fn(|c| mix(a.color[c], b.color[c]));
                CurveNode { scalar, color, extinction: mix(a.extinction, b.extinction) }
            }
            (Some(&end), None) | (None, Some(&end)) => CurveNode { scalar, ..end },
            (None, None) => CurveNode { scalar, color: [0.0; 3], extinction: 0.0 },
        }
    }
}

impl TransferFunction {
    /// Extinction and emission (colour x extinction, linear RGB), both 1 / data length, at `(scalar, gradient)`.
    pub fn extinction_and_emission(&self, scalar: f64, gradient: f64) -> (f64, [f64; 3]) {
        match self {
            Self::Widgets(widgets) => widgets.iter().fold((0.0, [0.0; 3]), |(sum, emission), widget| {
                let extinction = widget.extinction_at(scalar, gradient);
                (sum + extinction, std::array::from_fn(|c| emission[c] + extinction * widget.color[c]))
            }),
            Self::Curve(curve) => {
                let node = curve.at(scalar);
                (node.extinction, node.color.map(|c| c * node.extinction))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve() -> Curve {
        let node = |scalar, red, extinction| CurveNode { scalar, color: [red, 0.0, 1.0], extinction };
        Curve { nodes: vec![node(1.0, 0.0, 2.0), node(3.0, 1.0, 6.0)] }
    }

    #[test]
    fn a_curve_is_linear_between_its_nodes_and_constant_beyond() {
        assert_eq!(curve().at(2.0), CurveNode { scalar: 2.0, color: [0.5, 0.0, 1.0], extinction: 4.0 });
        assert_eq!(curve().at(-9.0).extinction, 2.0);
        assert_eq!(curve().at(1.0).extinction, 2.0);
        assert_eq!(curve().at(3.0).extinction, 6.0);
        assert_eq!(curve().at(9.0).color, [1.0, 0.0, 1.0]);
        assert_eq!(Curve { nodes: vec![] }.at(0.0).extinction, 0.0);
    }

    #[test]
    fn emission_is_colour_times_extinction() {
        let (extinction, emission) = TransferFunction::Curve(curve()).extinction_and_emission(2.0, 7.0);
        assert_eq!((extinction, emission), (4.0, [2.0, 0.0, 4.0]));
    }

    #[test]
    fn widgets_add_inside_their_closed_ranges() {
        let uniform = Widget {
            shape: WidgetShape::Uniform,
            color: [1.0, 0.5, 0.0],
            extinction: 2.0,
            scalar_range: Some([0.0, 1.0]),
            gradient_range: None,
        };
        let shape = WidgetShape::Gaussian { center: [1.0, 0.0], sigma: [0.5, 2.0], angle: 0.0 };
        let gaussian = Widget { shape, color: [0.0, 0.0, 1.0], scalar_range: None, ..uniform };
        let sum = TransferFunction::Widgets(vec![uniform, gaussian]);
        assert_eq!(sum.extinction_and_emission(1.0, 0.0), (4.0, [2.0, 1.0, 2.0]));
        let (extinction, _) = sum.extinction_and_emission(1.5, 0.0);
        assert!((extinction - 2.0 * (-0.5f64).exp()).abs() < 1e-15, "one sigma away, outside the box: {extinction}");
    }

    #[test]
    fn an_angle_turns_counter_clockwise() {
        let angle = std::f64::consts::FRAC_PI_2;
        let shape = WidgetShape::Gaussian { center: [0.0, 0.0], sigma: [1.0, 10.0], angle };
        assert!(shape.profile(0.0, 3.0) < 0.02, "the narrow axis lies along the gradient");
        assert!(shape.profile(3.0, 0.0) > 0.9, "the wide axis lies along the scalar");
    }
}
