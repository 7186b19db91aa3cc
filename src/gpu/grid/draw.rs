//! A frame of a grid: bricks in the order of drawing, batch by batch.

use super::scene::{ShownBrick, packed};
use super::store::LIST_STEP;
use super::{GridRenderer, LastBatch, check, write_grid};
use crate::error::Result;
use crate::gpu::cover::Cover;
use crate::gpu::frame;
use crate::gpu::kernel::Resources;
use crate::gpu::layout;
use crate::gpu::record::{Recorder, Work};
use crate::gpu::renderer::{EMPTY, ZERO, unprepared};
use crate::gpu::sort;
use crate::gpu::target::Target;
use crate::plan::voxels::{self, BRICK, Near, Sides};
use crate::renderer::{Frame, PassTime};
use crate::scene::Camera;
use crate::space::Bounds;
use crate::tet::VoxelBox;

/// Bricks that are drawn together.
struct Batch {
    /// Where their list begins.
    first: usize,
    bricks: usize,
    /// Cells, or spans of them, at most.
    listed: u32,
}

impl GridRenderer {
    /// Draws a frame; the picture is left in the target. Returns the passes' times and the voxels that were drawn
    /// otherwise.
    pub(super) fn draw_frame(&mut self, frame: &Frame<'_>, timed: bool) -> Result<(Vec<PassTime>, VoxelBox)> {
        check(frame.optics)?;
        self.prepare_scene(frame)?;
        if self.target.as_ref().is_none_or(|t| t.size != frame.size) {
            self.target = Some(Target::new(&self.gpu, frame.size, false)?);
        }
        let aspect = f64::from(frame.size[0]) / f64::from(frame.size[1]);
        let near = voxels::near(&self.grid, &self.part, frame.camera, aspect);
        let has_near = near.voxels.count() > 0;
        let mut passes = self.draw_near(frame, &near.voxels, timed)?;
        let nearest = voxels::nearest(&self.grid, frame.camera);
        write_grid(&self.gpu, &self.store.samples, &self.grid, &self.part, nearest, Some(&near));
        self.scene.as_mut().ok_or_else(unprepared)?.need_raster(&self.gpu)?;
        let gpu = self.gpu.clone();
        let mut recorder = Recorder::new(&gpu, timed);
        let (list, batches) = recorder.host("order of bricks", || self.batches(frame.camera, aspect, nearest, &near));
        self.write_frames(frame, &batches);
        let bricks = self.gpu.storage("bricks", &list);
        self.draw_batches(&mut recorder, &bricks, &batches)?;
        self.finish_picture(&mut recorder, has_near)?;
        self.last_batch = batches.last().map(|batch| {
            let bricks = list[batch.first..batch.first + batch.bricks].to_vec();
            LastBatch { bricks, nearest }
        });
        passes.extend(recorder.finish()?);
        Ok((grouped(passes), near.voxels))
    }

    /// The list of the bricks in the picture, back to front, and how it is cut.
    fn batches(&self, camera: &Camera, aspect: f64, nearest: [usize; 3], near: &Near) -> (Vec<u32>, Vec<Batch>) {
        let shown = self.scene.as_ref().map_or(&[][..], |scene| &scene.shown);
        let sides = Sides::new(&self.grid, camera, aspect, near.least_depth);
        let turn = |at: [usize; 3]| -> [usize; 3] {
            let of = |axis: usize| voxels::turn(nearest[axis] / BRICK, self.store.samples.bricks_along[axis], at[axis]);
            [of(2), of(1), of(0)]
        };
        let mut seen: Vec<([usize; 3], &ShownBrick)> =
            shown.iter().filter(|b| !sides.miss(&self.brick_bounds(b.at))).map(|b| (turn(b.at), b)).collect();
        seen.sort_unstable_by_key(|(turn, _)| *turn);
        let mut list: Vec<u32> = Vec::with_capacity(seen.len() + LIST_STEP);
        let mut batches: Vec<Batch> = Vec::new();
        for (_, brick) in seen {
            let fits =
                |b: &Batch| b.bricks < self.store.batch_bricks && b.listed + brick.listed <= self.store.batch_listed;
            match batches.last_mut().filter(|b| fits(b)) {
                Some(batch) => {
                    batch.bricks += 1;
                    batch.listed += brick.listed;
                }
                None => {
                    list.resize(list.len().next_multiple_of(LIST_STEP), 0);
                    batches.push(Batch { first: list.len(), bricks: 1, listed: brick.listed });
                }
            }
            list.push(packed(brick.at));
        }
        (list, batches)
    }

    fn brick_bounds(&self, at: [usize; 3]) -> Bounds {
        let ends = |up: usize| {
            let place = |axis: usize| {
                let places = &self.grid.places[axis];
                places[((at[axis] + up) * BRICK).min(places.len() - 1)]
            };
            glam::DVec3::new(place(0), place(1), place(2))
        };
        Bounds::of([ends(0), ends(1)])
    }

