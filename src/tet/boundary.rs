//! The faces of a linked mesh that one cell alone has.

use std::collections::HashMap;

use glam::{DVec3, Vec4};

use super::linked::{Cell, LinkedMesh};

/// All boundary faces.
#[derive(Clone, Debug, Default)]
pub struct Boundary {
    /// Their vertices, as rounded to f32 for rays, so that all mean one geometry.
    pub points: Vec<DVec3>,
    /// The faces.
    pub faces: Vec<BoundaryFace>,
    /// The linked mesh's vertex of each point.
    vertices: Vec<u32>,
}

/// One of them.
#[derive(Clone, Copy, Debug)]
pub struct BoundaryFace {
    /// Of [`Boundary::points`], counter-clockwise seen from outside.
    pub points: [u32; 3],
    /// The side of the cell.
    pub side: Side,
}

/// A face of a cell, with the sense in which it is seen from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// The cell.
    pub cell: u32,
    /// Its corner that is not on the face.
    pub opposite: u32,
    /// Of the face's corners in ascending order, the last two are to be exchanged to be counter-clockwise from outside.
    pub flipped: bool,
}

impl Side {
    /// The side of a cell opposite a corner; `odd`: the cell's corners in ascending order are oriented negatively.
    pub fn new(cell: u32, opposite: u32, odd: bool) -> Self {
        Self { cell, opposite, flipped: (opposite % 2 == 1) != odd }
    }

    /// The face's corners among its own in ascending order, counter-clockwise seen from outside.
    pub fn ranks(self) -> [u32; 3] {
        if self.flipped { [0, 2, 1] } else { [0, 1, 2] }
    }

    /// Eight times the cell, plus twice the opposite corner, plus one where flipped: as shaders read it.
    pub fn packed(self) -> u32 {
        self.cell << 3 | self.opposite << 1 | u32::from(self.flipped)
    }
}

impl Boundary {
    pub(super) fn new(cells: &[Cell], odd: impl Fn(u32) -> bool, vertices: &[Vec4]) -> Self {
        let mut boundary = Self::default();
        let mut numbers = HashMap::new();
        for (number, cell) in (0_u32..).zip(cells) {
            for opposite in (0_u32..4).filter(|&i| cell.links[i as usize] == LinkedMesh::NO_LINK) {
                let side = Side::new(number, opposite, odd(number));
                let corners = side.ranks().map(|rank| cell.vertices[(rank + u32::from(rank >= opposite)) as usize]);
                let points = corners.map(|v| {
                    *numbers.entry(v).or_insert_with(|| {
                        boundary.vertices.push(v);
                        boundary.vertices.len() as u32 - 1
                    })
                });
                boundary.faces.push(BoundaryFace { points, side });
            }
        }
        boundary.place(vertices);
        boundary
    }

    /// Takes the places of its points from the mesh's vertices.
    pub(super) fn place(&mut self, vertices: &[Vec4]) {
        self.points = self.vertices.iter().map(|&v| vertices[v as usize].truncate().as_dvec3()).collect();
    }

    /// Size in memory.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.points[..]) + size_of_val(&self.faces[..]) + size_of_val(&self.vertices[..])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tet::FACES;

    #[test]
    fn sides_are_those_of_oriented_cells() {
        for opposite in 0..4_u32 {
            let ranks = Side::new(0, opposite, false).ranks();
            let corners = ranks.map(|rank| (rank + u32::from(rank >= opposite)) as usize);
            let face = FACES[opposite as usize];
            assert!((0..3).any(|turn| [0, 1, 2].map(|i| face[(i + turn) % 3]) == corners), "{corners:?}");
            let [a, b, c] = Side::new(0, opposite, true).ranks();
            assert_eq!([a, c, b], ranks, "an odd cell's face is seen from the other side");
        }
    }
}
