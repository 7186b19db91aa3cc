//! The order of meshes that need not be convex, from their faces alone.

use crate::plan::order::sequence::Arrows;
use crate::plan::order::{Sequenced, Vantage};
use crate::scene::Camera;
use crate::tet::{Adjacency, TetMesh};

/// Meshed polyhedra visibility ordering for non-convex meshes (Williams 1992, *Visibility-ordering meshed polyhedra*):
/// every cell after the neighbours behind it. Right for convex meshes without circles; across gaps and dents, only as
/// good as the distances of the centroids of cells on the boundary.
///
/// One walk from those cells that the eye sees from outside, farthest first, then from those that it did not reach:
/// around an eye within the mesh, and in circles.
pub fn mpvonc(mesh: &TetMesh, adjacency: &Adjacency, camera: &Camera) -> Sequenced {
    Arrows::new(mesh, adjacency, Vantage::new(mesh, camera)).sequence()
}
