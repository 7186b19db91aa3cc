#import math/psi
#import shared/table
#import shared/widgets

// Pieces between the special points of all widgets: ends of ranges, knots, corners, a Gaussian's centre and its standard
// deviations, eighths of a wave's period.

// Pieces at most; the rest is one. (A wave of 1,000 periods has 8,000 special points.)
const MOST_SPECIAL = 1024u;
// Of unweighted emission: least part of a piece between special points, pieces tried, tolerance of the mean transmittance.
const FINEST_GLOW = 4096u;
const MOST_GLOWS = 8192u;
const GLOW_TOLERANCE = 1e-3;

// The nearest of `best` and where u passes `value` after `at`.
fn nearer(best: f32, at: f32, u_front: f32, u_back: f32, value: f32) -> f32 {
    let change = u_back - u_front;
    if abs(change) < 1e-30 {
        return best;
    }
    let x = (value - u_front) / change;
    return select(best, x, x > at + 1e-6 && x < best);
}

fn next_knot(best: f32, at: f32, u_front: f32, u_back: f32, first: u32, count: u32) -> f32 {
    var next = nearer(best, at, u_front, u_back, knots_at(first).x);
    for (var i = first; i < first + count; i++) {
        next = nearer(next, at, u_front, u_back, knots_at(i).z);
    }
    return next;
}

// Where the wave passes the next multiple of 1 / parts of its period, and the feet of narrow tents.
fn next_of_wave(best: f32, at: f32, w: Widget, s: Segment, parts: f32) -> f32 {
    let p_front = phase_at(w, s.front);
    let p_back = phase_at(w, s.back);
    let here = blend(p_front, p_back, at) * parts;
    // Where `here` is a multiple but for rounding, the next may be on either side of it.
    let step = sign(p_back - p_front);
    let multiple = floor(here + 0.5);
    var next = best;
    for (var i = -1.0; i < 2.5; i += 1.0) {
        next = nearer(next, at, p_front, p_back, (multiple + i * step) / parts);
    }
    if TRIANGLES && w.shape == TRIANGLE && w.whiten.w < 1.0 {
        let whole = floor(here / parts);
        for (var i = -1.0; i < 1.5; i += 1.0) {
            next = nearer(next, at, p_front, p_back, whole + i + 0.5 - 0.5 * w.whiten.w);
            next = nearer(next, at, p_front, p_back, whole + i + 0.5 + 0.5 * w.whiten.w);
        }
    }
    return next;
}

// The next special point after `at`; 1 where there is none. `fine`: with a Gaussian's standard deviations and a smooth
// wave's eighths.
fn next_special(s: Segment, at: f32, fine: bool) -> f32 {
    // Those of `next_of_wave`, and of standard deviations.
    turns_taken += widget_count() * (7u + WIDGET_TURNS);
    var next = 1.0;
    for (var k = 0u; k < widget_count(); k++) {
        let w = widget_at(k);
        if RANGES {
            next = nearer(next, at, s.front.x, s.back.x, w.scalar_low);
            next = nearer(next, at, s.front.x, s.back.x, w.scalar_high);
            next = nearer(next, at, s.front.y, s.back.y, w.gradient_low);
            next = nearer(next, at, s.front.y, s.back.y, w.gradient_high);
        }
        if WINDOWS && w.knots.y > 0u {
            next = next_knot(next, at, dot(w.window_direction, s.front), dot(w.window_direction, s.back), w.knots.x,
                             w.knots.y);
        }
        if RAMPS && w.shape == RAMP {
            next = next_knot(next, at, dot(w.whiten.xy, s.front), dot(w.whiten.xy, s.back), w.knots.z, w.knots.w);
        } else if GAUSSIANS && w.shape == GAUSSIAN {
            let a = whitened(w, s.front);
            let step = whitened(w, s.back) - a;
            let square = max(dot(step, step), 1e-30);
            let center = -dot(a, step) / square;
            // One standard deviation is 1 / sqrt(2) in whitened length.
            let sigma = 0.7071067811865476 * inverseSqrt(square);
            if fine {
                for (var j = -3.0; j < 3.5; j += 1.0) {
                    next = nearer(next, at, 0.0, 1.0, center + j * sigma);
                }
            } else {
                next = nearer(next, at, 0.0, 1.0, center);
            }
        } else if TRIANGLES && w.shape == TRIANGLE {
            next = next_of_wave(next, at, w, s, 2.0);
        } else if (COSINES || ARCHES) && w.shape >= COSINE && w.shape <= HALF && (fine || w.shape != COSINE) {
            next = next_of_wave(next, at, w, s, select(2.0, 8.0, fine));
        }
    }
    return next;
}

