//! Cells in any order: fragments listed, sorted and composed pixel by pixel.

use super::{GpuRenderer, unprepared};
use crate::error::Result;
use crate::gpu::kernel::DrawKernel;
use crate::gpu::lists::{FragmentLists, Strip};
use crate::gpu::record::{Recorder, Work};
use crate::gpu::sort;
use crate::renderer::PassTime;

impl GpuRenderer {
    /// Counts the fragments of the cells in the picture, in any order, and lists and composes them strip by strip.
    /// Returns the strips and the passes' times.
    pub(super) fn list_and_compose(
        &self,
        mut recorder: Recorder<'_>,
        lists: &mut FragmentLists,
    ) -> Result<(Vec<Strip>, Vec<PassTime>)> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let kernels = scene.lists.as_ref().ok_or_else(unprepared)?;
        let gpu = &self.gpu;
        recorder.submit();
        let cells = sort::survivors(gpu, &self.store.cells.counts)?;
        lists.clear(&mut recorder);
        self.draw_listed(&mut recorder, lists, &kernels.tally, cells, None)?;
        let resources = self.resources(&scene.transfer);
        let all = lists.offer(resources.clone());
        recorder.compute(&lists.rows, &lists.rows.bind(gpu, &all)?, Work::Groups(lists.size[1]))?;
        recorder.submit();
        let strips = lists.plan(gpu)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let all = lists.offer(resources).with_texture("picture", &target.picture);
        recorder.encoder().clear_buffer(&lists.fragments, 0, None);
        for &strip in &strips {
            gpu.queue.write_buffer(&lists.strip, 0, bytemuck::bytes_of(&strip.uniform()));
            self.draw_listed(&mut recorder, lists, &kernels.list, cells, Some(strip))?;
            lists.compose(gpu, &mut recorder, &all, strip)?;
        }
        lists.check(gpu)?;
        Ok((strips, recorder.finish()?))
    }

    /// Draws all chunks by a pass that counts or lists fragments: all, or those of a strip.
    pub(super) fn draw_listed(
        &self,
        recorder: &mut Recorder<'_>,
        lists: &FragmentLists,
        kernel: &DrawKernel,
        cells: u32,
        strip: Option<Strip>,
    ) -> Result<()> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let store = &self.store;
        let all = lists.offer(self.resources(&scene.transfer));
        let groups = kernel.bind(&self.gpu, &all)?;
        let chunks = cells.max(1).div_ceil(store.chunk_cells);
        for chunk in 0..chunks {
            // Corners of a single chunk stay.
            if strip.is_none() || chunks > 1 {
                self.project_chunk(recorder, &all, chunk)?;
            }
            recorder.draw(kernel, &groups, &[(&target.blended, wgpu::LoadOp::Load)], |pass| {
                if let Some(strip) = strip {
                    let [top, height] = strip.rows(lists.size[0]);
                    pass.set_scissor_rect(0, top, lists.size[0], height);
                }
                pass.set_index_buffer(store.indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.set_vertex_buffer(0, store.cells.corners.slice(..));
                pass.draw_indexed_indirect(&store.cells.draws, u64::from(chunk) * 20);
            })?;
        }
        Ok(())
    }
}
