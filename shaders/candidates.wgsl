#import shared/frame
#import shared/range
#import shared/transfer

// Marks the cells that the transfer function can make visible, independent of the view. Conservative: a cell's (scalar,
// gradient magnitude) values fill the convex hull of its vertices' values, and a cell is dropped only where a bound of
// the optical depth over the whole hull and the longest edge stays below INVISIBLE.

@group(1) @binding(0) var<storage, read> tets: array<vec4u>; // of the range
@group(1) @binding(1) var<storage, read> volumes: array<f32>; // of the range
@group(1) @binding(2) var<storage, read> vertices: array<vec4f>;
@group(1) @binding(3) var<storage, read> gradients: array<f32>;
@group(3) @binding(1) var<storage, read_write> candidates: array<u32>; // one bit a cell of the range

// The bands of each cell of the range that is a candidate (curves only).
@group(3) @binding(2) var<storage, read_write> cell_bands: array<u32>;
@group(3) @binding(3) var<storage, read_write> band_totals: BandTotals;

struct BandTotals {
    bands: atomic<u32>,
    // Pairs of them, the last one of a cell perhaps alone.
    pairs: atomic<u32>,
    // Bands in one cell.
    most: atomic<u32>,
    // Deep cells.
    deep: atomic<u32>,
}

// Off: every cell of non-zero volume is a candidate.
override CULL: bool = true;

// Optical depth. A ray through 1,000 dropped cells errs by 1e-6 at most.
const INVISIBLE: f32 = 1e-9;

var<workgroup> block_flags: array<atomic<u32>, 8>;

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

// The bands over scalars in [low, high], without what is transparent below and above.
fn bands_between(low: f32, high: f32, is_deep: bool) -> u32 {
    var first = piece_starts[u32(low * 256.0)].x;
    while first + 1u < PIECES && nodes[first + 1u].x <= low {
        first++;
    }
    var end = first + 1u;
    while end < PIECES && nodes[end].x < high {
        end++;
    }
    var seen = vec2u(first, end);
    while seen.x + 1u < end && transparent(seen.x) {
        seen.x++;
    }
    while seen.y > seen.x + 1u && transparent(seen.y - 1u) {
        seen.y--;
    }
    return packed_bands(seen.x, min(seen.y - seen.x, 255u), seen.x == first, seen.y == end, is_deep);
}

fn transparent(piece: u32) -> bool {
    return node_values[piece].w <= 0.0 && node_values[piece + 1u].w <= 0.0;
}

// Scalars from the lowest to the highest.
fn scalar_range(tet: vec4u) -> vec2f {
    let s = vec4f(vertices[tet.x].w, vertices[tet.y].w, vertices[tet.z].w, vertices[tet.w].w);
    return vec2f(min(min(s.x, s.y), min(s.z, s.w)), max(max(s.x, s.y), max(s.z, s.w)));
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

// Bound of the optical depth of a ray through the cell; colours above 1 count for as much more.
fn depth_bound(tet: vec4u) -> f32 {
    let a = vertices[tet.x];
    let b = vertices[tet.y];
    let c = vertices[tet.z];
    let d = vertices[tet.w];
    let edge = sqrt(max(max(max(dot(b.xyz - a.xyz, b.xyz - a.xyz), dot(c.xyz - a.xyz, c.xyz - a.xyz)),
                            max(dot(d.xyz - a.xyz, d.xyz - a.xyz), dot(c.xyz - b.xyz, c.xyz - b.xyz))),
                        max(dot(d.xyz - b.xyz, d.xyz - b.xyz), dot(d.xyz - c.xyz, d.xyz - c.xyz))));
    if PIECES > 0u {
        let low = min(min(a.w, b.w), min(c.w, d.w));
        let high = max(max(a.w, b.w), max(c.w, d.w));
        return curve_bound(low, high) * edge;
    }
    var points = array<vec2f, 4>(vec2f(a.w, 0.0), vec2f(b.w, 0.0), vec2f(c.w, 0.0), vec2f(d.w, 0.0));
    if BIVARIATE {
        points[0].y = gradients[tet.x];
        points[1].y = gradients[tet.y];
        points[2].y = gradients[tet.z];
        points[3].y = gradients[tet.w];
    }
    return widgets_bound(points) * edge;
}

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) lane: u32) {
    let block = group.x + group.y * groups.x;
    let i = block * 256u + lane;
    if lane < 8u {
        atomicStore(&block_flags[lane], 0u);
    }
    workgroupBarrier();
    if i < range.tet_count && volumes[i] != 0.0 {
        let depth = depth_bound(tets[i]);
        if !CULL || depth > INVISIBLE {
            atomicOr(&block_flags[lane >> 5u], 1u << (i & 31u));
            if PIECES > 0u {
                let scalars = scalar_range(tets[i]);
                let bands = bands_between(scalars.x, scalars.y, depth > THIN);
                cell_bands[i] = bands;
                atomicAdd(&band_totals.bands, band_count(bands));
                atomicAdd(&band_totals.pairs, (band_count(bands) + 1u) >> 1u);
                atomicMax(&band_totals.most, band_count(bands));
                if depth > THIN {
                    atomicAdd(&band_totals.deep, 1u);
                }
            }
        }
    }
    workgroupBarrier();
    if block * 256u < range.tet_count && lane < 8u {
        candidates[block * 8u + lane] = atomicLoad(&block_flags[lane]);
    }
}
