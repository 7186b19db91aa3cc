#import shared/frame
#import shared/counts
#import shared/tets

// Projects the surviving cells of one chunk, in the order of drawing: class, outline and thick vertex (Shirley & Tuchman
// 1990) in the form of Radon weights (optics.md 6.2): one formula for all classes and degeneracies, no 2D intersection,
// no difference of depths.
//
// Over the fan of 3 or 4 triangles around the thick vertex, every quantity is affine in each triangle. Instead of the
// fan, its outline is drawn, 1 or 2 triangles, and the fan's pieces are told apart per fragment: the tent that is 0 on
// the outline and 1 at the thick vertex is the minimum of affine functions, one an edge, and
//   thickness = tent x thickness at the apex,   back value = front value + tent x their difference at the apex
// (or the other way round), where the side that is one plane over the triangle is interpolated. Less than half the
// triangles, all of whose corners are vertices of the mesh: nothing can crack or fold over.

@group(1) @binding(0) var<storage, read> vertices: array<vec4f>;
@group(1) @binding(1) var<storage, read> gradients: array<f32>;
@group(3) @binding(0) var<uniform> chunk: Chunk;
@group(3) @binding(1) var<storage, read> counts: Counts;
@group(3) @binding(2) var<storage, read> order: array<u32>; // cells, back to front
@group(3) @binding(3) var<storage, read> projected: array<vec2f>;
// Four corners a cell; per corner: clip xy; 1/z and scalar/z; its peak (see `raster`); then, of the first corner alone, at the
// apex, the thickness (negative where the front is the interpolated side) and
// the change of scalar/z from the interpolated to the other side; with BIVARIATE gradient/z and its change.
//
// Few and plain stores: on software adapters each costs as much as a hundred operations.
@group(3) @binding(5) var<storage, read_write> corners: array<f32>;

struct Chunk {
    first_cell: u32,
    cells: u32,
    pad_a: u32,
    pad_b: u32,
}

override BIVARIATE: bool = false;

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

const FLOATS: u32 = 7u;
const BIVARIATE_FLOATS: u32 = 9u;

// How far the rasteriser's grid moves a vertex at view position v, in mesh space: sideways, its depth stays.
fn moved(v: vec3f, vertex: u32) -> vec3f {
    var depth = 1.0;
    if PERSPECTIVE {
        depth = max(dot(frame.forward, v), 1e-30);
    }
    let shift = (projected[vertex] - clip_from_view(v, 1.0 / depth)) * depth;
    return shift.x * frame.x_axis + shift.y * frame.y_axis;
}

struct Apex {
    thickness: f32,
    scalar_change: f32,
    gradient_change: f32,
}

fn put_corner(at: u32, vertex: u32, inverse_depth: f32, scalar: f32, gradient: f32, peak: f32) {
    // Bits that all cells around the vertex share: rasterisation is watertight.
    let clip = projected[vertex];
    corners[at] = clip.x;
    corners[at + 1u] = clip.y;
    corners[at + 2u] = inverse_depth;
    corners[at + 3u] = scalar * inverse_depth;
    corners[at + 4u] = peak;
    if BIVARIATE {
        corners[at + 7u] = gradient * inverse_depth;
    }
}

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let place = id.x;
    let rank = chunk.first_cell + place;
    if place >= chunk.cells || rank >= counts.survivors {
        return;
    }
    let cell = order[rank];
    let tet = tet_at(cell);
    let p0 = vertices[tet.x];
    let p1 = vertices[tet.y];
    let p2 = vertices[tet.z];
    let p3 = vertices[tet.w];
    let m0 = moved(from_eye(p0.xyz), tet.x);
    let m1 = moved(from_eye(p1.xyz), tet.y);
    let m2 = moved(from_eye(p2.xyz), tet.z);
    let m3 = moved(from_eye(p3.xyz), tet.w);
    let v0 = from_eye(p0.xyz) + m0;
    let v1 = from_eye(p1.xyz) + m1;
    let v2 = from_eye(p2.xyz) + m2;
    let v3 = from_eye(p3.xyz) + m3;
    let e01 = p1.xyz - p0.xyz;
    let e02 = p2.xyz - p0.xyz;
    let e03 = p3.xyz - p0.xyz;
    let n01 = e01 + (m1 - m0);
    let n02 = e02 + (m2 - m0);
    let n03 = e03 + (m3 - m0);
    // The moved cell's volume: the given one's, which keeps its digits in slivers, and three small differences.
    let given = volumes[cell];
    let parity = select(1.0, -1.0, given < 0.0);
    let volume = parity * (given + (dot(cross(m1 - m0, e02), e03) + dot(cross(n01, m2 - m0), e03)
        + dot(cross(n01, n02), m3 - m0)));
    let mu = parity * vec4f(face_weight(v1, (p2.xyz - p1.xyz) + (m2 - m1), (p3.xyz - p1.xyz) + (m3 - m1)),
                            -face_weight(v0, n02, n03), face_weight(v0, n01, n03), -face_weight(v0, n01, n02));
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
    // So does one that moving its vertices to the rasteriser's grid turned inside out: smaller than that grid.
    if front_sum > least && back_sum > least && volume > 0.0 {
        apex.thickness = volume * scales.x;
    }
    let scalars = vec4f(p0.w, p1.w, p2.w, p3.w);
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
    var inverse_depths = vec4f(1.0);
    if PERSPECTIVE {
        let depths = vec4f(dot(frame.forward, v0), dot(frame.forward, v1), dot(frame.forward, v2), dot(frame.forward, v3));
        shares *= depths;
        inverse_depths = 1.0 / max(depths, vec4f(1e-30));
    }
    let peaks = select(1.0, -1.0, count == 2u) / max(shares, vec4f(1e-7));
    let ring = outline(front, count);
    let size = select(FLOATS, BIVARIATE_FLOATS, BIVARIATE);
    let at = place * 4u * size;
    put_corner(at, tet[ring.x], inverse_depths[ring.x], scalars[ring.x], g[ring.x], peaks[ring.x]);
    put_corner(at + size, tet[ring.y], inverse_depths[ring.y], scalars[ring.y], g[ring.y], peaks[ring.y]);
    put_corner(at + 2u * size, tet[ring.z], inverse_depths[ring.z], scalars[ring.z], g[ring.z], peaks[ring.z]);
    put_corner(at + 3u * size, tet[ring.w], inverse_depths[ring.w], scalars[ring.w], g[ring.w], peaks[ring.w]);
    corners[at + 5u] = apex.thickness;
    corners[at + 6u] = apex.scalar_change;
    if BIVARIATE {
        corners[at + 8u] = apex.gradient_change;
    }
}
