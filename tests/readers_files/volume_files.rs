//! Raw and NRRD volumes.

use glam::DVec3;
use tetralux::mesh::{ReadOptions, Topology, nrrd, raw};

use super::{data, difference, expected, fixtures, reals};

#[test]
fn nrrd_files_of_every_encoding() {
    let expected = expected();
    for file in
        ["short_big.nrrd", "double_little.nrrd", "float_text.nrrd", "int_gzip.nrrd", "vector.nrrd", "detached.nhdr"]
    {
        let (name, _) = file.split_once('.').unwrap();
        let mesh = nrrd::read(&fixtures().join(file), &ReadOptions::default()).unwrap();
        let array = &mesh.arrays[0];
        assert_eq!(
            (array.name.as_str(), array.components as u64),
            (name, expected[name]["components"].as_u64().unwrap())
        );
        assert_eq!(difference(&array.values, &reals(&expected[name]["values"])), 0.0, "{file}");
        assert_eq!(mesh.topology, Topology::Structured { points: [3, 4, 2], blank: vec![] });
        let spaced = matches!(name, "float_text" | "int_gzip" | "detached");
        let origin = if spaced { DVec3::ZERO } else { DVec3::new(1.0, 2.0, 3.0) };
        assert_eq!(mesh.points[0], origin, "{file}");
        assert_eq!(mesh.points[23], origin + DVec3::new(1.0, 0.75, 2.0), "{file}");
    }
}

#[test]
fn nrrd_refusals_are_clear() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.nrrd");
    let good = "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n12345678";
    let read = |text: &str| {
        std::fs::write(&path, text).unwrap();
        nrrd::read(&path, &ReadOptions::default())
    };
    assert_eq!(read(good).unwrap().arrays[0].values[7], 56.0);
    let fails = |from: &str, to: &str, part: &str| {
        let error = read(&good.replace(from, to)).map(|_| "no error").unwrap_err().to_string();
        assert!(error.contains(part), "{error:?} lacks {part:?}");
    };
    fails("raw", "bzip2", "\"bzip2\" is not read");
    fails("uchar", "block", "\"block\" is not read");
    fails("uchar", "short", "no field \"endian\"");
    fails("2 2 2", "2 2 3", "promises 12 bytes of samples, and there are 8");
    fails("2 2 2", "2 2 1", "no volume");
    fails("2 2 2", "99999999999 99999999999 99999999999", "beyond 2^32");
    fails("2 2 2", "2 2 2 2", "dimension is \"3\" and there are 4 sizes");
    fails("sizes", "size", "no field \"sizes\"");
    fails("encoding", "spacings: 1 0 1\nencoding", "spacing is zero");
    fails("encoding", "space directions: (1,0,0) (2,0,0) (0,0,1)\nencoding", "span no volume");
    fails("encoding", "data file: LIST\nencoding", "several files");
    fails("encoding", "data file: missing.raw\nencoding", "cannot read");
    fails("encoding", "byte skip: 9\nencoding", "beyond the 8 bytes");
}

#[test]
fn raw_volumes_need_the_exact_size() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("box.raw");
    let samples: Vec<u8> = (0..24_i16).flat_map(|i| (i * 300 - 1000).to_be_bytes()).collect();
    std::fs::write(&path, &samples).unwrap();
    let options = ReadOptions {
        dims: Some([2, 3, 4]),
        spacing: Some([1.0, 0.5, 2.0]),
        sample_type: Some("i16be".into()),
        ..Default::default()
    };
    let mesh = raw::read(&path, &options).unwrap();
    assert_eq!(mesh.arrays[0].values[23], 5900.0);
    assert_eq!(mesh.arrays[0].name, "box");
    assert_eq!(mesh.points[23], DVec3::new(1.0, 1.0, 6.0));
    let error = |o: ReadOptions| raw::read(&path, &o).map(|_| "no error").unwrap_err();
    let message = error(ReadOptions { sample_type: None, ..options.clone() }).to_string();
    assert!(message.starts_with("2x3x4 samples of 1 bytes each are 24 bytes, and the file holds 48"), "{message}");
    let big = error(ReadOptions { dims: Some([usize::MAX; 3]), ..options.clone() });
    assert!(big.to_string().contains("beyond 2^32"), "{big}");
    for asked in
        [ReadOptions { dims: None, ..options.clone() }, ReadOptions { sample_type: Some("i12".into()), ..options }]
    {
        let error = error(asked);
        assert_eq!(error.exit_code(), 2, "{error}");
    }
    let named = folder.path().join("a_b_2x3x4_int16.raw");
    std::fs::write(&named, samples).unwrap();
    let mesh = raw::read(&named, &ReadOptions::default()).unwrap();
    assert_eq!((mesh.arrays[0].name.as_str(), mesh.points.len(), mesh.notes.len()), ("a_b", 24, 1));
}

#[test]
#[ignore = "needs TETRALUX_DATA"]
fn real_raw_data_have_the_published_means() {
    for (name, mean) in [("fuel", 1.9447898864746094), ("neghip", 18.402774810791016)] {
        let path = data().join(format!("structured/{name}_64x64x64_uint8.raw"));
        let mesh = raw::read(&path, &ReadOptions::default()).unwrap();
        let array = &mesh.arrays[0];
        assert_eq!((array.name.as_str(), array.values.len()), (name, 262_144));
        assert_eq!(array.values.iter().sum::<f64>() / 262_144.0, mean);
    }
}
