#import shared/frame

// Projects every vertex once: all cells around it then use the same bits, so rasterisation is watertight.

@group(1) @binding(0) var<storage, read> vertices: array<vec4f>; // position, scalar (0..1)
@group(3) @binding(0) var<storage, read_write> projected: array<vec2f>; // clip xy

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
    projected[i] = vec2f(dot(frame.x_row, v), dot(frame.y_row, v)) * inverse_depth;
}
