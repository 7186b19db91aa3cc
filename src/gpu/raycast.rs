//! Ray casting on the GPU: one compute pass walks every pixel's ray from cell to cell.

use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use crate::error::Result;
use crate::gpu::device::Gpu;
use crate::gpu::frame;
use crate::gpu::kernel::{Kernel, Resources};
use crate::gpu::layout;
use crate::gpu::light::{self, Shading};
use crate::gpu::linked::LinkedBuffers;
use crate::gpu::lists::{FragmentLists, Listed, Strip};
use crate::gpu::rays;
use crate::gpu::record::{Recorder, Work};
use crate::gpu::renderer::unprepared;
use crate::gpu::runner::{RayRunner, Timed, grow};
use crate::gpu::target::Target;
use crate::gpu::transfer::TransferBuffers;
use crate::plan::entries::BoundaryView;
use crate::plan::eye;
use crate::plan::lens::Lens;
use crate::renderer::{
    BufferSize, CellLayout, Frame, PassTime, RayCounts, Rendered, Renderer, SegmentIntegral, Settings, Stats,
};
use crate::scene::{EmissionModel, Projection};
use crate::tet::{LinkedMesh, TetMesh};

/// Pixels along a tile's side: a workgroup each (`shared/walk.wgsl`).
const TILE: u32 = 8;

/// Of a ray that has not come through (`shared/walk.wgsl`), bytes.
const STATE_BYTES: u64 = 64;

/// Words that count what rays of a tile met (`shared/walk.wgsl`).
const TALLIES: usize = 3;

/// Renders one mesh by ray casting (HARC; Weiler et al. 2003).
pub struct RayCaster {
    gpu: Gpu,
    mesh: Arc<TetMesh>,
    linked: LinkedMesh,
    settings: Settings,
    store: LinkedBuffers,
    /// Across rays, in a mesh unit.
    units: f32,
    runner: RayRunner,
    light: wgpu::Buffer,
    entries: wgpu::Buffer,
    tallies: wgpu::Buffer,
    /// A count, and a bit a pixel: rays that pass two cells at once.
    overlapping: wgpu::Buffer,
    /// Made when such rays were met.
    lists: Option<FragmentLists>,
    list_turns: u32,
    scene: Option<Scene>,
    target: Option<Target>,
}

/// A pass that casts rays.
struct Pass<'a> {
    kernel: &'a Kernel,
    /// Where it counts or lists segments, if it does.
    lists: Option<&'a FragmentLists>,
}

/// What depends on the transfer function and what shaders are specialised to.
struct Scene {
    transfer: TransferBuffers,
    perspective: bool,
    shading: Shading,
    kernels: Arc<CastKernels>,
    /// One bit a cell: not transparent.
    occupied: wgpu::Buffer,
}

/// Kernels, and what they are specialised to.
struct CastKernels {
    constants: Vec<(&'static str, f64)>,
    mark: Kernel,
    raycast: Kernel,
    /// Counts, and lists, the segments of rays that pass two cells at once; made when such were met.
    list: OnceLock<[Kernel; 2]>,
}

/// What a frame found out.
#[derive(Default)]
struct Drawn {
    passes: Vec<PassTime>,
    notes: Vec<String>,
}

impl CastKernels {
    fn list(&self, gpu: &Gpu) -> Result<&[Kernel; 2]> {
        if self.list.get().is_none() {
            let made = |lists: f64| gpu.kernel("raylist", &[&self.constants[..], &[("LISTS", lists)]].concat());
            let _ = self.list.set([made(0.0)?, made(1.0)?]);
        }
        self.list.get().ok_or_else(unprepared)
    }
}

impl RayCaster {
    /// Links the mesh's cells and uploads them.
    ///
    /// # Errors
    /// A mesh beyond the device's limits (with the numbers), a device that refuses.
    pub fn new(gpu: Gpu, mesh: Arc<TetMesh>, settings: Settings) -> Result<Self> {
        let linked = LinkedMesh::new(&mesh);
        let store = LinkedBuffers::new(&gpu, &linked, settings.layout)?;
        gpu.wait()?;
        let units = rays::units_across(linked.longest_edge());
        let light = gpu.uniform("light", &[layout::Light::default()]);
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
        let [entries, tallies, overlapping] = [(); 3].map(|()| gpu.buffer("rays", 0, usage));
        let runner = RayRunner::new(&gpu, TILE, STATE_BYTES);
        let list_turns = FragmentLists::turns(&gpu);
        Ok(Self {
            gpu,
            mesh,
            linked,
            settings,
            store,
            units,
            runner,
            light,
            entries,
            tallies,
            overlapping,
            lists: None,
            list_turns,
            scene: None,
            target: None,
        })
    }

