//! What was typed. Nothing here opens a file.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use serde::{Deserialize, Serialize};

use super::bench::BenchCommand;
use super::parse;
use crate::mesh::synth::Sample;
use crate::renderer::{self, SegmentIntegral};

/// Volume rendering of unstructured meshes with transfer functions of a scalar and its gradient magnitude.
#[derive(Debug, Parser)]
#[command(name = "tetralux", version, arg_required_else_help = true, max_term_width = 110)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Render a mesh to a picture
    Render(Box<RenderArgs>),
    /// Look at a mesh in a window, and draw its transfer function on the joint histogram
    View(Box<ViewArgs>),
    /// Tell what a mesh holds and what became of its cells
    Info(InfoArgs),
    /// Write a procedural mesh with an analytic field
    Sample(SampleArgs),
    /// Compare two pictures in linear floating point
    Compare(CompareArgs),
    /// Draw the joint histogram of a field and its gradient magnitude
    Histogram(HistogramArgs),
    /// Make the tables that the shaders look up, or compare them with what is there
    Tables(TablesArgs),
    /// Measure time and error of methods, integrals and orders, and chart one against the other
    Bench {
        #[command(subcommand)]
        what: BenchCommand,
    },
}

/// Which mesh, and how to read it.
#[derive(Debug, Args)]
pub(crate) struct SourceArgs {
    /// Mesh: .vtu .pvtu .vti .pvti .vtr .vts .pvd .vtk, PLOT3D (.xyz .x .bin .grd), .nrrd .nhdr, .raw
    pub mesh: PathBuf,
    /// Step of a time series, from 0 [default: the last]
    #[arg(long, value_name = "N")]
    pub step: Option<usize>,
    /// PLOT3D solution file beside the grid [default: found by name]
    #[arg(long, value_name = "FILE")]
    pub solution: Option<PathBuf>,
    /// Raw volumes: samples along x, y and z
    #[arg(long, value_name = "AxBxC", value_parser = parse::dims)]
    pub dims: Option<[usize; 3]>,
    /// Raw volumes: distance of samples [default: 1,1,1]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::spacing)]
    pub spacing: Option<[f64; 3]>,
    /// Raw volumes: type of a sample, as u8, i16be, f32
    #[arg(long, value_name = "TYPE")]
    pub sample_type: Option<String>,
    /// Tetrahedra a hexahedron is cut into, 5 or 6; 5 for structured grids only [default: 5 for rectilinear grids,
    /// else 6]
    #[arg(long, value_name = "N")]
    pub split: Option<Split>,
    /// Merge points at exactly one place, which closes the slits between blocks
    #[arg(long)]
    pub weld: bool,
}

impl SourceArgs {
    /// A file that is read as its name says.
    pub fn of(mesh: PathBuf) -> Self {
        Self {
            mesh,
            step: None,
            solution: None,
            dims: None,
            spacing: None,
            sample_type: None,
            split: None,
            weld: false,
        }
    }
}

/// An integral, or the cheapest that holds a tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum IntegralChoice {
    Auto,
    Fixed(SegmentIntegral),
}

impl IntegralChoice {
    /// The one that was asked for.
    pub fn fixed(self) -> Option<SegmentIntegral> {
        match self {
            Self::Auto => None,
            Self::Fixed(integral) => Some(integral),
        }
    }
}

impl Default for IntegralChoice {
    fn default() -> Self {
        Self::Fixed(SegmentIntegral::default())
    }
}

impl std::fmt::Display for IntegralChoice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Fixed(integral) => integral.fmt(f),
        }
    }
}

impl std::str::FromStr for IntegralChoice {
    type Err = crate::error::Error;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text == "auto" { Ok(Self::Auto) } else { text.parse().map(Self::Fixed) }
    }
}

/// What a choice is called on the command line.
pub(crate) fn name_of(choice: impl ValueEnum) -> String {
    choice.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
}

/// Tetrahedra per hexahedron.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Split {
    #[value(name = "5")]
    Five,
    #[value(name = "6")]
    Six,
}

