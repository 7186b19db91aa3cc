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
