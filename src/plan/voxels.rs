//! In which order a grid's voxels are drawn, and which of them are too near to the eye to be drawn as they are.

use glam::DVec3;
use rayon::prelude::*;

use crate::plan::lens::basis_in_mesh;
use crate::plan::near::MOST_DEPTH_RATIO;
use crate::plan::order::VisibilityOrder;
use crate::scene::{Camera, Projection};
use crate::space::Bounds;
use crate::tet::{Domain as _, Grid, VoxelBox};

/// Voxels along a brick's edge.
pub const BRICK: usize = 8;

/// Depth, in units of how much a voxel's depths differ, where these have [`MOST_DEPTH_RATIO`].
const LONG: f64 = MOST_DEPTH_RATIO / (MOST_DEPTH_RATIO - 1.0);

/// The picture counts as wider by this share, more than what f32 moves a vertex by.
const MARGIN: f64 = 1e-2;

/// When an index is visited, of `count` along an axis: first those below the one nearest to the eye, rising, then those
/// above it, falling, and that one itself last.
///
/// Along a ray from the eye the distance from the nearest index never falls, on any axis. So nested visits of the three
/// axes go back to front, whichever is outermost; of voxels, and of bricks of them.
pub fn turn(nearest: usize, count: usize, index: usize) -> usize {
    if index < nearest { index } else { count - 1 - (index - nearest) }
}

/// The voxel that holds the eye, else the one nearest to it; for an orthographic camera the one from which rays leave.
pub fn nearest(grid: &Grid, camera: &Camera) -> [usize; 3] {
    let eye = grid.mesh_from_data(camera.eye);
    let forward = basis_in_mesh(camera, grid).forward;
    std::array::from_fn(|axis| {
        let places = &grid.places[axis];
        let (last, rises) = (places.len() - 2, places[1] > places[0]);
        match camera.projection {
            Projection::Orthographic { .. } => {
                if (forward[axis] > 0.0) == rises {
                    0
                } else {
                    last
                }
            }
            Projection::Perspective { .. } => {
                let is_before_eye = |&place: &f64| if rises { place <= eye[axis] } else { place >= eye[axis] };
                places.partition_point(is_before_eye).saturating_sub(1).min(last)
            }
        }
    })
}

/// All tetrahedra of a grid, numbered as those of the mesh that five a voxel make, back to front: bricks, the voxels of
/// each and the tetrahedra of those, as they lie around the eye. What shaders do, for tests to compare with.
pub fn order(grid: &Grid, camera: &Camera) -> VisibilityOrder {
    let (voxels, nearest) = (grid.voxels(), nearest(grid, camera));
    let eye = grid.mesh_from_data(camera.eye);
    let forward = basis_in_mesh(camera, grid).forward;
    let perspective = matches!(camera.projection, Projection::Perspective { .. });
    let mut keyed = Vec::with_capacity(grid.tet_count() as usize);
    for tet in 0..grid.tet_count() as u32 {
        let voxel = tet as usize / 5;
        let at = [voxel % voxels[0], voxel / voxels[0] % voxels[1], voxel / voxels[0] / voxels[1]];
        // Of z first: it is outermost.
        let brick_turn =
            [2, 1, 0].map(|axis: usize| turn(nearest[axis] / BRICK, voxels[axis].div_ceil(BRICK), at[axis] / BRICK));
        let voxel_turn = [2, 1, 0].map(|axis: usize| {
            let first = at[axis] / BRICK * BRICK;
            turn(nearest[axis].clamp(first, first + BRICK - 1) - first, BRICK, at[axis] - first)
        });
        let is_odd = at.iter().sum::<usize>() % 2 == 1;
        let place = match tet % 5 {
            4 => 1,
            k => {
                let corner = (if is_odd { [0, 3, 5, 6] } else { [1, 2, 4, 7] })[k as usize];
                let ends = |axis: usize| {
                    let up = corner >> axis & 1;
                    [grid.places[axis][at[axis] + up], grid.places[axis][at[axis] + 1 - up]]
                };
                // Where the eye is, or looks, in units of the voxel's sides from the corner.
                let sum: f64 = (0..3)
                    .map(|axis| {
                        let [from, to] = ends(axis);
                        (if perspective { eye[axis] - from } else { forward[axis] }) / (to - from)
                    })
                    .sum();
                let is_before_middle = if perspective { sum < 1.0 } else { sum > 0.0 };
                if is_before_middle { 2 } else { 0 }
            }
        };
        keyed.push((brick_turn, voxel_turn, place, tet));
    }
    keyed.sort_unstable();
    VisibilityOrder::of_permutation(keyed.into_iter().map(|(.., tet)| tet).collect())
}

/// What is drawn of a grid around the eye in another way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// What may be cut: a box that holds the eye, if that is in the grid, so that it lies before all others. Empty
    /// where none is.
    pub voxels: VoxelBox,
    /// View depth, mesh space: other voxels that reach nearer are not in the picture.
    pub least_depth: f64,
}

