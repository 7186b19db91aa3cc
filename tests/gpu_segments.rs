//! Integrals on the device against stress cases computed with 34 digits, every shape of widget among them. `TETRALUX_ORACLE`
//! names a larger file of cases, which is then checked too.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use common::gpu::device as open;
use tetralux::oracle::cases::{Case, parse};
use tetralux::oracle::segment::integrate;
use tetralux::renderer::SegmentIntegral;
use tetralux::report::segments::{Answer, Budget, SegmentReport, on_cpu, on_device};
use tetralux::scene::{EmissionModel, SinusoidVariant, TransferFunction, Widget, WidgetShape};

const SOME: &str = include_str!("common/segment_cases.json");

/// The selection holds as many cases of every tag; pieces are counted over all cases only.
fn selection() -> Vec<Case> {
    parse(SOME).expect("cases")
}

/// The whole file, where there is one.
fn everything() -> Option<Vec<Case>> {
    let path = std::env::var("TETRALUX_ORACLE").ok()?;
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("TETRALUX_ORACLE: {path}: {e}"));
    Some(parse(&text).expect("cases"))
}

fn adaptive(tolerance: f64) -> SegmentIntegral {
    SegmentIntegral::Adaptive { tolerance }
}

/// Checks an integral on both files against its budget.
fn check(integral: SegmentIntegral, emission: EmissionModel) {
    let gpu = open();
    let budget = Budget::of(integral, emission);
    let some = selection();
    let answers = on_device(&gpu, integral, emission, &some).expect("answers");
    let report = SegmentReport::new(&some, &answers, emission, &Budget { mean_pieces: f64::INFINITY, ..budget });
    println!("{integral}\n{report}");
    assert!(report.failures.is_empty(), "{integral}\n{report}");
    if let Some(all) = everything() {
        let answers = on_device(&gpu, integral, emission, &all).expect("answers");
        let report = SegmentReport::new(&all, &answers, emission, &budget);
        println!("{integral}, all\n{report}");
        assert!(report.failures.is_empty(), "{integral}\n{report}");
    }
}

/// Of the 3,000 cases (lavapipe): opacity errs by 3.7e-6 at most, within four sensitivities of it; colours by 5.3e-3,
/// 6.3e-4 and 6.9e-5; 2.48, 4.89 and 10.5 pieces where several colours are seen.
#[test]
fn adaptive_keeps_its_tolerance() {
    for tolerance in [1e-2, 1e-3, 1e-4] {
        check(adaptive(tolerance), EmissionModel::Weighted);
    }
}

#[test]
fn analytic_depths_and_single_colors_are_exact() {
    check(SegmentIntegral::Analytic, EmissionModel::Weighted);
}

/// Of the 3,000 cases: 2.7e-4 of the colour times the length at most.
#[test]
fn unweighted_emission_is_close() {
    check(adaptive(1e-3), EmissionModel::Unweighted);
}

/// By tables, where one Gaussian or wave is alone.
#[test]
fn tabled_emission_is_close() {
    check(SegmentIntegral::Analytic, EmissionModel::Unweighted);
    // What a table answers takes one piece; elsewhere pieces are scaled to their depth.
    let cases: Vec<Case> = selection().into_iter().filter(|c| c.tags.iter().any(|tag| tag == "gaussian")).collect();
    let pieces = |integral| {
        let answers = on_device(&open(), integral, EmissionModel::Unweighted, &cases).expect("answers");
        answers.iter().map(|answer| answer.pieces).sum::<u32>() as usize
    };
    assert!(pieces(SegmentIntegral::Analytic) <= cases.len() * 5 / 4);
    assert!(pieces(adaptive(1e-3)) > cases.len() * 5 / 2);
}

/// Integrals without a promise are the CPU engine's, too: the same to rounding. (But 2.6 % of the cases by `partial-direct`:
/// the CPU leaves out widgets that a segment does not reach, and does not cut at their special points; and where nothing
/// absorbs at an end, its colour is any.)
/// `wrong` is added to the device's answers.
fn share_unlike_the_cpu(integral: SegmentIntegral, cases: &[Case], wrong: f64) -> f64 {
    let device = on_device(&open(), integral, EmissionModel::Weighted, cases).expect("answers");
    let host = on_cpu(integral, EmissionModel::Weighted, cases).expect("answers");
    let differ = |(a, b): &(&Answer, &Answer)| {
        let color = (0..3).map(|c| (a.color[c] + wrong - b.color[c]).abs()).fold(0.0, f64::max);
        let error = color.max((a.opacity - b.opacity).abs());
        error.is_nan() || error > 1e-4
    };
    device.iter().zip(&host).filter(differ).count() as f64 / cases.len() as f64
}

