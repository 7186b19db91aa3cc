#import shared/bound
#import shared/linked

// Marks the cells that the transfer function can make visible: rays pass through the others without integrating.

@group(3) @binding(0) var<storage, read_write> marks: array<u32>; // one bit a cell

// Off: every cell is marked.
override CULL: bool = true;

var<workgroup> block_marks: array<atomic<u32>, 8>;

fn vertex_at(slot: u32) -> vec4f {
    return vec4f(place_at(slot), scalars[slot]);
}

fn cell_depth_bound(cell: u32) -> f32 {
    let slots = vec4u(slot_at(cell, 0u), slot_at(cell, 1u), slot_at(cell, 2u), slot_at(cell, 3u));
    var magnitudes = vec4f(0.0);
    if BIVARIATE {
        magnitudes = vec4f(gradients[slots.x], gradients[slots.y], gradients[slots.z], gradients[slots.w]);
    }
    return depth_bound(vertex_at(slots.x), vertex_at(slots.y), vertex_at(slots.z), vertex_at(slots.w), magnitudes);
}

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) lane: u32) {
    let block = group.x + group.y * groups.x;
    let cell = block * 256u + lane;
    if lane < 8u {
        atomicStore(&block_marks[lane], 0u);
    }
    workgroupBarrier();
    if cell < CELLS && (!CULL || cell_depth_bound(cell) > INVISIBLE) {
        atomicOr(&block_marks[lane >> 5u], 1u << (lane & 31u));
    }
    workgroupBarrier();
    if block * 256u < CELLS && lane < 8u {
        marks[block * 8u + lane] = atomicLoad(&block_marks[lane]);
    }
}
