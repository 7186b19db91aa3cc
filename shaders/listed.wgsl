#import raster
#import shared/lists

// Lists fragments instead of blending them: each pixel's are sorted by depth and composed afterwards (compose.wgsl), so
// that the picture does not rest on the order of cells. Fragments are counted first, so that each list has room for all of
// them.

// Of each pixel: fragments counted, or listed so far.
@group(3) @binding(3) var<storage, read_write> fragments: array<atomic<u32>>;
// Depth of each segment's middle, twice; premultiplied colour and transmittance.
@group(3) @binding(4) var<storage, read_write> list_depths: array<f32>;
@group(3) @binding(5) var<storage, read_write> list_colors: array<vec4f>;
// Fragments beyond those counted.
@group(3) @binding(6) var<storage, read_write> unlisted: atomic<u32>;

fn pixel_at(position: vec4f) -> u32 {
    return u32(position.y) * u32(frame.image_width) + u32(position.x);
}

// The target takes no colour.
@fragment
fn fragment_tally(@builtin(position) position: vec4f) -> @location(0) vec4f {
    atomicAdd(&fragments[pixel_at(position)], 1u);
    return vec4f(0.0);
}

fn put(position: vec4f, depth: f32, seen: vec4f) -> vec4f {
    let pixel = pixel_at(position);
    let in_strip = pixel >= strip.first_pixel && pixel < strip.end_pixel;
    if !in_strip || (seen.a == 1.0 && all(seen.rgb == vec3f(0.0))) {
        return vec4f(0.0);
    }
    let list = list_of(pixel, u32(frame.image_width));
    let place = atomicAdd(&fragments[pixel], 1u);
    if place >= list.room {
        atomicAdd(&unlisted, 1u);
        return vec4f(0.0);
    }
    list_depths[list.start + place] = depth;
    list_colors[list.start + place] = seen;
    return vec4f(0.0);
}

// Depth of the segment's middle, twice. `thickness`: at the apex.
fn twice_middle(seen: Seen, thickness: f32) -> f32 {
    if !PERSPECTIVE {
        return 2.0 * seen.inverse - seen.tent * thickness;
    }
    let depths = side_lengths(seen.ray, seen.inverse, seen.tent * thickness);
    return depths.x + depths.y;
}

@fragment
fn fragment_listed(in: Fragment) -> @location(0) vec4f {
    return put(in.position, twice_middle(seen_of(in), in.tents_y.w), shade(in, 1.0));
}

@fragment
fn fragment_shaded_listed(in: Fragment, more: Shaded) -> @location(0) vec4f {
    return put(in.position, twice_middle(seen_of(in), in.tents_y.w), shade_more(in, more));
}

@fragment
fn fragment_bivariate_listed(in: BivariateFragment) -> @location(0) vec4f {
    return put(in.position, twice_middle(seen_of(plain_of_bivariate(in)), in.tents_y.w), shade_bivariate(in, 1.0));
}

@fragment
fn fragment_bivariate_shaded_listed(in: BivariateFragment, more: Shaded) -> @location(0) vec4f {
    return put(in.position, twice_middle(seen_of(plain_of_bivariate(in)), in.tents_y.w),
               shade_bivariate_more(in, more));
}
