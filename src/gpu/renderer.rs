//! Projected cells on the GPU: the passes of a frame, in order.

mod blend;
mod list;

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::error::{Error, Result};
use crate::gpu::cover::Cover;
use crate::gpu::device::Gpu;
use crate::gpu::frame;
use crate::gpu::kernel::{Kernel, Resources};
use crate::gpu::layout;
use crate::gpu::light::{self, Shading};
use crate::gpu::lists::{FragmentLists, Listed};
use crate::gpu::mesh::TetRange;
use crate::gpu::ordering::{Keys, Ordering};
use crate::gpu::record::{Recorder, Work};
use crate::gpu::scene::{self, SceneKernels, Spans, Variant};
use crate::gpu::slabs::{MOST_LAYERS, Slabs};
use crate::gpu::sort;
use crate::gpu::store::{DEEP_SPAN, Pieces, SPAN_BITS, Store};
use crate::gpu::target::Target;
use crate::gpu::transfer::TransferBuffers;
use crate::plan::near::{self, NearCut};
use crate::renderer::{
    BlendFormat, BufferSize, Frame, Method, OrderChoice, OrderMethod, Rendered, Renderer, SegmentIntegral, Settings,
    SortPlace, Stats,
};
use crate::scene::{EmissionModel, Projection, TransferFunction};
use crate::tet::TetMesh;

/// Nothing in front of what lies behind.
pub const EMPTY: wgpu::LoadOp<wgpu::Color> = wgpu::LoadOp::Clear(wgpu::Color { r: 0.0, g: 0.0, b: 0.0, a: 1.0 });
pub const ZERO: wgpu::LoadOp<wgpu::Color> = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);

/// Pairs of bands are drawn instead of bands where there are so many times as many of these: fewer spans, each of which
/// costs more a fragment. On lavapipe as many bands as pairs (a linear function) took 0.95 times as long a frame, 1.4 times
/// as many (584,000 cells) 1.3 times.
pub const PAIRS_PAY: f64 = 1.1;

/// Cells of one draw on a software adapter: lavapipe bins a draw's triangles, at 300 bytes each, before it shades them,
/// and these fit the caches. 16,384 took 1.25 times as long a frame (584,000 cells), 1,024 as long for its passes.
const SOFTWARE_DRAW: u32 = 3072;

/// Renders one mesh by projection (Shirley & Tuchman 1990; Weiler et al. 2003) in compute and raster passes.
pub struct GpuRenderer {
    gpu: Gpu,
    mesh: Arc<TetMesh>,
    settings: Settings,
    cover: Cover,
    f16: bool,
    store: Store,
    frame: wgpu::Buffer,
    light: wgpu::Buffer,
    scene: Option<SceneKernels>,
    target: Option<Target>,
    slabs: Slabs,
    ordering: Ordering,
    lists: Option<FragmentLists>,
    most_turns: u32,
}

/// What a frame found out.
#[derive(Default)]
struct Drawn {
    stats: Stats,
    pieces: Option<Pieces>,
}

impl GpuRenderer {
    /// Uploads the mesh.
    ///
    /// # Errors
    /// A mesh beyond the device's limits (with the numbers), a device that refuses or cannot blend as asked.
    pub fn new(gpu: Gpu, mesh: Arc<TetMesh>, settings: Settings) -> Result<Self> {
        if settings.method == Method::RayCast {
            return Err(Error::Asked("this renderer projects cells: make a RayCaster to cast rays".into()));
        }
        if settings.order == OrderMethod::Structured {
            return Err(Error::Asked("a structured order is a grid's: make a GridRenderer".into()));
        }
        let f16 = match settings.blend {
            BlendFormat::Auto => !gpu.blends_f32(),
            BlendFormat::F16 => true,
            BlendFormat::F32 if gpu.blends_f32() => false,
            BlendFormat::F32 => {
                let name = &gpu.info.name;
                return Err(Error::Device(format!("'{name}' cannot blend f32; render with --blend f16 or auto")));
            }
        };
        let cover = Cover::of(settings.method);
        let store = Store::new(&gpu, &mesh, cover, sorts_on_host(&gpu, settings), 0, 0)?;
        let frame = gpu.uniform("frame", &[layout::Frame::default()]);
        let light = gpu.uniform("light", &[layout::Light::default()]);
        let most_turns = FragmentLists::turns(&gpu);
        Ok(Self {
            gpu,
            mesh,
            settings,
            cover,
            f16,
            store,
            frame,
            light,
            scene: None,
            target: None,
            slabs: Slabs::default(),
            ordering: Ordering::default(),
            lists: None,
            most_turns,
        })
    }

