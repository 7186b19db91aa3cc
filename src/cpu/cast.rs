//! One ray through all of the mesh: walk after walk, front to back.

use glam::DVec2;

use crate::cpu::axes::RayAxes;
use crate::cpu::walk::{Counts, Sink, Walk};
use crate::plan::entries::Entry;
use crate::plan::eye::HAIR;
use crate::plan::lens::Lens;
use crate::tet::{LinkedMesh, Side};

/// Casts the ray through a film position into the sink. `entries`: its own, nearest first; `around`: see
/// [`sides_around`](crate::plan::eye::sides_around).
#[inline]
pub fn cast<S: Sink, const BIVARIATE: bool>(
    mesh: &LinkedMesh,
    lens: &Lens,
    film: DVec2,
    entries: &[Entry],
    around: &[Side],
    sink: &mut S,
    counts: &mut Counts,
) {
    if entries.is_empty() && around.is_empty() {
        return;
    }
    let axes = RayAxes::new(lens, film);
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
        let mut walk = Walk::enter::<BIVARIATE>(mesh, &axes, entry.side, axes.near);
        if walk.is_inside() && walk.depth() >= covered - HAIR && !walk.run::<S, BIVARIATE>(mesh, &axes, sink, counts) {
            return;
        }
    }
}

/// Walks that begin in the cells around the eye, each on the face through which the ray's line enters the cell behind the
/// eye, the farthest behind first.
fn walks_near_eye<const BIVARIATE: bool>(mesh: &LinkedMesh, axes: &RayAxes, around: &[Side]) -> Vec<Walk> {
    let walks = around.iter().map(|&side| Walk::enter::<BIVARIATE>(mesh, axes, side, axes.near));
    let mut walks: Vec<Walk> = walks.filter(Walk::is_inside).collect();
    walks.sort_by(|a, b| a.depth().total_cmp(&b.depth()));
    walks
}
