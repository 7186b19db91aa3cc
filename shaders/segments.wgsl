#import shared/integrals

// Evaluates segments, each under widgets of its own: what the integrals of shared/integrals.wgsl are checked with.

struct SegmentCase {
    // (scalar, gradient magnitude) at front and back.
    front: vec2f,
    back: vec2f,
    extent: f32,
    first_widget: u32,
    widget_count: u32,
    pad: u32,
}

struct SegmentResult {
    // Premultiplied; transmittance.
    color: vec4f,
    pieces: u32,
    pad_a: u32,
    pad_b: u32,
    pad_c: u32,
}

@group(2) @binding(0) var<storage, read> case_widgets: array<Widget>;
@group(2) @binding(1) var<storage, read> case_knots: array<vec4f>;
@group(3) @binding(0) var<storage, read> cases: array<SegmentCase>;
@group(3) @binding(1) var<storage, read_write> results: array<SegmentResult>;

override CASES: u32 = 0u;

var<private> first_widget: u32;
var<private> case_widget_count: u32;

fn widget_count() -> u32 {
    return case_widget_count;
}

fn widget_at(k: u32) -> Widget {
    return case_widgets[first_widget + k];
}

fn knots_at(i: u32) -> vec4f {
    return case_knots[i];
}

fn classify(p: vec2f) -> vec4f {
    return classify_widgets(p);
}

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= CASES {
        return;
    }
    let c = cases[id.x];
    first_widget = c.first_widget;
    case_widget_count = c.widget_count;
    let color = widget_segment(vec2f(c.front.x, c.back.x), vec2f(c.front.y, c.back.y), c.extent);
    results[id.x] = SegmentResult(color, pieces_taken, 0u, 0u, 0u);
}
