//! The mesh as rays walk through it: cells and vertices in the order of a space-filling curve, 32 and 16 bytes each.

use std::sync::OnceLock;

use glam::{DVec3, Vec4};
use rayon::prelude::*;

use super::boundary::{Boundary, Side};
use super::crossing::Crossing;
use super::{Adjacency, Axis, NO_TET, TetId, TetMesh};
use crate::error::{Error, Result};

/// One tetrahedron: half a cache line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C, align(32))]
pub struct Cell {
    /// Ascending: the three vertices of a face come in one order in both cells that share it, so no more than
    /// the corner that is not on it has to be known to step from one into the other.
    pub vertices: [u32; 4],
    /// Across the face opposite each vertex: four times the cell there, plus its corner that is not on the face;
    /// [`LinkedMesh::NO_LINK`] on the boundary, and where the cell there overlaps this one: both are entered and left
    /// on their own.
    pub links: [u32; 4],
}

/// What rays walk through. Topology does not change with fields, nor with places.
#[derive(Clone, Debug)]
pub struct LinkedMesh {
    /// Along a Morton curve, so that neighbours lie close in memory.
    pub cells: Vec<Cell>,
    /// Position (mesh space) and scalar (0..1), by first use.
    pub vertices: Vec<Vec4>,
    /// Gradient magnitude (0..1).
    pub gradients: Vec<f32>,
    /// The faces through which rays enter.
    pub boundary: Boundary,
    /// How scalars became 0..1.
    pub scalar: Axis,
    /// How gradient magnitudes became 0..1.
    pub gradient: Axis,
    /// The mesh's vertex of each of these.
    pub original: Vec<u32>,
    /// One bit a cell, 32 a word, lowest first: the ascending vertices are an odd permutation of oriented ones.
    odd: Vec<u32>,
    /// Made when first asked for: not every engine does.
    crossings: OnceLock<Vec<Crossing>>,
}

impl LinkedMesh {
    /// The link of a boundary face.
    pub const NO_LINK: u32 = u32::MAX;

    /// Mesh units: walks of one ray that overlap by less are said to meet.
    pub const TOUCH: f32 = 1e-5;

    /// Finds neighbours and the boundary, and reorders. Needs about 100 bytes a tetrahedron while at work.
    pub fn new(mesh: &TetMesh) -> Self {
        let order = morton_order(mesh);
        let mut place = vec![0_u32; order.len()];
        (0_u32..).zip(&order).for_each(|(new, &old)| place[old as usize] = new);
        let (number, original) = vertex_order(mesh, &order);
        let neighbors = Adjacency::new(mesh).neighbors;
        let vertices_of = |old: u32| mesh.tets[old as usize].map(|v| number[v as usize]);
        let cell = |&old: &u32| {
            let (oriented, across) = (vertices_of(old), &neighbors[old as usize]);
            let (corners, odd) = ascending(oriented);
            let link = |opposite: u32| {
                let corner = corners[opposite as usize];
                let next = across[corner];
                if next == NO_TET {
                    return Self::NO_LINK;
                }
                let (theirs, is_other_odd) = sorted(vertices_of(next));
                let on_face = |v: u32| v != oriented[corner] && oriented.contains(&v);
                let new = (0..4_u32).find(|&i| !on_face(theirs[i as usize])).unwrap_or_default();
                let there = place[next as usize];
                // Where cells lie on one side of their face, the mesh is folded: rays leave both through it.
                let is_fold = Side::new(0, opposite, odd).flipped == Side::new(there, new, is_other_odd).flipped;
                if is_fold { Self::NO_LINK } else { there << 2 | new }
            };
            Cell { vertices: corners.map(|corner| oriented[corner]), links: [0, 1, 2, 3].map(link) }
        };
        let cells: Vec<Cell> = order.par_iter().map(cell).collect();
        let odd = order
            .par_chunks(32)
            .map(|cells| {
                let bit = |(i, &old): (u32, &u32)| u32::from(sorted(vertices_of(old)).1) << i;
                (0..).zip(cells).map(bit).sum()
            })
            .collect();
        let (scalar, gradient) = (Axis::of(mesh.scalar_range()), Axis::of(mesh.gradient_range()));
        let (vertices, gradients, boundary, crossings) = Default::default();
        let mut linked = Self { cells, vertices, gradients, boundary, scalar, gradient, original, odd, crossings };
        linked.take_places(mesh);
        linked.boundary = Boundary::new(&linked.cells, |cell| linked.is_odd(cell), &linked.vertices);
        linked
    }

