#import math/optics

// A curve's pieces cut cells into bands: in one band, colour and extinction are linear. A span is drawn like a cell of its
// own, so that its fragments look nothing up and take no turns: one band, or where many cells have several, two
// neighbouring ones (renderer.rs, PAIRS_PAY).

// Where piece i begins (in x); piece i - 1 ends there.
@group(2) @binding(2) var<uniform> nodes: array<vec4f, 1025>;
// For each of 256 equal parts of 0..1: the first and the last piece in it.
@group(2) @binding(3) var<uniform> piece_starts: array<vec4u, 257>;
// Colour and extinction where pieces begin.
@group(2) @binding(4) var<uniform> node_values: array<vec4f, 1025>;

override PIECES: u32 = 0u;
// On: cells are drawn span by span. Then orders hold spans: a cell << SPAN_BITS, DEEP_SPAN if the cell is deep, and the
// span's rank from behind.
override BANDS: bool = false;
// On: a span is a pair of bands, the last one of a cell perhaps alone; off: it is one.
override PAIRED: bool = false;
// On: some span may be of a deep cell.
override DEEP: bool = true;
override SPAN_BITS: u32;
override DEEP_SPAN: u32;
// Up to this depth, at either end's extinction, a part is integrated in one step; deep is what may be beyond.
const THIN: f32 = 1.0;

// The bands of a cell in one word: the lowest piece that it reaches visibly, how many it reaches, whether these hold
// all that lies below and above in the cell (there, rounding must not clip), and whether it is deep.
fn packed_bands(first: u32, count: u32, reaches_low: bool, reaches_high: bool, is_deep: bool) -> u32 {
    return first | count << 16u | select(0u, 1u, reaches_low) << 24u | select(0u, 1u, reaches_high) << 25u
        | select(0u, 1u, is_deep) << 26u;
}

// A span of a cell, as orders hold it.
fn span_of(cell: u32, bands: u32, rank: u32) -> u32 {
    return cell << SPAN_BITS | select(0u, DEEP_SPAN, (bands & 0x4000000u) != 0u) | rank;
}

fn first_band(bands: u32) -> u32 {
    return bands & 0xffffu;
}

fn band_count(bands: u32) -> u32 {
    return (bands >> 16u) & 0xffu;
}

// Spans of a cell.
fn span_count(bands: u32) -> u32 {
    return select(band_count(bands), (band_count(bands) + 1u) >> 1u, PAIRED);
}

fn band_reaches_low(bands: u32) -> bool {
    return (bands & 0x1000000u) != 0u;
}

fn band_reaches_high(bands: u32) -> bool {
    return (bands & 0x2000000u) != 0u;
}

// min and max of numbers: the built-in ones may take three instructions, for the sake of NaN.
fn lesser(a: f32, b: f32) -> f32 {
    return select(b, a, (a < b));
}

fn greater(a: f32, b: f32) -> f32 {
    return select(b, a, (a > b));
}

// A span: the scalar u is 0 at the upper end of its lower band, and -1 at its lower end.
struct Span {
    // Where u is clipped: usually -1 and the upper end.
    bounds: vec2f,
    // Colour and extinction at 0, and their change per unit of u below and above it.
    middle: vec4f,
    lower: vec4f,
    upper: vec4f,
}

// The part of a segment in one band: u at its front and back, and the depth that it had with the extinction of its front,
// and with that of its back.
struct BandPart {
    front: f32,
    back: f32,
    front_depth: f32,
    back_depth: f32,
}

fn band_part(front: f32, back: f32, extent: f32, middle: f32, change: f32) -> BandPart {
    return BandPart(front, back, greater(middle + front * change, 0.0) * extent,
                    greater(middle + back * change, 0.0) * extent);
}

