#import shared/light
#import shared/linked
#import shared/ray
#import shared/transfer

// Rays from cell to cell, front to back (HARC; Weiler et al. 2003). The walk is that of src/cpu/walk.rs, where is told why
// no ray gets lost: seen along the ray a cell's faces hold it either not at all, or once on the way in and once on the
// way out, by signs that do not depend on rounding.
//
// Where rays enter: through the boundary faces of their tile that hold them, one walk each, in the order of depth. The next
// one is searched for when a walk has ended, so that there is no limit to their number.

@group(3) @binding(0) var<storage, read> occupied: array<u32>; // one bit a cell: not transparent
// The sides around the eye; where each tile's sides begin (and the last's end), in this array; the tiles' sides. A side
// is eight times the cell, plus twice the corner that is not on it, plus one where the last two of the others,
// ascending, are to be exchanged to be counter-clockwise from outside.
@group(3) @binding(1) var<storage, read> entries: array<u32>;
@group(3) @binding(2) var picture: texture_storage_2d<rgba32float, write>;
// Cells entered, and walks given up, in each tile.
@group(3) @binding(3) var<storage, read_write> tallies: array<atomic<u32>>;

override SHADED: bool = false;

const TILE = 8u; // gpu/raycast.rs
const FAR = 1e30;
const NO_SIDE = 0xffffffffu;
// Mesh units: what lies nearer behind a place than this is at that place.
const HAIR = 1e-6;
// Fewer turns than lavapipe ends a loop after.
const TURNS = 32768u;

// Values along a ray.
struct Values {
    depth: f32,
    scalar: f32,
    gradient: f32,
    // Mesh space.
    vector: vec3f,
}

// A face seen along the ray, counter-clockwise around it; a component a corner.
struct Triangle {
    x: vec3f,
    y: vec3f,
    // Which of the face's corners each is, in ascending order.
    ranks: vec3u,
    // Twice the area of the triangle of the ray and the edge opposite each corner.
    edges: vec3f,
    depths: vec3f,
    scalars: vec3f,
    gradients: vec3f,
    vectors: mat3x3f,
}

// The next entry of a ray.
struct Entry {
    depth: f32,
    side: u32,
    // Entries from there on, this one included.
    count: u32,
}

// The numbers of a cell's corners from their ranks among all but `without`.
fn numbers_of(ranks: vec3u, without: u32) -> vec3u {
    return ranks + select(vec3u(0u), vec3u(1u), ranks >= vec3u(without));
}

// Places and depths of a side; the rest is left 0.
fn outline(ray: Ray, side: u32) -> Triangle {
    var t: Triangle;
    t.ranks = select(vec3u(0u, 1u, 2u), vec3u(0u, 2u, 1u), (side & 1u) != 0u);
    let numbers = numbers_of(t.ranks, (side >> 1u) & 3u);
    let a = place_at(slot_at(side >> 3u, numbers.x));
    let b = place_at(slot_at(side >> 3u, numbers.y));
    let c = place_at(slot_at(side >> 3u, numbers.z));
    let p = place_across(ray, a);
    let q = place_across(ray, b);
    let r = place_across(ray, c);
    t.x = vec3f(p.x, q.x, r.x);
    t.y = vec3f(p.y, q.y, r.y);
    t.depths = vec3f(depth_of(a), depth_of(b), depth_of(c));
    t.edges = t.x.yzx * t.y.zxy - t.y.yzx * t.x.zxy;
    return t;
}

// Weights of the corners where the ray is on the face; zeros where that is seen edge-on.
fn weights_of(t: Triangle) -> vec3f {
    let edges = max(t.edges, vec3f(0.0));
    let sum = edges.x + edges.y + edges.z;
    return select(vec3f(0.0), edges / max(sum, 1.0), sum >= 1.0);
}

fn values_of(t: Triangle, weights: vec3f) -> Values {
    var values = Values(dot(t.depths, weights), dot(t.scalars, weights), 0.0, vec3f(0.0));
    if BIVARIATE {
        values.gradient = dot(t.gradients, weights);
    }
    if SHADED {
        values.vector = t.vectors * weights;
    }
    return values;
}

