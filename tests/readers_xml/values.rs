//! Good files give the values that VTK wrote.

use std::path::PathBuf;

use glam::DVec3;
use tetralux::error::Error;
use tetralux::mesh::{ArrayChoice, ArrayInfo, Association, CellKind, ReadOptions, Topology, read};

use crate::checks::*;

fn encodings() -> Vec<String> {
    let mut names = vec!["encoding_ascii.vtu".to_owned()];
    for mode in ["binary", "appended", "base64"] {
        for compressor in ["none", "zlib", "lz4", "lzma"] {
            for layout in ["u32_le", "u32_be", "u64_le", "u64_be"] {
                names.push(format!("encoding_{mode}_{compressor}_{layout}.vtu"));
            }
        }
    }
    names
}

#[test]
fn every_encoding_gives_the_same_mesh() {
    let reference = load("encoding_ascii.vtu");
    assert_eq!(field_errors(&reference), [""; 0]);
    let Topology::Cells { kinds, .. } = &reference.topology else { panic!("not a list of cells") };
    assert_eq!(kinds.as_slice(), [CellKind::Hexahedron; 9]);
    assert_eq!(reference.points.len(), 32);
    assert_eq!(boxes_volume(&reference), 1.5 * 3.0 * 2.0);
    for name in encodings() {
        assert_eq!(load(&name), reference, "{name}");
    }
}

#[test]
fn every_type_of_values_is_read() {
    for name in ["types_ascii_le.vtu", "types_ascii_be.vtu", "types_appended_le.vtu", "types_appended_be.vtu"] {
        let mesh = load(name);
        assert_eq!(field_errors(&mesh), [""; 0], "{name}");
        for i in 0..32 {
            for signed in ["i8", "i16", "i32", "i64", "f32", "f64"] {
                assert_eq!(array(&mesh, signed).values[i], i as f64 - 10.0, "{name} {signed}");
            }
            for unsigned in ["u8", "u16", "u32", "u64"] {
                assert_eq!(array(&mesh, unsigned).values[i], i as f64, "{name} {unsigned}");
            }
        }
        let tensor = array(&mesh, "T");
        assert_eq!((tensor.components, tensor.values[9 * 7 + 4]), (9, 67.0));
        assert_eq!(noted(&mesh, "strings"), 1, "{name}: {:?}", mesh.notes);
        assert_eq!(mesh.available.len(), mesh.arrays.len());
    }
}

#[test]
fn only_what_is_asked_for_is_read() {
    let path = fixture("encoding_appended_zlib_u64_le.vtu");
    let names = |options| -> Vec<String> {
        let mesh = read(&path, &options).unwrap();
        assert_eq!(mesh.available.len(), 3);
        mesh.arrays.into_iter().map(|a| a.name).collect()
    };
    assert_eq!(names(one("U")), ["U"]);
    assert_eq!(names(one("U:mag")), ["U"]);
    assert_eq!(names(one("center_x:0")), ["center_x"]);
    assert_eq!(names(ReadOptions { arrays: ArrayChoice::One(None), ..ReadOptions::default() }), ["linear"]);
    let error = read(&path, &one("pressure")).unwrap_err();
    assert!(matches!(error, Error::Asked(_)));
    let text = error.to_string();
    for there in ["pressure", "linear", "U", "3 components", "center_x", "cell"] {
        assert!(text.contains(there), "{text}");
    }
}

#[test]
fn volume_cells_are_kept_and_the_rest_is_counted() {
    for name in ["mixed.vtu", "mixed_ascii.vtu"] {
        let mesh = load(name);
        let Topology::Cells { kinds, nodes } = &mesh.topology else { panic!("not a list of cells") };
        use CellKind::{Hexahedron, Pyramid, Tetrahedron, Voxel, Wedge};
        assert_eq!(kinds.as_slice(), [Hexahedron, Voxel, Pyramid, Wedge, Tetrahedron]);
        assert_eq!(nodes[8..16], [1, 8, 2, 9, 5, 10, 6, 11]);
        assert_eq!(nodes[nodes.len() - 4..], [8, 9, 10, 13]);
        assert_eq!(array(&mesh, "id").values, [1.0, 4.0, 5.0, 7.0, 9.0]);
        assert_eq!(field_errors(&mesh), [""; 0]);
        for (words, count) in [("0D", 1), ("1D", 1), ("2D", 3), ("polyhedra left", 1), ("hexagonal prisms", 1)] {
            assert_eq!(noted(&mesh, words), count, "{words}: {:?}", mesh.notes);
        }
    }
}