/// The voxels near the eye for a picture of `aspect` = width / height: those that the near plane cuts, or whose depths
/// differ by more than [`MOST_DEPTH_RATIO`], within the picture; of `part` of the grid.
///
/// A voxel whose depths differ by `extent` may be cut where it is nearer than the near plane, and too long where it is
/// nearer than a third of `extent`: those that the picture holds up to where neither can be are in the box. Whatever else
/// reaches nearer lies outside the picture.
pub fn near(grid: &Grid, part: &VoxelBox, camera: &Camera, aspect: f64) -> Near {
    let depth = camera.near_depth(grid.bounds_in_data().diagonal()) / grid.data_per_mesh;
    let eye = grid.mesh_from_data(camera.eye);
    let basis = basis_in_mesh(camera, grid);
    let none = VoxelBox { low: [0; 3], high: [0; 3] };
    let Projection::Perspective { fov_y } = camera.projection else {
        let corners = grid.bounds_of(part).corners();
        let first = corners.iter().map(|p| (*p - eye).dot(basis.forward)).fold(f64::INFINITY, f64::min);
        return Near { voxels: if first < depth { *part } else { none }, least_depth: f64::NEG_INFINITY };
    };
    let end = |extent: f64| depth.max(extent * LONG) * (1.0 + MARGIN);
    let slope = (0.5 * fov_y).tan() * (1.0 + MARGIN);
    let seen_up_to = |end: f64| {
        let half = slope * end;
        let corner = |x: f64, y: f64| eye + end * basis.forward + x * half * aspect * basis.right + y * half * basis.up;
        let seen = Bounds::of([eye, corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, 1.0), corner(-1.0, -1.0)]);
        // Wider by what f32 moves a vertex by, were the picture a point.
        let hair = DVec3::splat(1e-6);
        Bounds { min: seen.min - hair, max: seen.max + hair }
    };
    let extent_of = |sides: DVec3| sides.dot(basis.forward.abs());
    let most = extent_of(longest_voxel(grid));
    let reached = grid.voxels_in(&seen_up_to(end(most))).and(part);
    // Of these, voxels that are shorter are not near so far.
    let is_near = |at: [usize; 3]| {
        let own = grid.bounds_of(&VoxelBox { low: at, high: at.map(|i| i + 1) });
        let seen = seen_up_to(end(extent_of(own.max - own.min)));
        own.min.cmplt(seen.max).all() && own.max.cmpgt(seen.min).all()
    };
    let voxels = around(&reached, is_near).unwrap_or(none);
    // The least that `end(extent) - extent` is of any voxel.
    let extent = (depth / LONG).clamp(extent_of(side_lengths(grid, f64::INFINITY, f64::min)), most);
    let least_depth = depth.max(extent * LONG) - extent;
    Near { voxels, least_depth: (1.0 - MARGIN) * least_depth }
}

/// The box around the voxels of another that are asked for, if there are any.
fn around(part: &VoxelBox, is_asked_for: impl Fn([usize; 3]) -> bool + Sync) -> Option<VoxelBox> {
    let layers: Vec<VoxelBox> = (part.low[2]..part.high[2])
        .into_par_iter()
        .filter_map(|z| {
            let rows = (part.low[1]..part.high[1]).flat_map(|y| (part.low[0]..part.high[0]).map(move |x| [x, y, z]));
            rows.filter(|&at| is_asked_for(at))
                .map(|at| VoxelBox { low: at, high: at.map(|i| i + 1) })
                .reduce(|a, b| a.with(&b))
        })
        .collect();
    layers.into_iter().reduce(|a, b| a.with(&b))
}

/// The largest sides of voxels, mesh space.
pub fn longest_voxel(grid: &Grid) -> DVec3 {
    side_lengths(grid, 0.0, f64::max)
}

/// Of voxels along each axis, folded.
fn side_lengths(grid: &Grid, start: f64, fold: fn(f64, f64) -> f64) -> DVec3 {
    let of = |places: &Vec<f64>| places.windows(2).map(|p| (p[1] - p[0]).abs()).fold(start, fold);
    let [x, y, z] = &grid.places;
    DVec3::new(of(x), of(y), of(z))
}

/// The view volume, for what is wholly outside of it.
pub struct Sides {
    eye: DVec3,
    /// Inward normals and distances: a point is outside where `normal . (p - eye) < -distance`.
    planes: [(DVec3, f64); 5],
}

impl Sides {
    /// Of a picture; `least_depth` as in [`Near`].
    pub fn new(grid: &Grid, camera: &Camera, aspect: f64, least_depth: f64) -> Self {
        let basis = basis_in_mesh(camera, grid);
        let (slope, half) = match camera.projection {
            Projection::Perspective { fov_y } => ((0.5 * fov_y).tan() * (1.0 + MARGIN), 0.0),
            Projection::Orthographic { height } => (0.0, 0.5 * height / grid.data_per_mesh * (1.0 + MARGIN)),
        };
        let side = |axis: DVec3, wider: f64| (slope * wider * basis.forward - axis, half * wider);
        let planes = [
            side(basis.right, aspect),
            side(-basis.right, aspect),
            side(basis.up, 1.0),
            side(-basis.up, 1.0),
            (basis.forward, -least_depth),
        ];
        Self { eye: grid.mesh_from_data(camera.eye), planes }
    }

    /// Whether all of a box (mesh space) is outside one side.
    pub fn miss(&self, part: &Bounds) -> bool {
        let corners = part.corners();
        self.planes.iter().any(|&(normal, distance)| corners.iter().all(|&p| normal.dot(p - self.eye) < -distance))
    }
}