// The nearest side of entries[list.x .. list.y] through which the ray enters behind the last one.
fn next_entry(ray: Ray, list: vec2u, behind: Entry) -> Entry {
    var next = Entry(FAR, NO_SIDE, 0u);
    for (var first = list.x; first < list.y; first += TURNS) {
        for (var i = first; i < min(first + TURNS, list.y); i++) {
            let side = entries[i];
            let t = outline(ray, side);
            let holds = all(turn_left(t.x.yzx, t.y.yzx, t.x.zxy, t.y.zxy, t.ranks.yzx < t.ranks.zxy));
            let weights = weights_of(t);
            let depth = select(t.depths.x, dot(t.depths, weights), any(weights > vec3f(0.0)));
            if holds && (depth > behind.depth || (depth == behind.depth && side > behind.side)) {
                next.count++;
                if depth < next.depth || (depth == next.depth && side < next.side) {
                    next.depth = depth;
                    next.side = side;
                }
            }
        }
    }
    return next;
}

// On a side, with all values.
fn enter(ray: Ray, side: u32) -> Triangle {
    var t = outline(ray, side);
    let numbers = numbers_of(t.ranks, (side >> 1u) & 3u);
    let slots = vec3u(slot_at(side >> 3u, numbers.x), slot_at(side >> 3u, numbers.y), slot_at(side >> 3u, numbers.z));
    t.scalars = vec3f(scalars[slots.x], scalars[slots.y], scalars[slots.z]);
    if BIVARIATE {
        t.gradients = vec3f(gradients[slots.x], gradients[slots.y], gradients[slots.z]);
    }
    if SHADED {
        t.vectors = mat3x3f(gradient_vector_at(slots.x), gradient_vector_at(slots.y), gradient_vector_at(slots.z));
    }
    return t;
}

// What is seen of a cell's segment: premultiplied colour and transmittance.
fn seen_between(ray: Ray, front: Values, back: Values, extent: f32) -> vec4f {
    let ends = clamp(vec2f(front.scalar, back.scalar), vec2f(0.0), vec2f(1.0));
    let magnitudes = clamp(vec2f(front.gradient, back.gradient), vec2f(0.0), vec2f(1.0));
    if !SHADED {
        return segment(ends, magnitudes, extent);
    }
    let middle = 0.5 * (front.vector + back.vector);
    let in_view = vec3f(dot(rays.right, middle), dot(rays.up, middle), dot(rays.forward, middle));
    let f = factors(in_view, ray.film, vec4f(light.direction, light.ambient),
                    vec4f(light.diffuse, light.specular, light.shininess, light.strength), light.exponent);
    return with_factors(segment(ends, magnitudes, extent * f.density), f);
}

// What a ray has seen so far.
struct Way {
    color: vec3f,
    transmittance: f32,
    // Depth up to which all is done.
    reached: f32,
    steps: u32,
    lost: u32,
}

