//! Ray casting through a grid on the GPU: one compute pass takes every pixel's ray from voxel to voxel.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::samples::GridSamples;
use super::{clipped_part, write_grid};
use crate::error::Result;
use crate::gpu::device::Gpu;
use crate::gpu::kernel::{Kernel, Resources};
use crate::gpu::layout;
use crate::gpu::rays;
use crate::gpu::record::{Recorder, Work};
use crate::gpu::renderer::unprepared;
use crate::gpu::runner::{RayRunner, Timed, grow};
use crate::gpu::target::Target;
use crate::gpu::transfer::TransferBuffers;
use crate::plan::lens::Lens;
use crate::renderer::{BufferSize, Frame, PassTime, RayCounts, Rendered, Renderer, SegmentIntegral, Settings, Stats};
use crate::scene::EmissionModel;
use crate::space::Bounds;
use crate::tet::{Domain as _, Grid, VoxelBox};

/// Pixels along a tile's side: a workgroup each (`grid_cast.wgsl`).
const TILE: u32 = 8;

/// Of a ray that has not come through (`grid_cast.wgsl`), bytes.
const STATE_BYTES: u64 = 32;

/// Renders one grid by ray casting, without a list of its tetrahedra.
pub struct GridCaster {
    gpu: Gpu,
    grid: Arc<Grid>,
    settings: Settings,
    /// The voxels that are seen.
    pub(super) part: VoxelBox,
    samples: GridSamples,
    runner: RayRunner,
    tallies: wgpu::Buffer,
    scene: Option<Scene>,
    target: Option<Target>,
}

/// What depends on the transfer function and what shaders are specialised to.
struct Scene {
    transfer: TransferBuffers,
    perspective: bool,
    cast: Kernel,
    /// A bit for each block of 2 x 2 x 2 voxels: not transparent.
    blocks: wgpu::Buffer,
}

impl GridCaster {
    /// Uploads the grid.
    ///
    /// # Errors
    /// A grid beyond the device's limits, with the numbers.
    pub fn new(gpu: Gpu, grid: Arc<Grid>, settings: Settings) -> Result<Self> {
        let samples = GridSamples::new(&gpu, &grid)?;
        Ok(Self::of(&gpu, &grid, samples, settings))
    }

    /// Of samples that are uploaded already.
    pub(super) fn of(gpu: &Gpu, grid: &Arc<Grid>, samples: GridSamples, settings: Settings) -> Self {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        Self {
            gpu: gpu.clone(),
            grid: Arc::clone(grid),
            settings,
            part: grid.all(),
            samples,
            runner: RayRunner::new(gpu, TILE, STATE_BYTES),
            tallies: gpu.buffer("tallies", 0, usage),
            scene: None,
            target: None,
        }
    }

    /// The same of the voxels that reach into a box alone, which is in data space and parallel to the axes.
    ///
    /// # Errors
    /// [`crate::Error::Asked`] for a box that holds none.
    pub fn clipped_to(mut self, bounds: &Bounds) -> Result<Self> {
        self.part = clipped_part(&self.grid, bounds)?;
        Ok(self)
    }

    /// The same, leaving rays to the next dispatch after so many turns of loops: how short dispatches are tested with small
    /// grids.
    #[must_use]
    pub fn leaving_rays_after(mut self, turns: u32) -> Self {
        // One turn is the loop's own.
        self.runner.most_turns = turns.max(2);
        self
    }

    /// Makes kernels and marks blocks where the transfer function or the kind of projection changed.
    fn prepare_scene(&mut self, frame: &Frame<'_>, perspective: bool) -> Result<()> {
        let emission = frame.optics.emission;
        let same = |s: &Scene| {
            s.transfer.source == *frame.transfer && s.transfer.emission == emission && s.perspective == perspective
        };
        if self.scene.as_ref().is_some_and(same) {
            return Ok(());
        }
        let (integral, samples) = (self.settings.integral, &self.samples);
        let (scalar, gradient, unit) = (samples.scalar, samples.gradient, self.grid.data_per_mesh);
        let transfer = TransferBuffers::new(&self.gpu, frame.transfer, integral, emission, scalar, gradient, unit)?;
        if transfer.bivariate {
            self.samples.need_gradients(&self.gpu, &self.grid)?;
        }
        let flag = |b: bool| f64::from(u8::from(b));
        let mut constants = transfer.constants.clone();
        constants.push(self.samples.constant());
        // What is transparent glows, too, where emission is not weighted by extinction.
        constants.push(("CULL", flag(self.settings.cull && emission == EmissionModel::Weighted)));
        constants.push(("PERSPECTIVE", flag(perspective)));
        constants.push(("MOST_TURNS", self.runner.most_turns.into()));
        let bricks: usize = self.samples.bricks_along.iter().product();
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let blocks = self.gpu.buffer("blocks", bricks as u64 * 8, usage);
        let camera = self.gpu.uniform("frame", &[layout::Frame { vertex_count: bricks as u32, ..Default::default() }]);
        let mark = self.gpu.kernel("grid_marks", &constants)?;
        let resources = transfer.offer(self.samples.resources()).with("frame", &camera).with("blocks", &blocks);
        let mut recorder = Recorder::new(&self.gpu, false);
        recorder.compute(&mark, &mark.bind(&self.gpu, &resources)?, Work::Groups(bricks as u32))?;
        recorder.submit();
        let cast = self.gpu.kernel("grid_cast", &constants)?;
        self.scene = Some(Scene { transfer, perspective, cast, blocks });
        Ok(())
    }