    /// The same, leaving rays and their lists to the next dispatch after so many turns of loops, at least 2: how short
    /// dispatches are tested with small meshes.
    #[must_use]
    pub fn leaving_rays_after(mut self, turns: u32) -> Self {
        // The first turn of a dispatch finds a ray's walk, the second takes it on.
        let turns = turns.max(2);
        self.runner.most_turns = turns;
        self.list_turns = turns;
        self
    }

    /// Another field, time step or place of the vertices, on the same tetrahedra: uploads values, gradients and, where
    /// they differ, places; links nothing anew.
    ///
    /// # Errors
    /// A mesh of other tetrahedra; a lost device.
    pub fn replace(&mut self, mesh: Arc<TetMesh>) -> Result<()> {
        self.linked.replace(&self.mesh, &mesh)?;
        if mesh.vertices != self.mesh.vertices {
            self.store.put_places(&self.gpu, &self.linked);
            self.units = rays::units_across(self.linked.longest_edge());
        }
        self.store.put_field(&self.gpu, &self.linked, &mesh);
        self.mesh = mesh;
        // Functions are normalised to the field's ranges, and what is transparent has changed.
        self.scene = None;
        self.gpu.wait()
    }

    /// The share of cells that the function does not leave transparent.
    ///
    /// # Errors
    /// A lost device.
    pub fn shown(&mut self, frame: &Frame<'_>) -> Result<f64> {
        self.prepare_scene(frame, matches!(frame.camera.projection, Projection::Perspective { .. }))?;
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        Ok(self.occupied_cells(scene)? as f64 / self.linked.cells.len().max(1) as f64)
    }

    fn occupied_cells(&self, scene: &Scene) -> Result<u64> {
        let bits: Vec<u32> = self.gpu.read(&scene.occupied, scene.occupied.size())?;
        Ok(bits.iter().map(|word| u64::from(word.count_ones())).sum())
    }

    /// Makes kernels and marks cells where the transfer function or what kernels are specialised to changed.
    fn prepare_scene(&mut self, frame: &Frame<'_>, perspective: bool) -> Result<()> {
        let (emission, shading) = (frame.optics.emission, Shading::of(frame.optics));
        let same = |s: &Scene| {
            s.transfer.source == *frame.transfer
                && s.transfer.emission == emission
                && (s.perspective, s.shading) == (perspective, shading)
        };
        if self.scene.as_ref().is_some_and(same) {
            return Ok(());
        }
        let (integral, linked) = (self.settings.integral, &self.linked);
        let (scalar, gradient, unit) = (linked.scalar, linked.gradient, self.mesh.data_per_mesh);
        let transfer = TransferBuffers::new(&self.gpu, frame.transfer, integral, emission, scalar, gradient, unit)?;
        if transfer.bivariate {
            self.store.need_gradients(&self.gpu, linked);
        }
        if shading.is_on() {
            self.store.need_gradient_vectors(&self.gpu, linked, &self.mesh);
        }
        let flag = |b: bool| f64::from(u8::from(b));
        let mut constants = transfer.constants.clone();
        constants.extend(self.store.constants());
        constants.extend(shading.constants());
        // What is transparent glows, too, where emission is not weighted by extinction.
        constants.push(("CULL", flag(self.settings.cull && emission == EmissionModel::Weighted)));
        constants.push(("PERSPECTIVE", flag(perspective)));
        constants.push(("MOST_TURNS", self.runner.most_turns.into()));
        constants.extend([("HAIR", eye::HAIR.into()), ("TOUCH", LinkedMesh::TOUCH.into())]);
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let cells = linked.cells.len() as u32;
        let occupied = self.gpu.buffer("occupied", u64::from(cells.div_ceil(256)) * 32, usage);
        let mark = self.gpu.kernel("occupied", &constants)?;
        let raycast = self.gpu.kernel("raycast", &constants)?;
        let kernels = Arc::new(CastKernels { constants, mark, raycast, list: OnceLock::new() });
        let mut recorder = Recorder::new(&self.gpu, false);
        let resources = transfer.offer(self.store.resources()).with("marks", &occupied);
        recorder.compute(&kernels.mark, &kernels.mark.bind(&self.gpu, &resources)?, Work::Items(cells))?;
        recorder.submit();
        self.scene = Some(Scene { transfer, perspective, shading, kernels, occupied });
        Ok(())
    }