#[test]
fn the_cpu_computes_the_same() {
    let cases = selection();
    for integral in [
        SegmentIntegral::VertexLinear,
        SegmentIntegral::MeanScalar,
        SegmentIntegral::Segmented { pieces: 10 },
        SegmentIntegral::PartialDirect,
    ] {
        let share = share_unlike_the_cpu(integral, &cases, 0.0);
        println!("{integral}: {:.1} % of the cases differ by more than 1e-4", 100.0 * share);
        assert!(share <= 0.03, "{integral}: {share}");
        assert!(share_unlike_the_cpu(integral, &cases, 2e-4) > 0.9, "{integral}: a planted error");
    }
}

#[test]
fn planted_errors_are_rejected() {
    let gpu = open();
    let cases = selection();
    for integral in [adaptive(1e-3), SegmentIntegral::Analytic] {
        let budget = Budget { mean_pieces: f64::INFINITY, ..Budget::of(integral, EmissionModel::Weighted) };
        let answers = on_device(&gpu, integral, EmissionModel::Weighted, &cases).expect("answers");
        let fails = |answers: &[Answer], budget: &Budget| {
            !SegmentReport::new(&cases, answers, EmissionModel::Weighted, budget).failures.is_empty()
        };
        let single = cases.iter().position(|c| c.tags[0] == "single" && c.sensitivity.weighted < 1e-7).expect("a case");
        let with = |change: &dyn Fn(&mut Answer)| {
            let mut planted = answers.clone();
            change(&mut planted[single]);
            planted
        };
        assert!(!fails(&answers, &budget));
        assert!(fails(&with(&|a| a.opacity += 4e-6), &budget), "an opacity wrong by 4e-6");
        assert!(fails(&with(&|a| a.color[1] -= 4e-6), &budget), "a single colour wrong by 4e-6");
        assert!(fails(&with(&|a| a.color[2] = f64::NAN), &budget), "NaN");
        assert!(fails(&with(&|a| a.opacity = f64::INFINITY), &budget), "infinity");
        assert!(fails(&answers[1..], &budget), "a case without an answer");
        let less = Budget { mean_pieces: 0.9, ..budget };
        assert!(fails(&answers, &less), "more pieces than allowed");
    }
    // Colours over length, of unweighted emission, wrong by 6e-4.
    let (unweighted, analytic) = (EmissionModel::Unweighted, SegmentIntegral::Analytic);
    let budget = Budget { mean_pieces: f64::INFINITY, ..Budget::of(analytic, unweighted) };
    let mut answers = on_device(&gpu, analytic, unweighted, &cases).expect("answers");
    assert!(SegmentReport::new(&cases, &answers, unweighted, &budget).failures.is_empty());
    let gaussian = cases.iter().position(|c| c.tags.contains(&"gaussian".to_owned())).expect("a case");
    answers[gaussian].color = answers[gaussian].color.map(|c| c + 6e-4 * cases[gaussian].length);
    assert!(!SegmentReport::new(&cases, &answers, unweighted, &budget).failures.is_empty());
    // The analytic integral's colours are within nobody's tolerance.
    let answers = on_device(&gpu, SegmentIntegral::Analytic, EmissionModel::Weighted, &cases).expect("answers");
    let budget = Budget::of(adaptive(1e-2), EmissionModel::Weighted);
    assert!(SegmentReport::new(&cases, &answers, EmissionModel::Weighted, &budget).failures.len() > 5);
}

fn case(transfer: &TransferFunction, front: [f64; 2], back: [f64; 2], length: f64) -> Case {
    let expected = integrate(transfer, front, back, length, 1e-10);
    Case {
        id: 0,
        tags: vec![],
        front,
        back,
        length,
        transfer: transfer.clone(),
        expected: tetralux::oracle::cases::Expected {
            tau_of_widget: vec![],
            tau: expected.tau,
            opacity: 1.0 - expected.transmittance(),
            weighted: expected.color,
            unweighted: [0.0; 3],
        },
        sensitivity: tetralux::oracle::cases::Sensitivity { opacity: 0.0, weighted: 0.0, unweighted: 0.0 },
    }
}

fn pairs() -> Vec<(&'static str, TransferFunction)> {
    let gaussian = |center, sigma| WidgetShape::Gaussian { center, sigma, angle: 0.4 };
    let wave = |variant, period| WidgetShape::Sinusoid { direction: [1.0, 0.2], offset: 0.1, period, variant };
    let sum = |a: WidgetShape, b: WidgetShape, most: f64| {
        TransferFunction::Widgets(vec![
            Widget::new(a, [1.0, 0.1, 0.0], most),
            Widget::new(b, [0.0, 0.4, 1.0], 0.6 * most),
        ])
    };
    vec![
        ("wide Gaussians", sum(gaussian([0.3, 0.4], [0.2, 0.3]), gaussian([0.6, 0.5], [0.3, 0.2]), 3.0)),
        ("a narrow Gaussian", sum(gaussian([0.5, 0.4], [0.02, 0.3]), WidgetShape::Uniform, 3.0)),
        ("waves", sum(wave(SinusoidVariant::Cos, 0.21), wave(SinusoidVariant::Half, 0.3), 5.0)),
        (
            "a triangle",
            sum(
                WidgetShape::Triangle { direction: [1.0, 0.0], offset: 0.05, period: 0.2, duty: 0.6 },
                gaussian([0.6, 0.5], [0.3, 0.2]),
                4.0,
            ),
        ),
    ]
}

