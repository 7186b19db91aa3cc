#import math/optics

// Mean transmittance over a piece of a ray, int_0^1 exp(-tau(x)) dx, of one Gaussian or one wave: where emission is not
// weighted by extinction (Song et al. 2009, Eq. 4) its colour is c x length x this. Values of the tables (tables/README.md)
// come as arguments; src/tables/unweighted.rs is the same with the look-ups, and is held to this by a test.
// All depths >= 0; strength = P or a of the tables, in [0, 1e3).

// Where the argument t >= 0 of an axis log(1 + t) / log(1 + 1e3) lies, in [0, 1]. Times nodes - 1 it counts nodes.
fn strength_position(t: real) -> real {
    return clamp(log2(1.0 + t) * 0.1003288150616121, 0.0, 1.0);
}

// Where a finite end depth t >= 0 lies on the axes 1 - (1 + t)^(-1/4) of psi.
fn psi_position(t: real) -> real {
    return 1.0 - exp2(-0.25 * log2(1.0 + t));
}

// The first of the four nodes that a cubic look-up reads; `at` counts nodes, in [0, nodes - 1].
fn cubic_start(at: real, nodes: real) -> real {
    return clamp(floor(at) - 1.0, 0.0, nodes - 4.0);
}

// Catmull-Rom weights of the four nodes from cubic_start on, offset = at - cubic_start in [0, 3]. Beyond an edge stands the
// parabola through the three nodes at it.
fn cubic_weights(offset: real) -> real4 {
    let mirrored = offset > 2.0;
    let from_edge = select(offset, 3.0 - offset, mirrored);
    let at_edge = from_edge < 1.0;
    let t = select(from_edge - 1.0, from_edge, at_edge);
    let before = t * (-0.5 + t * (1.0 - 0.5 * t));
    let begin = 1.0 + t * t * (1.5 * t - 2.5);
    let end = t * (0.5 + t * (2.0 - 1.5 * t));
    let after = t * t * (0.5 * t - 0.5);
    let inner = real4(before, begin, end, after);
    let edge = real4(begin + 3.0 * before, end - 3.0 * before, after + before, 0.0);
    let w = select(inner, edge, vec4<bool>(at_edge));
    return select(w, real4(w.w, w.z, w.y, w.x), vec4<bool>(mirrored));
}

// True for pieces that take mean_transmittance_short: the error of a look-up is divided by the extent.
fn is_short(extent: real, depth: real) -> bool {
    return extent < 1.0 && depth < 1.0;
}

// A piece's mean transmittance from its exact depths up to its shares 0.0469100770306680, 0.2307653449471585, 0.5,
// 0.7692346550528415 and 0.9530899229693320: 5-point Gauss-Legendre.
fn mean_transmittance_short(to_a: real, to_b: real, to_c: real, to_d: real, to_e: real) -> real {
    return 0.1184634425280945 * (attenuation(to_a) + attenuation(to_e))
        + 0.2393143352496832 * (attenuation(to_b) + attenuation(to_d))
        + 0.2844444444444444 * attenuation(to_c);
}

// A Gaussian along the whitened coordinate [start, start + extent]: lengths in front of -4 and beyond 4, where nothing is
// taken to be, and the ends of the rest, which the table J(P, v) is looked up at.
// P = length x peak extinction x exp(-q^2) sqrt(pi) / (2 extent).
fn gaussian_span(start: real, extent: real) -> real4 {
    let stop = start + extent;
    return real4(clamp(-4.0 - start, 0.0, extent), clamp(stop - 4.0, 0.0, extent), clamp(start, -4.0, 4.0),
        clamp(stop, -4.0, 4.0));
}

// Its mean transmittance; j_start and j_end are J at span.z and span.w, depth the piece's.
fn mean_transmittance_gaussian(span: real4, extent: real, j_start: real, j_end: real, depth: real) -> real {
    let rest = attenuation(depth);
    return clamp((span.x + (j_start - rest * j_end) + rest * span.y) / extent, 0.0, 1.0);
}

// A wave whose period is `turn` long (pi for |sin|, 2 pi for (1 - cos) / 2), from `start` over `periods` >= 0 periods: the
// ends' phases in [0, turn], which the table K(a, u) is looked up at, and how many periods start within.
// a = length x peak extinction / (turn x periods). Where the coordinate falls along the ray, `start` is negated.
fn wave_span(start: real, periods: real, turn: real) -> real3 {
    let first = start - floor(start);
    let last = first + periods;
    let starts = floor(last);
    return real3(turn * first, turn * (last - starts), starts);
}

// Its mean transmittance. k = K at span.x, at span.y and at 0; rest, period and depth: the depths of the first period's rest
// (from the profile's closed-form mean: the built-in sine is not exact enough times 1e3), of a period (2 a for |sin|, pi a
// for the other) and of the piece. What is left of the first period, the following ones as a geometric series, less what the
// last one has beyond the piece.
fn mean_transmittance_wave(span: real3, extent: real, k: real3, rest: real, period: real, depth: real) -> real {
    let series = span.z * phi_one(span.z * period) / phi_one(period);
    let seen = k.x + attenuation(rest) * k.z * series - attenuation(depth) * k.y;
    return clamp(seen / extent, 0.0, 1.0);
}
