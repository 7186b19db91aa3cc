#import shared/frame
#import shared/range
#import shared/bands

// Marks the candidate cells that can cover a pixel's centre, and counts them, or their bands, per block of 256.

@group(1) @binding(0) var<storage, read> tets: array<vec4u>; // of the range
@group(2) @binding(0) var<storage, read> candidates: array<u32>; // one bit a cell of the range
@group(3) @binding(1) var<storage, read> projected: array<vec2f>;
@group(3) @binding(2) var<storage, read> clipped: array<u32>; // one bit a cell: cut by the near plane, drawn as pieces
@group(3) @binding(3) var<storage, read_write> survivors: array<u32>; // one bit a cell of the range
@group(3) @binding(4) var<storage, read_write> block_counts: array<u32>; // one a block of the range

@group(3) @binding(5) var<storage, read> cell_bands: array<u32>; // of the range
@group(3) @binding(6) var<storage, read> banded: array<u32>; // one bit a cell of the range: it has several bands
// Of each word of survivors: the bands before it in its block.
@group(3) @binding(7) var<storage, read_write> word_bands: array<u32>;

override NEAR_CUT: bool = false;

// Rasterisers round positions to a grid of their own, 1/16 pixel at the coarsest: a cell is dropped only beyond that.
const SNAP: f32 = 0.0625;

var<workgroup> block_flags: array<atomic<u32>, 8>;
// Bands beyond a cell's first.
var<workgroup> block_bands: array<atomic<u32>, 8>;

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

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) lane: u32) {
    let block = group.x + group.y * groups.x;
    let i = block * 256u + lane;
    let word = i >> 5u;
    let bit = 1u << (i & 31u);
    if lane < 8u {
        atomicStore(&block_flags[lane], 0u);
        atomicStore(&block_bands[lane], 0u);
    }
    workgroupBarrier();
    if i < range.tet_count {
        var keep = (candidates[word] & bit) != 0u;
        if NEAR_CUT && keep {
            keep = (clipped[(range.first_tet >> 5u) + word] & bit) == 0u;
        }
        if keep && covers_a_pixel(tets[i]) {
            atomicOr(&block_flags[lane >> 5u], bit);
            if BANDS && (banded[word] & bit) != 0u {
                atomicAdd(&block_bands[lane >> 5u], span_count(cell_bands[i]) - 1u);
            }
        }
    }
    workgroupBarrier();
    if block * 256u >= range.tet_count {
        return;
    }
    if lane < 8u {
        survivors[block * 8u + lane] = atomicLoad(&block_flags[lane]);
    }
    if lane == 0u {
        var count = 0u;
        for (var k = 0u; k < 8u; k++) {
            if BANDS {
                word_bands[block * 8u + k] = count;
                count += atomicLoad(&block_bands[k]);
            }
            count += countOneBits(atomicLoad(&block_flags[k]));
        }
        block_counts[block] = count;
    }
}
