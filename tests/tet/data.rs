//! Real grids from the folder that TETRALUX_DATA names.

use std::collections::HashMap;
use std::fs;
use std::path::PathBuf;

use glam::DVec3;
use tetralux::mesh::{Mesh, Topology};
use tetralux::tet::{Adjacency, Census, FACES, TetMesh};

use crate::support::{build, mesh_of, point_array, six_volumes};

fn floats(bytes: &[u8]) -> impl Iterator<Item = f64> + '_ {
    bytes.chunks_exact(4).map(|b| f64::from(f32::from_be_bytes([b[0], b[1], b[2], b[3]])))
}

/// A PLOT3D whole-volume grid and the momentum magnitude: big-endian f32, blanking ignored.
fn plot3d(name: &str) -> Mesh {
    let folder = PathBuf::from(std::env::var_os("TETRALUX_DATA").expect("TETRALUX_DATA")).join("plot3d");
    let read = |what: &str| fs::read(folder.join(format!("{name}{what}.bin"))).expect("a PLOT3D file");
    let (xyz, q) = (read("xyz"), read("q"));
    let dims: [usize; 3] =
        std::array::from_fn(|i| i32::from_be_bytes(xyz[4 * i..4 * i + 4].try_into().unwrap()) as usize);
    let n: usize = dims.iter().product();
    let xyz: Vec<f64> = floats(&xyz[12..]).take(3 * n).collect();
    let points = (0..n).map(|i| DVec3::new(xyz[i], xyz[n + i], xyz[2 * n + i])).collect();
    // Dimensions, four flow conditions, then density, momentum, energy.
    let q: Vec<f64> = floats(&q[28..]).take(5 * n).collect();
    let momentum = (0..n).map(|i| DVec3::new(q[n + i], q[2 * n + i], q[3 * n + i]).length()).collect();
    let topology = Topology::Structured { points: dims, blank: Vec::new() };
    mesh_of(points, topology, vec![point_array("momentum", 1, momentum)])
}

fn check(mesh: &TetMesh, census: &Census) {
    assert!(six_volumes(mesh).all(|v| v > 0.0));
    assert_eq!(census.tets, mesh.tets.len() as u64);
    assert_eq!(census.folded_cells.count, 0, "{census}");
}

#[test]
#[ignore = "needs TETRALUX_DATA"]
fn blunt_fin() {
    let (mesh, census) = build(plot3d("bluntfin"));
    check(&mesh, &census);
    assert_eq!(census.tets_made, 224_874);
    assert_eq!(census.zero_volume.count, 115);
    assert_eq!(census.coincident_points.count, 39);
    let adjacency = Adjacency::new(&mesh);
    let topology = Census::topology(&mesh, &adjacency);
    assert_eq!(topology.overfull_faces.count, 0, "{topology}");
    // 13,516 boundary faces with the flat tetrahedra in. Without them, as points are not merged, 77 pairs of faces lie
    // at one place and do not know each other: a slit of no width at the fin's axis.
    let mut places: HashMap<[[u64; 3]; 3], u64> = HashMap::new();
    for (t, f) in adjacency.boundary_faces() {
        let mut place = FACES[f].map(|i| (mesh.corners(t)[i] + DVec3::ZERO).to_array().map(f64::to_bits));
        place.sort_unstable();
        *places.entry(place).or_default() += 1;
    }
    let paired: u64 = places.into_values().filter(|&n| n > 1).sum();
    assert_eq!((topology.boundary_faces, paired), (13_592, 2 * 77), "{topology}");
}

#[test]
#[ignore = "needs TETRALUX_DATA"]
fn liquid_oxygen_post() {
    let (mesh, census) = build(plot3d("post"));
    check(&mesh, &census);
    assert_eq!(census.tets_made, 616_050);
    assert_eq!(census.zero_volume.count, 0);
    assert!((mesh.gradient_range().max).is_finite());
}
