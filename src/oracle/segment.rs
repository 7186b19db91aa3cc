//! One ray segment inside one cell: adaptive quadrature of the integrals as they are defined.
//!
//! With `x` in [0, 1] from front to back, scalar and gradient magnitude linear in `x`, `D` the length:
//! `tau = D int a(x) dx` and `color = D int e(x) exp(-D int_0^x a) dx`, `a` the extinction and `e` the emission. The
//! segment is cut where the function has kinks, steps or peaks; each panel is halved until a 4-node and an 8-node
//! Gauss-Legendre rule agree. There is no error function and no table here: this is what those are held against.

use crate::oracle::cuts::cuts;
use crate::oracle::rule::{EIGHT, FOUR, Rule};
use crate::scene::TransferFunction;

/// What a segment does to light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Segment {
    /// Optical depth. Integrated front to back until nothing more is seen: a value above 32 is a lower bound.
    pub tau: f64,
    /// Emission that leaves through the front end, linear RGB.
    pub color: [f64; 3],
}

/// Below this transmittance nothing behind can be seen in an f64 sum of order one.
const OPAQUE: f64 = 1e-14;
/// A panel's optical depth: in a deeper one both rules may miss the thin bright front and agree on nothing.
const PANEL_DEPTH: f64 = 2.0;
/// Two rules may differ by rounding alone: asking for less would halve panels for ever.
const FINEST_TOLERANCE: f64 = 1e-14;
/// Halvings after which a panel is as narrow as the rounding of `x`.
const MOST_HALVINGS: u32 = 50;

impl Segment {
    /// `exp(-tau)`.
    pub fn transmittance(&self) -> f64 {
        (-self.tau).exp()
    }

    /// Puts `behind` at the back end.
    fn then(self, behind: Self) -> Self {
        let seen = self.transmittance();
        Self { tau: self.tau + behind.tau, color: std::array::from_fn(|c| self.color[c] + seen * behind.color[c]) }
    }
}

/// Integrates from `front` to `back`, each (scalar, gradient magnitude) in data units, over `length` data units. On
/// every panel the two rules agree to `tolerance`, absolute, in depth and colour as they weigh at the front end; the
/// finer one is used, whose error is far smaller.
pub fn integrate(transfer: &TransferFunction, front: [f64; 2], back: [f64; 2], length: f64, tolerance: f64) -> Segment {
    let mut walk = Walk {
        transfer,
        front,
        slope: [back[0] - front[0], back[1] - front[1]],
        length,
        tolerance: tolerance.max(FINEST_TOLERANCE),
        total: Segment::default(),
        transmittance: 1.0,
    };
    let mut start = 0.0;
    for end in cuts(transfer, front, walk.slope).into_iter().chain([1.0]) {
        if end > start {
            walk.add(start, end - start, MOST_HALVINGS);
            start = end;
        }
    }
    walk.total
}

/// A walk along one segment, front to back.
struct Walk<'a> {
    transfer: &'a TransferFunction,
    front: [f64; 2],
    slope: [f64; 2],
    length: f64,
    tolerance: f64,
    total: Segment,
    transmittance: f64,
}

impl Walk<'_> {
    /// Adds the panel `[start, start + width]`.
    fn add(&mut self, start: f64, width: f64, halvings: u32) {
        if self.transmittance < OPAQUE {
            return;
        }
        let coarse = self.panel(&FOUR, start, width);
        let fine = self.panel(&EIGHT, start, width);
        let change = (0..3).fold((fine.tau - coarse.tau).abs(), |m, c| m.max((fine.color[c] - coarse.color[c]).abs()));
        // Phrased so that NaN, which no halving mends, ends the search.
        let refine = fine.tau > PANEL_DEPTH || change * self.transmittance > self.tolerance;
        if refine && halvings > 0 {
            let half = 0.5 * width;
            self.add(start, half, halvings - 1);
            self.add(start + half, half, halvings - 1);
        } else {
            self.total = self.total.then(fine);
            self.transmittance = self.total.transmittance();
        }
    }

    /// One rule on one panel, seen from the panel's front.
    fn panel<const N: usize>(&self, rule: &Rule<N>, start: f64, width: f64) -> Segment {
        let length = self.length * width;
        let mut depths = [0.0; N];
        let mut emissions = [[0.0; 3]; N];
        for i in 0..N {
            let x = start + width * rule.nodes[i];
            let [scalar, gradient] = [self.front[0] + x * self.slope[0], self.front[1] + x * self.slope[1]];
            let (extinction, emission) = self.transfer.extinction_and_emission(scalar, gradient);
            (depths[i], emissions[i]) = (length * extinction, emission);
        }
        if depths == [0.0; N] {
            return Segment::default();
        }
        let mut sum = Segment::default();
        for i in 0..N {
            sum.tau += rule.weights[i] * depths[i];
            let in_front: f64 = (0..N).map(|j| rule.running[i][j] * depths[j]).sum();
            let seen = rule.weights[i] * length * (-in_front).exp();
            sum.color = std::array::from_fn(|c| sum.color[c] + seen * emissions[i][c]);
        }
        sum
    }
}
