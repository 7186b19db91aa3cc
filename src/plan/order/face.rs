//! Faces as both of their cells see them.

use glam::DVec3;

use crate::plan::order::Vantage;
use crate::tet::{Adjacency, FACES, NO_TET, TetMesh};

/// A face of a cell. Its vertices ascend, so that both cells compute the same bits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub vertices: [u32; 3],
    /// Clockwise seen from outside the cell.
    turned: bool,
}

impl Face {
    /// Opposite a corner.
    pub fn new(tet: [u32; 4], corner: usize) -> Self {
        let [mut a, mut b, mut c] = FACES[corner].map(|i| tet[i]);
        let mut turned = false;
        let mut ascend = |low: &mut u32, high: &mut u32| {
            if *low > *high {
                std::mem::swap(low, high);
                turned = !turned;
            }
        };
        ascend(&mut a, &mut b);
        ascend(&mut b, &mut c);
        ascend(&mut a, &mut b);
        Self { vertices: [a, b, c], turned }
    }

    pub fn corners(&self, mesh: &TetMesh) -> [DVec3; 3] {
        self.vertices.map(|v| mesh.vertices[v as usize])
    }

    /// 1 where the eye sees the face from outside the cell, -1 where it is on the cell's side, 0 where that cannot be
    /// told.
    pub fn side(&self, mesh: &TetMesh, vantage: &Vantage) -> i8 {
        let side = vantage.side(self.corners(mesh));
        if self.turned { -side } else { side }
    }
}

/// What lies across a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Across {
    /// Nothing: rays enter and leave.
    Open,
    /// A cell on the same side: the mesh is folded, and rays enter and leave both cells.
    Fold(u32),
    /// A cell, and its corner that is not on the face.
    Cell(u32, usize),
}

impl Across {
    pub fn new(mesh: &TetMesh, adjacency: &Adjacency, tet: usize, corner: usize, face: &Face) -> Self {
        let neighbor = adjacency.neighbors[tet][corner];
        if neighbor == NO_TET {
            return Self::Open;
        }
        let other = mesh.tets[neighbor as usize];
        let corner = (0..3).find(|&i| !face.vertices.contains(&other[i])).unwrap_or(3);
        if Face::new(other, corner).turned == face.turned { Self::Fold(neighbor) } else { Self::Cell(neighbor, corner) }
    }
}
