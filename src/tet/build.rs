//! From what the file said to a [`TetMesh`]: every promise of that type is made true here.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::cells::{Cell, Cells};
use super::census::{Census, Tally, count_kinds};
use super::field::{Field, FieldChoice};
use super::geometry::orientation;
use super::split::{HexSplit, split, split_in_five};
use super::weld::coincident;
use super::{MAX_TETS, TetMesh};
use crate::error::{Error, Result};
use crate::mesh::{Mesh, ReadNote};
use crate::space::Bounds;

/// How a mesh is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BuildOptions {
    /// How hexahedra are cut.
    pub hex_split: HexSplit,
    /// Merge points at exactly one place, which then have the first one's value: closes slits between blocks.
    pub weld: bool,
}

impl From<HexSplit> for BuildOptions {
    fn from(hex_split: HexSplit) -> Self {
        Self { hex_split, ..Self::default() }
    }
}

impl TetMesh {
    /// Cuts a mesh's cells into tetrahedra and computes what a renderer needs of them.
    ///
    /// Hexahedra, wedges and pyramids are cut so that neighbours agree on the diagonals of shared faces: each face is
    /// cut from its smallest point index (see [`HexSplit`] for the alternative on structured grids). Left out and
    /// counted in the [`Census`]: blanked cells, cells where the field is not finite, tetrahedra that name a node
    /// twice, tetrahedra whose volume cannot be told from zero in f64 (the sign of a kept one's is certain), points
    /// that nothing uses. Negative tetrahedra get two vertices exchanged. Points at one place are not merged unless
    /// [`BuildOptions::weld`] asks for it.
    ///
    /// # Errors
    /// [`Error::Asked`] where there is no such field, or where five tetrahedra are asked for cells that are not a
    /// structured grid's; [`Error::Mesh`] where the mesh contradicts itself, holds coordinates that are not finite,
    /// or where nothing is left, or more than can be indexed.
    pub fn new(mesh: Mesh, choice: &FieldChoice, options: impl Into<BuildOptions>) -> Result<(Self, Census)> {
        Self::build(mesh, choice, options.into())
    }

    fn build(mesh: Mesh, choice: &FieldChoice, options: BuildOptions) -> Result<(Self, Census)> {
        let BuildOptions { hex_split, weld } = options;
        let Mesh { points, topology, arrays, available, notes } = mesh;
        let mut cells = Cells::new(&topology, points.len())?;
        if hex_split == HexSplit::FiveAlternating && !cells.is_structured() {
            return Err(Error::Asked(
                "five tetrahedra a hexahedron need a structured grid, and this mesh has explicit cells: ask for six"
                    .into(),
            ));
        }
        let merged = if weld { cells.weld(&points) } else { Tally::default() };
        let field = Field::select(arrays, &available, choice, &cells, points.len())?;
        let mut census = Census {
            field: field.name.clone(),
            points: points.len() as u64,
            cells: count_kinds(&cells),
            cell_count: cells.len() as u64,
            merged_points: merged.finding("point"),
            blanked_cells: cells.blanked().finding("cell"),
            notes: notes.into_iter().map(note_text).chain(field.notes.iter().cloned()).collect(),
            ..Census::default()
        };
        let cut = Cutter { cells: &cells, points: &points, field: &field, hex_split }.cut(&mut census)?;
        let merged = cells.merged_into();
        drop(topology);
        let mesh = compact(cut, &points, &merged, field, &mut census)?;
        Ok((mesh, census))
    }
}

pub(super) fn note_text(note: ReadNote) -> String {
    if note.count == 0 { note.text } else { format!("{} ({})", note.text, note.count) }
}

/// Mesh space within data space.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Frame {
    pub center: DVec3,
    pub data_per_mesh: f64,
}

impl Frame {
    /// Around the marked points: radius (half the box's diagonal) in (0.5, 1].
    fn around(points: &[DVec3], used: &[bool]) -> Result<Self> {
        Self::of(Bounds::of(points.iter().zip(used).filter(|(_, used)| **used).map(|(&p, _)| p)))
    }

