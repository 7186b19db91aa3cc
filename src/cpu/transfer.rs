//! Transfer functions on normalised axes and mesh lengths, in f32.

use glam::Vec4;

use crate::cpu::curve::{CurveMedium, Piece};
use crate::cpu::preintegrated::PreIntegratedMedium;
use crate::cpu::segment::Medium as _;
use crate::cpu::widgets::{
    AdaptiveWidgets, AnyWidget, AnyWidgets, Axes, Classifier, Line, MOST_WIDGETS, PartialWidgets, PlainWidgets,
    PointMedium, PointRule, any_widgets, plain_widgets,
};
use crate::error::{Error, Result};
use crate::renderer::SegmentIntegral;
use crate::scene::{Curve, TransferFunction, Widget};
use crate::space::Interval;
use crate::tet::Axis;

/// A transfer function that segments can be integrated with.
#[derive(Clone, Debug)]
pub enum Compiled {
    Curve(CurveMedium),
    /// Uniform and Gaussian widgets of one colour, or of colours that are to be mixed evenly.
    Plain(PlainWidgets),
    /// The same of any widgets.
    Any(AnyWidgets),
    /// Any widgets of several colours.
    Adaptive(AdaptiveWidgets),
    /// Widgets, linear between special points.
    Partial(PartialWidgets),
    /// Anything, known at points.
    Points(PointMedium),
    /// A 1D function, from a table.
    PreIntegrated(PreIntegratedMedium),
}

impl Compiled {
    /// For an integral that is [`known`].
    ///
    /// # Errors
    /// A value that f32 cannot hold.
    pub fn new(transfer: &TransferFunction, integral: SegmentIntegral, axes: &Axes) -> Result<Self> {
        let rule = match integral {
            SegmentIntegral::VertexLinear => Some(PointRule::VertexLinear),
            SegmentIntegral::MeanScalar => Some(PointRule::MeanScalar),
            SegmentIntegral::Segmented { pieces } => Some(PointRule::Segmented { pieces }),
            _ => None,
        };
        let list = match transfer {
            TransferFunction::Curve(curve) => {
                let curve = compile_curve(curve, axes.scalar, axes.data_per_mesh)?;
                // Between its nodes a curve is linear: `partial` is its exact integral.
                return Ok(match (rule, integral) {
                    (Some(rule), _) => Self::Points(PointMedium { classifier: Classifier::Curve(curve), rule }),
                    (_, SegmentIntegral::PreIntegrated { size }) => {
                        Self::PreIntegrated(PreIntegratedMedium::new(curve, size))
                    }
                    _ => Self::Curve(curve),
                });
            }
            TransferFunction::Widgets(list) => list,
        };
        if let Some(rule) = rule {
            let classifier = Classifier::Widgets(any_widgets(list, axes)?);
            return Ok(Self::Points(PointMedium { classifier, rule }));
        }
        if matches!(integral, SegmentIntegral::Partial { .. } | SegmentIntegral::PartialDirect) {
            return Ok(Self::Partial(PartialWidgets { widgets: any_widgets(list, axes)? }));
        }
        if let SegmentIntegral::Adaptive { tolerance } = integral
            && !one_color(list)
        {
            let tolerance = tolerance as f32;
            return Ok(Self::Adaptive(AdaptiveWidgets { widgets: any_widgets(list, axes)?, tolerance }));
        }
        Ok(match plain_widgets(list, axes)? {
            Some(widgets) => Self::Plain(PlainWidgets { widgets }),
            None => Self::Any(AnyWidgets { widgets: any_widgets(list, axes)? }),
        })
    }

    /// Gradient magnitudes matter.
    pub fn is_bivariate(&self) -> bool {
        match self {
            Self::Curve(_) | Self::PreIntegrated(_) => false,
            Self::Points(medium) => medium.classifier.is_bivariate(),
            Self::Partial(sum) => sum.widgets.iter().any(AnyWidget::is_bivariate),
            Self::Plain(sum) => sum.widgets.iter().any(|w| w.is_bivariate()),
            Self::Any(sum) => sum.widgets.iter().any(AnyWidget::is_bivariate),
            Self::Adaptive(sum) => sum.widgets.iter().any(AnyWidget::is_bivariate),
        }
    }
}

/// What is seen of one segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integrated {
    /// Linear, premultiplied.
    pub color: [f32; 3],
    /// 1 - exp(-optical depth).
    pub opacity: f32,
    /// Pieces that the segment was cut into.
    pub pieces: u32,
}

