//! Where along a segment a transfer function has steps, kinks or narrow peaks.

use std::borrow::Cow;

use crate::scene::{Curve, TransferFunction, Widget, WidgetShape};

/// Periods of a wave along one segment that are told apart.
const MOST_PERIODS: f64 = 65_536.0;

/// Distances from a Gaussian's peak, in standard deviations along the segment, where panels end: the first keep a peak
/// of any width from falling between quadrature nodes, the last serve large extinctions, whose far tails are opaque.
const GAUSSIAN_CUTS: [f64; 6] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0];

/// Positions in (0, 1), increasing, along `front + x * slope` in the (scalar, gradient magnitude) plane.
pub fn cuts(transfer: &TransferFunction, front: [f64; 2], slope: [f64; 2]) -> Vec<f64> {
    let mut cuts = Vec::new();
    let mut add = |x: f64| {
        if x > 0.0 && x < 1.0 {
            cuts.push(x);
        }
    };
    match transfer {
        TransferFunction::Curve(curve) => curve_cuts(curve, front[0], slope[0], &mut add),
        TransferFunction::Widgets(widgets) => widgets.iter().for_each(|w| widget_cuts(w, front, slope, &mut add)),
    }
    cuts.sort_unstable_by(f64::total_cmp);
    cuts
}

/// The nodes that the segment crosses.
fn curve_cuts(curve: &Curve, front: f64, slope: f64, add: &mut impl FnMut(f64)) {
    let (low, high) = (front.min(front + slope), front.max(front + slope));
    let first = curve.nodes.partition_point(|node| node.scalar < low);
    for node in curve.nodes[first..].iter().take_while(|node| node.scalar <= high) {
        add((node.scalar - front) / slope);
    }
}

/// The ends of the ranges, the window's knots, and what the shape has.
fn widget_cuts(widget: &Widget, front: [f64; 2], slope: [f64; 2], add: &mut impl FnMut(f64)) {
    for (axis, range) in [widget.scalar_range, widget.gradient_range].into_iter().enumerate() {
        for end in range.into_iter().flatten() {
            add((end - front[axis]) / slope[axis]);
        }
    }
    if let Some(window) = &widget.window {
        knot_cuts(window.direction, &window.knots, front, slope, add);
    }
    match &widget.shape {
        WidgetShape::Uniform => {}
        WidgetShape::Gaussian { center, sigma, angle } => {
            // In units of the standard deviations along the rotated axes the peak is round.
            let (sin, cos) = angle.sin_cos();
            let turn = |[s, g]: [f64; 2]| [(cos * s + sin * g) / sigma[0], (cos * g - sin * s) / sigma[1]];
            let [p, q] = turn([front[0] - center[0], front[1] - center[1]]);
            let [dp, dq] = turn(slope);
            let squared = dp * dp + dq * dq;
            let peak = -(p * dp + q * dq) / squared;
            add(peak);
            for sigmas in GAUSSIAN_CUTS {
                let offset = sigmas / squared.sqrt();
                add(peak - offset);
                add(peak + offset);
            }
        }
        &WidgetShape::Triangle { direction, offset, period, duty } => {
            let line = Line::new(direction, front, slope);
            phase_cuts(line.phase(offset, period), &[0.0, 0.5, 0.5 * (1.0 - duty), 0.5 * (1.0 + duty)], add);
        }
        // Half a period is a panel: a rule cannot step over a peak.
        &WidgetShape::Sinusoid { direction, offset, period, .. } => {
            phase_cuts(Line::new(direction, front, slope).phase(offset, period), &[0.0, 0.5], add);
        }
        WidgetShape::Ramp { direction, knots } => knot_cuts(*direction, knots, front, slope, add),
    }
}

/// `start + x * change`.
#[derive(Clone, Copy)]
struct Line {
    start: f64,
    change: f64,
}

impl Line {
    fn new(direction: [f64; 2], front: [f64; 2], slope: [f64; 2]) -> Self {
        let along = |v: [f64; 2]| direction[0] * v[0] + direction[1] * v[1];
        Self { start: along(front), change: along(slope) }
    }

    fn phase(self, offset: f64, period: f64) -> Self {
        Self { start: (self.start - offset) / period, change: self.change / period }
    }
}

fn knot_cuts(direction: [f64; 2], knots: &[[f64; 2]], front: [f64; 2], slope: [f64; 2], add: &mut impl FnMut(f64)) {
    let line = Line::new(direction, front, slope);
    knots.iter().for_each(|knot| add((knot[0] - line.start) / line.change));
}

/// These fractions of every period that the segment meets.
fn phase_cuts(phase: Line, fractions: &[f64], add: &mut impl FnMut(f64)) {
    let span = phase.change.abs();
    // Phrased so that NaN ends here.
    if !(span > 0.0 && span <= 2.0 * MOST_PERIODS) {
        return;
    }
    let first = phase.start.min(phase.start + phase.change).floor();
    for period in 0..span as u32 + 2 {
        for fraction in fractions {
            add((first + f64::from(period) + fraction - phase.start) / phase.change);
        }
    }
}

