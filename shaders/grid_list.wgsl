#import shared/frame
#import shared/grid_bound

// Lists the batch's surviving tetrahedra, or their spans, back to front. Bricks and voxels are visited in that order
// already; within a voxel, the middle hides the corners that are cut off beyond it, and is hidden by those before it.

@group(3) @binding(0) var<storage, read> voxels: array<u32>; // grid_cull.wgsl
@group(3) @binding(1) var<storage, read> block_offsets: array<u32>;
@group(3) @binding(2) var<storage, read_write> order: array<u32>;

// Whether a corner lies on the eye's side of the face that cuts it off.
fn is_before_middle(voxel: vec3u, corner: u32) -> bool {
    let step = corner_step(corner);
    let place = place_at(voxel + step);
    let sides = place_at(voxel + 1u - step) - place;
    if PERSPECTIVE {
        return dot(-from_eye(place) / sides, vec3f(1.0)) < 1.0;
    }
    return dot(frame.forward / sides, vec3f(1.0)) > 0.0;
}

fn put(rank: u32, slot: u32, voxel: vec3u, k: u32) -> u32 {
    let cell = slot * 8u + k;
    if !BANDS {
        order[rank] = cell;
        return rank + 1u;
    }
    // Draws are not told apart by whether they have deep cells.
    let bands = tet_bands(voxel, corners_of(tet_of(voxel, k)), 0.0);
    let count = span_count(bands);
    for (var i = 0u; i < count; i++) {
        order[rank + i] = span_of(cell, bands, i);
    }
    return rank + count;
}

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let slot = id.x + id.y * groups.x * 256u;
    if slot >= frame.tet_count {
        return;
    }
    let bits = voxels[slot] & 31u;
    if bits == 0u {
        return;
    }
    let voxel = voxel_of(bricks[slot >> 9u], slot & 511u);
    var before = 0u;
    for (var k = 0u; k < MIDDLE; k++) {
        before |= select(0u, 1u << k, is_before_middle(voxel, apex_of(tet_of(voxel, k))));
    }
    let middle = 1u << MIDDLE;
    var rank = block_offsets[slot >> 8u] + (voxels[slot] >> 5u);
    for (var rest = bits & ~(before | middle); rest != 0u; rest &= rest - 1u) {
        rank = put(rank, slot, voxel, firstTrailingBit(rest));
    }
    if (bits & middle) != 0u {
        rank = put(rank, slot, voxel, MIDDLE);
    }
    for (var rest = bits & before; rest != 0u; rest &= rest - 1u) {
        rank = put(rank, slot, voxel, firstTrailingBit(rest));
    }
}