/// One segment in a mesh whose fields span just the segment's values. Ends are (scalar, gradient magnitude), all in data
/// units. How the engine's arithmetic is checked, a segment at a time.
///
/// # Errors
/// What the engine does not integrate; a value that f32 cannot hold.
pub fn integrate(
    transfer: &TransferFunction,
    integral: SegmentIntegral,
    front: [f64; 2],
    back: [f64; 2],
    length: f64,
) -> Result<Integrated> {
    known(transfer, integral)?;
    let [scalar, gradient] = [0, 1].map(|i| Axis::of(Interval::of([front[i], back[i]])));
    // Mesh units in which the segment is within f32's range, whatever the data's are.
    let data_per_mesh = length.max(f64::MIN_POSITIVE);
    let [front, back] = [front, back].map(|[s, g]| [scalar.apply(s) as f32, gradient.apply(g) as f32]);
    let length = (length / data_per_mesh) as f32;
    let (seen, pieces) =
        match Compiled::new(transfer, integral, &Axes { scalar, gradient, data_per_mesh, range_hair: 0.0 })? {
            Compiled::Curve(medium) => (medium.segment(front, back, length), 1),
            Compiled::Plain(medium) => (medium.segment(front, back, length), 1),
            Compiled::Any(medium) => (medium.segment(front, back, length), 1),
            Compiled::Points(medium) => (medium.segment(front, back, length), 1),
            Compiled::PreIntegrated(medium) => (medium.segment(front, back, length), 1),
            Compiled::Partial(medium) => medium.pieces(&Line { front: front.into(), back: back.into(), length }),
            Compiled::Adaptive(medium) => medium.pieces(&Line { front: front.into(), back: back.into(), length }),
        };
    Ok(Integrated { color: seen.truncate().to_array(), opacity: seen.w, pieces })
}

/// Whether this engine has the integral, and integrates every part of the function by it.
///
/// # Errors
/// What it has not.
pub fn known(transfer: &TransferFunction, integral: SegmentIntegral) -> Result<()> {
    match (integral, transfer) {
        (SegmentIntegral::Adaptive { .. }, TransferFunction::Widgets(list))
            if list.len() > MOST_WIDGETS && !one_color(list) =>
        {
            Err(Error::Asked(format!(
                "{} widgets of several colours cannot be cast on the CPU to a tolerance, {MOST_WIDGETS} at most: use \
                 --integral analytic, or --device oracle",
                list.len()
            )))
        }
        (SegmentIntegral::PreIntegrated { .. }, TransferFunction::Widgets(_)) => Err(Error::Asked(
            "'preintegrated' holds functions of the scalar alone, and the transfer function has widgets: use \
             adaptive, or give the function as a curve"
                .into(),
        )),
        _ => Ok(()),
    }
}

/// Then closed forms are exact.
fn one_color(widgets: &[Widget]) -> bool {
    widgets.windows(2).all(|pair| pair[0].color == pair[1].color)
}

fn compile_curve(curve: &Curve, scalar: Axis, data_per_mesh: f64) -> Result<CurveMedium> {
    let mut nodes: Vec<(f64, [f64; 4])> = curve
        .nodes
        .iter()
        .map(|n| (scalar.apply(n.scalar), [n.color[0], n.color[1], n.color[2], n.extinction * data_per_mesh]))
        .collect();
    let ends = nodes.first().copied().zip(nodes.last().copied());
    let (first, last) = ends.unwrap_or(((0.0, [0.0; 4]), (0.0, [0.0; 4])));
    // Constant beyond the ends, and beyond every value.
    nodes.insert(0, (first.0.min(0.0) - 1.0, first.1));
    nodes.push((last.0.max(1.0) + 1.0, last.1));
    let mut pieces = Vec::with_capacity(nodes.len());
    for (index, pair) in nodes.windows(2).enumerate() {
        let ((from, low), (to, high)) = (pair[0], pair[1]);
        let slope: [f64; 4] = std::array::from_fn(|i| (high[i] - low[i]) / (to - from));
        let [start, slope] = [low, slope].map(|v| Vec4::from(v.map(|v| v as f32)));
        let piece = Piece { low: from as f32, high: to as f32, start, slope };
        // Nodes that f32 does not tell apart: a jump.
        if piece.low == piece.high {
            continue;
        }
        if !(start.is_finite() && slope.is_finite() && piece.low.is_finite() && piece.high.is_finite()) {
            return Err(Error::Asked(format!("curve: the nodes around piece {index} are beyond f32 on this mesh")));
        }
        pieces.push(piece);
    }
    Ok(CurveMedium { pieces })
}
