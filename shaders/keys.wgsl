#import shared/frame
#import shared/range
#import shared/bands

// Lists the surviving cells, or their bands, with their sort keys: the view depth of the centroid, far cells first.

@group(1) @binding(0) var<storage, read> tets: array<vec4u>; // of the range
@group(1) @binding(1) var<storage, read> vertices: array<vec4f>;
@group(3) @binding(1) var<storage, read> survivors: array<u32>; // one bit a cell of the range
@group(3) @binding(2) var<storage, read> block_offsets: array<u32>; // of the range
@group(3) @binding(3) var<storage, read_write> keys: array<u32>; // ascending = back to front
@group(3) @binding(4) var<storage, read_write> order: array<u32>;

@group(3) @binding(5) var<storage, read> cell_bands: array<u32>; // of the range
@group(3) @binding(6) var<storage, read> banded: array<u32>; // one bit a cell of the range: it has several bands
@group(3) @binding(7) var<storage, read> word_bands: array<u32>; // of each word of survivors: the bands before it in its block

// The rank of cell i among the survivors.
fn rank_of(i: u32) -> u32 {
    let block = i >> 8u;
    let word = i >> 5u;
    var before = countOneBits(survivors[word] & ((1u << (i & 31u)) - 1u));
    for (var w = block * 8u; w < word; w++) {
        before += countOneBits(survivors[w]);
    }
    return block_offsets[block] + before;
}

// The rank of cell i's first band.
fn band_rank_of(i: u32) -> u32 {
    let word = i >> 5u;
    let earlier = survivors[word] & ((1u << (i & 31u)) - 1u);
    var before = block_offsets[i >> 8u] + word_bands[word] + countOneBits(earlier);
    for (var rest = earlier & banded[word]; rest != 0u; rest &= rest - 1u) {
        before += span_count(cell_bands[word * 32u + firstTrailingBit(rest)]) - 1u;
    }
    return before;
}

// Bits that sort floats descending.
fn far_first(depth: f32) -> u32 {
    let bits = bitcast<u32>(depth);
    return ~select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let i = id.x + id.y * groups.x * 256u;
    if i >= range.tet_count || (survivors[i >> 5u] & (1u << (i & 31u))) == 0u {
        return;
    }
    let tet = tets[i];
    // From the reference point: all depths of a frame share the rest.
    let sum = (vertices[tet.x].xyz - frame.reference) + (vertices[tet.y].xyz - frame.reference)
        + (vertices[tet.z].xyz - frame.reference) + (vertices[tet.w].xyz - frame.reference);
    let key = far_first(dot(frame.forward, sum) * 0.25);
    if BANDS {
        let first = band_rank_of(i);
        keys[first] = key;
        order[first] = (range.first_tet + i) << SPAN_BITS;
        if (banded[i >> 5u] & (1u << (i & 31u))) != 0u {
            for (var k = 1u; k < span_count(cell_bands[i]); k++) {
                keys[first + k] = key;
                order[first + k] = (range.first_tet + i) << SPAN_BITS | k;
            }
        }
        return;
    }
    let rank = rank_of(i);
    keys[rank] = key;
    order[rank] = range.first_tet + i;
}
