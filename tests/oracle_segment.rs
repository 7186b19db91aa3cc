//! The oracle's quadrature of one segment against values computed with 34 digits by another method (closed forms for
//! the depth, fixed collocation panels for the colour).

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use tetralux::oracle::Shade;
use tetralux::oracle::cases::{Case, parse};
use tetralux::oracle::segment::{Medium, Segment, integrate};
use tetralux::scene::{
    Curve, CurveNode, EmissionModel, SinusoidVariant, TransferFunction, Widget, WidgetShape, Window,
};

/// Chosen from 3,000 cases by `scripts/segment_cases.py`.
const SOME: &str = include_str!("common/segment_cases.json");
/// Every tag of the 3,000.
const TAGS: [&str; 27] = [
    "single",
    "uniform",
    "gaussian",
    "triangle",
    "sine",
    "ramp",
    "multi",
    "sf==sb",
    "gf==gb",
    "near-degenerate",
    "D-extreme",
    "huge-tau",
    "tiny-tau",
    "tiny-sigma",
    "huge-sigma",
    "far-tail",
    "tail-short",
    "high-frequency",
    "low-frequency",
    "box-edge",
    "anisotropic",
    "small-duty",
    "kink-at-end",
    "offset-data",
    "colour-layers",
    "window-product",
    "empty",
];
/// Agreement asked for: absolute, relative where the value exceeds 1.
///
/// Of the 3,000 cases the worst depth errs by 2.6e-11, colours and opacities by 3e-13.
const LIMIT: f64 = 1e-10;
/// Deeper segments are integrated only until they are opaque.
const OPAQUE_DEPTH: f64 = 32.0;

/// Errors of one case: depth, opacity, weighted and unweighted colour; infinite where something is not a number.
type Errors = [f64; 4];

fn errors(case: &Case, distort: f64) -> Errors {
    let integral = |emission| {
        let medium = Medium { transfer: &case.transfer, emission, shade: Shade::NONE };
        medium.integrate(case.front, case.back, case.length * (1.0 + distort), 1e-11)
    };
    let [weighted, unweighted] = [EmissionModel::Weighted, EmissionModel::Unweighted].map(integral);
    let error = |got: f64, want: f64| {
        let error = (got - want).abs() / want.abs().max(1.0);
        // `max` would pass over NaN.
        if error.is_finite() { error } else { f64::INFINITY }
    };
    let color = |got: &Segment, want: &[f64; 3]| (0..3).map(|c| error(got.color[c], want[c])).fold(0.0, f64::max);
    let want = &case.expected;
    let tau = |got: &Segment| match want.tau > OPAQUE_DEPTH {
        true if got.tau >= OPAQUE_DEPTH => 0.0,
        _ => error(got.tau, want.tau),
    };
    [
        tau(&weighted).max(tau(&unweighted)),
        error(1.0 - weighted.transmittance(), want.opacity),
        color(&weighted, &want.weighted),
        color(&unweighted, &want.unweighted),
    ]
}

/// Number of cases checked, and those that disagree by more than the limit, with their errors.
fn disagreements(text: &str, distort: f64) -> (usize, Vec<(u32, Vec<String>, Errors)>) {
    let cases = parse(text).expect("cases");
    let (mut bad, mut worst) = (Vec::new(), [(0.0, 0); 4]);
    for case in &cases {
        let errors = errors(case, distort);
        for (worst, error) in worst.iter_mut().zip(errors) {
            if error > worst.0 {
                *worst = (error, case.id);
            }
        }
        if errors.iter().any(|&error| error > LIMIT) {
            bad.push((case.id, case.tags.clone(), errors));
        }
    }
    println!("{} cases", cases.len());
    for (name, (error, id)) in ["tau", "opacity", "weighted", "unweighted"].iter().zip(worst) {
        println!("{name}: worst error {error:.1e}, case {id}");
    }
    (cases.len(), bad)
}

#[test]
fn some_cases_agree() {
    let (checked, bad) = disagreements(SOME, 0.0);
    assert!(checked > 300, "only {checked} cases");
    assert!(bad.is_empty(), "{bad:?}");
}

