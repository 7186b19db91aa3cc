//! VTK's XML formats: VTU, VTI, VTR, VTS, their parallel kinds, and PVD time series.
//!
//! What kind a file is, its root element says; the extension is not believed.

mod array;
mod blocks;
mod document;
mod extent;
mod join;
mod number;
mod parallel;
mod payload;
mod pvd;
mod structured;
mod vtu;
mod weld;

use std::path::Path;

use document::{Document, Source};

use super::{Mesh, ReadOptions};
use crate::error::Result;

/// Reads a file of any VTK XML kind.
pub(super) fn read(path: &Path, options: &ReadOptions) -> Result<Mesh> {
    let source = Source::open(path)?;
    let head = source.head()?;
    let document = Document::parse(&head)?;
    match document.kind() {
        "Collection" => pvd::read(&document, options),
        _ => read_grid(&document, options),
    }
}

/// Reads one grid, whole or in pieces of other files.
fn read_grid(document: &Document<'_>, options: &ReadOptions) -> Result<Mesh> {
    match document.kind() {
        "UnstructuredGrid" => vtu::read(&[document], options, false),
        "ImageData" | "RectilinearGrid" | "StructuredGrid" => structured::read(&[document], options),
        "PUnstructuredGrid" | "PImageData" | "PRectilinearGrid" | "PStructuredGrid" => {
            parallel::read(document, options)
        }
        "Collection" => Err(document.malformed("a time series within a time series")),
        "PolyData" | "PPolyData" => Err(crate::Error::Mesh(format!(
            "a surface (VTK PolyData) has no volume cells: {}",
            document.path.display()
        ))),
        other => Err(document.malformed(format!(
            "VTK data of type `{other}` cannot be read; known are UnstructuredGrid, ImageData, RectilinearGrid, \
             StructuredGrid, their parallel kinds, and Collection"
        ))),
    }
}
