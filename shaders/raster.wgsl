#import shared/frame
#import shared/transfer

// Draws the sorted cells: per fragment, entry and exit values by interpolating quantities that are affine on screen
// (optics.md 6.3), then the segment's integral; blending composes back to front.

@group(3) @binding(0) var<storage, read> order: array<u32>;
@group(3) @binding(1) var<storage, read> silhouettes: array<u32>; // four a cell
@group(3) @binding(2) var<storage, read> projected: array<vec4f>;
@group(3) @binding(3) var<storage, read> projected_gradients: array<f32>;
@group(3) @binding(4) var<storage, read> thick: array<vec4f>;
@group(3) @binding(5) var<storage, read> thick_scalars: array<vec2f>;
@group(3) @binding(6) var<storage, read> thick_gradients: array<vec2f>;

struct Fragment {
    @builtin(position) position: vec4f,
    // 1/z of the front, 1/z front - 1/z back, scalar/z at front and back.
    @location(0) @interpolate(linear) depths_and_scalars: vec4f,
    @location(1) @interpolate(linear) gradients: vec2f,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Fragment {
    let cell = order[index / 5u];
    let corner = index % 5u;
    var out: Fragment;
    if corner == 4u {
        let t = thick[cell];
        out.position = vec4f(t.xy, 0.5, 1.0);
        out.depths_and_scalars = vec4f(t.zw, thick_scalars[cell]);
        if BIVARIATE {
            out.gradients = thick_gradients[cell];
        }
    } else {
        let id = silhouettes[cell * 4u + corner];
        let p = projected[id];
        out.position = vec4f(p.xy, 0.5, 1.0);
        out.depths_and_scalars = vec4f(p.z, 0.0, p.ww);
        if BIVARIATE {
            out.gradients = vec2f(projected_gradients[id]);
        }
    }
    return out;
}

// Premultiplied colour, and transmittance in place of alpha.
@fragment
fn fragment(in: Fragment) -> @location(0) vec4f {
    let thickness = max(in.depths_and_scalars.y, 0.0);
    var z_front = 1.0;
    var z_back = 1.0;
    var ray_length = 1.0;
    if PERSPECTIVE {
        let inverse_front = in.depths_and_scalars.x;
        let inverse_back = inverse_front - thickness;
        let both = 1.0 / max(inverse_front * inverse_back, 1e-37);
        z_front = both * inverse_back;
        z_back = both * inverse_front;
        let x = in.position.x * frame.ray_scale_x + frame.ray_offset_x;
        let y = in.position.y * frame.ray_scale_y + frame.ray_offset_y;
        ray_length = sqrt(1.0 + x * x + y * y) * both;
    }
    let scalars = clamp(in.depths_and_scalars.zw * vec2f(z_front, z_back), vec2f(0.0), vec2f(1.0));
    var gradients = vec2f(0.0);
    if BIVARIATE {
        gradients = clamp(in.gradients * vec2f(z_front, z_back), vec2f(0.0), vec2f(1.0));
    }
    return segment(scalars, gradients, thickness * ray_length);
}
