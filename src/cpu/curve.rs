//! 1D functions, in f32: twins of `shaders/math/optics.wgsl` and `shaders/shared/curves.wgsl`.

use glam::Vec4;
use pulp::{Scalar, Simd};

use crate::cpu::lanes::{Floats, Mask, Words};
use crate::cpu::segment::{LaneMedium, Medium, Seen, SeenLanes, Segments};

/// A linear piece of a 1D function.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    /// Where it begins.
    pub low: f32,
    /// Where it ends.
    pub high: f32,
    /// Colour and extinction at its beginning.
    pub start: Vec4,
    /// Their change per unit of the scalar.
    pub slope: Vec4,
}

impl Piece {
    fn at(&self, s: f32) -> Vec4 {
        (self.start + (s - self.low) * self.slope).max(Vec4::ZERO)
    }
}

/// A 1D function: pieces without gaps that reach beyond 0..1.
#[derive(Clone, Debug, Default)]
pub struct CurveMedium {
    /// At least one; `low` strictly increases.
    pub pieces: Vec<Piece>,
}

impl CurveMedium {
    /// The last piece that begins below or at `s`.
    pub fn holder(&self, s: f32) -> usize {
        self.pieces.partition_point(|p| p.low <= s).saturating_sub(1)
    }

    /// Colour and extinction at a scalar.
    pub fn at(&self, s: f32) -> Vec4 {
        self.pieces.get(self.holder(s)).map_or(Vec4::ZERO, |piece| piece.at(s))
    }

    /// Mean extinction between two scalars.
    pub fn mean_extinction(&self, from: f32, to: f32) -> f32 {
        let (low, high) = (from.min(to), from.max(to));
        if high - low < 1e-6 {
            return self.at(0.5 * (low + high)).w;
        }
        let of_piece = |piece: &Piece| {
            let (start, end) = (low.max(piece.low), high.min(piece.high));
            if end > start { (end - start) * piece.at(0.5 * (start + end)).w } else { 0.0 }
        };
        self.pieces.iter().map(of_piece).sum::<f32>() / (high - low)
    }

    /// Segments of which some lie over several pieces: those are split at the pieces' ends.
    #[inline(always)]
    fn split<S: Simd>(&self, kept: &mut PieceLanes<S>, segments: &Segments<S>) -> SeenLanes<S> {
        let Segments { which, front: [front, _], back: [back, _], length, .. } = *segments;
        let elsewhere = which & (kept.low.above(front) | front.above(kept.high));
        for lane in elsewhere.lanes() {
            kept.take(lane, self, self.holder(front.values()[lane]));
        }
        let (zero, one) = (length.all(0.0), length.all(1.0));
        let change = back - front;
        let (mut at, mut seen) = (zero, SeenLanes { color: [zero; 3], opacity: zero });
        let mut pending = which;
        loop {
            let (rises, falls) = (back.above(kept.high), kept.low.above(back));
            let leaves = pending & (rises | falls);
            let bound = rises.floats(kept.high, kept.low);
            let end = leaves.floats((bound - front).over(change).max(at).min(one), one);
            let (s, t) = (change.mul_add(at, front), change.mul_add(end, front));
            let part = linear(kept.at(s), kept.at(t), length * (end - at));
            let clear = one - seen.opacity;
            for (sum, color) in seen.color.iter_mut().zip(part.color) {
                *sum = clear.mul_add(color, *sum);
            }
            seen.opacity = clear.mul_add(part.opacity, seen.opacity);
            at = end;
            pending = leaves & clear.all(1.0 - 1e-7).above(seen.opacity);
            if !pending.any() {
                return seen;
            }
            let rising = rises.bits();
            for lane in pending.lanes() {
                let index = kept.index.values()[lane] as usize;
                let next = if rising >> lane & 1 != 0 { index + 1 } else { index.saturating_sub(1) };
                kept.take(lane, self, next);
            }
        }
    }
}

/// The piece that each lane's last segment ended in.
#[derive(Clone, Copy)]
pub struct PieceLanes<S: Simd> {
    index: Words<S>,
    low: Floats<S>,
    high: Floats<S>,
    start: [Floats<S>; 4],
    slope: [Floats<S>; 4],
}

impl<S: Simd> PieceLanes<S> {
    #[inline(always)]
    fn take(&mut self, lane: usize, curve: &CurveMedium, index: usize) {
        let index = index.min(curve.pieces.len() - 1);
        let piece = &curve.pieces[index];
        self.index.values_mut()[lane] = index as u32;
        self.low.values_mut()[lane] = piece.low;
        self.high.values_mut()[lane] = piece.high;
        for i in 0..4 {
            self.start[i].values_mut()[lane] = piece.start[i];
            self.slope[i].values_mut()[lane] = piece.slope[i];
        }
    }

    /// Colour and extinction at a scalar.
    #[inline(always)]
    fn at(&self, s: Floats<S>) -> [Floats<S>; 4] {
        let (from, zero) = (s - self.low, s.all(0.0));
        let value = |i: usize| from.mul_add(self.slope[i], self.start[i]).max(zero);
        [value(0), value(1), value(2), value(3)]
    }
}

