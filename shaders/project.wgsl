#import shared/frame
#import shared/range

// Projects each surviving cell: class, silhouette and thick vertex (Shirley & Tuchman 1990), in the form of Radon
// weights (optics.md 6.2): one formula for all classes and degeneracies, no 2D intersection, no difference of depths.
//
// A cell becomes a fan of 4 triangles around the thick vertex; of class 1 (a triangle on screen) the fourth is empty.

@group(1) @binding(0) var<storage, read> tets: array<vec4u>; // of the range; vertex ids ascend
@group(1) @binding(1) var<storage, read> volumes: array<f32>; // of the range: 6 x volume, negative where odd
@group(1) @binding(2) var<storage, read> vertices: array<vec4f>;
@group(1) @binding(3) var<storage, read> gradients: array<f32>;
@group(3) @binding(1) var<storage, read> projected: array<vec4f>;
@group(3) @binding(2) var<storage, read> survivors: array<u32>; // one bit a cell of the range
@group(3) @binding(3) var<storage, read> block_offsets: array<u32>; // of the range
@group(3) @binding(4) var<storage, read_write> silhouettes: array<vec4u>; // vertex ids around the outline
@group(3) @binding(5) var<storage, read_write> thick: array<vec4f>; // clip x, clip y, 1/z front, 1/z front - 1/z back
@group(3) @binding(6) var<storage, read_write> thick_scalars: array<vec2f>; // scalar/z at front and back
@group(3) @binding(7) var<storage, read_write> thick_gradients: array<vec2f>;
@group(3) @binding(8) var<storage, read_write> keys: array<u32>; // ascending = back to front
@group(3) @binding(9) var<storage, read_write> order: array<u32>;

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

// The rank of cell i among the survivors.
fn slot_of(i: u32) -> u32 {
    let block = i >> 8u;
    let word = i >> 5u;
    var before = countOneBits(survivors[word] & ((1u << (i & 31u)) - 1u));
    for (var w = block * 8u; w < word; w++) {
        before += countOneBits(survivors[w]);
    }
    return block_offsets[block] + before;
}

// Bits that sort floats descending.
fn far_first(depth: f32) -> u32 {
    let bits = bitcast<u32>(depth);
    return ~select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
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

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let i = id.x + id.y * groups.x * 256u;
    if i >= range.tet_count || (survivors[i >> 5u] & (1u << (i & 31u))) == 0u {
        return;
    }
    let tet = tets[i];
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
    let volume = volumes[i];
    let parity = select(1.0, -1.0, volume < 0.0);
    let mu = parity * vec4f(face_weight(v1, p2.xyz - p1.xyz, p3.xyz - p1.xyz), -face_weight(v0, e02, e03),
                            face_weight(v0, e01, e03), -face_weight(v0, e01, e02));
    let front = mu > vec4f(0.0);
    let front_weights = max(mu, vec4f(0.0));
    let back_weights = max(-mu, vec4f(0.0));
    let front_sum = dot(front_weights, vec4f(1.0));
    let back_sum = dot(back_weights, vec4f(1.0));
    let scalars = vec4f(p0.w, p1.w, p2.w, p3.w);

    let point = front_weights.x * v0 + front_weights.y * v1 + front_weights.z * v2 + front_weights.w * v3;
    let slot = slot_of(i);
    // A cell seen exactly edge-on has no weight at all: it gets a thickness of zero.
    let floor_weight = 1e-37;
    var scale = 1.0 / max(dot(frame.forward, point), floor_weight);
    var front_scale = scale;
    var back_scale = scale;
    var thickness = abs(volume) * scale;
    var inverse_front = front_sum * scale;
    if !PERSPECTIVE {
        front_scale = 1.0 / max(front_sum, floor_weight);
        back_scale = 1.0 / max(back_sum, floor_weight);
        scale = front_scale;
        thickness = abs(volume) * front_scale;
        inverse_front = 1.0;
    }
    if !(front_sum > floor_weight && back_sum > floor_weight) {
        thickness = 0.0;
    }
    let xy = vec2f(dot(frame.x_row, point), dot(frame.y_row, point)) * scale;
    let count = u32(front.x) + u32(front.y) + u32(front.z) + u32(front.w);
    silhouettes[slot] = outline(front, count, tet);
    thick[slot] = vec4f(xy, inverse_front, thickness);
    thick_scalars[slot] = vec2f(dot(front_weights, scalars) * front_scale, dot(back_weights, scalars) * back_scale);
    if BIVARIATE {
        let g = vec4f(gradients[tet.x], gradients[tet.y], gradients[tet.z], gradients[tet.w]);
        thick_gradients[slot] = vec2f(dot(front_weights, g) * front_scale, dot(back_weights, g) * back_scale);
    }
    keys[slot] = far_first(dot(frame.forward, v0 + v1 + v2 + v3) * 0.25);
    order[slot] = slot;
}
