//! Pieces of the cells near the eye, in an order of the cells.

use std::collections::HashMap;

use crate::plan::near::NearCut;
use crate::plan::order::{VisibilityOrder, mpvonc};
use crate::scene::Camera;
use crate::tet::{Adjacency, TetMesh};

/// The rank of every cell, 0 for the farthest, and from `pieces_start` on of every piece of `cut`: pieces are where
/// their cell was, each after those behind it.
pub fn ranks_with_pieces(
    order: &VisibilityOrder,
    mesh: &TetMesh,
    cut: &NearCut,
    camera: &Camera,
    pieces_start: usize,
) -> Vec<u32> {
    let pieces = pieces_by_cell(mesh, cut, camera);
    let mut of_cell: HashMap<u32, std::ops::Range<usize>> = HashMap::new();
    for (i, &piece) in pieces.iter().enumerate() {
        of_cell.entry(cut.parents[piece as usize]).or_insert(i..i).end = i + 1;
    }
    let mut ranks = vec![0; pieces_start + cut.tets.len()];
    let mut rank = 0;
    for &cell in order.cells() {
        match of_cell.get(&cell) {
            None => {
                ranks[cell as usize] = rank;
                rank += 1;
            }
            Some(range) => {
                for &piece in &pieces[range.clone()] {
                    ranks[pieces_start + piece as usize] = rank;
                    rank += 1;
                }
            }
        }
    }
    ranks
}

/// The pieces by cell, and those of one cell so that each comes after those behind it: they are a convex body together.
fn pieces_by_cell(mesh: &TetMesh, cut: &NearCut, camera: &Camera) -> Vec<u32> {
    let mut vertices = Vec::new();
    // Of the vertices that pieces use.
    let mut number: HashMap<u32, u32> = HashMap::new();
    let mut numbered = |v: u32| {
        *number.entry(v).or_insert_with(|| {
            let made = (v as usize).checked_sub(mesh.vertices.len());
            vertices.push(made.map_or_else(|| mesh.vertices[v as usize], |i| cut.vertices[i].position));
            vertices.len() as u32 - 1
        })
    };
    let tets: Vec<[u32; 4]> = cut.tets.iter().map(|tet| tet.map(&mut numbered)).collect();
    let pieces = TetMesh {
        scalar: vec![0.0; vertices.len()],
        gradient_magnitude: vec![0.0; vertices.len()],
        vertices,
        tets: tets.into(),
        field: String::new(),
        ..*mesh
    };
    let mut order = mpvonc(&pieces, &Adjacency::new(&pieces), camera).order.cells().to_vec();
    // Stable: among a cell's pieces the order stays.
    order.sort_by_key(|&piece| cut.parents[piece as usize]);
    order
}
