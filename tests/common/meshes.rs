//! Meshes that the tests draw.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use tetralux::mesh::synth::Sample;
use tetralux::mesh::{ArrayChoice, Mesh, ReadOptions};
use tetralux::tet::{FieldChoice, HexSplit, TetMesh};

/// Reads `array` of a file.
pub fn read(path: &Path, array: &str) -> Arc<TetMesh> {
    let arrays = ArrayChoice::One(Some(array.into()));
    let mesh = tetralux::mesh::read(path, &ReadOptions { arrays, ..Default::default() });
    split(mesh.unwrap_or_else(|e| panic!("{e}")), array)
}

/// The tetrahedra of a mesh.
pub fn split(mesh: Mesh, array: &str) -> Arc<TetMesh> {
    let (mesh, _) = TetMesh::new(mesh, &FieldChoice::parse(array), HexSplit::default()).expect("tetrahedra");
    Arc::new(mesh)
}

/// The bundled mesh, temperature: 10,462 hexahedra, 62,772 tetrahedra.
pub fn fire() -> Arc<TetMesh> {
    read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/data/fire_ug.vtu"), "t")
}

/// A procedural mesh of about so many tetrahedra.
pub fn sample(sample: Sample, tets: usize) -> Arc<TetMesh> {
    split(sample.mesh(tets), sample.array())
}

/// The mesh's bounding box: centre and diagonal (data units).
pub fn center_and_diagonal(mesh: &TetMesh) -> (DVec3, f64) {
    let bounds = mesh.bounds_in_data();
    (bounds.center(), bounds.diagonal())
}
