#import shared/frame
#import shared/transfer

// Draws the sorted cells: per fragment, entry and exit values from quantities that are affine on screen (project.wgsl,
// optics.md 6.3), then the segment's integral; blending composes back to front.

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
    // With the piece, and where the band is not clipped (project.wgsl).
    @location(3) apex: vec3f,
}

struct BivariateCorner {
    @location(0) clip: vec2f,
    @location(1) plane: vec2f,
    @location(2) tent: vec3f,
    @location(3) apex: vec2f,
    @location(4) gradient: vec2f,
}

// All positions have w = 1, so perspective interpolation is linear. (Asked for linear interpolation, lavapipe's clipper
// loses large triangles: the cells around an eye inside the mesh.) Uniforms are read in the vertex stage: lavapipe loads
// them lane by lane.
struct Fragment {
    @builtin(position) position: vec4f,
    // Of the interpolated side: 1/z and scalar/z; two tent functions.
    @location(0) plane_and_tent: vec4f,
    // The third; x/z and y/z of the ray.
    @location(1) tent_and_ray: vec3f,
    // At the apex: thickness (negative where the front is interpolated), change of scalar/z to the other side.
    @location(2) @interpolate(flat) apex: vec2f,
}

struct BandFragment {
    @builtin(position) position: vec4f,
    @location(0) plane_and_tent: vec4f,
    @location(1) tent_and_ray: vec3f,
    // With the ends at which the band is clipped.
    @location(2) @interpolate(flat) apex: vec4f,
    // Colour and extinction at the band's lower end, and their change to the upper.
    @location(3) @interpolate(flat) low: vec4f,
    @location(4) @interpolate(flat) rise: vec4f,
}

struct BivariateFragment {
    @builtin(position) position: vec4f,
    @location(0) plane_and_tent: vec4f,
    // With gradient/z.
    @location(1) tent_and_ray_and_gradient: vec4f,
    @location(2) @interpolate(flat) apex: vec3f,
}

// x/z and y/z of the ray through a point on screen.
fn ray(clip: vec2f) -> vec2f {
    if !PERSPECTIVE {
        return vec2f(0.0);
    }
    return clip * vec2f(frame.ray_per_clip_x, frame.ray_per_clip_y);
}

@vertex
fn vertex(corner: Corner) -> Fragment {
    return Fragment(vec4f(corner.clip, 0.5, 1.0), vec4f(corner.plane, corner.tent.xy),
                    vec3f(corner.tent.z, ray(corner.clip)), corner.apex);
}

// How far a band reaches that is not clipped: no rounding goes so far.
const UNCLIPPED: f32 = 1e6;

@vertex
fn vertex_band(corner: BandCorner) -> BandFragment {
    // Of the first corner; the others' are not used, and may be anything.
    let packed = u32(corner.apex.z);
    let piece = min(packed >> 2u, PIECES - 1u);
    let low = node_values[piece];
    let bounds = vec2f(select(0.0, -UNCLIPPED, (packed & 1u) != 0u), select(1.0, UNCLIPPED, (packed & 2u) != 0u));
    return BandFragment(vec4f(corner.clip, 0.5, 1.0), vec4f(corner.plane, corner.tent.xy),
                        vec3f(corner.tent.z, ray(corner.clip)), vec4f(corner.apex.xy, bounds), low,
                        node_values[piece + 1u] - low);
}

@vertex
fn vertex_bivariate(corner: BivariateCorner) -> BivariateFragment {
    return BivariateFragment(vec4f(corner.clip, 0.5, 1.0), vec4f(corner.plane, corner.tent.xy),
                             vec4f(corner.tent.z, ray(corner.clip), corner.gradient.x),
                             vec3f(corner.apex, corner.gradient.y));
}

// Premultiplied colour, and transmittance in place of alpha.
@fragment
fn fragment(in: Fragment) -> @location(0) vec4f {
    return shade(in);
}

fn shade(in: Fragment) -> vec4f {
    let plane = in.plane_and_tent;
    let tent = greater(lesser(lesser(plane.z, plane.w), in.tent_and_ray.x), 0.0);
    let depths = side_lengths(in.tent_and_ray.yz, plane.x, tent * in.apex.x);
    let scalars = front_back(plane.y, tent * in.apex.y, in.apex.x, depths.xy);
    return segment(clamp(scalars, vec2f(0.0), vec2f(1.0)), vec2f(0.0), depths.z);
}

@fragment
fn fragment_band(in: BandFragment) -> @location(0) vec4f {
    return shade_band(in);
}

fn shade_band(in: BandFragment) -> vec4f {
    let plane = in.plane_and_tent;
    let tent = greater(lesser(lesser(plane.z, plane.w), in.tent_and_ray.x), 0.0);
    let depths = side_lengths(in.tent_and_ray.yz, plane.x, tent * in.apex.x);
    let ends = front_back(plane.y, tent * in.apex.y, in.apex.x, depths.xy);
    return band_segment(ends, in.apex.zw, depths.z, in.low, in.rise);
}

@fragment
fn fragment_bivariate(in: BivariateFragment) -> @location(0) vec4f {
    return shade_bivariate(in);
}

fn shade_bivariate(in: BivariateFragment) -> vec4f {
    let plane = in.plane_and_tent;
    let more = in.tent_and_ray_and_gradient;
    let tent = greater(lesser(lesser(plane.z, plane.w), more.x), 0.0);
    let depths = side_lengths(more.yz, plane.x, tent * in.apex.x);
    let scalars = front_back(plane.y, tent * in.apex.y, in.apex.x, depths.xy);
    let gradients = front_back(more.w, tent * in.apex.z, in.apex.x, depths.xy);
    return segment(clamp(scalars, vec2f(0.0), vec2f(1.0)), clamp(gradients, vec2f(0.0), vec2f(1.0)), depths.z);
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
    return counted(shade(in));
}

@fragment
fn fragment_band_counted(in: BandFragment) -> Counted {
    return counted(shade_band(in));
}

@fragment
fn fragment_bivariate_counted(in: BivariateFragment) -> Counted {
    return counted(shade_bivariate(in));
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
