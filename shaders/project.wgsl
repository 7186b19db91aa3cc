#import shared/frame
#import shared/counts
#import shared/tets
#import shared/bands

// Projects the surviving cells of one chunk, in the order of drawing: class, outline and thick vertex (Shirley & Tuchman
// 1990) in the form of Radon weights (optics.md 6.2): one formula for all classes and degeneracies, no 2D intersection,
// no difference of depths.
//
// Over the fan of 3 or 4 triangles around the thick vertex, every quantity is affine in each triangle. Instead of the
// fan, its outline is drawn, 1 or 2 triangles, and the fan's pieces are told apart per fragment: the tent that is 0 on
// the outline and 1 at the thick vertex is the minimum of affine functions, one an edge, and
//   thickness = tent x thickness at the apex,   back value = front value + tent x their difference at the apex
// (or the other way round), where the side that is one plane over the triangle is interpolated. Less than half the
// triangles, and no thick vertex whose rounding could fold them over.
//
// Rasterisers round positions to 1/256 pixel, which would give a pixel near an edge to the wrong cell: seams. So outlines
// are drawn a hair too large, with everything extrapolated: outside the cell the tent is negative, which counts as 0.
// Which cell a pixel is in is then decided by the tent, in f32.

@group(1) @binding(0) var<storage, read> vertices: array<vec4f>;
@group(1) @binding(1) var<storage, read> gradients: array<f32>;
@group(1) @binding(2) var<storage, read> gradient_vectors: array<f32>; // three a vertex; the largest has length 1
@group(3) @binding(0) var<uniform> chunk: Chunk;
@group(3) @binding(1) var<storage, read> counts: Counts;
@group(3) @binding(2) var<storage, read> order: array<u32>; // cells, or spans of cells, back to front
@group(3) @binding(4) var<storage, read> cell_bands: array<u32>;
@group(3) @binding(3) var<storage, read> projected: array<vec2f>;
// Four corners a cell; per corner: clip xy; 1/z and scalar/z; three tent functions; then, of the first corner alone, at
// the apex, the thickness (negative where the front is the interpolated side) and the change of scalar/z from the
// interpolated to the other side; with BIVARIATE gradient/z and its change; with BANDS the lower piece, as 8 x piece
// + 1 where the span is not clipped below + 2 where it is not above + 4 where it has no upper band, and the scalar is that
// of the span. With SHADED the
// gradient vector/z in view axes, and its change, come last.
//
// Few and plain stores: on a software adapter they were most of the time of this pass.
@group(3) @binding(5) var<storage, read_write> corners: array<f32>;

struct Chunk {
    first_cell: u32,
    cells: u32,
    pad_a: u32,
    pad_b: u32,
}

override BIVARIATE: bool = false;
override SHADED: bool = false;

// Volume of the eye and a face (perspective), or the face's area seen along the view (orthographic), times 6 or 2.
// The two cells at a face pass its vertices in the same order and get the same bits.
fn face_weight(a: vec3f, ab: vec3f, ac: vec3f) -> f32 {
    let normal = cross(ab, ac);
    if PERSPECTIVE {
        return dot(normal, a);
    }
    return dot(normal, frame.forward);
}

// Corner numbers around the outline. Class 1 (three vertices of one sign, the fourth behind or before them): the three,
// the first twice. Class 2: front, back, front, back: the outline is cut along the front edge, so that the front is one
// plane over each triangle.
fn outline(front: vec4<bool>, count: u32) -> vec4u {
    if count == 2u {
        if front.x == front.y {
            return select(vec4u(2u, 0u, 3u, 1u), vec4u(0u, 2u, 1u, 3u), front.x);
        }
        if front.x == front.z {
            return select(vec4u(1u, 0u, 3u, 2u), vec4u(0u, 1u, 2u, 3u), front.x);
        }
        return select(vec4u(1u, 0u, 2u, 3u), vec4u(0u, 1u, 3u, 2u), front.x);
    }
    let odd = count == 1u; // the vertex inside is the only one in front, or the only one behind
    if front.x == odd && front.y != odd {
        return vec4u(1u, 2u, 3u, 1u);
    }
    if front.y == odd && front.x != odd {
        return vec4u(0u, 2u, 3u, 0u);
    }
    if front.z == odd {
        return vec4u(0u, 1u, 3u, 0u);
    }
    return vec4u(0u, 1u, 2u, 0u);
}