#[test]
fn quadratic_cells_are_read_by_their_corners() {
    let mesh = load("quadratic.vtu");
    let Topology::Cells { kinds, .. } = &mesh.topology else { panic!("not a list of cells") };
    use CellKind::{Hexahedron, Pyramid, Tetrahedron, Wedge};
    let shapes = [
        Tetrahedron,
        Hexahedron,
        Wedge,
        Pyramid,
        Hexahedron,
        Wedge,
        Wedge,
        Hexahedron,
        Pyramid,
        Tetrahedron,
        Hexahedron,
        Wedge,
        Tetrahedron,
    ];
    assert_eq!(kinds.as_slice(), shapes);
    assert_eq!(array(&mesh, "type").values, [24., 25., 26., 27., 29., 31., 32., 33., 37., 71., 72., 73., 78.]);
    // The corners are those of the unit shapes in the linear cells' order.
    for (i, (kind, cell)) in kinds.iter().zip(cells(&mesh)).enumerate() {
        let corners: Vec<[f64; 3]> =
            cell.iter().map(|&n| (mesh.points[n] - DVec3::X * 2.0 * i as f64).to_array()).collect();
        let square = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
        let lifted = |base: &[[f64; 3]]| [base, &base.iter().map(|p| [p[0], p[1], 1.0]).collect::<Vec<_>>()].concat();
        let triangle = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];
        let want = match kind {
            Tetrahedron => [&triangle[..], &[[0., 0., 1.]]].concat(),
            // VTK puts the base of the triquadratic pyramid at half height.
            Pyramid => [&square.map(|p| [p[0], p[1], corners[0][2]])[..], &[corners[4]]].concat(),
            Wedge => lifted(&triangle),
            _ => lifted(&square),
        };
        assert_eq!(corners, want, "cell {i}");
    }
    assert_eq!(noted(&mesh, "higher order"), 13);
}

#[test]
fn pieces_of_one_file_are_joined() {
    let mesh = load("pieces.vtu");
    assert_eq!(field_errors(&mesh), [""; 0]);
    // 24 boxes of volume 2 each, whatever their order; ghost cells of the pieces are left out.
    assert_eq!((cells(&mesh).len(), boxes_volume(&mesh)), (24, 24.0), "{:?}", mesh.notes);
}

#[test]
fn pieces_of_a_parallel_file_are_joined_without_ghosts_and_conforming() {
    let mesh = load("ghosts.pvtu");
    assert_eq!(field_errors(&mesh), [""; 0]);
    assert_eq!((cells(&mesh).len(), boxes_volume(&mesh)), (24, 24.0));
    assert_eq!(mesh.points.len(), 60, "shared points are merged");
    assert!(noted(&mesh, "ghost") > 0 && noted(&mesh, "merged") > 0, "{:?}", mesh.notes);
    assert!(mesh.available.iter().all(|a| a.name != "vtkGhostType"));
    let single = load("ghosts_1.vtu");
    assert!(cells(&single).len() < 24 && noted(&single, "ghost") > 0);
    let boxed = read(&fixture("ghosts.pvtu"), &one("U:x")).unwrap();
    assert_eq!((boxed.arrays.len(), boxed.points), (1, mesh.points));
}

#[test]
fn images_have_origin_spacing_and_direction() {
    for name in ["image.vti", "image_ascii.vti", "image.pvti"] {
        let mesh = load(name);
        assert_eq!(field_errors(&mesh), [""; 0], "{name}");
        assert_eq!(mesh.topology, Topology::Structured { points: [4, 4, 3], blank: vec![] });
        // Index (2, -1, 0) times the spacing is (1, -1, 0); turned by a quarter about z, (1, 1, 0).
        assert_eq!(mesh.points[0], DVec3::new(2.0, 3.0, 3.0));
        assert_eq!(mesh.points[1], DVec3::new(2.0, 3.5, 3.0));
        assert_eq!(mesh.points[47], DVec3::new(-1.0, 4.5, 7.0));
    }
}

