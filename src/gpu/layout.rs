//! Every struct that a shader sees, as the host writes it. `tests/layout.rs` compares each with naga's layout.

use bytemuck::{Pod, Zeroable};

/// `shared/frame.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct Frame {
    pub reference: [f32; 3],
    pub tet_count: u32,
    pub eye_from_reference: [f32; 3],
    pub vertex_count: u32,
    pub x_row: [f32; 3],
    pub image_width: f32,
    pub y_row: [f32; 3],
    pub image_height: f32,
    pub forward: [f32; 3],
    pub ray_per_clip_x: f32,
    pub ray_per_clip_y: f32,
    pub chunk_cells: u32,
    pub most_drawn: u32,
    pub pad_a: u32,
    pub background: [f32; 4],
    pub x_offset: f32,
    pub y_offset: f32,
    pub z_offset: f32,
    pub pad_b: f32,
}

/// `shared/ray.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct Rays {
    pub right: [f32; 3],
    pub least_transmittance: f32,
    pub up: [f32; 3],
    pub near: f32,
    pub forward: [f32; 3],
    pub groups: u32,
    pub film: [f32; 2],
    pub film_step: [f32; 2],
    pub start: [f32; 2],
    pub start_step: [f32; 2],
    pub pixel: [i32; 2],
    pub size: [u32; 2],
    pub background: [f32; 4],
    pub first_row: u32,
    pub goes_on: u32,
    pub eye: f32,
    pub units: f32,
}

/// `shared/light.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct Light {
    pub direction: [f32; 3],
    pub ambient: f32,
    pub diffuse: f32,
    pub specular: f32,
    pub shininess: f32,
    pub strength: f32,
    pub exponent: f32,
    pub pad_a: f32,
    pub pad_b: f32,
    pub pad_c: f32,
}

/// `shared/range.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct Range {
    pub first_tet: u32,
    pub tet_count: u32,
    pub pad_a: u32,
    pub pad_b: u32,
}

/// `shared/counts.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct Counts {
    pub survivors: u32,
    pub sort_tiles: u32,
    pub pad_a: u32,
    pub pad_b: u32,
    pub sort_groups_x: u32,
    pub sort_groups_y: u32,
    pub sort_groups_z: u32,
    pub pad_c: u32,
}

/// `shared/widgets.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct Widget {
    pub whiten: [f32; 4],
    pub center: [f32; 2],
    pub extinction: f32,
    pub shape: u32,
    pub color: [f32; 3],
    pub pad_a: f32,
    pub scalar_low: f32,
    pub scalar_high: f32,
    pub gradient_low: f32,
    pub gradient_high: f32,
    pub window_direction: [f32; 2],
    pub pad_b: [f32; 2],
    pub knots: [u32; 4],
}

/// `segments.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct SegmentCase {
    pub front: [f32; 2],
    pub back: [f32; 2],
    pub extent: f32,
    pub first_widget: u32,
    pub widget_count: u32,
    pub pad: u32,
}

/// `segments.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct SegmentResult {
    pub color: [f32; 4],
    pub pieces: u32,
    pub pad_a: u32,
    pub pad_b: u32,
    pub pad_c: u32,
}

/// `shared/transfer.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct Piece {
    pub origin: [f32; 4],
    pub slope: [f32; 4],
}

/// `candidates.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct BandTotals {
    pub bands: u32,
    pub pairs: u32,
    pub most: u32,
    pub deep: u32,
}

/// `shared/lists.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct Strip {
    pub first_pixel: u32,
    pub end_pixel: u32,
    pub base: u32,
    pub goes_on: u32,
}

/// `shared/corners.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct Chunk {
    pub first_cell: u32,
    pub cells: u32,
    pub pad_a: u32,
    pub pad_b: u32,
}

/// `shared/grid.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct Grid {
    pub points: [u32; 3],
    pub least_depth: f32,
    pub nearest: [u32; 3],
    pub longest_edge: f32,
    pub low: [u32; 3],
    pub pad_a: u32,
    pub high: [u32; 3],
    pub pad_b: u32,
    pub near_low: [u32; 3],
    pub pad_c: u32,
    pub near_high: [u32; 3],
    pub pad_d: u32,
}

/// `grid_candidates.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[expect(missing_docs, reason = "the fields are documented in the shader")]
pub struct BrickCount {
    pub cells: u32,
    pub bands: u32,
    pub pairs: u32,
    pub most: u32,
}
