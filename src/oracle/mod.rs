//! The truth, in f64: which cells a ray crosses by clipping it against each of them, and what it sees by adaptive
//! quadrature of the defining integral.
//!
//! Clipping was preferred to walking from neighbour to neighbour: it needs no adjacency, so it is independent of the
//! code that makes it, it re-enters non-convex meshes and passes holes without special cases, and it cannot get lost at
//! an edge or a vertex: there the interval of each cell shrinks to nothing instead. Both cells of a face compute its
//! plane from the same bits, so the segments of a ray leave neither gap nor overlap beyond rounding, and a ray that lies
//! in a face exactly belongs to one of its two cells.
//!
//! It shares no formula with the shaders. It also renders pictures where no graphics driver is found.

pub mod cases;
mod cell;
mod cuts;
mod lens;
mod rule;
pub mod segment;
mod shade;
mod view;

use std::fmt;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::error::{Error, Result};
use crate::image::Image;
use crate::renderer::{Frame, PassTime, Rendered, Renderer, SegmentIntegral, Stats};
use crate::tet::TetMesh;

pub use shade::Shade;
use view::Composition;
pub use view::View;

/// Hears the finished fraction of a picture, from 0 to 1, from any thread and not always in order; says whether the picture
/// is still wanted.
pub type Progress = Arc<dyn Fn(f64) -> bool + Send + Sync>;

/// The f64 renderer.
pub struct Oracle {
    mesh: Arc<TetMesh>,
    progress: Progress,
}

impl fmt::Debug for Oracle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Oracle").field("tets", &self.mesh.tets.len()).finish_non_exhaustive()
    }
}

impl Oracle {
    /// What is rendered.
    pub fn mesh(&self) -> &TetMesh {
        &self.mesh
    }

    /// Renders `mesh`.
    pub fn new(mesh: Arc<TetMesh>) -> Self {
        Self { mesh, progress: Arc::new(|_| true) }
    }

    /// Reports progress while a picture is made.
    #[must_use]
    pub fn with_progress(self, progress: Progress) -> Self {
        Self { progress, ..self }
    }

    /// What a camera sees: for pictures and single positions of several transfer functions.
    pub fn view(&self, frame: &Frame<'_>) -> Result<View<'_>> {
        match frame.size {
            [0, _] | [_, 0] => Err(Error::Asked("the image has no pixels: ask for at least 1x1".into())),
            size => Ok(View::new(&self.mesh, frame.camera, frame.optics, size)),
        }
    }

    /// The picture with every ray's segments in the order they lie in.
    pub fn image(&self, frame: &Frame<'_>) -> Result<Image> {
        self.part(frame, all_of(frame))
    }

    /// The same of some pixels: from `left, top` to before `right, bottom`.
    ///
    /// # Errors
    /// [`Error::Asked`] where that is no part of the picture, or is not wanted any more.
    pub fn part(&self, frame: &Frame<'_>, area: [u32; 4]) -> Result<Image> {
        let view = self.view(frame)?;
        let [left, top, right, bottom] = area;
        if left >= right || top >= bottom || right > frame.size[0] || bottom > frame.size[1] {
            return Err(Error::Asked(format!("pixels {area:?} are no part of a picture of {:?}", frame.size)));
        }
        view.image(frame.transfer, Composition::AlongRay, frame.background, area, &*self.progress).ok_or_else(given_up)
    }

    /// The same segments composed by one key a cell (a view depth, say), the largest key behind, of equal keys the
    /// smaller id behind: what a renderer that draws cells in that order should get, whether the order is right or not.
    pub fn render_in_order(&self, frame: &Frame<'_>, keys: &[f64]) -> Result<Image> {
        if keys.len() != self.mesh.tets.len() {
            let (got, want) = (keys.len(), self.mesh.tets.len());
            return Err(Error::Asked(format!("{got} keys for {want} tetrahedra: give one each")));
        }
        let view = self.view(frame)?;
        view.image(frame.transfer, Composition::ByKey(keys), frame.background, all_of(frame), &*self.progress)
            .ok_or_else(given_up)
    }

    /// What is seen at any position of the image; the first pixel's centre is (0.5, 0.5). For many positions make a
    /// [`View`] once.
    pub fn pixel(&self, frame: &Frame<'_>, position: [f64; 2]) -> Result<[f64; 4]> {
        Ok(self.view(frame)?.pixel(frame.transfer, frame.background, position))
    }

    /// See [`View::sensitivity`].
    pub fn sensitivity(&self, frame: &Frame<'_>, position: [f64; 2], shift: f64) -> Result<f64> {
        Ok(self.view(frame)?.sensitivity(frame.transfer, position, shift))
    }
}

/// Pixels: left, top, before right, before bottom.
fn all_of(frame: &Frame<'_>) -> [u32; 4] {
    [0, 0, frame.size[0], frame.size[1]]
}

fn given_up() -> Error {
    Error::Asked("the picture was given up".into())
}

impl Renderer for Oracle {
    fn render(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Rendered> {
        let start = Instant::now();
        let view = self.view(frame)?;
        let binned = start.elapsed();
        let image = view.image(frame.transfer, Composition::AlongRay, frame.background, all_of(frame), &*self.progress);
        let image = image.ok_or_else(given_up)?;
        let rendered = start.elapsed();
        let (all, seen) = (self.mesh.tets.len() as u64, view.cells_in_view() as u64);
        let pass = |name: &str, work: String, time| PassTime { pass: name.into(), work, time };
        let passes = match timed {
            true => vec![
                pass("host: bin", format!("{all} cells"), binned),
                pass("host: integrate", format!("{seen} cells"), rendered - binned),
            ],
            false => Vec::new(),
        };
        let stats = Stats {
            cells: vec![("mesh".into(), all), ("in view".into(), seen)],
            passes,
            adapter: "CPU (oracle, f64)".into(),
            ..Stats::default()
        };
        Ok(Rendered { image, stats })
    }

    fn render_only(&mut self, frame: &Frame<'_>) -> Result<Duration> {
        let start = Instant::now();
        self.image(frame)?;
        Ok(start.elapsed())
    }

    fn set_integral(&mut self, _: SegmentIntegral) {}
}
