#import math/psi
#import shared/widgets

// Integrals that know the function at points only. Whoever imports this says what it is there: `classify`, (emission,
// extinction) of a point (scalar, gradient magnitude).

// Pieces of SEGMENTED.
override EQUAL_PIECES: u32 = 1u;

fn holds(w: Widget, p: vec2f) -> bool {
    var inside = true;
    if RANGES {
        inside = p.x >= w.scalar_low && p.x <= w.scalar_high && p.y >= w.gradient_low && p.y <= w.gradient_high;
    }
    if WINDOWS && w.knots.y > 0u {
        let u = dot(w.window_direction, p);
        inside = inside && u >= knots_at(w.knots.x).x && u <= knots_at(w.knots.x + w.knots.y - 1u).z;
    }
    if RAMPS && w.shape == RAMP {
        let u = dot(w.whiten.xy, p);
        inside = inside && u >= knots_at(w.knots.z).x && u <= knots_at(w.knots.z + w.knots.w - 1u).z;
    }
    return inside;
}

// Emission and extinction of all widgets at a point.
fn classify_widgets(p: vec2f) -> vec4f {
    turns_taken += 1u + widget_count() * WIDGET_TURNS;
    var sum = vec4f(0.0);
    for (var k = 0u; k < widget_count(); k++) {
        let w = widget_at(k);
        if holds(w, p) {
            sum += min(w.extinction, 1e25) * profile_at(w, p) * vec4f(w.color, 1.0);
        }
    }
    return sum;
}

// Emission over extinction; the other's where nothing absorbs.
fn color_of(point: vec4f, other: vec4f) -> vec3f {
    return select(other.rgb / max(other.w, 1e-30), point.rgb / max(point.w, 1e-30), point.w > 1e-30);
}

// Over a length, finite.
fn along_length(point: vec4f, extent: f32) -> vec4f {
    return min(point * extent, vec4f(1e25));
}

// Shirley & Tuchman 1990, for the ends of a segment: opacity from the mean of both extinctions, the mean of both colours.
fn vertex_linear_segment(s: Segment) -> vec4f {
    let front = along_length(classify(s.front), s.extent);
    let back = along_length(classify(s.back), s.extent);
    let depth = 0.5 * (front.w + back.w);
    let color = 0.5 * (color_of(front, back) + color_of(back, front));
    return vec4f(color * (depth * phi_one(depth)), attenuation(depth));
}

// The function at the mean of both ends.
fn mean_scalar_segment(s: Segment) -> vec4f {
    let middle = along_length(classify(point_at(s, 0.5)), s.extent);
    return vec4f(middle.rgb * phi_one(middle.w), attenuation(middle.w));
}

// Equal pieces, extinction and emission linear in each (Song et al. 2009, section 5).
fn segmented_segment(s: Segment) -> vec4f {
    let extent = s.extent / f32(EQUAL_PIECES);
    var color = vec3f(0.0);
    var seen = 1.0;
    var front = along_length(classify(s.front), extent);
    for (var i = 1u; i <= EQUAL_PIECES; i++) {
        let back = along_length(classify(point_at(s, f32(i) / f32(EQUAL_PIECES))), extent);
        let weights = emission_weights(front.w, back.w);
        color += seen * (weights.x * front.rgb + weights.y * back.rgb);
        seen *= attenuation(0.5 * (front.w + back.w));
        front = back;
        if seen < 1e-7 {
            break;
        }
    }
    return vec4f(color, seen);
}
