//! The generator: every node's integral in f64 by composite Gauss-Legendre quadrature.

use std::f64::consts::PI;

use rayon::prelude::*;
use serde_json::json;
use statrs::function::erf::{erf, erfc};

use super::{Axis, Kind, NODES, Table2};

/// Points of the rule. With panels of [`PANEL_DEPTH`] all samples are right to f32's rounding, by another rule in
/// `tests/tables/errors.rs`.
const POINTS: usize = 16;

/// Largest mean optical depth of a panel.
const PANEL_DEPTH: f64 = 3.0;

/// Optical depth beyond which nothing is added: exp(-60) = 9e-27.
const OPAQUE: f64 = 60.0;

/// Computes a committed table. The same bytes on every run; on another platform's mathematical library `exp` and `sin`
/// may differ in their last bit, and then a value that lies between two f32 may round to the other one.
pub fn generate(kind: Kind) -> Table2 {
    let rule = &Rule::new();
    let axes = kind.axes();
    let first: Vec<f64> = nodes(axes[0]);
    let second: Vec<f64> = nodes(axes[1]);
    // One column of the result per node of the first axis.
    let columns: Vec<Vec<f64>> = first
        .par_iter()
        .map(|&strength| match kind {
            Kind::Psi => second.iter().map(|&back| psi(rule, strength, back)).collect(),
            Kind::GaussianJ => visible_lengths(rule, strength, &second, erf_rise),
            Kind::ArchK => visible_lengths(rule, strength, &second, arch_rise),
            Kind::CosineK => visible_lengths(rule, strength, &second, cosine_rise),
        })
        .collect();
    let values = (0..NODES).flat_map(|j| columns.iter().map(move |column| column[j] as f32)).collect();
    Table2 { name: kind.name(), size: [NODES; 2], axes, values }
}

/// `tables/index.json`: what the files hold, for readers that are not this library.
pub fn index() -> String {
    let entries: Vec<_> = Kind::ALL
        .iter()
        .map(|kind| {
            json!({
                "name": kind.name(),
                "file": format!("{}.f32", kind.name()),
                "meaning": kind.meaning(),
                "type": "f32, little-endian, the first axis fastest",
                "size": [NODES, NODES],
                "axes": kind.axes(),
            })
        })
        .collect();
    format!("{:#}\n", json!({ "nodes": "node i of n lies at position i / (n - 1) of its axis", "tables": entries }))
}

fn nodes(axis: Axis) -> Vec<f64> {
    (0..NODES).map(|i| axis.argument(i as f64 / (NODES - 1) as f64)).collect()
}

/// Gauss-Legendre on [0, 1].
struct Rule {
    nodes: [f64; POINTS],
    weights: [f64; POINTS],
}

impl Rule {
    /// Roots of the Legendre polynomial by Newton's method.
    fn new() -> Self {
        let (mut nodes, mut weights) = ([0.0; POINTS], [0.0; POINTS]);
        for i in 0..POINTS {
            let mut x = -(PI * (i as f64 + 0.75) / (POINTS as f64 + 0.5)).cos();
            let mut slope = 1.0;
            for _ in 0..20 {
                let (mut before, mut value) = (1.0, x);
                for k in 2..=POINTS {
                    let k = k as f64;
                    (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
                }
                slope = POINTS as f64 * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            nodes[i] = 0.5 * (x + 1.0);
            weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
        }
        Self { nodes, weights }
    }

    /// `int_from^to exp(-depth(t)) dt` over equal panels.
    fn visible(&self, from: f64, to: f64, panels: usize, depth: impl Fn(f64) -> f64) -> f64 {
        let width = (to - from) / panels as f64;
        let panel = |p: usize| {
            let start = from + p as f64 * width;
            (0..POINTS).map(|i| self.weights[i] * (-depth(start + self.nodes[i] * width)).exp()).sum::<f64>()
        };
        (0..panels).map(panel).sum::<f64>() * width
    }
}

/// `psi(a, b)`; 0 where an end is infinitely dense.
fn psi(rule: &Rule, a: f64, b: f64) -> f64 {
    if a.is_infinite() || b.is_infinite() {
        return 0.0;
    }
    let depth = |x: f64| x * (a + 0.5 * (b - a) * x);
    // Where the depth is OPAQUE: the depth's inverse, without cancellation.
    let end = if 0.5 * (a + b) <= OPAQUE {
        1.0
    } else {
        (2.0 * OPAQUE / (a + (a * a + 2.0 * (b - a) * OPAQUE).sqrt())).min(1.0)
    };
    // Depth grows at most twice as fast at one end as on average.
    let panels = (2.0 * depth(end) / PANEL_DEPTH).ceil().max(1.0) as usize;
    rule.visible(0.0, end, panels, depth)
}

/// `int_u^end exp(-strength rise(u, t)) dt` for every `u` in `nodes`, which increase up to `end`: the part up to the next
/// node, and from there what the next node sees, dimmed by the depth between. All terms are positive: nothing cancels.
fn visible_lengths(rule: &Rule, strength: f64, nodes: &[f64], rise: fn(f64, f64) -> f64) -> Vec<f64> {
    let mut lengths = vec![0.0; nodes.len()];
    for i in (0..nodes.len() - 1).rev() {
        let (from, to) = (nodes[i], nodes[i + 1]);
        let depth = strength * rise(from, to);
        // Between nodes the profiles change little, but near their zeros: twice the mean there too.
        let panels = (2.0 * depth / PANEL_DEPTH).ceil().max(1.0) as usize;
        let near = rule.visible(from, to, panels, |t| strength * rise(from, t));
        lengths[i] = near + (-depth).exp() * lengths[i + 1];
    }
    lengths
}

/// `erf t - erf u`, t >= u, by complements where both lie on one side of the centre.
fn erf_rise(u: f64, t: f64) -> f64 {
    if u > 0.5 {
        erfc(u) - erfc(t)
    } else if t < -0.5 {
        erfc(-t) - erfc(-u)
    } else {
        erf(t) - erf(u)
    }
}

/// `cos u - cos t`.
fn arch_rise(u: f64, t: f64) -> f64 {
    2.0 * (0.5 * (t + u)).sin() * (0.5 * (t - u)).sin()
}

/// `((t - sin t) - (u - sin u)) / 2`.
fn cosine_rise(u: f64, t: f64) -> f64 {
    0.5 * (t - u) - (0.5 * (t + u)).cos() * (0.5 * (t - u)).sin()
}