    /// The same, leaving a pixel's list to the next dispatch after so many turns of loops, at least 1: how short
    /// dispatches are tested with short lists.
    #[must_use]
    pub fn leaving_lists_after(mut self, turns: u32) -> Self {
        self.most_turns = turns.max(1);
        self
    }

    /// The cells of the last frame, as they were drawn: back to front, unless their fragments were listed. Pieces of
    /// cells that the near plane cut are numbered from the mesh's end, up to a multiple of 16,384.
    ///
    /// # Errors
    /// A lost device.
    pub fn order(&self) -> Result<Vec<u32>> {
        let cells = &self.store.cells;
        let survivors = u64::from(sort::survivors(&self.gpu, &cells.counts)?);
        let mut order: Vec<u32> = self.gpu.read(&cells.order, survivors * 4)?;
        if self.scene.as_ref().is_some_and(|s| s.spans.is_some()) {
            // A cell is where its first span is.
            order.retain(|span| span % DEEP_SPAN == 0);
            order.iter_mut().for_each(|span| *span >>= SPAN_BITS);
        }
        Ok(order)
    }

    /// Makes kernels and marks candidates where the transfer function or what kernels are specialised to changed.
    fn prepare_scene(&mut self, transfer: &TransferFunction, emission: EmissionModel, variant: Variant) -> Result<()> {
        let same = |s: &SceneKernels| {
            s.transfer.source == *transfer && s.transfer.emission == emission && s.variant == variant
        };
        if self.scene.as_ref().is_some_and(same) {
            return Ok(());
        }
        self.make_scene(transfer, emission, variant, true)
    }

    /// `in_spans`: draw cells span by span where that is possible.
    fn make_scene(
        &mut self,
        transfer: &TransferFunction,
        emission: EmissionModel,
        variant: Variant,
        in_spans: bool,
    ) -> Result<()> {
        let m = &self.store.mesh;
        let transfer = TransferBuffers::new(
            &self.gpu,
            transfer,
            self.settings.integral,
            emission,
            m.scalar,
            m.gradient,
            self.mesh.data_per_mesh,
        )?;
        if transfer.bivariate {
            self.store.need_gradients(&self.gpu, &self.mesh);
        }
        if variant.shading.is_on() {
            self.store.need_gradient_vectors(&self.gpu, &self.mesh);
        }
        let curve = matches!(transfer.source, TransferFunction::Curve(_));
        if curve {
            self.store.need_bands(&self.gpu);
        }
        let mut extra = self.store.constants().to_vec();
        // What is transparent glows, too, where emission is not weighted by extinction.
        let cull = self.settings.cull && emission == EmissionModel::Weighted;
        extra.push(("CULL", f64::from(u8::from(cull))));
        let candidates = scene::candidates(&self.gpu, &transfer, &extra)?;
        self.mark_candidates(&candidates, &transfer, None)?;
        let mut spans = None;
        // Spans are drawn by the exact integral.
        let exact = matches!(self.settings.integral, SegmentIntegral::Analytic | SegmentIntegral::Adaptive { .. });
        let in_spans = in_spans && emission == EmissionModel::Weighted && !variant.lists;
        if curve && in_spans && exact && variant.shading.allows_spans() {
            let totals = self.band_totals()?;
            let pays = f64::from(totals.bands) > PAIRS_PAY * f64::from(totals.pairs);
            let fits = |spans: &Spans| self.store.holds_spans(spans.count.into(), spans.most);
            spans = [pays, true].map(|paired| Spans::of(totals, paired)).into_iter().find(fits);
        }
        self.scene = Some(SceneKernels::new(&self.gpu, transfer, variant, self.f16, candidates, spans, &extra)?);
        Ok(())
    }

    /// Bands found by the last marking.
    fn band_totals(&self) -> Result<layout::BandTotals> {
        let totals = self.gpu.read(&self.store.cells.band_totals, size_of::<layout::BandTotals>() as u64)?;
        Ok(totals.first().copied().unwrap_or_default())
    }

