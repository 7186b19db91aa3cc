//! The CPU engine's integrals of one segment against stress cases computed with 34 digits, every shape of widget among them.
//! `TETRALUX_ORACLE` names a larger file of cases, which is then checked too.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

use tetralux::cpu::integrate;
use tetralux::oracle::cases::{Case, parse};
use tetralux::oracle::segment::integrate as reference;
use tetralux::renderer::SegmentIntegral;
use tetralux::report::segments::{Answer, Budget, SegmentReport, on_cpu};
use tetralux::scene::{Curve, CurveNode, EmissionModel, TransferFunction, Widget, WidgetShape};

/// Chosen from 3,000 cases by `scripts/segment_cases.py`: as many of every tag. Pieces are counted over all cases only.
const SOME: &str = include_str!("common/segment_cases.json");

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

fn answers(integral: SegmentIntegral, cases: &[Case]) -> Vec<Answer> {
    on_cpu(integral, EmissionModel::Weighted, cases).expect("answers")
}

/// Checks an integral on both files against its budget.
fn check(integral: SegmentIntegral) {
    let budget = Budget::of(integral, EmissionModel::Weighted);
    let selection = (selection(), Budget { mean_pieces: f64::INFINITY, ..budget });
    for (cases, budget) in [selection].into_iter().chain(everything().map(|cases| (cases, budget))) {
        let report = SegmentReport::new(&cases, &answers(integral, &cases), EmissionModel::Weighted, &budget);
        println!("{integral}, {} cases\n{report}", cases.len());
        assert!(report.failures.is_empty(), "{integral}\n{report}");
    }
}

/// Of the 3,000 cases: opacity errs by 9.6e-7 at most; colours by 5.3e-3, 6.3e-4 and 6.9e-5; 2.48, 4.89 and 10.5 pieces
/// where several colours are seen. All but the opacity (3.7e-6) are the graphics device's numbers (`gpu_segments`).
#[test]
fn adaptive_keeps_its_tolerance() {
    for tolerance in [1e-2, 1e-3, 1e-4] {
        check(adaptive(tolerance));
    }
}

#[test]
fn analytic_depths_and_single_colors_are_exact() {
    check(SegmentIntegral::Analytic);
}

#[test]
fn planted_errors_are_rejected() {
    let cases = selection();
    for integral in [adaptive(1e-3), SegmentIntegral::Analytic] {
        let budget = Budget { mean_pieces: f64::INFINITY, ..Budget::of(integral, EmissionModel::Weighted) };
        let answers = answers(integral, &cases);
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
        assert!(fails(&answers[1..], &budget), "a case without an answer");
        assert!(fails(&answers, &Budget { mean_pieces: 0.9, ..budget }), "more pieces than allowed");
    }
    // The analytic integral's colours are within nobody's tolerance, and those of one tolerance not within a smaller one's.
    for (integral, other) in [(SegmentIntegral::Analytic, 1e-2), (adaptive(1e-2), 1e-4)] {
        let budget = Budget::of(adaptive(other), EmissionModel::Weighted);
        let report = SegmentReport::new(&cases, &answers(integral, &cases), EmissionModel::Weighted, &budget);
        assert!(report.failures.len() > 5, "{integral} as if {other}\n{report}");
    }
}

#[test]
fn what_it_cannot_do_is_refused() {
    let refusal =
        |integral, emission| on_cpu(integral, emission, &selection()).err().map(|e| e.to_string()).unwrap_or_default();
    assert!(refusal(adaptive(1e-3), EmissionModel::Unweighted).contains("unweighted"));
    let table = refusal(SegmentIntegral::PreIntegrated { size: 8 }, EmissionModel::Weighted);
    assert!(table.contains("functions of the scalar alone"), "{table}");
    let colored = |i: u32| Widget::new(WidgetShape::Uniform, [f64::from(i) / 100.0; 3], 0.01);
    let sum = |count| TransferFunction::Widgets((0..count).map(colored).collect());
    let of = |count, integral| integrate(&sum(count), integral, [0.0; 2], [1.0; 2], 1.0).map_err(|e| e.to_string());
    assert!(of(64, adaptive(1e-3)).is_ok());
    let many = of(65, adaptive(1e-3)).expect_err("65 colours");
    assert!(many.contains("65 widgets") && many.contains("--integral analytic"), "{many}");
    assert!(of(65, SegmentIntegral::Analytic).is_ok());
}

/// 1D functions: segments within a piece, over several, rising, falling and flat, thin to opaque.
#[test]
fn curves_are_met() {
    let node = |scalar, color, extinction| CurveNode { scalar, color, extinction };
    let nodes = vec![
        node(-1.0, [0.2, 0.4, 1.0], 0.0),
        node(0.5, [1.0, 0.1, 0.3], 1.0),
        node(0.6, [0.0, 1.0, 0.0], 0.25),
        node(2.0, [0.7, 0.7, 0.1], 2.0),
    ];
    let curve = TransferFunction::Curve(Curve { nodes });
    let places = [-2.0, -1.0, -0.3, 0.5, 0.55, 0.6, 0.61, 1.7, 2.0, 2.5];
    let mut worst = 0.0_f64;
    for (front, back) in places.iter().flat_map(|&a| places.map(|b| (a, b))) {
        for length in [1e-6, 1e-3, 0.05, 0.4, 1.0, 5.0, 60.0, 1e4] {
            let got = integrate(&curve, adaptive(1e-3), [front, 0.0], [back, 0.0], length).expect("a segment");
            let got = [got.color[0], got.color[1], got.color[2], got.opacity];
            let want = reference(&curve, [front, 0.0], [back, 0.0], length, 1e-11);
            let want = [want.color[0], want.color[1], want.color[2], 1.0 - want.transmittance()];
            let error = (0..4).map(|c| (f64::from(got[c]) - want[c]).abs()).fold(0.0, f64::max);
            assert!(error < 3e-5, "{front} to {back}, {length}: {got:?}, {want:?}");
            worst = worst.max(error);
        }
    }
    // The share of the front's colour errs by 3.8e-6 for each step (thin_weights).
    println!("worst error {worst:.1e}");
}
