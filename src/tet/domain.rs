//! What cameras, scenes and reports need of a mesh, however its cells are held.

use glam::{DMat3, DVec3};

use super::{JointHistogram, TetMesh};
use crate::space::{Bounds, Interval};

/// A field over tetrahedra, and where they lie. Mesh space is explained at [`TetMesh`].
pub trait Domain {
    /// Centre of the bounding box, data space.
    fn center_in_data(&self) -> DVec3;

    /// Length of a mesh-space unit in data units.
    fn data_per_mesh(&self) -> f64;

    /// Mesh space's axes in data space, a rotation: of grids that are turned.
    fn turn(&self) -> DMat3 {
        DMat3::IDENTITY
    }

    /// The bounding box, mesh space.
    fn bounds(&self) -> Bounds;

    /// The scalar's range.
    fn scalar_range(&self) -> Interval;

    /// The gradient magnitude's range.
    fn gradient_range(&self) -> Interval;

    /// How the volume is spread over both.
    fn histogram(&self, bins: [usize; 2]) -> JointHistogram;

    /// The field's name.
    fn field(&self) -> &str;

    /// Vertices.
    fn vertex_count(&self) -> usize;

    /// Tetrahedra.
    fn tet_count(&self) -> u64;

    /// The bounding box, data space.
    fn bounds_in_data(&self) -> Bounds {
        let data_from_mesh = |p: DVec3| self.center_in_data() + self.data_per_mesh() * (self.turn() * p);
        Bounds::of(self.bounds().corners().map(data_from_mesh))
    }

    /// Data space to mesh space.
    fn mesh_from_data(&self, p: DVec3) -> DVec3 {
        self.turn().transpose() * (p - self.center_in_data()) / self.data_per_mesh()
    }
}

impl Domain for TetMesh {
    fn center_in_data(&self) -> DVec3 {
        self.center_in_data
    }

    fn data_per_mesh(&self) -> f64 {
        self.data_per_mesh
    }

    fn bounds(&self) -> Bounds {
        self.bounds()
    }

    fn scalar_range(&self) -> Interval {
        self.scalar_range()
    }

    fn gradient_range(&self) -> Interval {
        self.gradient_range()
    }

    fn histogram(&self, bins: [usize; 2]) -> JointHistogram {
        JointHistogram::new(self, bins)
    }

    fn field(&self) -> &str {
        &self.field
    }

    fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    fn tet_count(&self) -> u64 {
        self.tets.len() as u64
    }
}
