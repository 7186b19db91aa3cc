#import shared/mesh_cells
#import shared/corners

// Prepares the front faces of one chunk's cells, in the order of drawing: cell projection without a decomposition (Weiler,
// Kraus, Merz & Ertl 2003). Rays enter through the face that is drawn, and leave through the nearest of the planes of the
// others.
//
// One vertex is on all front faces. The three faces around it are drawn, wound so that the rasteriser culls those that
// are back faces: four corners a cell, whatever its class. On a front face, the distance of 1/z to the plane of a back
// face is 0 at the two vertices that they share, so it is a multiple of the third one's barycentric coordinate, with the
// same factor for the change of all values: nothing is taken from a difference of depths, and the smallest of such tent
// functions is the exit. What rounding draws of a back face has a tent of 0.
//
// Of three front faces, the exit is interpolated, which is one plane, and tents lead to the entry: rasterisers move the
// edges between the faces, and where the entry was interpolated, a pixel there had that of the wrong face (up to 1.2e-2 off
// instead of 4e-4, Post, thin bands).
//
// Faces are drawn a hair too large, for the reasons of outlines (shared/outlines.wgsl).

// The vertices other than d, so that all four in a row are an odd permutation.
fn others(d: u32) -> vec3u {
    switch d {
        case 0u: { return vec3u(2u, 1u, 3u); }
        case 1u: { return vec3u(3u, 0u, 2u); }
        case 2u: { return vec3u(1u, 0u, 3u); }
        default: { return vec3u(2u, 0u, 1u); }
    }
}

// Vertex numbers: one in front, and the others around it, counter-clockwise from outside. Two in front: the second is in
// the middle of the others. Three: the one behind is the last.
fn fan(seen: SeenCell) -> vec4u {
    let front = seen.front;
    let d = select(select(select(3u, 2u, front.z), 1u, front.y), 0u, front.x);
    var rest = others(d);
    if seen.parity < 0.0 {
        rest = rest.yxz;
    }
    if seen.count == 2u {
        rest = select(select(rest, rest.zxy, front[rest.x]), rest.yzx, front[rest.z]);
    }
    if seen.count == 3u {
        rest = select(select(rest, rest.zxy, !front[rest.y]), rest.yzx, !front[rest.x]);
    }
    return vec4u(d, rest);
}

// What lies behind the apex.
fn behind(corner: Corner, apex: Apex) -> Corner {
    let farther = select(apex.thickness, -apex.thickness, PERSPECTIVE);
    let plane = corner.plane + vec3f(farther, apex.scalar_change, apex.gradient_change);
    return Corner(corner.clip, plane, corner.tent, corner.vector + apex.vector_change);
}

@compute @workgroup_size(256)
fn main(@builtin(global_invocation_id) id: vec3u) {
    let place = id.x;
    let rank = chunk.first_cell + place;
    if place >= chunk.cells || rank >= counts.survivors {
        return;
    }
    let seen = seen_cell(order[rank]);
    let ring = fan(seen);
    var a = corner_of(seen, ring.x);
    var b = corner_of(seen, ring.y);
    var c = corner_of(seen, ring.z);
    var d = corner_of(seen, ring.w);
    var middle: vec2f;
    var growth: f32;
    if seen.count == 1u {
        a = behind(a, seen.apex);
        a.tent = vec3f(1.0);
        b.tent.x = seen.peaks[ring.y];
        c.tent.y = seen.peaks[ring.z];
        d.tent.z = seen.peaks[ring.w];
        middle = (b.clip + c.clip + d.clip) / 3.0;
        growth = growth_about(middle, b.clip, c.clip, d.clip, d.clip);
    } else if seen.count == 2u {
        a.tent = vec3f(seen.peaks[ring.x], NO_CUT, 0.0);
        b.tent.y = NO_CUT;
        c.tent = vec3f(0.0, NO_CUT, seen.peaks[ring.z]);
        d.tent.y = NO_CUT;
        middle = 0.5 * (a.clip + c.clip);
        growth = growth_about(middle, a.clip, b.clip, c.clip, d.clip);
    } else {
        a.tent.x = seen.peaks[ring.x];
        b.tent.y = seen.peaks[ring.y];
        c.tent.z = seen.peaks[ring.z];
        // The other faces have no area.
        d = a;
        middle = (a.clip + b.clip + c.clip) / 3.0;
        growth = growth_about(middle, a.clip, b.clip, c.clip, c.clip);
    }
    let size = corner_size();
    let at = place * 4u * size;
    // The vertex that is within the outline may be anywhere.
    put_corner(at, a.clip, middle, select(growth, 0.0, seen.count == 1u));
    put_corner(at + size, b.clip, middle, growth);
    put_corner(at + 2u * size, c.clip, middle, growth);
    put_corner(at + 3u * size, d.clip, middle, growth);
    let is_back = seen.count == 1u;
    put_triangle(at + size, seen, is_back, b, c, a);
    if seen.count < 3u {
        put_triangle(at + 2u * size, seen, is_back, c, d, a);
    }
    if seen.count == 1u {
        put_triangle(at + 3u * size, seen, is_back, d, b, a);
    }
}