    /// Around a box.
    pub(super) fn of(bounds: Bounds) -> Result<Self> {
        let radius = (0.5 * bounds.max - 0.5 * bounds.min).length();
        // Beyond these, volumes and gradients could leave f64's range.
        if !(1e-60..=1e60).contains(&radius) {
            return Err(Error::Mesh(format!(
                "the mesh's cells reach from {} to {}: they fill no space that could be computed with; check the \
                 coordinates, or change their unit",
                bounds.min, bounds.max
            )));
        }
        let mut data_per_mesh = radius.log2().ceil().exp2();
        // log2 rounds: put the radius back where it belongs.
        if radius > data_per_mesh {
            data_per_mesh *= 2.0;
        } else if radius <= 0.5 * data_per_mesh {
            data_per_mesh *= 0.5;
        }
        Ok(Self { center: bounds.center(), data_per_mesh })
    }

    pub(super) fn mesh_from_data(&self, p: DVec3) -> DVec3 {
        (p - self.center) / self.data_per_mesh
    }
}

/// What one chunk of cells gave; nodes still have the file's numbers.
#[derive(Default)]
struct Chunk {
    tets: Vec<[u32; 4]>,
    made: u64,
    non_finite: Tally,
    repeated_node: Tally,
    zero_volume: Tally,
    reoriented: Tally,
    folded: Tally,
}

/// All kept tetrahedra, which points they use, and where mesh space lies.
struct Cut {
    chunks: Vec<Chunk>,
    used: Vec<bool>,
    frame: Frame,
}

struct Cutter<'a> {
    cells: &'a Cells<'a>,
    points: &'a [DVec3],
    field: &'a Field,
    hex_split: HexSplit,
}

