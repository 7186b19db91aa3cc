// The range of tetrahedra that one dispatch sees: bindings are limited in size, meshes are not.
struct Range {
    // First tetrahedron of the range; a multiple of 256.
    first_tet: u32,
    // Tetrahedra in the range.
    tet_count: u32,
    pad_a: u32,
    pad_b: u32,
}

@group(3) @binding(0) var<uniform> range: Range;