    /// Draws a frame; the picture is left in the target. Times of passes where asked.
    fn draw_frame(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Drawn> {
        light::check(frame.optics)?;
        let lens = Lens::new(frame.camera, frame.size, &*self.mesh);
        self.prepare_scene(frame, lens.perspective)?;
        if self.target.as_ref().is_none_or(|t| t.size != frame.size) {
            self.target = Some(Target::new(&self.gpu, frame.size, false)?);
        }
        let start = Instant::now();
        let groups = self.bin(&lens, frame.size)?;
        let work = format!("{} boundary faces", self.linked.boundary.faces.len());
        let mut passes = vec![PassTime { pass: "host: bin".to_owned(), work, time: start.elapsed() }];
        let least = self.settings.least_transmittance;
        let mut uniform = rays::uniform(&lens, frame.size, groups, self.units, least, frame.background);
        let light = light::uniform(frame.optics, &frame.camera.basis());
        self.gpu.queue.write_buffer(&self.light, 0, bytemuck::bytes_of(&light));
        let pixels = u64::from(frame.size[0]) * u64::from(frame.size[1]);
        grow(&self.gpu, &mut self.overlapping, "overlapping", 4 + pixels.div_ceil(32) * 4)?;
        let mut recorder = Recorder::new(&self.gpu, false);
        recorder.encoder().clear_buffer(&self.overlapping, 0, None);
        recorder.submit();
        let rows = frame.size[1].div_ceil(TILE);
        self.runner.need_states(&self.gpu, frame.size)?;
        let kernels = Arc::clone(&self.scene.as_ref().ok_or_else(unprepared)?.kernels);
        self.cast(
            &Pass { kernel: &kernels.raycast, lists: None },
            &mut uniform,
            [0, rows],
            &mut Timed { timed, passes: &mut passes },
        )?;
        let overlapping: Vec<u32> = self.gpu.read(&self.overlapping, 4)?;
        let overlapping = overlapping.first().copied().unwrap_or_default();
        let mut notes = Vec::new();
        if overlapping > 0 && FragmentLists::can_count(&self.gpu, frame.size) {
            let to = &mut Timed { timed, passes: &mut passes };
            let strips = self.cast_lists(&kernels, &mut uniform, frame, to)?;
            let (segments, strips) = (strips.iter().map(|s| s.listed).sum::<u64>(), strips.len());
            notes.push(format!(
                "{overlapping} rays pass two cells at once: room for {segments} segments of them was made, in {strips} \
                 strips, and they were composed by their depths"
            ));
        } else if overlapping > 0 {
            notes.push(format!(
                "{overlapping} rays pass two cells at once, and these are composed one behind the other: the picture is \
                 too large for lists on '{}'; render a smaller one, or with --device cpu",
                self.gpu.info.name
            ));
        }
        Ok(Drawn { passes, notes })
    }

    /// Casts the rays that pass two cells at once again, lists their segments, and composes these by their depths.
    /// Returns the strips.
    fn cast_lists(
        &mut self,
        kernels: &CastKernels,
        uniform: &mut layout::Rays,
        frame: &Frame<'_>,
        to: &mut Timed<'_>,
    ) -> Result<Vec<Strip>> {
        let [count, list] = kernels.list(&self.gpu)?;
        let mut lists = match self.lists.take() {
            Some(lists) => lists,
            None => FragmentLists::new(&self.gpu, self.list_turns, Listed::Rays)?,
        };
        lists.need_size(&self.gpu, frame.size)?;
        let (gpu, target) = (&self.gpu, self.target.as_ref().ok_or_else(unprepared)?);
        let camera = gpu.uniform("frame", &[frame::camera_uniform(frame, &*self.mesh)]);
        let resources = Resources::default().with("frame", &camera).with_texture("picture", &target.picture);
        let mut recorder = Recorder::new(gpu, to.timed);
        lists.clear(&mut recorder);
        recorder.submit();
        let rows = frame.size[1].div_ceil(TILE);
        self.cast(&Pass { kernel: count, lists: Some(&lists) }, uniform, [0, rows], to)?;
        let groups = lists.rows.bind(gpu, &lists.offer(resources.clone()))?;
        recorder.compute(&lists.rows, &groups, Work::Groups(frame.size[1]))?;
        recorder.submit();
        let strips = lists.plan(gpu)?;
        recorder.encoder().clear_buffer(&lists.fragments, 0, None);
        recorder.submit();
        for &strip in &strips {
            gpu.queue.write_buffer(&lists.strip, 0, bytemuck::bytes_of(&strip.uniform()));
            let [top, height] = strip.rows(frame.size[0]);
            let rows = [top / TILE, (top + height).div_ceil(TILE)];
            self.cast(&Pass { kernel: list, lists: Some(&lists) }, uniform, rows, to)?;
            lists.compose(gpu, &mut recorder, &lists.offer(resources.clone()), strip)?;
        }
        lists.check(gpu)?;
        to.passes.extend(recorder.finish()?);
        self.lists = Some(lists);
        Ok(strips)
    }

    /// Runs a pass over rows of tiles.
    fn cast(&self, pass: &Pass<'_>, uniform: &mut layout::Rays, rows: [u32; 2], to: &mut Timed<'_>) -> Result<()> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let resources = self.resources(scene).with_texture("picture", &target.picture);
        let resources = pass.lists.iter().fold(resources, |resources, lists| lists.offer(resources));
        self.runner.run(&self.gpu, pass.kernel, &resources, uniform, rows, to)
    }

