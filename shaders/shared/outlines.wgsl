#import shared/corners

// The pass that projects the surviving cells of one chunk, in the order of drawing: class, outline and thick vertex
// (Shirley & Tuchman 1990). Of a mesh it is project.wgsl, of a grid grid_project.wgsl.
//
// Over the fan of 3 or 4 triangles around the thick vertex, every quantity is affine in each triangle. Instead of the
// fan, its outline is drawn, 1 or 2 triangles, and the fan's pieces are told apart per fragment: the tent that is 0 on
// the outline and 1 at the thick vertex is the minimum of affine functions, one an edge, and
//   thickness = tent x thickness at the apex,   back value = front value + tent x their difference at the apex
// (or the other way round), where the side that is one plane over the triangle is interpolated. Less than half the
// triangles, and no thick vertex whose rounding could fold them over.
//
// Rasterisers round positions to 1/256 pixel, which would give a pixel near an edge to the wrong cell: seams. So outlines
// are drawn a hair too large, with everything extrapolated: outside the cell the tent is negative, which counts as 0.
// Which cell a pixel is in is then decided by the tent, in f32.

// Corner numbers around the outline. Class 1 (three vertices of one sign, the fourth behind or before them): the three,
// the first twice. Class 2: front, back, front, back: cut along the front edge, the front is one plane over each triangle,
// and cut along the back edge the back is.
fn outline(front: vec4<bool>, count: u32) -> vec4u {
    if count == 2u {
        if front.x == front.y {
            return select(vec4u(2u, 0u, 3u, 1u), vec4u(0u, 2u, 1u, 3u), front.x);
        }
        if front.x == front.z {
            return select(vec4u(1u, 0u, 3u, 2u), vec4u(0u, 1u, 2u, 3u), front.x);
        }
        return select(vec4u(1u, 0u, 2u, 3u), vec4u(0u, 1u, 3u, 2u), front.x);
    }
    let odd = count == 1u; // the vertex inside is the only one in front, or the only one behind
    if front.x == odd && front.y != odd {
        return vec4u(1u, 2u, 3u, 1u);
    }
    if front.y == odd && front.x != odd {
        return vec4u(0u, 2u, 3u, 0u);
    }
    if front.z == odd {
        return vec4u(0u, 1u, 3u, 0u);
    }
    return vec4u(0u, 1u, 2u, 0u);
}

// How wide the narrower triangle is of an outline that is cut between its first and third corner, less a factor of the
// cut's length.
fn cut_width(seen: SeenCell, ring: vec4u) -> f32 {
    let a = clip_of(seen.tet[ring.x]);
    let ac = clip_of(seen.tet[ring.z]) - a;
    let ab = clip_of(seen.tet[ring.y]) - a;
    let ad = clip_of(seen.tet[ring.w]) - a;
    return min(abs(ac.x * ab.y - ac.y * ab.x), abs(ac.x * ad.y - ac.y * ad.x));
}

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let place = id.x;
    let rank = chunk.first_cell + place;
    if place >= chunk.cells || rank >= counts.survivors {
        return;
    }
    let seen = seen_cell(order[rank]);
    var ring = outline(seen.front, seen.count);
    // Of one vertex in front of three, the back is one plane and the front is three.
    var is_back = seen.count == 1u;
    if seen.count == 2u {
        // A corner all but on one of these edges leaves a needle on its one side. Not for less: the same cell, rounded
        // otherwise, should be cut alike.
        is_back = cut_width(seen, ring.yzwx) > 2.0 * cut_width(seen, ring);
        ring = select(ring, ring.yzwx, is_back);
    }
    var a = corner_of(seen, ring.x);
    var b = corner_of(seen, ring.y);
    var c = corner_of(seen, ring.z);
    var d = a;
    var middle: vec2f;
    var growth: f32;
    a.tent.x = seen.peaks[ring.x];
    if seen.count == 2u {
        // The edge's ends have the first and third function; the second does not cut.
        d = corner_of(seen, ring.w);
        c.tent.z = seen.peaks[ring.z];
        a.tent.y = NO_CUT;
        b.tent.y = NO_CUT;
        c.tent.y = NO_CUT;
        d.tent.y = NO_CUT;
        // The middle of the edge that both triangles share: they stay neighbours.
        middle = 0.5 * (a.clip + c.clip);
        growth = growth_about(middle, a.clip, b.clip, c.clip, d.clip);
    } else {
        b.tent.y = seen.peaks[ring.y];
        c.tent.z = seen.peaks[ring.z];
        d = a;
        middle = (a.clip + b.clip + c.clip) / 3.0;
        growth = growth_about(middle, a.clip, b.clip, c.clip, c.clip);
    }
    let size = corner_size();
    let at = place * 4u * size;
    put_corner(at, a.clip, middle, growth);
    put_corner(at + size, b.clip, middle, growth);
    put_corner(at + 2u * size, c.clip, middle, growth);
    put_corner(at + 3u * size, d.clip, middle, growth);
    put_triangle(at, seen, is_back, a, b, c);
    if seen.count == 2u {
        put_triangle(at + 2u * size, seen, is_back, c, d, a);
    }
}
