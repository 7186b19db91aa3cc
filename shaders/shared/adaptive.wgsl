#import math/psi
#import shared/widgets

// Sums of widgets, integrated to a tolerance of the colour: exact depths, dyadic bisection front to back where a proven
// bound of the colour's error says so (optics.md 4.1). The opacity is exact whatever is done.

// Largest error of a channel, for colours up to 1.
override TOLERANCE: f32 = 1e-3;

// The bound over-estimates: with this factor the worst of 3,000 cases errs by 0.63 of the tolerance.
const SLACK = 1.4;
// Pieces are no shorter than 1 / FINEST.
const FINEST = 65536u;
// Pieces tried, after which the rest is one piece. (lavapipe ends any loop after 65,535 turns.)
const MOST_TRIES = 2048u;
// Widgets at most (gpu/widgets.rs).
const SLOTS = 64u;

// A piece as its widgets' exact depths show it.
struct Depths {
    total: f32,
    // Mean colour, weighted by depth.
    color: vec3f,
    // sum_k f_k |c_k - color|, f_k the widget's share of the depth.
    spread: vec3f,
    // max_k |c_k - color| over widgets that have depth.
    reach: vec3f,
}

// The depths of all widgets over [start, end], and sums of them.
fn measure(s: Segment, start: f32, end: f32, depths: ptr<function, array<f32, SLOTS>>) -> Depths {
    turns_taken += 2u * widget_count() * WIDGET_TURNS;
    var total = 0.0;
    var emission = vec3f(0.0);
    for (var k = 0u; k < widget_count(); k++) {
        let w = widget_at(k);
        let part = active_part(w, s, start, end);
        var depth = 0.0;
        if part.y > part.x {
            depth = part_depth(w, s, part);
        }
        (*depths)[k] = depth;
        total += depth;
        emission += depth * w.color;
    }
    if !(total > 0.0) {
        return Depths(0.0, vec3f(0.0), vec3f(0.0), vec3f(0.0));
    }
    let color = emission / total;
    var spread = vec3f(0.0);
    var reach = vec3f(0.0);
    for (var k = 0u; k < widget_count(); k++) {
        let depth = (*depths)[k];
        if depth > 0.0 {
            let off = abs(widget_at(k).color - color);
            spread += depth * off;
            reach = max(reach, off);
        }
    }
    return Depths(total, color, spread / total, reach);
}

fn largest(v: vec3f) -> f32 {
    return max(v.x, max(v.y, v.z));
}

// Bounds of the local colour: each widget's extinction lies between what it is at least and at most on the piece; the
// extremes of the weighted mean put every colour beyond a threshold at one end and the others at the other. Fixed-point
// steps find the threshold; were they too few, the widgets' own extremes bound it.
fn color_range(s: Segment, start: f32, end: f32, depths: ptr<function, array<f32, SLOTS>>) -> vec3f {
    var ranges: array<vec2f, SLOTS>;
    var low = vec3f(1e30);
    var high = vec3f(-1e30);
    for (var k = 0u; k < widget_count(); k++) {
        if (*depths)[k] > 0.0 {
            let w = widget_at(k);
            let part = active_part(w, s, start, end);
            var range = profile_range(w, point_at(s, part.x), point_at(s, part.y));
            if part.x > start || part.y < end {
                range.x = 0.0;
            }
            // A hair wider than computed.
            ranges[k] = min(w.extinction, 1e25) * range * vec2f(0.999999, 1.000001);
            low = min(low, w.color);
            high = max(high, w.color);
        }
    }
    // From the widgets' extremes of the other side: every step moves outwards.
    turns_taken += widget_count() * WIDGET_TURNS;
    var most = low;
    var least = high;
    var settled = false;
    for (var turn = 0u; turn < 8u && !settled; turn++) {
        turns_taken += 1u + widget_count();
        var most_emission = vec3f(0.0);
        var most_extinction = vec3f(1e-30);
        var least_emission = vec3f(0.0);
        var least_extinction = vec3f(1e-30);
        for (var k = 0u; k < widget_count(); k++) {
            if (*depths)[k] > 0.0 {
                let range = ranges[k];
                let color = widget_at(k).color;
                let for_most = select(vec3f(range.x), vec3f(range.y), color > most);
                let for_least = select(vec3f(range.x), vec3f(range.y), color < least);
                most_emission += for_most * color;
                most_extinction += for_most;
                least_emission += for_least * color;
                least_extinction += for_least;
            }
        }
        let next_most = max(most, most_emission / most_extinction);
        let next_least = min(least, least_emission / least_extinction);
        settled = largest(next_most - most) < 1e-4 && largest(least - next_least) < 1e-4;
        most = next_most;
        least = next_least;
    }
    if !settled {
        return high - low;
    }
    return most - least;
}