// Through the cell behind a side, and all that follow, to the boundary or until nothing more is seen.
fn walk(ray: Ray, side: u32, way: ptr<function, Way>) {
    var cell = side >> 3u;
    var corner = (side >> 1u) & 3u; // not on the face
    var t = enter(ray, side);
    // Where the ray was last on a face that is not seen edge-on.
    var weights = weights_of(t);
    if all(weights == vec3f(0.0)) {
        weights = vec3f(1.0, 0.0, 0.0);
    }
    var at = values_of(t, weights);
    (*way).reached = max(at.depth, rays.near);
    let steps_before = (*way).steps;
    var goes_on = true;
    while goes_on {
        for (var turn = 0u; turn < TURNS && goes_on; turn++) {
            (*way).steps++;
            let slot = slot_at(cell, corner);
            let p = place_at(slot);
            let place = place_across(ray, p);
            let numbers = numbers_of(t.ranks, corner);
            // Of the triangles of the new corner and two others, the ray is in the one between an edge that turns left and
            // one that does not: the corner opposite is left behind.
            let x = vec3f(place.x);
            let y = vec3f(place.y);
            let lefts = turn_left(x, y, t.x, t.y, vec3u(corner) < numbers);
            let leaves = lefts.yzx & !lefts.zxy;
            let left = dot(select(vec3u(0u), numbers, leaves), vec3u(1u));
            t.ranks = select(numbers - select(vec3u(0u), vec3u(1u), numbers > vec3u(left)),
                             vec3u(corner - select(0u, 1u, corner > left)), leaves);
            let crosses = x * t.y - y * t.x;
            t.edges = select(select(t.edges, crosses.zxy, leaves.yzx), -crosses.yzx, leaves.zxy);
            t.x = select(t.x, x, leaves);
            t.y = select(t.y, y, leaves);
            t.depths = select(t.depths, vec3f(depth_of(p)), leaves);
            t.scalars = select(t.scalars, vec3f(scalars[slot]), leaves);
            if BIVARIATE {
                t.gradients = select(t.gradients, vec3f(gradients[slot]), leaves);
            }
            if SHADED {
                let vector = gradient_vector_at(slot);
                t.vectors = mat3x3f(select(t.vectors[0], vector, leaves.x), select(t.vectors[1], vector, leaves.y),
                                    select(t.vectors[2], vector, leaves.z));
            }
            let link = link_at(cell, left);
            weights = weights_of(t);
            if any(weights > vec3f(0.0)) {
                let next = values_of(t, weights);
                if next.depth > (*way).reached {
                    if (occupied[cell >> 5u] & (1u << (cell & 31u))) != 0u {
                        compose(ray, at, next, way);
                    }
                    (*way).reached = next.depth;
                }
                at = next;
            }
            cell = link >> 2u;
            corner = link & 3u;
            goes_on = link != NO_LINK && (*way).transmittance > rays.least_transmittance;
        }
        // A walk enters no cell twice: this guards against a mesh that is none.
        if goes_on && (*way).steps - steps_before > CELLS {
            (*way).lost++;
            goes_on = false;
        }
    }
}

// Composes the segment from where all is done to `back`.
fn compose(ray: Ray, start: Values, back: Values, way: ptr<function, Way>) {
    var front = start;
    if front.depth < (*way).reached {
        // Some of the segment is done, or not seen.
        let share = ((*way).reached - front.depth) / (back.depth - front.depth);
        front.scalar = mix(front.scalar, back.scalar, share);
        front.gradient = mix(front.gradient, back.gradient, share);
        front.vector = mix(front.vector, back.vector, share);
    }
    let seen = seen_between(ray, front, back, (back.depth - (*way).reached) * ray.stretch);
    (*way).color += (*way).transmittance * seen.rgb;
    (*way).transmittance *= seen.a;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_id) local: vec3u) {
    let pixel = group.xy * TILE + local.xy;
    if any(pixel >= rays.size) {
        return;
    }
    let ray = ray_through(pixel);
    let tile = group.y * groups.x + group.x;
    let list = vec2u(entries[rays.around + tile], entries[rays.around + tile + 1u]);
    var way = Way(vec3f(0.0), 1.0, 0.0, 0u, 0u);
    // How far the ray is done by walks that did not begin at the boundary: what they passed must not be passed again.
    var covered = -FAR;
    // First come the cells around the eye: rays enter them where their line does, behind the eye.
    var is_around = rays.around > 0u;
    var entry = Entry(-FAR, 0u, 0u);
    loop {
        entry = next_entry(ray, select(list, vec2u(0u, rays.around), is_around), entry);
        if entry.count == 0u {
            if !is_around {
                break;
            }
            is_around = false;
            entry = Entry(-FAR, 0u, 0u);
            continue;
        }
        if entry.depth >= covered - HAIR {
            walk(ray, entry.side, &way);
            covered = select(covered, max(covered, way.reached), is_around);
        }
        if way.transmittance <= rays.least_transmittance || (entry.count == 1u && !is_around) {
            break;
        }
    }
    atomicAdd(&tallies[2u * tile], way.steps);
    atomicAdd(&tallies[2u * tile + 1u], way.lost);
    textureStore(picture, pixel, vec4f(way.color, 1.0 - way.transmittance) + way.transmittance * rays.background);
}
