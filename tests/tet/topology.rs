//! Adjacency, and what it tells of a mesh's shape.

use glam::DVec3;
use tetralux::mesh::{CellKind, Topology};
use tetralux::tet::{Adjacency, Census, FACES, NO_TET, TetId, TetMesh, TopologyCensus};

use crate::support::{build, cells_of, grid, mixed_cube};

fn examine(mesh: &TetMesh) -> TopologyCensus {
    Census::topology(mesh, &Adjacency::new(mesh))
}

/// Faces whose neighbour does not point back, or does not have the same vertices.
fn asymmetric(mesh: &TetMesh, adjacency: &Adjacency) -> usize {
    let face = |t: u32, f: usize| {
        let mut v = FACES[f].map(|i| mesh.tets[t as usize][i]);
        v.sort_unstable();
        v
    };
    let all = (0..mesh.tets.len() as u32).flat_map(|t| (0..4).map(move |f| (t, f)));
    all.filter(|&(t, f)| {
        let n = adjacency.neighbors[t as usize][f];
        n != NO_TET && !(0..4).any(|g| adjacency.neighbors[n as usize][g] == t && face(n, g) == face(t, f))
    })
    .count()
}

#[test]
fn adjacency_is_symmetric_and_complete() {
    for seed in 0..5 {
        let (mesh, _) = build(mixed_cube(5, 0.15, seed));
        let mut adjacency = Adjacency::new(&mesh);
        assert_eq!(asymmetric(&mesh, &adjacency), 0);
        // 5 x 5 squares on each side of the cube, two triangles each.
        assert_eq!(adjacency.boundary_faces().count(), 6 * 25 * 2);
        assert_eq!(adjacency.overfull_faces.count, 0);
        let first = adjacency.neighbors[0].iter().position(|&n| n != NO_TET).unwrap();
        adjacency.neighbors[0][first] ^= 1;
        assert!(asymmetric(&mesh, &adjacency) > 0);
    }
}

#[test]
fn faces_look_outward() {
    let (mesh, _) = build(grid([2, 2, 2]));
    for t in 0..mesh.tets.len() {
        let p = mesh.corners(TetId(t as u32));
        for (opposite, face) in FACES.iter().enumerate() {
            let [a, b, c] = face.map(|i| p[i]);
            assert!((b - a).cross(c - a).dot(p[opposite] - a) < 0.0);
        }
    }
}

#[test]
fn a_grid_is_convex_and_delaunay() {
    let mut mesh = grid([6, 5, 4]);
    // As read from f32: no longer exactly flat sides or common spheres.
    mesh.points.iter_mut().for_each(|p| *p = (*p * 0.1).as_vec3().as_dvec3());
    let topology = examine(&build(mesh).0);
    assert!(topology.is_convex() && topology.is_delaunay(), "{topology}");
    assert_eq!(topology.components, 1);
    assert!(topology.to_string().contains("yes"));
}

#[test]
fn a_dent_a_hole_and_a_second_part_are_not_convex() {
    let mut dented = grid([4, 4, 4]);
    let middle = dented.points.iter().position(|p| p.z == 1.0 && p.x > 0.2 && p.y > 0.2).unwrap();
    dented.points[middle].z -= 1e-3;
    let topology = examine(&build(dented).0);
    assert!(!topology.is_convex() && topology.reflex_edges.count > 0, "{topology}");

    let mut hollow = grid([6, 6, 6]);
    let mut blank = vec![false; 216];
    blank[2 + 6 * (2 + 6 * 2)] = true;
    hollow.topology = Topology::Structured { points: [6; 3], blank };
    let topology = examine(&build(hollow).0);
    assert!(!topology.is_convex() && topology.components == 1, "{topology}");

    let mut apart = grid([6, 2, 2]);
    let mut blank = vec![false; 24];
    blank[2] = true;
    apart.topology = Topology::Structured { points: [6, 2, 2], blank };
    let topology = examine(&build(apart).0);
    assert!(!topology.is_convex() && topology.components == 2, "{topology}");
}

#[test]
fn a_flat_pair_is_not_delaunay_until_flipped() {
    // Two tall tetrahedra back to back over a triangle: each apex is in the other's circumsphere where they are low.
    let points = |height: f64| {
        let turn = |i: f64| DVec3::new((i * 2.094_395).cos(), (i * 2.094_395).sin(), 0.0);
        vec![turn(0.0), turn(1.0), turn(2.0), DVec3::Z * height, DVec3::Z * -height]
    };
    let tets = [vec![0, 1, 2, 3], vec![0, 2, 1, 4]].map(|t| (CellKind::Tetrahedron, t));
    let low = examine(&build(cells_of(points(0.5), &tets)).0);
    assert_eq!((low.not_delaunay.count, low.not_delaunay.first.as_deref()), (1, Some("tetrahedron 0")));
    assert!(low.is_convex(), "{low}");
    let high = examine(&build(cells_of(points(2.0), &tets)).0);
    assert!(high.is_delaunay(), "{high}");
}

#[test]
fn overfull_faces_and_overlaps_are_found() {
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Z, 2.0 * DVec3::Z];
    let tets = |apexes: &[u32]| apexes.iter().map(|&a| (CellKind::Tetrahedron, vec![0, 1, 2, a])).collect::<Vec<_>>();
    let (mesh, _) = build(cells_of(points.clone(), &tets(&[3, 4, 5])));
    let topology = examine(&mesh);
    assert_eq!(topology.overfull_faces.count, 1);
    assert_eq!(topology.overfull_faces.first.as_deref(), Some("face of vertices 0, 1, 2"));
    assert!(!topology.is_convex() && !topology.is_delaunay());
    let (mesh, _) = build(cells_of(points, &tets(&[3, 5])));
    assert_eq!(examine(&mesh).overlapping_pairs.count, 1);
}
