#import shared/frame

// Projects every vertex once: all cells around it then use the same bits.

@group(1) @binding(0) var<storage, read> vertices: array<vec4f>; // position, scalar (0..1)
@group(3) @binding(0) var<storage, read_write> projected: array<vec2f>; // clip xy

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let i = id.x + id.y * groups.x * 256u;
    if i >= frame.vertex_count {
        return;
    }
    // Vertices at or behind the eye belong to cells that are clipped or dropped before anything reads this.
    let position = vertices[i].xyz;
    projected[i] = clip_from_mesh(position, 1.0 / divisor(position));
}
