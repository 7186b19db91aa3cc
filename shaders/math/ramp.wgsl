#import math/real

// Piecewise-linear functions along a segment: ramps and windows.

// The mean of the product of two linear functions, by their values at the ends: Simpson's rule is exact.
fn linear_product_mean(f: real2, g: real2) -> real {
    return (f.x * g.x + f.y * g.y) / 3.0 + (f.x * g.y + f.y * g.x) / 6.0;
}

// The value at u of the line through (piece.x, piece.y) and (piece.z, piece.w), piece.x <= piece.z; its ends' values
// beyond them.
fn line_at(piece: real4, u: real) -> real {
    let part = clamp((u - piece.x) / max(piece.z - piece.x, 1e-30), 0.0, 1.0);
    return piece.y + part * (piece.w - piece.y);
}