// Premultiplied colour and transmittance of the part of a segment in a span. `ends`: u at its front and back; `per_unit`:
// the length on which u changes by 1. Exact but for thin_weights.
fn span_segment(ends: vec2f, extent: f32, per_unit: f32, span: Span) -> vec4f {
    let front = lesser(greater(ends.x, span.bounds.x), span.bounds.y);
    let back = lesser(greater(ends.y, span.bounds.x), span.bounds.y);
    // Where a band ends, lengths follow from u; a whole segment's does not, for small cells' u have few digits.
    let clipped = lesser(abs(back - front) * per_unit, extent);
    let inside = select(clipped, extent, front == ends.x && back == ends.y);
    if !PAIRED {
        return band_segment(band_part(front, back, inside, span.middle.w, span.lower.w), span);
    }
    let front_below = lesser(front, 0.0);
    let back_below = lesser(back, 0.0);
    let split = lesser(abs(back_below - front_below) * per_unit, inside);
    let below = select(split, inside, front <= 0.0 && back <= 0.0);
    let low = band_part(front_below, back_below, below, span.middle.w, span.lower.w);
    let high = band_part(greater(front, 0.0), greater(back, 0.0), inside - below, span.middle.w, span.upper.w);
    if DEEP {
        return deep_span_segment(low, high, span);
    }
    let low_weights = thin_weights(low.front_depth, low.back_depth);
    let high_weights = thin_weights(high.front_depth, high.back_depth);
    // What lies in front of each, and is seen through.
    let rising = front < back;
    let low_seen = select(1.0 - high_weights.x, 1.0, rising);
    let high_seen = select(1.0, 1.0 - low_weights.x, rising);
    let opacity = low_weights.x * low_seen + high_weights.x * high_seen;
    let places = vec2f(low_seen * mean_place(low.front, low.back, low_weights),
                       high_seen * mean_place(high.front, high.back, high_weights));
    return span_color(opacity, (1.0 - low_weights.x) * (1.0 - high_weights.x), places, span);
}

// The same where the span is one band.
fn band_segment(band: BandPart, span: Span) -> vec4f {
    if DEEP {
        return deep_span_segment(band, BandPart(), span);
    }
    let weights = thin_weights(band.front_depth, band.back_depth);
    return span_color(weights.x, 1.0 - weights.x, vec2f(mean_place(band.front, band.back, weights), 0.0), span);
}

// The mean of u over a part, weighted by the light that comes from there. Colours are linear in u: it is all they need.
fn mean_place(front: f32, back: f32, weights: vec2f) -> f32 {
    return front * weights.x + (back - front) * (weights.x - weights.y);
}

fn span_color(opacity: f32, transmittance: f32, places: vec2f, span: Span) -> vec4f {
    return vec4f(opacity * span.middle.rgb + places.x * span.lower.rgb + places.y * span.upper.rgb, transmittance);
}

// In steps of end depths of at most 1, first the part in front.
fn deep_span_segment(low: BandPart, high: BandPart, span: Span) -> vec4f {
    let rising = low.front < low.back || high.front < high.back;
    var is_low = rising || high.front_depth + high.back_depth == 0.0;
    var is_last = select(low.front_depth + low.back_depth == 0.0, high.front_depth + high.back_depth == 0.0, is_low);
    var start = select(high.front, low.front, is_low);
    var back = select(high.back, low.back, is_low);
    var a = select(high.front_depth, low.front_depth, is_low);
    var b = select(high.back_depth, low.back_depth, is_low);
    var places = vec2f(0.0);
    var transmittance = 1.0;
    loop {
        // Squares stay finite.
        a = lesser(a, 1e15);
        b = lesser(b, 1e15);
        let part = step_part(a, b);
        let end = start + part * (back - start);
        let depth_at_end = a + part * (b - a);
        let weights = thin_weights(a * part, depth_at_end * part);
        let place = transmittance * mean_place(start, end, weights);
        places += select(vec2f(0.0, place), vec2f(place, 0.0), is_low);
        transmittance -= transmittance * weights.x;
        let ends = part == 1.0;
        if ends && is_last || transmittance < 1e-7 {
            break;
        }
        start = end;
        a = depth_at_end * (1.0 - part);
        b *= 1.0 - part;
        if ends {
            start = select(low.front, high.front, is_low);
            back = select(low.back, high.back, is_low);
            a = select(low.front_depth, high.front_depth, is_low);
            b = select(low.back_depth, high.back_depth, is_low);
            is_low = !is_low;
            is_last = true;
        }
    }
    return span_color(1.0 - transmittance, transmittance, places, span);
}

// A power of two such that the part from the front has end depths of at most 1: 1 where both are, else p with a p < 1/2
// and b p^2 < 1/2. By the exponents' bits: software adapters pay for both sides of a branch, and roots and quotients cost
// more than the rest of a step.
fn step_part(a: f32, b: f32) -> f32 {
    let halvings_a = i32(bitcast<u32>(4.0 * a) >> 23u) - 127;
    let halvings_b = (i32(bitcast<u32>(4.0 * b) >> 23u) - 126) >> 1u;
    let part = bitcast<f32>(u32(127 - max(max(halvings_a, halvings_b), 1)) << 23u);
    return select(part, 1.0, a <= THIN && b <= THIN);
}
