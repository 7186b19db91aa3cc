//! Where along a segment a transfer function has steps, kinks or narrow peaks.

use crate::scene::{Curve, TransferFunction, Widget, WidgetShape};

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

/// The ends of the ranges, and a Gaussian's peak and surroundings.
fn widget_cuts(widget: &Widget, front: [f64; 2], slope: [f64; 2], add: &mut impl FnMut(f64)) {
    for (axis, range) in [widget.scalar_range, widget.gradient_range].into_iter().enumerate() {
        for end in range.into_iter().flatten() {
            add((end - front[axis]) / slope[axis]);
        }
    }
    if let WidgetShape::Gaussian { center, sigma, angle } = widget.shape {
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
}
