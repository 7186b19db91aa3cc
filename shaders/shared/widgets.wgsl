#import math/optics
#import math/ramp
#import math/waves
#import math/widget

// Widgets over (scalar, gradient magnitude) and what they are along a straight segment in that plane. Whoever imports this
// says where they are kept: `widget_count`, `widget_at`, `knots_at`.

struct Widget {
    // Gaussian: whitening, a row-major 2 x 2 matrix that brings it to exp(-|p|^2). Waves: phase per unit of scalar and of
    // gradient, phase at `center`, duty. Ramp: direction.
    whiten: vec4f,
    // Waves: a point near one of phase 0, from which phases are taken.
    center: vec2f,
    // Where profile and window are 1.
    extinction: f32,
    shape: u32,
    color: vec3f,
    pad_a: f32,
    // Closed ranges.
    scalar_low: f32,
    scalar_high: f32,
    gradient_low: f32,
    gradient_high: f32,
    window_direction: vec2f,
    pad_b: vec2f,
    // First piece and number of pieces of the window, and of the ramp; none of a window: no window.
    knots: vec4u,
}

// The enum of the host (gpu/widgets.rs).
const UNIFORM = 0u;
const GAUSSIAN = 1u;
const TRIANGLE = 2u;
const COSINE = 3u;
const ARCH = 4u;
const HALF = 5u;
const RAMP = 6u;

// What any widget of the scene is or has; the rest is compiled away.
override GAUSSIANS: bool = false;
override TRIANGLES: bool = false;
override COSINES: bool = false;
override ARCHES: bool = false; // and halves
override RAMPS: bool = false;
override WINDOWS: bool = false;
override RANGES: bool = false;
// Gradient magnitudes matter.
override BIVARIATE: bool = false;

// Pieces that the last segment took.
var<private> pieces_taken: u32;
// Turns of loops that the invocation took, at most: what bounds the length of a dispatch counts them.
var<private> turns_taken: u32;
// For one widget.
override WIDGET_TURNS: u32 = 1u;

// A ray in one cell: (scalar, gradient magnitude) at its ends, and its length.
struct Segment {
    front: vec2f,
    back: vec2f,
    extent: f32,
}

// Between the ends, exact at both.
fn blend(front: f32, back: f32, x: f32) -> f32 {
    let change = back - front;
    return select(front + x * change, back - (1.0 - x) * change, x > 0.5);
}

fn point_at(s: Segment, x: f32) -> vec2f {
    return vec2f(blend(s.front.x, s.back.x, x), blend(s.front.y, s.back.y, x));
}

fn phase_at(w: Widget, p: vec2f) -> f32 {
    return dot(w.whiten.xy, p - w.center) + w.whiten.z;
}

fn whitened(w: Widget, p: vec2f) -> vec2f {
    let d = p - w.center;
    return vec2f(dot(w.whiten.xy, d), dot(w.whiten.zw, d));
}

// The part of [start, end] where the widget is: x to y, empty where x >= y.
fn active_part(w: Widget, s: Segment, start: f32, end: f32) -> vec2f {
    var part = vec2f(start, end);
    if RANGES {
        part = clip_to_range(part, s.front.x, s.back.x, w.scalar_low, w.scalar_high);
        if BIVARIATE {
            part = clip_to_range(part, s.front.y, s.back.y, w.gradient_low, w.gradient_high);
        }
    }
    if WINDOWS && w.knots.y > 0u {
        let low = knots_at(w.knots.x).x;
        let high = knots_at(w.knots.x + w.knots.y - 1u).z;
        part = clip_to_range(part, dot(w.window_direction, s.front), dot(w.window_direction, s.back), low, high);
    }
    if RAMPS && w.shape == RAMP {
        let low = knots_at(w.knots.z).x;
        let high = knots_at(w.knots.z + w.knots.w - 1u).z;
        part = clip_to_range(part, dot(w.whiten.xy, s.front), dot(w.whiten.xy, s.back), low, high);
    }
    return part;
}

// A piecewise-linear function at u, which lies between its outer knots.
fn knots_value(first: u32, count: u32, u: f32) -> f32 {
    var i = first;
    let last = first + count - 1u;
    while i < last && u > knots_at(i).z {
        i += 1u;
    }
    return line_at(knots_at(i), u);
}

// Profile times window at a point where the widget is.
fn profile_at(w: Widget, p: vec2f) -> f32 {
    var value = 1.0;
    if GAUSSIANS && w.shape == GAUSSIAN {
        let q = whitened(w, p);
        value = attenuation(dot(q, q));
    } else if TRIANGLES && w.shape == TRIANGLE {
        value = triangle_at(phase_at(w, p), w.whiten.w);
    } else if COSINES && w.shape == COSINE {
        value = cosine_at(phase_at(w, p));
    } else if ARCHES && w.shape == ARCH {
        value = arch_at(phase_at(w, p), false);
    } else if ARCHES && w.shape == HALF {
        value = arch_at(2.0 * phase_at(w, p), true);
    } else if RAMPS && w.shape == RAMP {
        value = knots_value(w.knots.z, w.knots.w, dot(w.whiten.xy, p));
    }
    if WINDOWS && w.knots.y > 0u {
        value *= knots_value(w.knots.x, w.knots.y, dot(w.window_direction, p));
    }
    return value;
}

