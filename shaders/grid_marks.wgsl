#import shared/frame
#import shared/grid_bound

// Marks the blocks of 2 x 2 x 2 voxels that the transfer function can make visible, for rays (grid_cast.wgsl).

// The 64 blocks of each brick, x fastest; bricks x fastest.
@group(3) @binding(0) var<storage, read_write> blocks: array<vec2u>;

var<workgroup> bits: array<atomic<u32>, 2>;

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) lane: u32) {
    let brick = group.x + group.y * groups.x;
    if lane < 2u {
        atomicStore(&bits[lane], 0u);
    }
    workgroupBarrier();
    let along = (grid.points + 6u) / 8u;
    let at = vec3u(brick % along.x, brick / along.x % along.y, brick / along.x / along.y);
    let first = 8u * at + 2u * vec3u(lane & 3u, (lane >> 2u) & 3u, lane >> 4u);
    for (var corner = 0u; corner < 8u && brick < frame.vertex_count; corner++) {
        let voxel = first + corner_step(corner);
        if all(voxel + 1u < grid.points) && may_show(voxel) {
            atomicOr(&bits[lane >> 5u], 1u << (lane & 31u));
            break;
        }
    }
    workgroupBarrier();
    if lane == 0u && brick < frame.vertex_count {
        blocks[brick] = vec2u(atomicLoad(&bits[0]), atomicLoad(&bits[1]));
    }
}
