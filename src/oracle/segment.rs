//! One ray segment inside one cell: adaptive quadrature of the integrals as they are defined.
//!
//! With `x` in [0, 1] from front to back, scalar and gradient magnitude linear in `x`, `D` the length:
//! `tau = D int a(x) dx` and `color = D int e(x) exp(-D int_0^x a) dx`, `a` the extinction and `e` the emission: by the
//! weighted model the sum of `c a` over the widgets, by the unweighted one the sum of `c` over their supports. The segment is cut where the function has kinks, steps or peaks; each panel is halved until a 4-node and an 8-node
//! Gauss-Legendre rule agree. There is no error function and no table here: this is what those are held against.

use std::borrow::Cow;

use crate::oracle::cuts::{coarsened, cuts};
use crate::oracle::rule::{EIGHT, FOUR, Rule};
use crate::oracle::shade::Shade;
use crate::scene::{EmissionModel, TransferFunction};

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

    /// Opacity and colour multiplied by `factor`.
    fn faded(self, factor: f64) -> Self {
        if factor == 1.0 {
            return self;
        }
        let opacity = -(-self.tau).exp_m1();
        Self { tau: -(-factor * opacity).ln_1p(), color: self.color.map(|c| factor * c) }
    }

    /// Puts `behind` at the back end.
    fn then(self, behind: Self) -> Self {
        let seen = self.transmittance();
        Self { tau: self.tau + behind.tau, color: std::array::from_fn(|c| self.color[c] + seen * behind.color[c]) }
    }
}

/// What a segment leads through.
#[derive(Clone, Copy, Debug)]
pub struct Medium<'a> {
    /// Classification, data units.
    pub transfer: &'a TransferFunction,
    /// What colours are multiplied by.
    pub emission: EmissionModel,
    /// Lighting and silhouettes.
    pub shade: Shade,
}

impl Medium<'_> {
    /// Integrates from `front` to `back`, each (scalar, gradient magnitude) in data units, over `length` data units. On
    /// every panel the two rules agree to `tolerance`, absolute, in depth and colour as they weigh at the front end; the
    /// finer one is used, whose error is far smaller.
    ///
    /// Of a wave with more than 65,536 periods along the segment the periods are stretched to that number: what a depth
    /// then errs by is at most a 65,536th of the depth at the wave's peak, and no renderer's scalars are that fine.
    pub fn integrate(&self, front: [f64; 2], back: [f64; 2], length: f64, tolerance: f64) -> Segment {
        let slope = [back[0] - front[0], back[1] - front[1]];
        let transfer = coarsened(self.transfer, slope);
        let cuts = cuts(&transfer, front, slope);
        let mut walk = Walk {
            transfer,
            emission: self.emission,
            shade: self.shade,
            front,
            slope,
            length: length * self.shade.density,
            tolerance: tolerance.max(FINEST_TOLERANCE),
            total: Segment::default(),
            transmittance: 1.0,
        };
        let mut start = 0.0;
        for end in cuts.into_iter().chain([1.0]) {
            if end > start {
                walk.add(start, end - start, MOST_HALVINGS);
                start = end;
            }
        }
        walk.total.faded(self.shade.opacity)
    }
}

/// [`Medium::integrate`] with weighted emission, unlit.
pub fn integrate(transfer: &TransferFunction, front: [f64; 2], back: [f64; 2], length: f64, tolerance: f64) -> Segment {
    let medium = Medium { transfer, emission: EmissionModel::Weighted, shade: Shade::NONE };
    medium.integrate(front, back, length, tolerance)
}

/// A walk along one segment, front to back.
struct Walk<'a> {
    transfer: Cow<'a, TransferFunction>,
    emission: EmissionModel,
    shade: Shade,
    front: [f64; 2],
    slope: [f64; 2],
    /// Data units times density.
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
            let terms = self.transfer.terms(self.emission, scalar, gradient);
            depths[i] = length * terms.extinction;
            emissions[i] = terms.emission.map(|c| self.shade.color * c + self.shade.white * terms.white);
        }
        if depths == [0.0; N] && emissions == [[0.0; 3]; N] {
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
