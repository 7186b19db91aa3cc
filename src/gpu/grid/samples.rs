//! What the device holds of a grid.

use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::grid::levels::Levels;
use crate::gpu::kernel::Resources;
use crate::gpu::layout;
use crate::plan::voxels::BRICK;
use crate::tet::{Axis, Domain as _, Grid};

/// Bricks along an axis, at most: their places share a word (`shared/grid.wgsl`).
const MOST_ALONG: usize = 1023;

/// A grid's samples.
pub struct GridSamples {
    /// How scalars became 0..1.
    pub scalar: Axis,
    /// How gradient magnitudes became 0..1.
    pub gradient: Axis,
    /// Bricks along each axis.
    pub bricks_along: [usize; 3],
    /// [`layout::Grid`].
    pub grid: wgpu::Buffer,
    sample_bits: u32,
    samples: wgpu::Buffer,
    levels: wgpu::Buffer,
    // 16 bytes until a scene needs them.
    gradients: wgpu::Buffer,
    places: wgpu::Buffer,
}

impl GridSamples {
    /// Uploads all but gradient magnitudes.
    ///
    /// # Errors
    /// A grid beyond the device's limits, with the numbers.
    pub fn new(gpu: &Gpu, grid: &Grid) -> Result<Self> {
        let bricks_along = grid.voxels().map(|n| n.div_ceil(BRICK));
        let scalar = Axis::of(grid.scalar_range());
        let Levels { bits, words, mut values } = Levels::of(&narrowed(&grid.scalar, scalar));
        // Bound though it is not read.
        values.resize(values.len().max(4), 0.0);
        let bytes = words.len() as u64 * 4;
        // Tetrahedra are numbered in 32 bits.
        if bytes > gpu.max_binding
            || grid.tet_count() > u64::from(u32::MAX)
            || bricks_along.iter().any(|&n| n > MOST_ALONG)
        {
            let [x, y, z] = grid.points;
            return Err(Error::Device(format!(
                "a grid of {x} x {y} x {z} samples is {} MiB; '{}' binds {} MiB at once, and {} voxels are drawn along \
                 an axis at most: coarsen the grid, or cut it",
                bytes >> 20,
                gpu.info.name,
                gpu.max_binding >> 20,
                MOST_ALONG * BRICK
            )));
        }
        let places: Vec<f32> = grid.places.iter().flatten().map(|&p| p as f32).collect();
        Ok(Self {
            scalar,
            gradient: Axis::of(grid.gradient_range()),
            bricks_along,
            grid: gpu.uniform("grid", &[layout::Grid::default()]),
            sample_bits: bits,
            samples: gpu.storage("samples", &words),
            levels: gpu.storage("levels", &values),
            gradients: gpu.storage("gradients", &[0.0f32; 4]),
            places: gpu.storage("places", &places),
        })
    }

    /// The same samples, for passes that see a part of the grid of their own.
    pub fn shared(&self, gpu: &Gpu) -> Self {
        let [samples, levels] = [&self.samples, &self.levels].map(wgpu::Buffer::clone);
        let [gradients, places] = [&self.gradients, &self.places].map(wgpu::Buffer::clone);
        let grid = gpu.uniform("grid", &[layout::Grid::default()]);
        Self { samples, levels, gradients, places, grid, ..*self }
    }

    /// Uploads gradient magnitudes, if no scene needed them before.
    ///
    /// # Errors
    /// A grid beyond the device's limits, with the numbers.
    pub fn need_gradients(&mut self, gpu: &Gpu, grid: &Grid) -> Result<()> {
        let bytes = grid.scalar.len() as u64 * 4;
        if bytes > gpu.max_binding {
            let [x, y, z] = grid.points;
            return Err(Error::Device(format!(
                "the gradient magnitudes of {x} x {y} x {z} samples are {} MiB, and '{}' binds {} MiB at once: take a \
                 function of the scalar alone, coarsen the grid, or cut it",
                bytes >> 20,
                gpu.info.name,
                gpu.max_binding >> 20
            )));
        }
        if self.gradients.size() < bytes {
            self.gradients = gpu.storage("gradients", &narrowed(&grid.gradient_magnitude, self.gradient));
        }
        Ok(())
    }

    /// What shaders are specialised to.
    pub fn constant(&self) -> (&'static str, f64) {
        ("SAMPLE_BITS", self.sample_bits.into())
    }

    /// Buffers by the names that shaders give them.
    pub fn resources(&self) -> Resources<'_> {
        self.held().into_iter().fold(Resources::default().with("grid", &self.grid), |r, (name, b)| r.with(name, b))
    }

    /// What grows with the grid.
    pub fn held(&self) -> [(&'static str, &wgpu::Buffer); 4] {
        [("samples", &self.samples), ("levels", &self.levels), ("gradients", &self.gradients), ("places", &self.places)]
    }
}

fn narrowed(values: &[f64], axis: Axis) -> Vec<f32> {
    values.par_iter().map(|&v| axis.apply(v) as f32).collect()
}