#[test]
fn rectilinear_and_curvilinear_grids_are_read() {
    for name in ["rectilinear.vtr", "rectilinear.pvtr"] {
        let mesh = load(name);
        assert_eq!(field_errors(&mesh), [""; 0], "{name}");
        assert_eq!(mesh.topology, Topology::Structured { points: [4, 4, 3], blank: vec![] });
        assert_eq!((mesh.points[0], mesh.points[47]), (DVec3::new(0.0, -1.0, 2.0), DVec3::new(7.0, 4.0, 5.0)));
    }
    for name in ["curved.vts", "curved.pvts"] {
        let mesh = load(name);
        assert_eq!(field_errors(&mesh), [""; 0], "{name}");
        assert_eq!(mesh.topology, Topology::Structured { points: [4, 4, 3], blank: vec![] });
        assert!((mesh.points[47] - DVec3::new(2.4, 3.0, 4.0)).length() < 1e-12);
    }
}

#[test]
fn blanked_points_and_cells_are_marked_or_left_out() {
    let mesh = load("blanked_point.vts");
    let Topology::Structured { blank, .. } = &mesh.topology else { panic!("not structured") };
    assert_eq!(blank.iter().enumerate().filter(|(_, b)| **b).map(|(i, _)| i).collect::<Vec<_>>(), [5]);
    let mesh = load("blanked_cell.vts");
    let Topology::Cells { kinds, .. } = &mesh.topology else { panic!("not a list of cells") };
    assert_eq!(kinds.as_slice(), [CellKind::Voxel; 17]);
    assert_eq!(field_errors(&mesh), [""; 0]);
    assert_eq!(noted(&mesh, "hidden"), 1);
    let whole = load("curved.vts");
    let mut centers = array(&whole, "center_x").values.clone();
    centers.remove(4);
    assert_eq!(array(&mesh, "center_x").values, centers);
}

#[test]
fn series_are_read_by_step() {
    let step = |step| read(&fixture("series.pvd"), &ReadOptions { step, ..ReadOptions::default() });
    for i in 0..2 {
        let mesh = step(Some(i)).unwrap();
        assert_eq!(array(&mesh, "step").values, [10.0 * i as f64; 8]);
    }
    let last = step(None).unwrap();
    assert_eq!(array(&last, "step").values, [20.0; 12], "two parts, joined");
    assert_eq!(field_errors(&last), [""; 0]);
    assert!(last.notes.iter().any(|n| n.text.contains("last of 3")));
    let error = step(Some(3)).unwrap_err();
    assert!(matches!(&error, Error::Asked(text) if text.contains("0 to 2")), "{error}");
}

#[test]
fn meshes_without_volume_are_refused_by_what_they_hold() {
    for (name, word) in [("surface.vtu", "2D"), ("plane.vti", "4 x 4 x 1")] {
        let error = read(&fixture(name), &ReadOptions::default()).unwrap_err();
        assert!(
            matches!(&error, Error::Mesh(text) if text.contains("no volume cells") && text.contains(word)),
            "{error}"
        );
    }
}

#[test]
fn what_lists_arrays_names_their_place() {
    let mesh = load("mixed.vtu");
    let id = ArrayInfo { name: "id".into(), association: Association::Cell, components: 1 };
    assert!(mesh.available.contains(&id));
}

#[test]
#[ignore = "needs TETRALUX_DATA"]
fn real_data_are_read() {
    let data = PathBuf::from(std::env::var_os("TETRALUX_DATA").expect("TETRALUX_DATA names the folder of test data"));
    let expect = [
        ("tet/bluntfin_tet.vtu", 40_960, 224_874),
        ("tet/post_tet.vtu", 109_744, 616_050),
        ("tet/can.vtu", 6_724, 28_800),
        ("tet/kiefer_bracket.vtu", 16_468, 56_786),
        ("structured/bluntfin.vts", 40_960, 39 * 31 * 31),
        ("structured/post.vts", 109_744, 37 * 75 * 37),
        ("structured/fuel.vti", 262_144, 63 * 63 * 63),
        ("structured/carotid_speed.vti", 76 * 49 * 45, 75 * 48 * 44),
        ("registry/fire_ug.vtu", 12_323, 10_462),
    ];
    for (name, points, cells) in expect {
        let mesh = read(&data.join(name), &ReadOptions::default()).unwrap();
        promises(&mesh).unwrap();
        assert_eq!((mesh.points.len(), mesh.topology.cell_count()), (points, cells), "{name}");
    }
    for folder in ["tet", "structured", "registry"] {
        for entry in std::fs::read_dir(data.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|e| ["vtu", "vti", "vts"].iter().any(|known| e == *known)) {
                let mesh = read(&path, &ReadOptions { arrays: ArrayChoice::One(None), ..ReadOptions::default() });
                promises(&mesh.unwrap()).unwrap();
            }
        }
    }
}
