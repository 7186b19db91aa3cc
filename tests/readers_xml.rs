//! VTK XML files, written by VTK itself (scripts/fixtures.py), are read as VTK would; broken ones are refused.

use std::path::{Path, PathBuf};

use glam::DVec3;
use tetralux::error::Error;
use tetralux::mesh::{ArrayChoice, ArrayInfo, Association, CellKind, DataArray, Mesh, ReadOptions, Topology, read};

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/xml").join(name)
}

fn load(name: &str) -> Mesh {
    read(&fixture(name), &ReadOptions::default()).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn one(name: &str) -> ReadOptions {
    ReadOptions { arrays: ArrayChoice::One(Some(name.to_owned())), ..ReadOptions::default() }
}

fn array<'m>(mesh: &'m Mesh, name: &str) -> &'m DataArray {
    mesh.arrays.iter().find(|a| a.name == name).unwrap_or_else(|| panic!("no array {name}"))
}

fn noted(mesh: &Mesh, words: &str) -> u64 {
    mesh.notes.iter().filter(|n| n.text.contains(words)).map(|n| n.count).sum()
}

/// Nodes of every cell, blanked ones of structured grids left out.
fn cells(mesh: &Mesh) -> Vec<Vec<usize>> {
    match &mesh.topology {
        Topology::Cells { kinds, nodes } => {
            let mut rest = nodes.as_slice();
            let take = |kind: &CellKind| {
                let (cell, after) = rest.split_at(kind.node_count());
                rest = after;
                cell.iter().map(|&n| n as usize).collect()
            };
            kinds.iter().map(take).collect()
        }
        Topology::Structured { points: [nx, ny, nz], .. } => {
            let mut all = Vec::new();
            for (k, j, i) in
                (0..nz - 1).flat_map(|k| (0..ny - 1).flat_map(move |j| (0..nx - 1).map(move |i| (k, j, i))))
            {
                let at = (k * ny + j) * nx + i;
                all.push([0, 1, *nx, nx + 1].into_iter().flat_map(|d| [at + d, at + d + nx * ny]).collect());
            }
            all
        }
    }
}

/// What is wrong with the fields of scripts/fixtures.py: `linear`, `U` at points, `center_x` at cells.
fn field_errors(mesh: &Mesh) -> Vec<String> {
    let mut errors = Vec::new();
    let (linear, u, center) = (array(mesh, "linear"), array(mesh, "U"), array(mesh, "center_x"));
    let cells = cells(mesh);
    if (linear.values.len(), u.values.len(), center.values.len())
        != (mesh.points.len(), 3 * mesh.points.len(), cells.len())
    {
        errors.push("lengths".to_owned());
        return errors;
    }
    let close = |a: f64, b: f64| (a - b).abs() <= 1e-6 * (1.0 + b.abs());
    for (i, p) in mesh.points.iter().enumerate() {
        if !close(linear.values[i], p.x + 2.0 * p.y + 4.0 * p.z) {
            errors.push(format!("linear at point {i}"));
        }
        if ![p.x, 2.0 * p.y, 3.0 * p.z].iter().zip(&u.values[3 * i..]).all(|(a, b)| close(*b, *a)) {
            errors.push(format!("U at point {i}"));
        }
    }
    for (i, cell) in cells.iter().enumerate() {
        let mean = cell.iter().map(|&n| mesh.points[n].x).sum::<f64>() / cell.len() as f64;
        if !close(center.values[i], mean) {
            errors.push(format!("center_x of cell {i}: {} instead of {mean}", center.values[i]));
        }
    }
    errors
}

