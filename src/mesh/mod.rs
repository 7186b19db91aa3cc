//! What the file said: points, cells and named arrays, as read, without geometry or repair.
//!
//! [`read`] opens any supported format. One file here per format; [`synth`] makes procedural meshes instead.

mod cells;
mod choice;
mod file;
pub mod legacy;
mod notes;
pub mod nrrd;
pub mod plot3d;
pub mod raw;
mod sample_type;
pub mod synth;
mod volume;
pub mod write;
mod xml;

use std::path::{Path, PathBuf};

use glam::DVec3;

use crate::error::{Error, Result};

/// Reads a mesh from a file of any supported format: by its content where that begins as XML does, else by its
/// extension (case-insensitive).
///
/// # Errors
///
/// [`Error::Io`] where the file cannot be opened, [`Error::Malformed`] where it is not what it should be,
/// [`Error::Mesh`] where it holds nothing that can be rendered, [`Error::Asked`] where an array, a step or a format is
/// asked for that is not there.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Mesh> {
    if file::begins_with_xml(path)? {
        return xml::read(path, options);
    }
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    match extension.as_str() {
        "vtu" | "pvtu" | "vti" | "pvti" | "vtr" | "pvtr" | "vts" | "pvts" | "pvd" => xml::read(path, options),
        "vtk" => legacy::read(path, options),
        "nrrd" | "nhdr" => nrrd::read(path, options),
        "raw" => raw::read(path, options),
        "bin" | "xyz" | "x" | "g" | "grd" | "p3d" => plot3d::read(path, options),
        _ if options.dims.is_some() => raw::read(path, options),
        _ if options.solution.is_some() => plot3d::read(path, options),
        _ => Err(Error::Asked(format!("unknown mesh format; known extensions: {EXTENSIONS}: {}", path.display()))),
    }
}

/// What [`read`] knows, for its error message.
const EXTENSIONS: &str =
    "vtu, pvtu, vti, pvti, vtr, pvtr, vts, pvts, pvd, vtk, nrrd, nhdr, raw, and bin, xyz, x, g, grd, p3d (PLOT3D)";

/// A cell's shape. Quadratic cells are read by their corner nodes, in the linear shape's order.
///
/// Node order is VTK's for each shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum CellKind {
    /// 4 nodes.
    Tetrahedron,
    /// 5 nodes: quadrilateral base, apex.
    Pyramid,
    /// 6 nodes: two triangles.
    Wedge,
    /// 8 nodes, two quadrilaterals, each counter-clockwise.
    Hexahedron,
    /// 8 nodes, x fastest, then y, then z (also the cell of structured grids).
    Voxel,
}

impl CellKind {
    /// Number of nodes.
    pub const fn node_count(self) -> usize {
        match self {
            Self::Tetrahedron => 4,
            Self::Pyramid => 5,
            Self::Wedge => 6,
            Self::Hexahedron | Self::Voxel => 8,
        }
    }
}

/// How the points are joined.
#[derive(Clone, Debug, PartialEq)]
pub enum Topology {
    /// Explicit cells. Every index is below the number of points; `nodes` holds the cells' nodes one after another,
    /// `kinds[i].node_count()` each.
    Cells {
        /// Shape of each cell.
        kinds: Vec<CellKind>,
        /// All cells' nodes, concatenated.
        nodes: Vec<u32>,
    },
    /// A structured grid of `points[0] * points[1] * points[2]` points, x fastest; cells are implied, x fastest.
    /// Cells of which `blank` is true at a node (PLOT3D's IBLANK = 0, VTK's ghost marks) are left out.
    Structured {
        /// Points along each axis, each at least 2.
        points: [usize; 3],
        /// Per point; empty where nothing is blanked.
        blank: Vec<bool>,
    },
}

impl Topology {
    /// Tetrahedra alone, of these vertices.
    pub fn tetrahedra(cells: &[[u32; 4]]) -> Self {
        Self::Cells { kinds: vec![CellKind::Tetrahedron; cells.len()], nodes: cells.as_flattened().to_vec() }
    }

    /// Number of volume cells, blanked ones included.
    pub fn cell_count(&self) -> usize {
        match self {
            Self::Cells { kinds, .. } => kinds.len(),
            Self::Structured { points, .. } => points.iter().map(|n| n - 1).product(),
        }
    }
}

/// What an array's tuples belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Association {
    /// One tuple a point.
    Point,
    /// One tuple a volume cell (tuples of left-out cells are already removed).
    Cell,
}

/// A named array as read, widened to f64.
#[derive(Clone, Debug, PartialEq)]
pub struct DataArray {
    /// As in the file.
    pub name: String,
    /// Points or cells.
    pub association: Association,
    /// Values per tuple, at least 1.
    pub components: usize,
    /// `components` values per tuple.
    pub values: Vec<f64>,
}

/// What is known of an array without its values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ArrayInfo {
    /// As in the file.
    pub name: String,
    /// Points or cells.
    pub association: Association,
    /// Values per tuple.
    pub components: usize,
}

/// Something the reader left out or guessed, to be told to the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadNote {
    /// One sentence.
    pub text: String,
    /// How many things it concerns (0 where a number makes no sense).
    pub count: u64,
}

/// What a file said.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Point positions, data space. All finite.
    pub points: Vec<DVec3>,
    /// Cells.
    pub topology: Topology,
    /// The arrays that were asked for.
    pub arrays: Vec<DataArray>,
    /// All arrays that the file offers, read or not.
    pub available: Vec<ArrayInfo>,
    /// Left out, guessed, or odd.
    pub notes: Vec<ReadNote>,
}

/// Which arrays to read.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum ArrayChoice {
    /// Everything.
    #[default]
    All,
    /// The array of this name (or of the name before `:` in `U:mag`, `U:x`, `U:0`), or, where `None`, the first
    /// numeric point array, else the first cell array.
    One(Option<String>),
}

/// How to read.
#[derive(Clone, Debug, Default)]
pub struct ReadOptions {
    /// Which arrays.
    pub arrays: ArrayChoice,
    /// The step of a PVD time series (index from 0); the last one where `None`.
    pub step: Option<usize>,
    /// PLOT3D: the solution file beside the grid.
    pub solution: Option<PathBuf>,
    /// Raw volumes: samples along x, y, z.
    pub dims: Option<[usize; 3]>,
    /// Raw volumes: distance of samples along x, y, z (default 1).
    pub spacing: Option<[f64; 3]>,
    /// Raw volumes: sample type, as `u8`, `i16be`, `f32`, ...
    pub sample_type: Option<String>,
}
