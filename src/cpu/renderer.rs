//! Pictures by ray casting on the CPU.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::Vec4;
use rayon::prelude::*;

use crate::cpu::cast;
use crate::cpu::empty::EmptyCells;
use crate::cpu::segment::Medium;
use crate::cpu::transfer::{Compiled, known};
use crate::cpu::walk::{Counts, Sink};
use crate::cpu::widgets::Axes;
use crate::error::{Error, Result};
use crate::image::Image;
use crate::plan::entries::BoundaryView;
use crate::plan::eye;
use crate::plan::lens::Lens;
use crate::renderer::{
    BufferSize, Frame, Method, PassTime, RayCounts, Rendered, Renderer, SegmentIntegral, Settings, Stats,
};
use crate::scene::{Optics, TransferFunction};
use crate::tet::{LinkedMesh, Side, TetMesh};

/// Pixels along a tile's side.
const TILE: u32 = 32;

/// Renders one mesh by casting rays through its cells, in f32 on all cores.
pub struct CpuRenderer {
    mesh: Arc<TetMesh>,
    cells: LinkedMesh,
    settings: Settings,
    scene: Option<Scene>,
}

/// What depends on the transfer function.
struct Scene {
    source: TransferFunction,
    compiled: Compiled,
    empty: EmptyCells,
}

/// Whether this engine can render with these.
///
/// # Errors
/// What it cannot.
pub fn supports(transfer: &TransferFunction, optics: &Optics, integral: SegmentIntegral) -> Result<()> {
    if *optics != Optics::PLAIN {
        return Err(Error::Asked(
            "unweighted emission, lighting and silhouettes cannot be cast on the CPU yet: use --device oracle".into(),
        ));
    }
    known(transfer, integral)
}

impl CpuRenderer {
    /// Finds neighbours and reorders cells.
    ///
    /// # Errors
    /// [`Error::Asked`] for a method that is not ray casting.
    pub fn new(mesh: Arc<TetMesh>, settings: Settings) -> Result<Self> {
        if matches!(settings.method, Method::Project | Method::CellCast) {
            return Err(Error::Asked(
                "the CPU engine casts rays: ask for --method raycast, or for project and cellcast with --device gpu"
                    .into(),
            ));
        }
        let cells = LinkedMesh::new(&mesh);
        Ok(Self { mesh, cells, settings, scene: None })
    }

    /// Compiles the transfer function where it changed.
    fn prepare_scene(&mut self, frame: &Frame<'_>) -> Result<()> {
        supports(frame.transfer, frame.optics, self.settings.integral)?;
        if frame.size.contains(&0) {
            return Err(Error::Asked("the image has no pixels: ask for at least 1x1".into()));
        }
        if self.scene.as_ref().is_some_and(|scene| scene.source == *frame.transfer) {
            return Ok(());
        }
        let cells = &self.cells;
        let (scalar, gradient, data_per_mesh) = (cells.scalar, cells.gradient, self.mesh.data_per_mesh);
        // Fields at the ends of ranges are means of f32 values, and err by about as much.
        let axes = Axes { scalar, gradient, data_per_mesh, range_hair: 1e-7 };
        let compiled = Compiled::new(frame.transfer, self.settings.integral, &axes)?;
        let empty = if self.settings.cull { EmptyCells::new(cells, &compiled) } else { EmptyCells::none(cells) };
        self.scene = Some(Scene { source: frame.transfer.clone(), compiled, empty });
        Ok(())
    }

    fn draw(&mut self, frame: &Frame<'_>) -> Result<Drawn> {
        let start = Instant::now();
        self.prepare_scene(frame)?;
        let scene = self.scene.as_ref().ok_or_else(|| Error::Asked("no scene was prepared".into()))?;
        let prepared = start.elapsed();
        let lens = Lens::new(frame.camera, frame.size, &self.mesh);
        let job = Job {
            mesh: &self.cells,
            view: BoundaryView::new(&self.cells.boundary, &lens, frame.size, TILE),
            around: eye::sides_around(&self.cells, &lens),
            lens,
            empty: &scene.empty,
            size: frame.size,
            background: Vec4::from(frame.background),
            least: self.settings.least_transmittance as f32,
        };
        let binned = start.elapsed();
        let bivariate = scene.compiled.is_bivariate();
        let (image, counts) = match &scene.compiled {
            Compiled::Curve(medium) => job.image(medium, bivariate),
            Compiled::Plain(medium) => job.image(medium, bivariate),
            Compiled::Any(medium) => job.image(medium, bivariate),
            Compiled::Adaptive(medium) => job.image(medium, bivariate),
            Compiled::Partial(medium) => job.image(medium, bivariate),
            Compiled::Points(medium) => job.image(medium, bivariate),
            Compiled::PreIntegrated(medium) => job.image(medium, bivariate),
        };
        let cast = start.elapsed();
        Ok(Drawn { image, counts, times: [prepared, binned - prepared, cast - binned] })
    }