impl LaneMedium for CurveMedium {
    type Kept<S: Simd> = PieceLanes<S>;

    #[inline(always)]
    fn kept<S: Simd>(&self, simd: S) -> PieceLanes<S> {
        let zero = Floats::splat(simd, 0.0);
        let mut kept =
            PieceLanes { index: Words::splat(simd, 0), low: zero, high: zero, start: [zero; 4], slope: [zero; 4] };
        for lane in 0..S::F32_LANES {
            kept.take(lane, self, 0);
        }
        kept
    }

    #[inline(always)]
    fn segments<S: Simd>(&self, kept: &mut PieceLanes<S>, segments: &Segments<S>) -> SeenLanes<S> {
        let Segments { which, front: [front, _], back: [back, _], length, .. } = *segments;
        let outside: Mask<S> = which & (kept.low.above(front.min(back)) | front.max(back).above(kept.high));
        if outside.any() {
            return self.split(kept, segments);
        }
        linear(kept.at(front), kept.at(back), length)
    }
}

impl Medium for CurveMedium {
    fn segment(&self, front: [f32; 2], back: [f32; 2], length: f32) -> Seen {
        self.segments(&mut self.kept(Scalar), &Segments::one(front, back, length)).one()
    }
}

/// Segments of linear colour and extinction (in the last component). What has an end depth above 1 is taken in steps
/// of depth 1/2.
#[inline(always)]
fn linear<S: Simd>(front: [Floats<S>; 4], back: [Floats<S>; 4], length: Floats<S>) -> SeenLanes<S> {
    let (a, b, one) = (front[3] * length, back[3] * length, length.all(1.0));
    let [opacity, share] = thin_weights(a.min(one), b.min(one));
    let rest = opacity - share;
    let color = |i: usize| front[i].mul_add(share, back[i] * rest);
    let mut seen = SeenLanes { color: [color(0), color(1), color(2)], opacity };
    let is_deep = a.max(b).above(one);
    if is_deep.any() {
        for lane in is_deep.lanes() {
            let [from, to] = [front, back].map(|end| Vec4::from(end.map(|lanes| lanes.values()[lane])));
            seen.set(lane, deep(from, to, a.values()[lane], b.values()[lane]));
        }
    }
    seen
}

#[inline(never)]
fn deep(mut front: Vec4, back: Vec4, a: f32, b: f32) -> Seen {
    // Squares stay finite.
    let (mut a, mut b) = (a.min(1e15), b.min(1e15));
    let mut seen = Vec4::ZERO;
    loop {
        let deep = a > 1.0 || b > 1.0;
        let mut part = 1.0;
        if deep {
            // a x + (b - a) x^2 / 2 = 1/2, in the form without cancellation.
            part = (1.0 / (a + (a * a + (b - a)).max(0.0).sqrt())).min(1.0);
        }
        let end = front.lerp(back, part);
        let depth_at_end = a + (b - a) * part;
        let depths = [a * part, depth_at_end * part].map(|depth| Floats::splat(Scalar, depth));
        let [opacity, share] = thin_weights(depths[0], depths[1]).map(|weight| weight.values()[0]);
        let color = front * share + end * (opacity - share);
        seen += (1.0 - seen.w) * color.with_w(opacity);
        if !deep || seen.w > 1.0 - 1e-7 {
            return seen;
        }
        front = end;
        a = depth_at_end * (1.0 - part);
        b *= 1.0 - part;
    }
}

/// Opacity, and the share of the front's colour in it, for end depths `a` and `b` from 0 to 1. See
/// `shaders/math/optics.wgsl`; the share's error is below 3.9e-6 (`tables/coefficients.json`, "front_share").
#[inline(always)]
fn thin_weights<S: Simd>(a: Floats<S>, b: Floats<S>) -> [Floats<S>; 2] {
    let half = a.all(0.5);
    let (t, d) = (half * (a + b), half * (b - a));
    let level = t.polynomial([0.0, 0.5, -0.166_354_7, 0.040_128_42, -0.005_898_007]);
    let slope = t.polynomial([-0.166_666_67, 0.083_240_46, -0.024_320_815, 0.004_133_037]);
    let bend = t.polynomial([-0.017_194_284, 0.010_519_15, -0.004_035_674_5]);
    let rest = t.polynomial([-0.001_174_861_1, 0.000_459_874_14]);
    let rest = d.mul_add(d.all(-0.000_445_414_77), rest);
    let front = d.mul_add(d.mul_add(d.mul_add(rest, bend), slope), level);
    [t * phi_one_unit(t), front]
}

/// `(1 - exp(-t)) / t` for t in 0..1, relative error 1.2e-7 (`tables/coefficients.json`, "phi_one_unit").
#[inline(always)]
fn phi_one_unit<S: Simd>(t: Floats<S>) -> Floats<S> {
    t.polynomial([0.999_999_94, -0.499_994_58, 0.166_605_22, -0.041_406_598, 0.007_823_707, -0.000_907_157_6])
}
