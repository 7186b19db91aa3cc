#import shared/frame
#import shared/counts
#import shared/bands

// What the passes share that write the corners of one chunk's cells, in the order of drawing (project.wgsl, faces.wgsl,
// grid_project.wgsl). Where cells come from is told by shared/mesh_cells.wgsl or shared/grid_cells.wgsl: Cell, cell_at,
// bands_of, clip_of, gradient_of, vector_of.

@group(3) @binding(0) var<uniform> chunk: Chunk;
@group(3) @binding(1) var<storage, read> counts: Counts;
@group(3) @binding(2) var<storage, read> order: array<u32>; // cells, or spans of cells, back to front
// Four corners a cell; per corner: clip xy; then, of the first corner of a triangle alone, what is affine over it, as
// planes: where they begin, pixels; value there and change a pixel along x and y of 1/z (orthographic: the depth), with
// the first of three tent functions; of scalar/z, with the second; changes of all three along x, with the third; along y,
// with the thickness at the apex (negative where the front is the side that is one plane); the change of scalar/z from
// that side to the other; with BIVARIATE the change of gradient/z and its plane; with BANDS the lower piece, as 8 x piece
// + 1 where the span is not clipped below + 2 where it is not above + 4 where it has no upper band, and the scalar is that
// of the span. With SHADED the plane of the gradient vector/z in view axes, and its change, come last.
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

// Of the point on screen where a cell is thickest, from its front to its back.
struct Apex {
    thickness: f32,
    scalar_change: f32,
    gradient_change: f32,
    vector_change: vec3f,
}

// A cell, or span of one, from the eye. Its vertices are in front or behind: the mean of those in front lies before that
// of the others, at the apex. A face opposite to a vertex behind is a front face.
struct SeenCell {
    tet: vec4u,
    // -1 where ascending ids are an odd permutation.
    parity: f32,
    front: vec4<bool>,
    // Vertices in front.
    count: u32,
    inverse_depths: vec4f,
    // The same for a perspective camera, else depths from the reference point.
    heights: vec4f,
    scalars: vec4f,
    gradients: vec4f,
    apex: Apex,
    // 1 / (share in the apex, as a mean on screen of the vertices of that side).
    peaks: vec4f,
    span: u32,
}

// What is affine over a triangle of a cell, at a corner.
struct Corner {
    clip: vec2f,
    // 1/z (orthographic: the depth), scalar/z, gradient/z.
    plane: vec3f,
    tent: vec3f,
    // Gradient vector/z.
    vector: vec3f,
}

const FLOATS: u32 = 21u;
const BANDS_FLOATS: u32 = 22u;
const BIVARIATE_FLOATS: u32 = 25u;
const SHADED_FLOATS: u32 = 12u; // more
// How much larger cells are drawn, pixels: twice the rasteriser's grid.
const HAIR: f32 = 0.0078125;
const NO_CUT: f32 = 2.0;
// Pixels squared.
const LEAST_AREA: f32 = 1e-18;
// At most, where the corners of needles would be far away; and by no more than the outline's own size, or a part of a
// pixel: beyond the ends of needles rounding has the last word on whether the tent is positive.
override LONGEST_HAIR: f32;
const SHORT_HAIR: f32 = 0.25;
// At a face seen edge-on, a cell is at once as thick as it is, and its tent rises from 0 to more than 1 within what pixels
// are rounded by. A pixel there, and meshes of regular places have many, would have a tent of 0, or of what rounding makes
// of it, for the cells of both sides: black. So a tent that changes by more than STEEP when it is evaluated aside, to the
// right and a little up, by eight times that rounding, is evaluated there. (To the right, then up, is also what the oracle
// decides by.)
const STEEP: f32 = 0.1;
const MOVE: f32 = 9.5e-7; // of the picture's size
const MOVE_UP: f32 = 0.318;

// Volume of the eye and a face (perspective), or the face's area seen along the view (orthographic), times 6 or 2.
// The two cells at a face pass its vertices in the same order and get the same bits.
fn face_weight(a: vec3f, ab: vec3f, ac: vec3f) -> f32 {
    let normal = cross(ab, ac);
    if PERSPECTIVE {
        return dot(normal, a);
    }
    return dot(normal, frame.forward);
}

