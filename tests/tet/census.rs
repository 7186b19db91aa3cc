//! What is dropped, repaired or odd is counted, with the first one.

use glam::DVec3;
use tetralux::Error;
use tetralux::mesh::{CellKind, Mesh, ReadNote, Topology};
use tetralux::tet::{FieldChoice, Finding, HexSplit, TetMesh};

use crate::support::{build, cells_of, grid, grid_points, six_volumes, volume_in_data};

fn found(finding: &Finding) -> (u64, Option<&str>) {
    (finding.count, finding.first.as_deref())
}

fn refusal(mesh: Mesh) -> String {
    match TetMesh::new(mesh, &FieldChoice::default(), HexSplit::Six) {
        Err(Error::Mesh(message)) => message,
        other => panic!("{other:?}"),
    }
}

#[test]
fn blanked_cells_and_cells_without_values_are_left_out() {
    let mut mesh = grid([5, 2, 2]);
    mesh.arrays[0].values[4] = f64::INFINITY;
    let mut blank = vec![false; 20];
    blank[0] = true;
    mesh.topology = Topology::Structured { points: [5, 2, 2], blank };
    let (mesh, census) = build(mesh);
    assert_eq!(found(&census.blanked_cells), (1, Some("cell 0")));
    assert_eq!(found(&census.non_finite_cells), (1, Some("cell 3")));
    assert_eq!((census.cells[0].kind, census.cells[0].count), ("hexahedra", 3));
    assert_eq!(found(&census.unused_points), (8, Some("point 0")));
    assert_eq!((mesh.tets.len(), mesh.vertices.len()), (12, 12));
    assert!((volume_in_data(&mesh) - 0.5).abs() < 1e-15);
}

#[test]
fn a_hexahedron_collapsed_to_a_wedge_keeps_its_volume() {
    let cells = [(CellKind::Hexahedron, vec![0, 1, 2, 2, 4, 5, 6, 6])];
    let mut points = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::splat(9.0)];
    points.extend([DVec3::Z, DVec3::new(1.0, 0.0, 1.0), DVec3::ONE]);
    let (mesh, census) = build(cells_of(points, &cells));
    assert_eq!(mesh.tets.len(), 3);
    assert_eq!(found(&census.repeated_node), (3, Some("in cell 0")));
    assert_eq!(census.tets_made, 6);
    assert!((volume_in_data(&mesh) - 0.5).abs() < 1e-15);
    // The unused point far away did not move the centre.
    assert_eq!(mesh.center_in_data, DVec3::splat(0.5));
}

#[test]
fn a_folded_cell_is_told_from_a_reversed_one() {
    let mut points = grid_points([2, 2, 2]);
    points[1] = DVec3::new(0.2, 0.8, 0.0);
    let hexahedron = vec![0, 1, 3, 2, 4, 5, 7, 6];
    let (mesh, census) = build(cells_of(points, &[(CellKind::Hexahedron, hexahedron)]));
    assert_eq!(found(&census.folded_cells), (1, Some("cell 0")));
    assert!(census.reoriented.count > 0);
    assert!(six_volumes(&mesh).all(|v| v > 0.0));
}

#[test]
fn coincident_points_are_counted_and_kept() {
    let mut points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    points.extend([DVec3::new(-0.0, 0.0, 0.0), DVec3::X, DVec3::Y, -DVec3::Z]);
    let tets = [vec![0, 1, 2, 3], vec![4, 6, 5, 7]].map(|t| (CellKind::Tetrahedron, t));
    let (mesh, census) = build(cells_of(points, &tets));
    assert_eq!(found(&census.coincident_points), (3, Some("point 4, where point 0 is")));
    assert_eq!(mesh.vertices.len(), 8);
}

#[test]
fn dropped_cells_do_not_move_the_centre() {
    // A flat cell sticks out far.
    let mut points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    points.push(DVec3::new(1e6, 0.0, 0.0));
    let tets = [vec![0, 1, 2, 3], vec![0, 1, 2, 4]].map(|t| (CellKind::Tetrahedron, t));
    let (mesh, census) = build(cells_of(points, &tets));
    assert_eq!(census.zero_volume.count, 1);
    assert_eq!((mesh.center_in_data, mesh.data_per_mesh), (DVec3::splat(0.5), 1.0));
}

#[test]
fn the_table_tells_everything() {
    let mut mesh = grid([40, 40, 2]);
    mesh.notes.push(ReadNote { text: "triangles are left out".into(), count: 12 });
    mesh.points[1] = mesh.points[0];
    let (_, census) = build(mesh);
    let table = census.to_string();
    for part in ["hexahedra", "1,521", "9,126", "zero volume", "first: in cell 0", "triangles are left out (12)"] {
        assert!(table.contains(part), "{table}");
    }
    let json = serde_json::to_value(&census).unwrap();
    assert_eq!(json["zero_volume"]["count"], census.zero_volume.count);
}

#[test]
fn meshes_that_cannot_be_are_refused() {
    let broken = |change: fn(&mut Mesh)| {
        let tets = [(CellKind::Tetrahedron, vec![0, 1, 2, 4])];
        let mut mesh = cells_of(grid_points([2, 2, 2]), &tets);
        change(&mut mesh);
        refusal(mesh)
    };
    assert!(broken(|m| m.points[1].y = f64::NAN).contains("point 1"));
    assert!(broken(|m| m.points[1] = DVec3::splat(1e300)).contains("change their unit"));
    assert!(broken(|m| m.points.iter_mut().for_each(|p| *p *= 1e-200)).contains("change their unit"));
    assert!(broken(|m| m.points.iter_mut().for_each(|p| p.z = 0.0)).contains("flat"));
    assert!(broken(|m| m.arrays[0].values.fill(f64::NAN)).contains("not finite"));
    assert!(broken(|m| m.arrays[0].values[0] = 1e308).contains("change their unit"));
    let cells = |nodes: &[u32]| Topology::Cells { kinds: vec![CellKind::Tetrahedron], nodes: nodes.to_vec() };
    let with = |topology| {
        let mut mesh = cells_of(grid_points([2, 2, 2]), &[]);
        mesh.topology = topology;
        refusal(mesh)
    };
    assert!(with(cells(&[0, 1, 2, 8])).contains("point 8"));
    assert!(with(cells(&[0, 1, 2])).contains("need 4 nodes"));
    assert!(with(Topology::Cells { kinds: vec![], nodes: vec![] }).contains("0 volume cells"));
    assert!(with(Topology::Structured { points: [3, 2, 2], blank: vec![] }).contains("3 x 2 x 2"));
    assert!(with(Topology::Structured { points: [8, 1, 1], blank: vec![] }).contains("at least 2"));
    assert!(with(Topology::Structured { points: [usize::MAX, 2, 2], blank: vec![] }).contains("8 points"));
    assert!(with(Topology::Structured { points: [2; 3], blank: vec![true] }).contains("blanking"));
    let five = cells_of(grid_points([2, 2, 2]), &[(CellKind::Voxel, (0..8).collect())]);
    let five = TetMesh::new(five, &FieldChoice::default(), HexSplit::FiveAlternating);
    assert!(matches!(five, Err(Error::Asked(_))));
}