    /// Marks the cells that the transfer function can make visible: of the mesh, or of the near plane's pieces.
    fn mark_candidates(&self, kernel: &Kernel, transfer: &TransferBuffers, pieces: Option<Pieces>) -> Result<()> {
        let all = self.resources(transfer);
        let mut recorder = Recorder::new(&self.gpu, false);
        recorder.encoder().clear_buffer(&self.store.cells.band_totals, 0, None);
        let ranges = self.store.range_resources(&all, pieces);
        let skipped = if pieces.is_some() { self.store.ranges.len() } else { 0 };
        for (range, part) in &ranges[skipped..] {
            recorder.compute(kernel, &kernel.bind(&self.gpu, part)?, Work::Items(range.count))?;
        }
        recorder.submit();
        Ok(())
    }

    /// Puts the near plane's pieces on the device, with more room where there is too little.
    fn prepare_near_cut(&mut self, cut: &NearCut) -> Result<Pieces> {
        if !self.store.has_room_for(cut) {
            let room = |n: usize| (n as u64 * 3 / 2).max(4096);
            let (vertices, tets) = (room(cut.vertices.len()), room(cut.tets.len()));
            let on_host = sorts_on_host(&self.gpu, self.settings);
            self.store = Store::new(&self.gpu, &self.mesh, self.cover, on_host, vertices, tets)?;
            // Candidates, and the constants that say how tetrahedra are bound, are of the old buffers.
            let scene = self.scene.take().ok_or_else(unprepared)?;
            self.prepare_scene(&scene.transfer.source, scene.transfer.emission, scene.variant)?;
        }
        let mut pieces = self.store.put_pieces(&self.gpu, &self.mesh, cut);
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        self.mark_candidates(&scene.candidates, &scene.transfer, Some(pieces))?;
        if let Some(spans) = scene.spans {
            let added = Spans::of(self.band_totals()?, spans.paired);
            pieces.spans = added.count;
            if !self.store.holds_spans(u64::from(spans.count) + u64::from(added.count), added.most) {
                let scene = self.scene.take().ok_or_else(unprepared)?;
                self.make_scene(&scene.transfer.source, scene.transfer.emission, scene.variant, false)?;
                let scene = self.scene.as_ref().ok_or_else(unprepared)?;
                self.mark_candidates(&scene.candidates, &scene.transfer, Some(pieces))?;
            }
        }
        self.scene.as_mut().ok_or_else(unprepared)?.need_near_cut(&self.gpu)?;
        Ok(pieces)
    }

    fn resources<'a>(&'a self, transfer: &'a TransferBuffers) -> Resources<'a> {
        transfer.offer(self.store.resources().with("frame", &self.frame).with("light", &self.light))
    }

