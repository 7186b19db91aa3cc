#import shared/frame
#import shared/counts
#import shared/tets

// Projects the surviving cells of one chunk, in the order of drawing: class, silhouette and thick vertex (Shirley &
// Tuchman 1990), in the form of Radon weights (optics.md 6.2): one formula for all classes and degeneracies, no 2D
// intersection, no difference of depths.
//
// A cell becomes 5 corners, drawn as a fan of 4 triangles around the last; of class 1 (a triangle on screen) the fourth
// is empty.

@group(1) @binding(0) var<storage, read> vertices: array<vec4f>;
@group(1) @binding(1) var<storage, read> gradients: array<f32>;
@group(3) @binding(0) var<uniform> chunk: Chunk;
@group(3) @binding(1) var<storage, read> counts: Counts;
@group(3) @binding(2) var<storage, read> order: array<u32>; // cells, back to front
@group(3) @binding(3) var<storage, read> projected: array<vec4f>;
@group(3) @binding(4) var<storage, read> projected_gradients: array<f32>;
// Per corner: clip xy; 1/z front, 1/z front - 1/z back; scalar/z front, back; with BIVARIATE gradient/z front, back.
@group(3) @binding(5) var<storage, read_write> corners: array<vec2f>;

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

fn signed_area(a: vec2f, b: vec2f, c: vec2f) -> f32 {
    let u = b - a;
    let v = c - a;
    return u.x * v.y - u.y * v.x;
}

// The outline, counter-clockwise on screen: the vertices of one sign and those of the other alternate; where three
// share a sign, the fourth lies inside and the first is named twice.
fn outline(front: vec4<bool>, count: u32, tet: vec4u) -> vec4u {
    var ring: vec4u;
    if count == 2u {
        if front.x == front.y {
            ring = tet.xzyw;
        } else if front.x == front.z {
            ring = tet.xyzw;
        } else {
            ring = tet.xywz;
        }
    } else {
        let odd = count == 1u; // the vertex inside is the only one in front, or the only one behind
        if front.x == odd && front.y != odd {
            ring = tet.yzwy;
        } else if front.y == odd && front.x != odd {
            ring = tet.xzwx;
        } else if front.z == odd {
            ring = tet.xywx;
        } else {
            ring = tet.xyzx;
        }
    }
    let a = projected[ring.x].xy;
    let b = projected[ring.y].xy;
    let c = projected[ring.z].xy;
    var area = signed_area(a, b, c);
    if count == 2u {
        let d = projected[ring.w].xy;
        area = (c.x - a.x) * (d.y - b.y) - (c.y - a.y) * (d.x - b.x);
        if area < 0.0 {
            ring = ring.xwzy;
        }
    } else if area < 0.0 {
        ring = ring.xzyx;
    }
    return ring;
}

fn put_corner(place: u32, corner: u32, xy: vec2f, depths: vec2f, scalars: vec2f, g: vec2f) {
    if BIVARIATE {
        let at = place * 20u + corner * 4u;
        corners[at] = xy;
        corners[at + 1u] = depths;
        corners[at + 2u] = scalars;
        corners[at + 3u] = g;
    } else {
        let at = place * 15u + corner * 3u;
        corners[at] = xy;
        corners[at + 1u] = depths;
        corners[at + 2u] = scalars;
    }
}

fn put_outline(place: u32, corner: u32, vertex: u32) {
    let p = projected[vertex];
    var g = 0.0;
    if BIVARIATE {
        g = projected_gradients[vertex];
    }
    put_corner(place, corner, p.xy, vec2f(p.z, 0.0), p.ww, vec2f(g));
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
    var inverse_front = front_sum * scales.x;
    if !PERSPECTIVE {
        scales = 1.0 / max(vec2f(front_sum, back_sum), vec2f(least));
        inverse_front = 1.0;
    }
    var thickness = 0.0;
    if front_sum > least && back_sum > least {
        thickness = abs(volume) * scales.x;
    }
    let xy = vec2f(dot(frame.x_row, point), dot(frame.y_row, point)) * scales.x;
    let scalars = vec4f(p0.w, p1.w, p2.w, p3.w);
    var thick_gradients = vec2f(0.0);
    if BIVARIATE {
        let g = vec4f(gradients[tet.x], gradients[tet.y], gradients[tet.z], gradients[tet.w]);
        thick_gradients = vec2f(dot(front_weights, g), dot(back_weights, g)) * scales;
    }
    let count = u32(front.x) + u32(front.y) + u32(front.z) + u32(front.w);
    let ring = outline(front, count, tet);
    put_outline(place, 0u, ring.x);
    put_outline(place, 1u, ring.y);
    put_outline(place, 2u, ring.z);
    put_outline(place, 3u, ring.w);
    put_corner(place, 4u, xy, vec2f(inverse_front, thickness),
               vec2f(dot(front_weights, scalars), dot(back_weights, scalars)) * scales, thick_gradients);
}
