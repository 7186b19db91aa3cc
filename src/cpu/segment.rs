//! Media that segments are integrated in, and 1D functions, in f32: twins of `shaders/math/optics.wgsl` and
//! `shaders/shared/curves.wgsl`. Widgets have a folder of their own.

use glam::Vec4;

/// What is seen of one segment: premultiplied colour, and opacity in w.
pub type Seen = Vec4;

/// A medium that segments are integrated in.
pub trait Medium: Sync {
    /// What is seen of a segment from `front` to `back` ((scalar, gradient magnitude), 0..1) of a length in mesh units.
    /// `hint` is whatever the medium left there for the ray's last segment, 0 at first.
    fn segment(&self, hint: &mut u32, front: [f32; 2], back: [f32; 2], length: f32) -> Seen;
}

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
    #[inline(always)]
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

    /// A segment over several pieces, split at their ends.
    #[cold]
    #[inline(never)]
    fn split(&self, hint: &mut u32, front: f32, back: f32, length: f32) -> Seen {
        let rising = back > front;
        let change = back - front;
        let mut i = self.holder(front);
        if !rising && i > 0 && self.pieces[i].low == front {
            i -= 1;
        }
        let (mut at, mut seen) = (0.0_f32, Vec4::ZERO);
        loop {
            let piece = &self.pieces[i];
            let (bound, is_last) = if rising { (piece.high, i + 1 == self.pieces.len()) } else { (piece.low, i == 0) };
            let leaves = !is_last && (if rising { back > bound } else { back < bound });
            let end = if leaves { ((bound - front) / change).clamp(at, 1.0) } else { 1.0 };
            let part = linear(piece.at(front + change * at), piece.at(front + change * end), length * (end - at));
            seen += (1.0 - seen.w) * part;
            if !leaves || seen.w > 1.0 - 1e-7 {
                break;
            }
            at = end;
            i = if rising { i + 1 } else { i - 1 };
        }
        *hint = i as u32;
        seen
    }
}

impl Medium for CurveMedium {
    #[inline(always)]
    fn segment(&self, hint: &mut u32, front: [f32; 2], back: [f32; 2], length: f32) -> Seen {
        let (front, back) = (front[0], back[0]);
        if let Some(piece) = self.pieces.get(*hint as usize)
            && front.min(back) >= piece.low
            && front.max(back) <= piece.high
        {
            return linear(piece.at(front), piece.at(back), length);
        }
        self.split(hint, front, back, length)
    }
}

/// A segment of linear colour and extinction (in w). What has an end depth above 1 is taken in steps of depth 1/2.
#[inline(always)]
pub fn linear(front: Vec4, back: Vec4, length: f32) -> Seen {
    let (a, b) = (front.w * length, back.w * length);
    if a <= 1.0 && b <= 1.0 {
        let [opacity, share] = thin_weights(a, b);
        return weighted(front, back, opacity, share);
    }
    deep(front, back, a, b)
}

/// Colours by their weights, and the opacity.
#[inline(always)]
fn weighted(front: Vec4, back: Vec4, opacity: f32, share: f32) -> Seen {
    let color = front * share + back * (opacity - share);
    color.with_w(opacity)
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
        let [opacity, share] = thin_weights(a * part, depth_at_end * part);
        seen += (1.0 - seen.w) * weighted(front, end, opacity, share);
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
pub fn thin_weights(a: f32, b: f32) -> [f32; 2] {
    let t = 0.5 * (a + b);
    let d = 0.5 * (b - a);
    let level = t * (0.5 + t * (-0.166_354_7 + t * (0.040_128_42 - t * 0.005_898_007)));
    let slope = -0.166_666_67 + t * (0.083_240_46 + t * (-0.024_320_815 + t * 0.004_133_037));
    let bend = -0.017_194_284 + t * (0.010_519_15 - t * 0.004_035_674_5);
    let rest = -0.001_174_861_1 + t * 0.000_459_874_14;
    let front = level + d * (slope + d * (bend + d * (rest - d * 0.000_445_414_77)));
    [t * phi_one_unit(t), front]
}

/// `(1 - exp(-t)) / t` for t in 0..1, relative error 1.2e-7 (`tables/coefficients.json`, "phi_one_unit").
#[inline(always)]
fn phi_one_unit(t: f32) -> f32 {
    0.999_999_94
        + t * (-0.499_994_58 + t * (0.166_605_22 + t * (-0.041_406_598 + t * (0.007_823_707 - t * 0.000_907_157_6))))
}