    /// Draws a frame; the picture is left in the target.
    fn draw_frame(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Drawn> {
        light::check(frame.optics)?;
        let perspective = matches!(frame.camera.projection, Projection::Perspective { .. });
        let (choice, note) = self.choose_order(frame);
        let lists = choice.method == OrderMethod::PerPixel;
        let variant = Variant { perspective, cover: self.cover, shading: Shading::of(frame.optics), lists };
        self.prepare_scene(frame.transfer, frame.optics.emission, variant)?;
        if self.target.as_ref().is_none_or(|t| t.size != frame.size) {
            self.target = Some(Target::new(&self.gpu, frame.size, self.f16)?);
        }
        let cut = near::cut(&self.mesh, frame.camera, f64::from(frame.size[0]) / f64::from(frame.size[1]));
        let pieces = cut.as_ref().map(|cut| self.prepare_near_cut(cut)).transpose()?;
        let near = cut.as_ref().zip(pieces);
        let keys = self.ordering.prepare(&self.gpu, &mut self.store, &self.mesh, choice.method, frame, near);
        self.scene.as_mut().ok_or_else(unprepared)?.need_keys(&self.gpu, keys)?;
        let uniform = self.frame_uniform(frame, pieces);
        self.gpu.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(&uniform));
        let light = light::uniform(frame.optics, &frame.camera.basis());
        self.gpu.queue.write_buffer(&self.light, 0, bytemuck::bytes_of(&light));
        let mut lists = None;
        if variant.lists {
            lists = Some(self.need_lists(frame.size)?);
        } else {
            self.need_raster()?;
        }
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let all = self.resources(&scene.transfer);
        let mut recorder = Recorder::new(&self.gpu, timed);
        self.list_cells(&mut recorder, &all, pieces, uniform.vertex_count, keys)?;
        let cells = &self.store.cells;
        let order = match &lists {
            None => self.store.sorter.sort(&self.gpu, &mut recorder, &cells.counts, &cells.keys, &cells.order)?,
            Some(_) => None,
        };
        let mut notes = Vec::from_iter(note);
        let cycles = self.ordering.cycles(choice.method);
        if cycles > 0 {
            notes.push(format!(
                "{cycles} circles of cells hide one another: in each, at most one pair is in the wrong order"
            ));
        }
        if let Some(p) = pieces {
            notes.push(format!("cells near the eye were cut: {} pieces of them are drawn instead", p.range.count));
        }
        let passes = if let Some(lists) = &mut lists {
            let (strips, passes) = self.list_and_compose(recorder, lists)?;
            let (fragments, strips) = (strips.iter().map(|s| s.listed).sum::<u64>(), strips.len());
            notes.push(format!("{fragments} fragments were listed, in {strips} strips, and composed by their depths"));
            passes
        } else if self.f16 {
            let (slabs, passes) = self.raster_slabs(recorder, timed)?;
            self.slabs = slabs;
            let cells = order.map_or(u32::MAX, |order| order.len() as u32);
            let count = self.slabs.ranges(cells).len();
            notes.push(format!("blended in f16, in {count} slabs of at most {MOST_LAYERS} layers"));
            passes
        } else {
            self.raster(&mut recorder, &all, order.as_deref(), uniform.most_drawn)?;
            recorder.finish()?
        };
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let kind = scene.transfer.describe(self.settings.integral, scene.spans.map(|s| s.paired));
        let pipelines = format!("{kind}; {} are drawn", self.cover.describe());
        let order = format!("{}: {}", choice.method, choice.why);
        let stats = Stats { passes, notes, pipelines, order, adapter: self.gpu.describe(), ..Default::default() };
        if lists.is_some() {
            self.lists = lists;
        }
        Ok(Drawn { stats, pieces })
    }

    /// Makes the passes of this frame that list fragments, and takes the lists out, made for its size.
    fn need_lists(&mut self, size: [u32; 2]) -> Result<FragmentLists> {
        let scene = self.scene.as_mut().ok_or_else(unprepared)?;
        scene.need_lists(&self.gpu)?;
        let mut lists = match self.lists.take() {
            Some(lists) => lists,
            None => FragmentLists::new(&self.gpu, self.most_turns, Listed::Cells)?,
        };
        lists.need_size(&self.gpu, size)?;
        Ok(lists)
    }

    /// The order of a frame. Cells are sorted, and a note says so, where lists were chosen, but not asked for, and the
    /// device cannot count the picture's fragments.
    fn choose_order(&self, frame: &Frame<'_>) -> (OrderChoice, Option<String>) {
        let choice = self.ordering.choose(&self.mesh, &self.settings, frame);
        let lists = choice.method == OrderMethod::PerPixel && self.settings.order != OrderMethod::PerPixel;
        if !lists || FragmentLists::can_count(&self.gpu, frame.size) {
            let warning = choice.warning();
            return (choice, warning);
        }
        let (name, [width, height]) = (&self.gpu.info.name, frame.size);
        let why = format!("{}, and {width}x{height} pixels are too many for lists on '{name}'", choice.why);
        let note = format!(
            "cells are sorted by their centroids, many in the wrong order: {width}x{height} pixels are too many for \
             lists on '{name}'; render a smaller picture, or with --order exact"
        );
        (OrderChoice { method: OrderMethod::Centroid, why, doubt: None }, Some(note))
    }

    /// Makes the raster passes of this frame: without the steps that deep cells take, where some draws have none.
    fn need_raster(&mut self) -> Result<()> {
        let scene = self.scene.as_mut().ok_or_else(unprepared)?;
        let has_deep = scene.spans.is_none_or(|spans| spans.deep);
        if has_deep {
            scene.need_raster(&self.gpu, true)?;
        }
        if !has_deep || (scene.spans.is_some() && !self.f16 && self.store.sorter.sorts_on_host()) {
            scene.need_raster(&self.gpu, false)?;
        }
        Ok(())
    }

