//! An order of all cells.

use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::plan::order::{Inversions, Vantage};
use crate::scene::Camera;
use crate::tet::{Adjacency, TetMesh};

/// A permutation of all cells, back to front.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VisibilityOrder {
    cells: Vec<u32>,
}

impl VisibilityOrder {
    /// By one key a cell: the largest key behind; of equal keys the smaller id behind.
    pub fn by_keys(keys: &[f64]) -> Self {
        let mut keyed: Vec<(u64, u32)> = (0..keys.len() as u32).into_par_iter().zip(keys).map(descending).collect();
        keyed.par_sort_unstable();
        Self { cells: keyed.into_par_iter().map(|(_, cell)| cell).collect() }
    }

    /// From a list, the farthest cell first.
    ///
    /// # Errors
    /// [`Error::Asked`] where a cell of `0..cells.len()` is missing.
    pub fn new(cells: Vec<u32>) -> Result<Self> {
        let mut seen = vec![false; cells.len()];
        for (place, &cell) in cells.iter().enumerate() {
            let what = match seen.get_mut(cell as usize).map(|seen| std::mem::replace(seen, true)) {
                Some(false) => continue,
                Some(true) => "comes twice",
                None => "does not exist",
            };
            let count = cells.len();
            return Err(Error::Asked(format!(
                "no order of {count} cells: cell {cell}, at place {place}, {what}: name each of them once"
            )));
        }
        Ok(Self { cells })
    }

    /// Of what is known to hold every cell once.
    pub(in crate::plan) fn of_permutation(cells: Vec<u32>) -> Self {
        debug_assert!(Self::new(cells.clone()).is_ok());
        Self { cells }
    }

    /// Back to front.
    pub fn cells(&self) -> &[u32] {
        &self.cells
    }

    /// The place of each cell, 0 for the farthest.
    pub fn ranks(&self) -> Vec<u32> {
        let mut ranks = vec![0; self.cells.len()];
        (0..).zip(&self.cells).for_each(|(rank, &cell)| ranks[cell as usize] = rank);
        ranks
    }

    /// How many neighbours are in the wrong order for a camera. The order must be of this mesh.
    pub fn inversions(&self, mesh: &TetMesh, adjacency: &Adjacency, camera: &Camera) -> Inversions {
        Inversions::count(mesh, adjacency, &Vantage::new(mesh, camera), &self.ranks())
    }
}

/// An integer that descends as the key ascends, in the order of [`f64::total_cmp`]; then the cell.
fn descending((cell, key): (u32, &f64)) -> (u64, u32) {
    let bits = key.to_bits();
    let ascending = if bits >> 63 == 0 { bits | 1 << 63 } else { !bits };
    (!ascending, cell)
}
