#import shared/light
#import shared/linked
#import shared/ray
#import shared/transfer

// Rays from cell to cell, front to back (HARC; Weiler et al. 2003). What is done with an occupied cell that is passed,
// `meet` says, and with a segment, `compose`; the passes define these (raycast.wgsl, raylist.wgsl). The walk is that of
// src/cpu/walk.rs, where is told why
// no ray gets lost: seen along the ray a cell's faces hold it either not at all, or once on the way in and once on the
// way out, by signs that do not depend on rounding.
//
// Where rays enter: through the boundary faces of their tile that hold them, one walk each, in the order of depth. The next
// one is searched for when a walk has ended, so that there is no limit to their number.
//
// A dispatch ends rays after MOST_TURNS turns of loops; those that have not come through go on in the next one from what
// they left in `states`. Devices stop what takes long, and lavapipe ends all loops of an invocation after 65,535 turns.

@group(3) @binding(0) var<storage, read> occupied: array<u32>; // one bit a cell: not transparent
// Where the sides of each group of linked cells around the eye begin, and the last's end, in this array; where each
// tile's sides begin, and the last's end; sides around the eye; the tiles' sides. A side is eight times the cell, plus
// twice the corner that is not on it, plus one where the last two of the others, ascending, are to be exchanged to be
// counter-clockwise from outside.
@group(3) @binding(1) var<storage, read> entries: array<u32>;
// Four words of a vector a pixel of the slab (see `load_way`).
@group(3) @binding(4) var<storage, read_write> states: array<vec4u>;
@group(3) @binding(5) var<storage, read_write> unfinished: atomic<u32>;
// Cells entered, steps whose exit lies before their entry, and walks given up, in each tile.
@group(3) @binding(3) var<storage, read_write> tallies: array<atomic<u32>>;

override SHADED: bool = false;

// Those of gpu/raycast.rs: pixels along a tile's side, vectors of a ray's state, counts of a tile.
const TILE: u32 = 8u;
const STATE_VECTORS: u32 = 4u;
const TALLIES: u32 = 3u;
const FAR = 1e30;
const NO_SIDE = 0xffffffffu;
// Mesh units: what lies nearer behind a place than this is at that place.
override HAIR: f32;
// Mesh units: walks that overlap by less are said to meet.
override TOUCH: f32;

override MOST_TURNS: u32 = 8192u;

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

// Where a ray enters.
struct Entry {
    depth: f32,
    side: u32,
}

// What a ray has seen so far, and where it is.
struct Way {
    color: vec3f,
    transmittance: f32,
    // Where the walk goes on; NO_SIDE between walks.
    side: u32,
    // Depth up to which the walk has done all, or which is not seen.
    reached: f32,
    // Where the farthest walk has ended.
    exit: f32,
    // How far the ray is done by walks from cells of this group: others of these cells were passed on the way.
    covered: f32,
    // First come the cells around the eye, group by group: rays enter them where their line does, behind the eye.
    group: u32,
    // Two cells are passed at once: what is seen of them lies in the order of walks.
    overlaps: bool,
    // The last.
    entry: Entry,
    // The nearest one found behind it, how many there are, and what was searched.
    next: Entry,
    found: u32,
    index: u32,
    // Steps of the walk.
    walked: u32,
    // Since the dispatch began.
    steps: u32,
    repaired: u32,
    lost: u32,
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
    t.edges = areas(t.x.yzx, t.y.yzx, t.x.zxy, t.y.zxy);
    return t;
}

