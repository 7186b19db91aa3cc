//! Legacy VTK files, ascii and binary (big endian), file versions 1 to 5.1.
//!
//! The format is a sequence of keywords: `dataset` reads points and cells, `attributes` the arrays, both from a
//! `cursor`. Arrays are found first and decoded only where wanted.

mod attributes;
mod cursor;
mod dataset;

use std::path::Path;

use self::attributes::Attributes;
use self::cursor::Cursor;
use self::dataset::Dataset;
use super::{Association, DataArray, Mesh, ReadNote, ReadOptions};
use crate::error::{Error, Result};

/// Reads an unstructured grid, structured points, or a structured or rectilinear grid.
///
/// Quadratic cells give their corner nodes. Points that a `vtkGhostType` array hides are blank in structured grids;
/// cells that it hides or marks as copies are left out of unstructured ones.
///
/// # Errors
/// Files that are not of this format, hold surfaces or no volume, are cut short, or have counts, indices or
/// coordinates that cannot be. The message tells the line (ascii) or byte (binary).
pub fn read(path: &Path, options: &ReadOptions) -> Result<Mesh> {
    let bytes = std::fs::read(path).map_err(|e| Error::io(path, e))?;
    let mut cursor = Cursor::new(path, &bytes)?;
    let (mut dataset, mut found) = (Dataset::default(), Attributes::default());
    while let Some(keyword) = cursor.word() {
        let keyword = keyword.to_ascii_uppercase();
        let known = dataset.read(&keyword, &mut cursor)? || found.read(&keyword, &mut cursor)?;
        if !known {
            return Err(cursor.fail(format!("{:?} is no keyword of a legacy VTK file", cursor::shown(&keyword))));
        }
    }
    let ghosts = |association| found.ghosts(association, &cursor);
    let mut grid = dataset.finish(&cursor, &ghosts(Association::Point)?, &ghosts(Association::Cell)?)?;
    let mut notes = std::mem::take(&mut grid.notes);
    found.keep(grid.points.len(), grid.cells, &cursor, &mut notes)?;
    let available = found.available();
    let mut arrays = Vec::new();
    let blocks: Vec<_> = found.blocks().collect();
    for i in options.arrays.select(&available)? {
        let (info, block) = (&available[i], blocks[i]);
        let mut values = cursor.decode(block)?;
        if let (Association::Cell, Some(kept)) = (info.association, &grid.kept) {
            let n = info.components;
            values = kept.iter().flat_map(|c| &values[c * n..(c + 1) * n]).copied().collect();
        }
        let (name, association, components) = (info.name.clone(), info.association, info.components);
        arrays.push(DataArray { name, association, components, values });
    }
    Ok(Mesh { points: grid.points, topology: grid.topology, arrays, available, notes })
}

fn note(text: impl Into<String>, count: usize) -> ReadNote {
    ReadNote { text: text.into(), count: count as u64 }
}
