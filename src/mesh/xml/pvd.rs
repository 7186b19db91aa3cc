//! PVD: a list of files by time.

use super::document::{Document, Source, children};
use super::parallel::{beside, read_pieces};
use super::read_grid;
use crate::error::{Error, Result};
use crate::mesh::{Mesh, ReadNote, ReadOptions};

/// Reads one step of a time series. Steps are numbered from 0 by ascending time; files of the same time are the parts
/// of one step.
pub(super) fn read(document: &Document<'_>, options: &ReadOptions) -> Result<Mesh> {
    let mut entries = Vec::new();
    for node in children(document.grid()?, "DataSet") {
        let time = document.numbers::<f64, 1>(node, "timestep")?.map_or(0.0, |[time]| time);
        entries.push((time, beside(document, document.attribute(node, "file")?)));
    }
    entries.sort_by(|a, b| a.0.total_cmp(&b.0));
    let steps: Vec<_> = entries.chunk_by(|a, b| a.0 == b.0).collect();
    if steps.is_empty() {
        return Err(Error::Mesh(format!("the time series names no files: {}", document.path.display())));
    }
    let last = steps.len() - 1;
    let step = options.step.unwrap_or(last);
    let Some(&parts) = steps.get(step) else {
        let path = document.path.display();
        return Err(Error::Asked(format!("the time series has no step {step}; it has 0 to {last}: {path}")));
    };
    let mut mesh = match parts {
        [(_, path)] => {
            let source = Source::open(path)?;
            let head = source.head()?;
            read_grid(&Document::parse(&head)?, options)?
        }
        _ => {
            let paths: Vec<_> = parts.iter().map(|(_, path)| path.clone()).collect();
            read_pieces(&paths, "UnstructuredGrid", options)?
        }
    };
    if options.step.is_none() && last > 0 {
        let text = format!("the last of {} time steps was read (time {})", last + 1, parts[0].0);
        mesh.notes.push(ReadNote { text, count: 0 });
    }
    Ok(mesh)
}