    fn stats(&self, drawn: &Drawn, timed: bool) -> Stats {
        let scene = self.scene.as_ref();
        let cells = self.cells.cells.len() as u64;
        let visible = cells - scene.map_or(0, |s| s.empty.count());
        let Counts { steps, repaired, lost } = drawn.counts;
        let work = [
            format!("{cells} cells"),
            format!("{} boundary faces", self.cells.boundary.faces.len()),
            format!("{steps} steps"),
        ];
        let names = ["host: classify", "host: bin", "host: cast"];
        let passes = names.into_iter().zip(work).zip(drawn.times);
        let pass = |((name, work), time): ((&str, String), Duration)| PassTime { pass: name.into(), work, time };
        let sizes = self.cells.sizes().into_iter();
        let sizes = sizes.chain(scene.map(|s| ("empty cells", s.empty.bytes())));
        Stats {
            pipelines: Default::default(),
            cells: vec![("in the mesh".into(), cells), ("that the function can show".into(), visible)],
            rays: Some(RayCounts { steps, repaired, lost }),
            passes: if timed { passes.map(pass).collect() } else { Vec::new() },
            buffers: sizes.map(|(name, bytes)| BufferSize { name: name.into(), bytes: bytes as u64 }).collect(),
            adapter: format!("CPU ({} threads, ray casting)", rayon::current_num_threads()),
            notes: Vec::new(),
        }
    }
}

struct Drawn {
    image: Image,
    counts: Counts,
    times: [Duration; 3],
}

impl Renderer for CpuRenderer {
    fn render(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Rendered> {
        let drawn = self.draw(frame)?;
        let stats = self.stats(&drawn, timed);
        Ok(Rendered { image: drawn.image, stats })
    }

    fn render_only(&mut self, frame: &Frame<'_>) -> Result<Duration> {
        let start = Instant::now();
        self.draw(frame)?;
        Ok(start.elapsed())
    }

    fn mesh(&self) -> &TetMesh {
        &self.mesh
    }
}

/// One picture of one medium.
struct Job<'a> {
    mesh: &'a LinkedMesh,
    view: BoundaryView<'a>,
    around: Vec<Side>,
    lens: Lens,
    empty: &'a EmptyCells,
    size: [u32; 2],
    background: Vec4,
    least: f32,
}

impl Job<'_> {
    fn image<M: Medium>(&self, medium: &M, bivariate: bool) -> (Image, Counts) {
        if bivariate { self.tiles::<M, true>(medium) } else { self.tiles::<M, false>(medium) }
    }

    fn tiles<M: Medium, const BIVARIATE: bool>(&self, medium: &M) -> (Image, Counts) {
        let tiles: Vec<(Vec<[f32; 4]>, Counts)> = (0..self.view.tile_count())
            .into_par_iter()
            .with_max_len(1)
            .map(|tile| self.tile::<M, BIVARIATE>(tile, medium))
            .collect();
        let mut image = Image::new(self.size[0], self.size[1]);
        let mut counts = Counts::default();
        for (tile, (pixels, tile_counts)) in (0..).zip(&tiles) {
            let [left, top] = self.view.tile_start(tile);
            let width = (self.size[0] - left).min(TILE) as usize;
            for (y, row) in (top as usize..).zip(pixels.chunks(width)) {
                let at = y * self.size[0] as usize + left as usize;
                image.pixels[at..at + width].copy_from_slice(row);
            }
            counts = counts.plus(*tile_counts);
        }
        (image, counts)
    }

    /// The tile's pixels within the picture, row by row.
    fn tile<M: Medium, const BIVARIATE: bool>(&self, tile: u32, medium: &M) -> (Vec<[f32; 4]>, Counts) {
        let [left, top] = self.view.tile_start(tile);
        let [width, height] = [(self.size[0] - left).min(TILE), (self.size[1] - top).min(TILE)];
        let entries = self.view.tile_entries(tile, &self.lens, self.size);
        let mut counts = Counts::default();
        let mut pixels = Vec::with_capacity((width * height) as usize);
        for y in 0..height {
            for x in 0..width {
                let mut seen = Composite {
                    medium,
                    empty: self.empty,
                    hint: 0,
                    color: Vec4::ZERO,
                    transmittance: 1.0,
                    least: self.least,
                };
                let film = self.lens.film([left + x, top + y]);
                let entries = entries.of(x, y);
                cast::cast::<_, BIVARIATE>(self.mesh, &self.lens, film, entries, &self.around, &mut seen, &mut counts);
                let front = seen.color.with_w(1.0 - seen.transmittance);
                pixels.push((front + seen.transmittance * self.background).to_array());
            }
        }
        (pixels, counts)
    }
}

/// Segments over each other, front to back.
struct Composite<'a, M> {
    medium: &'a M,
    empty: &'a EmptyCells,
    hint: u32,
    color: Vec4,
    transmittance: f32,
    /// Where a ray ends.
    least: f32,
}

impl<M: Medium> Sink for Composite<'_, M> {
    #[inline(always)]
    fn wants(&self, cell: u32) -> bool {
        !self.empty.has(cell)
    }

    #[inline(always)]
    fn segment(&mut self, front: [f32; 2], back: [f32; 2], length: f32) -> bool {
        let seen = self.medium.segment(&mut self.hint, front, back, length);
        self.color += self.transmittance * seen;
        self.transmittance -= self.transmittance * seen.w;
        self.transmittance > self.least
    }
}
