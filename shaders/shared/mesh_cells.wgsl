#import shared/tets

// A mesh's cells, for shared/corners.wgsl.

@group(1) @binding(0) var<storage, read> vertices: array<vec4f>;
@group(1) @binding(1) var<storage, read> gradients: array<f32>;
@group(1) @binding(2) var<storage, read> gradient_vectors: array<f32>; // three a vertex; the largest has length 1
@group(3) @binding(3) var<storage, read> projected: array<vec2f>;
@group(3) @binding(4) var<storage, read> cell_bands: array<u32>;

struct Cell {
    // Vertex ids, ascending.
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
    let tet = tet_at(cell);
    return Cell(tet, vertices[tet.x], vertices[tet.y], vertices[tet.z], vertices[tet.w], volumes[cell]);
}

fn bands_of(cell: u32, scalars: vec4f) -> u32 {
    return cell_bands[cell];
}

fn clip_of(vertex: u32) -> vec2f {
    return projected[vertex];
}

fn gradient_of(vertex: u32) -> f32 {
    return gradients[vertex];
}

fn vector_of(vertex: u32) -> vec3f {
    let at = 3u * vertex;
    return vec3f(gradient_vectors[at], gradient_vectors[at + 1u], gradient_vectors[at + 2u]);
}
