#import shared/bound
#import shared/frame
#import shared/grid

// Marks the bricks that the transfer function can make visible, by the ranges of their samples.

// Least and largest scalar and gradient magnitude.
@group(1) @binding(5) var<storage, read> brick_ranges: array<vec4f>;
@group(3) @binding(0) var<storage, read_write> shown: array<u32>; // one a brick

override CULL: bool = true;

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let brick = id.x + id.y * groups.x * 256u;
    if brick >= frame.vertex_count {
        return;
    }
    let ranges = brick_ranges[brick];
    let depth = box_bound(ranges.xz, ranges.yw) * grid.longest_edge;
    shown[brick] = select(0u, 1u, !CULL || depth > INVISIBLE);
}