/// Errors add up along a ray: 300 cells of two colours stay within twice the tolerance of one. `zigzag`: every cell leads
/// from one colour to the other, in turns; else all of them together do.
fn error_of_a_ray(transfer: &TransferFunction, tolerance: f64, length: f64, zigzag: bool) -> (f64, u32) {
    const CELLS: u32 = 300;
    let gpu = open();
    let at = |i: u32| {
        let x = if zigzag { f64::from(i % 2) } else { f64::from(i) / f64::from(CELLS) };
        // As shaders see it.
        [x, 0.2 + 0.7 * x].map(|v| f64::from(v as f32))
    };
    let cells: Vec<Case> = (0..CELLS).map(|i| case(transfer, at(i), at(i + 1), length / f64::from(CELLS))).collect();
    let answers = on_device(&gpu, adaptive(tolerance), EmissionModel::Weighted, &cells).expect("answers");
    let compose = |color: [f64; 3], seen: f64, behind: [f64; 3]| std::array::from_fn(|c| color[c] + seen * behind[c]);
    let (mut got, mut got_seen, mut want, mut want_seen) = ([0.0; 3], 1.0, [0.0; 3], 1.0);
    for (answer, cell) in answers.iter().zip(&cells) {
        got = compose(got, got_seen, answer.color);
        want = compose(want, want_seen, cell.expected.weighted);
        got_seen *= 1.0 - answer.opacity;
        want_seen *= 1.0 - cell.expected.opacity;
    }
    let error = got.iter().zip(&want).map(|(g, w): (&f64, &f64)| (g - w).abs()).fold(0.0, f64::max);
    (error, answers.iter().map(|a| a.pieces).sum())
}

#[test]
fn a_ray_through_many_cells_keeps_the_tolerance() {
    let mut worst = 0.0f64;
    for tolerance in [1e-2, 1e-3] {
        for (name, transfer) in pairs() {
            for length in [1.0, 5.0, 30.0, 200.0] {
                for zigzag in [false, true] {
                    let (error, pieces) = error_of_a_ray(&transfer, tolerance, length, zigzag);
                    println!("{name}, length {length}, zigzag {zigzag}, {tolerance}: {error:.1e}, {pieces} pieces");
                    worst = worst.max(error / tolerance);
                    assert!(error <= 2.0 * tolerance, "{name}, {length}, {zigzag}: {error:e} of {tolerance}");
                }
            }
        }
    }
    // The rays are hard enough to err at all.
    assert!(worst > 0.02, "{worst}");
}

/// Errors of 1, 2, 4 .. 64 equal pieces.
fn errors_of_pieces(transfer: &TransferFunction) -> Vec<f64> {
    let gpu = open();
    let cases = [case(transfer, [0.0, 0.2], [1.0, 0.9], 1.0)];
    let error = |power: u32| {
        let integral = SegmentIntegral::Segmented { pieces: 1 << power };
        let answers = on_device(&gpu, integral, EmissionModel::Weighted, &cases).expect("answers");
        let wrong = |c: usize| (answers[0].color[c] - cases[0].expected.weighted[c]).abs();
        (0..3).map(wrong).fold(0.0, f64::max)
    };
    (0..7).map(error).collect()
}

/// Mean order of convergence over the last three doublings.
fn order(errors: &[f64]) -> f64 {
    (errors[3] / errors[6]).log2() / 3.0
}

/// Equal pieces converge with their length squared where the function is smooth, and with their length where it has steps
/// (optics.md 4).
#[test]
fn equal_pieces_converge_as_they_should() {
    let (_, smooth) = &pairs()[0];
    let errors = errors_of_pieces(smooth);
    println!("smooth: {errors:?}, order {:.2}", order(&errors));
    assert!((1.8..2.2).contains(&order(&errors)), "{errors:?}");
    assert!(errors[0] > 1e-2, "one piece is not enough: {errors:?}");
    let step = |low: f64, color| Widget {
        scalar_range: Some([low, low + 0.43]),
        ..Widget::new(WidgetShape::Uniform, color, 5.0)
    };
    let steps = TransferFunction::Widgets(vec![step(0.13, [1.0, 0.0, 0.0]), step(0.29, [0.0, 1.0, 0.0])]);
    let errors = errors_of_pieces(&steps);
    println!("steps: {errors:?}, order {:.2}", order(&errors));
    assert!((0.4..1.6).contains(&order(&errors)), "{errors:?}");
}
