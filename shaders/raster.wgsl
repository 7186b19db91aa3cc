#import shared/frame
#import shared/light
#import shared/transfer

// Draws the sorted cells: per fragment, entry and exit values from quantities that are affine on screen
// (shared/corners.wgsl, optics.md 6.3), then the segment's integral; blending composes back to front.
//
// Nothing is interpolated by the rasteriser: GPUs round positions to 1/256 pixel first and take values from where the
// rounded triangle has them, 1/512 pixel aside (80 dB where planes evaluated here give 120, NVIDIA H100). A triangle's
// planes are flat values of its first corner.

// Of a univariate scene, corners and fragments carry no gradients.
struct Corner {
    // On screen; and where the planes begin, pixels.
    @location(0) place: vec4f,
    // Planes, as value there and change a pixel along x and y: of 1/z and scalar/z. With the first two tents.
    @location(1) depth: vec4f,
    @location(2) scalar: vec4f,
    // Changes of all three, along x and along y, with the third; and the thickness at the apex.
    @location(3) tents_x: vec4f,
    @location(4) tents_y: vec4f,
    @location(5) scalar_change: f32,
}

struct BandCorner {
    @location(0) place: vec4f,
    @location(1) depth: vec4f,
    @location(2) scalar: vec4f,
    @location(3) tents_x: vec4f,
    @location(4) tents_y: vec4f,
    // With the span (shared/corners.wgsl).
    @location(5) change_and_span: vec2f,
}

struct BivariateCorner {
    @location(0) place: vec4f,
    @location(1) depth: vec4f,
    @location(2) scalar: vec4f,
    @location(3) tents_x: vec4f,
    @location(4) tents_y: vec4f,
    // Of scalar and gradient.
    @location(5) changes: vec2f,
    // Plane of gradient/z.
    @location(6) gradient: vec3f,
}

// What shading adds to any of them.
struct ShadedCorner {
    // Gradient vector / z, view axes: a plane, and its change at the apex.
    @location(7) vector: vec3f,
    @location(8) vector_x: vec3f,
    @location(9) vector_y: vec3f,
    @location(10) vector_change: vec3f,
}

// Uniforms are read in the vertex stage: lavapipe loads them lane by lane.
struct Fragment {
    @builtin(position) position: vec4f,
    // Where planes begin, pixels; x/z and y/z of the ray there.
    @location(0) @interpolate(flat) place: vec4f,
    @location(1) @interpolate(flat) depth: vec4f,
    @location(2) @interpolate(flat) scalar: vec4f,
    @location(3) @interpolate(flat) tents_x: vec4f,
    @location(4) @interpolate(flat) tents_y: vec4f,
    // The ray's a pixel; of scalar/z, to the other side, at the apex.
    @location(5) @interpolate(flat) changes: vec3f,
}

struct BandFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) place: vec4f,
    @location(1) @interpolate(flat) depth: vec4f,
    @location(2) @interpolate(flat) scalar: vec4f,
    @location(3) @interpolate(flat) tents_x: vec4f,
    @location(4) @interpolate(flat) tents_y: vec4f,
    @location(5) @interpolate(flat) changes: vec3f,
    // Of the span.
    @location(6) @interpolate(flat) bounds: vec2f,
    @location(7) @interpolate(flat) middle: vec4f,
    @location(8) @interpolate(flat) lower: vec4f,
    @location(9) @interpolate(flat) upper: vec4f,
}

struct BivariateFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) place: vec4f,
    @location(1) @interpolate(flat) depth: vec4f,
    @location(2) @interpolate(flat) scalar: vec4f,
    @location(3) @interpolate(flat) tents_x: vec4f,
    @location(4) @interpolate(flat) tents_y: vec4f,
    // With that of gradient/z.
    @location(5) @interpolate(flat) changes: vec4f,
    @location(6) @interpolate(flat) gradient: vec3f,
}

