#import math/optics

// Emission of a piece whose extinction runs linearly from a (at its front) to b (at its back), both times the length:
// tau(x) = a x + (b - a) x^2 / 2 for x in [0, 1]. Any a, b >= 0; sums below 1e30.

// Dawson's integral exp(-x^2) int_0^x exp(t^2) dt for x >= 0. Relative error 4.4e-7 (tables/coefficients.json,
// "dawson_numerator", "dawson_denominator", "dawson_tail").
fn dawson(x: real) -> real {
    if x < 3.0 {
        return dawson_near(x);
    }
    return dawson_far(x);
}

fn dawson_near(x: real) -> real {
    let y = x * x;
    let p = 1.0000001192092896 + y * (-0.03806586563587189 + y * (0.03287903964519501 + y * (0.0011937979143112898
        + y * 0.0001802321639843285)));
    let q = 1.0 + y * (0.6286070346832275 + y * (0.18524527549743652 + y * (0.03334708884358406
        + y * (0.0038517736829817295 + y * 0.00032483585528098047))));
    return x * p / q;
}

fn dawson_far(x: real) -> real {
    let y = 1.0 / (x * x);
    let p = 1.0000001192092896 + y * (0.49982157349586487 + y * (0.7885714173316956 + y * (-1.2632287740707397
        + y * (129.1666717529297 + y * (-2472.171142578125 + y * (26553.970703125 + y * (-126146.453125
        + y * 201245.734375)))))));
    return 0.5 * p / x;
}

// int_0^1 exp(-tau(x)) dx (Moreland & Angel 2004). Absolute error 7.8e-7, relative 1.5e-6.
fn psi(a: real, b: real) -> real {
    if a + b < 3.0 {
        return psi_thin(a, b);
    }
    // Where a and b are close, both forms tend to the constant piece's.
    let root = sqrt(2.0 * max(abs(b - a), 1e-6 * (a + b)));
    let p = a / root;
    let r = b / root;
    let rest = attenuation(0.5 * (a + b));
    if b >= a {
        return 1.7724538509055159 * (erfcx(p) - rest * erfcx(r)) / root;
    }
    return 2.0 * (dawson(p) - rest * dawson(r)) / root;
}

// The same where a + b < 3: 5-point Gauss-Legendre.
fn psi_thin(a: real, b: real) -> real {
    let slope = 0.5 * (b - a);
    return 0.1184634425280945 * (attenuation(0.0469100770306680 * (a + 0.0469100770306680 * slope))
                                 + attenuation(0.9530899229693320 * (a + 0.9530899229693320 * slope)))
        + 0.2393143352496832 * (attenuation(0.2307653449471585 * (a + 0.2307653449471585 * slope))
                                + attenuation(0.7692346550528415 * (a + 0.7692346550528415 * slope)))
        + 0.2844444444444444 * attenuation(0.5 * (a + 0.5 * slope));
}

// int (1 - x) h(x) exp(-tau(x)) dx and int x h(x) exp(-tau(x)) dx for linear h, by 6-point Gauss-Legendre; `h` holds its
// values at the ends.
fn parts_thin(a: real, b: real, h: real2) -> real2 {
    return parts_node(a, b, h, 0.0337652428984240, 0.0856622461895852)
        + parts_node(a, b, h, 0.1693953067668677, 0.1803807865240693)
        + parts_node(a, b, h, 0.3806904069584015, 0.2339569672863455)
        + parts_node(a, b, h, 0.6193095930415985, 0.2339569672863455)
        + parts_node(a, b, h, 0.8306046932331323, 0.1803807865240693)
        + parts_node(a, b, h, 0.9662347571015760, 0.0856622461895852);
}

fn parts_node(a: real, b: real, h: real2, x: real, weight: real) -> real2 {
    let y = 1.0 - x;
    let value = weight * (y * h.x + x * h.y) * attenuation(x * (a + 0.5 * x * (b - a)));
    return real2(y * value, x * value);
}

// int (1 - x) tau'(x) exp(-tau(x)) dx = 1 - psi and int x tau'(x) exp(-tau(x)) dx = psi - zeta, zeta = exp(-tau(1)): the
// shares of the front and back colour where the colour is linear. They sum to the opacity. Absolute error 6.8e-7,
// relative 1.6e-6 for thin pieces too.
fn color_weights(a: real, b: real) -> real2 {
    if a + b < 4.0 {
        return parts_thin(a, b, real2(a, b));
    }
    let mean = psi(a, b);
    return real2(1.0 - mean, mean - attenuation(0.5 * (a + b)));
}

// (F, B) = int (1 - x) exp(-tau(x)) dx and int x exp(-tau(x)) dx: what linear emission at the front and back ends gives
// (Song et al. 2009, Eq. 2-3, per length). a F + b B is the opacity. Absolute error 1.1e-6; of a F and b B, 7.4e-6.
fn emission_weights(a: real, b: real) -> real2 {
    let sum = a + b;
    if sum < 4.0 {
        return parts_thin(a, b, real2(1.0, 1.0));
    }
    let change = b - a;
    let rest = attenuation(0.5 * sum);
    if abs(change) < max(0.015 * sum, 0.15) {
        return emission_weights_level(0.5 * sum, 0.5 * change, rest);
    }
    let mean = psi(a, b);
    let back = max((1.0 - rest - a * mean) / change, 0.0);
    return real2(max(mean - back, 0.0), back);
}

// The same for an extinction that hardly changes: second order in half the change, moments int x^k exp(-m x) dx by
// recursion. `mean` >= 2.
fn emission_weights_level(mean: real, half_change: real, rest: real) -> real2 {
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
    return real2(max(all - back, 0.0), max(back, 0.0));
}
