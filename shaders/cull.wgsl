#import shared/frame
#import shared/range
#import shared/bands

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

// Rasterisers round positions to a grid of their own, 1/16 pixel at the coarsest: a cell is dropped only beyond that.
const SNAP: f32 = 0.0625;

// Of each word of survivors: what is drawn of it.
var<workgroup> drawn: array<u32, 256>;

fn covers_a_pixel(tet: vec4u) -> bool {
    let a = projected[tet.x];
    let b = projected[tet.y];
    let c = projected[tet.z];
    let d = projected[tet.w];
    let size = vec2f(frame.image_width, frame.image_height);
    let low = (min(min(a, b), min(c, d)) * 0.5 + 0.5) * size;
    let high = (max(max(a, b), max(c, d)) * 0.5 + 0.5) * size;
    let first = max(ceil(low - (0.5 + SNAP)), vec2f(0.0));
    let last = min(floor(high - (0.5 - SNAP)), size - 1.0);
    return all(first <= last);
}

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
            if covers_a_pixel(tets[i]) {
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
