//! Unstructured grids: one or more pieces of points, cells and arrays.

use glam::DVec3;
use roxmltree::Node;

use super::array::{Array, section};
use super::document::{Document, children};
use super::join::{Joined, Part, common, ghosts};
use super::number::Numbers;
use crate::error::{Error, Result};
use crate::mesh::cells::{CellClass, classify, is_higher_order};
use crate::mesh::notes::Notes;
use crate::mesh::{ArrayInfo, Association, CellKind, DataArray, Mesh, ReadOptions};

/// Cells that another piece holds too (1), or that are hidden (32): vtkDataSetAttributes.h.
pub(super) const GHOST_CELL: u64 = 1 | 32;

/// Reads all pieces of all documents as one mesh; `weld` merges points that pieces of a parallel file share.
pub(super) fn read(documents: &[&Document<'_>], options: &ReadOptions, weld: bool) -> Result<Mesh> {
    let mut notes = Notes::default();
    let mut pieces = Vec::new();
    for &document in documents {
        for node in children(document.grid()?, "Piece") {
            let piece = Piece::new(document, node, &mut notes)?;
            if piece.points > 0 || piece.cells > 0 {
                pieces.push(piece);
            }
        }
    }
    if pieces.is_empty() {
        return Err(Error::Mesh("no volume cells: the file has no points".into()));
    }
    let offers: Vec<Vec<ArrayInfo>> = pieces.iter().map(Piece::offers).collect();
    let available = common(&offers, &mut notes);
    let chosen: Vec<ArrayInfo> = options.arrays.select(&available)?.into_iter().map(|i| available[i].clone()).collect();
    let with_ids = weld && pieces.iter().all(|p| p.global_ids().is_some());
    let mut joined = Joined::new(&chosen);
    for piece in &pieces {
        joined.append(piece.read(&chosen, with_ids, &mut notes)?)?;
    }
    if weld && pieces.len() > 1 {
        joined.weld(&mut notes);
    }
    joined.into_mesh(available, notes)
}

/// A `Piece` element.
struct Piece<'d> {
    document: &'d Document<'d>,
    node: Node<'d, 'd>,
    points: usize,
    cells: usize,
    point_arrays: Vec<Array<'d>>,
    cell_arrays: Vec<Array<'d>>,
}

impl<'d> Piece<'d> {
    fn new(document: &'d Document<'d>, node: Node<'d, 'd>, notes: &mut Notes) -> Result<Self> {
        Ok(Self {
            document,
            node,
            points: document.count(node, "NumberOfPoints")?,
            cells: document.count(node, "NumberOfCells")?,
            point_arrays: section(document, node, "PointData", notes)?,
            cell_arrays: section(document, node, "CellData", notes)?,
        })
    }

    fn offers(&self) -> Vec<ArrayInfo> {
        let points = self.point_arrays.iter().map(|a| a.info(Association::Point));
        points.chain(self.cell_arrays.iter().map(|a| a.info(Association::Cell))).collect()
    }