// Weights of the corners where the ray is on the face; zeros where that is seen edge-on.
fn weights_of(t: Triangle) -> vec3f {
    // Areas are whole numbers; rounded ones may fall short of 0.
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

// Looks for the nearest side of entries[.. end] through which the ray enters beyond `after` and behind its last entry, while
// there are turns.
fn search(ray: Ray, way: ptr<function, Way>, end: u32, after: f32) {
    let last = (*way).entry;
    for (; (*way).index < end && turns_taken < MOST_TURNS; (*way).index++) {
        turns_taken++;
        let side = entries[(*way).index];
        let t = outline(ray, side);
        let holds = all(turn_left(t.edges, t.x.yzx, t.y.yzx, t.x.zxy, t.y.zxy, t.ranks.yzx < t.ranks.zxy));
        let weights = weights_of(t);
        let depth = select(t.depths.x, dot(t.depths, weights), any(weights > vec3f(0.0)));
        if holds && depth > after && (depth > last.depth || (depth == last.depth && side > last.side)) {
            (*way).found++;
            let next = (*way).next;
            if depth < next.depth || (depth == next.depth && side < next.side) {
                (*way).next = Entry(depth, side);
            }
        }
    }
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

// Through cells, from the one behind `way.side`, to the boundary, or until nothing more is seen or turns run out.
fn walk(ray: Ray, way: ptr<function, Way>) {
    var cell = (*way).side >> 3u;
    var corner = ((*way).side >> 1u) & 3u; // not on the face
    var t = enter(ray, (*way).side);
    // Where the ray was last on a face that is not seen edge-on.
    var weights = weights_of(t);
    var is_edge_on = all(weights == vec3f(0.0));
    var at = values_of(t, select(weights, vec3f(1.0, 0.0, 0.0), is_edge_on));
    if (*way).walked == 0u {
        (*way).reached = max(at.depth, rays.near);
    }
    // Where the walk is given up, it goes on from a face that tells where the ray is.
    while turns_taken < MOST_TURNS || is_edge_on {
        turns_taken++;
        (*way).walked++;
        let slot = slot_at(cell, corner);
        let p = place_at(slot);
        let place = place_across(ray, p);
        let numbers = numbers_of(t.ranks, corner);
        // Of the triangles of the new corner and two others, the ray is in the one between an edge that turns left and one
        // that does not: the corner opposite is left behind.
        let x = vec3f(place.x);
        let y = vec3f(place.y);
        let crosses = areas(x, y, t.x, t.y);
        let lefts = turn_left(crosses, x, y, t.x, t.y, vec3u(corner) < numbers);
        let leaves = lefts.yzx & !lefts.zxy;
        let left = dot(select(vec3u(0u), numbers, leaves), vec3u(1u));
        t.ranks = select(numbers - select(vec3u(0u), vec3u(1u), numbers > vec3u(left)),
                         vec3u(corner - select(0u, 1u, corner > left)), leaves);
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
        is_edge_on = all(weights == vec3f(0.0));
        let is_occupied = (occupied[cell >> 5u] & (1u << (cell & 31u))) != 0u;
        if is_occupied {
            meet();
        }
        if !is_edge_on {
            let next = values_of(t, weights);
            if next.depth > (*way).reached {
                if is_occupied {
                    compose(ray, at, next, way);
                }
                (*way).reached = next.depth;
            }
            (*way).repaired += select(0u, 1u, next.depth < at.depth);
            at = next;
        }
        cell = link >> 2u;
        corner = link & 3u;
        // A walk enters no cell twice: the bound guards against a mesh that is none.
        if link == NO_LINK || (*way).transmittance <= rays.least_transmittance || (*way).walked > CELLS {
            (*way).lost += select(0u, 1u, (*way).walked > CELLS);
            (*way).steps += (*way).walked;
            (*way).side = NO_SIDE;
            (*way).covered = max((*way).covered, at.depth);
            (*way).exit = max((*way).exit, at.depth);
            return;
        }
    }
    // Ranks are (0, 1, 2) turned round, or the same with two exchanged.
    let flipped = t.ranks.y != (t.ranks.x + 1u) % 3u;
    (*way).side = cell << 3u | corner << 1u | select(0u, 1u, flipped);
}

// Where a segment begins that all is done of up to `reached`, or not seen.
fn start_of(front: Values, back: Values, reached: f32) -> Values {
    var start = front;
    if front.depth < reached {
        let share = (reached - front.depth) / (back.depth - front.depth);
        start.scalar = mix(front.scalar, back.scalar, share);
        start.gradient = mix(front.gradient, back.gradient, share);
        start.vector = mix(front.vector, back.vector, share);
    }
    return start;
}

fn new_way() -> Way {
    let start = Entry(-FAR, 0u);
    let next = Entry(FAR, NO_SIDE);
    return Way(vec3f(0.0), 1.0, NO_SIDE, 0.0, -FAR, -FAR, 0u, false, start, next, 0u, NO_SIDE, 0u, 0u, 0u, 0u);
}

fn load_way(at: u32) -> Way {
    let a = bitcast<vec4f>(states[at]);
    let b = states[at + 1u];
    let c = states[at + 2u];
    let d = states[at + 3u];
    return Way(a.rgb, a.w, b.x, bitcast<f32>(b.y), bitcast<f32>(b.w), bitcast<f32>(b.z), d.w >> 2u, (d.w & 2u) != 0u,
               Entry(bitcast<f32>(c.x), c.y), Entry(bitcast<f32>(c.z), c.w), d.x, d.y, d.z, 0u, 0u, 0u);
}

fn store_way(at: u32, way: Way, is_done: bool) {
    states[at] = bitcast<vec4u>(vec4f(way.color, way.transmittance));
    states[at + 1u] = vec4u(way.side, bitcast<u32>(way.reached), bitcast<u32>(way.covered), bitcast<u32>(way.exit));
    states[at + 2u] = vec4u(bitcast<u32>(way.entry.depth), way.entry.side, bitcast<u32>(way.next.depth), way.next.side);
    let flags = select(0u, 1u, is_done) | select(0u, 2u, way.overlaps) | way.group << 2u;
    states[at + 3u] = vec4u(way.found, way.index, way.walked, flags);
}

fn was_done(at: u32) -> bool {
    return (states[at + 3u].w & 1u) != 0u;
}

// The sides of a tile, in `entries`.
fn list_of_tile(tile: u32) -> vec2u {
    return vec2u(entries[rays.groups + 1u + tile], entries[rays.groups + 2u + tile]);
}

// Goes on with a ray; whether it has come through.
fn trace(ray: Ray, list: vec2u, way: ptr<function, Way>) -> bool {
    while turns_taken < MOST_TURNS {
        turns_taken++;
        let in_group = (*way).group < rays.groups;
        if (*way).side != NO_SIDE {
            walk(ray, way);
            if (*way).side == NO_SIDE {
                // The last of them was found to be the last. Behind an opaque one, the next may begin before that.
                if (*way).found == 1u && !in_group {
                    return true;
                }
                (*way).index = NO_SIDE;
            }
        } else {
            let group = min((*way).group, rays.groups);
            let part = select(list, vec2u(entries[group], entries[group + 1u]), in_group);
            if (*way).index == NO_SIDE {
                (*way).index = part.x;
                (*way).next = Entry(FAR, NO_SIDE);
                (*way).found = 0u;
            }
            // Behind the eye a ray's line may enter the mesh, too. What it has passed at the eye is around that.
            search(ray, way, part.y, select(rays.eye, -FAR, in_group));
            if (*way).index == part.y {
                if (*way).found == 0u && !in_group {
                    return true;
                }
                (*way).index = NO_SIDE;
                if (*way).found == 0u {
                    (*way).group++;
                    (*way).entry = Entry(-FAR, 0u);
                    (*way).covered = -FAR;
                } else {
                    let next = (*way).next;
                    (*way).entry = next;
                    if !in_group || next.depth >= (*way).covered - HAIR {
                        // Cells around the eye that are not linked fill one place.
                        let begins_before = in_group && (*way).covered == -FAR && (*way).exit > -FAR;
                        let lies_before = !in_group && next.depth < (*way).exit - TOUCH;
                        (*way).overlaps = (*way).overlaps || begins_before || lies_before;
                        if (*way).transmittance <= rays.least_transmittance {
                            return true;
                        }
                        (*way).side = next.side;
                        (*way).walked = 0u;
                    }
                }
            }
        }
    }
    return false;
}