// Emission that leaves the front of a piece: exact depths, and every widget linear between its extinctions at the ends,
// scaled to its depth.
fn piece_emission(s: Segment, start: f32, end: f32, d: Depths, depths: ptr<function, array<f32, SLOTS>>) -> vec3f {
    // One colour, or little that is seen.
    if largest(d.spread) * min(d.total, 1.0) < 1e-6 {
        return d.color * (d.total * phi_one(d.total));
    }
    turns_taken += widget_count() * WIDGET_TURNS;
    var front = 0.0;
    var back = 0.0;
    var front_emission = vec3f(0.0);
    var back_emission = vec3f(0.0);
    for (var k = 0u; k < widget_count(); k++) {
        let depth = (*depths)[k];
        if depth > 0.0 {
            let w = widget_at(k);
            let part = active_part(w, s, start, end);
            var ends = vec2f(0.0);
            if part.x <= start {
                ends.x = profile_at(w, point_at(s, start));
            }
            if part.y >= end {
                ends.y = profile_at(w, point_at(s, end));
            }
            let sum = ends.x + ends.y;
            // Where the ends say nothing of the depth, it is spread evenly.
            let share = select(vec2f(1.0), 2.0 * ends / max(sum, 1e-30), sum > 1e-20) * depth;
            front += share.x;
            back += share.y;
            front_emission += share.x * w.color;
            back_emission += share.y * w.color;
        }
    }
    let weights = emission_weights(front, back);
    return weights.x * front_emission + weights.y * back_emission;
}

// Premultiplied colour and transmittance.
fn adaptive_segment(s: Segment) -> vec4f {
    var depths: array<f32, SLOTS>;
    var whole = 0.0;
    var color = vec3f(0.0);
    // Of what lies before `at`, in units of 1 / FINEST.
    var seen = 1.0;
    var at = 0u;
    var step = FINEST;
    // Sum of the bounds of the pieces taken, in units of the tolerance.
    var spent = 0.0;
    pieces_taken = 0u;
    for (var tries = 0u; tries <= MOST_TRIES; tries++) {
        let last = tries == MOST_TRIES;
        if last {
            step = FINEST - at;
        }
        let start = f32(at) / f32(FINEST);
        let end = f32(at + step) / f32(FINEST);
        let d = measure(s, start, end, &depths);
        if tries == 0u {
            whole = d.total;
        }
        let opacity = d.total * phi_one(d.total);
        // What pieces in front left over may be spent, too.
        let allowed = SLACK * TOLERANCE * max(sqrt(end - start), sqrt(end) - spent);
        var bound = seen * opacity * min(0.5 * d.total * d.spread, d.reach);
        if largest(bound) > allowed && step > 1u && !last {
            bound = min(bound, seen * opacity * 0.25 * d.total * color_range(s, start, end, &depths));
        }
        if largest(bound) > allowed && step > 1u && !last {
            step = step >> 1u;
            continue;
        }
        color += seen * piece_emission(s, start, end, d, &depths);
        seen *= attenuation(d.total);
        spent += largest(bound) / TOLERANCE;
        pieces_taken += 1u;
        at += step;
        if at >= FINEST || seen < 1e-7 {
            break;
        }
        // As long as alignment allows.
        step = at & (~at + 1u);
    }
    return vec4f(color, attenuation(whole));
}
