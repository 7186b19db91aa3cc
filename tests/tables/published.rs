//! What the published axes give: numbers for `tables/README.md`, and no tables that anything reads.

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use tetralux::tables::{Axis, Interpolation, Kind, Table2};

use crate::reference::{erf_rise, integral, psi};

/// Nodes along an axis.
const COUNT: usize = 256;

/// Bilinear look-up in f64: these tables grow like exp(P), which f32 does not hold.
struct Double {
    most: f64,
    low: f64,
    high: f64,
    values: Vec<f64>,
}

impl Double {
    /// Rows of `value(strength)`, strengths even in [0, most], over [low, high].
    fn sample(most: f64, low: f64, high: f64, row: impl Fn(f64, &[f64]) -> Vec<f64>) -> Self {
        let node = |low: f64, high: f64, i: usize| low + (high - low) * i as f64 / (COUNT - 1) as f64;
        let across: Vec<f64> = (0..COUNT).map(|i| node(low, high, i)).collect();
        let values = (0..COUNT).flat_map(|j| row(node(0.0, most, j), &across)).collect();
        Self { most, low, high, values }
    }

    fn lookup(&self, strength: f64, t: f64) -> f64 {
        let place = |low: f64, high: f64, t: f64| {
            let at = (t - low) / (high - low) * (COUNT - 1) as f64;
            let start = (at as usize).min(COUNT - 2);
            (start, at - start as f64)
        };
        let ((j, y), (i, x)) = (place(0.0, self.most, strength), place(self.low, self.high, t));
        let row = |j: usize| self.values[j * COUNT + i] * (1.0 - x) + self.values[j * COUNT + i + 1] * x;
        row(j) * (1.0 - y) + row(j + 1) * y
    }
}

/// Running integrals of `f` from `zero` to every node.
fn running(across: &[f64], zero: f64, f: impl Fn(f64) -> f64) -> Vec<f64> {
    let step = |from: f64, to: f64| integral(to - from, |d| f(from + d));
    let mut sums = vec![0.0];
    for pair in across.windows(2) {
        sums.push(sums[sums.len() - 1] + step(pair[0], pair[1]));
    }
    let offset = step(across[0], zero);
    sums.iter().map(|sum| sum - offset).collect()
}

/// psi on gamma = t / (1 + t): the largest error, bilinear, over end depths with `(a + b) / 2` up to `most`.
pub fn psi_gamma(most: f64) -> f64 {
    let unit = Axis::Linear { from: 0.0, to: 1.0 };
    let depth = |gamma: f64| if gamma < 1.0 { gamma / (1.0 - gamma) } else { f64::INFINITY };
    let table = Table2::sample("gamma", [COUNT; 2], [unit; 2], |a, b| psi(depth(a), depth(b))).expect("enough nodes");
    super::errors::psi_error(most, |a, b| table.lookup([a / (1.0 + a), b / (1.0 + b)], Interpolation::Bilinear))
}

/// The paper's `T(P, t) = int_0^t exp(-P erf s) ds` on linear axes, P < 20, |t| < 4, in f64: the largest error of a
/// Gaussian's mean transmittance, on the sweep that J is measured on (short pieces by quadrature, as there).
pub fn gaussian_linear() -> f64 {
    let table =
        Double::sample(20.0, -4.0, 4.0, |strength, across| running(across, 0.0, |t| (-strength * libm::erf(t)).exp()));
    let upto = |p: f64, t: f64| {
        let inside = t.clamp(-4.0, 4.0);
        table.lookup(p, inside) + (t - inside) * (-p * inside.signum()).exp()
    };
    let mut worst = 0.0f64;
    for piece in super::unweighted::sweep(super::unweighted::Profile::Gaussian, 20.0, 4000) {
        let [p, from, extent] = [piece.strength, piece.start, piece.extent].map(f64::from);
        if extent < 1.0 && p * erf_rise(from, from + extent) < 1.0 {
            continue;
        }
        let mean = (p * libm::erf(from)).exp() * (upto(p, from + extent) - upto(p, from)) / extent;
        worst = worst.max((mean - piece.truth).abs());
    }
    worst
}

/// Falling ramps of depth-like strength w < `most`: the share of the ramp's length where a piece begins and ends, and w.
fn ramps(most: f64) -> impl Iterator<Item = [f64; 3]> {
    let mut rng = StdRng::seed_from_u64(8);
    (0..4000).map(move |turn| {
        let from: f64 = rng.random_range(0.0..1.0);
        let span = (1.0 - from) * if turn % 2 == 0 { 1.0 } else { 1e-3f64.powf(rng.random_range(0.0..1.0)) };
        [from, from + span, rng.random_range(0.0..most)]
    })
}

/// A falling ramp's mean transmittance, by its end depths.
fn ramp_ends([from, to, w]: [f64; 3]) -> [f64; 2] {
    [w * (1.0 - from) * (to - from), w * (1.0 - to) * (to - from)]
}

/// The paper's table of the falling ramp, `T(v, w) = int_0^v exp(-w (x - x^2 / 2)) dx`, in f64.
pub fn falling_ramp(most: f64) -> f64 {
    let table = Double::sample(most, 0.0, 1.0, |w, across| running(across, 0.0, |x| (-w * x * (1.0 - 0.5 * x)).exp()));
    let worst = |error: f64, ramp @ [from, to, w]: [f64; 3]| {
        let mean = (w * from * (1.0 - 0.5 * from)).exp() * (table.lookup(w, to) - table.lookup(w, from)) / (to - from);
        let [a, b] = ramp_ends(ramp);
        error.max((mean - psi(a, b)).abs())
    };
    ramps(most).fold(0.0, worst)
}

/// The same ramps by the table of psi.
pub fn falling_ramp_by_psi(most: f64) -> f64 {
    let worst = |error: f64, ramp| {
        let ends @ [a, b] = ramp_ends(ramp);
        error.max((Kind::Psi.table().lookup(ends, Interpolation::Bilinear) - psi(a, b)).abs())
    };
    ramps(most).fold(0.0, worst)
}
