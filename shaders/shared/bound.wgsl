#import shared/transfer

// What a transfer function can make of a cell at most. Conservative: a cell's (scalar, gradient magnitude) values fill the
// convex hull of its vertices' values, and the bound is one over the whole hull and the longest edge.

// Optical depth. A ray through 1,000 dropped cells errs by 1e-6 at most.
const INVISIBLE: f32 = 1e-9;

// Largest extinction over scalars in [low, high].
fn curve_bound(low: f32, high: f32) -> f32 {
    var most = 0.0;
    for (var i = piece_starts[u32(low * 256.0)].x; i < PIECES; i++) {
        if nodes[i].x > high {
            break;
        }
        let inside = clamp(vec2f(low, high), vec2f(nodes[i].x), vec2f(nodes[i + 1u].x));
        if low <= nodes[i + 1u].x {
            let a = max(pieces[i].origin + inside.x * pieces[i].slope, vec4f(0.0));
            let b = max(pieces[i].origin + inside.y * pieces[i].slope, vec4f(0.0));
            let color = max(max(a, b), vec4f(1.0));
            most = max(most, max(a.w, b.w) * max(color.r, max(color.g, color.b)));
        }
    }
    return most;
}

fn distance_to_edge(a: vec2f, b: vec2f) -> f32 {
    let ab = b - a;
    let t = clamp(-dot(a, ab) / max(dot(ab, ab), 1e-30), 0.0, 1.0);
    return length(a + t * ab);
}

// Negative, positive or zero as the origin lies right, left or on the line from a to b; exactly zero where a = b.
fn side(a: vec2f, b: vec2f) -> f32 {
    let ab = b - a;
    return a.x * ab.y - a.y * ab.x;
}

fn triangle_holds_origin(a: vec2f, b: vec2f, c: vec2f) -> bool {
    let u = side(a, b);
    let v = side(b, c);
    let w = side(c, a);
    // Points and lines hold nothing that their edges miss.
    return (u != 0.0 || v != 0.0 || w != 0.0) && ((u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0));
}

// Distance of the origin from the convex hull of four points.
fn distance_to_hull(p: array<vec2f, 4>) -> f32 {
    if triangle_holds_origin(p[0], p[1], p[2]) || triangle_holds_origin(p[0], p[1], p[3])
        || triangle_holds_origin(p[0], p[2], p[3]) || triangle_holds_origin(p[1], p[2], p[3]) {
        return 0.0;
    }
    let first = min(distance_to_edge(p[0], p[1]), min(distance_to_edge(p[0], p[2]), distance_to_edge(p[0], p[3])));
    let rest = min(distance_to_edge(p[1], p[2]), min(distance_to_edge(p[1], p[3]), distance_to_edge(p[2], p[3])));
    return min(first, rest);
}

// True where the line's normal separates the four points from the box.
fn separates(normal: vec2f, p: array<vec2f, 4>, low: vec2f, high: vec2f) -> bool {
    let d = vec4f(dot(normal, p[0]), dot(normal, p[1]), dot(normal, p[2]), dot(normal, p[3]));
    let nearest = dot(normal, select(high, low, normal >= vec2f(0.0)));
    let farthest = dot(normal, select(low, high, normal >= vec2f(0.0)));
    return max(max(d.x, d.y), max(d.z, d.w)) < nearest || min(min(d.x, d.y), min(d.z, d.w)) > farthest;
}

fn misses_box(p: array<vec2f, 4>, low: vec2f, high: vec2f) -> bool {
    if separates(vec2f(1.0, 0.0), p, low, high) || separates(vec2f(0.0, 1.0), p, low, high) {
        return true;
    }
    var q = p;
    for (var i = 0u; i < 3u; i++) {
        for (var j = i + 1u; j < 4u; j++) {
            let edge = q[j] - q[i];
            if separates(vec2f(-edge.y, edge.x), p, low, high) {
                return true;
            }
        }
    }
    return false;
}