// Of a vertex, in view axes.
fn gradient_vector(vertex: u32) -> vec3f {
    let vector = vector_of(vertex);
    return vec3f(frame.ray_per_clip_x * dot(frame.x_row, vector), frame.ray_per_clip_y * dot(frame.y_row, vector),
                 dot(frame.forward, vector));
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

// Class and apex in the form of Radon weights (optics.md 6.2): one formula for all classes and degeneracies, no 2D
// intersection, no difference of depths.
fn seen_cell(entry: u32) -> SeenCell {
    let cell = select(entry, entry >> SPAN_BITS, BANDS);
    let found = cell_at(cell);
    let tet = found.tet;
    let p0 = found.a;
    let p1 = found.b;
    let p2 = found.c;
    let p3 = found.d;
    let v0 = from_eye(p0.xyz);
    let v1 = from_eye(p1.xyz);
    let v2 = from_eye(p2.xyz);
    let v3 = from_eye(p3.xyz);
    let e01 = p1.xyz - p0.xyz;
    let e02 = p2.xyz - p0.xyz;
    let e03 = p3.xyz - p0.xyz;
    let volume = found.volume;
    var seen: SeenCell;
    seen.tet = tet;
    seen.parity = select(1.0, -1.0, volume < 0.0);
    let mu = seen.parity * vec4f(face_weight(v1, p2.xyz - p1.xyz, p3.xyz - p1.xyz), -face_weight(v0, e02, e03),
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
    if front_sum > least && back_sum > least {
        seen.apex.thickness = abs(volume) * scales.x;
    }
    seen.scalars = vec4f(p0.w, p1.w, p2.w, p3.w);
    if BANDS {
        let bands = bands_of(cell, seen.scalars);
        let index = span_index(entry & (DEEP_SPAN - 1u), bands, mu, seen.scalars);
        let piece = first_band(bands) + BANDS_PER_SPAN * index;
        let is_last = index + 1u == span_count(bands);
        seen.span = piece * 8u + select(0u, 1u, index == 0u && band_reaches_low(bands))
            + select(0u, 2u, is_last && band_reaches_high(bands))
            + select(0u, 4u, !PAIRED || (is_last && (band_count(bands) & 1u) != 0u));
        let middle = nodes[piece + 1u].x;
        seen.scalars = (seen.scalars - middle) / (middle - nodes[piece].x);
    }
    let change = back_weights * scales.y - front_weights * scales.x;
    seen.apex.scalar_change =
        dot(back_weights, seen.scalars) * scales.y - dot(front_weights, seen.scalars) * scales.x;
    if BIVARIATE {
        seen.gradients = vec4f(gradient_of(tet.x), gradient_of(tet.y), gradient_of(tet.z), gradient_of(tet.w));
        seen.apex.gradient_change =
            dot(back_weights, seen.gradients) * scales.y - dot(front_weights, seen.gradients) * scales.x;
    }
    if SHADED {
        seen.apex.vector_change = change.x * gradient_vector(tet.x) + change.y * gradient_vector(tet.y)
            + change.z * gradient_vector(tet.z) + change.w * gradient_vector(tet.w);
    }
    seen.front = front;
    seen.count = u32(front.x) + u32(front.y) + u32(front.z) + u32(front.w);
    let depths = vec4f(divisor(p0.xyz), divisor(p1.xyz), divisor(p2.xyz), divisor(p3.xyz));
    seen.inverse_depths = 1.0 / depths;
    seen.heights = seen.inverse_depths;
    if !PERSPECTIVE {
        seen.heights = vec4f(dot(frame.forward, p0.xyz - frame.reference), dot(frame.forward, p1.xyz - frame.reference),
                             dot(frame.forward, p2.xyz - frame.reference), dot(frame.forward, p3.xyz - frame.reference));
    }
    // A tent function is 1 / (share of its corner) there, 0 at the others of its side, and 1 at the apex.
    let shares = depths * (front_weights * scales.x + back_weights * scales.y);
    seen.peaks = 1.0 / max(shares, vec4f(1e-7));
    return seen;
}

// `k`: a vertex of the cell, 0 to 3.
fn corner_of(seen: SeenCell, k: u32) -> Corner {
    let inverse = seen.inverse_depths[k];
    let plane = vec3f(seen.heights[k], inverse * seen.scalars[k], inverse * seen.gradients[k]);
    var corner = Corner(clip_of(seen.tet[k]), plane, vec3f(), vec3f());
    if SHADED {
        corner.vector = inverse * gradient_vector(seen.tet[k]);
    }
    return corner;
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
    let longest = min(max(SHORT_HAIR, outer), LONGEST_HAIR);
    return min(HAIR / max(inner, 1e-30), longest / max(outer, 1e-30));
}

// On screen, grown about the outline's middle.
fn put_corner(at: u32, clip: vec2f, middle: vec2f, growth: f32) {
    let grown = clip + growth * (clip - middle);
    corners[at] = grown.x;
    corners[at + 1u] = grown.y;
}

// Floats of a corner.
fn plain_size() -> u32 {
    return select(select(FLOATS, BANDS_FLOATS, BANDS), BIVARIATE_FLOATS, BIVARIATE);
}

fn corner_size() -> u32 {
    return plain_size() + select(0u, SHADED_FLOATS, SHADED);
}

fn put_vector(at: u32, vector: vec3f) {
    corners[at] = vector.x;
    corners[at + 1u] = vector.y;
    corners[at + 2u] = vector.z;
}

// A change a pixel, from those of the second and third corner's shares.
fn slope(of_b: vec2f, of_c: vec2f, ab: f32, ac: f32) -> vec2f {
    return ab * of_b + ac * of_c;
}

// What is affine over the triangle a, b, c, at its first corner. `is_back`: corners hold the values of the back.
fn put_triangle(at: u32, seen: SeenCell, is_back: bool, a: Corner, b: Corner, c: Corner) {
    let pixels = vec2f(0.5 * frame.image_width, -0.5 * frame.image_height);
    let ab = pixels * (b.clip - a.clip);
    let ac = pixels * (c.clip - a.clip);
    let area = ab.x * ac.y - ab.y * ac.x;
    // Without an area nothing is seen.
    let is_flat = abs(area) < LEAST_AREA;
    let inverse = select(1.0 / area, 0.0, is_flat);
    // Changes of the second and third corner's barycentric coordinate.
    let of_b = inverse * vec2f(ac.y, -ac.x);
    let of_c = inverse * vec2f(-ab.y, ab.x);
    let begin = pixels * (a.clip + vec2f(1.0, -1.0));
    let depth = slope(of_b, of_c, b.plane.x - a.plane.x, c.plane.x - a.plane.x);
    let scalar = slope(of_b, of_c, b.plane.y - a.plane.y, c.plane.y - a.plane.y);
    let tent_b = b.tent - a.tent;
    let tent_c = c.tent - a.tent;
    let tent_x = of_b.x * tent_b + of_c.x * tent_c;
    let tent_y = of_b.y * tent_b + of_c.y * tent_c;
    let moved = MOVE * max(frame.image_width, frame.image_height) * (tent_x - MOVE_UP * tent_y);
    let tent = select(a.tent + select(vec3f(0.0), moved, abs(moved) > vec3f(STEEP)), vec3f(0.0), is_flat);
    let apex = seen.apex;
    corners[at + 2u] = begin.x;
    corners[at + 3u] = begin.y;
    corners[at + 4u] = a.plane.x;
    corners[at + 5u] = depth.x;
    corners[at + 6u] = depth.y;
    corners[at + 7u] = tent.x;
    corners[at + 8u] = a.plane.y;
    corners[at + 9u] = scalar.x;
    corners[at + 10u] = scalar.y;
    corners[at + 11u] = tent.y;
    put_vector(at + 12u, tent_x);
    corners[at + 15u] = tent.z;
    put_vector(at + 16u, tent_y);
    corners[at + 19u] = select(-apex.thickness, apex.thickness, is_back);
    corners[at + 20u] = select(apex.scalar_change, -apex.scalar_change, is_back);
    if BIVARIATE {
        let gradient = slope(of_b, of_c, b.plane.z - a.plane.z, c.plane.z - a.plane.z);
        corners[at + 21u] = select(apex.gradient_change, -apex.gradient_change, is_back);
        put_vector(at + 22u, vec3f(a.plane.z, gradient));
    }
    if BANDS {
        corners[at + 21u] = f32(seen.span);
    }
    if SHADED {
        let more = at + plain_size();
        put_vector(more, a.vector);
        put_vector(more + 3u, of_b.x * (b.vector - a.vector) + of_c.x * (c.vector - a.vector));
        put_vector(more + 6u, of_b.y * (b.vector - a.vector) + of_c.y * (c.vector - a.vector));
        put_vector(more + 9u, select(apex.vector_change, -apex.vector_change, is_back));
    }
}
