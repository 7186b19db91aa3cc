//! Gradients of the scalar: exact in each cell, volume-weighted means at the vertices.

use glam::{DVec3, DVec4};
use rayon::prelude::*;

use super::geometry::six_volumes;
use super::{TetId, TetMesh};

/// Tetrahedra are summed in this many runs side by side, each into its own array: enough for a few cores, and always
/// the same, so that sums come out equal on every machine. Costs 32 bytes a vertex each.
const RUNS: usize = 4;

impl TetMesh {
    /// The gradient of the scalar in a cell, where it is constant: data units per data length. Not finite only where
    /// it overflows f64.
    pub fn cell_gradient(&self, tet: TetId) -> DVec3 {
        let (weighted, six_volumes) = weighted_gradient(self, self.tets[tet.0 as usize]);
        weighted / six_volumes / self.data_per_mesh
    }

    /// The mean of the gradients of the cells around each vertex, weighted by their volumes: data units per data
    /// length. Recomputed at every call; [`TetMesh::gradient_magnitude`] keeps the norms.
    pub fn vertex_gradients(&self) -> Vec<DVec3> {
        self.of_vertex_gradients(|gradient| gradient)
    }

    /// The same of each gradient, without an array of vectors.
    pub(super) fn of_vertex_gradients<T: Send>(&self, of: impl Fn(DVec3) -> T + Sync) -> Vec<T> {
        let run_length = self.tets.len().div_ceil(RUNS).max(1);
        let runs: Vec<Vec<DVec4>> = self.tets.par_chunks(run_length).map(|tets| sum_at_vertices(self, tets)).collect();
        let mean = |v| {
            let sum = runs.iter().fold(DVec4::ZERO, |sum, run| sum + run[v]);
            of(sum.truncate() / sum.w / self.data_per_mesh)
        };
        (0..self.vertices.len()).into_par_iter().map(mean).collect()
    }
}

/// Weighted gradients, and volumes as their fourth component.
fn sum_at_vertices(mesh: &TetMesh, tets: &[[u32; 4]]) -> Vec<DVec4> {
    let mut sums = vec![DVec4::ZERO; mesh.vertices.len()];
    for &tet in tets {
        let (weighted, volume) = weighted_gradient(mesh, tet);
        for v in tet {
            sums[v as usize] += weighted.extend(volume);
        }
    }
    sums
}

/// Six times the volume times the gradient, mesh space, and six times the volume. The product needs no division, so
/// that slivers weigh next to nothing instead of spoiling the mean.
#[inline]
fn weighted_gradient(mesh: &TetMesh, tet: [u32; 4]) -> (DVec3, f64) {
    let (place, scalar) = (|v: u32| mesh.vertices[v as usize], |v: u32| mesh.scalar[v as usize]);
    // Not `map`, which is not inlined, and takes longer than all the rest.
    let [a, b, c, d] = tet;
    let [sa, sb, sc, sd] = [scalar(a), scalar(b), scalar(c), scalar(d)];
    let [a, b, c, d] = [place(a), place(b), place(c), place(d)];
    let (u, v, w) = (b - a, c - a, d - a);
    let weighted = (sb - sa) * v.cross(w) + (sc - sa) * w.cross(u) + (sd - sa) * u.cross(v);
    (weighted, six_volumes([a, b, c, d]))
}
