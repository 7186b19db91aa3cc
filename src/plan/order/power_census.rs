//! What the power order of a mesh is good for.

use std::fmt;

use crate::plan::order::Metric;
use crate::plan::order::lifting::Lifting;
use crate::tet::{Adjacency, Census, Finding, TetMesh, write_count, write_finding};

/// Whether a mesh is regular: its cells the lower hull of its lifted vertices. Of a convex mesh every interior face has
/// to be convex there, and then all of it is.
#[derive(Clone, Debug, PartialEq)]
pub struct PowerCensus {
    /// The squared length by which vertices are lifted.
    pub metric: Metric,
    /// Faces between two cells that do not overlap.
    pub interior_faces: u64,
    /// Neighbours that overlap: neither is behind.
    pub overlapping_pairs: u64,
    /// Faces of more than two cells: each may be behind any other.
    pub overfull_faces: u64,
    /// Faces where the lifting is not convex: from whichever side they are seen, the keys put the cell in front first.
    pub not_convex: Finding,
    /// Faces where it is flat, within f64 rounding of the vertices: keys are equal, which says nothing of the order.
    pub ties: Finding,
    /// The whole mesh is convex, as [`crate::tet::TopologyCensus::is_convex`] judges.
    pub is_convex_mesh: bool,
}

/// What is known of an order beforehand, for every eye.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Proof {
    /// It is right.
    Order,
    /// Neighbours are right; across gaps and dents nothing is known.
    Neighbors,
    /// Nothing: test it.
    Nothing,
}

impl PowerCensus {
    /// Finds the metric and examines all faces. Costs some passes over the cells, once a mesh.
    pub fn new(mesh: &TetMesh, adjacency: &Adjacency) -> Self {
        let (metric, lifting) = Lifting::find(mesh, adjacency);
        Self {
            metric,
            interior_faces: lifting.faces,
            overlapping_pairs: lifting.folds,
            overfull_faces: adjacency.overfull_faces.count,
            not_convex: Lifting::finding(&lifting.concave),
            ties: Lifting::finding(&lifting.flat),
            is_convex_mesh: lifting.folds == 0 && Census::has_convex_boundary(mesh, adjacency),
        }
    }

    /// What it proves of the power order.
    pub fn proof(&self) -> Proof {
        let unordered = self.overlapping_pairs + self.overfull_faces + self.not_convex.count + self.ties.count;
        match (unordered, self.is_convex_mesh) {
            (0, true) => Proof::Order,
            (0, false) => Proof::Neighbors,
            _ => Proof::Nothing,
        }
    }

    /// True where the power order is right for every eye.
    pub fn is_exact(&self) -> bool {
        self.proof() == Proof::Order
    }
}

impl fmt::Display for PowerCensus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<38}  {}", "metric of the power order", self.metric)?;
        write_count(f, "interior faces", self.interior_faces)?;
        write_count(f, "overlapping neighbours", self.overlapping_pairs)?;
        write_count(f, "faces of more than two tetrahedra", self.overfull_faces)?;
        write_finding(f, "  lifted: not convex", &self.not_convex)?;
        write_finding(f, "  lifted: flat, no order", &self.ties)?;
        let proof = match self.proof() {
            Proof::Order => "exact",
            Proof::Neighbors => "exact between neighbours; the mesh is not convex, so unknown across gaps",
            Proof::Nothing => "not exact",
        };
        writeln!(f, "{:<38}  {proof}", "power order")
    }
}
