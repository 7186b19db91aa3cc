//! Which array becomes the field.

use tetralux::Error;
use tetralux::mesh::{ArrayInfo, Association, Mesh};
use tetralux::tet::{FieldChoice, HexSplit, TetMesh};

use crate::support::{cell_array, grid, point_array};

/// Eight points, one cell.
fn with_arrays() -> Mesh {
    let mut mesh = grid([2, 2, 2]);
    let tuple = |i: usize| [i as f64, 2.0, -2.0];
    mesh.arrays = vec![
        point_array("U", 3, (0..8).flat_map(tuple).collect()),
        point_array("p", 1, (0..8).map(|i| 10.0 * i as f64).collect()),
        point_array("odd:x", 1, (0..8).map(|i| -(i as f64)).collect()),
        cell_array("q", 1, vec![4.0]),
    ];
    mesh
}

fn field(text: Option<&str>) -> tetralux::Result<TetMesh> {
    let choice = text.map_or_else(FieldChoice::default, FieldChoice::parse);
    Ok(TetMesh::new(with_arrays(), &choice, HexSplit::Six)?.0)
}

#[test]
fn names_and_suffixes() {
    let value = |text| {
        let mesh = field(Some(text)).unwrap();
        (mesh.field.clone(), mesh.scalar[1])
    };
    assert_eq!(value("p"), ("p".into(), 10.0));
    assert_eq!(value("U"), ("U:mag".into(), 3.0));
    assert_eq!(value("U:mag"), ("U:mag".into(), 3.0));
    assert_eq!(value("U:x"), ("U:x".into(), 1.0));
    assert_eq!(value("U:2"), ("U:z".into(), -2.0));
    assert_eq!(value("odd:x"), ("odd:x".into(), -1.0));
    assert_eq!(value("p:0"), ("p:x".into(), 10.0));
    assert_eq!(value("q"), ("q".into(), 4.0));
}

#[test]
fn the_default_is_the_first_scalar_of_the_points_then_a_magnitude_then_cells() {
    assert_eq!(field(None).unwrap().field, "p");
    let only = |keep: &str| {
        let mut mesh = with_arrays();
        mesh.arrays.retain(|a| a.name == keep);
        let (mesh, census) = TetMesh::new(mesh, &FieldChoice::default(), HexSplit::Six).unwrap();
        (mesh.field, census.notes.len())
    };
    assert_eq!(only("U"), ("U:mag".into(), 1));
    assert_eq!(only("q"), ("q".into(), 1));
}

#[test]
fn what_is_not_there_is_answered_with_what_is() {
    let message = |text| match field(Some(text)) {
        Err(Error::Asked(message)) => message,
        other => panic!("{other:?}"),
    };
    let nothing = message("T");
    for part in ["\"T\"", "\"U\" (points, 3 components)", "\"p\" (points, 1 component)", "\"q\" (cells, 1 component)"] {
        assert!(nothing.contains(part), "{nothing}");
    }
    for text in ["U:3", "p:y", "U:w", "U:-1", "U:"] {
        assert!(message(text).contains("component"), "{text}: {}", message(text));
    }
    let mut empty = with_arrays();
    empty.arrays.clear();
    empty.available = vec![ArrayInfo { name: "other".into(), association: Association::Point, components: 1 }];
    let result = TetMesh::new(empty, &FieldChoice::default(), HexSplit::Six);
    assert!(matches!(result, Err(Error::Mesh(m)) if m.contains("\"other\"")));
}

#[test]
fn cell_data_become_means_at_the_points() {
    let mut mesh = grid([4, 2, 2]);
    mesh.arrays = vec![cell_array("q", 1, vec![1.0, 3.0, f64::NAN])];
    let (mesh, census) = TetMesh::new(mesh, &FieldChoice::default(), HexSplit::Six).unwrap();
    // The cell without a value is left out, and its neighbour is not.
    assert_eq!(mesh.tets.len(), 12);
    assert_eq!((census.non_finite_cells.count, census.non_finite_cells.first.as_deref()), (1, Some("cell 2")));
    assert_eq!(census.unused_points.count, 4);
    assert_eq!(mesh.scalar[..3], [1.0, 2.0, 3.0]);
    assert!(census.notes[0].contains("cells"), "{:?}", census.notes);
}

#[test]
fn magnitudes_do_not_overflow() {
    let mut mesh = grid([2, 2, 2]);
    mesh.arrays = vec![point_array("U", 2, [3e200, 4e200].repeat(8))];
    let (mesh, _) = TetMesh::new(mesh, &FieldChoice::parse("U"), HexSplit::Six).unwrap();
    assert!(mesh.scalar.iter().all(|s| (s / 5e200 - 1.0).abs() < 1e-15));
}

#[test]
fn arrays_of_the_wrong_length_are_refused() {
    let mut mesh = grid([2, 2, 2]);
    mesh.arrays[0].values.pop();
    assert!(matches!(TetMesh::new(mesh, &FieldChoice::default(), HexSplit::Six), Err(Error::Mesh(_))));
}