/// The selection has every tag, every kind of widget, and every kind with ranges and a window.
#[test]
fn the_selection_has_everything() {
    let cases = parse(SOME).expect("cases");
    assert!(SOME.len() <= 400_000, "{} bytes", SOME.len());
    for tag in TAGS.into_iter().chain(["monochrome-multi"]) {
        assert!(cases.iter().any(|case| case.tags.iter().any(|t| t == tag)), "no case is tagged {tag}");
    }
    let mut seen = std::collections::BTreeSet::new();
    for case in &cases {
        let TransferFunction::Widgets(widgets) = &case.transfer else { panic!("widgets") };
        for w in widgets {
            let kind = match &w.shape {
                WidgetShape::Uniform => "uniform",
                WidgetShape::Gaussian { .. } => "gaussian",
                WidgetShape::Triangle { duty, .. } if *duty < 1.0 => "tents",
                WidgetShape::Triangle { .. } => "triangle",
                WidgetShape::Sinusoid { variant: SinusoidVariant::Cos, .. } => "cos",
                WidgetShape::Sinusoid { variant: SinusoidVariant::Arch, .. } => "arch",
                WidgetShape::Sinusoid { variant: SinusoidVariant::Half, .. } => "half",
                WidgetShape::Ramp { .. } => "ramp",
            };
            let ranges = w.scalar_range.is_some() || w.gradient_range.is_some();
            seen.insert((kind, ranges, w.window.is_some()));
        }
    }
    assert_eq!(seen.len(), 8 * 4, "kind, ranges, window: {seen:?}");
}

#[test]
fn a_length_wrong_by_a_millionth_is_noticed() {
    let (checked, bad) = disagreements(SOME, 1e-6);
    assert!(bad.len() * 2 > checked, "only {} of {checked} noticed", bad.len());
}

/// Definitions that are wrong in one detail disagree: what each kind of widget must not be.
#[test]
fn wrong_definitions_are_noticed() {
    type Spoil = fn(&mut Widget) -> bool;
    let spoils: [(&str, Spoil); 7] = [
        ("phase", |w| match &mut w.shape {
            WidgetShape::Triangle { offset, period, .. } | WidgetShape::Sinusoid { offset, period, .. } => {
                *offset += 1e-5 * *period;
                true
            }
            _ => false,
        }),
        ("duty", |w| match &mut w.shape {
            WidgetShape::Triangle { duty, .. } if *duty < 1.0 => {
                *duty *= 1.0 + 1e-5;
                true
            }
            _ => false,
        }),
        ("variant", |w| match &mut w.shape {
            WidgetShape::Sinusoid { variant, .. } => {
                *variant = match variant {
                    SinusoidVariant::Cos => SinusoidVariant::Arch,
                    _ => SinusoidVariant::Cos,
                };
                true
            }
            _ => false,
        }),
        ("angle", |w| match &mut w.shape {
            WidgetShape::Gaussian { angle, .. } if *angle != 0.0 => {
                *angle = -*angle;
                true
            }
            _ => false,
        }),
        ("ramp", |w| match &mut w.shape {
            WidgetShape::Ramp { knots, .. } => {
                knots.iter_mut().for_each(|knot| knot[1] *= 1.0 + 1e-5);
                true
            }
            _ => false,
        }),
        ("window", |w| match &mut w.window {
            Some(Window { knots, .. }) => {
                knots.iter_mut().for_each(|knot| knot[1] *= 1.0 + 1e-5);
                true
            }
            None => false,
        }),
        ("range", |w| match &mut w.scalar_range {
            Some([low, high]) => {
                *low -= 1e-5;
                *high += 1e-5;
                true
            }
            None => false,
        }),
    ];
    let cases = parse(SOME).expect("cases");
    for (name, spoil) in spoils {
        let (mut spoilt, mut noticed) = (0, 0);
        for mut case in cases.clone() {
            let TransferFunction::Widgets(widgets) = &mut case.transfer else { panic!("widgets") };
            if widgets.iter_mut().filter_map(|w| spoil(w).then_some(())).count() > 0 {
                spoilt += 1;
                noticed += usize::from(errors(&case, 0.0).iter().any(|&error| error > LIMIT));
            }
        }
        println!("{name}: {noticed} of {spoilt} noticed");
        assert!(spoilt >= 10 && noticed * 6 > spoilt, "{name}: {noticed} of {spoilt} noticed");
    }
}

#[test]
#[ignore = "needs TETRALUX_ORACLE"]
fn all_cases_agree() {
    let path = common::folder("TETRALUX_ORACLE");
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{e}: {}", path.display()));
    let (checked, bad) = disagreements(&text, 0.0);
    assert!(checked >= 3_000, "only {checked} cases");
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
    // More periods than anybody could integrate: the mean, as near as the documentation says.
    let shape =
        WidgetShape::Sinusoid { direction: [1.0, 0.3], offset: 0.1, period: 1e-250, variant: SinusoidVariant::Arch };
    let wave = TransferFunction::Widgets(vec![Widget::new(shape, [1.0; 3], 2.0)]);
    let got = integrate(&wave, [0.0; 2], [1.0; 2], 1.0, 1e-9);
    assert!((got.tau - 2.0 * std::f64::consts::FRAC_2_PI).abs() < 2.0 / 65_536.0, "{got:?}");
    assert_eq!(integrate(&TransferFunction::Widgets(vec![]), [0.0; 2], [1.0; 2], 1.0, 1e-11), Segment::default());
}