    /// Projects vertices, drops cells outside the picture, and lists the others with their sort keys.
    fn list_cells(
        &self,
        recorder: &mut Recorder<'_>,
        all: &Resources<'_>,
        pieces: Option<Pieces>,
        vertices: u32,
        keys: Keys,
    ) -> Result<()> {
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let keys = scene.keys(keys).ok_or_else(unprepared)?;
        let gpu = &self.gpu;
        recorder.compute(&scene.vertices, &scene.vertices.bind(gpu, all)?, Work::Items(vertices))?;
        let ranges = self.store.range_resources(all, pieces);
        let cull = scene.cull(pieces.is_some());
        // Of the survivors' bits, a word each.
        let words = |range: &TetRange| Work::Items(range.count.div_ceil(256) * 8);
        for (range, part) in &ranges {
            recorder.compute(cull, &cull.bind(gpu, part)?, words(range))?;
        }
        recorder.compute(&scene.compact, &scene.compact.bind(gpu, all)?, Work::Groups(1))?;
        for (range, part) in &ranges {
            recorder.compute(keys, &keys.bind(gpu, part)?, words(range))?;
        }
        Ok(())
    }

    /// The frame as shaders see it.
    fn frame_uniform(&self, frame: &Frame<'_>, pieces: Option<Pieces>) -> layout::Frame {
        let m = &self.store.mesh;
        let tet_count = pieces.filter(|p| p.range.count > 0).map_or(m.tet_count, |p| p.range.first + p.range.count);
        layout::Frame {
            tet_count,
            vertex_count: m.vertex_count + pieces.map_or(0, |p| p.vertices),
            chunk_cells: self.store.chunk_cells,
            most_drawn: match self.scene.as_ref().and_then(|s| s.spans) {
                Some(spans) => spans.count + pieces.map_or(0, |p| p.spans),
                None => tet_count,
            },
            ..frame::camera_uniform(frame, &*self.mesh)
        }
    }

    /// Cells after each stage of the last frame.
    fn cell_counts(&self, pieces: Option<Pieces>) -> Result<Vec<(String, u64)>> {
        let (store, gpu) = (&self.store, &self.gpu);
        let tets = u64::from(store.mesh.tet_count);
        let bits: Vec<u32> = gpu.read(&store.cells.candidates, tets.div_ceil(256) * 32)?;
        let candidates = bits.iter().map(|word| u64::from(word.count_ones())).sum();
        let drawn = u64::from(sort::survivors(gpu, &store.cells.counts)?);
        let in_spans = self.scene.as_ref().is_some_and(|s| s.spans.is_some());
        let mut counts = vec![("in the mesh".to_owned(), tets), ("that the function can show".to_owned(), candidates)];
        if let Some(p) = pieces {
            counts.push(("pieces at the near plane".to_owned(), u64::from(p.range.count)));
        }
        if in_spans {
            let bits: Vec<u32> = gpu.read(&store.cells.survivors, store.cells.survivors.size())?;
            let words = |range: TetRange| {
                let first = range.first as usize / 32;
                first..first + range.count.div_ceil(256) as usize * 8
            };
            let ranges = store.ranges.iter().copied().chain(pieces.map(|p| p.range));
            let drawn_cells = ranges.flat_map(|r| &bits[words(r)]).map(|word| u64::from(word.count_ones())).sum();
            counts.push(("drawn".to_owned(), drawn_cells));
            counts.push(("spans of them".to_owned(), drawn));
        } else {
            counts.push(("drawn".to_owned(), drawn));
        }
        Ok(counts)
    }
}

impl Renderer for GpuRenderer {
    fn render(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Rendered> {
        let Drawn { mut stats, pieces } = self.draw_frame(frame, timed)?;
        stats.cells = self.cell_counts(pieces)?;
        // Where fragments were listed, the order of cells is nobody's concern.
        if timed && self.scene.as_ref().is_some_and(|s| !s.variant.lists) {
            stats.inversions = Some(self.ordering.inversions(&self.mesh, frame.camera, &self.order()?));
        }
        let size = |(name, buffer): (&str, &wgpu::Buffer)| BufferSize { name: name.to_owned(), bytes: buffer.size() };
        stats.buffers = self.store.list().into_iter().map(size).collect();
        stats.buffers.extend(self.lists.iter().flat_map(FragmentLists::sizes));
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

fn sorts_on_host(gpu: &Gpu, settings: Settings) -> bool {
    match settings.sort {
        SortPlace::Auto => gpu.is_software(),
        SortPlace::Host => true,
        SortPlace::Gpu => false,
    }
}

/// A frame that no scene was prepared for.
pub fn unprepared() -> Error {
    Error::Device("internal: a frame was drawn before it was prepared".to_owned())
}
