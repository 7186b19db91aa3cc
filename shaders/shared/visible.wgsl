#import math/unweighted
#import shared/special

// Unweighted emission of one Gaussian or wave, from tables of visible lengths (tables/README.md; Song et al. 2009, sections
// 3.3 and 4, which tabulates antiderivatives instead).

// J(P, v), K(a, u) of |sin| and K(a, u) of (1 - cos) / 2, one behind the other: strengths fastest. Empty where INTEGRAL and
// emission need none.
@group(2) @binding(7) var<storage, read> visible_lengths: array<f32>;

// Along an axis.
override TABLE_NODES: u32;
// Where the tables end.
override MOST_STRENGTH: f32;

// Cubic from 4 x 4 nodes; `across`: the second argument's position in [0, 1].
fn visible_length(which: u32, strength: f32, across: f32) -> f32 {
    let last = f32(TABLE_NODES - 1u);
    let place = vec2f(strength_position(strength), clamp(across, 0.0, 1.0)) * last;
    let start = vec2f(cubic_start(place.x, f32(TABLE_NODES)), cubic_start(place.y, f32(TABLE_NODES)));
    let along = cubic_weights(place.x - start.x);
    let beside = cubic_weights(place.y - start.y);
    var sum = 0.0;
    for (var j = 0u; j < 4u; j++) {
        let row = ((which * TABLE_NODES) + u32(start.y) + j) * TABLE_NODES + u32(start.x);
        let values = vec4f(visible_lengths[row], visible_lengths[row + 1u], visible_lengths[row + 2u],
                           visible_lengths[row + 3u]);
        sum += beside[j] * dot(along, values);
    }
    return sum;
}

// One widget alone takes a table; several dim each other, and what ends inside a period has none.
fn has_table(w: Widget) -> bool {
    if WINDOWS && w.knots.y > 0u {
        return false;
    }
    return (GAUSSIANS && w.shape == GAUSSIAN) || (COSINES && w.shape == COSINE) || (ARCHES && w.shape == ARCH);
}

// Depth of the first share of a part.
fn depth_up_to(w: Widget, s: Segment, part: vec2f, share: f32) -> f32 {
    return part_depth(w, s, vec2f(part.x, part.x + share * (part.y - part.x)));
}

fn short_mean(w: Widget, s: Segment, part: vec2f) -> f32 {
    return mean_transmittance_short(depth_up_to(w, s, part, 0.0469100770306680),
                                    depth_up_to(w, s, part, 0.2307653449471585), depth_up_to(w, s, part, 0.5),
                                    depth_up_to(w, s, part, 0.7692346550528415),
                                    depth_up_to(w, s, part, 0.9530899229693320));
}

// Mean transmittance over a part that is all the widget's; negative where no table reaches.
fn tabled_mean(w: Widget, s: Segment, part: vec2f, depth: f32) -> f32 {
    let most = min(w.extinction * s.extent, 1e25) * (part.y - part.x);
    if w.shape == GAUSSIAN {
        let p = whitened(w, point_at(s, part.x));
        let q = whitened(w, point_at(s, part.y));
        let extent = length(q - p);
        if is_short(extent, depth) {
            return short_mean(w, s, part);
        }
        let along = (q - p) / max(extent, 1e-18);
        let nearer = select(p, q, dot(q, q) < dot(p, p));
        let off = nearer.x * along.y - nearer.y * along.x;
        let strength = 0.886226925452758 * most * attenuation(off * off) / max(extent, 1e-18);
        if !(strength < MOST_STRENGTH) {
            return -1.0;
        }
        let span = gaussian_span(dot(p, along), extent);
        return mean_transmittance_gaussian(span, extent, visible_length(0u, strength, (span.z + 4.0) * 0.125),
                                           visible_length(0u, strength, (span.w + 4.0) * 0.125), depth);
    }
    let is_arch = w.shape == ARCH;
    let turn = select(6.283185307179586, 3.141592653589793, is_arch);
    let p_front = phase_at(w, point_at(s, part.x));
    let p_back = phase_at(w, point_at(s, part.y));
    let periods = abs(p_back - p_front);
    let extent = turn * periods;
    if is_short(extent, depth) {
        return short_mean(w, s, part);
    }
    let strength = most / max(extent, 1e-18);
    if !(strength < MOST_STRENGTH) {
        return -1.0;
    }
    // Profiles are even: where phases fall, those of the mirrored wave rise.
    let start = select(-p_front, p_front, p_back >= p_front);
    let span = wave_span(start, periods, turn);
    let which = select(2u, 1u, is_arch);
    let first = span.x / turn;
    let rest = vec2f(first, 1.0);
    let mean = select(cosine_mean(rest, vec2f(1.0)), arch_mean(rest, vec2f(1.0), false), is_arch);
    let lengths = vec3f(visible_length(which, strength, first), visible_length(which, strength, span.y / turn),
                        visible_length(which, strength, 0.0));
    return mean_transmittance_wave(span, extent, lengths, strength * turn * (1.0 - first) * mean,
                                   strength * select(3.141592653589793, 2.0, is_arch), depth);
}

fn tabled_segment(s: Segment) -> vec4f {
    if widget_count() == 1u && has_table(widget_at(0u)) {
        let w = widget_at(0u);
        let part = active_part(w, s, 0.0, 1.0);
        if part.y <= part.x {
            return vec4f(0.0, 0.0, 0.0, 1.0);
        }
        let depth = part_depth(w, s, part);
        let mean = tabled_mean(w, s, part, depth);
        if mean >= 0.0 {
            return vec4f(s.extent * (part.y - part.x) * mean * w.color, attenuation(depth));
        }
    }
    return unweighted_segment(s);
}
