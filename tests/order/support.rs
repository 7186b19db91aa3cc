//! Meshes and cameras to order.

use glam::DVec3;
use tetralux::plan::order::{Inversions, VisibilityOrder, sample_cameras};
use tetralux::scene::{Camera, Projection};
use tetralux::tet::{Adjacency, TetId, TetMesh};

use crate::common::boxes::tet_mesh;
use crate::common::delaunay;
use crate::common::random::Random;

pub fn fields(p: DVec3) -> [f64; 2] {
    [p.x + 0.5 * p.y - 0.3 * p.z, 0.0]
}

/// About 4,500 cells.
pub fn delaunay(seed: u64) -> TetMesh {
    delaunay::cube(500, 25, 6, seed, fields)
}

/// The same cells with other points.
pub fn mapped(mesh: &TetMesh, map: impl FnMut(DVec3) -> DVec3) -> TetMesh {
    let points: Vec<DVec3> = mesh.vertices.iter().map(|&v| mesh.data_from_mesh(v)).map(map).collect();
    tet_mesh(&points, mesh.tets.to_vec(), fields)
}

/// Inner points moved at random, each by up to `most`, unless that turns a cell.
pub fn moved(mesh: &TetMesh, most: f64, seed: u64) -> TetMesh {
    let mut random = Random(seed);
    let mut moved = mesh.clone();
    let mut cells_of = vec![Vec::new(); mesh.vertices.len()];
    for (t, tet) in mesh.tets.iter().enumerate() {
        tet.iter().for_each(|&v| cells_of[v as usize].push(TetId(t as u32)));
    }
    let (low, high) = (mesh.bounds().min, mesh.bounds().max);
    for (v, cells) in cells_of.iter().enumerate() {
        let place = moved.vertices[v];
        if place.cmpgt(low).all() && place.cmplt(high).all() {
            moved.vertices[v] += most * random.unit() * random.direction();
            let volume = |&t: &TetId| {
                let [a, b, c, d] = moved.corners(t);
                (b - a).cross(c - a).dot(d - a)
            };
            if !cells.iter().all(|t| volume(t) > 1e-9) {
                moved.vertices[v] = place;
            }
        }
    }
    moved
}

/// Without the cells whose centroid, in data space, `drop` names.
pub fn without(mut mesh: TetMesh, drop: impl Fn(DVec3) -> bool) -> TetMesh {
    let centroid = |t: u32| mesh.data_from_mesh(mesh.corners(TetId(t)).iter().sum::<DVec3>() / 4.0);
    let kept = (0..mesh.tets.len() as u32).filter(|&t| !drop(centroid(t)));
    mesh.tets = kept.map(|t| mesh.tets[t as usize]).collect::<Vec<_>>().into();
    mesh
}

/// Sums over cameras around the mesh, within it, and of parallel rays.
pub fn count(mesh: &TetMesh, cameras: usize, mut order: impl FnMut(&Camera) -> VisibilityOrder) -> Inversions {
    let adjacency = Adjacency::new(mesh);
    let sum = sample_cameras(mesh, cameras)
        .iter()
        .map(|camera| order(camera).inversions(mesh, &adjacency, camera))
        .fold(Inversions::default(), |sum, one| sum + one);
    // Nearly all faces tell.
    let faces = adjacency.neighbors.iter().flatten().filter(|&&n| n != tetralux::tet::NO_TET).count() as u64 / 2;
    assert!(sum.pairs > faces * cameras as u64 * 9 / 10, "{sum:?} of {faces} faces");
    sum
}

pub fn camera(eye: DVec3, target: DVec3, projection: Projection) -> Camera {
    Camera { eye, target, up: DVec3::new(0.1, 0.2, 0.9), projection, near: None }
}
