//! Transfer functions: extinction and colour over (scalar, gradient magnitude), in data units.

use super::optics::EmissionModel;
use super::shape::WidgetShape;
use super::widget::Widget;

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

/// A 1D function of the scalar: colour and extinction each linear between the nodes and constant beyond the ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// At least one; strictly increasing in `scalar`.
    pub nodes: Vec<CurveNode>,
}

/// A sum of widgets, or a 1D function.
#[derive(Clone, Debug, PartialEq)]
pub enum TransferFunction {
    /// Extinctions and emissions add. With unweighted emission each widget emits its colour all over its support
    /// ([`Widget::supports`]).
    Widgets(Vec<Widget>),
    /// 1D. With unweighted emission: its colour wherever its extinction is above 0.
    Curve(Curve),
}

impl TransferFunction {
    /// Shows nothing.
    pub fn nothing() -> Self {
        Self::Widgets(vec![Widget::new(WidgetShape::Uniform, [0.0; 3], 0.0)])
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

/// What a transfer function says of one point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Terms {
    /// 1 / data length.
    pub extinction: f64,
    /// Linear RGB, 1 / data length.
    pub emission: [f64; 3],
    /// What [`Self::emission`] would be if every colour were white; highlights are weighted by it.
    pub white: f64,
}

impl Terms {
    fn add(&mut self, extinction: f64, color: [f64; 3], weight: f64) {
        self.extinction += extinction;
        self.white += weight;
        self.emission = std::array::from_fn(|c| self.emission[c] + weight * color[c]);
    }
}

impl TransferFunction {
    /// Extinction and emission at `(scalar, gradient)`.
    pub fn terms(&self, model: EmissionModel, scalar: f64, gradient: f64) -> Terms {
        let mut terms = Terms::default();
        let unit = |emits: bool| f64::from(u8::from(emits));
        match self {
            Self::Widgets(widgets) => {
                for widget in widgets {
                    let extinction = widget.extinction_at(scalar, gradient);
                    let weight = match model {
                        EmissionModel::Weighted => extinction,
                        EmissionModel::Unweighted => unit(widget.supports(scalar, gradient)),
                    };
                    terms.add(extinction, widget.color, weight);
                }
            }
            Self::Curve(curve) => {
                let node = curve.at(scalar);
                let weight = match model {
                    EmissionModel::Weighted => node.extinction,
                    EmissionModel::Unweighted => unit(node.extinction > 0.0),
                };
                terms.add(node.extinction, node.color, weight);
            }
        }
        terms
    }

    /// Extinction and weighted emission (colour x extinction, linear RGB), both 1 / data length, at
    /// `(scalar, gradient)`.
    pub fn extinction_and_emission(&self, scalar: f64, gradient: f64) -> (f64, [f64; 3]) {
        let terms = self.terms(EmissionModel::Weighted, scalar, gradient);
        (terms.extinction, terms.emission)
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
    fn unweighted_emission_of_a_curve_is_its_colour_where_it_absorbs() {
        let node = |scalar, extinction| CurveNode { scalar, color: [0.5, 0.25, 1.0], extinction };
        let curve = TransferFunction::Curve(Curve { nodes: vec![node(0.0, 0.0), node(1.0, 0.0), node(2.0, 8.0)] });
        let at = |scalar| curve.terms(EmissionModel::Unweighted, scalar, 0.0);
        assert_eq!(at(0.5), Terms::default(), "nothing glows where nothing absorbs");
        assert_eq!(at(1.25), Terms { extinction: 2.0, emission: [0.5, 0.25, 1.0], white: 1.0 });
        assert_eq!(at(9.0).white, 1.0);
    }
}
