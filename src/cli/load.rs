//! From a file's name to tetrahedra: the only place here that reads meshes.

use super::args::{SourceArgs, Split};
use super::output::note;
use super::progress::step;
use crate::error::Result;
use crate::mesh::{self, ArrayChoice, Mesh, ReadOptions};
use crate::tet::{BuildOptions, Census, FieldChoice, Grid, HexSplit, TetMesh};

/// Reads the arrays that `field` needs, all of them where it is `None`.
pub(super) fn mesh(source: &SourceArgs, arrays: ArrayChoice) -> Result<Mesh> {
    let options = ReadOptions {
        arrays,
        step: source.step,
        solution: source.solution.clone(),
        dims: source.dims,
        spacing: source.spacing,
        sample_type: source.sample_type.clone(),
    };
    step("reading", || mesh::read(&source.mesh, &options))
}

/// Cuts `mesh` into tetrahedra.
pub(super) fn cut(mesh: Mesh, source: &SourceArgs, field: Option<&str>) -> Result<(TetMesh, Census)> {
    let choice = field.map_or_else(FieldChoice::default, FieldChoice::parse);
    let hex_split = match source.split {
        Split::Five => HexSplit::FiveAlternating,
        Split::Six => HexSplit::Six,
    };
    let options = BuildOptions { hex_split, weld: source.weld };
    step("building", || TetMesh::new(mesh, &choice, options))
}

/// Both, telling on stderr what was left out or guessed.
pub(super) fn tet_mesh(source: &SourceArgs, field: Option<&str>) -> Result<(TetMesh, Census)> {
    let (mesh, census) = cut(mesh(source, arrays(field))?, source, field)?;
    tell(&census.notes);
    Ok((mesh, census))
}

/// A grid whose tetrahedra are implied, telling the same.
pub(super) fn grid(source: &SourceArgs, field: Option<&str>) -> Result<Grid> {
    let mesh = mesh(source, arrays(field))?;
    let choice = field.map_or_else(FieldChoice::default, FieldChoice::parse);
    let (grid, notes) = step("building", || Grid::new(mesh, &choice))?;
    tell(&notes);
    Ok(grid)
}

/// Without a name the choice falls on the first array of one component, which only the whole list tells.
fn arrays(field: Option<&str>) -> ArrayChoice {
    field.map_or(ArrayChoice::All, |name| ArrayChoice::One(Some(name.to_owned())))
}

fn tell(notes: &[String]) {
    for text in notes {
        note(&format!("note: {text}"));
    }
}
