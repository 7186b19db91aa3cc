//! Legacy VTK files.

use glam::DVec3;
use tetralux::mesh::{ArrayChoice, Association, CellKind, DataArray, Mesh, ReadOptions, Topology, legacy};
use tetralux::space::Bounds;

use super::{difference, expected, fixtures, reals};

/// Asserts that `mesh` holds the arrays that VTK read; `kept` are the volume cells among VTK's.
fn assert_arrays(mesh: &Mesh, want: &serde_json::Value, kept: Option<&[usize]>, tolerance: f64, file: &str) {
    let wanted = want["arrays"].as_array().unwrap();
    assert_eq!(mesh.arrays.len(), wanted.len(), "{file}");
    assert_eq!(mesh.available.len(), wanted.len(), "{file}");
    for want in wanted {
        let name = want["name"].as_str().unwrap();
        let association = if want["of"] == "cell" { Association::Cell } else { Association::Point };
        let is_it = |a: &&DataArray| a.name == name && a.association == association;
        let array = mesh.arrays.iter().find(is_it).unwrap_or_else(|| panic!("{file} lacks {name}"));
        assert_eq!(array.components, want["components"].as_u64().unwrap() as usize, "{file}: {name}");
        let mut values = reals(&want["values"]);
        if let (Association::Cell, Some(kept)) = (association, kept) {
            let n = array.components;
            values = kept.iter().flat_map(|c| values[c * n..(c + 1) * n].to_vec()).collect();
        }
        let error = difference(&array.values, &values);
        assert!(error <= tolerance, "{file}: {name} differs by {error:e}");
    }
}

#[test]
fn legacy_files_say_what_vtk_reads() {
    let expected = expected();
    // The volume cells of `mixed`: all but a triangle, a line and a hexagonal prism.
    let volume = [0, 2, 3, 5, 6, 7, 8];
    for name in ["mixed", "image", "curvilinear", "hidden", "rectilinear"] {
        let want = &expected[name];
        for (encoding, version) in [("ascii", 42), ("ascii", 51), ("binary", 42), ("binary", 51)] {
            let file = format!("{name}_{encoding}_{version}.vtk");
            if (name, encoding) == ("hidden", "ascii") {
                continue;
            }
            let mesh = legacy::read(&fixtures().join(&file), &ReadOptions::default()).unwrap();
            // VTK writes 11 significant digits in text; sums of rounding at 1e-11 of 1 + |value|.
            let tolerance = if encoding == "ascii" { 1e-10 } else { 0.0 };
            let kept = (name == "mixed").then_some(&volume[..]);
            assert_arrays(&mesh, want, kept, tolerance, &file);
            assert_eq!(mesh.points.len() as u64, want["points"], "{file}");
            let bounds = Bounds::of(mesh.points.iter().copied());
            let sides = [0, 1, 2].map(|i| [bounds.min[i], bounds.max[i]]).concat();
            // VTK writes 8 digits of a 32-bit coordinate.
            assert!(difference(&sides, &reals(&want["bounds"])) <= tolerance.max(1e-7), "{file}: {sides:?}");
        }
    }
}

#[test]
fn legacy_cells_of_every_shape() {
    use CellKind::*;
    for file in ["mixed_ascii_42.vtk", "mixed_ascii_51.vtk", "mixed_binary_42.vtk", "mixed_binary_51.vtk"] {
        let mesh = legacy::read(&fixtures().join(file), &ReadOptions::default()).unwrap();
        let Topology::Cells { kinds, nodes } = &mesh.topology else { panic!("{file}: not explicit") };
        assert_eq!(kinds[..], [Tetrahedron, Pyramid, Wedge, Hexahedron, Voxel, Tetrahedron, Hexahedron], "{file}");
        assert_eq!(nodes[..9], [4, 9, 23, 18, 7, 26, 1, 6, 9], "{file}");
        assert_eq!(nodes[31..], [27, 22, 18, 13, 0, 17, 9, 15, 20, 14, 16, 26], "{file}: corner nodes only");
        let counts: Vec<_> = mesh.notes.iter().map(|n| n.count).collect();
        assert_eq!(counts, [2, 1, 2], "{file}: flat, other, quadratic: {:?}", mesh.notes);
    }
    for file in ["polyhedron_ascii_42.vtk", "polyhedron_binary_51.vtk"] {
        let mesh = legacy::read(&fixtures().join(file), &ReadOptions::default()).unwrap();
        assert_eq!(mesh.topology, Topology::Cells { kinds: vec![Tetrahedron], nodes: vec![0, 1, 2, 3] });
        assert!(mesh.notes[0].text.starts_with("Polyhedra") && mesh.notes[0].count == 1);
    }
}

