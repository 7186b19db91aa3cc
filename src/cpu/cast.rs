//! One ray through all of the mesh: walk after walk, front to back.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::cpu::lens::{Lens, RayAxes};
use crate::cpu::mesh::CellMesh;
use crate::cpu::surface::Entry;
use crate::cpu::walk::{Counts, Sink, Walk};
use crate::tet::FACES;

/// Mesh units: what lies nearer behind a place than this is at that place.
const HAIR: f32 = 1e-6;

/// The cells around a perspective lens's eye: those that hold it, within what rays are moved by rounding.
pub fn cells_around_eye(mesh: &CellMesh, lens: &Lens) -> Vec<u32> {
    if !lens.perspective {
        return Vec::new();
    }
    let eye = lens.eye;
    let hair = f64::from(HAIR);
    let holds = |cell: &u32| {
        let corners =
            mesh.cells[*cell as usize].vertices.map(|v| mesh.vertices[v as usize].truncate().as_dvec3() - eye);
        let low = corners.into_iter().fold(DVec3::INFINITY, DVec3::min);
        let high = corners.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max);
        low.max_element() <= hair
            && high.min_element() >= -hair
            && FACES.iter().all(|face| {
                let [a, b, c] = face.map(|i| corners[i]);
                let outward = (b - a).cross(c - a);
                outward.dot(a) >= -hair * outward.length()
            })
    };
    (0..mesh.cells.len() as u32).into_par_iter().filter(holds).collect()
}

/// Casts the ray through a film position into the sink. `entries`: its own, nearest first; `around`: see
/// [`cells_around_eye`].
#[inline]
pub fn cast<S: Sink, const BIVARIATE: bool>(
    mesh: &CellMesh,
    lens: &Lens,
    film: DVec2,
    entries: &[Entry],
    around: &[u32],
    sink: &mut S,
    counts: &mut Counts,
) {
    if entries.is_empty() && around.is_empty() {
        return;
    }
    let axes = lens.ray(film);
    // How far the ray is done by walks that did not begin at the boundary: what they passed must not be passed again.
    let mut covered = f32::NEG_INFINITY;
    if !around.is_empty() {
        for mut walk in walks_near_eye::<BIVARIATE>(mesh, &axes, around) {
            if walk.depth() >= covered - HAIR {
                if !walk.run::<S, BIVARIATE>(mesh, &axes, sink, counts) {
                    return;
                }
                covered = covered.max(walk.reached());
            }
        }
    }
    for entry in entries {
        let mut walk = Walk::enter::<BIVARIATE>(mesh, &axes, entry.cell, entry.opposite, axes.near);
        if walk.is_inside() && walk.depth() >= covered - HAIR && !walk.run::<S, BIVARIATE>(mesh, &axes, sink, counts) {
            return;
        }
    }
}

/// Walks that begin in the cells around the eye, each on the face through which the ray's line enters the cell behind the
/// eye, the farthest behind first.
fn walks_near_eye<const BIVARIATE: bool>(mesh: &CellMesh, axes: &RayAxes, around: &[u32]) -> Vec<Walk> {
    let faces = around.iter().flat_map(|&cell| (0..4).map(move |opposite| (cell, opposite)));
    let walks = faces.map(|(cell, opposite)| Walk::enter::<BIVARIATE>(mesh, axes, cell, opposite, axes.near));
    let mut walks: Vec<Walk> = walks.filter(Walk::is_inside).collect();
    walks.sort_by(|a, b| a.depth().total_cmp(&b.depth()));
    walks
}