/// Volume of boxes with edges along the axes, by their diagonals.
fn boxes_volume(mesh: &Mesh) -> f64 {
    let volume = |cell: &Vec<usize>| {
        let corners = cell.iter().map(|&n| mesh.points[n]);
        let low = corners.clone().fold(DVec3::INFINITY, DVec3::min);
        (corners.fold(DVec3::NEG_INFINITY, DVec3::max) - low).element_product()
    };
    cells(mesh).iter().map(volume).sum()
}

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
fn the_field_check_sees_planted_errors() {
    let good = load("encoding_ascii.vtu");
    let mut bad = good.clone();
    bad.arrays[0].values[3] += 1e-4;
    assert_eq!(field_errors(&bad), ["linear at point 3"]);
    let mut bad = good.clone();
    bad.arrays[1].values[3 * 5 + 2] = f64::NAN;
    assert_eq!(field_errors(&bad), ["U at point 5"]);
    let mut bad = good.clone();
    let Topology::Cells { nodes, .. } = &mut bad.topology else { panic!("not a list of cells") };
    nodes[8] = 31;
    assert_eq!(field_errors(&bad).len(), 1);
    let mut bad = good;
    bad.arrays[2].values.pop();
    assert_eq!(field_errors(&bad), ["lengths"]);
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
        assert!(mesh.arrays.iter().any(|a| a.values == [7.0; 32]), "{name}: the unnamed array");
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

/// Reads a copy of a fixture after `damage`.
fn read_damaged(folder: &Path, name: &str, damage: impl FnOnce(&mut Vec<u8>)) -> Result<Mesh, Error> {
    let mut bytes = std::fs::read(fixture(name)).unwrap();
    damage(&mut bytes);
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    read(&path, &ReadOptions::default())
}

fn replace(bytes: &mut Vec<u8>, from: &str, to: &str) {
    let at = bytes.windows(from.len()).position(|w| w == from.as_bytes()).unwrap_or_else(|| panic!("no {from}"));
    bytes.splice(at..at + from.len(), to.bytes());
}

#[test]
fn damage_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let raw = "encoding_appended_none_u64_le.vtu";
    let ascii = "encoding_ascii.vtu";
    let zlib = "encoding_appended_zlib_u64_le.vtu";
    let cases: [(&str, &str, &str, &str); 17] = [
        (raw, "LittleEndian", "BigEndian", "byte_order"),
        (raw, "UInt64", "UInt32", "values"),
        (raw, "NumberOfPoints=\"32\"", "NumberOfPoints=\"4000000000000\"", "4000000000000"),
        (raw, "NumberOfPoints=\"32\"", "NumberOfPoints=\"-3\"", "not a count"),
        (raw, "NumberOfCells=\"9\"", "NumberOfCells=\"18446744073709551615\"", "expected"),
        (raw, "offset=\"0\"", "offset=\"99999999\"", "beyond the end"),
        (raw, "Name=\"connectivity\"", "Name=\"sonnectivity\"", "connectivity"),
        (raw, "encoding=\"raw\"", "encoding=\"cooked\"", "cooked"),
        (raw, "NumberOfComponents=\"3\" format", "format", "expected"),
        (ascii, "type=\"Float64\"", "type=\"Float128\"", "Float128"),
        (ascii, "format=\"ascii\"", "format=\"braille\"", "braille"),
        (ascii, "<Points>", "<Paints>", "XML"),
        (ascii, "type=\"UnstructuredGrid\"", "type=\"HyperTreeGrid\"", "HyperTreeGrid"),
        (ascii, "VTKFile", "VTRFile", "VT"),
        (zlib, "vtkZLibDataCompressor", "vtkMagicDataCompressor", "vtkMagicDataCompressor"),
        (zlib, "LittleEndian", "BigEndian", "byte_order"),
        (zlib, "vtkZLibDataCompressor", "vtkLZ4DataCompressor", "block 0"),
    ];
    for (name, from, to, word) in cases {
        let error = read_damaged(folder.path(), name, |bytes| replace(bytes, from, to)).unwrap_err();
        let text = error.to_string();
        assert!(text.contains(word), "{from} -> {to}: {text}");
        assert!(text.contains(name), "the path comes last: {text}");
    }
}

