#import math/optics
#import shared/table

// 1D piecewise-linear functions beyond their exact integral: at a point, by psi, and from a table of segments. `pieces`,
// `nodes` and `piece_starts` are those of shared/transfer.wgsl.

// The longest segment of the table: the mesh lies within 1 of the origin.
const LONGEST = 2.0;
// Lengths of the table, each half as long again as the one before; shorter ones are as the first.
const LENGTHS = 32u;
const LENGTH_STEP = 0.5849625007211562; // log2(1.5)

// Colour and extinction at a scalar.
fn curve_at(scalar: f32) -> vec4f {
    var i = piece_starts[u32(clamp(scalar, 0.0, 1.0) * 256.0)].x;
    while i + 1u < PIECES && scalar > nodes[i + 1u].x {
        turns_taken++;
        i += 1u;
    }
    return max(pieces[i].origin + scalar * pieces[i].slope, vec4f(0.0));
}

fn classify_curve(scalar: f32) -> vec4f {
    let value = curve_at(scalar);
    return vec4f(value.rgb * value.w, value.w);
}

// Between the function's nodes extinction and colour are linear: psi of each piece, whatever its depth. With UNWEIGHTED
// the colour is emitted wherever there is any extinction, and two integrals of the same kind weigh its ends.
fn partial_curve_segment(scalars: vec2f, extent: f32) -> vec4f {
    let rising = scalars.y - scalars.x > 1e-30;
    // Where nothing changes the start may be a piece late, too: that is left at once.
    let change = select(min(scalars.y - scalars.x, -1e-30), scalars.y - scalars.x, rising);
    let falls = select(1u, 0u, rising);
    var i = piece_starts[u32(clamp(scalars.x, 0.0, 1.0) * 256.0)][falls];
    let last = select(0u, PIECES - 1u, rising);
    var at = 0.0;
    var color = vec3f(0.0);
    var depth = 0.0;
    for (var turn = 0u; turn <= PIECES; turn++) {
        turns_taken++;
        let bound = nodes[i + 1u - falls].x;
        let leaves = select((scalars.y < bound), (scalars.y > bound), rising) && i != last;
        var end = 1.0;
        if leaves {
            end = clamp((bound - scalars.x) / change, at, 1.0);
        }
        let front = max(pieces[i].origin + (scalars.x + change * at) * pieces[i].slope, vec4f(0.0));
        let back = max(pieces[i].origin + (scalars.x + change * end) * pieces[i].slope, vec4f(0.0));
        let step = extent * (end - at);
        // Squares stay finite.
        let a = min(front.w * step, 1e15);
        let b = min(back.w * step, 1e15);
        var weights: vec2f;
        if UNWEIGHTED {
            weights = select(vec2f(0.0), step * emission_weights(a, b), front.w + back.w > 0.0);
        } else {
            weights = partial_weights(a, b);
        }
        color += attenuation(depth) * (weights.x * front.rgb + weights.y * back.rgb);
        depth += 0.5 * (a + b);
        at = end;
        if !leaves || depth > 16.2 {
            break;
        }
        i = select(i - 1u, i + 1u, rising);
    }
    return vec4f(color, attenuation(depth));
}

// Mean extinction between two scalars.
fn curve_mean(from_scalar: f32, to_scalar: f32) -> f32 {
    let low = min(from_scalar, to_scalar);
    let high = max(from_scalar, to_scalar);
    if high - low < 1e-6 {
        return curve_at(0.5 * (low + high)).w;
    }
    var sum = 0.0;
    for (var i = 0u; i < PIECES; i++) {
        let start = max(low, nodes[i].x);
        let end = min(high, nodes[i + 1u].x);
        if end > start {
            sum += (end - start) * max(pieces[i].origin.w + 0.5 * (start + end) * pieces[i].slope.w, 0.0);
        }
    }
    return sum / (high - low);
}

fn table_entry(front: u32, back: u32, length: u32) -> vec4f {
    return table[(length * TABLE_SIZE + back) * TABLE_SIZE + front];
}

fn table_plane(corner: vec2u, part: vec2f, length: u32) -> vec4f {
    return mix(mix(table_entry(corner.x, corner.y, length), table_entry(corner.x + 1u, corner.y, length), part.x),
               mix(table_entry(corner.x, corner.y + 1u, length), table_entry(corner.x + 1u, corner.y + 1u, length),
                   part.x), part.y);
}

// A table over entry, exit and the logarithm of the length (Weiler et al. 2003). It holds the mean extinction and the mean
// colour as seen from the front, which change little with the length.
fn preintegrated_segment(scalars: vec2f, extent: f32) -> vec4f {
    let size = f32(TABLE_SIZE - 1u);
    let place = clamp(scalars, vec2f(0.0), vec2f(1.0)) * size;
    let corner = min(floor(place), vec2f(size - 1.0));
    let level = clamp(log2(max(extent, 1e-30) / LONGEST) / LENGTH_STEP + f32(LENGTHS - 1u), 0.0, f32(LENGTHS - 1u));
    let below = min(u32(level), LENGTHS - 2u);
    let nodes_below = table_plane(vec2u(corner), place - corner, below);
    let nodes_above = table_plane(vec2u(corner), place - corner, below + 1u);
    let value = mix(nodes_below, nodes_above, level - f32(below));
    let depth = min(value.w * extent, 1e25);
    return vec4f(value.rgb * (depth * phi_one(depth)), attenuation(depth));
}
