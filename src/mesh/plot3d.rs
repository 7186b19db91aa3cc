//! PLOT3D whole-volume binaries: a grid (xyz, with or without IBLANK) and, beside it, a solution (q).
//!
//! Byte order, Fortran record marks, one or several blocks, precision and IBLANK are found from the file's size
//! (see `layout`). The fields are those that users of PLOT3D know, derived with a ratio of specific heats of 1.4.

mod layout;

use std::path::{Path, PathBuf};

use glam::DVec3;

use self::layout::{Block, Content, Layout};
use super::sample_type::SampleType;
use super::{ArrayInfo, Association, CellKind, DataArray, Mesh, ReadNote, ReadOptions, Topology};
use crate::error::{Error, Result};

/// Ratio of specific heats, PLOT3D's default.
const GAMMA: f64 = 1.4;

/// Reads the grid at `path` and the solution `options.solution`, or, where that is unset, the file whose name has `q`
/// in place of the grid's `xyz` (noted).
///
/// Point arrays: `Density`, `Momentum`, `StagnationEnergy`, `MomentumMagnitude`, `Pressure`, `Mach`, in the file's
/// units. One block gives a structured grid (points with IBLANK 0 are blank); several give the hexahedra of all, not
/// joined at their borders.
///
/// # Errors
/// Unreadable files, sizes that fit no variant of the format, a solution of another grid, NaN coordinates.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Mesh> {
    let bytes = std::fs::read(path).map_err(|e| Error::io(path, e))?;
    let layout = grid_layout(&bytes, path)?;
    let mut notes = Vec::new();
    if layout.padding > 0 {
        notes.push(note("Bytes of padding at the end of the grid file were left out", layout.padding as u64));
    }
    let points = read_points(&layout, &bytes, path)?;
    let topology = match &layout.blocks[..] {
        [block] => Topology::Structured { points: block.dims, blank: read_blank(&layout, block, &bytes) },
        blocks => {
            notes.push(note("Blocks were read side by side, not joined at their borders", blocks.len() as u64));
            hexahedra(&layout, &bytes)
        }
    };
    let mut mesh = Mesh { points, topology, arrays: Vec::new(), available: Vec::new(), notes };
    match options.solution.clone().or_else(|| guess_solution(path, &mut mesh.notes)) {
        Some(solution) => read_solution(&mut mesh, &layout, &solution, options)?,
        None => mesh.notes.push(note("No solution (q) file was given or found: the grid has no arrays", 0)),
    }
    Ok(mesh)
}

fn note(text: &str, count: u64) -> ReadNote {
    ReadNote { text: text.into(), count }
}

fn grid_layout(bytes: &[u8], path: &Path) -> Result<Layout> {
    let grid = Layout::find(bytes, Content::Grid);
    let solution = Layout::find(bytes, Content::Solution);
    match (grid, solution) {
        (Some(grid), Some(solution)) if solution.doubt(bytes) < grid.doubt(bytes) => {
            Err(given_solution(&solution, path))
        }
        (None, Some(solution)) => Err(given_solution(&solution, path)),
        (Some(grid), _) => {
            let flat = grid.blocks.iter().find(|b| b.dims.iter().any(|n| *n < 2));
            match flat {
                Some(b) => Err(Error::malformed(path, format!("the PLOT3D grid is flat ({}): no volume", b.size()))),
                None => Ok(grid),
            }
        }
        (None, None) => Err(not_plot3d(bytes, Content::Grid, path)),
    }
}

fn given_solution(solution: &Layout, path: &Path) -> Error {
    let size = solution.blocks[0].size();
    let what = format!(
        "this is a PLOT3D solution (q) file of {size} points: open the grid (xyz) file, with this one as its solution"
    );
    Error::malformed(path, what)
}

fn not_plot3d(bytes: &[u8], content: Content, path: &Path) -> Error {
    let what = match content {
        Content::Grid => "grid (xyz)",
        Content::Solution => "solution (q)",
    };
    let first: Vec<_> = SampleType::I32.widen(&bytes[..bytes.len().min(16)], super::sample_type::Endian::Big);
    Error::malformed(
        path,
        format!(
            "not a PLOT3D whole-volume binary {what} file: no byte order, record marks, block count, precision or \
             IBLANK fits its {} bytes (first big-endian integers: {first:?})",
            bytes.len()
        ),
    )
}

/// All blocks' points, one block after another.
fn read_points(layout: &Layout, bytes: &[u8], path: &Path) -> Result<Vec<DVec3>> {
    let mut points = Vec::with_capacity(layout.blocks.iter().map(Block::count).sum());
    for block in &layout.blocks {
        let [x, y, z] = [0, 1, 2].map(|variable| layout.variable(block, variable, bytes));
        points.extend(x.iter().zip(&y).zip(&z).map(|((x, y), z)| DVec3::new(*x, *y, *z)));
    }
    match points.iter().position(|p| !p.is_finite()) {
        Some(i) => Err(Error::malformed(path, format!("point {i} has a coordinate that is not finite: {}", points[i]))),
        None => Ok(points),
    }
}

