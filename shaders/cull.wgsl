#import shared/frame
#import shared/range
#import shared/bands
#import shared/covered

// Marks the candidate cells that can cover a pixel's centre, and counts them, or their spans, per block of 256.

@group(1) @binding(0) var<storage, read> tets: array<vec4u>; // of the range
@group(2) @binding(0) var<storage, read> candidates: array<u32>; // one bit a cell of the range
@group(3) @binding(1) var<storage, read> projected: array<vec2f>;
@group(3) @binding(2) var<storage, read> clipped: array<u32>; // one bit a cell: cut by the near plane, drawn as pieces
@group(3) @binding(3) var<storage, read_write> survivors: array<u32>; // one bit a cell of the range
@group(3) @binding(4) var<storage, read_write> block_counts: array<u32>; // one a block of the range

@group(3) @binding(5) var<storage, read> cell_bands: array<u32>; // of the range
// Of each word of survivors: the cells, or their spans, before it in its block.
@group(3) @binding(7) var<storage, read_write> word_offsets: array<u32>;

override NEAR_CUT: bool = false;

// Of each word of survivors: what is drawn of it.
var<workgroup> drawn: array<u32, 256>;

// A word of survivors, 32 cells, each: a barrier for every 256 cells was more than half of the time on a software adapter.
@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) lane: u32) {
    let word = id.x + id.y * groups.x * 256u;
    let words = (range.tet_count + 255u) / 256u * 8u;
    var flags = 0u;
    var count = 0u;
    if word < words {
        var rest = candidates[word];
        if NEAR_CUT {
            rest &= ~clipped[(range.first_tet >> 5u) + word];
        }
        for (; rest != 0u; rest &= rest - 1u) {
            let bit = rest & (~rest + 1u);
            let i = word * 32u + firstTrailingBit(rest);
            let tet = tets[i];
            if covers_a_pixel(projected[tet.x], projected[tet.y], projected[tet.z], projected[tet.w]) {
                flags |= bit;
                count++;
                if BANDS {
                    count += span_count(cell_bands[i]) - 1u;
                }
            }
        }
        survivors[word] = flags;
    }
    drawn[lane] = count;
    workgroupBarrier();
    if word >= words {
        return;
    }
    var before = 0u;
    for (var earlier = lane & ~7u; earlier < lane; earlier++) {
        before += drawn[earlier];
    }
    word_offsets[word] = before;
    if (lane & 7u) == 7u {
        block_counts[word >> 3u] = before + count;
    }
}
