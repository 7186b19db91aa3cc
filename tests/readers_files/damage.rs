//! Truncated and garbled files of every format.

use std::path::Path;

use tetralux::error::{Error, Result};
use tetralux::mesh::{Association, Mesh, ReadOptions, Topology, legacy, nrrd, plot3d, raw};

use super::fixtures;
use super::plot3d_files::Plot3d;

type Reader = fn(&Path, &ReadOptions) -> Result<Mesh>;

/// Reads `bytes` as a file of `name`; panics are the test's failure.
fn try_read(read: Reader, folder: &Path, name: &str, bytes: &[u8]) -> bool {
    let path = folder.join(name);
    // Some file systems write a truncated file to the disk at once, which takes 50 times as long as all the rest.
    if path.exists() {
        std::fs::remove_file(&path).unwrap();
    }
    std::fs::write(&path, bytes).unwrap();
    let options = ReadOptions { dims: Some([3, 4, 2]), solution: Some(path.clone()), ..Default::default() };
    match read(&path, &options) {
        Ok(mesh) => {
            // What is read in spite of the damage must keep the mesh's promises.
            let count = mesh.points.len();
            if let Topology::Cells { kinds, nodes } = &mesh.topology {
                assert!(nodes.iter().all(|n| (*n as usize) < count));
                assert_eq!(nodes.len(), kinds.iter().map(|k| k.node_count()).sum::<usize>());
            }
            for a in &mesh.arrays {
                let tuples = if a.association == Association::Point { count } else { mesh.topology.cell_count() };
                assert_eq!(a.values.len(), a.components * tuples, "{name}: {}", a.name);
            }
            assert!(mesh.points.iter().all(|p| p.is_finite()));
            true
        }
        Err(Error::Malformed { .. } | Error::Io { .. } | Error::Asked(_)) => false,
        Err(other) => panic!("{name}: an unexpected kind of error: {other}"),
    }
}

#[test]
fn damaged_files_never_panic() {
    let folder = tempfile::tempdir().unwrap();
    let variant =
        |records| Plot3d { little: false, records, counted: true, double: false, iblank: true, dims: vec![[3; 3]; 2] };
    let mut files: Vec<(Reader, String, Vec<u8>)> = vec![
        (plot3d::read, "a.x".into(), variant(true).grid()),
        (plot3d::read, "b.x".into(), variant(false).grid()),
        (plot3d::read, "a.q".into(), variant(true).solution()),
        (raw::read, "a.raw".into(), vec![7; 24]),
    ];
    for entry in std::fs::read_dir(fixtures()).unwrap() {
        let path = entry.unwrap().path();
        let read: Reader = match path.extension().and_then(|e| e.to_str()) {
            Some("vtk") => legacy::read,
            Some("nrrd" | "nhdr") => nrrd::read,
            _ => continue,
        };
        files.push((read, path.file_name().unwrap().to_str().unwrap().into(), std::fs::read(&path).unwrap()));
    }
    assert!(files.len() > 30, "the fixtures are missing");
    std::fs::copy(fixtures().join("detached.raw"), folder.path().join("detached.raw")).unwrap();
    let (mut refused, mut read_anyway) = (0, 0);
    let mut count = |read_it: bool| if read_it { read_anyway += 1 } else { refused += 1 };
    for (read, name, bytes) in &files {
        for end in (0..bytes.len()).step_by(1 + bytes.len() / 150) {
            count(try_read(*read, folder.path(), name, &bytes[..end]));
        }
        // Headers are where damage matters: every byte of the first 400, then a sample.
        let places = (0..bytes.len().min(400)).chain((400..bytes.len()).step_by(37));
        for place in places {
            for flip in [0xff, 0x01, 0x10] {
                let mut bytes = bytes.clone();
                bytes[place] ^= flip;
                count(try_read(*read, folder.path(), name, &bytes));
            }
        }
    }
    assert!(refused > 1000 && read_anyway > 1000, "{refused} refused, {read_anyway} read");
}