    /// The point array that numbers the points of all pieces.
    fn global_ids(&self) -> Option<&Array<'d>> {
        let marked = super::document::child(self.node, "PointData").and_then(|n| n.attribute("GlobalIds"));
        let name = marked.unwrap_or("GlobalNodeIds");
        self.point_arrays.iter().find(|a| a.name == name && a.components == 1)
    }

    fn read(&self, chosen: &[ArrayInfo], with_ids: bool, notes: &mut Notes) -> Result<Part> {
        let mut points = self.read_points(notes)?;
        let cells = self.read_cells(notes)?;
        self.check_points(&mut points, &cells.nodes, notes)?;
        let arrays: Result<Vec<DataArray>> = chosen.iter().map(|info| self.read_array(info, &cells)).collect();
        let ids = match self.global_ids() {
            Some(array) if with_ids => Some(array.read(self.document, self.points)?.to_f64()),
            _ => None,
        };
        Ok(Part { points, kinds: cells.kinds, nodes: cells.nodes, arrays: arrays?, ids })
    }

    fn read_points(&self, notes: &mut Notes) -> Result<Vec<DVec3>> {
        let arrays = section(self.document, self.node, "Points", notes)?;
        let array = arrays.first().ok_or_else(|| self.error("it has no array of points"))?;
        if array.components != 3 {
            return Err(array.error(self.document, &format!("points of {} components instead of 3", array.components)));
        }
        let values = array.read(self.document, self.points)?.to_f64();
        Ok(values.as_chunks::<3>().0.iter().map(|p| DVec3::from_array(*p)).collect())
    }

    /// Points that cells use must be finite; others are moved to the origin.
    fn check_points(&self, points: &mut [DVec3], nodes: &[u32], notes: &mut Notes) -> Result<()> {
        if points.iter().all(|p| p.is_finite()) {
            return Ok(());
        }
        if let Some(&node) = nodes.iter().find(|&&n| !points[n as usize].is_finite()) {
            let p = points[node as usize];
            let what = format!("point {node}, which a cell uses, is at ({}, {}, {})", p.x, p.y, p.z);
            return Err(self.error(&what));
        }
        let mut count = 0;
        for p in points.iter_mut().filter(|p| !p.is_finite()) {
            *p = DVec3::ZERO;
            count += 1;
        }
        notes.count(
            "points that no cell uses have coordinates that are no numbers, and were moved to the origin",
            count,
        );
        Ok(())
    }

    fn read_array(&self, info: &ArrayInfo, cells: &Cells) -> Result<DataArray> {
        let (arrays, tuples) = match info.association {
            Association::Point => (&self.point_arrays, self.points),
            Association::Cell => (&self.cell_arrays, self.cells),
        };
        let array = arrays.iter().find(|a| a.name == info.name);
        let array = array.ok_or_else(|| self.error(&format!("it has no array `{}`", info.name)))?;
        let mut values = array.read(self.document, tuples)?.to_f64();
        if info.association == Association::Cell {
            cells.drop_left_out(&mut values, info.components);
        }
        Ok(DataArray { name: info.name.clone(), association: info.association, components: info.components, values })
    }

    fn read_cells(&self, notes: &mut Notes) -> Result<Cells> {
        let arrays = section(self.document, self.node, "Cells", notes)?;
        let named = |name: &str| {
            let array = arrays.iter().find(|a| a.name == name);
            array.ok_or_else(|| self.error(&format!("its cells have no array `{name}`")))
        };
        let (types, offsets, connectivity) = if self.cells == 0 {
            (Numbers::none(), Numbers::none(), Numbers::none())
        } else {
            (
                named("types")?.read(self.document, self.cells)?,
                named("offsets")?.read(self.document, self.cells)?,
                named("connectivity")?.read_any(self.document)?,
            )
        };
        let ghosts = self.read_ghosts()?;
        let mut cells = Cells::with_capacity(self.cells, connectivity.len());
        let mut counts = LeftOut::default();
        let mut start = 0;
        for cell in 0..self.cells {
            let kept = cells.kinds.len();
            let end = self.end(&offsets, cell, start, connectivity.len())?;
            let code = types.index(cell).unwrap_or(u64::MAX);
            match classify(code) {
                CellClass::LeftOut(word) => counts.add(word),
                CellClass::Volume { .. } if ghosts.get(cell) == Some(&true) => counts.ghosts += 1,
                CellClass::Volume { kind, nodes } => {
                    if !nodes.allows(end - start) {
                        let what =
                            format!("cell {cell} of VTK type {code} has {} nodes instead of {nodes}", end - start);
                        return Err(self.error(&what));
                    }
                    counts.higher_order += u64::from(is_higher_order(code));
                    self.push(&mut cells, cell, kind, &connectivity, start)?;
                }
            }
            cells.kept.push(cells.kinds.len() > kept);
            start = end;
        }
        counts.tell(notes);
        cells.close();
        Ok(cells)
    }

    /// Whether each cell is a copy of another piece's, or hidden; empty where the piece does not say.
    fn read_ghosts(&self) -> Result<Vec<bool>> {
        let Some(array) = ghosts(&self.cell_arrays) else { return Ok(Vec::new()) };
        let marks = array.read(self.document, self.cells)?;
        // The older array counts levels away from the piece's own cells.
        let mask = if array.name == "vtkGhostLevels" { u64::MAX } else { GHOST_CELL };
        let is_ghost = |cell| marks.index(cell * array.components).unwrap_or(0) & mask != 0;
        Ok((0..self.cells).map(is_ghost).collect())
    }

    /// Where the nodes of a cell end in the connectivity.
    fn end(&self, offsets: &Numbers<'_>, cell: usize, start: usize, length: usize) -> Result<usize> {
        let end = offsets.index(cell).and_then(|end| usize::try_from(end).ok());
        end.filter(|&end| start <= end && end <= length).ok_or_else(|| {
            let end = end.map_or_else(|| "no index".to_owned(), |end| end.to_string());
            self.error(&format!(
                "cell {cell} is said to end at entry {end} of the connectivity, which must be from {start} to {length}"
            ))
        })
    }

    fn push(
        &self,
        cells: &mut Cells,
        cell: usize,
        kind: CellKind,
        connectivity: &Numbers<'_>,
        start: usize,
    ) -> Result<()> {
        for i in start..start + kind.node_count() {
            let node = connectivity.index(i).filter(|&n| n < self.points as u64).and_then(|n| u32::try_from(n).ok());
            let Some(node) = node else {
                let index = connectivity.index(i).map_or_else(|| "no index".to_owned(), |n| n.to_string());
                let what = format!("node {} of cell {cell} is point {index}, of {} points", i - start, self.points);
                return Err(self.error(&what));
            };
            cells.nodes.push(node);
        }
        cells.kinds.push(kind);
        Ok(())
    }

    /// An error about this piece.
    fn error(&self, what: &str) -> Error {
        let line = self.document.line(self.node.range().start);
        self.document.malformed(format!("piece at line {line}: {what}"))
    }
}