// What dot(direction, point - center) takes over the hull, a hair more: values on rays err by 3e-7.
fn span_along(p: array<vec2f, 4>, center: vec2f, direction: vec2f) -> vec2f {
    let u = vec4f(dot(direction, p[0] - center), dot(direction, p[1] - center), dot(direction, p[2] - center),
                  dot(direction, p[3] - center));
    let hair = 1e-6 * (abs(direction.x) + abs(direction.y));
    return vec2f(min(min(u.x, u.y), min(u.z, u.w)) - hair, max(max(u.x, u.y), max(u.z, u.w)) + hair);
}

// Largest value of a piecewise-linear function over a span.
fn knots_bound(first: u32, count: u32, span: vec2f) -> f32 {
    let low = max(span.x, knots_at(first).x);
    let high = min(span.y, knots_at(first + count - 1u).z);
    if low > high {
        return 0.0;
    }
    return knots_range(first, count, low, high).y;
}

// Bound of the widgets' extinction over the hull.
fn widgets_bound(p: array<vec2f, 4>) -> f32 {
    var sum = 0.0;
    for (var k = 0u; k < WIDGETS; k++) {
        let w = widgets[k];
        if RANGES && misses_box(p, vec2f(w.scalar_low, w.gradient_low), vec2f(w.scalar_high, w.gradient_high)) {
            continue;
        }
        var most = w.extinction;
        if GAUSSIANS && w.shape == GAUSSIAN {
            var q: array<vec2f, 4>;
            for (var i = 0u; i < 4u; i++) {
                var corner = p;
                let d = corner[i] - w.center;
                q[i] = vec2f(dot(w.whiten.xy, d), dot(w.whiten.zw, d));
            }
            // A hair nearer than computed: rounding must not cull.
            let distance = distance_to_hull(q) * 0.9999;
            most *= attenuation(distance * distance);
        } else if (TRIANGLES || COSINES || ARCHES) && w.shape >= TRIANGLE && w.shape <= HALF {
            let phases = span_along(p, w.center, w.whiten.xy) + w.whiten.z;
            most *= wave_range(w, phases.x, phases.y).y;
        } else if RAMPS && w.shape == RAMP {
            most *= knots_bound(w.knots.z, w.knots.w, span_along(p, vec2f(0.0), w.whiten.xy));
        }
        if WINDOWS && w.knots.y > 0u {
            most *= knots_bound(w.knots.x, w.knots.y, span_along(p, vec2f(0.0), w.window_direction));
        }
        // Colours above 1 count for as much more.
        sum += most * max(1.0, max(w.color.r, max(w.color.g, w.color.b)));
    }
    return sum;
}

// Bound of the extinction over a rectangle of scalars and gradient magnitudes.
fn box_bound(low: vec2f, high: vec2f) -> f32 {
    if PIECES > 0u {
        return curve_bound(low.x, high.x);
    }
    return widgets_bound(array<vec2f, 4>(low, vec2f(high.x, low.y), high, vec2f(low.x, high.y)));
}

// Bound of the optical depth of a ray through the cell of these vertices (place, scalar) and gradient magnitudes; colours
// above 1 count for as much more.
fn depth_bound(a: vec4f, b: vec4f, c: vec4f, d: vec4f, magnitudes: vec4f) -> f32 {
    let edge = sqrt(max(max(max(dot(b.xyz - a.xyz, b.xyz - a.xyz), dot(c.xyz - a.xyz, c.xyz - a.xyz)),
                            max(dot(d.xyz - a.xyz, d.xyz - a.xyz), dot(c.xyz - b.xyz, c.xyz - b.xyz))),
                        max(dot(d.xyz - b.xyz, d.xyz - b.xyz), dot(d.xyz - c.xyz, d.xyz - c.xyz))));
    if PIECES > 0u {
        let low = min(min(a.w, b.w), min(c.w, d.w));
        let high = max(max(a.w, b.w), max(c.w, d.w));
        return curve_bound(low, high) * edge;
    }
    return widgets_bound(array<vec2f, 4>(vec2f(a.w, magnitudes.x), vec2f(b.w, magnitudes.y), vec2f(c.w, magnitudes.z),
                                         vec2f(d.w, magnitudes.w))) * edge;
}
