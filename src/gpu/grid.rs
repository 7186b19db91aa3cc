//! Projected tetrahedra of a structured grid, none of which is held (Maximo et al. 2007): voxels are drawn in the order
//! in which they lie around the eye, a batch of bricks at a time.

mod cast;
mod draw;
mod levels;
mod samples;
mod scene;
mod store;

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DMat3;

pub use self::cast::GridCaster;
use self::samples::GridSamples;
use self::scene::GridScene;
use self::store::GridStore;
use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::layout;
use crate::gpu::light::Shading;
use crate::gpu::renderer::unprepared;
use crate::gpu::sort;
use crate::gpu::store::{DEEP_SPAN, SPAN_BITS};
use crate::gpu::target::Target;
use crate::gpu::transfer::TransferBuffers;
use crate::plan::voxels::{self, BRICK, Near};
use crate::renderer::{
    BlendFormat, BufferSize, Frame, Method, PassTime, Rendered, Renderer, SegmentIntegral, Settings, Stats,
};
use crate::scene::{Optics, Projection};
use crate::space::Bounds;
use crate::tet::{Domain as _, Grid, VoxelBox};

/// Renders one grid by projection, without a list of its tetrahedra and without sorting.
pub struct GridRenderer {
    gpu: Gpu,
    grid: Arc<Grid>,
    settings: Settings,
    /// The voxels that are drawn.
    part: VoxelBox,
    store: GridStore,
    scene: Option<GridScene>,
    target: Option<Target>,
    /// The batches' frames.
    frames: Vec<wgpu::Buffer>,
    /// What draws the voxels around the eye, which the near plane may cut.
    near: Option<GridCaster>,
    last_batch: Option<LastBatch>,
}

/// The last bricks that were drawn, for [`GridRenderer::order`].
struct LastBatch {
    bricks: Vec<u32>,
    nearest: [usize; 3],
}

impl GridRenderer {
    /// Uploads the grid.
    ///
    /// # Errors
    /// A grid beyond the device's limits (with the numbers); what this renderer does not do.
    pub fn new(gpu: Gpu, grid: Arc<Grid>, settings: Settings) -> Result<Self> {
        if !matches!(settings.method, Method::Auto | Method::Project) {
            return Err(Error::Asked(
                "a structured order is one of projected cells, or of rays: render with --method project or raycast, or \
                 with another --order"
                    .into(),
            ));
        }
        if settings.blend == BlendFormat::F16 {
            let text = "a structured order is blended in f32 alone: render with --blend f32, or with --method raycast";
            return Err(Error::Asked(text.into()));
        }
        if !gpu.blends_f32() {
            return Err(Error::Asked(format!(
                "a structured order is blended in f32, which '{}' cannot: render with --method raycast",
                gpu.info.name
            )));
        }
        let store = GridStore::new(&gpu, &grid)?;
        let part = grid.all();
        Ok(Self {
            gpu,
            grid,
            settings,
            part,
            store,
            scene: None,
            target: None,
            frames: Vec::new(),
            near: None,
            last_batch: None,
        })
    }

    /// The same of the voxels that reach into a box alone, which is in data space and parallel to the axes.
    ///
    /// # Errors
    /// [`Error::Asked`] for a box that holds none.
    pub fn clipped_to(mut self, bounds: &Bounds) -> Result<Self> {
        self.part = clipped_part(&self.grid, bounds)?;
        self.scene = None;
        Ok(self)
    }

    /// The tetrahedra of the last frame's last batch, 1,024 bricks of 8 x 8 x 8 voxels at most, as they were drawn:
    /// back to front, numbered as those of the mesh that five a voxel make.
    ///
    /// # Errors
    /// A lost device.
    pub fn order(&self) -> Result<Vec<u32>> {
        let (Some(scene), Some(batch)) = (&self.scene, &self.last_batch) else { return Ok(Vec::new()) };
        let listed = u64::from(sort::survivors(&self.gpu, &self.store.counts)?);
        let mut entries: Vec<u32> = self.gpu.read(self.store.order(), listed * 4)?;
        if scene.spans.is_some() {
            // A cell is where its first span is.
            entries.retain(|span| span % DEEP_SPAN == 0);
            entries.iter_mut().for_each(|span| *span >>= SPAN_BITS);
        }
        let voxels = self.grid.voxels();
        let tet = |entry: u32| {
            let (slot, k) = (entry as usize / 8, entry % 8);
            let first = scene::unpacked(batch.bricks[slot / 512]).map(|brick| brick * BRICK);
            let turns = [slot % 8, slot / 8 % 8, slot / 64 % 8];
            let at: [usize; 3] = std::array::from_fn(|axis| {
                let nearest = batch.nearest[axis].clamp(first[axis], first[axis] + BRICK - 1) - first[axis];
                // It is its own inverse.
                first[axis] + voxels::turn(nearest, BRICK, turns[axis])
            });
            (5 * (at[0] + voxels[0] * (at[1] + voxels[1] * at[2]))) as u32 + k
        };
        Ok(entries.into_iter().map(tet).collect())
    }

    fn prepare_scene(&mut self, frame: &Frame<'_>) -> Result<()> {
        let perspective = matches!(frame.camera.projection, Projection::Perspective { .. });
        let emission = frame.optics.emission;
        let same = |s: &GridScene| {
            s.transfer.source == *frame.transfer && s.transfer.emission == emission && s.perspective == perspective
        };
        if self.scene.as_ref().is_some_and(same) {
            return Ok(());
        }
        let transfer = TransferBuffers::new(
            &self.gpu,
            frame.transfer,
            self.settings.integral,
            emission,
            self.store.samples.scalar,
            self.store.samples.gradient,
            self.grid.data_per_mesh,
        )?;
        if transfer.bivariate {
            self.store.samples.need_gradients(&self.gpu, &self.grid)?;
        }
        // It holds the samples that were needed before.
        self.near = None;
        write_grid(&self.gpu, &self.store.samples, &self.grid, &self.part, [0; 3], None);
        self.scene = Some(GridScene::new(&self.gpu, &self.store, transfer, perspective, self.settings)?);
        Ok(())
    }