impl Cutter<'_> {
    fn cut(&self, census: &mut Census) -> Result<Cut> {
        let mut cut = self.cut_within(self.usable_points()?)?;
        if Frame::around(self.points, &cut.used)? != cut.frame {
            // Dropped cells stuck out. Volumes are judged in mesh space, so once more in the right one.
            cut = self.cut_within(cut.used)?;
        }
        let sum = |of: fn(&Chunk) -> Tally, noun| {
            cut.chunks.iter().map(of).fold(Tally::default(), Tally::merge).finding(noun)
        };
        census.non_finite_cells = sum(|c| c.non_finite, "cell");
        census.repeated_node = sum(|c| c.repeated_node, "in cell");
        census.zero_volume = sum(|c| c.zero_volume, "in cell");
        census.reoriented = sum(|c| c.reoriented, "in cell");
        census.folded_cells = sum(|c| c.folded, "cell");
        census.tets_made = cut.chunks.iter().map(|c| c.made).sum();
        census.tets = cut.chunks.iter().map(|c| c.tets.len() as u64).sum();
        if census.tets > MAX_TETS {
            return Err(Error::Mesh(format!(
                "the mesh gives {} tetrahedra, and at most {MAX_TETS} can be indexed: cut it into parts",
                census.tets
            )));
        }
        Ok(cut)
    }

    /// Points of the cells where the field is finite.
    fn usable_points(&self) -> Result<Vec<bool>> {
        let mut used = vec![false; self.points.len()];
        self.cells.for_each(|cell| {
            if self.is_usable(&cell) {
                cell.nodes.iter().for_each(|&n| used[n as usize] = true);
            }
        });
        if let Some(i) = (0..used.len()).find(|&i| used[i] && !self.points[i].is_finite()) {
            return Err(Error::Mesh(format!(
                "point {i} lies at {}, which is no place: repair the file's coordinates",
                self.points[i]
            )));
        }
        if !used.contains(&true) {
            return Err(Error::Mesh(format!(
                "nothing to show: the mesh has {} volume cells, and {}",
                self.cells.len(),
                if self.cells.len() == 0 {
                    "tetrahedra, pyramids, wedges, hexahedra or voxels are needed".to_owned()
                } else {
                    format!("all are blanked, or have values of {:?} that are not finite", self.field.name)
                }
            )));
        }
        Ok(used)
    }

    fn is_usable(&self, cell: &Cell<'_>) -> bool {
        !self.field.unusable.get(cell.index).is_some_and(|&u| u)
            && cell.nodes.iter().all(|&n| self.field.values[n as usize].is_finite())
    }

    fn cut_within(&self, mut used: Vec<bool>) -> Result<Cut> {
        let frame = Frame::around(self.points, &used)?;
        let chunks: Vec<Chunk> =
            (0..self.cells.chunk_count()).into_par_iter().map(|i| self.cut_chunk(i, &frame)).collect();
        used.fill(false);
        let tets = || chunks.iter().flat_map(|c| &c.tets);
        tets().flatten().for_each(|&n| used[n as usize] = true);
        if tets().next().is_none() {
            return Err(Error::Mesh(format!(
                "nothing to show: all {} tetrahedra are flat or name a node twice",
                chunks.iter().map(|c| c.made).sum::<u64>()
            )));
        }
        Ok(Cut { chunks, used, frame })
    }

    fn cut_chunk(&self, index: usize, frame: &Frame) -> Chunk {
        let mut chunk = Chunk::default();
        self.cells.visit(index, |cell| {
            if !self.is_usable(&cell) {
                chunk.non_finite.add(cell.index);
                return;
            }
            let pieces = match self.hex_split {
                HexSplit::Six => split(cell.kind, cell.nodes),
                HexSplit::FiveAlternating => split_in_five(cell.nodes, cell.odd),
            };
            let [mut positive, mut negative] = [false; 2];
            for &tet in pieces.as_slice() {
                chunk.made += 1;
                if names_twice(tet) {
                    chunk.repeated_node.add(cell.index);
                    continue;
                }
                match orientation(tet.map(|n| frame.mesh_from_data(self.points[n as usize]))) {
                    0 => chunk.zero_volume.add(cell.index),
                    1 => {
                        positive = true;
                        chunk.tets.push(tet);
                    }
                    _ => {
                        negative = true;
                        chunk.reoriented.add(cell.index);
                        chunk.tets.push([tet[0], tet[1], tet[3], tet[2]]);
                    }
                }
            }
            if positive && negative {
                chunk.folded.add(cell.index);
            }
        });
        chunk
    }
}

fn names_twice([a, b, c, d]: [u32; 4]) -> bool {
    a == b || a == c || a == d || b == c || b == d || c == d
}

/// Removes unused points, keeping the order of the others, and computes the gradients.
fn compact(cut: Cut, points: &[DVec3], merged_into: &[u32], field: Field, census: &mut Census) -> Result<TetMesh> {
    let Cut { chunks, used, frame } = cut;
    let mut unused = Tally::default();
    let mut new_number = vec![0_u32; points.len()];
    let mut kept = Vec::new();
    for (i, number) in new_number.iter_mut().enumerate() {
        if used[i] {
            *number = kept.len() as u32;
            kept.push(i);
        } else if merged_into.get(i).is_none_or(|&first| first as usize == i) {
            unused.add(i);
        }
    }
    census.unused_points = unused.finding("point");
    census.coincident_points = coincident(&kept, points);
    let mut tets = Vec::with_capacity(census.tets as usize);
    for chunk in chunks {
        tets.extend(chunk.tets.into_iter().map(|tet| tet.map(|n| new_number[n as usize])));
    }
    census.points_of_vertices = kept.iter().map(|&i| i as u32).collect();
    let mesh = TetMesh {
        vertices: kept.iter().map(|&i| frame.mesh_from_data(points[i])).collect(),
        center_in_data: frame.center,
        data_per_mesh: frame.data_per_mesh,
        tets: Arc::new(tets),
        scalar: kept.iter().map(|&i| field.values[i]).collect(),
        gradient_magnitude: Vec::new(),
        field: field.name,
    };
    mesh.with_gradients(&census.points_of_vertices)
}
