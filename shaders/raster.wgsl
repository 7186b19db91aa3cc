#import shared/frame
#import shared/light
#import shared/transfer

// Draws the sorted cells: per fragment, entry and exit values from quantities that are affine on screen
// (shared/corners.wgsl, optics.md 6.3), then the segment's integral; blending composes back to front.

// Of a univariate scene, corners and fragments carry no gradients.
struct Corner {
    @location(0) clip: vec2f,
    @location(1) plane: vec2f,
    @location(2) tent: vec3f,
    @location(3) apex: vec2f,
}

struct BandCorner {
    @location(0) clip: vec2f,
    @location(1) plane: vec2f,
    @location(2) tent: vec3f,
    // With the span (shared/corners.wgsl).
    @location(3) apex: vec3f,
}

struct BivariateCorner {
    @location(0) clip: vec2f,
    @location(1) plane: vec2f,
    @location(2) tent: vec3f,
    @location(3) apex: vec2f,
    @location(4) gradient: vec2f,
}

// What shading adds to any of them.
struct ShadedCorner {
    // Gradient vector / z, view axes; of the first corner, its change at the apex.
    @location(5) vector: vec3f,
    @location(6) vector_change: vec3f,
}

// All positions have w = 1, so perspective interpolation is linear too, a division dearer. Where outlines may be clipped
// the host takes `linear` out (shader.rs): lavapipe's clipper then loses large triangles, the cells around an eye inside
// the mesh. Uniforms are read in the vertex stage: lavapipe loads them lane by lane.
struct Fragment {
    @builtin(position) position: vec4f,
    // Of the interpolated side: 1/z and scalar/z; two tent functions.
    @location(0) @interpolate(linear) plane_and_tent: vec4f,
    // The third; x/z and y/z of the ray.
    @location(1) @interpolate(linear) tent_and_ray: vec3f,
    // At the apex: thickness (negative where the front is interpolated), change of scalar/z to the other side.
    @location(2) @interpolate(flat) apex: vec2f,
}

struct BandFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(linear) plane_and_tent: vec4f,
    @location(1) @interpolate(linear) tent_and_ray: vec3f,
    // With the span's bounds.
    @location(2) @interpolate(flat) apex: vec4f,
    @location(3) @interpolate(flat) middle: vec4f,
    @location(4) @interpolate(flat) lower: vec4f,
    @location(9) @interpolate(flat) upper: vec4f,
}

struct BivariateFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(linear) plane_and_tent: vec4f,
    // With gradient/z.
    @location(1) @interpolate(linear) tent_and_ray_and_gradient: vec4f,
    @location(2) @interpolate(flat) apex: vec3f,
}

// What shading adds to any of them.
struct Shaded {
    @location(5) @interpolate(linear) vector: vec3f,
    // Its change at the apex; the silhouettes' exponent.
    @location(6) @interpolate(flat) vector_change: vec4f,
    // Towards the light, ambient.
    @location(7) @interpolate(flat) towards: vec4f,
    // Diffuse, specular, shininess; the silhouettes' strength.
    @location(8) @interpolate(flat) material: vec4f,
}

struct ShadedFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(linear) plane_and_tent: vec4f,
    @location(1) @interpolate(linear) tent_and_ray: vec3f,
    @location(2) @interpolate(flat) apex: vec2f,
    @location(5) @interpolate(linear) vector: vec3f,
    @location(6) @interpolate(flat) vector_change: vec4f,
    @location(7) @interpolate(flat) towards: vec4f,
    @location(8) @interpolate(flat) material: vec4f,
}

struct ShadedBandFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(linear) plane_and_tent: vec4f,
    @location(1) @interpolate(linear) tent_and_ray: vec3f,
    @location(2) @interpolate(flat) apex: vec4f,
    @location(3) @interpolate(flat) middle: vec4f,
    @location(4) @interpolate(flat) lower: vec4f,
    @location(9) @interpolate(flat) upper: vec4f,
    @location(5) @interpolate(linear) vector: vec3f,
    @location(6) @interpolate(flat) vector_change: vec4f,
    @location(7) @interpolate(flat) towards: vec4f,
    @location(8) @interpolate(flat) material: vec4f,
}

struct ShadedBivariateFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(linear) plane_and_tent: vec4f,
    @location(1) @interpolate(linear) tent_and_ray_and_gradient: vec4f,
    @location(2) @interpolate(flat) apex: vec3f,
    @location(5) @interpolate(linear) vector: vec3f,
    @location(6) @interpolate(flat) vector_change: vec4f,
    @location(7) @interpolate(flat) towards: vec4f,
    @location(8) @interpolate(flat) material: vec4f,
}

// x/z and y/z of the ray through a point on screen.
fn ray(clip: vec2f) -> vec2f {
    if !PERSPECTIVE {
        return vec2f(0.0);
    }
    return clip * vec2f(frame.ray_per_clip_x, frame.ray_per_clip_y);
}

// The viewport is larger than the picture, by a power of two: rounding stays as it is.
override CLIP_SCALE: f32 = 1.0;

fn position_of(clip: vec2f) -> vec4f {
    return vec4f(CLIP_SCALE * clip, 0.5, 1.0);
}

@vertex
fn vertex(corner: Corner) -> Fragment {
    return fragment_of(corner);
}

