//! What a box leaves of a mesh: as much, of the same values, conforming.

use glam::DVec3;
use tetralux::Error;
use tetralux::space::Bounds;
use tetralux::tet::{Adjacency, TetId, TetMesh};

use crate::support::{build, mixed_cube, six_volumes, unmatched_faces, volume_in_data};

/// (scalar, gradient magnitude) at a place in data space, of the cell that it lies deepest in.
fn values_at(mesh: &TetMesh, place: DVec3) -> [f64; 2] {
    let p = mesh.mesh_from_data(place);
    let shares = |i: usize| {
        let [a, b, c, d] = mesh.corners(TetId(i as u32));
        let inner = glam::DMat3::from_cols(b - a, c - a, d - a).inverse() * (p - a);
        [1.0 - inner.element_sum(), inner.x, inner.y, inner.z]
    };
    let depth = |i: &usize| shares(*i).into_iter().fold(f64::INFINITY, f64::min);
    let cell = (0..mesh.tets.len()).max_by(|a, b| depth(a).total_cmp(&depth(b))).expect("cells");
    let of = |values: &[f64]| (0..4).map(|k| shares(cell)[k] * values[mesh.tets[cell][k] as usize]).sum();
    [of(&mesh.scalar), of(&mesh.gradient_magnitude)]
}

/// A cube of mixed cells whose field is no linear one.
fn cube(seed: u64) -> TetMesh {
    let (mut mesh, _) = build(mixed_cube(4, if seed.is_multiple_of(2) { 0.15 } else { 0.0 }, seed));
    for i in 0..mesh.vertices.len() {
        let p = mesh.data_from_mesh(mesh.vertices[i]);
        mesh.scalar[i] = (7.0 * p.x).sin() + p.y * p.z;
        mesh.gradient_magnitude[i] = 1.0 + (5.0 * p.z - p.x).cos();
    }
    mesh
}

fn boxes() -> [Bounds; 4] {
    let of = |min: [f64; 3], max: [f64; 3]| Bounds { min: min.into(), max: max.into() };
    [
        of([0.21, 0.13, 0.32], [0.83, 0.79, 0.9]),
        // Sides through vertices and along faces of the grid that the cube was.
        of([0.25, 0.0, -1.0], [0.75, 1.0, 0.5]),
        // Within one cell or two.
        of([0.4, 0.41, 0.42], [0.401, 0.412, 0.4204]),
        of([-3.0, -3.0, 0.99], [3.0, 3.0, 3.0]),
    ]
}

fn inside_the_cube(bounds: &Bounds) -> Bounds {
    Bounds { min: bounds.min.max(DVec3::ZERO), max: bounds.max.min(DVec3::ONE) }
}

fn volume(bounds: &Bounds) -> f64 {
    (bounds.max - bounds.min).element_product()
}

#[test]
fn what_is_left_fills_the_box_conformingly() {
    for seed in 0..4 {
        let mesh = cube(seed);
        for (number, bounds) in boxes().iter().enumerate() {
            let left = mesh.clipped_to(bounds).unwrap_or_else(|e| panic!("{e}"));
            let want = inside_the_cube(bounds);
            let error = |want: &Bounds| (volume_in_data(&left) / volume(want) - 1.0).abs();
            assert!(error(&want) < 1e-10, "{seed} {number}: {:e}", error(&want));
            let planted = Bounds { max: want.max + DVec3::X * 1e-6 * (want.max - want.min), ..want };
            assert!(error(&planted) > 1e-7, "a side that is wrong by 1e-6 must show");
            assert!(six_volumes(&left).all(|v| v > 0.0));
            assert_eq!(unmatched_faces(&left), 0, "{seed} {number}");
            let got = left.bounds_in_data();
            assert!(got.min.distance(want.min) < 1e-12 && got.max.distance(want.max) < 1e-12, "{got:?} {want:?}");
            assert!((0.5..=1.0).contains(&(0.5 * left.bounds().diagonal())), "mesh space is around what is left");
            // All of its surface lies on the box, so nothing is open inside.
            for (tet, face) in Adjacency::new(&left).boundary_faces() {
                let corners = left.corners(tet);
                let on: Vec<DVec3> = (0..4).filter(|&k| k != face).map(|k| left.data_from_mesh(corners[k])).collect();
                let is_on = |axis: usize, at: f64| on.iter().all(|p| (p[axis] - at).abs() < 1e-9);
                assert!((0..3).any(|axis| is_on(axis, want.min[axis]) || is_on(axis, want.max[axis])), "{on:?}");
            }
        }
    }
}

#[test]
fn values_stay_where_they_were() {
    let mesh = cube(9);
    for bounds in boxes() {
        let left = mesh.clipped_to(&bounds).unwrap_or_else(|e| panic!("{e}"));
        let inner = inside_the_cube(&bounds);
        for i in 0..60 {
            // Additive recurrences (Roberts 2018) spread over the box.
            let share = |step: f64| (0.5 + step * f64::from(i)).fract();
            let shares = DVec3::new(share(0.819_172_5), share(0.671_043_6), share(0.549_700_5));
            let place = inner.min + shares * (inner.max - inner.min);
            let (want, got) = (values_at(&mesh, place), values_at(&left, place));
            for k in 0..2 {
                assert!((got[k] - want[k]).abs() < 1e-9, "{place}: {got:?}, not {want:?}");
            }
            let aside = values_at(&left, place + 1e-5 * (inner.max - inner.min));
            assert!(aside != want, "the comparison tells places apart");
        }
    }
}

#[test]
fn a_box_around_all_changes_nothing_and_one_beside_is_refused() {
    let mesh = cube(3);
    let all = mesh.clipped_to(&Bounds { min: DVec3::splat(-1.0), max: DVec3::splat(2.0) }).expect("all of it");
    assert_eq!((&all.vertices, &all.tets, &all.scalar), (&mesh.vertices, &mesh.tets, &mesh.scalar));
    let error = mesh.clipped_to(&Bounds { min: DVec3::splat(1.5), max: DVec3::splat(2.0) }).expect_err("nothing");
    assert!(matches!(&error, Error::Asked(text) if text.contains("1.5") && text.contains("nothing")), "{error}");
}
