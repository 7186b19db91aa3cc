#import shared/frame

// Composes the blended cells over what lies behind them: the background, or slabs resolved before.

@group(3) @binding(0) var blended: texture_2d<f32>; // premultiplied colour, transmittance
@group(3) @binding(1) var behind: texture_2d<f32>; // the same

// The picture is finished by this pass: transmittance becomes opacity, over the background.
override LAST: bool = true;
override FIRST: bool = true;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    // One triangle that covers the image.
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.5, 1.0);
}

@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    var result = textureLoad(blended, pixel, 0);
    if !FIRST {
        let far = textureLoad(behind, pixel, 0);
        result = vec4f(result.rgb + result.a * far.rgb, result.a * far.a);
    }
    if LAST {
        let background = frame.background;
        return vec4f(result.rgb + result.a * background.rgb, 1.0 - result.a * (1.0 - background.a));
    }
    return result;
}