#[derive(Debug, Args)]
pub(crate) struct RenderArgs {
    #[command(flatten)]
    pub source: SourceArgs,
    /// Picture to write: .png (8 bit, straight alpha, sRGB) or .exr (32-bit float, linear, premultiplied)
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Where to render: a graphics adapter (hardware preferred), a software one, the CPU, or the f64 reference there
    #[arg(long, value_name = "DEVICE", default_value = "auto")]
    pub device: Device,
    /// Write PNG values without the sRGB curve
    #[arg(long)]
    pub png_linear: bool,
    /// Draw the transfer function beside the picture, which becomes wider
    #[arg(long)]
    pub legend: bool,
    /// Frames to time after the first one
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub repeat: u32,
    /// Print one line of JSON on stdout: cells after each stage, milliseconds of each pass, seconds a frame
    #[arg(long, value_name = "FORMAT")]
    pub stats: Option<StatsFormat>,
    /// Tell the plan and the passes, with cells after each stage, bytes and milliseconds
    #[arg(long)]
    pub explain: bool,
    #[command(flatten)]
    pub scene: SceneArgs,
    #[command(flatten)]
    pub choices: ChoiceArgs,
}

/// Public to tests of the window, which begin as the command line does.
#[derive(Clone, Debug, Args)]
pub struct ViewArgs {
    /// Mesh: what `tetralux render` reads by its name alone; others can be opened or dropped later
    pub mesh: Option<PathBuf>,
    /// Scene file (TOML) to begin with
    #[arg(short, long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// Scalar field: an array's name, or NAME:mag, NAME:x, NAME:0 [default: the first]
    #[arg(short, long, value_name = "NAME")]
    pub field: Option<String>,
    /// Where to render: a graphics adapter (hardware preferred), a software one, the CPU, or the f64 reference there
    #[arg(long, value_name = "DEVICE", default_value = "auto")]
    pub device: Device,
    #[command(flatten)]
    pub choices: ChoiceArgs,
}

/// What replaces the scene file's values.
#[derive(Debug, Args)]
#[command(next_help_heading = "Scene")]
pub(crate) struct SceneArgs {
    /// Scene file (TOML); every flag below wins over it
    #[arg(short, long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// Scalar field: an array's name, or NAME:mag, NAME:x, NAME:0 [default: the first]
    #[arg(short, long, value_name = "NAME")]
    pub field: Option<String>,
    /// Width and height of the picture, pixels [default: 800x600]
    #[arg(long, value_name = "WxH", value_parser = parse::size, conflicts_with_all = ["width", "height"])]
    pub size: Option<[u32; 2]>,
    /// Width of the picture, pixels
    #[arg(long, value_name = "PIXELS")]
    pub width: Option<u32>,
    /// Height of the picture, pixels
    #[arg(long, value_name = "PIXELS")]
    pub height: Option<u32>,
    /// Behind the volume: R,G,B or R,G,B,A, linear, or #rrggbb, sRGB [default: transparent black]
    #[arg(long, value_name = "COLOUR", value_parser = parse::color)]
    pub background: Option<String>,
    /// Position of the camera
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::vector, allow_hyphen_values = true)]
    pub eye: Option<[f64; 3]>,
    /// What the camera looks at [default: the mesh's middle]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::vector, allow_hyphen_values = true)]
    pub target: Option<[f64; 3]>,
    /// What is up [default: 0,0,1]
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::vector, allow_hyphen_values = true)]
    pub up: Option<[f64; 3]>,
    /// Full vertical angle of a perspective camera, degrees [default: 30]
    #[arg(long, value_name = "DEGREES", conflicts_with = "ortho_height")]
    pub fov_y: Option<f64>,
    /// Height of an orthographic image, data units
    #[arg(long, value_name = "LENGTH")]
    pub ortho_height: Option<f64>,
    /// Fitted camera: angle around z from the x axis, degrees [default: 30]
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, conflicts_with_all = ["eye", "target", "up"])]
    pub azimuth: Option<f64>,
    /// Fitted camera: angle above the xy plane, degrees [default: 20]
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, conflicts_with_all = ["eye", "target", "up"])]
    pub elevation: Option<f64>,
    /// Depth where the picture begins, data units [default: 1e-4 of the mesh's diagonal]
    #[arg(allow_hyphen_values = true, long, value_name = "DEPTH")]
    pub near: Option<f64>,
    /// What colours are multiplied by: the extinction, or one (Song et al. 2009) [default: weighted]
    #[arg(long, value_name = "MODEL")]
    pub emission: Option<Emission>,
    /// Light the gradients: vector towards the light; --set lighting.KEY has the rest
    #[arg(long, value_name = "X,Y,Z", value_parser = parse::vector, allow_hyphen_values = true)]
    pub light: Option<[f64; 3]>,
    /// What the light is fixed to; lights the gradients too [default: view]
    #[arg(long, value_name = "SPACE")]
    pub light_space: Option<LightSpace>,
    /// Emphasise outlines: exponent, above 0
    #[arg(long, value_name = "P", allow_hyphen_values = true)]
    pub silhouette: Option<f64>,
    /// What outlines modulate; emphasises them too [default: opacity]
    #[arg(long, value_name = "MODE")]
    pub silhouette_mode: Option<SilhouetteMode>,
    /// Cut off what is outside of this box, data units; with --order structured, the voxels outside
    #[arg(long, value_name = "X0,Y0,Z0,X1,Y1,Z1", value_parser = parse::corners, allow_hyphen_values = true)]
    pub clip: Option<[f64; 6]>,
    /// Any scene key, as transfer.widget.0.extinction=3 (list items count from 0); may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = parse::assignment)]
    pub set: Vec<(String, String)>,
}

