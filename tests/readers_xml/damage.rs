//! Bad files give an error that names the place, never a panic or an impossible mesh.

use std::path::Path;

use tetralux::error::Error;
use tetralux::mesh::{Mesh, ReadOptions, read};

use crate::checks::*;

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
fn an_array_without_a_name_gets_one() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = read_damaged(folder.path(), "encoding_ascii.vtu", |bytes| replace(bytes, " Name=\"linear\"", ""));
    let mesh = mesh.unwrap();
    assert_eq!(mesh.arrays[0].name, "PointData 0");
    assert_eq!(mesh.arrays[0].values, load("encoding_ascii.vtu").arrays[0].values);
}

#[test]
fn damage_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let raw = "encoding_appended_none_u64_le.vtu";
    let ascii = "encoding_ascii.vtu";
    let zlib = "encoding_appended_zlib_u64_le.vtu";
    let cases: [(&str, &str, &str, &str); 17] = [
        (raw, "LittleEndian", "BigEndian", "byte_order"),
        (raw, "UInt64", "UInt32", "cell 0 is said to end at entry 34359738368"),
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
