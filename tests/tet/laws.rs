//! Geometry: volumes, orientation, conformity, gradients, coordinates.

use std::sync::Arc;

use glam::DVec3;
use tetralux::mesh::{CellKind, Topology};
use tetralux::tet::{FieldChoice, HexSplit, TetId, TetMesh};

use crate::support::{
    build, cells_of, grid, grid_points, mesh_of, mixed_cube, point_array, six_volumes, unmatched_faces, volume_in_data,
};

#[test]
fn mixed_cells_fill_the_cube_once_positively_and_conformingly() {
    for seed in 0..20 {
        let (mesh, census) = build(mixed_cube(4, 0.15, seed));
        assert!((volume_in_data(&mesh) - 1.0).abs() < 1e-13, "{seed}: {}", volume_in_data(&mesh));
        assert!(six_volumes(&mesh).all(|v| v > 0.0));
        assert_eq!(unmatched_faces(&mesh), 0, "{seed}");
        assert_eq!((census.reoriented.count, census.zero_volume.count), (0, 0), "{seed}");
        assert_eq!(census.tets, mesh.tets.len() as u64);
        assert_eq!(census.cells.iter().filter(|c| c.count > 0).count(), 4, "{seed}: every shape occurs");
    }
}

#[test]
fn the_conformity_check_sees_one_turned_diagonal() {
    // Two stacked cubes: the upper one's lower face is cut the other way by exchanging its points' numbers.
    let points = grid_points([2, 2, 3]);
    let lower = vec![0, 1, 3, 2, 4, 5, 7, 6];
    let upper = vec![4, 5, 7, 6, 8, 9, 11, 10];
    let (mut mesh, _) = build(cells_of(points, &[(CellKind::Hexahedron, lower), (CellKind::Hexahedron, upper)]));
    assert_eq!(unmatched_faces(&mesh), 0);
    let on_face = |t: &[u32; 4]| t.iter().filter(|v| (4..8).contains(*v)).count() == 3;
    let upper: Vec<usize> =
        (0..12).filter(|&i| mesh.tets[i].iter().any(|&v| v > 7) && on_face(&mesh.tets[i])).collect();
    assert_eq!(upper.len(), 2);
    for i in upper {
        // 4-7 becomes 5-6.
        let tet = &mut Arc::make_mut(&mut mesh.tets)[i];
        tet.iter_mut().for_each(|v| *v = [0, 1, 2, 3, 5, 4, 7, 6, 8, 9, 10, 11][*v as usize]);
    }
    assert!(unmatched_faces(&mesh) >= 4);
}

#[test]
fn structured_grids_give_six_or_five() {
    for (split, per_cell) in [(HexSplit::Six, 6), (HexSplit::FiveAlternating, 5)] {
        let (mesh, census) = TetMesh::new(grid([5, 4, 3]), &FieldChoice::default(), split).unwrap();
        assert_eq!(mesh.tets.len(), 24 * per_cell);
        assert_eq!(census.tets_made, 24 * per_cell as u64);
        assert!((volume_in_data(&mesh) - 1.0).abs() < 1e-14);
        assert!(six_volumes(&mesh).all(|v| v > 0.0));
        assert_eq!((unmatched_faces(&mesh), census.reoriented.count), (0, 0));
        if split == HexSplit::Six {
            // Kuhn: all six hold the diagonal 000-111.
            let diagonal = (5 * 4 + 5 + 1) as u32;
            assert!(mesh.tets.iter().all(|t| t.iter().max().unwrap() - t.iter().min().unwrap() == diagonal));
        }
    }
}

#[test]
fn a_left_handed_grid_is_turned() {
    let mut mirrored = grid([4, 4, 4]);
    mirrored.points.iter_mut().for_each(|p| p.x = -p.x);
    let (mesh, census) = build(mirrored);
    assert_eq!(census.reoriented.count, 6 * 27);
    assert_eq!(census.reoriented.first.as_deref(), Some("in cell 0"));
    assert_eq!(census.folded_cells.count, 0);
    assert!(six_volumes(&mesh).all(|v| v > 0.0));
    assert_eq!(unmatched_faces(&mesh), 0);
}