/// How, not what, is rendered.
#[derive(Clone, Copy, Debug, PartialEq, Args, Serialize)]
#[command(next_help_heading = "Method")]
pub(crate) struct ChoiceArgs {
    /// How cells meet pixels
    #[arg(long, default_value = "auto")]
    pub method: Method,
    /// In which order cells are blended
    #[arg(long, default_value = "auto")]
    pub order: Order,
    /// How one ray segment in one cell is integrated: vertex-linear, mean-scalar, preintegrated[:N], partial[:N],
    /// partial-direct, analytic, segmented:N, adaptive[:TOLERANCE]; auto: the cheapest that holds --tolerance
    #[arg(long, default_value_t)]
    #[serde(serialize_with = "as_text")]
    pub integral: IntegralChoice,
    /// What a channel of a pixel may err by, where integrals, orders and methods are chosen
    #[arg(long, value_name = "ERROR", default_value_t = renderer::TOLERANCE, value_parser = parse::tolerance)]
    pub tolerance: f64,
    /// Where cells are sorted; auto: on the host for software adapters
    #[arg(long, default_value = "auto")]
    pub sort: Sort,
    /// What is blended into; auto: f32 where the adapter can
    #[arg(long, default_value = "auto")]
    pub blend: Blend,
    /// How a graphics device holds cells for ray casting; auto: fast where it fits
    #[arg(long, default_value = "auto")]
    pub layout: Layout,
    /// Keep cells that the transfer function leaves empty
    #[arg(long)]
    pub no_cull: bool,
    /// Rays end where they would see less than this share of what lies behind; 0: at the mesh's end
    #[arg(long, value_name = "SHARE", default_value = "1e-5", value_parser = parse::share)]
    pub least_transmittance: f64,
}

impl ChoiceArgs {
    /// Defaults but for these.
    pub fn of(method: Method, order: Order, integral: IntegralChoice) -> Self {
        Self {
            method,
            order,
            integral,
            tolerance: renderer::TOLERANCE,
            sort: Sort::Auto,
            blend: Blend::Auto,
            layout: Layout::Auto,
            no_cull: false,
            least_transmittance: renderer::Settings::default().least_transmittance,
        }
    }

