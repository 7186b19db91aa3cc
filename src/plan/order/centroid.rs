//! Order by centroids: the cheapest, and often wrong.

use rayon::prelude::*;

use crate::scene::Camera;
use crate::tet::{TetId, TetMesh};

/// View depth (along the view direction from the eye, data units) of every cell's centroid.
pub fn centroid_depth(mesh: &TetMesh, camera: &Camera) -> Vec<f64> {
    let forward = camera.basis().forward;
    let eye_in_mesh = mesh.mesh_from_data(camera.eye);
    (0..mesh.tets.len() as u32)
        .into_par_iter()
        .map(|tet| {
            let sum: f64 = mesh.corners(TetId(tet)).iter().map(|&corner| (corner - eye_in_mesh).dot(forward)).sum();
            0.25 * sum * mesh.data_per_mesh
        })
        .collect()
}
