//! Parallel files: a list of pieces, each a file of its own.

use std::path::PathBuf;

use super::document::{Document, Head, Source, children};
use super::{structured, vtu};
use crate::error::{Error, Result};
use crate::mesh::{Mesh, ReadOptions};

/// Reads all pieces that a PVTU, PVTI, PVTR or PVTS file names, as one mesh.
pub(super) fn read(document: &Document<'_>, options: &ReadOptions) -> Result<Mesh> {
    let sources: Result<Vec<&str>> =
        children(document.grid()?, "Piece").map(|piece| document.attribute(piece, "Source")).collect();
    let paths: Vec<PathBuf> = sources?.into_iter().map(|source| beside(document, source)).collect();
    let kind = document.kind().trim_start_matches('P').to_owned();
    read_pieces(&paths, &kind, options)
}

/// A path as a file names it: from its own folder.
pub(super) fn beside(document: &Document<'_>, name: &str) -> PathBuf {
    document.path.parent().unwrap_or_else(|| "".as_ref()).join(name)
}

/// Reads files that all must be of one `kind` as one mesh.
pub(super) fn read_pieces(paths: &[PathBuf], kind: &str, options: &ReadOptions) -> Result<Mesh> {
    if paths.is_empty() {
        return Err(Error::Mesh("no volume cells: the file names no pieces".into()));
    }
    let sources: Vec<Source<'_>> = paths.iter().map(|path| Source::open(path)).collect::<Result<_>>()?;
    let heads: Vec<Head<'_>> = sources.iter().map(Source::head).collect::<Result<_>>()?;
    let documents: Vec<Document<'_>> = heads.iter().map(Document::parse).collect::<Result<_>>()?;
    if let Some(other) = documents.iter().find(|d| d.kind() != kind) {
        return Err(other.malformed(format!("a piece of type `{}` where `{kind}` is expected", other.kind())));
    }
    let documents: Vec<&Document<'_>> = documents.iter().collect();
    match kind {
        "UnstructuredGrid" => vtu::read(&documents, options, true),
        _ => structured::read(&documents, options),
    }
}
