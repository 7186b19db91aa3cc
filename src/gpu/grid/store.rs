//! What the device holds of the part of a grid that is drawn at a time.

use rayon::prelude::*;

use super::samples::GridSamples;
use crate::error::Result;
use crate::gpu::cover::Cover;
use crate::gpu::device::Gpu;
use crate::gpu::kernel::Resources;
use crate::gpu::layout;
use crate::gpu::store::{DEEP_SPAN, triangle_indices};
use crate::plan::voxels::BRICK;
use crate::tet::{Domain as _, Grid};

/// Voxels of a brick.
const BRICK_VOXELS: u64 = (BRICK * BRICK * BRICK) as u64;

/// Bricks listed in a batch, at most: their cells' numbers leave room for the bits of spans (`shared/bands.wgsl`).
const MOST_BRICKS: usize = 1024;

/// Cells, or spans of them, listed in a batch, at most. One brick's always fit.
const MOST_LISTED: u64 = 1 << 20;

/// Cells that are projected and drawn at a time, at most.
const MOST_PROJECTED: u32 = 65_536;

/// Lists of bricks begin at multiples of this, so that bindings are aligned.
pub const LIST_STEP: usize = 64;

/// Buffers of a grid.
pub struct GridStore {
    /// The grid itself.
    pub samples: GridSamples,
    /// Bricks of a batch, at most.
    pub batch_bricks: usize,
    /// Cells or spans of a batch, at most.
    pub batch_listed: u32,
    /// Cells projected at a time.
    pub chunk_cells: u32,
    // Bound by the raster pass, which shades nothing.
    light: wgpu::Buffer,
    brick_ranges: wgpu::Buffer,
    voxels: wgpu::Buffer,
    block_counts: wgpu::Buffer,
    block_offsets: wgpu::Buffer,
    /// Arguments of an indexed draw a chunk.
    pub draws: wgpu::Buffer,
    /// [`layout::Counts`].
    pub counts: wgpu::Buffer,
    /// Tetrahedra drawn.
    pub drawn_cells: wgpu::Buffer,
    order: wgpu::Buffer,
    /// Corners of one chunk's cells.
    pub corners: wgpu::Buffer,
    /// The triangles of a chunk's cells.
    pub indices: wgpu::Buffer,
    /// A `Chunk` each.
    pub chunks: Vec<wgpu::Buffer>,
}

impl GridStore {
    /// Uploads the samples.
    ///
    /// # Errors
    /// A grid beyond the device's limits, with the numbers.
    pub fn new(gpu: &Gpu, grid: &Grid) -> Result<Self> {
        let samples = GridSamples::new(gpu, grid)?;
        let bricks_along = samples.bricks_along;
        let bricks: usize = bricks_along.iter().product();
        let batch_bricks = bricks.min(MOST_BRICKS);
        let least = 5 * BRICK_VOXELS * u64::from(DEEP_SPAN);
        let batch_listed = (grid.tet_count() * 3 / 2).clamp(least, MOST_LISTED) as u32;
        let chunk_cells = (batch_listed / 8).next_power_of_two().min(MOST_PROJECTED);
        let chunk = |first_cell| layout::Chunk { first_cell, cells: chunk_cells, ..Default::default() };
        let chunks: Vec<_> = (0..batch_listed)
            .step_by(chunk_cells as usize)
            .map(|first| gpu.uniform("chunk", &[chunk(first)]))
            .collect();
        let indices = triangle_indices(Cover::Outline, chunk_cells);
        let index_usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST;
        let index_buffer = gpu.buffer("indices", indices.len() as u64 * 4, index_usage);
        gpu.write(&index_buffer, 0, bytemuck::cast_slice(&indices));
        let (written, copied) = (wgpu::BufferUsages::COPY_DST, wgpu::BufferUsages::COPY_SRC);
        let buffer = |label, bytes, usage| gpu.buffer(label, bytes, wgpu::BufferUsages::STORAGE | usage);
        let none = wgpu::BufferUsages::empty();
        let blocks = batch_bricks as u64 * BRICK_VOXELS / 256;
        Ok(Self {
            batch_bricks,
            batch_listed,
            chunk_cells,
            light: gpu.uniform("light", &[layout::Light::default()]),
            brick_ranges: gpu.storage("brick_ranges", &brick_ranges(grid, &samples)),
            samples,
            voxels: buffer("voxels", blocks * 1024, none),
            block_counts: buffer("block_counts", blocks * 4, none),
            block_offsets: buffer("block_offsets", blocks * 4, none),
            draws: buffer("draws", chunks.len() as u64 * 20, wgpu::BufferUsages::INDIRECT),
            counts: buffer("counts", size_of::<layout::Counts>() as u64, copied),
            drawn_cells: buffer("drawn_cells", 4, copied | written),
            order: buffer("order", u64::from(batch_listed) * 4, copied),
            // Of a bivariate scene.
            corners: buffer("corners", u64::from(chunk_cells) * 4 * 100, wgpu::BufferUsages::VERTEX),
            indices: index_buffer,
            chunks,
        })
    }

    /// The tetrahedra of a batch, or spans of them, back to front.
    pub fn order(&self) -> &wgpu::Buffer {
        &self.order
    }

    /// Buffers by the names that shaders give them.
    pub fn resources(&self) -> Resources<'_> {
        let own = self.working().into_iter().chain([("light", &self.light), ("brick_ranges", &self.brick_ranges)]);
        own.fold(self.samples.resources(), |r, (name, buffer)| r.with(name, buffer))
    }

    /// What grows with the grid.
    pub fn held(&self) -> Vec<(&'static str, &wgpu::Buffer)> {
        self.samples.held().into_iter().chain([("brick_ranges", &self.brick_ranges)]).collect()
    }

    /// What is drawn at a time.
    pub fn working(&self) -> [(&'static str, &wgpu::Buffer); 9] {
        [
            ("voxels", &self.voxels),
            ("block_counts", &self.block_counts),
            ("block_offsets", &self.block_offsets),
            ("draws", &self.draws),
            ("counts", &self.counts),
            ("drawn_cells", &self.drawn_cells),
            ("order", &self.order),
            ("corners", &self.corners),
            ("indices", &self.indices),
        ]
    }
}

/// Least and largest scalar and gradient magnitude of the samples of each brick, x fastest.
fn brick_ranges(grid: &Grid, on_device: &GridSamples) -> Vec<[f32; 4]> {
    let (bricks, scalar, gradient) = (on_device.bricks_along, on_device.scalar, on_device.gradient);
    let [nx, ny, _] = grid.points;
    let range_of = |brick: usize| {
        let at = [brick % bricks[0], brick / bricks[0] % bricks[1], brick / bricks[0] / bricks[1]];
        let samples = |axis: usize| at[axis] * BRICK..(at[axis] * BRICK + BRICK + 1).min(grid.points[axis]);
        let mut range = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        for k in samples(2) {
            for j in samples(1) {
                let row = nx * (j + ny * k);
                for i in samples(0) {
                    let (s, g) = (grid.scalar[row + i], grid.gradient_magnitude[row + i]);
                    range = [range[0].min(s), range[1].max(s), range[2].min(g), range[3].max(g)];
                }
            }
        }
        let [s, t, g, h] = range;
        [scalar.apply(s), scalar.apply(t), gradient.apply(g), gradient.apply(h)].map(|v| v as f32)
    };
    (0..bricks.iter().product()).into_par_iter().map(range_of).collect()
}
