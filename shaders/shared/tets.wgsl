// Tetrahedra by number, for passes that visit them in any order: bindings are limited in size, so the buffer is bound in
// parts of PART_TETS.
@group(1) @binding(4) var<storage, read> tets_a: array<vec4u>; // vertex ids ascend
@group(1) @binding(5) var<storage, read> tets_b: array<vec4u>;
@group(1) @binding(6) var<storage, read> tets_c: array<vec4u>;
@group(1) @binding(7) var<storage, read> tets_d: array<vec4u>;
@group(1) @binding(8) var<storage, read> volumes: array<f32>; // 6 x volume, negative where odd

override TET_PARTS: u32 = 1u;
override PART_TETS: u32 = 0xffffffffu;

fn tet_at(cell: u32) -> vec4u {
    if TET_PARTS == 1u {
        return tets_a[cell];
    }
    let i = cell % PART_TETS;
    switch cell / PART_TETS {
        case 0u: { return tets_a[i]; }
        case 1u: { return tets_b[i]; }
        case 2u: { return tets_c[i]; }
        default: { return tets_d[i]; }
    }
}
