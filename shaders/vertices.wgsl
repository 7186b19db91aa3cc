#import shared/frame

// Projects every vertex once: all cells around it then use the same bits, so rasterisation is watertight. Rasterisers
// round positions to a grid of 1/256 pixel; rounding here instead, and computing everything else from the rounded
// positions (`project`), draws a slightly moved mesh exactly rather than the given one with seams.

@group(1) @binding(0) var<storage, read> vertices: array<vec4f>; // position, scalar (0..1)
@group(3) @binding(0) var<storage, read_write> projected: array<vec2f>; // clip xy

const SUBPIXELS: f32 = 256.0;

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let i = id.x + id.y * groups.x * 256u;
    if i >= frame.vertex_count {
        return;
    }
    let v = from_eye(vertices[i].xyz);
    var inverse_depth = 1.0;
    if PERSPECTIVE {
        // Vertices at or behind the eye belong to cells that are clipped or dropped before anything reads this.
        inverse_depth = 1.0 / max(dot(frame.forward, v), 1e-30);
    }
    let clip = clip_from_view(v, inverse_depth);
    let half_size = 0.5 * vec2f(frame.pixel_width, frame.pixel_height);
    let pixel = (clip + 1.0) * half_size;
    // Far outside, f32 has no such digits.
    let fine = all(abs(pixel) < vec2f(32768.0));
    projected[i] = select(clip, round(pixel * SUBPIXELS) / (SUBPIXELS * half_size) - 1.0, vec2<bool>(fine));
}
