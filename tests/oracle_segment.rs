//! The oracle's quadrature of one segment against values computed with 34 digits by another method (closed forms for
//! the depth, fixed collocation panels for the colour).

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use serde::Deserialize;
use tetralux::oracle::segment::{Segment, integrate};
use tetralux::scene::{Curve, CurveNode, TransferFunction, Widget, WidgetShape};

/// A few of the 3,000 cases, one of each kind that concerns uniform and Gaussian widgets.
const SOME: &str = include_str!("common/segment_cases.json");
/// Agreement asked for, absolute; for depths, relative where they exceed 1.
const LIMIT: f64 = 1e-9;
/// Deeper segments are integrated only until they are opaque.
const OPAQUE_DEPTH: f64 = 32.0;

#[derive(Deserialize)]
struct Cases {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    id: u32,
    tags: Vec<String>,
    segment: Ends,
    widgets: Vec<CaseWidget>,
    expect: Expect,
}

#[derive(Deserialize)]
struct Ends {
    sf: f64,
    gf: f64,
    sb: f64,
    gb: f64,
    #[serde(rename = "D")]
    length: f64,
}

#[derive(Deserialize)]
struct CaseWidget {
    #[serde(rename = "type")]
    kind: String,
    amax: f64,
    color: [f64; 3],
    center: Option<[f64; 2]>,
    sigma: Option<[f64; 2]>,
    #[serde(default)]
    angle: f64,
    #[serde(rename = "box", default)]
    ranges: Ranges,
    window: Option<serde_json::Value>,
}

#[derive(Default, Deserialize)]
struct Ranges {
    s: Option<[f64; 2]>,
    g: Option<[f64; 2]>,
}

#[derive(Deserialize)]
struct Expect {
    tau: f64,
    alpha: f64,
    #[serde(rename = "C_weighted")]
    color: [f64; 3],
}

impl Case {
    /// `None` where the case uses widgets that tetralux does not have.
    fn transfer(&self) -> Option<TransferFunction> {
        let widget = |w: &CaseWidget| {
            let shape = match w.kind.as_str() {
                "uniform" => WidgetShape::Uniform,
                "gaussian" => WidgetShape::Gaussian { center: w.center?, sigma: w.sigma?, angle: w.angle },
                _ => return None,
            };
            w.window.is_none().then_some(Widget {
                shape,
                color: w.color,
                extinction: w.amax,
                scalar_range: w.ranges.s,
                gradient_range: w.ranges.g,
                window: None,
            })
        };
        self.widgets.iter().map(widget).collect::<Option<_>>().map(TransferFunction::Widgets)
    }

    /// The largest disagreement: opacity, colour, and depth where it is not opaque.
    fn error(&self, got: &Segment) -> f64 {
        let colors = (0..3).map(|c| (got.color[c] - self.expect.color[c]).abs()).fold(0.0, f64::max);
        let opacity = (1.0 - got.transmittance() - self.expect.alpha).abs();
        let tau = match self.expect.tau > OPAQUE_DEPTH {
            true if got.tau >= OPAQUE_DEPTH => 0.0,
            _ => (got.tau - self.expect.tau).abs() / self.expect.tau.max(1.0),
        };
        // `max` would pass over NaN.
        if (opacity + tau + got.color.iter().sum::<f64>()).is_finite() {
            colors.max(opacity).max(tau)
        } else {
            f64::INFINITY
        }
    }
}

/// Number of cases checked, and those that disagree by more than the limit, with their errors.
fn disagreements(text: &str, distort: f64) -> (usize, Vec<(u32, Vec<String>, f64)>) {
    let cases: Cases = serde_json::from_str(text).expect("cases");
    let (mut checked, mut bad, mut worst) = (0, Vec::new(), 0.0f64);
    for case in cases.cases {
        let Some(transfer) = case.transfer() else { continue };
        let Ends { sf, gf, sb, gb, length } = case.segment;
        let got = integrate(&transfer, [sf, gf], [sb, gb], length * (1.0 + distort), 1e-11);
        let error = case.error(&got);
        (checked, worst) = (checked + 1, worst.max(error));
        if error > LIMIT {
            bad.push((case.id, case.tags, error));
        }
    }
    println!("{checked} cases, worst error {worst:.1e}");
    (checked, bad)
}

#[test]
fn some_cases_agree() {
    let (checked, bad) = disagreements(SOME, 0.0);
    assert!(checked > 10, "only {checked} cases were understood");
    assert!(bad.is_empty(), "{bad:?}");
}

#[test]
fn a_length_wrong_by_a_millionth_is_noticed() {
    let (checked, bad) = disagreements(SOME, 1e-6);
    assert!(bad.len() * 2 > checked, "only {} of {checked} noticed", bad.len());
}

