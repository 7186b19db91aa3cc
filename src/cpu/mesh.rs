//! The mesh as rays walk through it: cells and vertices in the order of a space-filling curve, 32 and 16 bytes each.

use glam::{DVec3, Vec4};
use rayon::prelude::*;

use crate::cpu::axis::Axis;
use crate::cpu::surface::Surface;
use crate::tet::{Adjacency, NO_TET, TetId, TetMesh};

/// One tetrahedron: half a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Cell {
    /// Positively oriented.
    pub vertices: [u32; 4],
    /// Across the face opposite each vertex; [`NO_TET`] on the boundary.
    pub neighbors: [u32; 4],
}

/// What rays walk through.
#[derive(Debug)]
pub struct CellMesh {
    /// Along a Morton curve, so that neighbours lie close in memory.
    pub(super) cells: Vec<Cell>,
    /// Position (mesh space) and scalar (0..1), by first use.
    pub(super) vertices: Vec<Vec4>,
    /// Gradient magnitude (0..1).
    pub(super) gradients: Vec<f32>,
    pub(super) surface: Surface,
    pub(super) scalar: Axis,
    pub(super) gradient: Axis,
    pub(super) center_in_data: DVec3,
    pub(super) data_per_mesh: f64,
}

impl CellMesh {
    /// Finds neighbours and the boundary, and reorders. Needs about 100 bytes a tetrahedron while at work.
    pub fn new(mesh: &TetMesh) -> Self {
        let order = morton_order(mesh);
        let mut place = vec![0_u32; order.len()];
        (0_u32..).zip(&order).for_each(|(new, &old)| place[old as usize] = new);
        let (number, old_of_new) = vertex_order(mesh, &order);
        let neighbors = Adjacency::new(mesh).neighbors;
        let across = |n: u32| if n == NO_TET { NO_TET } else { place[n as usize] };
        let cells: Vec<Cell> = order
            .par_iter()
            .map(|&old| Cell {
                vertices: mesh.tets[old as usize].map(|v| number[v as usize]),
                neighbors: neighbors[old as usize].map(across),
            })
            .collect();
        let (scalar, gradient) = (Axis::of(mesh.scalar_range()), Axis::of(mesh.gradient_range()));
        let vertex = |&old: &u32| {
            let s = scalar.apply(mesh.scalar[old as usize]);
            mesh.vertices[old as usize].as_vec3().extend(s as f32)
        };
        let vertices: Vec<Vec4> = old_of_new.par_iter().map(vertex).collect();
        let magnitude = |&old: &u32| gradient.apply(mesh.gradient_magnitude[old as usize]) as f32;
        let gradients = old_of_new.par_iter().map(magnitude).collect();
        let surface = Surface::new(&cells, &vertices);
        let (center_in_data, data_per_mesh) = (mesh.center_in_data, mesh.data_per_mesh);
        Self { cells, vertices, gradients, surface, scalar, gradient, center_in_data, data_per_mesh }
    }

    /// Name and size of each array.
    pub(super) fn sizes(&self) -> [(&'static str, usize); 4] {
        [
            ("cells", size_of_val(&self.cells[..])),
            ("vertices", size_of_val(&self.vertices[..])),
            ("gradients", size_of_val(&self.gradients[..])),
            ("surface", self.surface.bytes()),
        ]
    }
}

/// Tetrahedra by the Morton code of their centroid: bits of x, y and z in turn (Morton 1966).
fn morton_order(mesh: &TetMesh) -> Vec<u32> {
    let bounds = mesh.bounds();
    let cell_size = ((bounds.max - bounds.min).max_element() / f64::from(1 << 20)).max(f64::MIN_POSITIVE);
    let mut keyed: Vec<(u64, u32)> = (0..mesh.tets.len() as u32)
        .into_par_iter()
        .map(|tet| {
            let centroid = 0.25 * mesh.corners(TetId(tet)).iter().sum::<DVec3>();
            // `as` saturates.
            let [x, y, z] = ((centroid - bounds.min) / cell_size).to_array().map(|v| spread(v as u64));
            (x | y << 1 | z << 2, tet)
        })
        .collect();
    keyed.par_sort_unstable();
    keyed.into_iter().map(|(_, tet)| tet).collect()
}

/// Two zeros between any two of the lowest 21 bits.
fn spread(v: u64) -> u64 {
    let v = v.min((1 << 21) - 1);
    let v = (v | v << 32) & 0x001f_0000_0000_ffff;
    let v = (v | v << 16) & 0x001f_0000_ff00_00ff;
    let v = (v | v << 8) & 0x100f_00f0_0f00_f00f;
    let v = (v | v << 4) & 0x10c3_0c30_c30c_30c3;
    (v | v << 2) & 0x1249_2492_4924_9249
}

/// New number of each vertex, and the old one of each new number: in the order in which the cells use them.
fn vertex_order(mesh: &TetMesh, order: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let mut number = vec![u32::MAX; mesh.vertices.len()];
    let mut old_of_new = Vec::with_capacity(mesh.vertices.len());
    for v in order.iter().flat_map(|&tet| mesh.tets[tet as usize]) {
        if number[v as usize] == u32::MAX {
            number[v as usize] = old_of_new.len() as u32;
            old_of_new.push(v);
        }
    }
    (number, old_of_new)
}

#[cfg(test)]
mod tests {
    #[test]
    fn bits_are_spread_by_three() {
        assert_eq!(super::spread(0b1011), 0b001_000_001_001);
        assert_eq!(super::spread(u64::MAX).count_ones(), 21);
        assert_eq!(super::spread(1 << 20), 1 << 60);
    }
}
