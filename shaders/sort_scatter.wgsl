#import shared/counts
#import shared/scan

// Sorts each tile of 1,024 keys by the round's digit in workgroup memory (two stable counting sorts of 4 bits), then
// writes it to its place: runs of equal digits stay together, so that writes are mostly side by side.

@group(3) @binding(0) var<storage, read> counts: Counts;
@group(3) @binding(1) var<storage, read> digit_counts: array<u32>; // [digit][tile], offsets within the digit
@group(3) @binding(2) var<storage, read> digit_totals: array<u32>;
@group(3) @binding(3) var<storage, read> keys_in: array<u32>;
@group(3) @binding(4) var<storage, read> values_in: array<u32>;
@group(3) @binding(5) var<storage, read_write> keys_out: array<u32>;
@group(3) @binding(6) var<storage, read_write> values_out: array<u32>;

override SHIFT: u32 = 0u;

var<workgroup> tile_keys: array<u32, 1024>;
var<workgroup> tile_values: array<u32, 1024>;
// Counts of 4-bit digits, two to a word (a tile's counts fit 16 bits): [digit pair][thread].
var<workgroup> nibble_counts: array<u32, 2048>;

// Stable counting sort of the tile by 4 bits. A thread holds 4 neighbouring keys.
fn sort_nibble(lane: u32, shift: u32) {
    var keys: array<u32, 4>;
    var values: array<u32, 4>;
    for (var k = 0u; k < 4u; k++) {
        keys[k] = tile_keys[lane * 4u + k];
        values[k] = tile_values[lane * 4u + k];
    }
    for (var pair = 0u; pair < 8u; pair++) {
        nibble_counts[pair * 256u + lane] = 0u;
    }
    // Only this thread's column: no barrier needed.
    for (var k = 0u; k < 4u; k++) {
        let digit = (keys[k] >> shift) & 15u;
        nibble_counts[(digit & 7u) * 256u + lane] += 1u << ((digit >> 3u) * 16u);
    }
    workgroupBarrier();
    // Scan in the order (digit, thread): a thread takes 8 words of a row; low halves are digits 0-7, high ones 8-15.
    var sum = 0u;
    for (var k = 0u; k < 8u; k++) {
        sum += nibble_counts[lane * 8u + k];
    }
    let inclusive = scan(lane, sum);
    let low_total = partial[255] & 0xffffu;
    workgroupBarrier();
    var before = inclusive - sum + (low_total << 16u);
    for (var k = 0u; k < 8u; k++) {
        let count = nibble_counts[lane * 8u + k];
        nibble_counts[lane * 8u + k] = before;
        before += count;
    }
    workgroupBarrier();
    for (var k = 0u; k < 4u; k++) {
        let digit = (keys[k] >> shift) & 15u;
        let word = (digit & 7u) * 256u + lane;
        let half = (digit >> 3u) * 16u;
        let place = (nibble_counts[word] >> half) & 0xffffu;
        nibble_counts[word] += 1u << half;
        tile_keys[place] = keys[k];
        tile_values[place] = values[k];
    }
    workgroupBarrier();
}

var<workgroup> digit_places: array<u32, 256>; // where the digit's run begins in the output
var<workgroup> digit_starts: array<u32, 256>; // ... and in the tile

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u,
        @builtin(local_invocation_index) lane: u32) {
    let tile = group.x + group.y * groups.x;
    let first = tile * 1024u;
    let here = min(max(counts.survivors, first) - first, 1024u);
    for (var k = 0u; k < 4u; k++) {
        let i = k * 256u + lane;
        // Past the end: the largest digit, sorted behind all that counts (the sort is stable).
        tile_keys[i] = 0xffffffffu;
        if i < here {
            tile_keys[i] = keys_in[first + i];
            tile_values[i] = values_in[first + i];
        }
    }
    workgroupBarrier();
    sort_nibble(lane, SHIFT);
    sort_nibble(lane, SHIFT + 4u);
    let total = digit_totals[lane];
    let digit_base = scan(lane, total) - total;
    if tile < counts.sort_tiles {
        digit_places[lane] = digit_base + digit_counts[lane * counts.sort_tiles + tile];
    }
    for (var k = 0u; k < 4u; k++) {
        let i = k * 256u + lane;
        let digit = (tile_keys[i] >> SHIFT) & 255u;
        if i == 0u || ((tile_keys[i - 1u] >> SHIFT) & 255u) != digit {
            digit_starts[digit] = i;
        }
    }
    workgroupBarrier();
    for (var k = 0u; k < 4u; k++) {
        let i = k * 256u + lane;
        if i < here {
            let digit = (tile_keys[i] >> SHIFT) & 255u;
            let place = digit_places[digit] + i - digit_starts[digit];
            keys_out[place] = tile_keys[i];
            values_out[place] = tile_values[i];
        }
    }
}