// Mean of the profile from p to q, all of it where the widget is, times a linear weight.
fn profile_mean(w: Widget, p: vec2f, q: vec2f, weights: vec2f) -> f32 {
    if GAUSSIANS && w.shape == GAUSSIAN {
        return gaussian_product_mean(whitened(w, p), whitened(w, q), weights);
    }
    if (TRIANGLES || COSINES || ARCHES) && w.shape >= TRIANGLE && w.shape <= HALF {
        let phases = vec2f(phase_at(w, p), phase_at(w, q));
        if TRIANGLES && w.shape == TRIANGLE {
            return triangle_mean(phases, weights, w.whiten.w);
        }
        if COSINES && w.shape == COSINE {
            return cosine_mean(phases, weights);
        }
        let alternate = w.shape == HALF;
        return arch_mean(phases * select(1.0, 2.0, alternate), weights, alternate);
    }
    if RAMPS && w.shape == RAMP {
        return ramp_mean(w, dot(w.whiten.xy, p), dot(w.whiten.xy, q), weights);
    }
    return 0.5 * (weights.x + weights.y);
}

fn ramp_mean(w: Widget, start: f32, end: f32, weights: vec2f) -> f32 {
    if abs(end - start) < 1e-30 {
        return 0.5 * (weights.x + weights.y) * knots_value(w.knots.z, w.knots.w, start);
    }
    var sum = 0.0;
    for (var i = w.knots.z; i < w.knots.z + w.knots.w; i++) {
        let piece = knots_at(i);
        let part = clip_to_range(vec2f(0.0, 1.0), start, end, piece.x, piece.z);
        if part.y > part.x {
            let values = vec2f(line_at(piece, blend(start, end, part.x)), line_at(piece, blend(start, end, part.y)));
            let tilted = vec2f(blend(weights.x, weights.y, part.x), blend(weights.x, weights.y, part.y));
            sum += (part.y - part.x) * linear_product_mean(values, tilted);
        }
    }
    return sum;
}

// The widget's optical depth over `part`, where all of it is the widget's (active_part). Exact but for rounding; never a
// difference of antiderivatives.
fn part_depth(w: Widget, s: Segment, part: vec2f) -> f32 {
    var sum = 0.0;
    if WINDOWS && w.knots.y > 0u {
        let u_front = dot(w.window_direction, s.front);
        let u_back = dot(w.window_direction, s.back);
        let level = abs(u_back - u_front) < 1e-30;
        for (var i = w.knots.x; i < w.knots.x + w.knots.y; i++) {
            let piece = knots_at(i);
            let inner = clip_to_range(part, u_front, u_back, piece.x, piece.z);
            if inner.y > inner.x {
                let weights = vec2f(line_at(piece, blend(u_front, u_back, inner.x)),
                                    line_at(piece, blend(u_front, u_back, inner.y)));
                sum += (inner.y - inner.x) * profile_mean(w, point_at(s, inner.x), point_at(s, inner.y), weights);
                // Where two pieces meet, a level segment lies in both.
                if level {
                    break;
                }
            }
        }
    } else {
        sum = (part.y - part.x) * profile_mean(w, point_at(s, part.x), point_at(s, part.y), vec2f(1.0));
    }
    // Absurd extinctions stay finite.
    return min(w.extinction * s.extent, 1e25) * max(sum, 0.0);
}

// Least and largest profile times window between p and q, all of it where the widget is.
fn profile_range(w: Widget, p: vec2f, q: vec2f) -> vec2f {
    var range = vec2f(1.0);
    if GAUSSIANS && w.shape == GAUSSIAN {
        let a = whitened(w, p);
        let b = whitened(w, q);
        let step = b - a;
        let nearest = a + clamp(-dot(a, step) / max(dot(step, step), 1e-30), 0.0, 1.0) * step;
        range = vec2f(attenuation(max(dot(a, a), dot(b, b))), attenuation(min(dot(nearest, nearest), dot(a, a))));
    } else if (TRIANGLES || COSINES || ARCHES) && w.shape >= TRIANGLE && w.shape <= HALF {
        range = wave_range(w, phase_at(w, p), phase_at(w, q));
    } else if RAMPS && w.shape == RAMP {
        range = knots_range(w.knots.z, w.knots.w, dot(w.whiten.xy, p), dot(w.whiten.xy, q));
    }
    if WINDOWS && w.knots.y > 0u {
        range *= knots_range(w.knots.x, w.knots.y, dot(w.window_direction, p), dot(w.window_direction, q));
    }
    return range;
}

fn wave_range(w: Widget, start: f32, end: f32) -> vec2f {
    let low = min(start, end);
    let high = max(start, end);
    var ends: vec2f;
    var valley = floor(high) > floor(low);
    var peak = floor(high + 0.5) > floor(low + 0.5);
    if TRIANGLES && w.shape == TRIANGLE {
        ends = vec2f(triangle_at(low, w.whiten.w), triangle_at(high, w.whiten.w));
    } else if COSINES && w.shape == COSINE {
        ends = vec2f(cosine_at(low), cosine_at(high));
    } else if w.shape == HALF {
        ends = vec2f(arch_at(2.0 * low, true), arch_at(2.0 * high, true));
        valley = floor(2.0 * high) > floor(2.0 * low);
        peak = floor(high - 0.25) > floor(low - 0.25);
    } else {
        ends = vec2f(arch_at(low, false), arch_at(high, false));
    }
    return vec2f(select(min(ends.x, ends.y), 0.0, valley), select(max(ends.x, ends.y), 1.0, peak));
}

fn knots_range(first: u32, count: u32, start: f32, end: f32) -> vec2f {
    let a = knots_value(first, count, start);
    let b = knots_value(first, count, end);
    var range = vec2f(min(a, b), max(a, b));
    for (var i = first; i + 1u < first + count; i++) {
        let knot = knots_at(i).zw;
        if knot.x > min(start, end) && knot.x < max(start, end) {
            range = vec2f(min(range.x, knot.y), max(range.y, knot.y));
        }
    }
    return range;
}
