#import shared/grid
#import shared/reached

// A grid's cells, for shared/corners.wgsl: the voxel's number in the batch x 8 + the tetrahedron's. Vertices are
// numbered as samples.

struct Cell {
    tet: vec4u,
    // Place and scalar of each.
    a: vec4f,
    b: vec4f,
    c: vec4f,
    d: vec4f,
    // 6 x volume, negative where odd.
    volume: f32,
}

fn cell_at(cell: u32) -> Cell {
    let slot = cell >> 3u;
    let voxel = voxel_of(bricks[slot >> 9u], slot & 511u);
    let tet = tet_of(voxel, cell & 7u);
    let corners = corners_of(tet);
    let a = voxel + corner_step(corners.x);
    let b = voxel + corner_step(corners.y);
    let c = voxel + corner_step(corners.z);
    let d = voxel + corner_step(corners.w);
    let sides = place_at(voxel + 1u) - place_at(voxel);
    let volume = sides.x * sides.y * sides.z * select(1.0, 2.0, (cell & 7u) == MIDDLE);
    return Cell(vec4u(sample_at(a), sample_at(b), sample_at(c), sample_at(d)), vertex_at(a), vertex_at(b), vertex_at(c),
                vertex_at(d), select(volume, -volume, (tet & 4096u) != 0u));
}

fn bands_of(cell: u32, scalars: vec4f) -> u32 {
    let reached = scalar_range(scalars);
    return bands_between(reached.x, reached.y, false);
}

fn clip_of(vertex: u32) -> vec2f {
    let row = vertex / grid.points.x;
    let position = place_at(vec3u(vertex % grid.points.x, row % grid.points.y, row / grid.points.y));
    return clip_from_mesh(position, 1.0 / divisor(position));
}

fn gradient_of(vertex: u32) -> f32 {
    return gradients[vertex];
}

// Grids are not shaded.
fn vector_of(vertex: u32) -> vec3f {
    return vec3f(0.0);
}
