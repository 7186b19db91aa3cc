//! The cells of a topology, checked, one after another or in parallel chunks.

use glam::DVec3;
use rayon::prelude::*;

use super::census::Tally;
use super::weld::first_at_place;
use crate::error::{Error, Result};
use crate::mesh::{CellKind, Topology};

const CHUNK: usize = 1 << 15;
/// Of the largest cell, a hexahedron.
const MOST_NODES: usize = 8;

/// One volume cell.
pub(super) struct Cell<'a> {
    /// Index in the file, blanked cells counted.
    pub index: usize,
    pub kind: CellKind,
    pub nodes: &'a [u32],
    /// Parity of i + j + k in a structured grid.
    pub odd: bool,
}

/// All cells that are not blanked. Every node index is below the number of points.
pub(super) struct Cells<'a> {
    topology: &'a Topology,
    /// Where the nodes of every `CHUNK`-th explicit cell begin.
    starts: Vec<usize>,
    /// What each point is merged into, itself if into none; empty where nothing is merged.
    merged_into: Vec<u32>,
}

impl<'a> Cells<'a> {
    pub(super) fn new(topology: &'a Topology, point_count: usize) -> Result<Self> {
        let mut starts = Vec::new();
        match topology {
            Topology::Cells { kinds, nodes } => {
                let named = |kinds: &[CellKind]| kinds.iter().map(|kind| kind.node_count()).sum::<usize>();
                let mut at = 0;
                for count in kinds.par_chunks(CHUNK).map(named).collect::<Vec<_>>() {
                    starts.push(at);
                    at += count;
                }
                if at != nodes.len() {
                    return Err(Error::Mesh(format!("the cells need {at} nodes and {} are given", nodes.len())));
                }
                let highest = |nodes: &[u32]| nodes.iter().fold(0, |highest, &n| n.max(highest));
                let is_beyond = |n: u32| n as usize >= point_count;
                if nodes.par_chunks(CHUNK).any(|nodes| is_beyond(highest(nodes)))
                    && let Some(i) = nodes.iter().position(|&n| is_beyond(n))
                {
                    return Err(Error::Mesh(format!(
                        "a cell names point {} (entry {i} of the cells' nodes) and there are {point_count} points",
                        nodes[i]
                    )));
                }
            }
            Topology::Structured { points, blank } => {
                let product = points.iter().try_fold(1_usize, |n, &p| n.checked_mul(p));
                if points.iter().any(|&n| n < 2) || product != Some(point_count) {
                    return Err(Error::Mesh(format!(
                        "a structured grid of {} x {} x {} points cannot be made of {point_count} points: each axis \
                         needs at least 2",
                        points[0], points[1], points[2]
                    )));
                }
                if u32::try_from(point_count).is_err() {
                    return Err(Error::Mesh(format!("{point_count} points are more than 2^32 - 1: cut the grid")));
                }
                if !blank.is_empty() && blank.len() != point_count {
                    return Err(Error::Mesh(format!("{} blanking marks for {point_count} points", blank.len())));
                }
            }
        }
        Ok(Self { topology, starts, merged_into: Vec::new() })
    }

    /// Merges points at exactly one place: from now on cells name the first of them. Which points are gone.
    pub(super) fn weld(&mut self, points: &[DVec3]) -> Tally {
        let (merged_into, merged) = first_at_place(points, self);
        self.merged_into = merged_into;
        merged
    }

    /// What each point was merged into, itself if into none; empty where nothing was merged.
    pub(super) fn merged_into(self) -> Vec<u32> {
        self.merged_into
    }

    /// Number of cells, blanked ones counted.
    pub(super) fn len(&self) -> usize {
        self.topology.cell_count()
    }

    pub(super) fn is_structured(&self) -> bool {
        matches!(self.topology, Topology::Structured { .. })
    }

    /// Number of pieces for [`Cells::visit`], which together hold all cells in order.
    pub(super) fn chunk_count(&self) -> usize {
        self.len().div_ceil(CHUNK)
    }

    /// Visits every cell that is not blanked, in order.
    pub(super) fn for_each(&self, mut visit: impl FnMut(Cell<'_>)) {
        (0..self.chunk_count()).for_each(|chunk| self.visit(chunk, &mut visit));
    }

    /// Visits the cells of one chunk that are not blanked, in order.
    pub(super) fn visit(&self, chunk: usize, mut visit: impl FnMut(Cell<'_>)) {
        let range = chunk * CHUNK..((chunk + 1) * CHUNK).min(self.len());
        match self.topology {
            Topology::Cells { kinds, nodes } => {
                let mut at = self.starts[chunk];
                for index in range {
                    let kind = kinds[index];
                    let end = at + kind.node_count();
                    let mut named = [0; MOST_NODES];
                    let nodes = self.named(&nodes[at..end], &mut named);
                    visit(Cell { index, kind, nodes, odd: false });
                    at = end;
                }
            }
            Topology::Structured { points, blank } => {
                for index in range {
                    let (nodes, odd) = structured_nodes(index, *points);
                    if !is_blank(&nodes, blank) {
                        let mut named = [0; MOST_NODES];
                        visit(Cell { index, kind: CellKind::Hexahedron, nodes: self.named(&nodes, &mut named), odd });
                    }
                }
            }
        }
    }

    /// The nodes by the points that they are merged into.
    fn named<'n>(&self, nodes: &'n [u32], buffer: &'n mut [u32; MOST_NODES]) -> &'n [u32] {
        if self.merged_into.is_empty() {
            return nodes;
        }
        for (named, &node) in buffer.iter_mut().zip(nodes) {
            *named = self.merged_into[node as usize];
        }
        &buffer[..nodes.len()]
    }

    /// Cells that blanking leaves out.
    pub(super) fn blanked(&self) -> Tally {
        let mut tally = Tally::default();
        if let Topology::Structured { points, blank } = self.topology
            && !blank.is_empty()
        {
            for index in 0..self.len() {
                if is_blank(&structured_nodes(index, *points).0, blank) {
                    tally.add(index);
                }
            }
        }
        tally
    }
}

/// The nodes of a grid's cell in the hexahedron's order, and the parity of i + j + k.
fn structured_nodes(index: usize, points: [usize; 3]) -> ([u32; 8], bool) {
    let [nx, ny, _] = points;
    let (i, j, k) = (index % (nx - 1), index / (nx - 1) % (ny - 1), index / ((nx - 1) * (ny - 1)));
    let b = i + nx * (j + ny * k);
    let top = b + nx * ny;
    let nodes = [b, b + 1, b + 1 + nx, b + nx, top, top + 1, top + 1 + nx, top + nx];
    (nodes.map(|n| n as u32), (i + j + k) % 2 == 1)
}

fn is_blank(nodes: &[u32; 8], blank: &[bool]) -> bool {
    !blank.is_empty() && nodes.iter().any(|&n| blank[n as usize])
}
