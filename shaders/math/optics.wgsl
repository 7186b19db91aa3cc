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

// phi_one for t in [0, 1], relative error 1.2e-7 (tables/coefficients.json, "phi_one_unit").
fn phi_one_unit(t: real) -> real {
    return 0.9999999403953552 + t * (-0.49999457597732544 + t * (0.16660521924495697 + t * (-0.041406597942113876
        + t * (0.007823706604540348 - t * 0.0009071576059795916))));
}

// A piece whose extinction runs linearly from front to back, with end depths a = extinction x length >= 0 at its front
// and b at its back, both at most 1. Returns (opacity, share of the front colour in it):
//   opacity = 1 - exp(-(a + b) / 2),  front = int (1 - x) tau'(x) exp(-tau(x)) dx = 1 - psi  (Moreland & Angel 2004),
// emission = front x front colour + (opacity - front) x back colour for linear colour.
// `front` is a polynomial of degree 4 in the mean depth and half the change, its linear part exact (so thin pieces keep
// their digits): error below 3.8e-6 (tables/coefficients.json, "front_share").
fn thin_weights(a: real, b: real) -> real2 {
    let t = 0.5 * (a + b);
    let d = 0.5 * (b - a);
    let level = t * (0.5 + t * (-0.166354700922966 + t * (0.040128421038389206 - t * 0.005898007191717625)));
    let slope = -0.16666666666666666 + t * (0.08324045687913895 + t * (-0.0243208147585392 + t * 0.0041330368258059025));
    let bend = -0.01719428412616253 + t * (0.010519149713218212 - t * 0.004035674501210451);
    let rest = -0.0011748610995709896 + t * 0.00045987413614057004;
    let front = level + d * (slope + d * (bend + d * (rest - d * 0.0004454147710930556)));
    return real2(t * phi_one_unit(t), front);
}
