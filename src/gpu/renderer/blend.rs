//! Sorted cells, blended back to front: in f32, or in slabs in f16.

use super::{EMPTY, GpuRenderer, SOFTWARE_DRAW, ZERO, unprepared};
use crate::error::Result;
use crate::gpu::kernel::Resources;
use crate::gpu::record::{Recorder, Work};
use crate::gpu::slabs::Slabs;
use crate::gpu::sort;
use crate::gpu::store::DEEP_SPAN;
use crate::renderer::PassTime;

impl GpuRenderer {
    /// Projects and blends the sorted cells or spans (`order` where the host knows it, else `most` at most) in f32, chunk by
    /// chunk, and finishes the picture.
    pub(super) fn raster(
        &self,
        recorder: &mut Recorder<'_>,
        all: &Resources<'_>,
        order: Option<&[u32]>,
        most: u32,
    ) -> Result<()> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let (gpu, store) = (&self.gpu, &self.store);
        let indices = self.cover.indices();
        let all_deep = scene.spans.is_none_or(|spans| spans.deep);
        let raster = |deep| scene.raster(deep).ok_or_else(unprepared);
        // The variants bind alike.
        let raster_groups = raster(all_deep)?.bind(gpu, all)?;
        let mut load = EMPTY;
        let most = order.map_or(most, |order| order.len() as u32);
        for chunk in 0..most.max(1).div_ceil(store.chunk_cells) {
            self.project_chunk(recorder, all, chunk)?;
            let mut draw = |range: Option<std::ops::Range<u32>>, deep: bool| {
                recorder.draw(raster(deep)?, &raster_groups, &[(&target.blended, load)], |pass| {
                    pass.set_index_buffer(store.indices.slice(..), wgpu::IndexFormat::Uint32);
                    pass.set_vertex_buffer(0, store.cells.corners.slice(..));
                    match range {
                        Some(cells) => pass.draw_indexed(cells.start * indices..cells.end * indices, 0, 0..1),
                        None => pass.draw_indexed_indirect(&store.cells.draws, u64::from(chunk) * 20),
                    }
                })?;
                load = wgpu::LoadOp::Load;
                Ok(())
            };
            match order {
                None => draw(None, all_deep)?,
                Some(order) => {
                    let start = chunk * store.chunk_cells;
                    let cells = store.chunk_cells.min(most - start);
                    let at_once = if gpu.is_software() { SOFTWARE_DRAW } else { cells.max(1) };
                    // Once at least: the first draw clears.
                    for first in (0..cells.max(1)).step_by(at_once as usize) {
                        let drawn = first..cells.min(first + at_once);
                        let spans = &order[(start + drawn.start) as usize..(start + drawn.end) as usize];
                        let deep =
                            all_deep && (scene.spans.is_none() || spans.iter().any(|span| span & DEEP_SPAN != 0));
                        draw(Some(drawn), deep)?;
                    }
                }
            }
        }
        self.finish_picture(recorder, &target.blended)
    }

    /// Makes the corners of one chunk's cells.
    pub(super) fn project_chunk(&self, recorder: &mut Recorder<'_>, all: &Resources<'_>, chunk: u32) -> Result<()> {
        let corners = &self.scene.as_ref().ok_or_else(unprepared)?.corners;
        let resources = all.clone().with("chunk", &self.store.chunks[chunk as usize]);
        recorder.compute(corners, &corners.bind(&self.gpu, &resources)?, Work::Items(self.store.chunk_cells))
    }

    pub(super) fn finish_picture(&self, recorder: &mut Recorder<'_>, composed: &wgpu::TextureView) -> Result<()> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let textures =
            self.resources(&scene.transfer).with_texture("blended", composed).with_texture("behind", composed);
        let groups = scene.resolve.bind(&self.gpu, &textures)?;
        recorder.draw(&scene.resolve, &groups, &[(&target.picture, ZERO)], |pass| pass.draw(0..3, 0..1))
    }

    /// The same in f16, slab by slab. Returns the slabs that held, and the passes' times of the last attempt.
    pub(super) fn raster_slabs(&self, mut recorder: Recorder<'_>, timed: bool) -> Result<(Slabs, Vec<PassTime>)> {
        recorder.submit();
        let cells = sort::survivors(&self.gpu, &self.store.cells.counts)?;
        let mut slabs = self.slabs.clone();
        let mut before = recorder.finish()?;
        loop {
            let mut recorder = Recorder::new(&self.gpu, timed);
            let layers = self.raster_slabs_once(&mut recorder, &slabs.ranges(cells))?;
            let passes = recorder.finish()?;
            let layers: Vec<u32> = match &layers {
                Some(buffer) => self.gpu.map(buffer, buffer.size())?,
                None => Vec::new(),
            };
            if !slabs.refine(cells, &layers) {
                before.extend(passes);
                return Ok((slabs, before));
            }
        }
    }

    /// Draws the slabs; returns a mappable buffer with the most layers of each (and padding).
    pub(super) fn raster_slabs_once(
        &self,
        recorder: &mut Recorder<'_>,
        ranges: &[std::ops::Range<u32>],
    ) -> Result<Option<wgpu::Buffer>> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let (gpu, store) = (&self.gpu, &self.store);
        let indices = self.cover.indices();
        let (Some(kernels), Some(slab_target)) = (&scene.slabs, &target.slabs) else { return Err(unprepared()) };
        let all = self.resources(&scene.transfer);
        let deep = scene.spans.is_none_or(|spans| spans.deep);
        let raster = scene.raster(deep).ok_or_else(unprepared)?;
        let raster_groups = raster.bind(gpu, &all)?;
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        let most_layers = gpu.buffer("most_layers", 4, usage);
        let mapped = (!ranges.is_empty()).then(|| {
            let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
            gpu.buffer("most_layers, mapped", ranges.len() as u64 * 4, usage)
        });
        let resolved = &slab_target.resolved;
        recorder.draw(&scene.resolve, &[], &[(&resolved[0], EMPTY)], |_| {})?;
        let mut projected = None;
        for (slab, range) in ranges.iter().enumerate() {
            let mut loads = [ZERO, ZERO];
            let first_chunk = range.start / store.chunk_cells;
            let last_chunk = (range.end - 1) / store.chunk_cells;
            for chunk in first_chunk..=last_chunk {
                if projected != Some(chunk) {
                    self.project_chunk(recorder, &all, chunk)?;
                    projected = Some(chunk);
                }
                let first = chunk * store.chunk_cells;
                let start = range.start.max(first) - first;
                let end = range.end.min(first + store.chunk_cells) - first;
                let targets = [(&target.blended, loads[0]), (&slab_target.layers, loads[1])];
                recorder.draw(raster, &raster_groups, &targets, |pass| {
                    pass.set_index_buffer(store.indices.slice(..), wgpu::IndexFormat::Uint32);
                    pass.set_vertex_buffer(0, store.cells.corners.slice(..));
                    pass.draw_indexed(start * indices..end * indices, 0, 0..1);
                })?;
                loads = [wgpu::LoadOp::Load; 2];
            }
            let (behind, front) = (&resolved[slab % 2], &resolved[1 - slab % 2]);
            let textures = all
                .clone()
                .with_texture("layers", &slab_target.layers)
                .with("most_layers", &most_layers)
                .with_texture("blended", &target.blended)
                .with_texture("behind", behind);
            let pixels = target.size[0] * target.size[1];
            recorder.compute(&kernels.layers, &kernels.layers.bind(gpu, &textures)?, Work::Items(pixels))?;
            if let Some(mapped) = &mapped {
                recorder.encoder().copy_buffer_to_buffer(&most_layers, 0, mapped, slab as u64 * 4, 4);
                recorder.encoder().clear_buffer(&most_layers, 0, None);
            }
            let groups = kernels.resolve.bind(gpu, &textures)?;
            recorder.draw(&kernels.resolve, &groups, &[(front, ZERO)], |pass| pass.draw(0..3, 0..1))?;
        }
        self.finish_picture(recorder, &resolved[ranges.len() % 2])?;
        Ok(mapped)
    }
}
