#import shared/counts

// Radix sort, 8 bits a round, least significant first; reduce then scan (no look-back: nothing waits for another
// workgroup). This pass counts each digit in each tile of 1,024 keys.

@group(3) @binding(0) var<storage, read> counts: Counts;
@group(3) @binding(1) var<storage, read> keys_in: array<u32>;
@group(3) @binding(2) var<storage, read_write> digit_counts: array<u32>; // [digit][tile]

override SHIFT: u32 = 0u;

var<workgroup> histogram: array<atomic<u32>, 256>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) lane: u32) {
    let tile = group.x + group.y * groups.x;
    atomicStore(&histogram[lane], 0u);
    workgroupBarrier();
    if tile < counts.sort_tiles {
        for (var k = 0u; k < 4u; k++) {
            let i = tile * 1024u + k * 256u + lane;
            if i < counts.survivors {
                atomicAdd(&histogram[(keys_in[i] >> SHIFT) & 255u], 1u);
            }
        }
    }
    workgroupBarrier();
    if tile < counts.sort_tiles {
        digit_counts[lane * counts.sort_tiles + tile] = atomicLoad(&histogram[lane]);
    }
}
