//! What a renderer needs of a mesh, independent of the view.
//!
//! [`TetMesh::new`] makes it from what a file said and tells in a [`Census`] what it dropped or repaired on the way.

mod adjacency;
mod axis;
mod boundary;
mod build;
mod cells;
mod census;
mod clip;
mod crossing;
mod domain;
mod field;
mod geometry;
mod gradient;
mod grid;
mod histogram;
mod linked;
mod part;
mod series;
mod split;
mod topology;
mod weld;

use std::sync::Arc;

use glam::DVec3;

pub use self::adjacency::{Adjacency, FACES};
pub use self::axis::Axis;
pub use self::boundary::{Boundary, BoundaryFace, Side};
pub use self::build::BuildOptions;
pub use self::census::{Census, Finding, KindCount};
pub(crate) use self::census::{write_count, write_finding};
pub use self::crossing::Crossing;
pub use self::domain::Domain;
pub use self::field::FieldChoice;
pub(crate) use self::geometry::{determinant_sign, is_positive, six_volumes};
pub use self::grid::{Grid, VoxelBox};
pub use self::histogram::JointHistogram;
pub use self::linked::{Cell, LinkedMesh};
pub(crate) use self::part::part;
pub use self::split::HexSplit;
pub use self::topology::TopologyCensus;
use crate::space::{Bounds, Interval};

/// Index of a tetrahedron in [`TetMesh::tets`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TetId(pub u32);

/// Index of a vertex in [`TetMesh::vertices`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VertexId(pub u32);

/// The most tetrahedra a mesh may have: the four faces of all of them must be indexed in a u32.
pub const MAX_TETS: u64 = (1 << 30) - 1;

/// No neighbour across a face: the face is on the boundary.
pub const NO_TET: u32 = u32::MAX;

/// A conforming tetrahedral mesh with one scalar field and its gradient.
///
/// Mesh space is data space moved and scaled: `data = center_in_data + data_per_mesh * mesh`, with `data_per_mesh` a
/// power of two that brings the mesh's radius into [0.5, 1]. Extinction, gradients and cameras stay in data units.
#[derive(Clone, Debug)]
pub struct TetMesh {
    /// Vertex positions, mesh space.
    pub vertices: Vec<DVec3>,
    /// Centre of the bounding box in data space.
    pub center_in_data: DVec3,
    /// Length of a mesh-space unit in data units; a power of two.
    pub data_per_mesh: f64,
    /// Four vertices each, positively oriented: `(b - a) x (c - a) . (d - a) > 0`.
    /// Shared by the meshes of [`TetMesh::with_field`].
    pub tets: Arc<Vec<[u32; 4]>>,
    /// The scalar at each vertex, data units.
    pub scalar: Vec<f64>,
    /// Norm of the volume-weighted mean of the adjacent cells' gradients, at each vertex (data units per data length).
    pub gradient_magnitude: Vec<f64>,
    /// The field's name.
    pub field: String,
}

impl TetMesh {
    /// The scalar's range over the vertices used by tetrahedra.
    pub fn scalar_range(&self) -> Interval {
        Interval::of(self.scalar.iter().copied())
    }

    /// The gradient magnitude's range.
    pub fn gradient_range(&self) -> Interval {
        Interval::of(self.gradient_magnitude.iter().copied())
    }

    /// The bounding box, mesh space.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(self.vertices.iter().copied())
    }

    /// The bounding box, data space.
    pub fn bounds_in_data(&self) -> Bounds {
        let b = self.bounds();
        Bounds { min: self.data_from_mesh(b.min), max: self.data_from_mesh(b.max) }
    }

    /// Mesh space to data space.
    pub fn data_from_mesh(&self, p: DVec3) -> DVec3 {
        self.center_in_data + self.data_per_mesh * p
    }

    /// Data space to mesh space.
    pub fn mesh_from_data(&self, p: DVec3) -> DVec3 {
        (p - self.center_in_data) / self.data_per_mesh
    }

    /// Positions of a tetrahedron's vertices, mesh space.
    pub fn corners(&self, tet: TetId) -> [DVec3; 4] {
        self.tets[tet.0 as usize].map(|v| self.vertices[v as usize])
    }
}
