//! Ray casting on the GPU: one compute pass walks every pixel's ray from cell to cell.

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::error::{Error, Result};
use crate::gpu::device::{Gpu, Kernel, Resources};
use crate::gpu::layout;
use crate::gpu::light::{self, Shading};
use crate::gpu::linked::LinkedBuffers;
use crate::gpu::rays;
use crate::gpu::record::{Recorder, Work};
use crate::gpu::target::Target;
use crate::gpu::transfer::TransferBuffers;
use crate::plan::entries::BoundaryView;
use crate::plan::eye;
use crate::plan::lens::Lens;
use crate::renderer::{BufferSize, CellLayout, Frame, PassTime, Rendered, Renderer, Settings, Stats};
use crate::scene::EmissionModel;
use crate::tet::{LinkedMesh, TetMesh};

/// Pixels along a tile's side: a workgroup each (`raycast.wgsl`).
const TILE: u32 = 8;

/// Renders one mesh by ray casting (HARC; Weiler et al. 2003).
pub struct RayCaster {
    gpu: Gpu,
    mesh: Arc<TetMesh>,
    linked: LinkedMesh,
    settings: Settings,
    store: LinkedBuffers,
    rays: wgpu::Buffer,
    light: wgpu::Buffer,
    entries: wgpu::Buffer,
    tallies: wgpu::Buffer,
    scene: Option<Scene>,
    target: Option<Target>,
}

/// What depends on the transfer function and what shaders are specialised to.
struct Scene {
    transfer: TransferBuffers,
    perspective: bool,
    shading: Shading,
    raycast: Kernel,
    /// One bit a cell: not transparent.
    occupied: wgpu::Buffer,
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
        let rays = gpu.uniform("rays", &[layout::Rays::default()]);
        let light = gpu.uniform("light", &[layout::Light::default()]);
        let empty = || gpu.buffer("empty", 0, wgpu::BufferUsages::STORAGE);
        let (entries, tallies) = (empty(), empty());
        Ok(Self { gpu, mesh, linked, settings, store, rays, light, entries, tallies, scene: None, target: None })
    }

    /// Another field, time step or place of the vertices, on the same tetrahedra: uploads values, gradients and, where
    /// they differ, places; links nothing anew.
    ///
    /// # Errors
    /// A mesh of other tetrahedra; a lost device.
    pub fn replace(&mut self, mesh: Arc<TetMesh>) -> Result<()> {
        if mesh.tets != self.mesh.tets {
            return Err(Error::Asked(
                "the mesh has other tetrahedra than the one that was uploaded: make a new renderer".into(),
            ));
        }
        self.linked.take_places(&mesh);
        if mesh.vertices != self.mesh.vertices {
            self.store.put_places(&self.gpu, &self.linked);
        }
        self.store.put_field(&self.gpu, &self.linked, &mesh);
        self.mesh = mesh;
        // Functions are normalised to the field's ranges, and what is transparent has changed.
        self.scene = None;
        self.gpu.wait()
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
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let cells = linked.cells.len() as u32;
        let occupied = self.gpu.buffer("occupied", u64::from(cells.div_ceil(256)) * 32, usage);
        let mark = self.gpu.kernel("occupied", &constants)?;
        let raycast = self.gpu.kernel("raycast", &constants)?;
        let mut recorder = Recorder::new(&self.gpu, false);
        let resources = transfer.offer(self.store.resources()).with("marks", &occupied);
        recorder.compute(&mark, &mark.bind(&self.gpu, &resources)?, Work::Items(cells))?;
        recorder.submit();
        self.scene = Some(Scene { transfer, perspective, shading, raycast, occupied });
        Ok(())
    }

    /// Draws a frame; the picture is left in the target. Times of passes where asked.
    fn draw_frame(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Vec<PassTime>> {
        light::check(frame.optics)?;
        let lens = Lens::new(frame.camera, frame.size, &self.mesh);
        self.prepare_scene(frame, lens.perspective)?;
        if self.target.as_ref().is_none_or(|t| t.size != frame.size) {
            self.target = Some(Target::new(&self.gpu, frame.size, false)?);
        }
        let mut recorder = Recorder::new(&self.gpu, timed);
        let around = recorder.host("bin", || -> Result<u32> {
            let around = eye::sides_around(&self.linked, &lens);
            let view = BoundaryView::new(&self.linked.boundary, &lens, frame.size, TILE);
            let mut entries: Vec<u32> = around.iter().map(|side| side.packed()).collect();
            let (starts, sides) = view.packed_tiles();
            let first = (around.len() + starts.len()) as u32;
            entries.extend(starts.iter().map(|start| first + start));
            entries.extend(sides);
            put(&self.gpu, &mut self.entries, "entries", &entries)?;
            put(&self.gpu, &mut self.tallies, "tallies", &vec![0_u32; 2 * view.tile_count() as usize])?;
            Ok(around.len() as u32)
        })?;
        let least = self.settings.least_transmittance;
        let uniform = rays::uniform(&lens, frame.size, around, least, frame.background);
        self.gpu.queue.write_buffer(&self.rays, 0, bytemuck::bytes_of(&uniform));
        let light = light::uniform(frame.optics, &frame.camera.basis());
        self.gpu.queue.write_buffer(&self.light, 0, bytemuck::bytes_of(&light));
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let resources = self.resources(scene).with_texture("picture", &target.picture);
        let groups = scene.raycast.bind(&self.gpu, &resources)?;
        recorder.compute(&scene.raycast, &groups, Work::Tiles(frame.size.map(|n| n.div_ceil(TILE))))?;
        recorder.finish()
    }

    fn resources<'a>(&'a self, scene: &'a Scene) -> Resources<'a> {
        scene
            .transfer
            .offer(self.store.resources())
            .with("rays", &self.rays)
            .with("light", &self.light)
            .with("entries", &self.entries)
            .with("tallies", &self.tallies)
            .with("occupied", &scene.occupied)
    }

    fn stats(&self, passes: Vec<PassTime>) -> Result<Stats> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let cells = self.linked.cells.len() as u64;
        let bits: Vec<u32> = self.gpu.read(&scene.occupied, scene.occupied.size())?;
        let visible = bits.iter().map(|word| u64::from(word.count_ones())).sum();
        let tallies: Vec<u32> = self.gpu.read(&self.tallies, self.tallies.size())?;
        let total = |of: usize| tallies.iter().skip(of).step_by(2).map(|&n| u64::from(n)).sum::<u64>();
        let (steps, lost) = (total(0), total(1));
        let mut notes = vec![format!("{steps} cells were entered by rays")];
        if lost > 0 {
            notes.push(crate::renderer::lost_rays(lost));
        }
        let size = |(name, buffer): (&str, &wgpu::Buffer)| BufferSize { name: name.to_owned(), bytes: buffer.size() };
        let frame = [("occupied", &scene.occupied), ("entries", &self.entries), ("tallies", &self.tallies)];
        let kind = scene.transfer.describe(self.settings.integral, None);
        let layout = if self.store.layout == CellLayout::Fast { "fast" } else { "compact" };
        Ok(Stats {
            cells: vec![("in the mesh".to_owned(), cells), ("that the function can show".to_owned(), visible)],
            passes,
            buffers: self.store.list().into_iter().chain(frame).map(size).collect(),
            adapter: self.gpu.describe(),
            pipelines: format!("{kind}; cells are held in the {layout} layout"),
            notes,
        })
    }
}