#[test]
#[ignore = "needs TETRALUX_ORACLE"]
fn all_cases_agree() {
    let path = common::folder("TETRALUX_ORACLE");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{e}: {}", path.display()));
    let (checked, bad) = disagreements(&text, 0.0);
    assert!(checked > 100, "only {checked} cases were understood");
    assert!(bad.is_empty(), "{bad:?}");
}

/// Between two nodes of equal extinction and colours 0 and 1 the integral is elementary.
#[test]
fn a_colour_ramp_at_constant_extinction_is_exact() {
    let node = |scalar, red| CurveNode { scalar, color: [red, 1.0, 0.0], extinction: 3.0 };
    let ramp = TransferFunction::Curve(Curve { nodes: vec![node(0.0, 0.0), node(1.0, 1.0)] });
    for length in [1e-9f64, 1e-3, 0.5, 4.0, 400.0] {
        let depth = 3.0 * length;
        let got = integrate(&ramp, [0.0, 0.0], [1.0, 0.0], length, 1e-12);
        let opacity = -(-depth).exp_m1();
        // int_0^1 x depth exp(-depth x) dx, by its series where the closed form cancels.
        let series = depth * (1.0 / 2.0 - depth * (1.0 / 3.0 - depth * (1.0 / 8.0 - depth / 30.0)));
        let red = if depth < 1e-2 { series } else { opacity / depth - (-depth).exp() };
        assert!((got.color[1] - opacity).abs() < 1e-11, "length {length}: {got:?}");
        assert!((got.color[0] - red).abs() < 1e-11, "length {length}: {got:?}, not {red}");
    }
}

/// A peak far narrower than the segment, at any place along it, is never stepped over.
#[test]
fn narrow_peaks_are_found() {
    for exponent in 3..12 {
        let sigma = 10f64.powi(-exponent);
        for center in [0.013, 0.2, 0.37, 0.5, 0.861] {
            let peak = Widget {
                shape: WidgetShape::Gaussian { center: [center, 0.0], sigma: [sigma, 1.0], angle: 0.0 },
                color: [1.0; 3],
                extinction: 1.0 / sigma,
                scalar_range: None,
                gradient_range: None,
                window: None,
            };
            let got = integrate(&TransferFunction::Widgets(vec![peak]), [0.0, 0.0], [1.0, 0.0], 1.0, 1e-11);
            let want = (2.0 * std::f64::consts::PI).sqrt();
            // The narrowest feel the rounding of the scalar.
            let slack = 1e-10 + 1e-15 / sigma;
            assert!((got.tau - want).abs() < slack, "sigma {sigma}, center {center}: {} {want}", got.tau);
        }
    }
}

/// Reversing a segment changes what is seen, not what is let through.
#[test]
fn reversal_keeps_the_depth() {
    let widget = |center, color| Widget {
        shape: WidgetShape::Gaussian { center, sigma: [0.1, 0.3], angle: 0.7 },
        color,
        extinction: 9.0,
        scalar_range: Some([0.1, 0.8]),
        gradient_range: None,
        window: None,
    };
    let two = TransferFunction::Widgets(vec![widget([0.3, 0.2], [1.0, 0.0, 0.0]), widget([0.6, 0.4], [0.0, 1.0, 0.0])]);
    let there = integrate(&two, [0.0, 0.1], [1.0, 0.6], 2.0, 1e-12);
    let back = integrate(&two, [1.0, 0.6], [0.0, 0.1], 2.0, 1e-12);
    assert!((there.tau - back.tau).abs() < 1e-11, "{there:?} {back:?}");
    assert!(there.color[0] > 1.2 * back.color[0], "the nearer widget hides the other: {there:?} {back:?}");
}

/// Values that no scene should hold end the search instead of refining for ever.
#[test]
fn absurd_values_end() {
    let uniform = |extinction| {
        let widget = Widget {
            shape: WidgetShape::Uniform,
            color: [1.0; 3],
            extinction,
            scalar_range: None,
            gradient_range: None,
            window: None,
        };
        TransferFunction::Widgets(vec![widget])
    };
    assert!(integrate(&uniform(f64::NAN), [0.0; 2], [1.0; 2], 1.0, 1e-11).tau.is_nan());
    assert!(integrate(&uniform(1.0), [0.0; 2], [f64::NAN; 2], 1.0, 0.0).tau.is_finite());
    assert_eq!(integrate(&uniform(f64::INFINITY), [0.0; 2], [1.0; 2], 1.0, 1e-11).transmittance(), 0.0);
    let bright = integrate(&uniform(1e12), [0.0; 2], [1.0; 2], 1.0, 1e-11);
    assert!((bright.color[0] - 1.0).abs() < 1e-11, "{bright:?}");
    assert_eq!(integrate(&TransferFunction::Widgets(vec![]), [0.0; 2], [1.0; 2], 1.0, 1e-11), Segment::default());
}
