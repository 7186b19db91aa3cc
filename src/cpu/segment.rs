//! The integral of one segment, in f32: twins of `shaders/math`, `shared/transfer.wgsl` and `shared/bands.wgsl`.

use glam::{Vec2, Vec4};

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

/// A widget on normalised axes.
#[derive(Clone, Copy, Debug)]
pub struct WidgetMedium {
    /// Linear RGB.
    pub color: Vec4,
    /// 1 / mesh length.
    pub extinction: f32,
    /// None for a uniform profile.
    pub gaussian: Option<Gaussian>,
    /// Closed range of the scalar.
    pub scalar: Option<[f32; 2]>,
    /// Closed range of the gradient magnitude.
    pub gradient: Option<[f32; 2]>,
}

/// `exp(-|m (p - center)|^2)`.
#[derive(Clone, Copy, Debug)]
pub struct Gaussian {
    /// (scalar, gradient magnitude).
    pub center: Vec2,
    /// Rows of m.
    pub whiten: [Vec2; 2],
}

impl Gaussian {
    /// From the centre, in units of sqrt(2) standard deviations.
    #[inline(always)]
    pub fn whitened(&self, p: Vec2) -> Vec2 {
        let from_center = p - self.center;
        Vec2::new(self.whiten[0].dot(from_center), self.whiten[1].dot(from_center))
    }
}

/// A sum of widgets. Depths are exact and add; the colours are weighted by their depths.
#[derive(Clone, Debug, Default)]
pub struct WidgetsMedium {
    /// In no order.
    pub widgets: Vec<WidgetMedium>,
}

impl Medium for WidgetsMedium {
    #[inline(always)]
    fn segment(&self, _: &mut u32, front: [f32; 2], back: [f32; 2], length: f32) -> Seen {
        let (front, back) = (Vec2::from(front), Vec2::from(back));
        let (mut depth, mut emission) = (0.0, Vec4::ZERO);
        for widget in &self.widgets {
            let d = widget.depth(front, back, length);
            depth += d;
            emission += d * widget.color;
        }
        let phi = phi_one(depth);
        (emission * phi).with_w(depth * phi)
    }
}

impl WidgetMedium {
    /// The optical depth of a segment.
    #[inline]
    pub fn depth(&self, front: Vec2, back: Vec2, length: f32) -> f32 {
        let mut inside = [0.0, 1.0];
        if let Some(range) = self.scalar {
            inside = clip_to_range(inside, front.x, back.x, range);
        }
        if let Some(range) = self.gradient {
            inside = clip_to_range(inside, front.y, back.y, range);
        }
        let share = inside[1] - inside[0];
        if share <= 0.0 {
            return 0.0;
        }
        let mean = match &self.gaussian {
            None => 1.0,
            Some(g) => gaussian_mean(g.whitened(front.lerp(back, inside[0])), g.whitened(front.lerp(back, inside[1]))),
        };
        // Absurd extinctions stay finite.
        (self.extinction * length).min(1e25) * share * mean
    }
}

/// `exp(-t)` for t >= 0, without denormals.
#[inline(always)]
fn attenuation(t: f32) -> f32 {
    (-t.min(87.0)).exp()
}

/// `(1 - exp(-t)) / t` for t >= 0, 1 at 0. Relative error 1.6e-7.
#[inline(always)]
fn phi_one(t: f32) -> f32 {
    if t < 1.0 {
        return 1.0
            + t * (-0.5
                + t * (0.166_666_5
                    + t * (-0.041_665_334
                        + t * (0.008_328_144
                            + t * (-0.001_377_766_4 + t * (0.000_184_942_31 - t * 0.000_015_930_939))))));
    }
    (1.0 - attenuation(t)) / t
}

/// `exp(x^2) erfc(x)` for x >= 0. Relative error 3.0e-7 (`tables/coefficients.json`, "erfcx").
fn erfcx(x: f32) -> f32 {
    const P: [f32; 11] = [
        0.000_155_460_13,
        -0.000_183_626_73,
        -0.001_382_726,
        0.001_043_077_4,
        0.008_678_226,
        -0.007_942_667,
        -0.054_208_256,
        0.164_035_83,
        -0.166_031_52,
        -0.092_763_08,
        1.276_978_4,
    ];
    let u = (x - 2.0) / (x + 2.0);
    P.iter().fold(0.0, |sum, p| sum * u + p) / (1.0 + 2.0 * x)
}

/// Mean of `exp(-|p|^2)` over the segment between two whitened points, `|p| <= 1e15`. Never a difference of error functions:
/// scaled complements share no leading digits. Absolute error 2.6e-7.
pub fn gaussian_mean(front: Vec2, back: Vec2) -> f32 {
    let step = back - front;
    let extent = step.length();
    // A segment without extent may run any way.
    let along = if extent > 1e-18 { step / extent.max(1e-18) } else { Vec2::X };
    // From the end nearer to the centre: rounding is relative to its coordinates.
    let near_end = if back.length_squared() < front.length_squared() { -back } else { front };
    let v_start = near_end.dot(along);
    let across = near_end.perp_dot(along);
    let q = across * across;
    let v_end = v_start + extent;
    if extent < 1.0 && extent * (v_start + v_end).abs() < 2.0 {
        return gaussian_mean_short(v_start, extent, q);
    }
    let (a, b) = (v_start.abs().min(v_end.abs()), v_start.abs().max(v_end.abs()));
    let tail_a = attenuation(a * a + q) * erfcx(a);
    let tail_b = attenuation(b * b + q) * erfcx(b);
    let same_side = v_start * v_end > 0.0;
    let area = if same_side { tail_a - tail_b } else { 2.0 * attenuation(q) - tail_a - tail_b };
    0.886_226_95 * area / extent
}

/// The same over `[v, v + extent]` at distance `sqrt(q)`, for short extents: 5-point Gauss-Legendre.
fn gaussian_mean_short(v: f32, extent: f32, q: f32) -> f32 {
    const NODES: [(f32, f32); 5] = [
        (0.046_910_077, 0.118_463_44),
        (0.230_765_34, 0.239_314_34),
        (0.5, 0.284_444_45),
        (0.769_234_66, 0.239_314_34),
        (0.953_089_9, 0.118_463_44),
    ];
    NODES.iter().map(|(x, weight)| weight * attenuation((v + extent * x) * (v + extent * x) + q)).sum()
}

/// The part of [0, 1] where `front + x (back - front)` lies in the range, intersected with `within` (start, end); empty
/// where start > end.
fn clip_to_range(within: [f32; 2], front: f32, back: f32, [low, high]: [f32; 2]) -> [f32; 2] {
    let change = back - front;
    if change.abs() < 1e-30 {
        return if front >= low && front <= high { within } else { [1.0, 0.0] };
    }
    let (x_low, x_high) = ((low - front) / change, (high - front) / change);
    [within[0].max(x_low.min(x_high)), within[1].min(x_low.max(x_high))]
}
