// What later passes of a frame need to know of the surviving cells; written by `compact`.
struct Counts {
    survivors: u32,
    // Tiles of the sort, and its dispatch.
    sort_tiles: u32,
    pad_a: u32,
    pad_b: u32,
    sort_groups_x: u32,
    sort_groups_y: u32,
    sort_groups_z: u32,
    pad_c: u32,
}
