//! Passes that cast rays, in dispatches that a device does not stop.

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::kernel::{Kernel, Resources};
use crate::gpu::layout;
use crate::gpu::record::{Recorder, Work};
use crate::gpu::renderer::unprepared;
use crate::renderer::PassTime;

/// What rays of one dispatch leave, bytes at most.
const MOST_STATES: u64 = 64 << 20;

/// Turns of loops after which a dispatch leaves a ray. lavapipe ends the loops of 8 rays at once after 65,535 turns.
const SOFTWARE_TURNS: u32 = 7_000;
const HARDWARE_TURNS: u32 = 200_000;

/// Where the times of passes go.
pub struct Timed<'a> {
    /// Whether they are taken.
    pub timed: bool,
    /// Those so far.
    pub passes: &'a mut Vec<PassTime>,
}

/// Runs such passes: slab by slab of the picture, each of them until all its rays have come through.
pub struct RayRunner {
    /// Turns of loops after which a dispatch leaves a ray.
    pub most_turns: u32,
    /// Pixels along a tile's side: a workgroup each.
    tile: u32,
    /// Of a ray that has not come through.
    state_bytes: u64,
    rays: wgpu::Buffer,
    states: wgpu::Buffer,
    unfinished: wgpu::Buffer,
    unfinished_mapped: wgpu::Buffer,
}

impl RayRunner {
    /// For passes of such tiles and states.
    pub fn new(gpu: &Gpu, tile: u32, state_bytes: u64) -> Self {
        let storage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        let mapped = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        Self {
            most_turns: if gpu.is_software() { SOFTWARE_TURNS } else { HARDWARE_TURNS },
            tile,
            state_bytes,
            rays: gpu.uniform("rays", &[layout::Rays::default()]),
            states: gpu.buffer("states", 0, storage),
            unfinished: gpu.buffer("unfinished", 0, storage),
            unfinished_mapped: gpu.buffer("unfinished, mapped", 0, mapped),
        }
    }

    /// What rays leave.
    pub fn states(&self) -> &wgpu::Buffer {
        &self.states
    }

    /// Makes room for the rays of a picture of this size.
    ///
    /// # Errors
    /// A row of tiles beyond the device's limits, with the numbers.
    pub fn need_states(&mut self, gpu: &Gpu, size: [u32; 2]) -> Result<()> {
        let (rows, row_bytes) = (size[1].div_ceil(self.tile), self.row_bytes(size[0]));
        let most = (MOST_STATES.min(gpu.max_binding) / row_bytes).clamp(1, rows.into());
        grow(gpu, &mut self.states, "states", most * row_bytes)
    }

    /// Casts rows of tiles, after [`Self::need_states`]; `uniform` is of the picture.
    ///
    /// # Errors
    /// A lost device.
    pub fn run(
        &self,
        gpu: &Gpu,
        kernel: &Kernel,
        resources: &Resources<'_>,
        uniform: &mut layout::Rays,
        [start, end]: [u32; 2],
        to: &mut Timed<'_>,
    ) -> Result<()> {
        let own = [("rays", &self.rays), ("states", &self.states), ("unfinished", &self.unfinished)];
        let resources = own.into_iter().fold(resources.clone(), |all, (name, buffer)| all.with(name, buffer));
        let groups = kernel.bind(gpu, &resources)?;
        let columns = uniform.size[0].div_ceil(self.tile);
        let most = (self.states.size() / self.row_bytes(uniform.size[0])).max(1) as u32;
        for first in (start..end).step_by(most as usize) {
            (uniform.first_row, uniform.goes_on) = (first, 0);
            let tiles = [columns, most.min(end - first)];
            loop {
                gpu.queue.write_buffer(&self.rays, 0, bytemuck::bytes_of(uniform));
                let mut recorder = Recorder::new(gpu, to.timed);
                recorder.encoder().clear_buffer(&self.unfinished, 0, None);
                recorder.compute(kernel, &groups, Work::Tiles(tiles))?;
                recorder.encoder().copy_buffer_to_buffer(&self.unfinished, 0, &self.unfinished_mapped, 0, 4);
                to.passes.extend(recorder.finish()?);
                let unfinished: Vec<u32> = gpu.map(&self.unfinished_mapped, 4)?;
                // Each dispatch takes every ray that is left on by one turn at least.
                if *unfinished.first().ok_or_else(unprepared)? == 0 {
                    break;
                }
                uniform.goes_on = 1;
            }
        }
        Ok(())
    }

    /// What a row of tiles leaves.
    fn row_bytes(&self, width: u32) -> u64 {
        u64::from(width * self.tile) * self.state_bytes
    }
}

/// Makes a buffer anew where it is too small.
///
/// # Errors
/// One beyond the device's limits, with the numbers.
pub fn grow(gpu: &Gpu, buffer: &mut wgpu::Buffer, label: &str, bytes: u64) -> Result<()> {
    if bytes > gpu.max_binding {
        return Err(Error::Device(format!(
            "'{label}' of a picture takes {} MiB, and '{}' binds {} MiB: render a smaller picture, or with --device cpu",
            bytes >> 20,
            gpu.info.name,
            gpu.max_binding >> 20
        )));
    }
    if buffer.size() < bytes {
        *buffer = gpu.buffer(label, (bytes + bytes / 4).min(gpu.max_binding), buffer.usage());
    }
    Ok(())
}
