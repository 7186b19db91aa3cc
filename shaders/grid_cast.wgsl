#import shared/grid
#import shared/ray
#import shared/transfer

// Rays through a grid's voxels, front to back: the planes of samples part each ray, and from plane to plane it only ever goes
// on (after Amanatides & Woo 1987), so that none is lost and none stays. Of a voxel's five tetrahedra a ray meets three
// at most: one that is cut off, the middle, and another one that is cut off.

@group(3) @binding(0) var<storage, read> blocks: array<vec2u>; // grid_marks.wgsl
@group(3) @binding(1) var picture: texture_storage_2d<rgba32float, write>;
// Two words of a vector a pixel of the slab (see `load_way`).
@group(3) @binding(2) var<storage, read_write> states: array<vec4u>;
@group(3) @binding(3) var<storage, read_write> unfinished: atomic<u32>;
// Tetrahedra passed, in each tile.
@group(3) @binding(4) var<storage, read_write> tallies: array<atomic<u32>>;

override MOST_TURNS: u32 = 8192u;

// Those of gpu/grid/cast.rs: pixels along a tile's side, vectors of a ray's state.
const TILE: u32 = 8u;
const STATE_VECTORS: u32 = 2u;
const FAR = 1e30;

// A ray in mesh space. Depths are counted from that of the mesh's centre.
struct Line {
    // At depth 0.
    origin: vec3f,
    // Per depth, and the inverse of each component; finite.
    direction: vec3f,
    inverse: vec3f,
    // Whether indices rise along the ray.
    rises: vec3<bool>,
    // Length along the ray per depth.
    stretch: f32,
}

struct Way {
    color: vec3f,
    transmittance: f32,
    // Where the ray is; -1, or the number of voxels, where it has left them.
    voxel: vec3i,
    // Depth up to which all is done, or which is not seen.
    reached: f32,
    steps: u32,
}

fn line_through(pixel: vec2u) -> Line {
    let away = vec2f(vec2i(pixel) - rays.pixel);
    let start = rays.start - rays.start_step * away;
    let film = select(vec2f(0.0), rays.film + rays.film_step * away, PERSPECTIVE);
    let origin = -start.x * rays.right - start.y * rays.up;
    let along = rays.forward + film.x * rays.right + film.y * rays.up;
    // A ray within a plane of samples crosses the others there far away.
    let direction = select(along, vec3f(1e-18), abs(along) < vec3f(1e-18));
    let falling = place_at(grid.points - 1u) < place_at(vec3u(0u));
    return Line(origin, direction, 1.0 / direction, (direction > vec3f(0.0)) != falling,
                sqrt(1.0 + dot(film, film)));
}

// Depths where the ray crosses planes of samples. One on which it lies, it has crossed before.
fn crossings(line: Line, planes: vec3i) -> vec3f {
    let away = place_at(vec3u(planes)) - line.origin;
    let lies_on = (away == vec3f(0.0)) & (abs(line.direction) < vec3f(1e-17));
    return select(clamp(away * line.inverse, vec3f(-FAR), vec3f(FAR)), vec3f(-FAR), lies_on);
}

// The planes through which a ray enters what lies between two corners, or leaves it.
fn entered(line: Line, low: vec3i, high: vec3i) -> vec3i {
    return select(high, low, line.rises);
}

// The voxels' low and high end.
fn drawn_low() -> vec3i {
    return vec3i(grid.low);
}

fn drawn_high() -> vec3i {
    return vec3i(grid.high);
}

// Goes on, along each axis, to the last voxel before `high` or at `low` whose entry lies at `depth` or before.
fn advanced(line: Line, voxel: vec3i, low: vec3i, high: vec3i, depth: f32) -> vec3i {
    // Steps from the voxel.
    var least = vec3i(0);
    var most = select(voxel - low, high - 1 - voxel, line.rises);
    let step = select(vec3i(-1), vec3i(1), line.rises);
    while any(least < most) && turns_taken < MOST_TURNS {
        turns_taken++;
        let middle = (least + most + 1) / 2;
        let at = voxel + step * middle;
        let is_behind = crossings(line, entered(line, at, at + 1)) <= vec3f(depth);
        least = select(least, middle, is_behind);
        most = max(select(middle - 1, most, is_behind), least);
    }
    return voxel + step * least;
}

