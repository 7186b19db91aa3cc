#import math/optics

// A curve's pieces cut cells into bands: in one band, colour and extinction are linear. Each band is drawn like a cell of
// its own, so that its fragments look nothing up and take no turns.

// Where piece i begins (in x); piece i - 1 ends there.
@group(2) @binding(2) var<uniform> nodes: array<vec4f, 1025>;
// Colour and extinction there.
@group(2) @binding(4) var<uniform> node_values: array<vec4f, 1025>;

// On: cells are drawn band by band. Then orders hold bands: a cell << BAND_BITS, and the band's rank from behind.
override BANDS: bool = false;
const BAND_BITS: u32 = 6u;

// The bands of a cell in one word: the lowest piece that it reaches visibly, how many it reaches, and whether these hold
// all that lies below and above in the cell: there, rounding must not clip.
fn packed_bands(first: u32, count: u32, reaches_low: bool, reaches_high: bool) -> u32 {
    return first | count << 16u | select(0u, 1u, reaches_low) << 24u | select(0u, 1u, reaches_high) << 25u;
}

fn first_band(bands: u32) -> u32 {
    return bands & 0xffffu;
}

fn band_count(bands: u32) -> u32 {
    return (bands >> 16u) & 0xffu;
}

fn band_reaches_low(bands: u32) -> bool {
    return (bands & 0x1000000u) != 0u;
}

fn band_reaches_high(bands: u32) -> bool {
    return (bands & 0x2000000u) != 0u;
}

// Premultiplied colour and transmittance of the part of a segment in a band. `ends`: where its front and back lie between
// the band's ends, 0 to 1; `bounds`: where it is clipped, usually 0 and 1; `low` and `rise`: colour and extinction at
// the lower end, and their change to the upper. Exact but for thin_weights; deeper parts are taken in steps of depth 1/2.
fn band_segment(ends: vec2f, bounds: vec2f, extent: f32, low: vec4f, rise: vec4f) -> vec4f {
    let change = ends.y - ends.x;
    let per_change = 1.0 / select(min(change, -1e-30), max(change, 1e-30), change >= 0.0);
    let cuts = (bounds - ends.x) * per_change;
    let x_front = max(min(cuts.x, cuts.y), 0.0);
    let x_back = min(max(cuts.x, cuts.y), 1.0);
    let inside = extent * max(x_back - x_front, 0.0);
    var front = low + clamp(ends.x + change * x_front, 0.0, 1.0) * rise;
    var back = low + clamp(ends.x + change * x_back, 0.0, 1.0) * rise;
    // Depth per whole segment, had it the extinction of its front, and of its back. Squares stay finite.
    var a = clamp(front.w * inside, 0.0, 1e15);
    var b = clamp(back.w * inside, 0.0, 1e15);
    var color = vec3f(0.0);
    var transmittance = 1.0;
    loop {
        let deep = a + b > 1.0;
        var part = 1.0;
        if deep {
            // a x + (b - a) x^2 / 2 = 1/2, in the form without cancellation.
            part = min(1.0 / (a + sqrt(max(a * a + (b - a), 0.0))), 1.0);
        }
        let end = mix(front, back, part);
        let depth_at_end = mix(a, b, part);
        let weights = thin_weights(a * part, depth_at_end * part);
        color += transmittance * (weights.y * front.rgb + (weights.x - weights.y) * end.rgb);
        transmittance -= transmittance * weights.x;
        if !deep || transmittance < 1e-7 {
            break;
        }
        front = end;
        a = depth_at_end * (1.0 - part);
        b *= 1.0 - part;
    }
    return vec4f(color, transmittance);
}
