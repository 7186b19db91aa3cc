//! The VTU writer.

use tetralux::mesh::synth::Sample;
use tetralux::mesh::{Association, DataArray, Topology, synth, write};

#[test]
fn vtu_is_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtu");
    let mesh = Sample::SphereFlow.mesh(1000);
    write::write_vtu(&mesh, &path).unwrap();
    let bytes = std::fs::read(&path).unwrap();
    let start = bytes.windows(7).position(|w| w == b"raw\">\n_").unwrap() + 7;
    let xml = String::from_utf8(bytes[..start].to_vec()).unwrap() + "</AppendedData></VTKFile>";
    let document = roxmltree::Document::parse(&xml).unwrap();
    let block = |name: &str| {
        let array = document.descendants().find(|n| n.attribute("Name") == Some(name)).unwrap();
        let at = start + array.attribute("offset").unwrap().parse::<usize>().unwrap();
        let size = u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
        &bytes[at + 8..at + 8 + size]
    };
    let reals = |name: &str| block(name).as_chunks::<8>().0.iter().map(|b| f64::from_le_bytes(*b)).collect::<Vec<_>>();
    assert_eq!(reals("cp"), mesh.arrays[0].values);
    assert_eq!(reals("U"), mesh.arrays[1].values);
    assert_eq!(reals("Points"), mesh.points.iter().flat_map(|p| p.to_array()).collect::<Vec<_>>());
    let Topology::Cells { kinds, nodes } = &mesh.topology else { panic!("not explicit") };
    let integers =
        |name: &str| block(name).as_chunks::<8>().0.iter().map(|b| i64::from_le_bytes(*b)).collect::<Vec<_>>();
    assert_eq!(integers("connectivity"), nodes.iter().map(|n| i64::from(*n)).collect::<Vec<_>>());
    assert_eq!(integers("offsets").last(), Some(&(nodes.len() as i64)));
    assert_eq!(block("types"), vec![12; kinds.len()]);

    // Nothing but the file is left in the folder, and a failure leaves what was there.
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let missing = folder.path().join("none/a.vtu");
    let error = write::write_vtu(&mesh, &missing).unwrap_err().to_string();
    assert!(error.starts_with("cannot write: ") && error.ends_with("a.vtu"), "{error}");
    std::fs::create_dir(folder.path().join("taken.vtu")).unwrap();
    assert!(write::write_vtu(&mesh, &folder.path().join("taken.vtu")).is_err());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn vtu_of_a_grid_leaves_out_blanked_cells() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.vtu");
    let mut mesh = synth::box_grid([2, 3, 4]);
    let mut blank = vec![false; 60];
    blank[0] = true;
    mesh.topology = Topology::Structured { points: [3, 4, 5], blank };
    let values = (0..24).map(f64::from).collect();
    mesh.arrays = vec![DataArray { name: "a<\"&".into(), association: Association::Cell, components: 1, values }];
    write::write_vtu(&mesh, &path).unwrap();
    let text = String::from_utf8_lossy(&std::fs::read(&path).unwrap()).into_owned();
    assert!(text.contains("NumberOfCells=\"23\"") && text.contains("Name=\"a&lt;&quot;&amp;\""));
    let first = text.as_bytes().windows(3).position(|w| w == b">\n_").unwrap();
    let bytes = std::fs::read(&path).unwrap();
    assert_eq!(bytes[first + 3..first + 11], (23_u64 * 8).to_le_bytes());
    assert_eq!(bytes[first + 11..first + 19], 1_f64.to_le_bytes(), "cell 0 is the blanked one");
}
