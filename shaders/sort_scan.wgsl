#import shared/counts
#import shared/scan

// One workgroup a digit: exclusive scan of its counts over the tiles, and their total.

@group(3) @binding(0) var<storage, read> counts: Counts;
@group(3) @binding(1) var<storage, read_write> digit_counts: array<u32>; // [digit][tile], counts in, offsets out
@group(3) @binding(2) var<storage, read_write> digit_totals: array<u32>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let row = group.x * counts.sort_tiles;
    var before = 0u;
    for (var first = 0u; first < counts.sort_tiles; first += 256u) {
        let tile = first + lane;
        var count = 0u;
        if tile < counts.sort_tiles {
            count = digit_counts[row + tile];
        }
        let inclusive = scan(lane, count);
        if tile < counts.sort_tiles {
            digit_counts[row + tile] = before + inclusive - count;
        }
        before += partial[255];
        workgroupBarrier();
    }
    if lane == 0u {
        digit_totals[group.x] = before;
    }
}
