//! Exponentials and means of Gaussians of all lanes at once: twins of `optics.rs` and `gaussian.rs`.

use pulp::Simd;

use crate::cpu::lanes::{Floats, Mask};

/// `exp(-t)` for t >= 0, without denormals. Relative error 2e-7: Cody and Waite's reduction, and the polynomial of Cephes'
/// `expf` (Moshier 1992).
#[inline(always)]
pub fn attenuation<S: Simd>(t: Floats<S>) -> Floats<S> {
    let x = -t.min(t.all(87.0));
    let power = (x * x.all(std::f32::consts::LOG2_E)).rounded();
    // ln 2, its first part with so few digits that the product is exact.
    let r = power.mul_add(x.all(-355.0 / 512.0), x);
    let r = power.mul_add(x.all(2.121_944_4e-4), r);
    let rest = r.polynomial([0.5, 0.166_666_65, 0.041_665_796, 0.008_333_452, 0.001_398_2, 0.000_198_756_92]);
    (r * r).mul_add(rest, r + x.all(1.0)).times_power_of_two(power)
}

/// `(1 - exp(-t)) / t` for t >= 0, 1 at 0. The polynomial is that of [`phi_one`](super::optics::phi_one).
#[inline(always)]
pub fn phi_one<S: Simd>(t: Floats<S>) -> Floats<S> {
    let one = t.all(1.0);
    let thin = t.polynomial([
        1.0,
        -0.5,
        0.166_666_5,
        -0.041_665_334,
        0.008_328_144,
        -0.001_377_766_4,
        0.000_184_942_31,
        -0.000_015_930_939,
    ]);
    let is_thin = one.above(t);
    if !(!is_thin).any() {
        return thin;
    }
    is_thin.floats(thin, (one - attenuation(t)).over(t.max(one)))
}

/// Means of `exp(-|p|^2)` over segments between whitened points, and where they hold: for short extents. By 5-point
/// Gauss-Legendre as in [`gaussian_mean`](super::gaussian::gaussian_mean).
#[inline(always)]
pub fn short_gaussian_means<S: Simd>(front: [Floats<S>; 2], back: [Floats<S>; 2]) -> (Floats<S>, Mask<S>) {
    const NODES: [(f32, f32); 5] = [
        (0.046_910_077, 0.118_463_44),
        (0.230_765_34, 0.239_314_34),
        (0.5, 0.284_444_45),
        (0.769_234_66, 0.239_314_34),
        (0.953_089_9, 0.118_463_44),
    ];
    let square = |p: [Floats<S>; 2]| p[0].mul_add(p[0], p[1] * p[1]);
    let [zero, one, least] = [0.0, 1.0, 1e-18].map(|value| front[0].all(value));
    let step = [back[0] - front[0], back[1] - front[1]];
    let extent = square(step).sqrt();
    // A segment without extent may run any way.
    let (has_extent, inverse) = (extent.above(least), one.over(extent.max(least)));
    let along = [has_extent.floats(step[0] * inverse, one), has_extent.floats(step[1] * inverse, zero)];
    // From the end nearer to the centre: rounding is relative to its coordinates.
    let from_back = square(front).above(square(back));
    let near = [from_back.floats(-back[0], front[0]), from_back.floats(-back[1], front[1])];
    let start = near[0].mul_add(along[0], near[1] * along[1]);
    let across = near[0] * along[1] - near[1] * along[0];
    let end = start + extent;
    let is_short = one.above(extent) & one.all(2.0).above(extent * (start + end).abs());
    let mut mean = zero;
    for (x, share) in NODES {
        let at = extent.mul_add(one.all(x), start);
        mean = attenuation(at.mul_add(at, across * across)).mul_add(one.all(share), mean);
    }
    (mean, is_short)
}

#[cfg(test)]
mod tests {
    use glam::Vec2;
    use pulp::{Arch, Scalar, WithSimd};

    use super::*;
    use crate::cpu::widgets::gaussian::gaussian_mean;

    /// Worst relative errors of the exponential and its mean, worst difference of the Gaussians' means, and how many of
    /// these were compared.
    struct Errors;

    impl WithSimd for Errors {
        type Output = ([f64; 3], usize);

        fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
            let (mut worst, mut count) = ([0.0_f64; 3], 0);
            for i in 0..4_000_u16 {
                let t = if i == 0 { 0.0 } else { 1e-4 * 1.0035_f64.powi(i32::from(i)) } as f32;
                let lanes = Floats::splat(simd, t);
                let t = f64::from(t.min(87.0));
                let mean = if t == 0.0 { 1.0 } else { -(-t).exp_m1() / t };
                worst[0] = worst[0].max((f64::from(attenuation(lanes).values()[0]) / (-t).exp() - 1.0).abs());
                if t < 87.0 {
                    worst[1] = worst[1].max((f64::from(phi_one(lanes).values()[0]) / mean - 1.0).abs());
                }
                let turn = f32::from(i);
                let front = 1.5 * turn.cos() * Vec2::new(turn.sin(), (0.7 * turn).cos());
                let back = front + 0.9 * (1.3 * turn).sin() * Vec2::new((0.3 * turn).cos(), (0.9 * turn).sin());
                let [p, q] = [front, back].map(|p| p.to_array().map(|x| Floats::splat(simd, x)));
                let (means, is_short) = short_gaussian_means(p, q);
                if is_short.any() {
                    let difference = f64::from(means.values()[0] - gaussian_mean(front, back)).abs();
                    worst[2] = worst[2].max(difference);
                    count += 1;
                }
            }
            (worst, count)
        }
    }

    #[test]
    fn lanes_agree_with_single_numbers() {
        for ([exponential, mean, gaussian], count) in [Arch::new().dispatch(Errors), Errors.with_simd(Scalar)] {
            assert!(exponential > 0.0 && exponential < 3e-7, "{exponential:e}");
            assert!(mean > 0.0 && mean < 3e-7, "{mean:e}");
            assert!(gaussian < 4e-7 && count > 3_000, "{gaussian:e}, {count}");
        }
    }
}