    /// Draws a frame; the picture is left in the target. Times of passes where asked.
    pub(super) fn draw_frame(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Vec<PassTime>> {
        super::check(frame.optics)?;
        let lens = Lens::new(frame.camera, frame.size, &*self.grid);
        write_grid(&self.gpu, &self.samples, &self.grid, &self.part, [0; 3], None);
        self.prepare_scene(frame, lens.perspective)?;
        if self.target.as_ref().is_none_or(|t| t.size != frame.size) {
            self.target = Some(Target::new(&self.gpu, frame.size, false)?);
        }
        let tiles = frame.size.map(|n| n.div_ceil(TILE));
        self.runner.need_states(&self.gpu, frame.size)?;
        grow(&self.gpu, &mut self.tallies, "tallies", u64::from(tiles[0]) * u64::from(tiles[1]) * 4)?;
        let mut recorder = Recorder::new(&self.gpu, false);
        recorder.encoder().clear_buffer(&self.tallies, 0, None);
        recorder.submit();
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let resources = self.resources(scene).with_texture("picture", &target.picture);
        let mut uniform = rays::uniform(&lens, frame.size, 0, 0.0, self.settings.least_transmittance, frame.background);
        let mut passes = Vec::new();
        let to = &mut Timed { timed, passes: &mut passes };
        self.runner.run(&self.gpu, &scene.cast, &resources, &mut uniform, [0, tiles[1]], to)?;
        Ok(passes)
    }

    fn resources<'a>(&'a self, scene: &'a Scene) -> Resources<'a> {
        let held = scene.transfer.offer(self.samples.resources());
        held.with("blocks", &scene.blocks).with("tallies", &self.tallies)
    }

    /// What a frame takes.
    pub(super) fn working(&self) -> [(&'static str, &wgpu::Buffer); 2] {
        [("states", self.runner.states()), ("tallies", &self.tallies)]
    }

    /// The last frame.
    pub(super) fn picture(&self) -> Option<&wgpu::TextureView> {
        self.target.as_ref().map(|target| &target.picture)
    }

    fn stats(&self, passes: Vec<PassTime>) -> Result<Stats> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let bits: Vec<u32> = self.gpu.read(&scene.blocks, scene.blocks.size())?;
        let shown: u64 = bits.iter().map(|word| u64::from(word.count_ones())).sum();
        // The buffer may be that of a larger picture before.
        let size = self.target.as_ref().ok_or_else(unprepared)?.size;
        let tiles: u64 = size.map(|n| u64::from(n.div_ceil(TILE))).iter().product();
        let tallies: Vec<u32> = self.gpu.read(&self.tallies, tiles * 4)?;
        let size = |(name, buffer): (&str, &wgpu::Buffer)| BufferSize { name: name.to_owned(), bytes: buffer.size() };
        let held: Vec<_> = self.samples.held().into_iter().chain([("blocks", &scene.blocks)]).collect();
        let bytes: u64 = held.iter().map(|(_, buffer)| buffer.size()).sum();
        let per_voxel = bytes as f64 / self.grid.scalar.len() as f64;
        let kind = scene.transfer.describe(self.settings.integral, None);
        Ok(Stats {
            cells: vec![
                ("in the grid".to_owned(), self.grid.tet_count()),
                ("in blocks of voxels that the function can show, at most".to_owned(), shown * 8 * 5),
            ],
            passes,
            buffers: held.into_iter().chain(self.working()).map(size).collect(),
            adapter: self.gpu.describe(),
            pipelines: format!("{kind}; rays pass implied tetrahedra"),
            rays: Some(RayCounts { steps: tallies.iter().map(|&n| u64::from(n)).sum(), repaired: 0, lost: 0 }),
            order: "along each ray: exact".to_owned(),
            inversions: None,
            notes: vec![format!("{per_voxel:.2} B a voxel on the device")],
        })
    }
}

impl Renderer for GridCaster {
    fn render(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Rendered> {
        let passes = self.draw_frame(frame, timed)?;
        let stats = self.stats(if timed { passes } else { Vec::new() })?;
        let image = self.target.as_ref().ok_or_else(unprepared)?.read(&self.gpu)?;
        Ok(Rendered { image, stats })
    }

    fn render_only(&mut self, frame: &Frame<'_>) -> Result<Duration> {
        let start = Instant::now();
        self.draw_frame(frame, false)?;
        Ok(start.elapsed())
    }

    fn set_integral(&mut self, integral: SegmentIntegral) {
        self.settings.integral = integral;
        self.scene = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::Module;

    #[test]
    fn the_shader_has_the_same_constants() {
        let module = Module::new("grid_cast").expect("a pass");
        let value = |name| module.constant(name);
        assert_eq!((value("TILE"), value("STATE_VECTORS") * 16), (TILE, STATE_BYTES as u32));
        assert_eq!(module.naga.entry_points[0].workgroup_size, [TILE, TILE, 1]);
    }
}
