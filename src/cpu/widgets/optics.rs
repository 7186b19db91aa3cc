//! Exponentials, error functions, and the emission of a piece whose extinction runs linearly: f32 twins of
//! `shaders/math/optics.wgsl` and `psi.wgsl`. Coefficients and their errors: `tables/coefficients.json`. No result is NaN
//! or infinite.

/// Coefficients begin with the constant.
#[inline(always)]
pub fn polynomial<const N: usize>(x: f32, coefficients: [f32; N]) -> f32 {
    let mut from_highest = coefficients.iter().rev();
    let highest = from_highest.next().copied().unwrap_or_default();
    from_highest.fold(highest, |sum, c| sum * x + c)
}

/// `exp(-t)` for t >= 0, without denormals.
#[inline(always)]
pub fn attenuation(t: f32) -> f32 {
    (-t.min(87.0)).exp()
}

/// `(1 - exp(-t)) / t` for t >= 0, 1 at 0. Relative error 1.6e-7 ("phi_one").
#[inline(always)]
pub fn phi_one(t: f32) -> f32 {
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

/// `exp(x^2) erfc(x)` for x >= 0. Relative error 3.0e-7 ("erfcx").
pub fn erfcx(x: f32) -> f32 {
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

/// Dawson's integral `exp(-x^2) int_0^x exp(t^2) dt` for x >= 0. Relative error 4.4e-7 ("dawson_numerator",
/// "dawson_denominator", "dawson_tail").
fn dawson(x: f32) -> f32 {
    if x < 3.0 {
        let y = x * x;
        let p = polynomial(y, [1.000_000_1, -0.038_065_866, 0.032_879_04, 0.001_193_797_9, 0.000_180_232_16]);
        let q = [1.0, 0.628_607_03, 0.185_245_28, 0.033_347_09, 0.003_851_773_7, 0.000_324_835_86];
        return x * p / polynomial(y, q);
    }
    const TAIL: [f32; 9] = [
        1.000_000_1,
        0.499_821_57,
        0.788_571_4,
        -1.263_228_8,
        129.166_67,
        -2_472.171,
        26_553.97,
        -126_146.45,
        201_245.73,
    ];
    0.5 * polynomial(1.0 / (x * x), TAIL) / x
}

/// `int_0^1 exp(-tau(x)) dx`, `tau(x) = a x + (b - a) x^2 / 2` (Moreland & Angel 2004), where a + b >= 4. Absolute error
/// 7.8e-7.
fn psi(a: f32, b: f32) -> f32 {
    // Where a and b are close, both forms tend to the constant piece's.
    let root = (2.0 * (b - a).abs().max(1e-6 * (a + b))).sqrt();
    let (p, r) = (a / root, b / root);
    let rest = attenuation(0.5 * (a + b));
    if b >= a {
        return 1.772_453_9 * (erfcx(p) - rest * erfcx(r)) / root;
    }
    2.0 * (dawson(p) - rest * dawson(r)) / root
}

/// `int (1 - x) exp(-tau(x)) dx` and `int x exp(-tau(x)) dx` for extinctions that run linearly from a (at the front) to b,
/// both times the length: what linear emission at the front and at the back gives (Song et al. 2009, Eq. 2-3, per
/// length). a, b >= 0, their sum below 1e30. Absolute error 1.1e-6.
pub fn emission_weights(a: f32, b: f32) -> [f32; 2] {
    let sum = a + b;
    if sum < 4.0 {
        return thin(a, b, [1.0; 2]);
    }
    let change = b - a;
    let rest = attenuation(0.5 * sum);
    if change.abs() < (0.015 * sum).max(0.15) {
        return emission_weights_level(0.5 * sum, 0.5 * change, rest);
    }
    let mean = psi(a, b);
    let back = ((1.0 - rest - a * mean) / change).max(0.0);
    [(mean - back).max(0.0), back]
}

/// `1 - psi` and `psi - zeta`, zeta = exp(-(a + b) / 2): the shares of the front and back colour where colour and extinction
/// are linear. They sum to the opacity. Absolute error 6.8e-7.
pub fn color_weights(a: f32, b: f32) -> [f32; 2] {
    if a + b < 4.0 {
        return thin(a, b, [a, b]);
    }
    let mean = psi(a, b);
    [1.0 - mean, mean - attenuation(0.5 * (a + b))]
}

/// `int (1 - x) h(x) exp(-tau(x)) dx` and `int x h(x) exp(-tau(x)) dx` for linear h by its ends, by 6-point Gauss-Legendre.
fn thin(a: f32, b: f32, h: [f32; 2]) -> [f32; 2] {
    const NODES: [(f32, f32); 6] = [
        (0.033_765_24, 0.085_662_246),
        (0.169_395_31, 0.180_380_79),
        (0.380_690_4, 0.233_956_97),
        (0.619_309_6, 0.233_956_97),
        (0.830_604_7, 0.180_380_79),
        (0.966_234_74, 0.085_662_246),
    ];
    NODES.iter().fold([0.0; 2], |[front, back], &(x, weight)| {
        let height = (1.0 - x) * h[0] + x * h[1];
        let seen = weight * height * attenuation(x * (a + 0.5 * x * (b - a)));
        [front + (1.0 - x) * seen, back + x * seen]
    })
}

/// For an extinction that hardly changes: second order in half the change, moments `int x^k exp(-m x) dx` by recursion.
/// `mean` >= 2.
fn emission_weights_level(mean: f32, half_change: f32, rest: f32) -> [f32; 2] {
    let inverse = 1.0 / mean;
    let i_zero = (1.0 - rest) * inverse;
    let i_one = (i_zero - rest) * inverse;
    let i_two = (2.0 * i_one - rest) * inverse;
    let i_three = (3.0 * i_two - rest) * inverse;
    let i_four = (4.0 * i_three - rest) * inverse;
    let i_five = (5.0 * i_four - rest) * inverse;
    let half_square = 0.5 * half_change * half_change;
    let all = i_zero + half_change * (i_one - i_two) + half_square * (i_two - 2.0 * i_three + i_four);
    let back = i_one + half_change * (i_two - i_three) + half_square * (i_three - 2.0 * i_four + i_five);
    [(all - back).max(0.0), back.max(0.0)]
}