// Where a ray enters.
fn new_way(line: Line) -> Way {
    let low = drawn_low();
    let high = drawn_high();
    let entry = crossings(line, entered(line, low, high));
    let exit = crossings(line, entered(line, high, low));
    let begin = max(max(max(entry.x, entry.y), entry.z), rays.near);
    let end = min(min(exit.x, exit.y), exit.z);
    let first = entered(line, low, high - 1);
    let voxel = select(vec3i(-1), advanced(line, first, low, high, begin), begin < end);
    return Way(vec3f(0.0), 1.0, voxel, begin, 0u);
}

fn load_way(at: u32) -> Way {
    let seen = bitcast<vec4f>(states[at]);
    let rest = states[at + 1u];
    let voxel = vec3i(vec3u(rest.x & 0xffffu, rest.x >> 16u, rest.y));
    return Way(seen.rgb, seen.a, voxel, bitcast<f32>(rest.z), 0u);
}

fn store_way(at: u32, way: Way, is_done: bool) {
    states[at] = bitcast<vec4u>(vec4f(way.color, way.transmittance));
    let voxel = vec3u(max(way.voxel, vec3i(0)));
    states[at + 1u] = vec4u(voxel.x | voxel.y << 16u, voxel.z, bitcast<u32>(way.reached), select(0u, 1u, is_done));
}

// What a voxel's samples take anywhere in it. The middle's values go on beyond its faces, where `apart` tells by how much those
// of the corners that are cut off differ.
struct Samples {
    // At the middle's corners: opposite to each face, half.
    middle: vec4f,
    apart: vec4f,
}

fn samples_of(values: array<f32, 8>) -> Samples {
    let opposite = vec4f(values[6], values[5], values[3], values[0]);
    let cut_off = vec4f(values[1], values[2], values[4], values[7]);
    return Samples(0.5 * opposite, 0.5 * dot(opposite, vec4f(1.0)) - opposite - cut_off);
}

// `beyond`: how far within the middle a point lies, from the faces that cut off the corners; below 0 beyond that one.
fn value_at(samples: Samples, beyond: vec4f) -> f32 {
    return dot(samples.middle, beyond) + dot(samples.apart, min(beyond, vec4f(0.0)));
}

// For a point within the voxel, as shares of its sides.
fn faces_from(at: vec3f) -> vec4f {
    return vec4f(-at.x + at.y + at.z, at.x - at.y + at.z, at.x + at.y - at.z, 2.0 - at.x - at.y - at.z);
}

// What is seen of the voxel from where all is done to `exit`.
fn see(line: Line, way: ptr<function, Way>, exit: f32) {
    let voxel = vec3u((*way).voxel);
    // In every other voxel, all is mirrored along x.
    let is_odd = ((voxel.x + voxel.y + voxel.z) & 1u) != 0u;
    let mirror = select(0u, 1u, is_odd);
    var values: array<f32, 8>;
    var magnitudes: array<f32, 8>;
    for (var corner = 0u; corner < 8u; corner++) {
        let at = sample_at(voxel + corner_step(corner ^ mirror));
        values[corner] = scalar_at(at);
        if BIVARIATE {
            magnitudes[corner] = gradients[at];
        }
    }
    let scalar = samples_of(values);
    let magnitude = samples_of(magnitudes);
    let begin = (*way).reached;
    let place = place_at(voxel);
    let sides = place_at(voxel + 1u) - place;
    let start = line.origin - place;
    var a = clamp((start + begin * line.direction) / sides, vec3f(0.0), vec3f(1.0));
    var b = clamp((start + exit * line.direction) / sides, vec3f(0.0), vec3f(1.0));
    a.x = select(a.x, 1.0 - a.x, is_odd);
    b.x = select(b.x, 1.0 - b.x, is_odd);
    let first = faces_from(a);
    let last = faces_from(b);
    // Where the ray enters the middle, and where it leaves it.
    let crossed = first / select(vec4f(1.0), first - last, (first < vec4f(0.0)) != (last < vec4f(0.0)));
    let enters = select(vec4f(0.0), crossed, (first < vec4f(0.0)) & (last >= vec4f(0.0)));
    let leaves = select(vec4f(1.0), crossed, (first >= vec4f(0.0)) & (last < vec4f(0.0)));
    var ends = array<f32, 3>(max(max(enters.x, enters.y), max(enters.z, enters.w)),
                             min(min(leaves.x, leaves.y), min(leaves.z, leaves.w)), 1.0);
    var share = 0.0;
    var front = vec2f(value_at(scalar, first), 0.0);
    if BIVARIATE {
        front.y = value_at(magnitude, first);
    }
    let extent = (exit - begin) * line.stretch;
    for (var part = 0u; part < 3u; part++) {
        let end = min(max(ends[part], share), 1.0);
        if end > share {
            let beyond = mix(first, last, end);
            var back = vec2f(value_at(scalar, beyond), 0.0);
            if BIVARIATE {
                back.y = value_at(magnitude, beyond);
            }
            let scalars = clamp(vec2f(front.x, back.x), vec2f(0.0), vec2f(1.0));
            let seen = segment(scalars, clamp(vec2f(front.y, back.y), vec2f(0.0), vec2f(1.0)), (end - share) * extent);
            (*way).color += (*way).transmittance * seen.rgb;
            (*way).transmittance *= seen.a;
            (*way).steps++;
            front = back;
            share = end;
        }
    }
}

