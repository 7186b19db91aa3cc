//! What the tests hold meshes against, and that it can fail.

use std::path::{Path, PathBuf};

use glam::DVec3;
use tetralux::mesh::{ArrayChoice, Association, CellKind, DataArray, Mesh, ReadOptions, Topology, read};

pub fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/xml").join(name)
}

pub fn load(name: &str) -> Mesh {
    read(&fixture(name), &ReadOptions::default()).unwrap_or_else(|e| panic!("{name}: {e}"))
}

pub fn one(name: &str) -> ReadOptions {
    ReadOptions { arrays: ArrayChoice::One(Some(name.to_owned())), ..ReadOptions::default() }
}

pub fn array<'m>(mesh: &'m Mesh, name: &str) -> &'m DataArray {
    mesh.arrays.iter().find(|a| a.name == name).unwrap_or_else(|| panic!("no array {name}"))
}

pub fn noted(mesh: &Mesh, words: &str) -> u64 {
    mesh.notes.iter().filter(|n| n.text.contains(words)).map(|n| n.count).sum()
}

/// Nodes of every cell, blanked ones of structured grids left out.
pub fn cells(mesh: &Mesh) -> Vec<Vec<usize>> {
    match &mesh.topology {
        Topology::Cells { kinds, nodes } => {
            let mut rest = nodes.as_slice();
            let take = |kind: &CellKind| {
                let (cell, after) = rest.split_at(kind.node_count());
                rest = after;
                cell.iter().map(|&n| n as usize).collect()
            };
            kinds.iter().map(take).collect()
        }
        Topology::Structured { points: [nx, ny, nz], .. } => {
            let mut all = Vec::new();
            for (k, j, i) in
                (0..nz - 1).flat_map(|k| (0..ny - 1).flat_map(move |j| (0..nx - 1).map(move |i| (k, j, i))))
            {
                let at = (k * ny + j) * nx + i;
                all.push([0, 1, *nx, nx + 1].into_iter().flat_map(|d| [at + d, at + d + nx * ny]).collect());
            }
            all
        }
    }
}

/// What is wrong with the fields of scripts/fixtures.py: `linear`, `U` at points, `center_x` at cells.
pub fn field_errors(mesh: &Mesh) -> Vec<String> {
    let mut errors = Vec::new();
    let (linear, u, center) = (array(mesh, "linear"), array(mesh, "U"), array(mesh, "center_x"));
    let cells = cells(mesh);
    if (linear.values.len(), u.values.len(), center.values.len())
        != (mesh.points.len(), 3 * mesh.points.len(), cells.len())
    {
        errors.push("lengths".to_owned());
        return errors;
    }
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-6 * (1.0 + b.abs());
    for (i, p) in mesh.points.iter().enumerate() {
        if !close(linear.values[i], p.x + 2.0 * p.y + 4.0 * p.z) {
            errors.push(format!("linear at point {i}"));
        }
        if ![p.x, 2.0 * p.y, 3.0 * p.z].iter().zip(&u.values[3 * i..]).all(|(a, b)| close(*b, *a)) {
            errors.push(format!("U at point {i}"));
        }
    }
    for (i, cell) in cells.iter().enumerate() {
        let mean = cell.iter().map(|&n| mesh.points[n].x).sum::<f64>() / cell.len() as f64;
        if !close(center.values[i], mean) {
            errors.push(format!("center_x of cell {i}: {} instead of {mean}", center.values[i]));
        }
    }
    errors
}

/// Volume of boxes with edges along the axes, by their diagonals.
pub fn boxes_volume(mesh: &Mesh) -> f64 {
    let volume = |cell: &Vec<usize>| {
        let corners = cell.iter().map(|&n| mesh.points[n]);
        let low = corners.clone().fold(DVec3::INFINITY, DVec3::min);
        (corners.fold(DVec3::NEG_INFINITY, DVec3::max) - low).element_product()
    };
    cells(mesh).iter().map(volume).sum()
}

/// What every mesh promises; a reader of damaged files may return a wrong mesh, but never an impossible one.
pub fn promises(mesh: &Mesh) -> Result<(), String> {
    let count = match &mesh.topology {
        Topology::Cells { kinds, nodes } => {
            if nodes.len() != kinds.iter().map(|k| k.node_count()).sum::<usize>() {
                return Err("number of nodes".to_owned());
            }
            if nodes.iter().any(|&n| n as usize >= mesh.points.len()) {
                return Err("a node is out of range".to_owned());
            }
            kinds.len()
        }
        Topology::Structured { points, blank } => {
            if points.iter().product::<usize>() != mesh.points.len()
                || !(blank.is_empty() || blank.len() == mesh.points.len())
            {
                return Err("number of grid points".to_owned());
            }
            mesh.topology.cell_count()
        }
    };
    if count == 0 || mesh.points.iter().any(|p| !p.is_finite()) {
        return Err("no cells, or a point that is not finite".to_owned());
    }
    for array in &mesh.arrays {
        let tuples = if array.association == Association::Point { mesh.points.len() } else { count };
        if array.components == 0 || array.values.len() != tuples * array.components {
            return Err(format!("length of {}", array.name));
        }
    }
    Ok(())
}

#[test]
fn the_field_check_sees_planted_errors() {
    let good = load("encoding_ascii.vtu");
    let mut bad = good.clone();
    bad.arrays[0].values[3] += 1e-4;
    assert_eq!(field_errors(&bad), ["linear at point 3"]);
    let mut bad = good.clone();
    bad.arrays[1].values[3 * 5 + 2] = f64::NAN;
    assert_eq!(field_errors(&bad), ["U at point 5"]);
    let mut bad = good.clone();
    let Topology::Cells { nodes, .. } = &mut bad.topology else { panic!("not a list of cells") };
    nodes[8] = 31;
    assert_eq!(field_errors(&bad).len(), 1);
    let mut bad = good;
    bad.arrays[2].values.pop();
    assert_eq!(field_errors(&bad), ["lengths"]);
}

#[test]
pub fn promises_can_be_broken() {
    let good = load("mixed.vtu");
    promises(&good).unwrap();
    let mut bad = good.clone();
    bad.points.pop();
    promises(&bad).unwrap_err();
    let mut bad = good.clone();
    bad.arrays[0].values.pop();
    promises(&bad).unwrap_err();
    let mut bad = good;
    bad.points[0].x = f64::NAN;
    promises(&bad).unwrap_err();
}
