#import math/real

// Exponentials and the weights of emission-absorption over a short piece. No result is NaN or infinite.

// exp(-t) for t >= 0, without denormals.
fn attenuation(t: real) -> real {
    return exp(-min(t, 87.0));
}

// (1 - exp(-t)) / t for t >= 0, 1 at 0. Relative error 1.6e-7 (coefficients: tables/coefficients.json, "phi_one").
fn phi_one(t: real) -> real {
    if t < 1.0 {
        return phi_one_thin(t);
    }
    return (1.0 - attenuation(t)) / t;
}

// The same for t in [0, 1]: a polynomial alone.
fn phi_one_thin(t: real) -> real {
    return 1.0 + t * (-0.5 + t * (0.16666649281978607 + t * (-0.04166533425450325 + t * (0.008328143507242203
        + t * (-0.0013777663698419929 + t * (0.00018494231335353106 - t * 0.000015930938388919458))))));
}

// exp(x^2) erfc(x) for x >= 0. Relative error 3.0e-7 (tables/coefficients.json, "erfcx").
fn erfcx(x: real) -> real {
    let u = (x - 2.0) / (x + 2.0);
    let p = 1.2769783735275269 + u * (-0.09276308119297028 + u * (-0.16603152453899384 + u * (0.164035826921463
        + u * (-0.05420825630426407 + u * (-0.007942667230963707 + u * (0.008678225800395012
        + u * (0.0010430774418637156 + u * (-0.0013827260117977858 + u * (-0.00018362673290539533
        + u * 0.00015546013310085982)))))))));
    return p / (1.0 + 2.0 * x);
}

// phi_one for t in [0, 1/2], relative error 1.1e-7 (tables/coefficients.json, "phi_one_half").
fn phi_one_half(t: real) -> real {
    return 0.9999999403953552 + t * (-0.49999240040779114 + t * (0.16654734313488007 + t * (-0.04099874943494797
        + t * 0.006768545601516962)));
}

// A piece whose extinction runs linearly from front to back, with end depths a = extinction x length >= 0 at its front
// and b at its back and (a + b) / 2 <= 1/2. Returns (opacity, share of the front colour in it):
//   opacity = 1 - exp(-(a + b) / 2),  front = int (1 - x) tau'(x) exp(-tau(x)) dx = 1 - psi  (Moreland & Angel 2004),
// emission = front x front colour + (opacity - front) x back colour for linear colour.
// psi by 3-point Gauss-Legendre: error of `front` below 1.0e-5, the worst at a = 1, b = 0.
fn thin_weights(a: real, b: real) -> real2 {
    let half_slope = 0.5 * (b - a);
    let t_lo = 0.1127016653792583 * (a + 0.1127016653792583 * half_slope);
    let t_mid = 0.5 * (a + 0.5 * half_slope);
    let t_hi = 0.8872983346207417 * (a + 0.8872983346207417 * half_slope);
    let t = 0.5 * (a + b);
    let front = (t_lo * phi_one_half(t_lo) + t_hi * phi_one_half(t_hi)) * 0.2777777777777778
        + t_mid * phi_one_half(t_mid) * 0.4444444444444444;
    return real2(t * phi_one_half(t), front);
}