// Goes on with a ray; whether it has come through.
fn trace(line: Line, way: ptr<function, Way>) -> bool {
    let low = drawn_low();
    let high = drawn_high();
    let along = (vec3i(grid.points) + 6) / 8;
    let step = select(vec3i(-1), vec3i(1), line.rises);
    while turns_taken < MOST_TURNS {
        turns_taken++;
        let voxel = (*way).voxel;
        if any(voxel < low) || any(voxel >= high) || (*way).transmittance <= rays.least_transmittance {
            return true;
        }
        let brick = voxel / 8;
        let marks = blocks[brick.x + along.x * (brick.y + along.y * brick.z)];
        let is_empty = all(marks == vec2u(0u));
        // The brick, as far as it is drawn, or the voxel.
        let first = select(voxel, max(brick * 8, low), is_empty);
        let end = select(voxel + 1, min(brick * 8 + 8, high), is_empty);
        let leaves = crossings(line, entered(line, end, first));
        let exit = min(min(leaves.x, leaves.y), leaves.z);
        let block = (voxel / 2) & vec3i(3);
        let bit = u32(block.x + 4 * block.y + 16 * block.z);
        if (select(marks.x, marks.y, bit >= 32u) & (1u << (bit & 31u))) != 0u && exit > (*way).reached {
            see(line, way, exit);
        }
        (*way).reached = max((*way).reached, exit);
        var next = voxel;
        if is_empty {
            next = advanced(line, voxel, first, end, exit);
        }
        // Through an edge or a corner it goes at once.
        let goes_on = leaves <= vec3f(exit);
        (*way).voxel = select(next, entered(line, end, first - 1), goes_on);
    }
    return false;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_id) local: vec3u) {
    let in_slab = group.xy * TILE + local.xy;
    let pixel = in_slab + vec2u(0u, rays.first_row * TILE);
    if any(pixel >= rays.size) {
        return;
    }
    let at = STATE_VECTORS * (in_slab.y * rays.size.x + in_slab.x);
    let goes_on = rays.goes_on != 0u;
    if goes_on && (states[at + 1u].w & 1u) != 0u {
        return;
    }
    let line = line_through(pixel);
    var way: Way;
    if goes_on {
        way = load_way(at);
    } else {
        way = new_way(line);
    }
    let is_done = trace(line, &way);
    if !is_done {
        atomicAdd(&unfinished, 1u);
    }
    store_way(at, way, is_done);
    if is_done {
        textureStore(picture, pixel, vec4f(way.color, 1.0 - way.transmittance) + way.transmittance * rays.background);
    }
    atomicAdd(&tallies[(group.y + rays.first_row) * groups.x + group.x], way.steps);
}