const FLOATS: u32 = 9u;
const BANDS_FLOATS: u32 = 10u;
const BIVARIATE_FLOATS: u32 = 11u;
const SHADED_FLOATS: u32 = 6u; // more
// How much larger outlines are drawn, pixels: twice the rasteriser's grid.
const HAIR: f32 = 0.0078125;
const NO_CUT: f32 = 2.0;
// At most: the corners of needles would be far away.
override LONGEST_HAIR: f32;

struct Apex {
    thickness: f32,
    scalar_change: f32,
    gradient_change: f32,
}

// What is affine over a triangle of the outline, at a corner.
struct Corner {
    clip: vec2f,
    // 1/z, scalar/z, gradient/z.
    plane: vec3f,
    tent: vec3f,
}

fn put_corner(at: u32, corner: Corner, middle: Corner, growth: f32) {
    let clip = corner.clip + growth * (corner.clip - middle.clip);
    let plane = corner.plane + growth * (corner.plane - middle.plane);
    let tent = corner.tent + growth * (corner.tent - middle.tent);
    corners[at] = clip.x;
    corners[at + 1u] = clip.y;
    corners[at + 2u] = plane.x;
    corners[at + 3u] = plane.y;
    corners[at + 4u] = tent.x;
    corners[at + 5u] = tent.y;
    corners[at + 6u] = tent.z;
    if BIVARIATE {
        corners[at + 9u] = plane.z;
    }
}

// Of a vertex, in view axes.
fn gradient_vector(vertex: u32) -> vec3f {
    let at = 3u * vertex;
    let vector = vec3f(gradient_vectors[at], gradient_vectors[at + 1u], gradient_vectors[at + 2u]);
    return vec3f(frame.ray_per_clip_x * dot(frame.x_row, vector), frame.ray_per_clip_y * dot(frame.y_row, vector),
                 dot(frame.forward, vector));
}

fn put_vector(at: u32, vector: vec3f) {
    corners[at] = vector.x;
    corners[at + 1u] = vector.y;
    corners[at + 2u] = vector.z;
}

// Distance of the line through a and b from the origin.
fn line_distance(a: vec2f, b: vec2f) -> f32 {
    let ab = b - a;
    // No line: no limit.
    let extent = length(ab);
    return select(1e30, abs(a.x * ab.y - a.y * ab.x) / max(extent, 1e-30), extent > 0.0);
}

// By how much the outline grows about its middle, so that each edge moves out by a hair.
fn growth_about(middle: vec2f, a: vec2f, b: vec2f, c: vec2f, d: vec2f) -> f32 {
    let half_size = 0.5 * vec2f(frame.image_width, frame.image_height);
    let p = (a - middle) * half_size;
    let q = (b - middle) * half_size;
    let r = (c - middle) * half_size;
    let s = (d - middle) * half_size;
    let inner = min(min(line_distance(p, q), line_distance(q, r)), min(line_distance(r, s), line_distance(s, p)));
    let outer = max(max(length(p), length(q)), max(length(r), length(s)));
    return min(HAIR / max(inner, 1e-30), LONGEST_HAIR / max(outer, 1e-30));
}

override BANDS_PER_SPAN: u32 = select(1u, 2u, PAIRED);