/// The volume cells of a piece.
struct Cells {
    kinds: Vec<CellKind>,
    nodes: Vec<u32>,
    /// Whether each cell of the piece is among `kinds`; empty where all are.
    kept: Vec<bool>,
}

impl Cells {
    fn with_capacity(cells: usize, nodes: usize) -> Self {
        let nodes = nodes.min(cells.saturating_mul(8));
        Self { kinds: Vec::with_capacity(cells), nodes: Vec::with_capacity(nodes), kept: Vec::with_capacity(cells) }
    }

    /// Gives back what is not needed.
    fn close(&mut self) {
        self.nodes.shrink_to_fit();
        if self.kinds.len() == self.kept.len() {
            self.kept = Vec::new();
        }
    }

    fn drop_left_out(&self, values: &mut Vec<f64>, components: usize) {
        if self.kept.is_empty() {
            return;
        }
        let mut i = 0;
        values.retain(|_| {
            i += 1;
            self.kept[(i - 1) / components]
        });
    }
}

/// What is left out of a piece, counted.
#[derive(Default)]
struct LeftOut {
    words: Vec<(&'static str, u64)>,
    ghosts: u64,
    higher_order: u64,
}

impl LeftOut {
    fn add(&mut self, word: &'static str) {
        match self.words.iter_mut().find(|(w, _)| *w == word) {
            Some((_, count)) => *count += 1,
            None => self.words.push((word, 1)),
        }
    }

    fn tell(&self, notes: &mut Notes) {
        self.words.iter().for_each(|(word, count)| notes.count(word, *count));
        notes.count("ghost or hidden cells left out", self.ghosts);
        notes.count("cells of higher order are read by their corner nodes", self.higher_order);
    }
}
