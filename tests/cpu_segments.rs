//! The CPU engine's integral of one segment against values computed with 34 digits.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use tetralux::cpu::integrate;
use tetralux::oracle::cases::{Case, parse};
use tetralux::oracle::segment::integrate as reference;
use tetralux::scene::{Curve, CurveNode, TransferFunction};

/// Chosen from 3,000 cases by `scripts/segment_cases.py`.
const SOME: &str = include_str!("common/segment_cases.json");

fn one_color(case: &Case) -> bool {
    let TransferFunction::Widgets(widgets) = &case.transfer else { return true };
    widgets.iter().all(|w| w.color == widgets[0].color)
}

/// Of opacity, and of the colours of cases of one colour: by how much each exceeds what is allowed.
fn excess(case: &Case, got: [f32; 4], distort: f64) -> f64 {
    let got = got.map(|v| f64::from(v) + distort);
    let (want, allowed) = (&case.expected, &case.sensitivity);
    let mut worst = (got[3] - want.opacity).abs() - (2e-6 + 4.0 * allowed.opacity);
    if one_color(case) {
        for (got, want) in got.iter().zip(want.weighted) {
            worst = worst.max((got - want).abs() - (2e-6 + 4.0 * allowed.weighted));
        }
    }
    if got.iter().all(|v| v.is_finite()) { worst } else { f64::INFINITY }
}

fn failures(text: &str, distort: f64) -> (usize, Vec<(u32, Vec<String>, f64)>) {
    let cases = parse(text).expect("cases");
    let mut known = 0;
    let mut bad = Vec::new();
    for case in &cases {
        let Ok(got) = integrate(&case.transfer, case.front, case.back, case.length) else { continue };
        known += 1;
        let excess = excess(case, got, distort);
        if excess > 0.0 {
            bad.push((case.id, case.tags.clone(), excess));
        }
    }
    println!("{known} of {} cases are known, {} fail", cases.len(), bad.len());
    (known, bad)
}

#[test]
fn known_cases_are_met() {
    let (known, bad) = failures(SOME, 0.0);
    assert!(known > 100, "only {known}");
    assert!(bad.is_empty(), "{bad:?}");
}

#[test]
fn planted_errors_are_found() {
    let (known, bad) = failures(SOME, 1e-5);
    assert!(bad.len() > known / 2, "{} of {known}", bad.len());
}

#[test]
#[ignore = "needs TETRALUX_ORACLE"]
fn all_known_cases_are_met() {
    let path = common::folder("TETRALUX_ORACLE").join("cases.json");
    let (known, bad) = failures(&std::fs::read_to_string(&path).expect("cases"), 0.0);
    assert!(known > 800, "only {known}");
    assert!(bad.is_empty(), "{bad:?}");
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
            let got = integrate(&curve, [front, 0.0], [back, 0.0], length).expect("a segment");
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