#[test]
fn an_affine_field_is_exact_everywhere() {
    let gradient = DVec3::new(3.0, -2.0, 0.5);
    for (scale, shift) in [(1.0, 0.0), (1e-7, 0.0), (3e8, 1e9)] {
        let mut mixed = mixed_cube(4, 0.2, 7);
        mixed.points.iter_mut().for_each(|p| *p = *p * scale + DVec3::splat(shift));
        let center = DVec3::splat(0.5 * scale + shift);
        mixed.arrays[0].values = mixed.points.iter().map(|&p| 100.0 + gradient.dot(p - center) / scale).collect();
        let (mesh, _) = build(mixed);
        let expected = gradient / scale;
        let error = |got: DVec3| (got - expected).length() / expected.length();
        let in_cells = (0..mesh.tets.len()).map(|t| error(mesh.cell_gradient(TetId(t as u32)))).fold(0.0, f64::max);
        let at_vertices = mesh.vertex_gradients().into_iter().map(error).fold(0.0, f64::max);
        // Measured: 2.9e-14 and 7e-15; the scalar's rounding at 100 is 1e-14, and cells are about 1/4 wide.
        assert!(in_cells < 2e-13, "{scale} {in_cells:e}");
        assert!(at_vertices < 5e-14, "{scale} {at_vertices:e}");
        assert!(mesh.gradient_magnitude.iter().all(|g| (g / expected.length() - 1.0).abs() < 5e-14));
        // The same comparison sees a field that is off by 1e-11 at one vertex.
        let mut planted = mesh.clone();
        planted.scalar[planted.tets[0][0] as usize] += 1e-11;
        assert!(error(planted.cell_gradient(TetId(0))) > 2e-13);
    }
}

#[test]
fn vertex_gradients_are_weighted_by_volume() {
    // Two tetrahedra on one base, with volumes 1 : 3 and gradients 1 and 2 along z.
    let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, DVec3::new(0.0, 0.0, -3.0)];
    let values = vec![0.0, 0.0, 0.0, 1.0, -6.0];
    let topology = Topology::Cells { kinds: vec![CellKind::Tetrahedron; 2], nodes: vec![0, 1, 2, 3, 0, 2, 1, 4] };
    let (mesh, _) = build(mesh_of(points, topology, vec![point_array("s", 1, values)]));
    assert!((mesh.gradient_magnitude[0] - (1.0 + 3.0 * 2.0) / 4.0).abs() < 1e-14);
    assert!((mesh.gradient_magnitude[3] - 1.0).abs() < 1e-14);
}

#[test]
fn coordinates_are_recentred_and_scaled_by_a_power_of_two() {
    for (scale, shift) in [(1.0, 0.0), (1e-30, 0.0), (1e30, 0.0), (7.3, 1e5), (0.577_350_269_189_625_8, 0.0)] {
        let mut cube = grid([3, 3, 3]);
        cube.points.iter_mut().for_each(|p| *p = *p * scale + DVec3::splat(shift));
        let originals = cube.points.clone();
        let (mesh, _) = build(cube);
        assert_eq!(mesh.data_per_mesh.log2().fract(), 0.0);
        let radius = 0.5 * mesh.bounds().diagonal();
        assert!(radius > 0.5 - 1e-12 && radius <= 1.0 + 1e-12, "{scale}: {radius}");
        for (&p, &original) in mesh.vertices.iter().zip(&originals) {
            assert!((mesh.data_from_mesh(p) - original).length() <= 4e-16 * (scale + shift));
        }
    }
}

#[test]
fn slivers_stay_and_flat_cells_go() {
    let (a, b, c) = (DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.9, 0.1, 0.4), DVec3::new(0.3, 0.8, 0.2));
    let normal = (b - a).cross(c - a).normalize();
    let inside = (a + b + c) / 3.0;
    let points = vec![a, b, c, inside + 1e-6 * normal, 0.3 * a + 0.45 * b + 0.25 * c];
    let tets = [vec![0, 1, 2, 3], vec![0, 1, 2, 4]].map(|t| (CellKind::Tetrahedron, t));
    let (mesh, census) = build(cells_of(points, &tets));
    assert_eq!(mesh.tets.len(), 1);
    assert_eq!((census.zero_volume.count, census.zero_volume.first.as_deref()), (1, Some("in cell 1")));
    assert_eq!((census.unused_points.count, census.unused_points.first.as_deref()), (1, Some("point 4")));
}