fn fragment_of(corner: Corner) -> Fragment {
    return Fragment(position_of(corner.clip), vec4f(corner.plane, corner.tent.xy),
                    vec3f(corner.tent.z, ray(corner.clip)), corner.apex);
}

// How far a span reaches that is not clipped.
const UNCLIPPED: f32 = 1e30;

@vertex
fn vertex_band(corner: BandCorner) -> BandFragment {
    return band_fragment_of(corner);
}

fn band_fragment_of(corner: BandCorner) -> BandFragment {
    // Of the first corner; the others' are not used, and may be anything.
    let packed = u32(corner.apex.z);
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
    return BandFragment(position_of(corner.clip), vec4f(corner.plane, corner.tent.xy),
                        vec3f(corner.tent.z, ray(corner.clip)), vec4f(corner.apex.xy, bounds), middle,
                        middle - node_values[piece], upper);
}

@vertex
fn vertex_bivariate(corner: BivariateCorner) -> BivariateFragment {
    return bivariate_fragment_of(corner);
}

fn bivariate_fragment_of(corner: BivariateCorner) -> BivariateFragment {
    return BivariateFragment(position_of(corner.clip), vec4f(corner.plane, corner.tent.xy),
                             vec4f(corner.tent.z, ray(corner.clip), corner.gradient.x),
                             vec3f(corner.apex, corner.gradient.y));
}

fn shading(corner: ShadedCorner) -> Shaded {
    return Shaded(corner.vector, vec4f(corner.vector_change, light.exponent), vec4f(light.direction, light.ambient),
                  vec4f(light.diffuse, light.specular, light.shininess, light.strength));
}

@vertex
fn vertex_shaded(corner: Corner, more: ShadedCorner) -> ShadedFragment {
    let f = fragment_of(corner);
    let s = shading(more);
    return ShadedFragment(f.position, f.plane_and_tent, f.tent_and_ray, f.apex,
                          s.vector, s.vector_change, s.towards, s.material);
}

@vertex
fn vertex_band_shaded(corner: BandCorner, more: ShadedCorner) -> ShadedBandFragment {
    let f = band_fragment_of(corner);
    let s = shading(more);
    return ShadedBandFragment(f.position, f.plane_and_tent, f.tent_and_ray, f.apex, f.middle, f.lower, f.upper,
                              s.vector, s.vector_change, s.towards, s.material);
}

@vertex
fn vertex_bivariate_shaded(corner: BivariateCorner, more: ShadedCorner) -> ShadedBivariateFragment {
    let f = bivariate_fragment_of(corner);
    let s = shading(more);
    return ShadedBivariateFragment(f.position, f.plane_and_tent, f.tent_and_ray_and_gradient, f.apex,
                                   s.vector, s.vector_change, s.towards, s.material);
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
    let f = factors_of(more, in.plane_and_tent, in.tent_and_ray, in.apex.x);
    return with_factors(shade(in, f.density), f);
}

// `density`: the silhouettes' factor.
fn shade(in: Fragment, density: f32) -> vec4f {
    let plane = in.plane_and_tent;
    let tent = greater(lesser(lesser(plane.z, plane.w), in.tent_and_ray.x), 0.0);
    let depths = side_lengths(in.tent_and_ray.yz, plane.x, tent * in.apex.x);
    let scalars = front_back(plane.y, tent * in.apex.y, in.apex.x, depths.xy);
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
    let f = factors_of(more, in.plane_and_tent, in.tent_and_ray, in.apex.x);
    return with_factors(shade_band(in, f.density), f);
}

fn shade_band(in: BandFragment, density: f32) -> vec4f {
    let plane = in.plane_and_tent;
    let tent = greater(lesser(lesser(plane.z, plane.w), in.tent_and_ray.x), 0.0);
    let depths = side_lengths(in.tent_and_ray.yz, plane.x, tent * in.apex.x);
    let ends = front_back(plane.y, tent * in.apex.y, in.apex.x, depths.xy);
    let per_unit = length_per_change(in.tent_and_ray.yz, plane.xy, in.apex.xy);
    return span_segment(ends, depths.z * density, per_unit * density, Span(in.apex.zw, in.middle, in.lower, in.upper));
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
    let f = factors_of(more, in.plane_and_tent, in.tent_and_ray_and_gradient.xyz, in.apex.x);
    return with_factors(shade_bivariate(in, f.density), f);
}

fn shade_bivariate(in: BivariateFragment, density: f32) -> vec4f {
    let plane = in.plane_and_tent;
    let more = in.tent_and_ray_and_gradient;
    let tent = greater(lesser(lesser(plane.z, plane.w), more.x), 0.0);
    let depths = side_lengths(more.yz, plane.x, tent * in.apex.x);
    let scalars = front_back(plane.y, tent * in.apex.y, in.apex.x, depths.xy);
    let gradients = front_back(more.w, tent * in.apex.z, in.apex.x, depths.xy);
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
fn factors_of(more: Shaded, plane_and_tent: vec4f, tent_and_ray: vec3f, thickness: f32) -> Factors {
    let tent = max(min(min(plane_and_tent.z, plane_and_tent.w), tent_and_ray.x), 0.0);
    let sides = side_lengths(tent_and_ray.yz, plane_and_tent.x, tent * thickness);
    let other = more.vector + tent * more.vector_change.xyz;
    let gradient = 0.5 * (sides.x * more.vector + sides.y * other);
    return factors(gradient, tent_and_ray.yz, more.towards, more.material, more.vector_change.w);
}
