#import math/optics
#import math/widget

// The transfer function (group 2), over scalars and gradient magnitudes normalised to 0..1 and mesh-space lengths,
// and the integral of one segment under it.

struct Widget {
    // Whitening: row-major 2 x 2 matrix that brings the Gaussian to exp(-|p|^2).
    whiten: vec4f,
    center: vec2f,
    extinction: f32,
    // 0 uniform, 1 Gaussian.
    shape: u32,
    color: vec3f,
    pad: f32,
    // Closed ranges; infinite ones are given as -1..2, beyond every normalised value.
    scalar_low: f32,
    scalar_high: f32,
    gradient_low: f32,
    gradient_high: f32,
}

// A linear piece of a 1D function; the first and last are constant and reach beyond 0..1.
struct Piece {
    // Colour and extinction at the low end.
    low: vec4f,
    // Colour and extinction at the high end.
    high: vec4f,
    scalar_low: f32,
    scalar_high: f32,
    // 1 / (scalar_high - scalar_low).
    inverse_width: f32,
    pad: f32,
}

@group(2) @binding(0) var<storage, read> widgets: array<Widget>;
@group(2) @binding(1) var<storage, read> pieces: array<Piece>;
// The piece in which the i-th of equal parts of 0..1 begins.
@group(2) @binding(2) var<storage, read> piece_starts: array<u32>;

override WIDGETS: u32 = 0u;
override PIECES: u32 = 0u;
override PIECE_STARTS: u32 = 1u;
// Gradient magnitudes matter.
override BIVARIATE: bool = false;
// Any widget is a Gaussian; any has ranges.
override GAUSSIANS: bool = false;
override RANGES: bool = false;

// Premultiplied colour and transmittance of the segment from front to back.
fn segment(scalars: vec2f, gradients: vec2f, extent: f32) -> vec4f {
    if PIECES > 0u {
        return curve_segment(scalars, extent);
    }
    return widget_segment(scalars, gradients, extent);
}

fn piece_at(scalar: f32) -> u32 {
    var i = piece_starts[u32(scalar * f32(PIECE_STARTS - 1u))];
    while i + 1u < PIECES && pieces[i].scalar_high <= scalar {
        i++;
    }
    return i;
}

// 1D functions, split at their nodes: exact but for thin_weights. A piece deeper than 1/2 is taken in steps of 1/2.
fn curve_segment(scalars: vec2f, extent: f32) -> vec4f {
    let change = scalars.y - scalars.x;
    let rising = change > 0.0;
    var i = piece_at(scalars.x);
    var at = 0.0;
    var color = vec3f(0.0);
    var transmittance = 1.0;
    loop {
        let piece = pieces[i];
        // Where the ray leaves the piece, if it does.
        let bound = select(piece.scalar_low, piece.scalar_high, rising);
        let leaves = select(scalars.y < bound && i > 0u, scalars.y > bound && i + 1u < PIECES, rising);
        var end = 1.0;
        if leaves {
            end = clamp((bound - scalars.x) / change, at, 1.0);
        }
        let u_front = clamp((scalars.x + change * at - piece.scalar_low) * piece.inverse_width, 0.0, 1.0);
        let u_back = clamp((scalars.x + change * end - piece.scalar_low) * piece.inverse_width, 0.0, 1.0);
        let front = mix(piece.low, piece.high, u_front);
        var back = mix(piece.low, piece.high, u_back);
        let a = front.w * (extent * (end - at));
        var b = back.w * (extent * (end - at));
        let deep = a + b > 1.0;
        var part = 1.0;
        if deep {
            // a x + (b - a) x^2 / 2 = 1/2, in the form without cancellation.
            part = min(1.0 / max(a + sqrt(max(a * a + (b - a), 0.0)), 1e-30), 1.0);
            back = mix(front, back, part);
            b = mix(a, b, part);
        }
        let weights = thin_weights(a * part, b * part);
        color += transmittance * (weights.y * front.rgb + (weights.x - weights.y) * back.rgb);
        transmittance -= transmittance * weights.x;
        at = mix(at, end, part);
        if (!leaves && !deep) || transmittance < 1e-7 {
            break;
        }
        if !deep {
            i = select(i - 1u, i + 1u, rising);
        }
    }
    return vec4f(color, transmittance);
}

// Sums of widgets: depths are exact and add; the colours are weighted by their depths.
fn widget_segment(scalars: vec2f, gradients: vec2f, extent: f32) -> vec4f {
    var depth = 0.0;
    var emission = vec3f(0.0);
    for (var k = 0u; k < WIDGETS; k++) {
        let d = widget_depth(k, scalars, gradients, extent);
        depth += d;
        emission += d * widgets[k].color;
    }
    return vec4f(emission * phi_one(depth), attenuation(depth));
}

fn widget_depth(k: u32, scalars: vec2f, gradients: vec2f, extent: f32) -> f32 {
    let w = widgets[k];
    var inside = vec2f(0.0, 1.0);
    if RANGES {
        inside = clip_to_range(inside, scalars.x, scalars.y, w.scalar_low, w.scalar_high);
        if BIVARIATE {
            inside = clip_to_range(inside, gradients.x, gradients.y, w.gradient_low, w.gradient_high);
        }
    }
    let share = inside.y - inside.x;
    if !(share > 0.0) {
        return 0.0;
    }
    var mean = 1.0;
    if GAUSSIANS && w.shape == 1u {
        let front = vec2f(mix(scalars.x, scalars.y, inside.x), mix(gradients.x, gradients.y, inside.x)) - w.center;
        let back = vec2f(mix(scalars.x, scalars.y, inside.y), mix(gradients.x, gradients.y, inside.y)) - w.center;
        mean = gaussian_mean(vec2f(dot(w.whiten.xy, front), dot(w.whiten.zw, front)),
                             vec2f(dot(w.whiten.xy, back), dot(w.whiten.zw, back)));
    }
    return w.extinction * extent * share * mean;
}
