#import shared/frame
#import shared/range
#import shared/bands

// Lists the surviving cells, or their spans, with their sort keys, far cells first: the view depth of the centroid, the
// power of the eye (plan/order/power.rs), or a rank that the host found.

@group(1) @binding(0) var<storage, read> tets: array<vec4u>; // of the range
@group(1) @binding(1) var<storage, read> vertices: array<vec4f>;
@group(3) @binding(1) var<storage, read> survivors: array<u32>; // one bit a cell of the range
@group(3) @binding(2) var<storage, read> block_offsets: array<u32>; // of the range
@group(3) @binding(3) var<storage, read_write> keys: array<u32>; // ascending = back to front
@group(3) @binding(4) var<storage, read_write> order: array<u32>;

@group(3) @binding(5) var<storage, read> cell_bands: array<u32>; // of the range
// Of each word of survivors: what is drawn before it in its block.
@group(3) @binding(7) var<storage, read> word_offsets: array<u32>;

// Of the range; 16 bytes where the order needs none.
@group(3) @binding(8) var<storage, read> power_rows: array<vec4f>;
@group(3) @binding(9) var<storage, read> ranks: array<u32>;

// As in gpu/ordering.rs.
const BY_CENTROID: u32 = 0u;
const BY_POWER: u32 = 1u;
override KEYS: u32 = BY_CENTROID;

fn key_of(i: u32) -> u32 {
    if KEYS == BY_CENTROID {
        let tet = tets[i];
        // From the reference point: all depths of a frame share the rest.
        let sum = (vertices[tet.x].xyz - frame.reference) + (vertices[tet.y].xyz - frame.reference)
            + (vertices[tet.z].xyz - frame.reference) + (vertices[tet.w].xyz - frame.reference);
        return far_first(dot(frame.forward, sum) * 0.25);
    }
    if KEYS == BY_POWER {
        let row = power_rows[i];
        if PERSPECTIVE {
            return far_first(dot(row.xyz, frame.reference + frame.eye_from_reference) + row.w);
        }
        return far_first(-dot(row.xyz, frame.forward));
    }
    return ranks[i];
}

// Bits that sort floats descending.
fn far_first(depth: f32) -> u32 {
    let bits = bitcast<u32>(depth);
    return ~select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

// A word of survivors, 32 cells, each: cells count on from those before.
@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u, @builtin(num_workgroups) groups: vec3u) {
    let word = id.x + id.y * groups.x * 256u;
    if word >= (range.tet_count + 255u) / 256u * 8u {
        return;
    }
    var rank = block_offsets[word >> 3u] + word_offsets[word];
    for (var rest = survivors[word]; rest != 0u; rest &= rest - 1u) {
        let i = word * 32u + firstTrailingBit(rest);
        let key = key_of(i);
        let cell = range.first_tet + i;
        keys[rank] = key;
        if !BANDS {
            order[rank] = cell;
            rank++;
            continue;
        }
        let bands = cell_bands[i];
        order[rank] = span_of(cell, bands, 0u);
        rank++;
        for (var k = 1u; k < span_count(bands); k++) {
            keys[rank] = key;
            order[rank] = span_of(cell, bands, k);
            rank++;
        }
    }
}
