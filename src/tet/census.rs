//! What was read, made, dropped, repaired or odd, with a count and a first example each.

use std::fmt;

use serde::Serialize;

use super::cells::Cells;
use crate::mesh::CellKind;

/// How often something was found, and where first.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// How often.
    pub count: u64,
    /// The first one, as `cell 17` (indices from 0, in the file's order, unless the text says otherwise).
    pub first: Option<String>,
}

impl Finding {
    pub(super) fn of(count: u64, first: Option<String>) -> Self {
        Self { count, first }
    }
}

/// A count and the smallest index, while counting.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    pub count: u64,
    first: Option<usize>,
}

impl Tally {
    pub(super) fn add(&mut self, index: usize) {
        self.count += 1;
        self.first = Some(self.first.map_or(index, |first| first.min(index)));
    }

    pub(super) fn merge(self, other: Self) -> Self {
        let first = match (self.first, other.first) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        Self { count: self.count + other.count, first }
    }

    pub(super) fn finding(self, noun: &str) -> Finding {
        Finding::of(self.count, self.first.map(|i| format!("{noun} {i}")))
    }
}

/// Cells of one shape.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct KindCount {
    /// `tetrahedra`, `hexahedra`, ...
    pub kind: &'static str,
    /// How many.
    pub count: u64,
}

/// What became of a mesh's cells and points.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Census {
    /// The field that was taken, as it can be asked for.
    pub field: String,
    /// Points read.
    pub points: u64,
    /// Cells read, blanked ones left out, by shape; shapes that do not occur are missing.
    pub cells: Vec<KindCount>,
    /// Cells that a structured grid's blanking leaves out.
    pub blanked_cells: Finding,
    /// Cells left out because the field is not finite there.
    pub non_finite_cells: Finding,
    /// Tetrahedra cut from the cells, before any was dropped.
    pub tets_made: u64,
    /// Tetrahedra dropped because they name a node twice.
    pub repeated_node: Finding,
    /// Tetrahedra dropped because their volume cannot be told from zero in f64.
    pub zero_volume: Finding,
    /// Tetrahedra whose negative orientation was repaired by exchanging two vertices.
    pub reoriented: Finding,
    /// Cells cut into tetrahedra of both orientations: a folded cell, whose repaired tetrahedra overlap others.
    pub folded_cells: Finding,
    /// Tetrahedra kept.
    pub tets: u64,
    /// Points that no kept tetrahedron uses.
    pub unused_points: Finding,
    /// Points merged, because that was asked for, with an earlier one at exactly their place.
    pub merged_points: Finding,
    /// Used points at exactly the position of an earlier used point; they are not merged.
    pub coincident_points: Finding,
    /// The file's point of each vertex.
    #[serde(skip)]
    pub points_of_vertices: Vec<u32>,
    /// The file's volume cells, blanked ones included.
    #[serde(skip)]
    pub cell_count: u64,
    /// What the reader left out or guessed and how the field was made, one sentence each.
    pub notes: Vec<String>,
}

/// Number of cells of each shape.
pub(super) fn count_kinds(cells: &Cells<'_>) -> Vec<KindCount> {
    const KINDS: [(CellKind, &str); 5] = [
        (CellKind::Tetrahedron, "tetrahedra"),
        (CellKind::Pyramid, "pyramids"),
        (CellKind::Wedge, "wedges"),
        (CellKind::Hexahedron, "hexahedra"),
        (CellKind::Voxel, "voxels"),
    ];
    let mut counts = [0; KINDS.len()];
    cells.for_each(|cell| counts[cell.kind as usize] += 1);
    let named = KINDS.iter().map(|&(kind, name)| KindCount { kind: name, count: counts[kind as usize] });
    named.filter(|k| k.count > 0).collect()
}

/// `1234567` as `1,234,567`.
fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

pub(crate) fn write_count(f: &mut fmt::Formatter<'_>, label: &str, count: u64) -> fmt::Result {
    writeln!(f, "{label:<38}{:>14}", grouped(count))
}

pub(crate) fn write_finding(f: &mut fmt::Formatter<'_>, label: &str, finding: &Finding) -> fmt::Result {
    match &finding.first {
        Some(first) => writeln!(f, "{label:<38}{:>14}  first: {first}", grouped(finding.count)),
        None => write_count(f, label, finding.count),
    }
}

impl fmt::Display for Census {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<38}  {}", "field", self.field)?;
        write_count(f, "points", self.points)?;
        write_finding(f, "  used by no tetrahedron: removed", &self.unused_points)?;
        if self.merged_points.count > 0 {
            write_finding(f, "  at an earlier point's place: merged", &self.merged_points)?;
        }
        write_finding(f, "  at an earlier point's place: kept", &self.coincident_points)?;
        for kind in &self.cells {
            write_count(f, kind.kind, kind.count)?;
        }
        write_finding(f, "cells blanked: left out", &self.blanked_cells)?;
        write_finding(f, "cells without finite field: left out", &self.non_finite_cells)?;
        write_finding(f, "cells folded: parts overlap", &self.folded_cells)?;
        write_count(f, "tetrahedra made", self.tets_made)?;
        write_finding(f, "  a node twice: dropped", &self.repeated_node)?;
        write_finding(f, "  zero volume: dropped", &self.zero_volume)?;
        write_finding(f, "  negative orientation: repaired", &self.reoriented)?;
        write_count(f, "tetrahedra kept", self.tets)?;
        for note in &self.notes {
            writeln!(f, "note: {note}")?;
        }
        Ok(())
    }
}
