//! What is dropped, repaired or odd is counted, with the first one.

use glam::DVec3;
use tetralux::Error;
use tetralux::mesh::{CellKind, Mesh, ReadNote, Topology};
use tetralux::tet::{Adjacency, BuildOptions, FieldChoice, Finding, HexSplit, NO_TET, TetMesh};

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
fn coincident_points_are_merged_where_that_is_asked_for() {
    let mut points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    points.extend([DVec3::new(-0.0, 0.0, 0.0), DVec3::X, DVec3::Y, -DVec3::Z, DVec3::splat(7.0)]);
    let tets = [vec![0, 1, 2, 3], vec![4, 6, 5, 7]].map(|t| (CellKind::Tetrahedron, t));
    let mut mesh = cells_of(points, &tets);
    mesh.arrays[0].values = vec![0.0, 1.0, 2.0, 4.0, 50.0, 60.0, 70.0, -4.0, 9.0];
    let options = BuildOptions { weld: true, ..BuildOptions::default() };
    let (welded, census) = TetMesh::new(mesh, &FieldChoice::default(), options).unwrap();
    assert_eq!(found(&census.merged_points), (3, Some("point 4")));
    assert_eq!(found(&census.unused_points), (1, Some("point 8")), "merged points are not unused ones");
    assert_eq!(census.coincident_points, Finding::default());
    assert_eq!(welded.scalar, [0.0, 1.0, 2.0, 4.0, -4.0], "the first one's values");
    assert_eq!(welded.tets.len(), 2);
    assert!(census.to_string().contains("merged"), "{census}");
}

/// Two blocks that meet in a plane, the second one's points numbered the other way round: the diagonals of their common
/// faces agree only if its points are the same ones.
#[test]
fn welded_blocks_are_one_conforming_mesh() {
    let block = grid_points([3, 3, 3]);
    let mut points = block.clone();
    points.extend(block.iter().rev().map(|&p| p + DVec3::X));
    let corner = |i: usize, j: usize, k: usize| (i + 3 * (j + 3 * k)) as u32;
    let mut cells = Vec::new();
    for (i, j, k) in (0..8).map(|c| (c % 2, c / 2 % 2, c / 4)) {
        let square = |k| [corner(i, j, k), corner(i + 1, j, k), corner(i + 1, j + 1, k), corner(i, j + 1, k)];
        let nodes = [square(k), square(k + 1)].concat();
        cells.push((CellKind::Hexahedron, nodes.clone()));
        cells.push((CellKind::Hexahedron, nodes.into_iter().map(|n| 53 - n).collect()));
    }
    let mesh = |weld| {
        let options = BuildOptions { weld, ..BuildOptions::default() };
        TetMesh::new(cells_of(points.clone(), &cells), &FieldChoice::default(), options).unwrap()
    };
    let boundary = |mesh: &TetMesh| Adjacency::new(mesh).neighbors.iter().flatten().filter(|&&t| t == NO_TET).count();
    let ((apart, _), (welded, census)) = (mesh(false), mesh(true));
    assert_eq!((census.merged_points.count, welded.vertices.len()), (9, 45));
    // Two triangles a square: six faces of 2 x 2 squares for each block, and the four long faces of 4 x 2 and two ends.
    assert_eq!((boundary(&apart), boundary(&welded)), (96, 80));
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
