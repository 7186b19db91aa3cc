#import math/optics

// A curve's pieces cut cells into bands: in one band, colour and extinction are linear. Each band is drawn like a cell of
// its own, so that its fragments look nothing up and take no turns.

// Where piece i begins (in x); piece i - 1 ends there.
@group(2) @binding(2) var<uniform> nodes: array<vec4f, 1025>;
// Colour and extinction there.
@group(2) @binding(4) var<uniform> node_values: array<vec4f, 1025>;

// On: cells are drawn band by band. Then orders hold bands: a cell << BAND_BITS, and the band's rank from behind.
override BANDS: bool = false;
// On: some cell is deeper than 1/2.
override DEEP: bool = true;
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

// min and max of numbers: the built-in ones may take three instructions, for the sake of NaN.
fn lesser(a: f32, b: f32) -> f32 {
    return select(b, a, (a < b));
}

fn greater(a: f32, b: f32) -> f32 {
    return select(b, a, (a > b));
}

// Premultiplied colour and transmittance of the part of a segment in a band. `ends`: where its front and back lie between
// the band's ends, 0 to 1; `bounds`: where it is clipped, usually 0 and 1; `low` and `rise`: colour and extinction at
// the lower end, and their change to the upper. Exact but for thin_weights; deeper parts are taken in steps of depth 1/2.
fn band_segment(ends: vec2f, bounds: vec2f, extent: f32, low: vec4f, rise: vec4f) -> vec4f {
    let change = ends.y - ends.x;
    let u_front = lesser(greater(ends.x, bounds.x), bounds.y);
    let u_back = lesser(greater(ends.y, bounds.x), bounds.y);
    // A ray along which the scalar is constant is in the band or is not.
    let inside = select((u_back - u_front) / change, select(0.0, 1.0, u_front == ends.x), abs(change) < 1e-30);
    let front = low + u_front * rise;
    let back = low + u_back * rise;
    // Depth per whole segment, had it the extinction of its front, and of its back.
    let a = greater(front.w, 0.0) * (extent * inside);
    let b = greater(back.w, 0.0) * (extent * inside);
    if !DEEP {
        let weights = thin_weights(a, b);
        return vec4f(weights.y * front.rgb + (weights.x - weights.y) * back.rgb, 1.0 - weights.x);
    }
    return deep_segment(front, back, a, b);
}

// In steps of depth 1/2.
fn deep_segment(front: vec4f, back: vec4f, front_depth: f32, back_depth: f32) -> vec4f {
    var start = front;
    var a = front_depth;
    var b = back_depth;
    var color = vec3f(0.0);
    var transmittance = 1.0;
    loop {
        let deep = a + b > 1.0;
        var part = 1.0;
        if deep {
            // a x + (b - a) x^2 / 2 = 1/2, in the form without cancellation.
            part = lesser(1.0 / (a + sqrt(greater(a * a + (b - a), 0.0))), 1.0);
        }
        let end = mix(start, back, part);
        let depth_at_end = mix(a, b, part);
        let weights = thin_weights(a * part, depth_at_end * part);
        color += transmittance * (weights.y * start.rgb + (weights.x - weights.y) * end.rgb);
        transmittance -= transmittance * weights.x;
        if !deep || transmittance < 1e-7 {
            break;
        }
        start = end;
        a = depth_at_end * (1.0 - part);
        b *= 1.0 - part;
    }
    return vec4f(color, transmittance);
}
