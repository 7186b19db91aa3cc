#import shared/frame

// Rasterisers round positions to a grid of their own, 1/16 pixel at the coarsest: a cell is dropped only beyond that.
const SNAP: f32 = 0.0625;

// Whether the tetrahedron of these clip positions may cover a pixel's centre.
fn covers_a_pixel(a: vec2f, b: vec2f, c: vec2f, d: vec2f) -> bool {
    let size = vec2f(frame.image_width, frame.image_height);
    let low = (min(min(a, b), min(c, d)) * 0.5 + 0.5) * size;
    let high = (max(max(a, b), max(c, d)) * 0.5 + 0.5) * size;
    let first = max(ceil(low - (0.5 + SNAP)), vec2f(0.0));
    let last = min(floor(high - (0.5 - SNAP)), size - 1.0);
    return all(first <= last);
}