// Extinction and colour linear between special points (Moreland & Angel 2004); psi evaluated, or from the table.
fn partial_segment(s: Segment) -> vec4f {
    var color = vec3f(0.0);
    var depth = 0.0;
    var start = 0.0;
    for (var i = 0u; i < MOST_SPECIAL; i++) {
        let end = select(next_special(s, start, true), 1.0, i + 1u == MOST_SPECIAL);
        turns_taken += 1u + widget_count() * WIDGET_TURNS;
        var front = vec4f(0.0);
        var back = vec4f(0.0);
        for (var k = 0u; k < widget_count(); k++) {
            let w = widget_at(k);
            let part = active_part(w, s, start, end);
            // All of the piece, or none of it.
            if part.y - part.x > 0.5 * (end - start) {
                let most = min(w.extinction * s.extent, 1e25) * (end - start);
                front += most * profile_at(w, point_at(s, start)) * vec4f(w.color, 1.0);
                back += most * profile_at(w, point_at(s, end)) * vec4f(w.color, 1.0);
            }
        }
        let weights = partial_weights(front.w, back.w);
        color += attenuation(depth) * (weights.x * color_of(front, back) + weights.y * color_of(back, front));
        depth += 0.5 * (front.w + back.w);
        pieces_taken = i + 1u;
        start = end;
        if end >= 1.0 || depth > 16.2 {
            break;
        }
    }
    return vec4f(color, attenuation(depth));
}

// A piece of unweighted emission: extinction linear between its values at the ends, scaled to the exact depth.
struct Glow {
    // Depth at the front and back ends, were the extinction constant.
    shares: vec2f,
    // Sum of the colours that are emitted.
    color: vec3f,
    // Most that the depth of the piece could differ from a line's, up to a factor.
    bend: f32,
}

fn glow(s: Segment, start: f32, end: f32) -> Glow {
    turns_taken += 1u + widget_count() * WIDGET_TURNS;
    var shares = vec2f(0.0);
    var color = vec3f(0.0);
    var bend = 0.0;
    for (var k = 0u; k < widget_count(); k++) {
        let w = widget_at(k);
        let part = active_part(w, s, start, end);
        if part.y - part.x > 0.5 * (end - start) {
            let p = point_at(s, start);
            let q = point_at(s, end);
            let ends = vec2f(profile_at(w, p), profile_at(w, q));
            let sum = ends.x + ends.y;
            shares += select(vec2f(1.0), 2.0 * ends / max(sum, 1e-30), sum > 1e-20) * part_depth(w, s, part);
            if glows(w, point_at(s, 0.5 * (start + end))) {
                color += w.color;
            }
            // Straight profiles are straight between special points.
            let is_straight = (w.shape == UNIFORM || w.shape == TRIANGLE || w.shape == RAMP) && !(WINDOWS && w.knots.y > 0u);
            if !is_straight {
                let range = profile_range(w, p, q);
                bend += min(w.extinction * s.extent, 1e25) * (range.y - range.x);
            }
        }
    }
    return Glow(shares, color, bend * (end - start));
}

// Emission not weighted by extinction (Song et al. 2009, Eq. 4; scene/optics.rs): sum_k c_k int over its support of
// exp(-tau). Cut at special points, where supports end, and halved until extinctions hardly change in a piece (optics.md
// 2.4).
fn unweighted_segment(s: Segment) -> vec4f {
    var color = vec3f(0.0);
    var depth = 0.0;
    // The part between special points, and where in it, in units of its 1 / FINEST_GLOW.
    var low = 0.0;
    var high = next_special(s, 0.0, false);
    var at = 0u;
    var step = FINEST_GLOW;
    pieces_taken = 0u;
    for (var tries = 0u; tries <= MOST_GLOWS; tries++) {
        let last = tries == MOST_GLOWS;
        let start = blend(low, high, f32(at) / f32(FINEST_GLOW));
        let end = select(blend(low, high, f32(at + step) / f32(FINEST_GLOW)), 1.0, last);
        let piece = glow(s, start, end);
        let width = end - start;
        if attenuation(depth) * width * min(piece.bend / 8.0, 1.0) > GLOW_TOLERANCE * sqrt(width) && step > 1u && !last {
            step = step >> 1u;
            continue;
        }
        color += attenuation(depth) * s.extent * width * psi(piece.shares.x, piece.shares.y) * piece.color;
        depth += 0.5 * (piece.shares.x + piece.shares.y);
        pieces_taken += 1u;
        at += step;
        if at >= FINEST_GLOW {
            if high >= 1.0 {
                break;
            }
            low = high;
            high = next_special(s, low, false);
            at = 0u;
            step = FINEST_GLOW;
        } else {
            step = at & (~at + 1u);
        }
        if depth > 16.2 || last {
            break;
        }
    }
    return vec4f(color, attenuation(whole_depth(s)));
}

// Of all widgets over the whole segment: many pieces' rounding adds up.
fn whole_depth(s: Segment) -> f32 {
    turns_taken += widget_count() * WIDGET_TURNS;
    var depth = 0.0;
    for (var k = 0u; k < widget_count(); k++) {
        let w = widget_at(k);
        let part = active_part(w, s, 0.0, 1.0);
        if part.y > part.x {
            depth += part_depth(w, s, part);
        }
    }
    return depth;
}

// Whether a point within the widget's ranges and knots belongs to its support.
fn glows(w: Widget, p: vec2f) -> bool {
    if TRIANGLES && w.shape == TRIANGLE && w.whiten.w < 1.0 {
        return triangle_at(phase_at(w, p), w.whiten.w) > 0.0;
    }
    if ARCHES && w.shape == HALF {
        return arch_at(2.0 * phase_at(w, p), true) > 0.0;
    }
    return true;
}
