#import shared/frame

// Composes the blended cells over what lies behind them: the background, or slabs resolved before.

@group(3) @binding(0) var blended: texture_2d<f32>; // premultiplied colour, transmittance (a slab: opacity)
@group(3) @binding(1) var behind: texture_2d<f32>; // premultiplied colour, transmittance

// On: a slab over those behind it. Off: the picture is finished; transmittance becomes opacity, over the background.
override SLAB: bool = false;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    // One triangle that covers the image.
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.5, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    let front = textureLoad(blended, pixel, 0);
    if SLAB {
        let far = textureLoad(behind, pixel, 0);
        let transmittance = 1.0 - front.a;
        return vec4f(front.rgb + transmittance * far.rgb, transmittance * far.a);
    }
    let background = frame.background;
    return vec4f(front.rgb + front.a * background.rgb, 1.0 - front.a * (1.0 - background.a));
}
