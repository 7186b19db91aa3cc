// Where each pixel's fragments are listed. A frame's lists may not fit at once: strips of the picture are listed and
// composed one after the other.

struct Strip {
    // Row by row: the first pixel, and the one behind the last.
    first_pixel: u32,
    end_pixel: u32,
    // Fragments of all pixels before the first, as a wrapping number.
    base: u32,
    goes_on: u32,
}

@group(3) @binding(10) var<uniform> strip: Strip;
// Of each pixel: fragments up to its end in its row.
@group(3) @binding(11) var<storage, read> list_ends: array<u32>;
// Of each row: fragments of the rows before, as a wrapping number.
@group(3) @binding(12) var<storage, read> row_bases: array<u32>;

// Of a list in the strip's, and its room.
struct List {
    start: u32,
    room: u32,
}

fn list_of(pixel: u32, width: u32) -> List {
    var before = 0u;
    if pixel % width > 0u {
        before = list_ends[pixel - 1u];
    }
    return List(row_bases[pixel / width] + before - strip.base, list_ends[pixel] - before);
}
