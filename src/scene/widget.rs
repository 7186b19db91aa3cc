//! A widget: a shape, clipped and weighted, with extinction and colour.

use super::shape::{WidgetShape, Window};

/// One widget: extinction per unit length and colour over (scalar, gradient magnitude).
#[derive(Clone, Debug, PartialEq)]
pub struct Widget {
    /// The profile.
    pub shape: WidgetShape,
    /// Linear RGB.
    pub color: [f64; 3],
    /// Where profile and window are 1, 1 / data length, non-negative.
    pub extinction: f64,
    /// Zero outside this closed range of the scalar.
    pub scalar_range: Option<[f64; 2]>,
    /// Zero outside this closed range of the gradient magnitude.
    pub gradient_range: Option<[f64; 2]>,
    /// Multiplies the profile.
    pub window: Option<Window>,
}

impl Widget {
    /// Without ranges and window.
    pub fn new(shape: WidgetShape, color: [f64; 3], extinction: f64) -> Self {
        Self { shape, color, extinction, scalar_range: None, gradient_range: None, window: None }
    }

    /// Extinction (1 / data length) at `(scalar, gradient)`; 0 outside the ranges, whose ends belong to them.
    pub fn extinction_at(&self, scalar: f64, gradient: f64) -> f64 {
        if !self.in_ranges(scalar, gradient) {
            return 0.0;
        }
        let weight = self.window.as_ref().map_or(Some(1.0), |window| window.weight(scalar, gradient));
        weight.map_or(0.0, |weight| self.extinction * weight * self.shape.profile(scalar, gradient))
    }

    /// Whether `(scalar, gradient)` belongs to the widget's support: inside both ranges, inside the window's knots and
    /// in the shape's own support ([`WidgetShape::supports`]). Whatever the extinction is, and the window's weight.
    pub fn supports(&self, scalar: f64, gradient: f64) -> bool {
        self.in_ranges(scalar, gradient)
            && self.window.as_ref().is_none_or(|window| window.weight(scalar, gradient).is_some())
            && self.shape.supports(scalar, gradient)
    }

    fn in_ranges(&self, scalar: f64, gradient: f64) -> bool {
        let inside = |range: Option<[f64; 2]>, v: f64| range.is_none_or(|[low, high]| low <= v && v <= high);
        inside(self.scalar_range, scalar) && inside(self.gradient_range, gradient)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{EmissionModel, TransferFunction};

    fn pair() -> TransferFunction {
        let uniform =
            Widget { scalar_range: Some([0.0, 1.0]), ..Widget::new(WidgetShape::Uniform, [1.0, 0.5, 0.0], 2.0) };
        let shape = WidgetShape::Gaussian { center: [1.0, 0.0], sigma: [0.5, 2.0], angle: 0.0 };
        TransferFunction::Widgets(vec![uniform, Widget::new(shape, [0.0, 0.0, 1.0], 2.0)])
    }

    #[test]
    fn widgets_add_inside_their_closed_ranges() {
        assert_eq!(pair().extinction_and_emission(1.0, 0.0), (4.0, [2.0, 1.0, 2.0]));
        let (extinction, _) = pair().extinction_and_emission(1.5, 0.0);
        assert!((extinction - 2.0 * (-0.5f64).exp()).abs() < 1e-15, "one sigma away, outside the box: {extinction}");
    }

    #[test]
    fn unweighted_emission_is_the_sum_of_colours_over_the_supports() {
        let at = |scalar| pair().terms(EmissionModel::Unweighted, scalar, 0.0);
        assert_eq!((at(0.5).emission, at(0.5).white), ([1.0, 0.5, 1.0], 2.0));
        assert_eq!((at(1.5).emission, at(1.5).white), ([0.0, 0.0, 1.0], 1.0));
        assert_eq!(at(0.5).extinction, pair().extinction_and_emission(0.5, 0.0).0);
    }

    #[test]
    fn a_window_multiplies_and_bounds_the_support() {
        let window = Some(Window { direction: [0.0, 1.0], knots: vec![[0.0, 0.0], [2.0, 1.0]] });
        let widget = Widget { window, ..Widget::new(WidgetShape::Uniform, [1.0; 3], 8.0) };
        assert_eq!([-0.1, 0.0, 0.5, 2.0, 2.1].map(|g| widget.extinction_at(5.0, g)), [0.0, 0.0, 2.0, 8.0, 0.0]);
        assert_eq!([-0.1, 0.0, 0.5, 2.0, 2.1].map(|g| widget.supports(5.0, g)), [false, true, true, true, false]);
    }
}
