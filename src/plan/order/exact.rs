//! The order of any mesh for one picture.

use crate::plan::lens::Lens;
use crate::plan::order::gaps::relations;
use crate::plan::order::sequence::Arrows;
use crate::plan::order::{Sequenced, Vantage};
use crate::scene::Camera;
use crate::tet::{Adjacency, TetMesh};

/// Right along the ray of every pixel's centre of a picture of this size, but for circles: after SXMPVO (Cook, Max,
/// Silva & Williams 2004, *Image-space visibility ordering for cell projection volume rendering of unstructured data*).
///
/// Along each ray, where it leaves one cell through the boundary and enters another, that one is behind. Of parts that
/// overlap along a ray, each is in order, and in front of all that begins beyond its end; how their cells come among
/// each other's is not said. What lies outside the picture is ordered as by [`super::mpvonc`].
pub fn exact(mesh: &TetMesh, adjacency: &Adjacency, camera: &Camera, size: [u32; 2]) -> Sequenced {
    let lens = Lens::new(camera, size, mesh);
    let arrows = Arrows::new(mesh, adjacency, Vantage::new(mesh, camera));
    let seen = relations(mesh, &arrows.open_faces(), &lens, size);
    let pixel = lens.pixel_size();
    arrows.with_relations(seen, pixel * pixel).sequence()
}