// The span of a cell that is drawn as the k-th from behind. `mu`: weights of the vertices, whose mean is the eye. Along
// every ray from there scalars only rise or only fall, so spans farther from the eye's scalar lie behind.
fn span_index(k: u32, bands: u32, mu: vec4f, scalars: vec4f) -> u32 {
    let last = span_count(bands) - 1u;
    var below_eye = 0u;
    for (var j = 1u; j <= last; j++) {
        if dot(mu, scalars - nodes[first_band(bands) + BANDS_PER_SPAN * j].x) >= 0.0 {
            below_eye = j;
        }
    }
    let above_eye = last - below_eye;
    return select(k - above_eye, last - k, k < above_eye);
}

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let place = id.x;
    let rank = chunk.first_cell + place;
    if place >= chunk.cells || rank >= counts.survivors {
        return;
    }
    let entry = order[rank];
    let cell = select(entry, entry >> SPAN_BITS, BANDS);
    let tet = tet_at(cell);
    let p0 = vertices[tet.x];
    let p1 = vertices[tet.y];
    let p2 = vertices[tet.z];
    let p3 = vertices[tet.w];
    let v0 = from_eye(p0.xyz);
    let v1 = from_eye(p1.xyz);
    let v2 = from_eye(p2.xyz);
    let v3 = from_eye(p3.xyz);
    let e01 = p1.xyz - p0.xyz;
    let e02 = p2.xyz - p0.xyz;
    let e03 = p3.xyz - p0.xyz;
    let volume = volumes[cell];
    let parity = select(1.0, -1.0, volume < 0.0);
    let mu = parity * vec4f(face_weight(v1, p2.xyz - p1.xyz, p3.xyz - p1.xyz), -face_weight(v0, e02, e03),
                            face_weight(v0, e01, e03), -face_weight(v0, e01, e02));
    let front = mu > vec4f(0.0);
    let front_weights = max(mu, vec4f(0.0));
    let back_weights = max(-mu, vec4f(0.0));
    let front_sum = dot(front_weights, vec4f(1.0));
    let back_sum = dot(back_weights, vec4f(1.0));
    let point = front_weights.x * v0 + front_weights.y * v1 + front_weights.z * v2 + front_weights.w * v3;
    // A cell seen exactly edge-on has no weight at all: it gets a thickness of zero.
    let least = 1e-37;
    var scales = vec2f(1.0 / max(dot(frame.forward, point), least));
    if !PERSPECTIVE {
        scales = 1.0 / max(vec2f(front_sum, back_sum), vec2f(least));
    }
    var apex: Apex;
    if front_sum > least && back_sum > least {
        apex.thickness = abs(volume) * scales.x;
    }
    var scalars = vec4f(p0.w, p1.w, p2.w, p3.w);
    var span = 0u;
    if BANDS {
        let bands = cell_bands[cell];
        let index = span_index(entry & (DEEP_SPAN - 1u), bands, mu, scalars);
        let piece = first_band(bands) + BANDS_PER_SPAN * index;
        let is_last = index + 1u == span_count(bands);
        span = piece * 8u + select(0u, 1u, index == 0u && band_reaches_low(bands))
            + select(0u, 2u, is_last && band_reaches_high(bands))
            + select(0u, 4u, !PAIRED || (is_last && (band_count(bands) & 1u) != 0u));
        let middle = nodes[piece + 1u].x;
        scalars = (scalars - middle) / (middle - nodes[piece].x);
    }
    var g = vec4f(0.0);
    apex.scalar_change = dot(back_weights, scalars) * scales.y - dot(front_weights, scalars) * scales.x;
    if BIVARIATE {
        g = vec4f(gradients[tet.x], gradients[tet.y], gradients[tet.z], gradients[tet.w]);
        apex.gradient_change = dot(back_weights, g) * scales.y - dot(front_weights, g) * scales.x;
    }
    let count = u32(front.x) + u32(front.y) + u32(front.z) + u32(front.w);
    if count == 1u {
        // The back is one plane, the front three.
        apex.scalar_change = -apex.scalar_change;
        apex.gradient_change = -apex.gradient_change;
    } else {
        apex.thickness = -apex.thickness;
    }
    // The apex as a mean of the corners on screen; a tent function is 1 / (share of its corner) there and 0 elsewhere.
    var shares = select(front_weights * scales.x, back_weights * scales.y, count == 1u);
    let depths = vec4f(divisor(p0.xyz), divisor(p1.xyz), divisor(p2.xyz), divisor(p3.xyz));
    shares *= depths;
    let inverse_depths = 1.0 / depths;
    let peaks = 1.0 / max(shares, vec4f(1e-7));
    let ring = outline(front, count);
    var a = Corner(projected[tet[ring.x]], inverse_depths[ring.x] * vec3f(1.0, scalars[ring.x], g[ring.x]), vec3f());
    var b = Corner(projected[tet[ring.y]], inverse_depths[ring.y] * vec3f(1.0, scalars[ring.y], g[ring.y]), vec3f());
    var c = Corner(projected[tet[ring.z]], inverse_depths[ring.z] * vec3f(1.0, scalars[ring.z], g[ring.z]), vec3f());
    var d = a;
    var middle: Corner;
    var growth: f32;
    a.tent.x = peaks[ring.x];
    if count == 2u {
        // The front edge's ends have the first and third function; the second does not cut.
        d = Corner(projected[tet[ring.w]], inverse_depths[ring.w] * vec3f(1.0, scalars[ring.w], g[ring.w]), vec3f());
        c.tent.z = peaks[ring.z];
        a.tent.y = NO_CUT;
        b.tent.y = NO_CUT;
        c.tent.y = NO_CUT;
        d.tent.y = NO_CUT;
        // The middle of the edge that both triangles share: they stay neighbours.
        middle = Corner(0.5 * (a.clip + c.clip), 0.5 * (a.plane + c.plane), 0.5 * (a.tent + c.tent));
        growth = growth_about(middle.clip, a.clip, b.clip, c.clip, d.clip);
    } else {
        b.tent.y = peaks[ring.y];
        c.tent.z = peaks[ring.z];
        d = a;
        let third = 1.0 / 3.0;
        middle = Corner(third * (a.clip + b.clip + c.clip), third * (a.plane + b.plane + c.plane),
                        third * (a.tent + b.tent + c.tent));
        growth = growth_about(middle.clip, a.clip, b.clip, c.clip, c.clip);
    }
    let plain_size = select(select(FLOATS, BANDS_FLOATS, BANDS), BIVARIATE_FLOATS, BIVARIATE);
    let size = plain_size + select(0u, SHADED_FLOATS, SHADED);
    let at = place * 4u * size;
    put_corner(at, a, middle, growth);
    put_corner(at + size, b, middle, growth);
    put_corner(at + 2u * size, c, middle, growth);
    put_corner(at + 3u * size, d, middle, growth);
    corners[at + 7u] = apex.thickness;
    corners[at + 8u] = apex.scalar_change;
    if BIVARIATE {
        corners[at + 10u] = apex.gradient_change;
    }
    if BANDS {
        corners[at + 9u] = f32(span);
    }
    if SHADED {
        let weights = back_weights * scales.y - front_weights * scales.x;
        let change = weights.x * gradient_vector(tet.x) + weights.y * gradient_vector(tet.y)
            + weights.z * gradient_vector(tet.z) + weights.w * gradient_vector(tet.w);
        let over_depth = vec4f(inverse_depths[ring.x], inverse_depths[ring.y], inverse_depths[ring.z],
                               inverse_depths[ring.w]);
        let va = over_depth.x * gradient_vector(tet[ring.x]);
        let vb = over_depth.y * gradient_vector(tet[ring.y]);
        let vc = over_depth.z * gradient_vector(tet[ring.z]);
        let vd = over_depth.w * gradient_vector(tet[ring.w]);
        let center = select((1.0 / 3.0) * (va + vb + vc), 0.5 * (va + vc), count == 2u);
        let first = at + plain_size;
        put_vector(first, va + growth * (va - center));
        put_vector(first + size, vb + growth * (vb - center));
        put_vector(first + 2u * size, vc + growth * (vc - center));
        put_vector(first + 3u * size, vd + growth * (vd - center));
        put_vector(first + 3u, select(change, -change, count == 1u));
    }
}
