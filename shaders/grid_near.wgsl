// Puts the picture of the voxels around the eye, drawn otherwise, before what is blended already.

@group(3) @binding(0) var near: texture_2d<f32>; // premultiplied colour, opacity

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    // One triangle that covers the image.
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0, 0.5, 1.0);
}

// Transmittance in place of alpha, as raster.wgsl has it.
@fragment
fn fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let front = textureLoad(near, vec2u(position.xy), 0);
    return vec4f(front.rgb, 1.0 - front.a);
}
