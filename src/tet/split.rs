//! Cells into tetrahedra, so that two cells that share a face cut it along the same diagonal.

use crate::mesh::CellKind;

/// How hexahedra are cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HexSplit {
    /// Six tetrahedra each, for every mesh. On structured grids this is Kuhn's split along the 000-111 diagonal.
    #[default]
    Six,
    /// Five tetrahedra each, mirrored in every other cell. Structured grids only: no other mesh need have such a
    /// two-colouring.
    FiveAlternating,
}

/// The tetrahedra of one cell, at most six.
pub(crate) struct Pieces {
    tets: [[u32; 4]; 6],
    len: usize,
}

impl Pieces {
    fn new() -> Self {
        Self { tets: [[0; 4]; 6], len: 0 }
    }

    fn push(&mut self, tet: [u32; 4]) {
        self.tets[self.len] = tet;
        self.len += 1;
    }

    pub(crate) fn as_slice(&self) -> &[[u32; 4]] {
        &self.tets[..self.len]
    }
}

// Faces, counter-clockwise seen from outside where the first face's nodes run counter-clockwise seen from the opposite
// node or face (VTK's parametric coordinates; its wedges also come the other way round, which orientation repair mends).
const PYRAMID: &[&[u8]] = &[&[0, 3, 2, 1], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]];
const WEDGE: &[&[u8]] = &[&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]];
const HEXAHEDRON: &[&[u8]] =
    &[&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];
const HEXAHEDRON_FROM_VOXEL: [usize; 8] = [0, 1, 3, 2, 4, 5, 7, 6];

/// Cuts a cell into cones: its smallest node id is joined to every triangle of the faces that do not hold it, each
/// quadrilateral cut from its own smallest id. A face's diagonal depends on the face's ids alone, so neighbours agree
/// whatever their shapes (the rule of Dompierre, Labbe, Vallet and Camarero 1999, *How to subdivide pyramids, prisms,
/// and hexahedra into tetrahedra*; their variant with five tetrahedra, possible for some numberings of a hexahedron,
/// is not used: always six here). Two tetrahedra a pyramid, three a wedge.
///
/// Where a cell names a node twice (a hexahedron collapsed to a wedge), the tetrahedra that do so are made too.
pub(crate) fn split(kind: CellKind, nodes: &[u32]) -> Pieces {
    match kind {
        CellKind::Tetrahedron => {
            let mut pieces = Pieces::new();
            pieces.push([nodes[0], nodes[1], nodes[2], nodes[3]]);
            pieces
        }
        CellKind::Pyramid => cone(nodes, PYRAMID),
        CellKind::Wedge => cone(nodes, WEDGE),
        CellKind::Hexahedron => cone(nodes, HEXAHEDRON),
        CellKind::Voxel => cone(&HEXAHEDRON_FROM_VOXEL.map(|i| nodes[i]), HEXAHEDRON),
    }
}

fn cone(nodes: &[u32], faces: &[&[u8]]) -> Pieces {
    let apex = (0..nodes.len()).min_by_key(|&i| nodes[i]).unwrap_or(0);
    let mut pieces = Pieces::new();
    for face in faces.iter().filter(|face| !face.contains(&(apex as u8))) {
        let id = |i: usize| nodes[face[i % face.len()] as usize];
        if face.len() == 3 {
            pieces.push([nodes[apex], id(0), id(1), id(2)]);
        } else {
            let i = (0..4).min_by_key(|&i| id(i)).unwrap_or(0);
            pieces.push([nodes[apex], id(i), id(i + 1), id(i + 2)]);
            pieces.push([nodes[apex], id(i), id(i + 2), id(i + 3)]);
        }
    }
    pieces
}

const FIVE_EVEN: [[usize; 4]; 5] = [[1, 2, 0, 5], [3, 0, 2, 7], [4, 7, 5, 0], [6, 5, 7, 2], [0, 2, 7, 5]];
const FIVE_ODD: [[usize; 4]; 5] = [[0, 3, 4, 1], [2, 1, 6, 3], [5, 6, 1, 4], [7, 4, 3, 6], [1, 3, 4, 6]];

/// Cuts four corners off a hexahedron of a structured grid, the other four where its i + j + k is `odd`, so that
/// neighbours agree.
pub(super) fn split_in_five(nodes: &[u32], odd: bool) -> Pieces {
    let mut pieces = Pieces::new();
    for tet in if odd { &FIVE_ODD } else { &FIVE_EVEN } {
        pieces.push(tet.map(|i| nodes[i]));
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn six_volumes(pieces: &Pieces, at: &[DVec3]) -> Vec<f64> {
        let v6 = |t: &[u32; 4]| {
            let [a, b, c, d] = t.map(|i| at[i as usize]);
            (b - a).cross(c - a).dot(d - a)
        };
        pieces.as_slice().iter().map(v6).collect()
    }

    fn unit_cube() -> [DVec3; 8] {
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
            .map(|p| DVec3::from_array(p.map(f64::from)))
    }

    #[test]
    fn both_halves_of_five_fill_the_cube_positively() {
        let at = unit_cube();
        for odd in [false, true] {
            let v6 = six_volumes(&split_in_five(&[0, 1, 2, 3, 4, 5, 6, 7], odd), &at);
            assert!(v6.iter().all(|&v| v > 0.0), "{odd} {v6:?}");
            assert_eq!(v6.iter().sum::<f64>(), 6.0);
        }
    }

    #[test]
    fn every_numbering_of_each_shape_is_filled_positively() {
        let cube = unit_cube();
        let shapes: [(CellKind, Vec<DVec3>, f64); 4] = [
            (CellKind::Hexahedron, cube.to_vec(), 6.0),
            (CellKind::Voxel, HEXAHEDRON_FROM_VOXEL.map(|i| cube[i]).to_vec(), 6.0),
            (CellKind::Wedge, [0, 1, 3, 4, 5, 7].map(|i| cube[i]).to_vec(), 3.0),
            (CellKind::Pyramid, [0, 1, 2, 3, 5].map(|i| cube[i]).to_vec(), 2.0),
        ];
        for (kind, corners, volume) in shapes {
            let n = corners.len() as u32;
            // Enough numberings to put every corner first and every diagonal both ways.
            for step in [1, 3, 5, 7] {
                for shift in 0..n {
                    let ids: Vec<u32> = (0..n).map(|i| ((i * step) % 11 * 13 + shift * 29) % 31).collect();
                    let mut at = vec![DVec3::ZERO; 31];
                    ids.iter().zip(&corners).for_each(|(&id, &p)| at[id as usize] = p);
                    let v6 = six_volumes(&split(kind, &ids), &at);
                    assert!(v6.iter().all(|&v| v > 0.0), "{kind:?} {ids:?} {v6:?}");
                    assert_eq!(v6.iter().sum::<f64>(), volume, "{kind:?} {ids:?}");
                }
            }
        }
    }
}
