#import shared/bands

// Which bands of a curve a cell reaches.

// The bands over scalars in [low, high], without what is transparent below and above.
fn bands_between(low: f32, high: f32, is_deep: bool) -> u32 {
    var first = piece_starts[u32(low * 256.0)].x;
    while first + 1u < PIECES && nodes[first + 1u].x <= low {
        first++;
    }
    var end = first + 1u;
    while end < PIECES && nodes[end].x < high {
        end++;
    }
    var seen = vec2u(first, end);
    while seen.x + 1u < end && transparent(seen.x) {
        seen.x++;
    }
    while seen.y > seen.x + 1u && transparent(seen.y - 1u) {
        seen.y--;
    }
    return packed_bands(seen.x, min(seen.y - seen.x, 255u), seen.x == first, seen.y == end, is_deep);
}

fn transparent(piece: u32) -> bool {
    return node_values[piece].w <= 0.0 && node_values[piece + 1u].w <= 0.0;
}

// Scalars from the lowest to the highest.
fn scalar_range(s: vec4f) -> vec2f {
    return vec2f(min(min(s.x, s.y), min(s.z, s.w)), max(max(s.x, s.y), max(s.z, s.w)));
}
