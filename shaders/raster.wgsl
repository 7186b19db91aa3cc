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

struct BivariateCorner {
    @location(0) clip: vec2f,
    @location(1) plane: vec2f,
    @location(2) tent: vec3f,
    @location(3) apex: vec2f,
    @location(4) gradient: vec2f,
}

// All positions have w = 1, so perspective interpolation is linear. (Asked for linear interpolation, lavapipe's clipper
// loses large triangles: the cells around an eye inside the mesh.)
struct Fragment {
    @builtin(position) position: vec4f,
    // Of the interpolated side: 1/z and scalar/z; two tent functions.
    @location(0) plane_and_tent: vec4f,
    // The third.
    @location(1) tent: f32,
    // At the apex: thickness (negative where the front is interpolated), change of scalar/z to the other side.
    @location(2) @interpolate(flat) apex: vec2f,
}

struct BivariateFragment {
    @builtin(position) position: vec4f,
    @location(0) plane_and_tent: vec4f,
    // The third tent function, and gradient/z.
    @location(1) tent_and_gradient: vec2f,
    @location(2) @interpolate(flat) apex: vec3f,
}

@vertex
fn vertex(corner: Corner) -> Fragment {
    return Fragment(vec4f(corner.clip, 0.5, 1.0), vec4f(corner.plane, corner.tent.xy), corner.tent.z, corner.apex);
}

@vertex
fn vertex_bivariate(corner: BivariateCorner) -> BivariateFragment {
    return BivariateFragment(vec4f(corner.clip, 0.5, 1.0), vec4f(corner.plane, corner.tent.xy),
                             vec2f(corner.tent.z, corner.gradient.x), vec3f(corner.apex, corner.gradient.y));
}

// Premultiplied colour, and transmittance in place of alpha.
@fragment
fn fragment(in: Fragment) -> @location(0) vec4f {
    return shade(in);
}

fn shade(in: Fragment) -> vec4f {
    let plane = in.plane_and_tent;
    let tent = max(min(min(plane.z, plane.w), in.tent), 0.0);
    let depths = front_back_length(in.position.xy, plane.x, tent * in.apex.x);
    let scalars = front_back(plane.y, tent * in.apex.y, in.apex.x, depths.xy);
    return segment(scalars, vec2f(0.0), depths.z);
}

@fragment
fn fragment_bivariate(in: BivariateFragment) -> @location(0) vec4f {
    return shade_bivariate(in);
}

fn shade_bivariate(in: BivariateFragment) -> vec4f {
    let plane = in.plane_and_tent;
    let tent = max(min(min(plane.z, plane.w), in.tent_and_gradient.x), 0.0);
    let depths = front_back_length(in.position.xy, plane.x, tent * in.apex.x);
    let scalars = front_back(plane.y, tent * in.apex.y, in.apex.x, depths.xy);
    let gradients = front_back(in.tent_and_gradient.y, tent * in.apex.z, in.apex.x, depths.xy);
    return segment(scalars, gradients, depths.z);
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
fn fragment_bivariate_counted(in: BivariateFragment) -> Counted {
    return counted(shade_bivariate(in));
}

// Values at entry and exit from value/z of the interpolated side and its change to the other.
fn front_back(plane: f32, change: f32, side: f32, depths: vec2f) -> vec2f {
    let other = plane + change;
    let over_depth = select(vec2f(plane, other), vec2f(other, plane), side > 0.0);
    return clamp(over_depth * depths, vec2f(0.0), vec2f(1.0));
}

// Depths of entry and exit, and the length of the ray between them, from 1/z of the interpolated side and the thickness
// 1/z front - 1/z back, negative where that side is the front. Never a difference of depths: the length of a thin cell
// keeps its digits.
fn front_back_length(pixel: vec2f, inverse: f32, thickness: f32) -> vec3f {
    if !PERSPECTIVE {
        return vec3f(1.0, 1.0, abs(thickness));
    }
    let inverse_front = inverse + max(thickness, 0.0);
    let inverse_back = inverse + min(thickness, 0.0);
    let both = 1.0 / max(inverse_front * inverse_back, 1e-37);
    let x = pixel.x * frame.ray_scale_x + frame.ray_offset_x;
    let y = pixel.y * frame.ray_scale_y + frame.ray_offset_y;
    return vec3f(inverse_back, inverse_front, abs(thickness) * sqrt(1.0 + x * x + y * y)) * both;
}
