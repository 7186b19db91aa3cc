#import shared/counts
#import shared/covered
#import shared/frame
#import shared/grid_bound
#import shared/scan

// Marks each voxel's tetrahedra that the transfer function can make visible and that can cover a pixel's centre, and
// counts them, or their spans, per block of 256 voxels: half a brick.

// Of each voxel of the batch: bits of its tetrahedra, and above them what is drawn before it in its block.
@group(3) @binding(0) var<storage, read_write> voxels: array<u32>;
@group(3) @binding(1) var<storage, read_write> block_counts: array<u32>;
// Tetrahedra drawn in the frame.
@group(3) @binding(2) var<storage, read_write> drawn_cells: atomic<u32>;

var<workgroup> block_cells: atomic<u32>;

struct Survivors {
    bits: u32,
    // Of them, or of their spans.
    drawn: u32,
}

fn survivors_of(voxel: vec3u) -> Survivors {
    var seen = Survivors();
    if !is_in(voxel, grid.low, grid.high) || is_in(voxel, grid.near_low, grid.near_high) || !may_show(voxel) {
        return seen;
    }
    var clips: array<vec2f, 8>;
    var nearest = 1e30;
    for (var corner = 0u; corner < 8u; corner++) {
        let position = place_at(voxel + corner_step(corner));
        let depth = divisor(position);
        nearest = min(nearest, depth);
        clips[corner] = clip_from_mesh(position, 1.0 / depth);
    }
    if PERSPECTIVE && nearest < grid.least_depth {
        return seen;
    }
    for (var k = 0u; k <= MIDDLE; k++) {
        let corners = corners_of(tet_of(voxel, k));
        if !covers_a_pixel(clips[corners.x], clips[corners.y], clips[corners.z], clips[corners.w]) {
            continue;
        }
        let depth = tet_bound(voxel, corners);
        if is_candidate(depth) {
            seen.bits |= 1u << k;
            if BANDS {
                seen.drawn += span_count(tet_bands(voxel, corners, depth));
            } else {
                seen.drawn++;
            }
        }
    }
    return seen;
}

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) lane: u32) {
    let block = group.x + group.y * groups.x;
    let is_listed = block * 256u < frame.tet_count;
    if lane == 0u {
        atomicStore(&block_cells, 0u);
    }
    var seen = Survivors();
    if is_listed {
        seen = survivors_of(voxel_of(bricks[block >> 1u], (block & 1u) * 256u + lane));
    }
    let upto = scan(lane, seen.drawn);
    atomicAdd(&block_cells, countOneBits(seen.bits));
    workgroupBarrier();
    if !is_listed {
        return;
    }
    voxels[block * 256u + lane] = seen.bits | (upto - seen.drawn) << 5u;
    if lane == 255u {
        block_counts[block] = upto;
        atomicAdd(&drawn_cells, atomicLoad(&block_cells));
    }
}