/// Per point whether IBLANK is 0 (other values tell walls and block borders); empty where nothing is blank.
fn read_blank(layout: &Layout, block: &Block, bytes: &[u8]) -> Vec<bool> {
    let blank: Vec<bool> = layout.iblank(block, bytes).iter().map(|v| *v == 0.0).collect();
    if blank.contains(&true) { blank } else { Vec::new() }
}

/// The hexahedra of all blocks, blanked ones left out.
fn hexahedra(layout: &Layout, bytes: &[u8]) -> Topology {
    let (mut nodes, mut first) = (Vec::new(), 0);
    for block in &layout.blocks {
        let blank = read_blank(layout, block, bytes);
        let [n, m, l] = block.dims;
        let (row, layer) = (n, n * m);
        let corners = [0, 1, 1 + row, row, layer, 1 + layer, 1 + row + layer, row + layer];
        let starts =
            (0..l - 1).flat_map(|k| (0..m - 1).flat_map(move |j| (0..n - 1).map(move |i| i + row * j + layer * k)));
        for start in starts {
            let cell = corners.map(|c| start + c);
            if blank.is_empty() || cell.iter().all(|&p| !blank[p]) {
                nodes.extend(cell.map(|p| (first + p) as u32));
            }
        }
        first += block.count();
    }
    Topology::Cells { kinds: vec![CellKind::Hexahedron; nodes.len() / 8], nodes }
}

/// The file beside the grid whose name has `q` for `xyz` (the last one), where there is one.
fn guess_solution(grid: &Path, notes: &mut Vec<ReadNote>) -> Option<PathBuf> {
    let name = grid.file_name()?.to_str()?;
    let (at, q) = name.rfind("xyz").map(|at| (at, "q")).or_else(|| name.rfind("XYZ").map(|at| (at, "Q")))?;
    let guess = format!("{}{q}{}", &name[..at], &name[at + 3..]);
    let solution = grid.with_file_name(&guess);
    solution.is_file().then(|| {
        notes.push(note(&format!("Solution file taken by its name: {guess}"), 0));
        solution
    })
}

fn read_solution(mesh: &mut Mesh, grid: &Layout, path: &Path, options: &ReadOptions) -> Result<()> {
    let bytes = std::fs::read(path).map_err(|e| Error::io(path, e))?;
    let layout = Layout::find_like(&bytes, grid)
        .or_else(|| Layout::find(&bytes, Content::Solution))
        .ok_or_else(|| not_plot3d(&bytes, Content::Solution, path))?;
    let sizes = |l: &Layout| l.blocks.iter().map(Block::size).collect::<Vec<_>>().join(", ");
    if sizes(&layout) != sizes(grid) {
        let what = format!("the solution has {} points and the grid {}", sizes(&layout), sizes(grid));
        return Err(Error::malformed(path, what));
    }
    if layout.padding > 0 {
        let text = "Bytes of padding at the end of the solution file were left out";
        mesh.notes.push(note(text, layout.padding as u64));
    }
    mesh.available = Quantity::ALL.map(Quantity::info).to_vec();
    for quantity in options.arrays.select(&mesh.available)?.into_iter().map(|i| Quantity::ALL[i]) {
        let values = layout.blocks.iter().flat_map(|block| quantity.values(&layout, block, &bytes)).collect();
        let ArrayInfo { name, association, components } = quantity.info();
        mesh.arrays.push(DataArray { name, association, components, values });
    }
    Ok(())
}

/// What can be had from density, momentum and energy.
#[derive(Clone, Copy)]
enum Quantity {
    Density,
    Momentum,
    StagnationEnergy,
    MomentumMagnitude,
    Pressure,
    Mach,
}

impl Quantity {
    const ALL: [Self; 6] =
        [Self::Density, Self::Momentum, Self::StagnationEnergy, Self::MomentumMagnitude, Self::Pressure, Self::Mach];

    fn info(self) -> ArrayInfo {
        let (name, components) = match self {
            Self::Density => ("Density", 1),
            Self::Momentum => ("Momentum", 3),
            Self::StagnationEnergy => ("StagnationEnergy", 1),
            Self::MomentumMagnitude => ("MomentumMagnitude", 1),
            Self::Pressure => ("Pressure", 1),
            Self::Mach => ("Mach", 1),
        };
        ArrayInfo { name: name.into(), association: Association::Point, components }
    }

    fn values(self, layout: &Layout, block: &Block, bytes: &[u8]) -> Vec<f64> {
        let variable = |i| layout.variable(block, i, bytes);
        let momentum = || {
            let [x, y, z] = [1, 2, 3].map(variable);
            (0..block.count()).map(move |i| DVec3::new(x[i], y[i], z[i]))
        };
        match self {
            Self::Density => variable(0),
            Self::StagnationEnergy => variable(4),
            Self::Momentum => momentum().flat_map(|m| m.to_array()).collect(),
            Self::MomentumMagnitude => momentum().map(DVec3::length).collect(),
            Self::Pressure | Self::Mach => {
                let (density, energy) = (variable(0), variable(4));
                let state = momentum().zip(density).zip(energy);
                state
                    .map(|((m, density), energy)| {
                        let pressure = (GAMMA - 1.0) * (energy - 0.5 * m.length_squared() / density);
                        match self {
                            Self::Mach => m.length() / density / (GAMMA * pressure / density).sqrt(),
                            _ => pressure,
                        }
                    })
                    .collect()
            }
        }
    }
}