    /// Sorts the boundary into the picture's tiles. How many groups of linked cells hold the eye.
    fn bin(&mut self, lens: &Lens, size: [u32; 2]) -> Result<u32> {
        let around = eye::sides_around(&self.linked, lens);
        let view = BoundaryView::new(&self.linked.boundary, lens, size, TILE, &around);
        let groups = eye::groups(&self.linked, &around);
        let (starts, sides) = view.packed_tiles();
        let first = (groups.len() + 1 + starts.len()) as u32;
        let mut entries = vec![first];
        for group in &groups {
            entries.push(entries[entries.len() - 1] + group.len() as u32);
        }
        let first = first + around.len() as u32;
        entries.extend(starts.iter().map(|start| first + start));
        entries.extend(groups.iter().flatten().map(|side| side.packed()));
        entries.extend(sides);
        let tallies = vec![0_u32; TALLIES * view.tile_count() as usize];
        for (buffer, label, words) in
            [(&mut self.entries, "entries", &entries), (&mut self.tallies, "tallies", &tallies)]
        {
            grow(&self.gpu, buffer, label, size_of_val(&words[..]) as u64)?;
            self.gpu.write(buffer, 0, bytemuck::cast_slice(words));
        }
        Ok(groups.len() as u32)
    }

    fn resources<'a>(&'a self, scene: &'a Scene) -> Resources<'a> {
        scene
            .transfer
            .offer(self.store.resources())
            .with("overlapping", &self.overlapping)
            .with("light", &self.light)
            .with("entries", &self.entries)
            .with("tallies", &self.tallies)
            .with("occupied", &scene.occupied)
    }

    fn stats(&self, Drawn { passes, notes }: Drawn) -> Result<Stats> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let cells = self.linked.cells.len() as u64;
        let visible = self.occupied_cells(scene)?;
        // The buffer may be that of a larger picture before.
        let size = self.target.as_ref().ok_or_else(unprepared)?.size;
        let tiles: u64 = size.map(|n| u64::from(n.div_ceil(TILE))).iter().product();
        let tallies: Vec<u32> = self.gpu.read(&self.tallies, tiles * TALLIES as u64 * 4)?;
        let total = |of: usize| tallies.iter().skip(of).step_by(TALLIES).map(|&n| u64::from(n)).sum();
        let size = |(name, buffer): (&str, &wgpu::Buffer)| BufferSize { name: name.to_owned(), bytes: buffer.size() };
        let frame = [
            ("occupied", &scene.occupied),
            ("entries", &self.entries),
            ("tallies", &self.tallies),
            ("states", self.runner.states()),
            ("overlapping", &self.overlapping),
        ];
        let lists = self.lists.iter().flat_map(FragmentLists::sizes);
        let kind = scene.transfer.describe(self.settings.integral, None);
        let layout = if self.store.layout == CellLayout::Fast { "fast" } else { "compact" };
        Ok(Stats {
            cells: vec![("in the mesh".to_owned(), cells), ("that the function can show".to_owned(), visible)],
            passes,
            buffers: self.store.list().into_iter().chain(frame).map(size).chain(lists).collect(),
            adapter: self.gpu.describe(),
            pipelines: format!("{kind}; cells are held in the {layout} layout"),
            rays: Some(RayCounts { steps: total(0), repaired: total(1), lost: total(2) }),
            order: "along each ray: exact".to_owned(),
            inversions: None,
            notes,
        })
    }
}

impl Renderer for RayCaster {
    fn render(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Rendered> {
        let mut drawn = self.draw_frame(frame, timed)?;
        if !timed {
            drawn.passes.clear();
        }
        let stats = self.stats(drawn)?;
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
        let module = Module::new("raycast").expect("a pass");
        let value = |name| module.constant(name);
        assert_eq!((value("TILE"), value("NO_LINK")), (TILE, LinkedMesh::NO_LINK));
        assert_eq!((value("STATE_VECTORS") * 16, value("TALLIES")), (STATE_BYTES as u32, TALLIES as u32));
        assert_eq!(module.naga.entry_points[0].workgroup_size, [TILE, TILE, 1]);
    }
}
