//! Cells as rays leave them.

use rayon::prelude::*;

use super::linked::{Cell, LinkedMesh};

/// What lies across each face of a cell: half a cache line. That a link's vertex stands beside it lets a ray ask for the
/// next cell and for its new corner at the same time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C, align(32))]
pub struct Crossing {
    /// As in [`Cell`].
    pub links: [u32; 4],
    /// The next cell's vertex that is not on the face; any on the boundary.
    pub vertices: [u32; 4],
}

impl Crossing {
    /// Of all cells.
    pub(super) fn of(cells: &[Cell]) -> Vec<Self> {
        let vertex = |link: u32| match link {
            LinkedMesh::NO_LINK => 0,
            _ => cells[(link >> 2) as usize].vertices[(link & 3) as usize],
        };
        cells.par_iter().map(|cell| Self { links: cell.links, vertices: cell.links.map(vertex) }).collect()
    }
}