/// The function with at most [`MOST_PERIODS`] periods of each wave along a segment of this `slope`.
pub fn coarsened(transfer: &TransferFunction, slope: [f64; 2]) -> Cow<'_, TransferFunction> {
    let longer = |widget: &Widget| match widget.shape {
        WidgetShape::Triangle { direction, period, .. } | WidgetShape::Sinusoid { direction, period, .. } => {
            let least = Line::new(direction, [0.0; 2], slope).change.abs() / MOST_PERIODS;
            (least > period).then_some(least)
        }
        _ => None,
    };
    let TransferFunction::Widgets(widgets) = transfer else { return Cow::Borrowed(transfer) };
    if widgets.iter().all(|widget| longer(widget).is_none()) {
        return Cow::Borrowed(transfer);
    }
    let mut widgets = widgets.clone();
    for widget in &mut widgets {
        if let Some(least) = longer(widget)
            && let WidgetShape::Triangle { period, .. } | WidgetShape::Sinusoid { period, .. } = &mut widget.shape
        {
            *period = least;
        }
    }
    Cow::Owned(TransferFunction::Widgets(widgets))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::CurveNode;

    #[test]
    fn a_curve_is_cut_at_the_nodes_inside_in_either_direction() {
        let node = |scalar| CurveNode { scalar, color: [1.0; 3], extinction: 1.0 };
        let curve = TransferFunction::Curve(Curve { nodes: [0.0, 1.0, 2.0, 4.0].map(node).to_vec() });
        assert_eq!(cuts(&curve, [0.5, 0.0], [2.0, 0.0]), [0.25, 0.75]);
        assert_eq!(cuts(&curve, [2.5, 0.0], [-2.0, 0.0]), [0.25, 0.75]);
        assert_eq!(cuts(&curve, [2.0, 0.0], [0.0, 0.0]), [0.0; 0], "no division of zero by zero");
    }

    #[test]
    fn a_widget_is_cut_at_its_ranges_and_around_its_peak() {
        let widget = Widget {
            shape: WidgetShape::Gaussian { center: [0.5, 0.5], sigma: [0.1, 10.0], angle: 0.0 },
            color: [1.0; 3],
            extinction: 1.0,
            scalar_range: Some([0.25, 2.0]),
            gradient_range: None,
            window: None,
        };
        let got = cuts(&TransferFunction::Widgets(vec![widget]), [0.0, 0.5], [1.0, 0.0]);
        let want = [0.1, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.9];
        assert_eq!(got.len(), want.len());
        assert!(got.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-12), "{got:?}");
    }

    fn positions(shape: WidgetShape, front: [f64; 2], slope: [f64; 2]) -> Vec<f64> {
        cuts(&TransferFunction::Widgets(vec![Widget::new(shape, [1.0; 3], 1.0)]), front, slope)
    }

    #[test]
    fn waves_are_cut_in_every_period_in_either_direction() {
        let triangle = |duty| WidgetShape::Triangle { direction: [1.0, 0.0], offset: 0.25, period: 0.5, duty };
        let distinct = |mut cuts: Vec<f64>| {
            cuts.dedup();
            cuts
        };
        assert_eq!(distinct(positions(triangle(1.0), [0.0; 2], [1.0, 0.0])), [0.25, 0.5, 0.75]);
        assert_eq!(distinct(positions(triangle(1.0), [1.0, 0.0], [-1.0, 0.0])), [0.25, 0.5, 0.75]);
        let tents = distinct(positions(triangle(0.5), [0.25, 0.0], [0.5, 0.0]));
        assert_eq!(tents, [0.25, 0.5, 0.75]);
        assert_eq!(positions(triangle(1.0), [0.3, 0.0], [0.0, 9.0]), [0.0; 0], "along a crest");
        assert!(positions(triangle(1.0), [1e300, 0.0], [f64::NAN, 0.0]).is_empty());
    }

    #[test]
    fn ramps_and_windows_are_cut_at_their_knots() {
        let ramp = WidgetShape::Ramp { direction: [1.0, 1.0], knots: vec![[-1.0, 0.0], [0.5, 1.0], [1.0, 0.0]] };
        assert_eq!(positions(ramp, [0.0; 2], [1.0, 1.0]), [0.25, 0.5]);
    }

    #[test]
    fn absurd_waves_are_coarsened_and_sane_ones_are_not() {
        let wave = |period| {
            let shape = WidgetShape::Triangle { direction: [1.0, 0.0], offset: 0.0, period, duty: 1.0 };
            TransferFunction::Widgets(vec![Widget::new(shape, [1.0; 3], 1.0)])
        };
        assert!(matches!(coarsened(&wave(1e-3), [1.0, 0.0]), Cow::Borrowed(_)));
        let absurd = wave(1e-300);
        let coarse = coarsened(&absurd, [1.0, 0.0]);
        assert_eq!(*coarse, wave(1.0 / MOST_PERIODS));
        assert!(cuts(&coarse, [0.3, 0.0], [1.0, 0.0]).len() < 300_000);
    }
}
