#import shared/frame
#import shared/transfer

// Draws the sorted cells: per fragment, entry and exit values by interpolating quantities that are affine on screen
// (optics.md 6.3), then the segment's integral; blending composes back to front.

// Of a univariate scene, corners and fragments carry no gradients.
struct Corner {
    @location(0) clip: vec2f,
    @location(1) depths: vec2f,
    @location(2) scalars: vec2f,
}

struct BivariateCorner {
    @location(0) clip: vec2f,
    @location(1) depths: vec2f,
    @location(2) scalars: vec2f,
    @location(3) gradients: vec2f,
}

struct Fragment {
    @builtin(position) position: vec4f,
    // 1/z of the front, 1/z front - 1/z back, scalar/z at front and back.
    @location(0) @interpolate(linear) depths_and_scalars: vec4f,
}

struct BivariateFragment {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(linear) depths_and_scalars: vec4f,
    // Gradient magnitude/z at front and back.
    @location(1) @interpolate(linear) gradients: vec2f,
}

@vertex
fn vertex(corner: Corner) -> Fragment {
    return Fragment(vec4f(corner.clip, 0.5, 1.0), vec4f(corner.depths, corner.scalars));
}

@vertex
fn vertex_bivariate(corner: BivariateCorner) -> BivariateFragment {
    return BivariateFragment(vec4f(corner.clip, 0.5, 1.0), vec4f(corner.depths, corner.scalars), corner.gradients);
}

// Premultiplied colour, and transmittance in place of alpha.
@fragment
fn fragment(in: Fragment) -> @location(0) vec4f {
    let depths = front_back_length(in.position.xy, in.depths_and_scalars.xy);
    let scalars = clamp(in.depths_and_scalars.zw * depths.xy, vec2f(0.0), vec2f(1.0));
    return segment(scalars, vec2f(0.0), depths.z);
}

@fragment
fn fragment_bivariate(in: BivariateFragment) -> @location(0) vec4f {
    let depths = front_back_length(in.position.xy, in.depths_and_scalars.xy);
    let scalars = clamp(in.depths_and_scalars.zw * depths.xy, vec2f(0.0), vec2f(1.0));
    let gradients = clamp(in.gradients * depths.xy, vec2f(0.0), vec2f(1.0));
    return segment(scalars, gradients, depths.z);
}

// Depths of entry and exit, and the length of the ray between them, from (1/z front, 1/z front - 1/z back). Never a
// difference of depths: the length of a thin cell keeps its digits.
fn front_back_length(pixel: vec2f, inverse: vec2f) -> vec3f {
    let thickness = max(inverse.y, 0.0);
    if !PERSPECTIVE {
        return vec3f(1.0, 1.0, thickness);
    }
    let inverse_back = inverse.x - thickness;
    let both = 1.0 / max(inverse.x * inverse_back, 1e-37);
    let x = pixel.x * frame.ray_scale_x + frame.ray_offset_x;
    let y = pixel.y * frame.ray_scale_y + frame.ray_offset_y;
    return vec3f(inverse_back, inverse.x, thickness * sqrt(1.0 + x * x + y * y)) * both;
}