// What shading adds to any of them.
struct Shaded {
    @location(10) @interpolate(flat) vector: vec3f,
    @location(11) @interpolate(flat) vector_x: vec3f,
    @location(12) @interpolate(flat) vector_y: vec3f,
    // With the silhouettes' exponent.
    @location(13) @interpolate(flat) vector_change: vec4f,
    // Towards the light, ambient.
    @location(14) @interpolate(flat) towards: vec4f,
    // Diffuse, specular, shininess; the silhouettes' strength.
    @location(15) @interpolate(flat) material: vec4f,
}

struct ShadedFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) place: vec4f,
    @location(1) @interpolate(flat) depth: vec4f,
    @location(2) @interpolate(flat) scalar: vec4f,
    @location(3) @interpolate(flat) tents_x: vec4f,
    @location(4) @interpolate(flat) tents_y: vec4f,
    @location(5) @interpolate(flat) changes: vec3f,
    @location(10) @interpolate(flat) vector: vec3f,
    @location(11) @interpolate(flat) vector_x: vec3f,
    @location(12) @interpolate(flat) vector_y: vec3f,
    @location(13) @interpolate(flat) vector_change: vec4f,
    @location(14) @interpolate(flat) towards: vec4f,
    @location(15) @interpolate(flat) material: vec4f,
}

struct ShadedBandFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) place: vec4f,
    @location(1) @interpolate(flat) depth: vec4f,
    @location(2) @interpolate(flat) scalar: vec4f,
    @location(3) @interpolate(flat) tents_x: vec4f,
    @location(4) @interpolate(flat) tents_y: vec4f,
    @location(5) @interpolate(flat) changes: vec3f,
    @location(6) @interpolate(flat) bounds: vec2f,
    @location(7) @interpolate(flat) middle: vec4f,
    @location(8) @interpolate(flat) lower: vec4f,
    @location(9) @interpolate(flat) upper: vec4f,
    @location(10) @interpolate(flat) vector: vec3f,
    @location(11) @interpolate(flat) vector_x: vec3f,
    @location(12) @interpolate(flat) vector_y: vec3f,
    @location(13) @interpolate(flat) vector_change: vec4f,
    @location(14) @interpolate(flat) towards: vec4f,
    @location(15) @interpolate(flat) material: vec4f,
}

struct ShadedBivariateFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) place: vec4f,
    @location(1) @interpolate(flat) depth: vec4f,
    @location(2) @interpolate(flat) scalar: vec4f,
    @location(3) @interpolate(flat) tents_x: vec4f,
    @location(4) @interpolate(flat) tents_y: vec4f,
    @location(5) @interpolate(flat) changes: vec4f,
    @location(6) @interpolate(flat) gradient: vec3f,
    @location(10) @interpolate(flat) vector: vec3f,
    @location(11) @interpolate(flat) vector_x: vec3f,
    @location(12) @interpolate(flat) vector_y: vec3f,
    @location(13) @interpolate(flat) vector_change: vec4f,
    @location(14) @interpolate(flat) towards: vec4f,
    @location(15) @interpolate(flat) material: vec4f,
}

// x/z and y/z of the ray through a place on screen, pixels; and its change a pixel.
fn ray_and_step(place: vec2f) -> vec4f {
    if !PERSPECTIVE {
        return vec4f(0.0);
    }
    let step = vec2f(2.0 * frame.ray_per_clip_x / frame.image_width, -2.0 * frame.ray_per_clip_y / frame.image_height);
    return vec4f((place - 0.5 * vec2f(frame.image_width, frame.image_height)) * step, step);
}

fn position_of(place: vec4f) -> vec4f {
    return vec4f(place.xy, 0.5, 1.0);
}

@vertex
fn vertex(corner: Corner) -> Fragment {
    return fragment_of(corner);
}

fn fragment_of(corner: Corner) -> Fragment {
    let ray = ray_and_step(corner.place.zw);
    return Fragment(position_of(corner.place), vec4f(corner.place.zw, ray.xy), corner.depth, corner.scalar,
                    corner.tents_x, corner.tents_y, vec3f(ray.zw, corner.scalar_change));
}

