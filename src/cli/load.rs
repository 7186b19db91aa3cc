//! From a file's name to tetrahedra: the only place here that reads meshes.

use rayon::prelude::*;

use super::args::{SourceArgs, Split};
use super::output::note;
use super::progress::step;
use crate::error::{Error, Result};
use crate::mesh::{self, ArrayChoice, Mesh, ReadOptions};
use crate::tet::{BuildOptions, Census, FieldChoice, Grid, HexSplit, TetMesh};

/// Reads the arrays that `field` needs, all of them where it is `None`.
pub(crate) fn mesh(source: &SourceArgs, arrays: ArrayChoice) -> Result<Mesh> {
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
pub(crate) fn cut(mesh: Mesh, source: &SourceArgs, field: Option<&str>) -> Result<(TetMesh, Census)> {
    let choice = field.map_or_else(FieldChoice::default, FieldChoice::parse);
    let hex_split = match source.split {
        Some(Split::Five) => HexSplit::FiveAlternating,
        None if Grid::check(&mesh).is_ok() => HexSplit::FiveAlternating,
        None | Some(Split::Six) => HexSplit::Six,
    };
    let options = BuildOptions { hex_split, weld: source.weld };
    step("building", || TetMesh::new(mesh, &choice, options))
}

/// Both, telling on stderr what was left out or guessed.
pub(crate) fn tet_mesh(source: &SourceArgs, field: Option<&str>) -> Result<(TetMesh, Census)> {
    let (mesh, census) = cut(mesh(source, arrays(field))?, source, field)?;
    tell(&census.notes);
    Ok((mesh, census))
}

/// What a renderer is made of.
pub(crate) enum Domain {
    /// Its tetrahedra are implied.
    Grid(Grid),
    Mesh(TetMesh),
}

/// Which is wanted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    Grid,
    /// A grid, where that is one with values everywhere, and nothing was asked for that needs a mesh.
    GridIfPossible,
    Mesh,
}

/// Either, telling the same; `takes_grids` is asked where the mesh could be one.
pub(crate) fn domain(
    source: &SourceArgs,
    field: Option<&str>,
    wanted: Wanted,
    takes_grids: impl FnOnce() -> bool,
) -> Result<Domain> {
    let mesh = mesh(source, arrays(field))?;
    if wanted == Wanted::Grid && (source.weld || source.split == Some(Split::Six)) {
        let text =
            "a structured order takes five tetrahedra a voxel, and joins no points: leave out --split 6 and --weld";
        return Err(Error::Asked(text.into()));
    }
    let is_plain = || {
        let is_finite = mesh.arrays.iter().all(|array| array.values.par_iter().all(|v| v.is_finite()));
        !source.weld && source.split != Some(Split::Six) && is_finite && Grid::check(&mesh).is_ok() && takes_grids()
    };
    if wanted == Wanted::Mesh || (wanted == Wanted::GridIfPossible && !is_plain()) {
        let (mesh, census) = cut(mesh, source, field)?;
        tell(&census.notes);
        return Ok(Domain::Mesh(mesh));
    }
    let choice = field.map_or_else(FieldChoice::default, FieldChoice::parse);
    let (grid, notes) = step("building", || Grid::new(mesh, &choice))?;
    tell(&notes);
    Ok(Domain::Grid(grid))
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
