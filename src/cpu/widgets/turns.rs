//! Trigonometric functions of turns and a spherical Bessel function, for means of waves: f32 twins of
//! `shaders/math/turns.wgsl`. Coefficients and their errors: `tables/coefficients.json`.

use std::f32::consts::PI;

use crate::cpu::widgets::optics::polynomial;

/// `sin(pi/2 x)` for x in [-1, 1]. Absolute error 1.8e-7, relative near 0 ("quarter_sine").
#[inline(always)]
fn quarter_sine(x: f32) -> f32 {
    let coefficients = [1.570_796_4, -0.645_963_7, 0.079_689_68, -0.004_673_766_4, 0.000_151_485_13];
    x * polynomial(x * x, coefficients)
}

/// `sin(2 pi t)`.
pub fn sine_of_turns(t: f32) -> f32 {
    let r = t - (t + 0.5).floor();
    let folded = 0.5_f32.copysign(r) - r;
    quarter_sine(4.0 * if r.abs() > 0.25 { folded } else { r })
}

/// `cos(2 pi t)`.
pub fn cosine_of_turns(t: f32) -> f32 {
    let r = t - (t + 0.5).floor();
    quarter_sine(1.0 - 4.0 * r.abs())
}

/// `1 - sin(h) / h` for h = pi x, without cancellation near 0 ("sinc_complement").
pub fn sinc_complement(x: f32) -> f32 {
    let h = PI * x;
    let y = h * h;
    if y < 2.25 {
        let coefficients = [0.166_666_67, -0.008_333_33, 0.000_198_404, -0.000_002_748_742, 0.000_000_022_990_204];
        return y * polynomial(y, coefficients);
    }
    1.0 - sine_of_turns(0.5 * x) / h
}

/// The spherical Bessel function `j1(h) = (sin h - h cos h) / h^2` for h = pi x; its power series where |h| < 1.5.
pub fn bessel_one(x: f32) -> f32 {
    let h = PI * x;
    let y = h * h;
    if y < 2.25 {
        let coefficients =
            [1.0 / 3.0, -1.0 / 30.0, 1.0 / 840.0, -1.0 / 45_360.0, 1.0 / 3_991_680.0, -1.0 / 518_918_400.0];
        return h * polynomial(y, coefficients);
    }
    (sine_of_turns(0.5 * x) - h * cosine_of_turns(0.5 * x)) / y
}