#[test]
fn impossible_cells_and_points_are_named() {
    let text = |connectivity: &str, offsets: &str, points: &str| {
        format!(
            "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"5\" NumberOfCells=\"1\">\
             <Points><DataArray type=\"Float32\" NumberOfComponents=\"3\">{points}</DataArray></Points><Cells>\
             <DataArray type=\"Int32\" Name=\"connectivity\">{connectivity}</DataArray>\
             <DataArray type=\"Int32\" Name=\"offsets\">{offsets}</DataArray>\
             <DataArray type=\"UInt8\" Name=\"types\">10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>"
        )
    };
    let good = "0 0 0 1 0 0 0 1 0 0 0 1 9 9 9";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tet.vtu");
    let attempt = |text: String| {
        std::fs::write(&path, text).unwrap();
        read(&path, &ReadOptions::default())
    };
    assert_eq!(attempt(text("0 1 2 3", "4", good)).unwrap().points.len(), 5);
    let unused = attempt(text("0 1 2 3", "4", "0 0 0 1 0 0 0 1 0 0 0 1 9 nan 9")).unwrap();
    assert_eq!(noted(&unused, "no cell uses"), 1);
    for (connectivity, offsets, points, word) in [
        ("0 1 2 5", "4", good, "point 5, of 5 points"),
        ("0 1 2 -1", "4", good, "no index"),
        ("0 1 2 1.5", "4", good, "no index"),
        ("0 1 2 3", "5", good, "ends at entry 5|end at entry 5"),
        ("0 1 2 3", "-4", good, "no index"),
        ("0 1 2 3", "3", good, "3 nodes instead of 4"),
        ("0 1 2 3", "4 4", good, "2 values"),
        ("0 1 2 x3", "4", good, "`x3`"),
        ("0 1 2 3", "4", "0 0 0 1 0 0 0 1 0 0 inf 1 9 9 9", "point 3"),
        ("0 1 2 3", "4", "0 0 0 1 0 0 0 1 0 0 0 -nan(ind) 9 9 9", "point 3"),
        ("0 1 2 3", "4", "0 0 0 1 0 0", "6 values"),
    ] {
        let error = attempt(text(connectivity, offsets, points)).unwrap_err().to_string();
        assert!(word.split('|').any(|word| error.contains(word)), "{word}: {error}");
    }
}

#[test]
fn absurd_extents_and_sizes_cost_nothing() {
    let folder = tempfile::tempdir().unwrap();
    for (extent, word) in [
        ("0 2000000000 0 2000000000 0 2000000000", "numbered"),
        ("0 1500 0 1500 0 1500", "expected"),
        ("0 3 0 3 0 x", "6 numbers"),
        ("0 3 0 3", "6 numbers"),
    ] {
        let attempt = read_damaged(folder.path(), "image.vti", |bytes| {
            replace(bytes, "<Piece Extent=\"2 5 -1 2 0 2\"", &format!("<Piece Extent=\"{extent}\""));
        });
        let error = attempt.unwrap_err().to_string();
        assert!(error.contains(word), "{extent}: {error}");
    }
    // A compressed array of blocks that claim a gigabyte each.
    let name = "encoding_appended_zlib_u64_le.vtu";
    let attempt = read_damaged(folder.path(), name, |bytes| {
        let blob = bytes.windows(12).position(|w| w == b"AppendedData").unwrap();
        let start = blob + bytes[blob..].iter().position(|&b| b == b'_').unwrap() + 1;
        bytes[start + 8..start + 16].copy_from_slice(&(1_u64 << 30).to_le_bytes());
    });
    assert!(attempt.unwrap_err().to_string().contains("cannot yield"));
}

#[test]
fn what_is_no_mesh_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let attempt = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        read(&path, &ReadOptions::default()).unwrap_err().to_string()
    };
    assert!(attempt("a.vtu", b"").contains("empty"));
    assert!(attempt("b.vtu", b"solid cube").contains("XML"));
    assert!(attempt("c.vtu", b"<html></html>").contains("VTKFile"));
    assert!(attempt("d.vtu", b"<VTKFile type=\"Table\"></VTKFile>").contains("Table"));
    assert!(attempt("e.vtu", b"<VTKFile \xff>").contains("UTF-8"));
    assert!(attempt("f.txt", b"words").contains("vtu"));
    assert!(attempt("g.vtu", "<a>".repeat(300_000).as_bytes()).contains("XML"));
    let cycle = b"<VTKFile type=\"Collection\"><Collection><DataSet file=\"h.pvd\"/></Collection></VTKFile>";
    assert!(attempt("h.pvd", cycle).contains("within"));
    let missing = b"<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><Piece Source=\"none.vtu\"/></PUnstructuredGrid></VTKFile>";
    assert!(attempt("i.pvtu", missing).contains("none.vtu"));
    assert!(matches!(read(folder.path(), &ReadOptions::default()), Err(Error::Io { .. })));
    assert!(matches!(read(&folder.path().join("nowhere.vtu"), &ReadOptions::default()), Err(Error::Io { .. })));
}

