//! What is said of a mesh before any eye is known.

use glam::DVec3;
use tetralux::plan::order::{PowerCensus, PowerOrder, Proof};
use tetralux::tet::{Adjacency, Census, TetMesh};

use crate::common::boxes::{box_mesh, tet_mesh};
use crate::support::{count, delaunay, fields, without};

fn proof(mesh: &TetMesh) -> (Proof, bool, String) {
    let adjacency = Adjacency::new(mesh);
    let census = PowerCensus::new(mesh, &adjacency);
    assert_eq!(census.is_convex_mesh, Census::topology(mesh, &adjacency).is_convex());
    (census.proof(), census.is_convex_mesh, census.to_string())
}

#[test]
fn convex_meshes_are_convex() {
    for seed in 0..3 {
        let (proof, is_convex, text) = proof(&delaunay(seed));
        assert!(proof == Proof::Order && is_convex, "{text}");
        assert!(text.ends_with("  exact\n") && text.contains("identity"), "{text}");
    }
    let one = tet_mesh(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], vec![[0, 1, 2, 3]], fields);
    assert_eq!(proof(&one).0, Proof::Order);
}

#[test]
fn what_is_left_of_a_delaunay_mesh_is_right_between_neighbors() {
    let through = |p: DVec3| (p.x - 0.5).abs() < 0.15;
    let hole = |p: DVec3| (p - 0.5).length() < 0.25;
    let dent = |p: DVec3| (p - DVec3::new(1.0, 0.5, 0.5)).length() < 0.3;
    for drop in [&through as &dyn Fn(DVec3) -> bool, &hole, &dent] {
        let mesh = without(delaunay(2), drop);
        let (proof, is_convex, text) = proof(&mesh);
        assert!(proof == Proof::Neighbors && !is_convex, "{text}");
        assert!(text.contains("between neighbours"), "{text}");
        let census = PowerCensus::new(&mesh, &Adjacency::new(&mesh));
        let power = PowerOrder::new(&mesh, &census.metric);
        assert_eq!(count(&mesh, 12, |camera| power.order(&mesh, camera)).wrong, 0);
    }
}

#[test]
fn of_overlapping_neighbors_nothing_is_proved() {
    let points = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, 2.0 * DVec3::Z, DVec3::new(0.3, 0.3, -1.0)];
    for (tets, overlapping, overfull) in [
        (vec![[0, 1, 2, 3], [0, 1, 2, 4]], 1, 0),
        (vec![[0, 1, 2, 3], [0, 1, 2, 4], [0, 2, 1, 5]], 0, 1),
        (vec![[0, 1, 2, 3], [0, 2, 1, 5]], 0, 0),
    ] {
        let mesh = tet_mesh(&points, tets, fields);
        let census = PowerCensus::new(&mesh, &Adjacency::new(&mesh));
        assert_eq!((census.overlapping_pairs, census.overfull_faces), (overlapping, overfull), "{census}");
        let is_clean = overlapping + overfull == 0;
        assert_eq!((census.interior_faces == 1, census.proof() != Proof::Nothing), (is_clean, is_clean), "{census}");
        assert_eq!(census.to_string().ends_with("  not exact\n"), !is_clean, "{census}");
    }
}

#[test]
fn dented_lattices_are_not_convex() {
    let mesh = without(box_mesh(3, DVec3::ZERO, DVec3::ONE, fields), |p| p.min_element() > 0.67);
    let (proof, is_convex, text) = proof(&mesh);
    assert!(proof == Proof::Neighbors && !is_convex, "{text}");
}