// How far a span reaches that is not clipped.
const UNCLIPPED: f32 = 1e30;

@vertex
fn vertex_band(corner: BandCorner) -> BandFragment {
    return band_fragment_of(corner);
}

fn band_fragment_of(corner: BandCorner) -> BandFragment {
    // Of a triangle's first corner; the others' are not used, and may be anything.
    let packed = u32(corner.change_and_span.y);
    let piece = min(packed >> 3u, PIECES - 1u);
    let is_single = (packed & 4u) != 0u;
    let end = min(piece + select(2u, 1u, is_single), PIECES);
    let middle = node_values[piece + 1u];
    let lower_width = nodes[piece + 1u].x - nodes[piece].x;
    let upper_width = nodes[end].x - nodes[piece + 1u].x;
    let upper_end = upper_width / lower_width;
    // A span without an upper band ends level.
    let upper = (node_values[end] - middle) / select(upper_end, 1.0, is_single);
    let bounds = vec2f(select(-1.0, -UNCLIPPED, (packed & 1u) != 0u),
                       select(upper_end, UNCLIPPED, (packed & 2u) != 0u));
    let ray = ray_and_step(corner.place.zw);
    return BandFragment(position_of(corner.place), vec4f(corner.place.zw, ray.xy), corner.depth, corner.scalar,
                        corner.tents_x, corner.tents_y, vec3f(ray.zw, corner.change_and_span.x), bounds, middle,
                        middle - node_values[piece], upper);
}

@vertex
fn vertex_bivariate(corner: BivariateCorner) -> BivariateFragment {
    return bivariate_fragment_of(corner);
}

fn bivariate_fragment_of(corner: BivariateCorner) -> BivariateFragment {
    let ray = ray_and_step(corner.place.zw);
    return BivariateFragment(position_of(corner.place), vec4f(corner.place.zw, ray.xy), corner.depth, corner.scalar,
                             corner.tents_x, corner.tents_y, vec4f(ray.zw, corner.changes), corner.gradient);
}

fn shading(corner: ShadedCorner) -> Shaded {
    return Shaded(corner.vector, corner.vector_x, corner.vector_y, vec4f(corner.vector_change, light.exponent),
                  vec4f(light.direction, light.ambient),
                  vec4f(light.diffuse, light.specular, light.shininess, light.strength));
}

@vertex
fn vertex_shaded(corner: Corner, more: ShadedCorner) -> ShadedFragment {
    let f = fragment_of(corner);
    let s = shading(more);
    return ShadedFragment(f.position, f.place, f.depth, f.scalar, f.tents_x, f.tents_y, f.changes,
                          s.vector, s.vector_x, s.vector_y, s.vector_change, s.towards, s.material);
}

@vertex
fn vertex_band_shaded(corner: BandCorner, more: ShadedCorner) -> ShadedBandFragment {
    let f = band_fragment_of(corner);
    let s = shading(more);
    return ShadedBandFragment(f.position, f.place, f.depth, f.scalar, f.tents_x, f.tents_y, f.changes,
                              f.bounds, f.middle, f.lower, f.upper,
                              s.vector, s.vector_x, s.vector_y, s.vector_change, s.towards, s.material);
}

@vertex
fn vertex_bivariate_shaded(corner: BivariateCorner, more: ShadedCorner) -> ShadedBivariateFragment {
    let f = bivariate_fragment_of(corner);
    let s = shading(more);
    return ShadedBivariateFragment(f.position, f.place, f.depth, f.scalar, f.tents_x, f.tents_y, f.changes, f.gradient,
                                   s.vector, s.vector_x, s.vector_y, s.vector_change, s.towards, s.material);
}

// What is known of a fragment: 1/z (orthographic: the depth) and scalar/z of the side that is one plane, and the tent.
struct Seen {
    // From where planes begin, pixels.
    offset: vec2f,
    inverse: f32,
    scalar: f32,
    tent: f32,
    ray: vec2f,
}