/// What every mesh promises; a reader of damaged files may return a wrong mesh, but never an impossible one.
fn promises(mesh: &Mesh) -> Result<(), String> {
    let count = match &mesh.topology {
        Topology::Cells { kinds, nodes } => {
            if nodes.len() != kinds.iter().map(|k| k.node_count()).sum::<usize>() {
                return Err("number of nodes".to_owned());
            }
            if nodes.iter().any(|&n| n as usize >= mesh.points.len()) {
                return Err("a node is out of range".to_owned());
            }
            kinds.len()
        }
        Topology::Structured { points, blank } => {
            if points.iter().product::<usize>() != mesh.points.len()
                || !(blank.is_empty() || blank.len() == mesh.points.len())
            {
                return Err("number of grid points".to_owned());
            }
            mesh.topology.cell_count()
        }
    };
    if count == 0 || mesh.points.iter().any(|p| !p.is_finite()) {
        return Err("no cells, or a point that is not finite".to_owned());
    }
    for array in &mesh.arrays {
        let tuples = if array.association == Association::Point { mesh.points.len() } else { count };
        if array.components == 0 || array.values.len() != tuples * array.components {
            return Err(format!("length of {}", array.name));
        }
    }
    Ok(())
}

#[test]
fn promises_can_be_broken() {
    let good = load("mixed.vtu");
    promises(&good).unwrap();
    let mut bad = good.clone();
    bad.points.pop();
    promises(&bad).unwrap_err();
    let mut bad = good.clone();
    bad.arrays[0].values.pop();
    promises(&bad).unwrap_err();
    let mut bad = good;
    bad.points[0].x = f64::NAN;
    promises(&bad).unwrap_err();
}

#[test]
fn no_damage_makes_it_panic() {
    let folder = tempfile::tempdir().unwrap();
    let names = [
        "encoding_ascii.vtu",
        "encoding_appended_none_u32_le.vtu",
        "encoding_appended_zlib_u32_le.vtu",
        "encoding_appended_lz4_u64_be.vtu",
        "encoding_appended_lzma_u32_le.vtu",
        "encoding_base64_lz4_u32_le.vtu",
        "encoding_base64_none_u64_be.vtu",
        "encoding_binary_lzma_u64_le.vtu",
        "encoding_binary_none_u32_le.vtu",
        "mixed.vtu",
        "image.vti",
        "rectilinear.vtr",
        "curved.vts",
        "blanked_cell.vts",
        "pieces.vtu",
    ];
    // A small multiplicative generator: the same damage in every run.
    let mut state = 1_u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let (mut refused, mut accepted) = (0, 0);
    for name in names {
        let length = std::fs::metadata(fixture(name)).unwrap().len() as usize;
        let mut try_with = |damage: &dyn Fn(&mut Vec<u8>)| match read_damaged(folder.path(), name, damage) {
            Ok(mesh) => {
                promises(&mesh).unwrap_or_else(|what| panic!("{name}: {what}"));
                accepted += 1;
            }
            Err(_) => refused += 1,
        };
        for part in 0..60 {
            try_with(&|bytes| bytes.truncate(part * length / 60));
        }
        for _ in 0..250 {
            let (at, bit) = (random(length), random(8));
            try_with(&|bytes| bytes[at] ^= 1 << bit);
            let value = [0, 0xff, b'<', b'9', b'-', 0x7f][random(6)];
            try_with(&|bytes| bytes[at..(at + 4).min(length)].fill(value));
        }
    }
    assert!(refused > 1000 && accepted > 100, "{refused} refused, {accepted} accepted");
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
