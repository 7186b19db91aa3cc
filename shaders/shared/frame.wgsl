// The camera, in mesh space, as every pass of a frame sees it (group 0).
struct Frame {
    // A point near what is seen: the eye (rounded) if it is near the mesh, else the mesh's centre. Positions are taken
    // from there, so that neither a near nor a far camera loses their digits.
    reference: vec3f,
    // With the pieces at the near plane, and the gap before them (store.rs).
    tet_count: u32,
    eye_from_reference: vec3f,
    vertex_count: u32,
    // Clip-space x and y of a point: dot(row, point - reference) + offset, over the view depth for a perspective camera.
    x_row: vec3f,
    image_width: f32,
    y_row: vec3f,
    image_height: f32,
    // View depth: dot(forward, point - reference) + z_offset.
    forward: vec3f,
    // x/z and y/z of the ray through a point on screen, per clip-space x and y (perspective).
    ray_per_clip_x: f32,
    ray_per_clip_y: f32,
    // Cells that are projected at a time.
    chunk_cells: u32,
    // At most so many cells, or spans of them, are drawn.
    most_drawn: u32,
    pad_a: u32,
    background: vec4f,
    x_offset: f32,
    y_offset: f32,
    z_offset: f32,
    pad_b: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// True for a perspective camera.
override PERSPECTIVE: bool = true;

fn from_eye(position: vec3f) -> vec3f {
    return (position - frame.reference) - frame.eye_from_reference;
}

// The depth that vertices are divided by: 1 for an orthographic camera, and never 0.
fn divisor(position: vec3f) -> f32 {
    if PERSPECTIVE {
        return max(dot(frame.forward, position - frame.reference) + frame.z_offset, 1e-30);
    }
    return 1.0;
}

fn clip_from_mesh(position: vec3f, inverse_divisor: f32) -> vec2f {
    let p = position - frame.reference;
    return vec2f(dot(frame.x_row, p) + frame.x_offset, dot(frame.y_row, p) + frame.y_offset) * inverse_divisor;
}
