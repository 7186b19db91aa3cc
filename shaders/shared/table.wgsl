#import math/psi

// What is looked up: psi (partial), or a 1D function's segments (preintegrated). An entry of psi holds the values at the four
// corners of its square: one load instead of four.
@group(2) @binding(5) var<storage, read> table: array<vec4f>;

// Nodes along an axis; 0: psi is evaluated.
override TABLE_SIZE: u32 = 0u;

// Where a + b is small, the slope of psi at a node: 1 - (1 + t)^(-1/4) has bounded ones everywhere (optics.md 3).
fn psi_axis(t: f32) -> f32 {
    let root = sqrt(sqrt(1.0 + t));
    // 1 - 1 / root without cancellation.
    return t / (root * (1.0 + root) * (1.0 + root * root));
}

fn psi_from_table(a: f32, b: f32) -> f32 {
    let size = f32(TABLE_SIZE - 1u);
    let place = vec2f(psi_axis(a), psi_axis(b)) * size;
    let cell = min(floor(place), vec2f(size - 1.0));
    let part = place - cell;
    let corners = table[u32(cell.y) * TABLE_SIZE + u32(cell.x)];
    return mix(mix(corners.x, corners.y, part.x), mix(corners.z, corners.w, part.x), part.y);
}

// Shares of the front and back colour, from psi.
fn partial_weights(a: f32, b: f32) -> vec2f {
    if TABLE_SIZE == 0u {
        return color_weights(a, b);
    }
    let mean = psi_from_table(a, b);
    return vec2f(1.0 - mean, mean - attenuation(0.5 * (a + b)));
}
