#import shared/walk

// Rays' segments, composed front to back.

@group(3) @binding(2) var picture: texture_storage_2d<rgba32float, write>;
// How many rays pass two cells at once; then a bit a pixel, of these.
@group(3) @binding(6) var<storage, read_write> overlapping: array<atomic<u32>>;

// Nothing is counted.
fn meet() {}

// Composes the segment from where all is done to `back`.
fn compose(ray: Ray, start: Values, back: Values, way: ptr<function, Way>) {
    let front = start_of(start, back, (*way).reached);
    let seen = seen_between(ray, front, back, (back.depth - (*way).reached) * ray.stretch);
    (*way).color += (*way).transmittance * seen.rgb;
    (*way).transmittance *= seen.a;
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
    if goes_on && was_done(at) {
        return;
    }
    let ray = ray_through(pixel);
    let tile = (group.y + rays.first_row) * groups.x + group.x;
    var way = new_way();
    if goes_on {
        way = load_way(at);
    }
    let is_done = trace(ray, list_of_tile(tile), &way);
    if !is_done {
        atomicAdd(&unfinished, 1u);
    }
    // What is not read again need not be written.
    if !is_done || goes_on {
        store_way(at, way, is_done);
    } else {
        states[at + 3u] = vec4u(0u, 0u, 0u, 1u);
    }
    if is_done {
        textureStore(picture, pixel, vec4f(way.color, 1.0 - way.transmittance) + way.transmittance * rays.background);
        if way.overlaps {
            let number = pixel.y * rays.size.x + pixel.x;
            atomicAdd(&overlapping[0], 1u);
            atomicOr(&overlapping[1u + (number >> 5u)], 1u << (number & 31u));
        }
    }
    atomicAdd(&tallies[TALLIES * tile], way.steps);
    atomicAdd(&tallies[TALLIES * tile + 1u], way.repaired);
    atomicAdd(&tallies[TALLIES * tile + 2u], way.lost);
}
