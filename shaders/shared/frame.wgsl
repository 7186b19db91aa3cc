// The camera, in mesh space, as every pass of a frame sees it (group 0).
struct Frame {
    // The eye in two parts: vertex - eye loses nothing where the camera is far away.
    eye_high: vec3f,
    tet_count: u32,
    eye_low: vec3f,
    vertex_count: u32,
    // Clip-space x and y of a view vector: dot(row, v), over the view depth for a perspective camera.
    x_row: vec3f,
    pixel_width: f32,
    y_row: vec3f,
    pixel_height: f32,
    forward: vec3f,
    // x/z and y/z of the ray through a pixel position p: p * ray_scale + ray_offset (perspective).
    ray_scale_x: f32,
    ray_scale_y: f32,
    ray_offset_x: f32,
    ray_offset_y: f32,
    // Cells that one draw covers.
    chunk_cells: u32,
    // The mesh-space vector that moves a point by 1 in clip x at depth 1 (everywhere for an orthographic camera).
    x_axis: vec3f,
    pad_a: f32,
    y_axis: vec3f,
    pad_b: f32,
    background: vec4f,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// True for a perspective camera.
override PERSPECTIVE: bool = true;

fn from_eye(position: vec3f) -> vec3f {
    return (position - frame.eye_high) - frame.eye_low;
}

// Clip-space x and y of a view vector, over the depth for a perspective camera.
fn clip_from_view(v: vec3f, inverse_depth: f32) -> vec2f {
    return vec2f(dot(frame.x_row, v), dot(frame.y_row, v)) * inverse_depth;
}
