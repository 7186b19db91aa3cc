#import math/optics

// Means of widget profiles over a straight segment in the (scalar, gradient magnitude) plane.

// Mean of exp(-|p|^2) over the segment from `p_front` to `p_back` (whitened coordinates, |p| <= 1e15).
// Absolute error 2.6e-7.
fn gaussian_mean(p_front: real2, p_back: real2) -> real {
    return gaussian_product_mean(p_front, p_back, real2(1.0, 1.0));
}

// The same times a weight that runs linearly from weights.x to weights.y.
// Never a difference of error functions: scaled complements share no leading digits (optics.md 2.2).
fn gaussian_product_mean(p_front: real2, p_back: real2, weights: real2) -> real {
    let step = p_back - p_front;
    let extent = length(step);
    // A segment without extent may run any way.
    let along = select(real2(1.0, 0.0), step / max(extent, 1e-18), vec2<bool>(extent > 1e-18));
    // From the end nearer to the centre: rounding is relative to its coordinates.
    let from_back = dot(p_back, p_back) < dot(p_front, p_front);
    let near_end = select(p_front, -p_back, vec2<bool>(from_back));
    let near_weight = select(weights.x, weights.y, from_back);
    let tilt = select(weights.y, weights.x, from_back) - near_weight;
    let v_start = dot(near_end, along);
    let across = near_end.x * along.y - near_end.y * along.x;
    let q = across * across;
    let v_end = v_start + extent;
    if extent < 1.0 && extent * abs(v_start + v_end) < 2.0 {
        return gaussian_mean_short(v_start, extent, q, near_weight, tilt);
    }
    let a = min(abs(v_start), abs(v_end));
    let b = max(abs(v_start), abs(v_end));
    let edge_a = attenuation(a * a + q);
    let edge_b = attenuation(b * b + q);
    let tail_a = edge_a * erfcx(a);
    let tail_b = edge_b * erfcx(b);
    let same_side = v_start * v_end > 0.0;
    let area = select(2.0 * attenuation(q) - tail_a - tail_b, tail_a - tail_b, same_side);
    let mean = 0.8862269254527580 * area / extent;
    var product = near_weight * mean;
    if tilt != 0.0 {
        // |v_start| is a: the near end.
        product += tilt * max(0.5 * (edge_a - edge_b) / extent - v_start * mean, 0.0) / extent;
    }
    return product;
}

// The same over [v, v + extent] at distance sqrt(q), for short extents: 5-point Gauss-Legendre.
fn gaussian_mean_short(v: real, extent: real, q: real, weight: real, tilt: real) -> real {
    let a = v + extent * 0.0469100770306680;
    let b = v + extent * 0.2307653449471585;
    let c = v + extent * 0.5;
    let d = v + extent * 0.7692346550528415;
    let e = v + extent * 0.9530899229693320;
    let at_a = attenuation(a * a + q);
    let at_b = attenuation(b * b + q);
    let at_d = attenuation(d * d + q);
    let at_e = attenuation(e * e + q);
    let outer = 0.1184634425280945 * (at_a + at_e);
    let inner = 0.2393143352496832 * (at_b + at_d);
    let mean = outer + inner + 0.2844444444444444 * attenuation(c * c + q);
    var product = weight * mean;
    if tilt != 0.0 {
        // Nodes lie 0.5 -+ 0.4530899229693320 and 0.5 -+ 0.2692346550528415 from the start.
        product += tilt * (0.5 * mean + 0.1184634425280945 * 0.4530899229693320 * (at_e - at_a)
                           + 0.2393143352496832 * 0.2692346550528415 * (at_d - at_b));
    }
    return product;
}

// The part of [0, 1] where front + x (back - front) lies in [low, high], intersected with `within` (start, end);
// empty where start > end.
fn clip_to_range(within: real2, front: real, back: real, low: real, high: real) -> real2 {
    let change = back - front;
    if abs(change) < 1e-30 {
        if front >= low && front <= high {
            return within;
        }
        return real2(1.0, 0.0);
    }
    let x_low = (low - front) / change;
    let x_high = (high - front) / change;
    return real2(max(within.x, min(x_low, x_high)), min(within.y, max(x_low, x_high)));
}
