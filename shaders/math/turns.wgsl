#import math/real

// Trigonometric functions of turns, and spherical Bessel functions, for means of waves. The built-in functions may err by
// 2^-11; these do not. No result is NaN or infinite.

// sin(pi/2 x) for x in [-1, 1]. Absolute error 1.8e-7, relative near 0 (tables/coefficients.json, "quarter_sine").
fn quarter_sine(x: real) -> real {
    let y = x * x;
    return x * (1.5707963705062866 + y * (-0.645963728427887 + y * (0.07968968152999878 + y * (-0.004673766437917948
        + y * 0.00015148513193707913))));
}

// sin(2 pi t).
fn sine_of_turns(t: real) -> real {
    let r = t - floor(t + 0.5);
    let folded = 0.5 * sign(r) - r;
    return quarter_sine(4.0 * select(r, folded, abs(r) > 0.25));
}

// cos(2 pi t).
fn cosine_of_turns(t: real) -> real {
    let r = t - floor(t + 0.5);
    return quarter_sine(1.0 - 4.0 * abs(r));
}

// 1 - sin(h) / h for h = pi x, without cancellation near 0 (tables/coefficients.json, "sinc_complement").
fn sinc_complement(x: real) -> real {
    let h = 3.141592653589793 * x;
    let y = h * h;
    if y < 2.25 {
        return y * (0.1666666716337204 + y * (-0.008333330042660236 + y * (0.00019840399909298867
            + y * (-0.0000027487419629323995 + y * 0.0000000229902035187024))));
    }
    return 1.0 - sine_of_turns(0.5 * x) / h;
}

// The spherical Bessel function j1(h) = (sin h - h cos h) / h^2 for h = pi x; its power series where |h| < 1.5.
fn bessel_one(x: real) -> real {
    let h = 3.141592653589793 * x;
    let y = h * h;
    if y < 2.25 {
        return h * (0.3333333333333333 + y * (-0.03333333333333333 + y * (0.0011904761904761905
            + y * (-0.000022045855379188714 + y * (0.0000002505210838544172 - y * 0.0000000019270852604185938)))));
    }
    return (sine_of_turns(0.5 * x) - h * cosine_of_turns(0.5 * x)) / y;
}
