#import shared/frame
#import shared/counts
#import shared/scan

// Turns block counts into block offsets (exclusive scan), and writes the arguments of the indirect sort and draws.
// One workgroup: a block stands for 256 cells, so that even 100 million cells are 1,526 turns of its loop.

@group(3) @binding(0) var<storage, read> block_counts: array<u32>;
@group(3) @binding(3) var<storage, read_write> block_offsets: array<u32>;
@group(3) @binding(1) var<storage, read_write> counts: Counts;
@group(3) @binding(2) var<storage, read_write> draws: array<u32>; // 5 words a chunk: arguments of draw_indexed

// Of a cell.
override INDICES: u32;

const SORT_TILE: u32 = 1024u;
const SORT_ROW: u32 = 32768u; // below the limit of 65,535 groups a dimension

@compute @workgroup_size(256)
fn main(@builtin(local_invocation_index) lane: u32) {
    let blocks = (frame.tet_count + 255u) / 256u;
    var before = 0u;
    for (var first = 0u; first < blocks; first += 256u) {
        let i = first + lane;
        var count = 0u;
        if i < blocks {
            count = block_counts[i];
        }
        let inclusive = scan(lane, count);
        if i < blocks {
            block_offsets[i] = before + inclusive - count;
        }
        before += partial[255];
        workgroupBarrier();
    }
    if lane == 0u {
        let tiles = (before + SORT_TILE - 1u) / SORT_TILE;
        counts.survivors = before;
        counts.sort_tiles = tiles;
        counts.sort_groups_x = min(tiles, SORT_ROW);
        counts.sort_groups_y = (tiles + SORT_ROW - 1u) / SORT_ROW;
        counts.sort_groups_z = 1u;
    }
    // The first is drawn even where there is nothing.
    let chunks = (max(frame.most_drawn, 1u) + frame.chunk_cells - 1u) / frame.chunk_cells;
    for (var chunk = lane; chunk < chunks; chunk += 256u) {
        let first_cell = chunk * frame.chunk_cells;
        draws[chunk * 5u] = min(max(before, first_cell) - first_cell, frame.chunk_cells) * INDICES;
        draws[chunk * 5u + 1u] = 1u;
        draws[chunk * 5u + 2u] = 0u;
        draws[chunk * 5u + 3u] = 0u;
        draws[chunk * 5u + 4u] = 0u;
    }
}
