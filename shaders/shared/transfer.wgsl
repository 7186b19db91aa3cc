#import shared/bands
#import shared/curves
#import shared/integrals

// The transfer function (group 2), over scalars and gradient magnitudes normalised to 0..1 and mesh-space lengths,
// and the integral of one segment under it.

// A linear piece of a 1D function; the first and last are constant and reach beyond 0..1.
struct Piece {
    // Colour and extinction at the scalar 0, were the piece so long.
    origin: vec4f,
    // Their change per unit of the scalar.
    slope: vec4f,
}

// Uniform buffers: software adapters read them faster than storage. What is read a fragment is kept small.
@group(2) @binding(0) var<uniform> widgets: array<Widget, 64>;
@group(2) @binding(1) var<uniform> pieces: array<Piece, 1024>;
// Pieces of windows and ramps: (u, weight) at both ends.
@group(2) @binding(6) var<uniform> knots: array<vec4f, 512>;

override WIDGETS: u32 = 0u;

fn widget_count() -> u32 {
    return WIDGETS;
}

fn widget_at(k: u32) -> Widget {
    return widgets[k];
}

fn knots_at(i: u32) -> vec4f {
    return knots[i];
}

// Emission and extinction at a point.
fn classify(p: vec2f) -> vec4f {
    if PIECES > 0u {
        return classify_curve(p.x);
    }
    return classify_widgets(p);
}

// Premultiplied colour and transmittance of the segment from front to back.
fn segment(scalars: vec2f, gradients: vec2f, extent: f32) -> vec4f {
    if PIECES > 0u {
        if UNWEIGHTED {
            return partial_curve_segment(scalars, extent);
        }
        if from_points() {
            return point_segment(Segment(vec2f(scalars.x, 0.0), vec2f(scalars.y, 0.0), extent));
        }
        if INTEGRAL == PREINTEGRATED {
            return preintegrated_segment(scalars, extent);
        }
        if INTEGRAL == PARTIAL {
            return partial_curve_segment(scalars, extent);
        }
        return curve_segment(scalars, extent);
    }
    return widget_segment(scalars, gradients, extent);
}

// 1D functions, split at their nodes: exact but for thin_weights. A piece deeper than 1/2 is taken in steps of 1/2.
fn curve_segment(scalars: vec2f, extent: f32) -> vec4f {
    let rising = scalars.y - scalars.x > 1e-30;
    let change = select(min(scalars.y - scalars.x, -1e-30), scalars.y - scalars.x, rising);
    // The start may be a piece early: then the first turn has no length.
    let part_of_range = u32(scalars.x * 256.0);
    let falls = select(1u, 0u, rising);
    var i = piece_starts[part_of_range][falls];
    let last = select(0u, PIECES - 1u, rising);
    var at = 0.0;
    var color = vec3f(0.0);
    var transmittance = 1.0;
    loop {
        turns_taken++;
        let origin = pieces[i].origin;
        let slope = pieces[i].slope;
        // Where the ray leaves the piece, if it does.
        let bound = nodes[i + 1u - falls].x;
        let leaves = select((scalars.y < bound), (scalars.y > bound), rising) && i != last;
        var end = 1.0;
        if leaves {
            end = clamp((bound - scalars.x) / change, at, 1.0);
        }
        let front = max(origin + (scalars.x + change * at) * slope, vec4f(0.0));
        var back = max(origin + (scalars.x + change * end) * slope, vec4f(0.0));
        let step = extent * (end - at);
        // Squares stay finite.
        let a = min(front.w * step, 1e15);
        var b = min(back.w * step, 1e15);
        let deep = a + b > 1.0;
        var part = 1.0;
        if deep {
            // a x + (b - a) x^2 / 2 = 1/2, in the form without cancellation.
            part = min(1.0 / (a + sqrt(max(a * a + (b - a), 0.0))), 1.0);
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