    /// Draws the voxels around the eye, if there are any. Returns the passes' times.
    fn draw_near(&mut self, frame: &Frame<'_>, voxels: &VoxelBox, timed: bool) -> Result<Vec<PassTime>> {
        if voxels.count() == 0 {
            return Ok(Vec::new());
        }
        let make = || GridCaster::of(&self.gpu, &self.grid, self.store.samples.shared(&self.gpu), self.settings);
        let caster = self.near.get_or_insert_with(make);
        caster.part = *voxels;
        caster.draw_frame(&Frame { background: [0.0; 4], ..*frame }, timed)
    }

    /// Cells after each stage of the last frame.
    fn cell_counts(&self, near: &VoxelBox) -> Result<Vec<(String, u64)>> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let drawn: Vec<u32> = self.gpu.read(&self.store.drawn_cells, 4)?;
        let mut counts = vec![
            ("in the grid".to_owned(), self.grid.tet_count()),
            ("that the function can show".to_owned(), scene.shown.iter().map(|b| u64::from(b.cells)).sum()),
            ("drawn".to_owned(), u64::from(drawn[0])),
        ];
        if near.count() > 0 {
            counts.push(("around the eye, for rays".to_owned(), 5 * near.count() as u64));
        }
        Ok(counts)
    }

    /// What the device holds a sample, and besides.
    fn memory_note(&self) -> String {
        let bytes = |list: &[(&str, &wgpu::Buffer)]| list.iter().map(|(_, b)| b.size()).sum::<u64>();
        let per_voxel = bytes(&self.store.held()) as f64 / self.grid.scalar.len() as f64;
        let working = bytes(&self.store.working()) >> 20;
        format!("{per_voxel:.2} B a voxel on the device, and {working} MiB for what is drawn at a time")
    }
}

impl Renderer for GridRenderer {
    fn render(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Rendered> {
        let (passes, near) = self.draw_frame(frame, timed)?;
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let size = |(name, buffer): (&str, &wgpu::Buffer)| BufferSize { name: name.to_owned(), bytes: buffer.size() };
        let of_rays = self.near.iter().flat_map(GridCaster::working);
        let kind = scene.transfer.describe(self.settings.integral, scene.spans.map(|s| s.paired));
        let mut notes = vec![self.memory_note()];
        if near.count() > 0 {
            notes.push(format!(
                "rays were cast through the {} voxels around the eye, which the near plane may cut",
                near.count()
            ));
        }
        let stats = Stats {
            passes,
            notes,
            cells: self.cell_counts(&near)?,
            buffers: self.store.held().into_iter().chain(self.store.working()).chain(of_rays).map(size).collect(),
            adapter: self.gpu.describe(),
            pipelines: format!("{kind}; outlines are drawn, of implied tetrahedra"),
            order: "structured: exact, as voxels lie around the eye".to_owned(),
            inversions: None,
            rays: None,
        };
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

/// The voxels that reach into a box of data space.
fn clipped_part(grid: &Grid, bounds: &Bounds) -> Result<VoxelBox> {
    if grid.turn != DMat3::IDENTITY {
        return Err(Error::Asked(
            "a clipping box is parallel to the axes, and this grid is turned: leave out --clip".into(),
        ));
    }
    let in_mesh = Bounds { min: grid.mesh_from_data(bounds.min), max: grid.mesh_from_data(bounds.max) };
    let part = grid.voxels_in(&in_mesh);
    if part.count() > 0 {
        return Ok(part);
    }
    let all = grid.bounds_in_data();
    Err(Error::Asked(format!(
        "the clipping box from {} to {} holds nothing of the grid, which reaches from {} to {}",
        bounds.min, bounds.max, all.min, all.max
    )))
}

/// What all passes of a frame see of a grid, of which `part` is drawn.
fn write_grid(
    gpu: &Gpu,
    samples: &GridSamples,
    grid: &Grid,
    part: &VoxelBox,
    nearest: [usize; 3],
    near: Option<&Near>,
) {
    let narrow = |v: [usize; 3]| v.map(|n| n as u32);
    let sides = voxels::longest_voxel(grid);
    let around = near.map_or(VoxelBox { low: [0; 3], high: [0; 3] }, |near| near.voxels);
    // Edges are sides, or diagonals of faces.
    let longest_edge = (sides.length_squared() - sides.min_element().powi(2)).sqrt();
    let uniform = layout::Grid {
        points: narrow(grid.points),
        least_depth: near.map_or(0.0, |near| near.least_depth.max(-1e30) as f32),
        nearest: narrow(nearest),
        // A hair more: rounding must not cull.
        longest_edge: (longest_edge * (1.0 + 1e-6)) as f32,
        low: narrow(part.low),
        high: narrow(part.high),
        near_low: narrow(around.low),
        near_high: narrow(around.high),
        ..Default::default()
    };
    gpu.queue.write_buffer(&samples.grid, 0, bytemuck::bytes_of(&uniform));
}

/// What cannot be drawn.
fn check(optics: &Optics) -> Result<()> {
    if Shading::of(optics).is_on() {
        return Err(Error::Asked(
            "lighting and silhouettes need gradient vectors, which a structured order does not have: render with \
             --order centroid or per-pixel"
                .into(),
        ));
    }
    Ok(())
}