fn on_plane(plane: vec3f, offset: vec2f) -> f32 {
    return plane.x + (offset.x * plane.y + offset.y * plane.z);
}

fn seen_of(in: Fragment) -> Seen {
    let offset = in.position.xy - in.place.xy;
    let tents = vec3f(in.depth.w, in.scalar.w, in.tents_x.w) + (offset.x * in.tents_x.xyz + offset.y * in.tents_y.xyz);
    let tent = greater(lesser(lesser(tents.x, tents.y), tents.z), 0.0);
    return Seen(offset, on_plane(in.depth.xyz, offset), on_plane(in.scalar.xyz, offset), tent,
                in.place.zw + offset * in.changes.xy);
}

fn plain_of_band(in: BandFragment) -> Fragment {
    return Fragment(in.position, in.place, in.depth, in.scalar, in.tents_x, in.tents_y, in.changes);
}

fn plain_of_bivariate(in: BivariateFragment) -> Fragment {
    return Fragment(in.position, in.place, in.depth, in.scalar, in.tents_x, in.tents_y, in.changes.xyz);
}

// Premultiplied colour, and transmittance in place of alpha.
@fragment
fn fragment(in: Fragment) -> @location(0) vec4f {
    return shade(in, 1.0);
}

@fragment
fn fragment_shaded(in: Fragment, more: Shaded) -> @location(0) vec4f {
    return shade_more(in, more);
}

fn shade_more(in: Fragment, more: Shaded) -> vec4f {
    let f = factors_of(more, seen_of(in), in.tents_y.w);
    return with_factors(shade(in, f.density), f);
}

// `density`: the silhouettes' factor.
fn shade(in: Fragment, density: f32) -> vec4f {
    let seen = seen_of(in);
    let thickness = in.tents_y.w;
    let depths = side_lengths(seen.ray, seen.inverse, seen.tent * thickness);
    let scalars = front_back(seen.scalar, seen.tent * in.changes.z, thickness, depths.xy);
    return segment(clamp(scalars, vec2f(0.0), vec2f(1.0)), vec2f(0.0), depths.z * density);
}

@fragment
fn fragment_band(in: BandFragment) -> @location(0) vec4f {
    return shade_band(in, 1.0);
}

@fragment
fn fragment_band_shaded(in: BandFragment, more: Shaded) -> @location(0) vec4f {
    return shade_band_more(in, more);
}

fn shade_band_more(in: BandFragment, more: Shaded) -> vec4f {
    let f = factors_of(more, seen_of(plain_of_band(in)), in.tents_y.w);
    return with_factors(shade_band(in, f.density), f);
}

fn shade_band(in: BandFragment, density: f32) -> vec4f {
    let seen = seen_of(plain_of_band(in));
    let apex = vec2f(in.tents_y.w, in.changes.z);
    let depths = side_lengths(seen.ray, seen.inverse, seen.tent * apex.x);
    let ends = front_back(seen.scalar, seen.tent * apex.y, apex.x, depths.xy);
    let per_unit = length_per_change(seen.ray, vec2f(seen.inverse, seen.scalar), apex);
    return span_segment(ends, depths.z * density, per_unit * density, Span(in.bounds, in.middle, in.lower, in.upper));
}

@fragment
fn fragment_bivariate(in: BivariateFragment) -> @location(0) vec4f {
    return shade_bivariate(in, 1.0);
}

@fragment
fn fragment_bivariate_shaded(in: BivariateFragment, more: Shaded) -> @location(0) vec4f {
    return shade_bivariate_more(in, more);
}

fn shade_bivariate_more(in: BivariateFragment, more: Shaded) -> vec4f {
    let f = factors_of(more, seen_of(plain_of_bivariate(in)), in.tents_y.w);
    return with_factors(shade_bivariate(in, f.density), f);
}

