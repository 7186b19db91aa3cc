#import shared/frame
#import shared/grid_bound

// Counts the tetrahedra, and their bands, that the transfer function can make visible in each brick of the list.

struct BrickCount {
    cells: u32,
    // Of a curve.
    bands: u32,
    // Pairs of them, the last one of a cell perhaps alone.
    pairs: u32,
    // Bands in one cell, and 65,536 more where one is deep: these may be two cells.
    most: u32,
}

@group(3) @binding(0) var<storage, read_write> brick_counts: array<BrickCount>;

var<workgroup> sums: array<atomic<u32>, 4>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) lane: u32) {
    let brick = group.x + group.y * groups.x;
    if lane < 4u {
        atomicStore(&sums[lane], 0u);
    }
    workgroupBarrier();
    var count = BrickCount();
    var is_deep = false;
    for (var rank = lane; rank < 512u && brick * 256u < frame.tet_count; rank += 256u) {
        let voxel = voxel_of(bricks[brick], rank);
        if !is_in(voxel, grid.low, grid.high) || !may_show(voxel) {
            continue;
        }
        for (var k = 0u; k <= MIDDLE; k++) {
            let corners = corners_of(tet_of(voxel, k));
            let depth = tet_bound(voxel, corners);
            if !is_candidate(depth) {
                continue;
            }
            count.cells++;
            if PIECES > 0u {
                let bands = band_count(tet_bands(voxel, corners, depth));
                count.bands += bands;
                count.pairs += (bands + 1u) >> 1u;
                count.most = max(count.most, bands);
                is_deep = is_deep || depth > THIN;
            }
        }
    }
    atomicAdd(&sums[0], count.cells);
    atomicAdd(&sums[1], count.bands);
    atomicAdd(&sums[2], count.pairs);
    atomicMax(&sums[3], count.most);
    workgroupBarrier();
    if is_deep {
        atomicOr(&sums[3], 65536u);
    }
    workgroupBarrier();
    if lane == 0u && brick * 256u < frame.tet_count {
        brick_counts[brick] =
            BrickCount(atomicLoad(&sums[0]), atomicLoad(&sums[1]), atomicLoad(&sums[2]), atomicLoad(&sums[3]));
    }
}