impl Renderer for RayCaster {
    fn render(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Rendered> {
        let passes = self.draw_frame(frame, timed)?;
        let stats = self.stats(passes)?;
        let image = self.target.as_ref().ok_or_else(unprepared)?.read(&self.gpu)?;
        Ok(Rendered { image, stats })
    }

    fn render_only(&mut self, frame: &Frame<'_>) -> Result<Duration> {
        let start = Instant::now();
        self.draw_frame(frame, false)?;
        Ok(start.elapsed())
    }

    fn mesh(&self) -> &TetMesh {
        &self.mesh
    }
}

/// Writes words to a buffer, which is made anew where it is too small.
fn put(gpu: &Gpu, buffer: &mut wgpu::Buffer, label: &str, words: &[u32]) -> Result<()> {
    let bytes = size_of_val(words) as u64;
    if bytes > gpu.max_binding {
        return Err(Error::Device(format!(
            "the boundary in this picture's tiles takes {} MiB, and '{}' binds {} MiB: render a smaller picture, or with \
             --device cpu",
            bytes >> 20,
            gpu.info.name,
            gpu.max_binding >> 20
        )));
    }
    if buffer.size() < bytes {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
        *buffer = gpu.buffer(label, bytes + bytes / 4, usage);
    }
    gpu.write(buffer, 0, bytemuck::cast_slice(words));
    Ok(())
}

fn unprepared() -> Error {
    Error::Device("internal: a frame was drawn before it was prepared".to_owned())
}
