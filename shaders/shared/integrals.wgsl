#import shared/adaptive
#import shared/points
#import shared/special
#import shared/visible

// Integrals of one segment under a sum of widgets; which one is an override constant (renderer.rs, SegmentIntegral).

const ANALYTIC = 0u;
const ADAPTIVE = 1u;
const SEGMENTED = 2u;
const MEAN_SCALAR = 3u;
const VERTEX_LINEAR = 4u;
const PARTIAL = 5u;
const PREINTEGRATED = 6u;

override INTEGRAL: u32 = 1u;
// All widgets have the same colour: any integral that knows the depth is exact.
override ONE_COLOR: bool = false;
// Emission is not weighted by extinction.
override UNWEIGHTED: bool = false;

// Premultiplied colour and transmittance of the segment from front to back.
fn widget_segment(scalars: vec2f, gradients: vec2f, extent: f32) -> vec4f {
    let s = Segment(vec2f(scalars.x, gradients.x), vec2f(scalars.y, gradients.y), extent);
    pieces_taken = 1u;
    if UNWEIGHTED {
        if INTEGRAL == ANALYTIC {
            return tabled_segment(s);
        }
        return unweighted_segment(s);
    }
    if INTEGRAL == ADAPTIVE && !ONE_COLOR {
        return adaptive_segment(s);
    }
    if INTEGRAL == PARTIAL {
        return partial_segment(s);
    }
    if from_points() {
        return point_segment(s);
    }
    return analytic_segment(s);
}

// The integral knows the function at points only.
fn from_points() -> bool {
    return INTEGRAL == SEGMENTED || INTEGRAL == MEAN_SCALAR || INTEGRAL == VERTEX_LINEAR;
}

fn point_segment(s: Segment) -> vec4f {
    if INTEGRAL == SEGMENTED {
        pieces_taken = EQUAL_PIECES;
        return segmented_segment(s);
    }
    if INTEGRAL == MEAN_SCALAR {
        return mean_scalar_segment(s);
    }
    return vertex_linear_segment(s);
}

// Depths are exact and add; the colours are weighted by their depths, which is exact for one.
fn analytic_segment(s: Segment) -> vec4f {
    turns_taken += widget_count() * WIDGET_TURNS;
    var depth = 0.0;
    var emission = vec3f(0.0);
    for (var k = 0u; k < widget_count(); k++) {
        let w = widget_at(k);
        let part = active_part(w, s, 0.0, 1.0);
        if part.y > part.x {
            let d = part_depth(w, s, part);
            depth += d;
            emission += d * w.color;
        }
    }
    return vec4f(emission * phi_one(depth), attenuation(depth));
}