    /// The camera, with each batch's counts.
    fn write_frames(&mut self, frame: &Frame<'_>, batches: &[Batch]) {
        let camera = frame::camera_uniform(frame, &*self.grid);
        // One at least, to finish the picture by.
        while self.frames.len() < batches.len().max(1) {
            self.frames.push(self.gpu.uniform("frame", &[camera]));
        }
        self.gpu.queue.write_buffer(&self.frames[0], 0, bytemuck::bytes_of(&camera));
        for (buffer, batch) in self.frames.iter().zip(batches) {
            let uniform = layout::Frame {
                tet_count: (batch.bricks * BRICK * BRICK * BRICK) as u32,
                chunk_cells: self.store.chunk_cells,
                most_drawn: batch.listed,
                ..camera
            };
            self.gpu.queue.write_buffer(buffer, 0, bytemuck::bytes_of(&uniform));
        }
    }

    fn draw_batches(&self, recorder: &mut Recorder<'_>, bricks: &wgpu::Buffer, batches: &[Batch]) -> Result<()> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let gpu = &self.gpu;
        recorder.encoder().clear_buffer(&self.store.drawn_cells, 0, None);
        recorder.draw(&scene.resolve, &[], &[(&target.blended, EMPTY)], |_| {})?;
        let held = scene.transfer.offer(self.store.resources());
        for (batch, frame) in batches.iter().zip(&self.frames) {
            let size = (batch.bricks * 4) as u64;
            let all = held.clone().with("frame", frame).with_part("bricks", bricks, batch.first as u64 * 4, size);
            let voxels = (batch.bricks * BRICK * BRICK * BRICK) as u32;
            recorder.compute(&scene.cull, &scene.cull.bind(gpu, &all)?, Work::Items(voxels))?;
            recorder.compute(&scene.compact, &scene.compact.bind(gpu, &all)?, Work::Groups(1))?;
            recorder.compute(&scene.list, &scene.list.bind(gpu, &all)?, Work::Items(voxels))?;
            // Waiting here also bounds what a software adapter has to hold.
            let mut known = None;
            if gpu.is_software() {
                recorder.submit();
                known = Some(sort::survivors(gpu, &self.store.counts)?);
            }
            self.draw_listed(recorder, &all, (known, batch.listed))?;
        }
        Ok(())
    }

    /// Projects and blends a batch's cells, chunk by chunk: so many, or as many as are counted, `most` at most.
    fn draw_listed(
        &self,
        recorder: &mut Recorder<'_>,
        all: &Resources<'_>,
        (known, most): (Option<u32>, u32),
    ) -> Result<()> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let (gpu, store) = (&self.gpu, &self.store);
        let raster = scene.raster.as_ref().ok_or_else(unprepared)?;
        let groups = raster.bind(gpu, all)?;
        let indices = Cover::Outline.indices();
        for chunk in 0..known.unwrap_or(most).div_ceil(store.chunk_cells) {
            let rest = known.unwrap_or(most) - chunk * store.chunk_cells;
            let cells = rest.min(store.chunk_cells);
            let resources = all.clone().with("chunk", &store.chunks[chunk as usize]);
            recorder.compute(&scene.project, &scene.project.bind(gpu, &resources)?, Work::Items(cells))?;
            // One draw: smaller ones fit a software adapter's caches better, but lavapipe keeps about 1 MB of each.
            recorder.draw(raster, &groups, &[(&target.blended, wgpu::LoadOp::Load)], |pass| {
                pass.set_index_buffer(store.indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.set_vertex_buffer(0, store.corners.slice(..));
                match known {
                    None => pass.draw_indexed_indirect(&store.draws, u64::from(chunk) * 20),
                    Some(_) => pass.draw_indexed(0..cells * indices, 0, 0..1),
                }
            })?;
        }
        Ok(())
    }

    fn finish_picture(&self, recorder: &mut Recorder<'_>, has_near: bool) -> Result<()> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        if has_near {
            let caster = self.near.as_ref().ok_or_else(unprepared)?;
            let picture = Resources::default().with_texture("near", caster.picture().ok_or_else(unprepared)?);
            let groups = scene.near.bind(&self.gpu, &picture)?;
            let over = [(&target.blended, wgpu::LoadOp::Load)];
            recorder.draw(&scene.near, &groups, &over, |pass| pass.draw(0..3, 0..1))?;
        }
        let textures = Resources::default()
            .with("frame", &self.frames[0])
            .with_texture("blended", &target.blended)
            .with_texture("behind", &target.blended);
        let groups = scene.resolve.bind(&self.gpu, &textures)?;
        recorder.draw(&scene.resolve, &groups, &[(&target.picture, ZERO)], |pass| pass.draw(0..3, 0..1))
    }
}

/// Batches and draws are many: one line a pass.
fn grouped(times: Vec<PassTime>) -> Vec<PassTime> {
    let mut sums: Vec<(PassTime, u32)> = Vec::new();
    for time in times {
        match sums.iter_mut().find(|(sum, _)| sum.pass == time.pass) {
            Some((sum, count)) => {
                sum.time += time.time;
                *count += 1;
            }
            None => sums.push((time, 1)),
        }
    }
    let named = |(sum, count): (PassTime, u32)| PassTime { work: format!("{count} times"), ..sum };
    sums.into_iter().map(named).collect()
}
