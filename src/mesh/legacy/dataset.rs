//! Points and cells of a legacy VTK file.

use glam::DVec3;

use super::cursor::Cursor;
use super::note;
use crate::error::Result;
use crate::mesh::cells::{self, CellClass};
use crate::mesh::{ReadNote, Topology};

/// What a dataset's keywords said.
#[derive(Default)]
pub(super) struct Dataset {
    kind: Option<Kind>,
    dims: Option<[usize; 3]>,
    origin: Option<[f64; 3]>,
    spacing: Option<[f64; 3]>,
    coordinates: [Vec<f64>; 3],
    points: Vec<f64>,
    /// Ends of the cells in `nodes`.
    ends: Vec<usize>,
    nodes: Vec<f64>,
    types: Vec<f64>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Unstructured,
    Points,
    Structured,
    Rectilinear,
}

/// The dataset as a mesh holds it.
pub(super) struct Grid {
    pub(super) points: Vec<DVec3>,
    pub(super) topology: Topology,
    /// Cells in the file, all shapes.
    pub(super) cells: usize,
    /// Numbers of the cells that were kept, where some were not.
    pub(super) kept: Option<Vec<usize>>,
    pub(super) notes: Vec<ReadNote>,
}

impl Dataset {
    /// Reads what belongs to `keyword`, or returns false where it is not about points and cells.
    pub(super) fn read(&mut self, keyword: &str, cursor: &mut Cursor) -> Result<bool> {
        match keyword {
            "DATASET" => {
                self.kind = Some(match cursor.need("a dataset's type")?.to_ascii_uppercase().as_str() {
                    "UNSTRUCTURED_GRID" => Kind::Unstructured,
                    "STRUCTURED_POINTS" => Kind::Points,
                    "STRUCTURED_GRID" => Kind::Structured,
                    "RECTILINEAR_GRID" => Kind::Rectilinear,
                    "POLYDATA" => return Err(cursor.fail("the file holds a surface (POLYDATA): no volume to render")),
                    other => return Err(cursor.fail(format!("datasets of type {other} are not read"))),
                });
            }
            "DIMENSIONS" => self.dims = Some(three(cursor, "a dimension")?),
            "EXTENT" => {
                for _ in 0..6 {
                    cursor.number::<i64>("an extent")?;
                }
            }
            "ORIGIN" => self.origin = Some(three(cursor, "an origin")?),
            "SPACING" | "ASPECT_RATIO" => self.spacing = Some(three(cursor, "a spacing")?),
            "X_COORDINATES" => self.coordinates[0] = counted(1, cursor)?,
            "Y_COORDINATES" => self.coordinates[1] = counted(1, cursor)?,
            "Z_COORDINATES" => self.coordinates[2] = counted(1, cursor)?,
            "POINTS" => self.points = counted(3, cursor)?,
            "CELLS" => self.cells(cursor)?,
            "CELL_TYPES" => {
                let count = cursor.number("a number of cells")?;
                let block = cursor.block(count, "int")?;
                self.types = cursor.decode(&block)?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// Cells: `n i j k ...` each, or, from version 5, offsets and connectivity.
    fn cells(&mut self, cursor: &mut Cursor) -> Result<()> {
        let (count, size) = (cursor.number("a number of cells")?, cursor.number("a size")?);
        self.ends.clear();
        self.nodes.clear();
        if cursor.next_line_begins("OFFSETS") {
            cursor.take("OFFSETS");
            let kind = cursor.need("a number type")?;
            let block = cursor.block(count, &kind)?;
            let offsets = cursor.decode(&block)?;
            if !cursor.take("CONNECTIVITY") {
                return Err(cursor.fail("CONNECTIVITY does not follow OFFSETS"));
            }
            let kind = cursor.need("a number type")?;
            let block = cursor.block(size, &kind)?;
            self.nodes = cursor.decode(&block)?;
            return self.ends_of_offsets(&offsets, cursor);
        }
        let block = cursor.block(size, "int")?;
        let list = cursor.decode(&block)?;
        let mut rest = &list[..];
        // Every cell takes at least one number, so that `count` is at most `size`, which was there.
        for cell in 0..count {
            let taken = rest.split_first().and_then(|(n, rest)| {
                let n = if *n >= 0.0 { *n as usize } else { usize::MAX };
                (n <= rest.len()).then(|| rest.split_at(n))
            });
            let Some((nodes, after)) = taken else {
                return Err(cursor.fail(format!("cell {cell} of {count} runs past the {size} numbers of all cells")));
            };
            self.nodes.extend(nodes);
            self.ends.push(self.nodes.len());
            rest = after;
        }
        Ok(())
    }

    fn ends_of_offsets(&mut self, offsets: &[f64], cursor: &Cursor) -> Result<()> {
        let mut last = 0;
        for (i, offset) in offsets.iter().enumerate() {
            let end = *offset as usize;
            if !(*offset >= 0.0 && end >= last && end <= self.nodes.len()) || (i == 0 && end != 0) {
                let size = self.nodes.len();
                return Err(cursor.fail(format!("offset {i} of the cells is {offset}, after {last}, of {size} nodes")));
            }
            last = end;
            self.ends.extend((i > 0).then_some(end));
        }
        Ok(())
    }

    /// Checks everything and puts it together. `point_ghosts` and `cell_ghosts` are VTK's marks, or empty.
    pub(super) fn finish(self, cursor: &Cursor, point_ghosts: &[u8], cell_ghosts: &[u8]) -> Result<Grid> {
        let grid = match self.kind {
            None => return Err(cursor.fail("the file has no DATASET")),
            Some(Kind::Unstructured) => self.unstructured(cursor, cell_ghosts)?,
            Some(kind) => self.structured(kind, cursor, point_ghosts, cell_ghosts)?,
        };
        match grid.points.iter().position(|p| !p.is_finite()) {
            Some(i) => Err(cursor.fail(format!("point {i} has a coordinate that is not finite: {}", grid.points[i]))),
            None => Ok(grid),
        }
    }

    fn structured(self, kind: Kind, cursor: &Cursor, point_ghosts: &[u8], cell_ghosts: &[u8]) -> Result<Grid> {
        let dims = self.dims.ok_or_else(|| cursor.fail("the grid has no DIMENSIONS"))?;
        let size = dims.map(|n| n.to_string()).join("x");
        if dims.iter().any(|n| *n < 2) {
            return Err(cursor.fail(format!("a grid of {size} points has no volume: at least 2 along each axis")));
        }
        let count = dims.iter().try_fold(1_usize, |n, d| n.checked_mul(*d)).filter(|n| u32::try_from(*n).is_ok());
        let count = count.ok_or_else(|| cursor.fail(format!("{size} points are beyond 2^32")))?;
        let points = match kind {
            Kind::Structured if self.points.len() == 3 * count => positions(&self.points),
            Kind::Structured => {
                return Err(cursor.fail(format!("{size} points promised, and {} there", self.points.len() / 3)));
            }
            Kind::Rectilinear if self.coordinates.each_ref().map(Vec::len) != dims => {
                let lengths = self.coordinates.map(|c| c.len());
                return Err(cursor.fail(format!("{size} points promised, and {lengths:?} coordinates there")));
            }
            // Nothing else proves that there is an array for so many points: the smallest has a bit for each.
            _ if !cursor.holds(count / 16) => {
                return Err(cursor.fail(format!("{size} points promised, more than the file can have values for")));
            }
            Kind::Rectilinear => lattice(dims, |i| {
                DVec3::new(self.coordinates[0][i[0]], self.coordinates[1][i[1]], self.coordinates[2][i[2]])
            }),
            _ => {
                let origin = DVec3::from_array(self.origin.unwrap_or_default());
                let spacing = DVec3::from_array(self.spacing.unwrap_or([1.0; 3]));
                lattice(dims, |i| origin + spacing * DVec3::from_array(i.map(|k| k as f64)))
            }
        };
        let hidden = |marks: &[u8], mask: u8| marks.iter().filter(|m| **m & mask != 0).count();
        let mut blank = Vec::new();
        if point_ghosts.len() == count && hidden(point_ghosts, ghost::HIDDEN_POINT) > 0 {
            blank = point_ghosts.iter().map(|m| m & ghost::HIDDEN_POINT != 0).collect();
        }
        let mut notes = Vec::new();
        match hidden(cell_ghosts, ghost::LEFT_OUT) {
            0 => {}
            n => notes.push(note("Ghost or hidden cells of a structured grid were kept", n)),
        }
        let topology = Topology::Structured { points: dims, blank };
        Ok(Grid { points, cells: topology.cell_count(), topology, kept: None, notes })
    }

    fn unstructured(self, cursor: &Cursor, cell_ghosts: &[u8]) -> Result<Grid> {
        let (points, cells) = (positions(&self.points), self.ends.len());
        if u32::try_from(points.len()).is_err() {
            return Err(cursor.fail(format!("{} points are beyond 2^32", points.len())));
        }
        if self.types.len() != cells {
            return Err(cursor.fail(format!("{cells} cells, and {} cell types", self.types.len())));
        }
        let (mut kinds, mut nodes, mut kept, mut left_out) = (Vec::new(), Vec::new(), Vec::new(), LeftOut::default());
        let mut start = 0;
        for (cell, (&end, &code)) in self.ends.iter().zip(&self.types).enumerate() {
            let list = &self.nodes[start..end];
            start = end;
            if cell_ghosts.len() == cells && cell_ghosts[cell] & ghost::LEFT_OUT != 0 {
                left_out.ghosts += 1;
                continue;
            }
            let CellClass::Volume { kind, nodes: length } = cells::classify(code as u64) else {
                left_out.add(code);
                continue;
            };
            if !length.allows(list.len()) {
                let what = format!("cell {cell} of VTK type {code} has {} nodes instead of {length}", list.len());
                return Err(cursor.fail(what));
            }
            for node in &list[..kind.node_count()] {
                if !(*node >= 0.0 && *node < points.len() as f64 && node.fract() == 0.0) {
                    return Err(
                        cursor.fail(format!("cell {cell} has the node {node}, and there are {} points", points.len()))
                    );
                }
                nodes.push(*node as u32);
            }
            left_out.quadratic += usize::from(list.len() > kind.node_count());
            kinds.push(kind);
            kept.push(cell);
        }
        let kept = (kept.len() < cells).then_some(kept);
        Ok(Grid { points, topology: Topology::Cells { kinds, nodes }, cells, kept, notes: left_out.notes() })
    }
}

/// Bits of VTK's ghost marks (vtkDataSetAttributes.h).
mod ghost {
    pub(super) const HIDDEN_POINT: u8 = 2;
    /// A copy of another piece's cell (1), or hidden (32).
    pub(super) const LEFT_OUT: u8 = 1 | 32;
}

/// Counts of cells that are not read as they stand.
#[derive(Default)]
struct LeftOut {
    ghosts: usize,
    flat: usize,
    polyhedra: usize,
    other: usize,
    quadratic: usize,
}

impl LeftOut {
    fn add(&mut self, code: f64) {
        match code as i64 {
            // Points, lines, polygons, and their quadratic kin; Lagrange and Bezier curves and surfaces.
            0..=9 | 21..=23 | 28 | 30 | 34..=36 | 68..=70 | 75..=77 => self.flat += 1,
            42 => self.polyhedra += 1,
            _ => self.other += 1,
        }
    }

    fn notes(&self) -> Vec<ReadNote> {
        let all = [
            (self.ghosts, "Ghost or hidden cells were left out"),
            (self.flat, "Points, lines and surface cells were left out"),
            (self.polyhedra, "Polyhedra were left out: they are not rendered"),
            (self.other, "Cells of other shapes were left out: they are not rendered"),
            (self.quadratic, "Quadratic cells are read by their corner nodes"),
        ];
        all.into_iter().filter(|(n, _)| *n > 0).map(|(n, text)| note(text, n)).collect()
    }
}

fn three<T: std::str::FromStr + Copy + Default>(cursor: &mut Cursor, what: &str) -> Result<[T; 3]> {
    let mut numbers = [T::default(); 3];
    for number in &mut numbers {
        *number = cursor.number(what)?;
    }
    Ok(numbers)
}

/// `N type`, then `N * components` numbers.
fn counted(components: usize, cursor: &mut Cursor) -> Result<Vec<f64>> {
    let count: usize = cursor.number("a number of tuples")?;
    let kind = cursor.need("a number type")?;
    let count = count.checked_mul(components).ok_or_else(|| cursor.fail(format!("{count} tuples cannot be")))?;
    let block = cursor.block(count, &kind)?;
    cursor.decode(&block)
}

fn positions(numbers: &[f64]) -> Vec<DVec3> {
    numbers.as_chunks::<3>().0.iter().map(|p| DVec3::from_array(*p)).collect()
}

fn lattice(dims: [usize; 3], at: impl Fn([usize; 3]) -> DVec3) -> Vec<DVec3> {
    let mut points = Vec::with_capacity(dims.iter().product());
    for k in 0..dims[2] {
        for j in 0..dims[1] {
            points.extend((0..dims[0]).map(|i| at([i, j, k])));
        }
    }
    points
}
