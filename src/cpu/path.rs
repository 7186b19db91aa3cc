//! The way of any one ray through the mesh.

use glam::DVec2;

use crate::cpu::cast;
use crate::cpu::walk::{Counts, Sink};
use crate::plan::entries;
use crate::plan::lens::Lens;
use crate::space::Ray;
use crate::tet::{LinkedMesh, TetMesh};

/// What one ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Length inside the mesh, data units.
    pub length: f64,
    /// Cells entered.
    pub steps: u64,
    /// Walks that were given up; 0, but for a mesh whose neighbours are wrong.
    pub lost: u64,
}

struct Length(f64);

impl Sink for Length {
    fn wants(&self, _: u32) -> bool {
        true
    }

    fn segment(&mut self, _: [f32; 2], _: [f32; 2], length: f32) -> bool {
        self.0 += f64::from(length);
        true
    }
}

/// The part of `ray` (data space) with `t >= 0` inside the mesh, as pictures see it; `linked` is of `mesh`. Tries every
/// boundary face, so it is for single rays.
pub fn path(mesh: &TetMesh, linked: &LinkedMesh, ray: &Ray) -> Path {
    let lens = Lens::along(mesh.mesh_from_data(ray.origin), ray.direction, 0.0);
    let entries = entries::of_ray(&linked.boundary, &lens, DVec2::ZERO);
    let (mut length, mut counts) = (Length(0.0), Counts::default());
    cast::cast::<_, false>(linked, &lens, DVec2::ZERO, &entries, &[], &mut length, &mut counts);
    Path { length: length.0 * mesh.data_per_mesh, steps: counts.steps, lost: counts.lost }
}
