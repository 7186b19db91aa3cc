//! The values along one ray, to be marked on the histogram.

use rayon::prelude::*;

use crate::scene::Camera;
use crate::tet::{TetId, TetMesh};

/// (scalar, gradient magnitude) where the ray through `pixel` (of a picture of `size`) enters and leaves cells, near ones
/// first.
pub fn along(mesh: &TetMesh, camera: &Camera, size: [u32; 2], pixel: [f64; 2]) -> Vec<[f64; 2]> {
    let ray = camera.ray(size, pixel);
    let origin = mesh.mesh_from_data(ray.origin);
    let direction = mesh.mesh_from_data(ray.origin + ray.direction) - origin;
    let near = camera.near_depth(mesh.bounds_in_data().diagonal());
    let part = |tet: usize| {
        let [a, b, c, d] = mesh.corners(TetId(tet as u32));
        let sides = glam::DMat3::from_cols(b - a, c - a, d - a);
        let inverse = sides.inverse();
        // Barycentric coordinates along the ray: at depth 0, and their change.
        let (at, by) = (inverse * (origin - a), inverse * direction);
        let at = [1.0 - at.element_sum(), at.x, at.y, at.z];
        let by = [-by.element_sum(), by.x, by.y, by.z];
        let (mut enter, mut exit) = (near, f64::INFINITY);
        for (at, by) in at.into_iter().zip(by) {
            if by > 0.0 {
                enter = enter.max(-at / by);
            } else if by < 0.0 {
                exit = exit.min(-at / by);
            } else if at < 0.0 {
                return None;
            }
        }
        // Phrased so that NaN is none.
        if !(enter < exit && exit < f64::INFINITY) {
            return None;
        }
        let value = |depth: f64| {
            let of =
                |values: &[f64]| (0..4).map(|i| (at[i] + depth * by[i]) * values[mesh.tets[tet][i] as usize]).sum();
            [of(&mesh.scalar), of(&mesh.gradient_magnitude)]
        };
        Some((enter, [value(enter), value(exit)]))
    };
    let mut parts: Vec<(f64, [[f64; 2]; 2])> = (0..mesh.tets.len()).into_par_iter().filter_map(part).collect();
    parts.sort_by(|a, b| a.0.total_cmp(&b.0));
    parts.into_iter().flat_map(|(_, ends)| ends).collect()
}