#[test]
fn legacy_hidden_points_are_blank() {
    let mesh = legacy::read(&fixtures().join("hidden_binary_51.vtk"), &ReadOptions::default()).unwrap();
    let Topology::Structured { points, blank } = &mesh.topology else { panic!("not structured") };
    assert_eq!(*points, [3, 4, 2]);
    let hidden: Vec<_> = (0..24).filter(|i| blank[*i]).collect();
    assert_eq!(hidden, [0, 23]);
}

#[test]
fn only_wanted_arrays_are_decoded() {
    let path = fixtures().join("image_binary_51.vtk");
    let names = |choice: Option<&str>| {
        let arrays = ArrayChoice::One(choice.map(str::to_owned));
        let mesh = legacy::read(&path, &ReadOptions { arrays, ..Default::default() }).unwrap();
        assert_eq!(mesh.available.len(), 11);
        mesh.arrays.into_iter().map(|a| a.name).collect::<Vec<_>>()
    };
    assert_eq!(names(Some("velocity:mag")), ["velocity"]);
    assert_eq!(names(Some("with space")), ["with space"]);
    assert_eq!(names(None), ["temperature"]);
    let nothing = ReadOptions { arrays: ArrayChoice::One(Some("nothing".into())), ..Default::default() };
    let message = legacy::read(&path, &nothing).unwrap_err().to_string();
    assert!(message.contains("`nothing`") && message.contains("`temperature`"), "{message}");
    // An array that nobody wants may hold anything.
    let text = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nPOINT_DATA 8\n\
                SCALARS bad float\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 x\nSCALARS good float 1\nLOOKUP_TABLE default\n\
                1 2 3 4 5 6 7 nan\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtk");
    std::fs::write(&path, text).unwrap();
    let one = |name: &str| ReadOptions { arrays: ArrayChoice::One(Some(name.into())), ..Default::default() };
    assert!(legacy::read(&path, &one("good")).unwrap().arrays[0].values[7].is_nan());
    let error = legacy::read(&path, &one("bad")).unwrap_err().to_string();
    assert!(error.starts_with("line 9: \"x\" where a number should be"), "{error}");
}

#[test]
fn legacy_errors_tell_the_place() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtk");
    let head = "# vtk DataFile Version 2.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n";
    let tet = "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
    let fails = |text: &str, part: &str| {
        std::fs::write(&path, format!("{head}{text}")).unwrap();
        let error = legacy::read(&path, &ReadOptions::default()).map(|_| "no error").unwrap_err().to_string();
        assert!(error.contains(part), "{error:?} lacks {part:?}");
        assert!(error.ends_with("a.vtk"), "{error}");
    };
    std::fs::write(&path, format!("{head}{tet}")).unwrap();
    assert_eq!(legacy::read(&path, &ReadOptions::default()).unwrap().topology.cell_count(), 1);
    std::fs::write(&path, format!("{head}{tet}").replace('\n', "\r\n")).unwrap();
    assert_eq!(legacy::read(&path, &ReadOptions::default()).unwrap().points[3], DVec3::Z, "lines may end in CR LF");
    fails("POINTS 4000000000 float\n0 0 0\n", "12000000000 numbers promised, and 7 bytes left");
    fails(&tet.replace("0 1 2 3\n", "0 1 2 4\n"), "cell 0 has the node 4, and there are 4 points");
    fails(&tet.replace("4 0 1 2 3\n", "4 0 1 2 -1\n"), "cell 0 has the node -1");
    fails(&tet.replace("4 0 1 2 3\n", "9 0 1 2 3\n"), "cell 0 of 1 runs past");
    fails(&tet.replace("\n10\n", "\n12\n"), "cell 0 of VTK type 12 has 4 nodes instead of 8");
    fails(&tet.replace("0 0 1\n", "0 0 nan\n"), "point 3 has a coordinate that is not finite");
    fails(&format!("{tet}POINT_DATA 5\n"), "the arrays are for 5 points, and the grid has 4");
    fails(&format!("{tet}POINT_DATA 4\nSCALARS s float\nLOOKUP_TABLE default\n1.5 2.5"), "after 2 of 4 numbers");
    fails(&format!("{tet}NONSENSE"), "line 11: \"NONSENSE\" is no keyword");
    for file in ["surface_ascii_42.vtk", "surface_binary_51.vtk"] {
        let error = legacy::read(&fixtures().join(file), &ReadOptions::default()).unwrap_err().to_string();
        assert!(error.contains("surface (POLYDATA): no volume"), "{error}");
    }
    // A grid that would need 24 GB of points must be refused before they are made.
    let grid = "# vtk DataFile Version 2.0\nt\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 1000 1000 1000\n";
    std::fs::write(&path, grid).unwrap();
    let error = legacy::read(&path, &ReadOptions::default()).unwrap_err().to_string();
    assert!(error.contains("more than the file can have values for"), "{error}");
}