    /// The library's words for it.
    pub fn settings(self) -> renderer::Settings {
        renderer::Settings {
            method: match self.method {
                Method::Auto => renderer::Method::Auto,
                Method::Project => renderer::Method::Project,
                Method::Cellcast => renderer::Method::CellCast,
                Method::Raycast => renderer::Method::RayCast,
            },
            integral: self.integral.fixed().unwrap_or_default(),
            order: match self.order {
                Order::Auto => renderer::OrderMethod::Auto,
                Order::Centroid => renderer::OrderMethod::Centroid,
                Order::Power => renderer::OrderMethod::Power,
                Order::Mpvonc => renderer::OrderMethod::Mpvonc,
                Order::Exact => renderer::OrderMethod::Exact,
                Order::PerPixel => renderer::OrderMethod::PerPixel,
                Order::Structured => renderer::OrderMethod::Structured,
            },
            cull: !self.no_cull,
            sort: match self.sort {
                Sort::Auto => renderer::SortPlace::Auto,
                Sort::Host => renderer::SortPlace::Host,
                Sort::Gpu => renderer::SortPlace::Gpu,
            },
            blend: match self.blend {
                Blend::Auto => renderer::BlendFormat::Auto,
                Blend::F32 => renderer::BlendFormat::F32,
                Blend::F16 => renderer::BlendFormat::F16,
            },
            layout: match self.layout {
                Layout::Auto => renderer::CellLayout::Auto,
                Layout::Fast => renderer::CellLayout::Fast,
                Layout::Compact => renderer::CellLayout::Compact,
            },
            tolerance: self.tolerance,
            least_transmittance: self.least_transmittance,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Layout {
    Auto,
    /// At most 96 bytes a tetrahedron
    Fast,
    /// At most 40
    Compact,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Emission {
    Weighted,
    Unweighted,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LightSpace {
    /// The camera: x right, y up, z towards the viewer
    View,
    /// The mesh
    World,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SilhouetteMode {
    /// Each cell's opacity and colour
    Opacity,
    /// The optical depth
    Depth,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Method {
    /// Rays; projected tetrahedra on graphics devices where an order of cells is asked for, or links do not fit, or where
    /// software rasterises and few cells are shown
    Auto,
    /// Projected tetrahedra
    Project,
    /// Front faces of cells; exits by the planes of the other faces
    Cellcast,
    /// Rays from cell to cell: visibility is exact
    Raycast,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Order {
    /// The cheapest that the function and the mesh allow
    Auto,
    /// View depth of the cell's centroid
    Centroid,
    /// Power of the eye to the cells; exact for Delaunay meshes and stretched ones
    Power,
    /// Cells after those behind them, on the host; exact for convex meshes
    Mpvonc,
    /// The same, and across gaps; on the host
    Exact,
    /// Each pixel's fragments by their own depth: exact
    PerPixel,
    /// Rectilinear grids: voxels as they lie around the eye, five tetrahedra each that are not stored; exact
    Structured,
}

/// As it is written on the command line.
fn as_text<S: serde::Serializer>(value: &impl std::fmt::Display, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(value)
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Sort {
    Auto,
    Host,
    Gpu,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Blend {
    Auto,
    F32,
    F16,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum Device {
    /// A hardware graphics adapter if there is one, else the CPU, or what can render the scene
    Auto,
    /// Any graphics adapter, hardware preferred
    Gpu,
    /// A software graphics adapter
    Software,
    /// Rays through the cells, on all cores
    Cpu,
    /// The f64 reference on the CPU: slow and exact
    Oracle,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum StatsFormat {
    Json,
}

#[derive(Debug, Args)]
pub(crate) struct InfoArgs {
    #[command(flatten)]
    pub source: SourceArgs,
    /// Scalar field the census is about [default: the first]
    #[arg(short, long, value_name = "NAME")]
    pub field: Option<String>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct SampleArgs {
    /// marschner-lobb, hydrogen, sphere-flow or tangle
    pub name: Sample,
    /// About how many tetrahedra
    #[arg(long, value_name = "N", default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(1..=200_000_000))]
    pub tets: u32,
    /// Mesh to write: .vtu
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
}

#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    /// The picture in question: .png or .exr
    pub got: PathBuf,
    /// What it should be
    pub want: PathBuf,
    /// Difference picture to write: .png or .exr
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// What differences are multiplied by in the difference picture
    #[arg(long, value_name = "FACTOR", default_value_t = 16.0)]
    pub scale: f32,
    /// Fail (exit code 1) where a channel of a pixel differs by more
    #[arg(long, value_name = "X")]
    pub max_error: Option<f64>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct HistogramArgs {
    #[command(flatten)]
    pub source: SourceArgs,
    /// Scalar field [default: the first]
    #[arg(short, long, value_name = "NAME")]
    pub field: Option<String>,
    /// Picture to write: .png or .exr
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// Table to write: .csv
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Bins along the scalar and the gradient magnitude
    #[arg(long, value_name = "WxH", default_value = "256x256", value_parser = parse::bins)]
    pub bins: [u32; 2],
}

#[derive(Debug, Args)]
pub(crate) struct TablesArgs {
    /// Folder of the tables
    #[arg(short, long, value_name = "FOLDER", default_value = "tables")]
    pub output: PathBuf,
    /// Write nothing; fail (exit code 1) where a file differs by more than the last place of a number
    #[arg(long)]
    pub check: bool,
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    #[test]
    fn the_definition_is_consistent() {
        super::Arguments::command().debug_assert();
    }
}
