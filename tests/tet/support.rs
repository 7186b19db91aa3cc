//! Meshes to try things on, and checks that several tests need.

use std::collections::HashMap;

use glam::DVec3;
use rand::rngs::StdRng;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use tetralux::mesh::{Association, CellKind, DataArray, Mesh, Topology};
use tetralux::tet::{Census, FieldChoice, HexSplit, TetMesh};

pub fn point_array(name: &str, components: usize, values: Vec<f64>) -> DataArray {
    DataArray { name: name.into(), association: Association::Point, components, values }
}

pub fn cell_array(name: &str, components: usize, values: Vec<f64>) -> DataArray {
    DataArray { name: name.into(), association: Association::Cell, components, values }
}

pub fn mesh_of(points: Vec<DVec3>, topology: Topology, arrays: Vec<DataArray>) -> Mesh {
    Mesh { points, topology, arrays, available: Vec::new(), notes: Vec::new() }
}

/// Cells of any shape, with the x coordinate as field `x`.
pub fn cells_of(points: Vec<DVec3>, cells: &[(CellKind, Vec<u32>)]) -> Mesh {
    let x = point_array("x", 1, points.iter().map(|p| p.x).collect());
    let kinds = cells.iter().map(|c| c.0).collect();
    let nodes = cells.iter().flat_map(|c| c.1.clone()).collect();
    mesh_of(points, Topology::Cells { kinds, nodes }, vec![x])
}

pub fn build(mesh: Mesh) -> (TetMesh, Census) {
    TetMesh::new(mesh, &FieldChoice::default(), HexSplit::Six).expect("a mesh that can be built")
}

/// `n` points along each axis of the unit cube, x fastest.
pub fn grid_points(n: [usize; 3]) -> Vec<DVec3> {
    let at = |i: usize, n: usize| i as f64 / (n - 1) as f64;
    let mut points = Vec::new();
    for k in 0..n[2] {
        for j in 0..n[1] {
            for i in 0..n[0] {
                points.push(DVec3::new(at(i, n[0]), at(j, n[1]), at(k, n[2])));
            }
        }
    }
    points
}

/// A structured grid over the unit cube, with field `x`.
pub fn grid(n: [usize; 3]) -> Mesh {
    let points = grid_points(n);
    let x = point_array("x", 1, points.iter().map(|p| p.x).collect());
    mesh_of(points, Topology::Structured { points: n, blank: Vec::new() }, vec![x])
}

/// The unit cube as `n` cubed cubes, each at random a hexahedron, a voxel, two wedges (by column) or six pyramids;
/// points shuffled, inner ones moved by up to `jitter` of a cube's edge.
pub fn mixed_cube(n: usize, jitter: f64, seed: u64) -> Mesh {
    let mut rng = StdRng::seed_from_u64(seed);
    let m = n + 1;
    let mut points = grid_points([m; 3]);
    for p in &mut points {
        let inner = p.cmpgt(DVec3::ZERO).all() && p.cmplt(DVec3::ONE).all();
        if inner {
            *p += DVec3::from_array(std::array::from_fn(|_| rng.random_range(-1.0..1.0))) * jitter / n as f64;
        }
    }
    let columns: Vec<bool> = (0..n * n).map(|_| rng.random_bool(0.4)).collect();
    let mut cells = Vec::new();
    for i in 0..n * n * n {
        let (x, y, z) = (i % n, i / n % n, i / (n * n));
        let b = x + m * (y + m * z);
        let h = [b, b + 1, b + 1 + m, b + m].map(|i| i as u32);
        let [a, b, c, d, e, f, g, k] = {
            let up = (m * m) as u32;
            [h[0], h[1], h[2], h[3], h[0] + up, h[1] + up, h[2] + up, h[3] + up]
        };
        match (columns[x + n * y], rng.random_range(0..3)) {
            (true, _) => {
                cells.push((CellKind::Wedge, vec![a, b, d, e, f, k]));
                cells.push((CellKind::Wedge, vec![b, c, d, f, g, k]));
            }
            (false, 0) => cells.push((CellKind::Hexahedron, vec![a, b, c, d, e, f, g, k])),
            (false, 1) => cells.push((CellKind::Voxel, vec![a, b, d, c, e, f, k, g])),
            (false, _) => {
                let apex = points.len() as u32;
                points.push([a, b, c, d, e, f, g, k].iter().map(|&i| points[i as usize]).sum::<DVec3>() / 8.0);
                for q in [[a, b, c, d], [e, k, g, f], [a, e, f, b], [b, f, g, c], [c, g, k, d], [d, k, e, a]] {
                    cells.push((CellKind::Pyramid, vec![q[0], q[1], q[2], q[3], apex]));
                }
            }
        }
    }
    let mut numbers: Vec<u32> = (0..points.len() as u32).collect();
    numbers.shuffle(&mut rng);
    let mut moved = vec![DVec3::ZERO; points.len()];
    points.iter().zip(&numbers).for_each(|(&p, &n)| moved[n as usize] = p);
    cells.iter_mut().for_each(|c| c.1.iter_mut().for_each(|v| *v = numbers[*v as usize]));
    cells.shuffle(&mut rng);
    cells_of(moved, &cells)
}

pub fn six_volumes(mesh: &TetMesh) -> impl Iterator<Item = f64> + '_ {
    mesh.tets.iter().map(|t| {
        let [a, b, c, d] = t.map(|v| mesh.vertices[v as usize]);
        (b - a).cross(c - a).dot(d - a)
    })
}

pub fn volume_in_data(mesh: &TetMesh) -> f64 {
    six_volumes(mesh).sum::<f64>() / 6.0 * mesh.data_per_mesh.powi(3)
}

/// Faces that one tetrahedron alone, or more than two, hold, though they do not lie on a side of the mesh's box.
pub fn unmatched_faces(mesh: &TetMesh) -> usize {
    let mut owners: HashMap<[u32; 3], usize> = HashMap::new();
    for tet in mesh.tets.iter() {
        for skip in 0..4 {
            let mut face: Vec<u32> = (0..4).filter(|&i| i != skip).map(|i| tet[i]).collect();
            face.sort_unstable();
            *owners.entry([face[0], face[1], face[2]]).or_default() += 1;
        }
    }
    let bounds = mesh.bounds();
    let on_side = |face: &[u32; 3]| {
        let p = face.map(|v| mesh.vertices[v as usize]);
        (0..3).any(|a| [bounds.min[a], bounds.max[a]].iter().any(|&side| p.iter().all(|q| q[a] == side)))
    };
    owners.iter().filter(|(face, count)| **count > 2 || (**count == 1 && !on_side(face))).count()
}