fn shade_bivariate(in: BivariateFragment, density: f32) -> vec4f {
    let seen = seen_of(plain_of_bivariate(in));
    let thickness = in.tents_y.w;
    let depths = side_lengths(seen.ray, seen.inverse, seen.tent * thickness);
    let scalars = front_back(seen.scalar, seen.tent * in.changes.z, thickness, depths.xy);
    let gradients =
        front_back(on_plane(in.gradient, seen.offset), seen.tent * in.changes.w, thickness, depths.xy);
    return segment(clamp(scalars, vec2f(0.0), vec2f(1.0)), clamp(gradients, vec2f(0.0), vec2f(1.0)),
                   depths.z * density);
}

// The same for slabs blended in f16, counting layers. With opacity: f16 tells small opacities apart, and not
// transmittances near 1 (error 3e-2 after 200 layers).
struct Counted {
    @location(0) color: vec4f,
    @location(1) layers: f32,
}

fn counted(shaded: vec4f) -> Counted {
    return Counted(vec4f(shaded.rgb, 1.0 - shaded.a), 1.0);
}

@fragment
fn fragment_counted(in: Fragment) -> Counted {
    return counted(shade(in, 1.0));
}

@fragment
fn fragment_shaded_counted(in: Fragment, more: Shaded) -> Counted {
    return counted(shade_more(in, more));
}

@fragment
fn fragment_band_counted(in: BandFragment) -> Counted {
    return counted(shade_band(in, 1.0));
}

@fragment
fn fragment_band_shaded_counted(in: BandFragment, more: Shaded) -> Counted {
    return counted(shade_band_more(in, more));
}

@fragment
fn fragment_bivariate_counted(in: BivariateFragment) -> Counted {
    return counted(shade_bivariate(in, 1.0));
}

@fragment
fn fragment_bivariate_shaded_counted(in: BivariateFragment, more: Shaded) -> Counted {
    return counted(shade_bivariate_more(in, more));
}

// Values at entry and exit from value/z of the interpolated side and its change to the other, and the depths of the two.
fn front_back(plane: f32, change: f32, side: f32, depths: vec2f) -> vec2f {
    let values = vec2f(plane, plane + change) * depths;
    return select(values, values.yx, side > 0.0);
}

// Depths of the interpolated and the other side, and the length of the ray between them, from 1/z of the interpolated side
// and the thickness 1/z front - 1/z back, negative where that side is the front. Never a difference of depths: the length
// of a thin cell keeps its digits.
fn side_lengths(ray: vec2f, inverse: f32, thickness: f32) -> vec3f {
    if !PERSPECTIVE {
        return vec3f(1.0, 1.0, abs(thickness));
    }
    let other = inverse + thickness;
    let both = 1.0 / greater(inverse * other, 1e-37);
    return vec3f(other, inverse, abs(thickness) * sqrt(1.0 + dot(ray, ray))) * both;
}

// Length on which a value changes by 1 along the ray, from 1/z and value/z of the interpolated side, and thickness and
// change at the apex: what the tent scales in both is left out, and no difference of nearly equal values is taken.
fn length_per_change(ray: vec2f, plane: vec2f, apex: vec2f) -> f32 {
    if !PERSPECTIVE {
        return abs(apex.x) / greater(abs(apex.y), 1e-30);
    }
    return abs(apex.x) * sqrt(1.0 + dot(ray, ray)) / greater(abs(apex.y * plane.x - plane.y * apex.x), 1e-30);
}

// From the gradient in the segment's middle: the mean of those at entry and exit. `thickness`: at the apex.
fn factors_of(more: Shaded, seen: Seen, thickness: f32) -> Factors {
    let sides = side_lengths(seen.ray, seen.inverse, seen.tent * thickness);
    let vector = more.vector + (seen.offset.x * more.vector_x + seen.offset.y * more.vector_y);
    let other = vector + seen.tent * more.vector_change.xyz;
    let gradient = 0.5 * (sides.x * vector + sides.y * other);
    return factors(gradient, seen.ray, more.towards, more.material, more.vector_change.w);
}
