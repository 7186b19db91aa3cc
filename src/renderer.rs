//! What every renderer offers, and the closed sets of choices a user has.

mod integral;
mod order;
mod probe;

use std::time::Duration;

use crate::error::Result;
use crate::image::Image;
use crate::plan::order::Inversions;
use crate::scene::{Camera, Optics, TransferFunction};

pub use integral::SegmentIntegral;
pub use order::{OrderChoice, OrderMethod};
pub use probe::{ChosenIntegral, LEAST_TOLERANCE, TOLERANCE, choose_integral};

/// How cells meet pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// What costs least: rays on the CPU; on graphics devices what records say of the scene (`gpu::choose_method`).
    #[default]
    Auto,
    /// Projected tetrahedra (Shirley & Tuchman 1990): rasterised triangles, blended back to front.
    Project,
    /// Cell projection without a decomposition (Weiler et al. 2003): front faces are rasterised, exits found by the planes
    /// of the other faces, blended back to front.
    CellCast,
    /// Rays from cell to cell (Weiler et al. 2003), front to back: visibility is exact.
    RayCast,
}

/// Where the depth sort runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SortPlace {
    /// On the host for software adapters, on the GPU otherwise.
    #[default]
    Auto,
    /// std's sort, all cores.
    Host,
    /// Radix sort in compute passes.
    Gpu,
}

/// What fragments are blended into.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BlendFormat {
    /// f32 where the adapter blends it, f16 otherwise.
    #[default]
    Auto,
    /// rgba32float.
    F32,
    /// rgba16float in slabs of few layers, resolved to f32.
    F16,
}

/// How a device holds the cells that rays walk through.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CellLayout {
    /// Fast where it fits the device, compact otherwise.
    #[default]
    Auto,
    /// Places and values at every corner of every cell: at most 96 bytes a tetrahedron.
    Fast,
    /// Places and values at vertices, found through the cells' corners: at most 40 bytes a tetrahedron.
    Compact,
}

/// Choices that change how, not what, is rendered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How cells meet pixels.
    pub method: Method,
    /// How segments are integrated.
    pub integral: SegmentIntegral,
    /// How cells are ordered.
    pub order: OrderMethod,
    /// Drop cells that the transfer function leaves empty.
    pub cull: bool,
    /// Where to sort.
    pub sort: SortPlace,
    /// What to blend into.
    pub blend: BlendFormat,
    /// How a graphics device holds cells for ray casting.
    pub layout: CellLayout,
    /// Rays end where less than this share of the light behind would be seen, 0 to 1; 0: only at the mesh's end. The
    /// picture errs by at most as much, times the colours behind.
    pub least_transmittance: f64,
    /// What a channel of a pixel may err by: [`OrderMethod::Auto`] takes half of it at most.
    pub tolerance: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            method: Method::default(),
            integral: SegmentIntegral::default(),
            order: OrderMethod::default(),
            cull: true,
            sort: SortPlace::default(),
            blend: BlendFormat::default(),
            layout: CellLayout::default(),
            least_transmittance: 1e-5,
            tolerance: TOLERANCE,
        }
    }
}

/// One picture to make.
#[derive(Clone, Copy, Debug)]
pub struct Frame<'a> {
    /// From where.
    pub camera: &'a Camera,
    /// Classification, data units.
    pub transfer: &'a TransferFunction,
    /// Emission, lighting, silhouettes.
    pub optics: &'a Optics,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Linear, premultiplied; composited behind the volume.
    pub background: [f32; 4],
}

/// Time of one pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// The pass's name (a shader's file name, or `host: ...`).
    pub pass: String,
    /// Workgroups, vertices or cells, for people to read.
    pub work: String,
    /// GPU timestamps, or the host's clock around submit and wait (software adapters).
    pub time: Duration,
}

/// A named buffer and its size.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BufferSize {
    /// The buffer's label.
    pub name: String,
    /// Bytes.
    pub bytes: u64,
}

/// What rays met.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// Cells entered.
    pub steps: u64,
    /// Steps out of cells that rounding has turned over, whose exit lies before their entry: passed without length.
    pub repaired: u64,
    /// Walks that were given up, since they entered more cells than there are: what lies behind is missing. 0, but for a
    /// mesh whose links are wrong.
    pub lost: u64,
}

impl RayCounts {
    /// Of both.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { steps: self.steps + other.steps, repaired: self.repaired + other.repaired, lost: self.lost + other.lost }
    }
}

/// What happened while rendering.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stats {
    /// Cells left after each stage, in order: (stage, cells).
    pub cells: Vec<(String, u64)>,
    /// Time of each pass; empty unless passes were timed.
    pub passes: Vec<PassTime>,
    /// Where rays were cast.
    pub rays: Option<RayCounts>,
    /// Neighbours among the cells that were drawn, and those in the wrong order; unless passes were timed, not counted.
    pub inversions: Option<Inversions>,
    /// Device buffers.
    pub buffers: Vec<BufferSize>,
    /// Adapter, driver and back end, or the CPU engine's name.
    pub adapter: String,
    /// What the pipelines were specialised for, one line; empty where nothing is compiled for a scene.
    pub pipelines: String,
    /// The order of cells and why it was taken; empty where there is none.
    pub order: String,
    /// Choices that the renderer made, one sentence each.
    pub notes: Vec<String>,
}

/// A picture and how it came to be.
#[derive(Clone, Debug)]
pub struct Rendered {
    /// Linear, premultiplied.
    pub image: Image,
    /// Counters.
    pub stats: Stats,
}

/// Renders one mesh, again and again. Made from a mesh; holds what does not depend on the view.
pub trait Renderer {
    /// Renders `frame` and reads the picture back. `timed` measures every pass, at some cost.
    fn render(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Rendered>;

    /// Renders `frame` and waits for it, leaving the picture on the device: what is timed as a frame.
    fn render_only(&mut self, frame: &Frame<'_>) -> Result<Duration>;

    /// From the next frame on, integrates in another way. The reference knows one alone.
    fn set_integral(&mut self, integral: SegmentIntegral);
}
