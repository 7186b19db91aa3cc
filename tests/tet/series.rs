//! The same tetrahedra with another field or at another time.

use glam::DVec3;
use tetralux::mesh::synth::Sample;
use tetralux::mesh::{Association, DataArray, Mesh};
use tetralux::tet::{FieldChoice, HexSplit, TetMesh};

fn two_fields() -> Mesh {
    let mut mesh = Sample::Tangle.mesh(2_000);
    let values = mesh.points.iter().map(|p| (3.0 * p.x).sin() + p.y * p.z).collect();
    mesh.arrays.push(DataArray { name: "second".into(), association: Association::Point, components: 1, values });
    mesh
}

fn made(mesh: Mesh, field: &FieldChoice) -> (TetMesh, tetralux::tet::Census) {
    TetMesh::new(mesh, field, HexSplit::default()).expect("a mesh")
}

#[test]
fn another_field_is_as_if_it_had_been_the_first() {
    let second = FieldChoice::parse("second");
    let (first, census) = made(two_fields(), &FieldChoice::default());
    let got = first.with_field(&census, two_fields(), &second).expect("a field");
    let (want, _) = made(two_fields(), &second);
    assert_eq!((&got.tets, &got.vertices, &got.field), (&want.tets, &want.vertices, &want.field));
    assert_eq!((got.scalar, got.gradient_magnitude), (want.scalar.clone(), want.gradient_magnitude));
    assert_ne!(first.scalar, want.scalar);
}

#[test]
fn points_may_move() {
    let moved = || {
        let mut mesh = two_fields();
        mesh.points.iter_mut().for_each(|p| *p = 3.0 * *p + DVec3::new(p.y * p.y, 7.0, 0.2 * p.x));
        mesh
    };
    // These change nothing in mesh space.
    let larger = || Mesh { points: two_fields().points.iter().map(|&p| 2.0 * p).collect(), ..two_fields() };
    let aside = || Mesh { points: two_fields().points.iter().map(|&p| p + DVec3::X).collect(), ..two_fields() };
    let (first, census) = made(two_fields(), &FieldChoice::default());
    let meshes: [&dyn Fn() -> Mesh; 3] = [&moved, &larger, &aside];
    for mesh in meshes {
        let got = first.with_field(&census, mesh(), &FieldChoice::default()).expect("a field");
        let (want, _) = made(mesh(), &FieldChoice::default());
        assert_eq!((got.data_per_mesh, got.center_in_data), (want.data_per_mesh, want.center_in_data));
        assert_eq!((got.vertices, got.gradient_magnitude), (want.vertices, want.gradient_magnitude));
    }
}

#[test]
fn what_does_not_fit_is_refused() {
    let (first, census) = made(two_fields(), &FieldChoice::default());
    let refusal = |change: fn(&mut Mesh), field: &str| {
        let mut mesh = two_fields();
        change(&mut mesh);
        first.with_field(&census, mesh, &FieldChoice::parse(field)).expect_err("nothing that fits").to_string()
    };
    assert!(refusal(|_| {}, "third").contains("no field \"third\""));
    assert!(refusal(|mesh| mesh.arrays[1].values[7] = f64::NAN, "second").contains("not finite at point 7"));
    let in_cell = refusal(
        |mesh| {
            let mut values = vec![1.0; mesh.topology.cell_count()];
            values[9] = f64::NAN;
            let (name, association) = ("of cells".into(), Association::Cell);
            mesh.arrays.push(DataArray { name, association, components: 1, values });
        },
        "of cells",
    );
    assert!(in_cell.contains("not finite in cell 9"), "{in_cell}");
    let more = refusal(
        |mesh| {
            mesh.points.push(DVec3::ZERO);
            mesh.arrays.iter_mut().for_each(|a| a.values.push(0.0));
        },
        "second",
    );
    assert!(more.contains("make tetrahedra anew"), "{more}");
    let nowhere = refusal(|mesh| mesh.points[5].y = f64::INFINITY, "second");
    assert!(nowhere.contains("point 5 lies at"), "{nowhere}");
    let mirrored = refusal(|mesh| mesh.points.iter_mut().for_each(|p| p.x = -p.x), "second");
    assert!(mirrored.contains("turned tetrahedron 0 over"), "{mirrored}");
}