    /// Whether a cell's vertices, ascending, are oriented negatively.
    pub fn is_odd(&self, cell: u32) -> bool {
        self.odd[(cell / 32) as usize] >> (cell % 32) & 1 != 0
    }

    /// Takes places and fields from `next`, which has the tetrahedra of `last`: what a time step changes. Nothing is linked
    /// anew.
    ///
    /// # Errors
    /// [`Error::Asked`] for other tetrahedra.
    pub fn replace(&mut self, last: &TetMesh, next: &TetMesh) -> Result<()> {
        if next.tets != last.tets {
            return Err(Error::Asked(
                "the mesh has other tetrahedra than the one that is to be replaced: make a new renderer".into(),
            ));
        }
        self.take_places(next);
        Ok(())
    }

    fn take_places(&mut self, mesh: &TetMesh) {
        (self.scalar, self.gradient) = (Axis::of(mesh.scalar_range()), Axis::of(mesh.gradient_range()));
        let (scalar, gradient) = (self.scalar, self.gradient);
        let vertex = |&old: &u32| {
            let s = scalar.apply(mesh.scalar[old as usize]);
            mesh.vertices[old as usize].as_vec3().extend(s as f32)
        };
        self.vertices = self.original.par_iter().map(vertex).collect();
        let magnitude = |&old: &u32| gradient.apply(mesh.gradient_magnitude[old as usize]) as f32;
        self.gradients = self.original.par_iter().map(magnitude).collect();
        self.boundary.place(&self.vertices);
    }

    /// Of all cells, mesh units.
    pub fn longest_edge(&self) -> f64 {
        let of_cell = |cell: &Cell| {
            let corners = cell.vertices.map(|v| self.vertices[v as usize].truncate().as_dvec3());
            let edge = |[i, j]: [usize; 2]| corners[i].distance_squared(corners[j]);
            [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]].map(edge).into_iter().fold(0.0, f64::max)
        };
        self.cells.par_iter().map(of_cell).reduce(|| 0.0, f64::max).sqrt()
    }

    /// What lies across the faces of each cell.
    pub fn crossings(&self) -> &[Crossing] {
        self.crossings.get_or_init(|| Crossing::of(&self.cells))
    }

    /// Name and size of each array.
    pub fn sizes(&self) -> [(&'static str, usize); 5] {
        [
            ("cells", size_of_val(&self.cells[..]) + size_of_val(&self.odd[..])),
            ("vertices", size_of_val(&self.vertices[..]) + size_of_val(&self.original[..])),
            ("gradients", size_of_val(&self.gradients[..])),
            ("boundary", self.boundary.bytes()),
            ("crossings", self.crossings.get().map_or(0, |crossings| size_of_val(&crossings[..]))),
        ]
    }
}

/// Corners by ascending vertex, and whether that is an odd permutation.
fn ascending(vertices: [u32; 4]) -> ([usize; 4], bool) {
    let mut corners = [0, 1, 2, 3];
    corners.sort_unstable_by_key(|&corner| vertices[corner]);
    let inversions = (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j))).filter(|&(i, j)| corners[i] > corners[j]);
    (corners, inversions.count() % 2 == 1)
}

fn sorted(vertices: [u32; 4]) -> ([u32; 4], bool) {
    let (corners, odd) = ascending(vertices);
    (corners.map(|corner| vertices[corner]), odd)
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
    use super::*;

    #[test]
    fn bits_are_spread_by_three() {
        assert_eq!(spread(0b1011), 0b001_000_001_001);
        assert_eq!(spread(u64::MAX).count_ones(), 21);
        assert_eq!(spread(1 << 20), 1 << 60);
    }

    #[test]
    fn permutations_are_odd_or_even() {
        assert_eq!(sorted([3, 5, 7, 9]), ([3, 5, 7, 9], false));
        assert_eq!(sorted([5, 3, 7, 9]), ([3, 5, 7, 9], true));
        assert_eq!(sorted([9, 3, 5, 7]), ([3, 5, 7, 9], true));
        assert_eq!(sorted([5, 3, 9, 7]), ([3, 5, 7, 9], false));
    }
}
