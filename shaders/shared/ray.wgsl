// One ray: where vertices lie across it, and on which side of it edges pass. One answer each, whatever rounding does.

// Rays through a picture's pixels, in mesh space.
struct Rays {
    right: vec3f,
    // Rays end where no more than this share of what lies behind is seen.
    least_transmittance: f32,
    up: vec3f,
    // View depth where the picture begins, from that of the mesh's centre.
    near: f32,
    forward: vec3f,
    // Groups of linked cells around the eye.
    groups: u32,
    // Of the ray through `pixel`, the one nearest to the mesh's centre: x/z and y/z (perspective), and where the centre lies
    // from it, along `right` and `up` at its depth. And their change from pixel to pixel.
    film: vec2f,
    film_step: vec2f,
    start: vec2f,
    start_step: vec2f,
    pixel: vec2i,
    size: vec2u,
    background: vec4f,
    // Of the slab of tiles that a dispatch casts.
    first_row: u32,
    // Whether its rays have begun before.
    goes_on: u32,
    // The eye's depth, from that of the mesh's centre; far behind for parallel rays.
    eye: f32,
    // Across rays, in a mesh unit; a power of two.
    units: f32,
}

@group(0) @binding(2) var<uniform> rays: Rays;

// True for a perspective camera.
override PERSPECTIVE: bool = true;

struct Ray {
    // Unit vectors across the ray, in the planes of right and forward, and of up and forward.
    x_row: vec3f,
    x_offset: f32,
    y_row: vec3f,
    y_offset: f32,
    // x/z and y/z.
    film: vec2f,
    // Length along the ray per depth.
    stretch: f32,
}

fn ray_through(pixel: vec2u) -> Ray {
    let away = vec2f(vec2i(pixel) - rays.pixel);
    let start = rays.start - rays.start_step * away;
    if !PERSPECTIVE {
        return Ray(rays.right, start.x, rays.up, start.y, vec2f(0.0), 1.0);
    }
    let film = rays.film + rays.film_step * away;
    let unit = inverseSqrt(1.0 + film * film);
    return Ray(unit.x * (rays.right - film.x * rays.forward), unit.x * start.x,
               unit.y * (rays.up - film.y * rays.forward), unit.y * start.y, film, sqrt(1.0 + dot(film, film)));
}

// Across the ray, in units: whole numbers that f32 holds. A vertex is at one place for all of its cells, so this
// must be the same arithmetic wherever it stands: so that compilers do not choose here and there what to fuse, all of it is
// fused (drivers keep to that, though no standard says that they have to). No edge is longer than 2^24 units, so a vertex
// that lies farther along either axis is on no cell that the ray meets: the others of its cells lie on its side of the
// ray, and so it may be moved along that axis, up to there.
fn place_across(ray: Ray, p: vec3f) -> vec2f {
    let x = fma(p.z, ray.x_row.z, fma(p.y, ray.x_row.y, fma(p.x, ray.x_row.x, ray.x_offset)));
    let y = fma(p.z, ray.y_row.z, fma(p.y, ray.y_row.y, fma(p.x, ray.y_row.x, ray.y_offset)));
    return clamp(round(rays.units * vec2f(x, y)), vec2f(-16777216.0), vec2f(16777216.0));
}

// View depth from that of the mesh's centre.
fn depth_of(p: vec3f) -> f32 {
    return fma(p.z, rays.forward.z, fma(p.y, rays.forward.y, p.x * rays.forward.x));
}

// Twice the areas of three triangles of the ray and an edge from a to b, places across the ray: positive where that turns
// left. Of the sign that exact arithmetic gives, and exact but for 2^-24 of cells within 2^15 units of the ray.
//
// a x b is below 2^49, and f32 errs by less than 2^26 of its two products: a difference beyond 2^30 has the right sign.
// A lesser one is below 2^31, so that the 32-bit product, which is right but for multiples of 2^32, is the exact value.
fn areas(ax: vec3f, ay: vec3f, bx: vec3f, by: vec3f) -> vec3f {
    let rounded = ax * by - ay * bx;
    let exact = vec3i(ax) * vec3i(by) - vec3i(ay) * vec3i(bx);
    return select(rounded, vec3f(exact), abs(rounded) < vec3f(1073741824.0));
}

// Whether edges of these areas turn left; `before`: a's vertex comes before b's. Those that meet the ray count as if it were
// moved along the first axis by an infinitesimal, and along the second by one of that; of vertices at one place, as if
// the later one lay to the left by less still. Exactly one of (a, b) and (b, a) turns left.
fn turn_left(areas: vec3f, ax: vec3f, ay: vec3f, bx: vec3f, by: vec3f, before: vec3<bool>) -> vec3<bool> {
    let tie = (ay > by) | ((ay == by) & ((bx > ax) | ((bx == ax) & before)));
    return (areas > vec3f(0.0)) | ((areas == vec3f(0.0)) & tie);
}
