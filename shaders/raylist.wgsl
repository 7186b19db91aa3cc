#import shared/walk
#import shared/lists

// Segments of the rays that pass two cells at once, which raycast.wgsl has found: counted, or listed, in any order. All
// occupied cells are counted, whatever is seen of them: rounding may differ between the two pipelines. With one, told by a
// uniform what to do, lavapipe (Mesa 22.3.6) wrote beyond arrays while it compiled.

@group(3) @binding(6) var<storage, read> overlapping: array<u32>;
// Of each pixel: cells counted, or segments listed so far.
@group(3) @binding(7) var<storage, read_write> fragments: array<u32>;
// Depth of each segment's middle, twice; premultiplied colour and transmittance.
@group(3) @binding(8) var<storage, read_write> list_depths: array<f32>;
@group(3) @binding(9) var<storage, read_write> list_colors: array<vec4f>;
// Segments beyond those counted.
@group(3) @binding(2) var<storage, read_write> unlisted: atomic<u32>;

// Off: they are counted.
override LISTS: bool = false;

var<private> pixel_number: u32;

fn meet() {
    if !LISTS {
        fragments[pixel_number]++;
    }
}

fn compose(ray: Ray, start: Values, back: Values, way: ptr<function, Way>) {
    if !LISTS {
        return;
    }
    let front = start_of(start, back, (*way).reached);
    let seen = seen_between(ray, front, back, (back.depth - (*way).reached) * ray.stretch);
    if seen.a == 1.0 && all(seen.rgb == vec3f(0.0)) {
        return;
    }
    let place = fragments[pixel_number];
    let list = list_of(pixel_number, rays.size.x);
    if place >= list.room {
        atomicAdd(&unlisted, 1u);
        return;
    }
    list_depths[list.start + place] = (*way).reached + back.depth;
    list_colors[list.start + place] = seen;
    fragments[pixel_number] = place + 1u;
}

@compute @workgroup_size(8, 8)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_id) local: vec3u) {
    let in_slab = group.xy * TILE + local.xy;
    let pixel = in_slab + vec2u(0u, rays.first_row * TILE);
    if any(pixel >= rays.size) {
        return;
    }
    pixel_number = pixel.y * rays.size.x + pixel.x;
    if (overlapping[1u + (pixel_number >> 5u)] & (1u << (pixel_number & 31u))) == 0u {
        return;
    }
    if LISTS && (pixel_number < strip.first_pixel || pixel_number >= strip.end_pixel) {
        return;
    }
    let at = STATE_VECTORS * (in_slab.y * rays.size.x + in_slab.x);
    let goes_on = rays.goes_on != 0u;
    if goes_on && was_done(at) {
        return;
    }
    var way = new_way();
    if goes_on {
        way = load_way(at);
    }
    let is_done = trace(ray_through(pixel), list_of_tile((group.y + rays.first_row) * groups.x + group.x), &way);
    if !is_done {
        atomicAdd(&unfinished, 1u);
    }
    store_way(at, way, is_done);
}
