// The mesh as rays walk through it (tet/linked.rs). A slot holds what is known of a vertex. In the compact layout there is
// one for each vertex, found through `ids`; in the fast one each corner of each cell has its own, one look-up nearer.
// Bindings are limited in size, so links and ids are bound in parts of PART_CELLS.
@group(1) @binding(0) var<storage, read> links_a: array<u32>; // four a cell
@group(1) @binding(1) var<storage, read> links_b: array<u32>;
@group(1) @binding(2) var<storage, read> links_c: array<u32>;
@group(1) @binding(3) var<storage, read> links_d: array<u32>;
@group(1) @binding(4) var<storage, read> ids_a: array<u32>; // four a cell, ascending
@group(1) @binding(5) var<storage, read> ids_b: array<u32>;
@group(1) @binding(6) var<storage, read> ids_c: array<u32>;
@group(1) @binding(7) var<storage, read> ids_d: array<u32>;
@group(1) @binding(8) var<storage, read> places: array<f32>; // three a slot, mesh space
@group(1) @binding(9) var<storage, read> scalars: array<f32>; // 0..1
@group(1) @binding(10) var<storage, read> gradients: array<f32>; // magnitudes, 0..1
@group(1) @binding(11) var<storage, read> gradient_vectors: array<f32>; // three a slot; the largest has length 1

override CELLS: u32 = 0u;
override CELL_PARTS: u32 = 1u;
override PART_CELLS: u32 = 0x3fffffffu;
// The fast layout.
override SLOT_PER_CORNER: bool = false;

const NO_LINK: u32 = 0xffffffffu; // tet/linked.rs

// Across the face opposite a corner: four times the cell there, plus its corner that is not on the face.
fn link_at(cell: u32, corner: u32) -> u32 {
    if CELL_PARTS == 1u {
        return links_a[cell * 4u + corner];
    }
    let i = cell % PART_CELLS * 4u + corner;
    switch cell / PART_CELLS {
        case 0u: { return links_a[i]; }
        case 1u: { return links_b[i]; }
        case 2u: { return links_c[i]; }
        default: { return links_d[i]; }
    }
}

fn slot_at(cell: u32, corner: u32) -> u32 {
    if SLOT_PER_CORNER {
        return cell * 4u + corner;
    }
    if CELL_PARTS == 1u {
        return ids_a[cell * 4u + corner];
    }
    let i = cell % PART_CELLS * 4u + corner;
    switch cell / PART_CELLS {
        case 0u: { return ids_a[i]; }
        case 1u: { return ids_b[i]; }
        case 2u: { return ids_c[i]; }
        default: { return ids_d[i]; }
    }
}

fn place_at(slot: u32) -> vec3f {
    return vec3f(places[slot * 3u], places[slot * 3u + 1u], places[slot * 3u + 2u]);
}

fn gradient_vector_at(slot: u32) -> vec3f {
    return vec3f(gradient_vectors[slot * 3u], gradient_vectors[slot * 3u + 1u], gradient_vectors[slot * 3u + 2u]);
}
