//! Subjects as other programs read them: mesh, camera, function and reference picture (scripts/peer_vtk.py).

use std::path::Path;

use serde::Serialize;

use super::plan::Shot;
use super::subject::make_folder_of;
use crate::cli::output;
use crate::error::{Error, Result};
use crate::image::Image;
use crate::mesh::write::write_vtu;
use crate::mesh::{Association, DataArray, Mesh, Topology};
use crate::report::record::Subject;
use crate::scene::{Optics, Projection, TransferFunction};
use crate::tet::{Domain as _, TetMesh};

#[derive(Serialize)]
struct Exported<'a> {
    subject: &'a Subject,
    /// Relative to this file's folder.
    mesh: String,
    array: &'a str,
    camera: ExportedCamera,
    /// Scalar, linear RGB, extinction per data length; linear between rows, constant beyond. `None`: of two variables, lit,
    /// or with silhouettes.
    points: Option<Vec<[f64; 5]>>,
    background: [f64; 4],
    truth: &'a str,
}

#[derive(Serialize)]
struct ExportedCamera {
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    /// Full vertical angle, degrees; `None` of an orthographic camera.
    fov_y: Option<f64>,
    /// Of an orthographic picture, data units.
    height: Option<f64>,
    near: f64,
}

/// Writes a subject's folder, and its mesh if it is not there.
///
/// # Errors
/// [`Error::Write`].
pub(super) fn write(folder: &Path, subject: &Subject, mesh: &TetMesh, shot: &Shot, truth: &Image) -> Result<()> {
    let mesh_name = format!("{}.vtu", subject.mesh);
    let mesh_path = folder.join("meshes").join(&mesh_name);
    if !mesh_path.exists() {
        make_folder_of(&mesh_path)?;
        output::whole(|| write_vtu(&plain(mesh), &mesh_path))?;
    }
    let (fov_y, height) = match shot.camera.projection {
        Projection::Perspective { fov_y } => (Some(fov_y.to_degrees()), None),
        Projection::Orthographic { height } => (None, Some(height)),
    };
    let camera = ExportedCamera {
        eye: shot.camera.eye.to_array(),
        target: shot.camera.target.to_array(),
        up: shot.camera.up.to_array(),
        fov_y,
        height,
        near: shot.camera.near_depth(mesh.bounds_in_data().diagonal()),
    };
    let points = match &shot.transfer {
        TransferFunction::Curve(curve) if shot.optics == Optics::PLAIN => {
            let row = |n: &crate::scene::CurveNode| [n.scalar, n.color[0], n.color[1], n.color[2], n.extinction];
            Some(curve.nodes.iter().map(row).collect())
        }
        _ => None,
    };
    let exported = Exported {
        subject,
        mesh: format!("../meshes/{mesh_name}"),
        array: mesh.field(),
        camera,
        points,
        background: [0.0; 4],
        truth: "truth.f32",
    };
    let own = folder.join(&subject.hash);
    let json = serde_json::to_string_pretty(&exported).map_err(|e| Error::write(&own, e))?;
    make_folder_of(&own.join("subject.json"))?;
    let pixels = truth.pixels.iter().flatten().flat_map(|v| v.to_le_bytes()).collect();
    output::write_together(&[(own.join("subject.json"), json.into_bytes()), (own.join("truth.f32"), pixels)])
}

/// Tetrahedra and their scalar, data units.
fn plain(mesh: &TetMesh) -> Mesh {
    let values = mesh.scalar.clone();
    let array = DataArray { name: mesh.field().to_owned(), association: Association::Point, components: 1, values };
    Mesh {
        points: mesh.vertices.iter().map(|&v| mesh.data_from_mesh(v)).collect(),
        topology: Topology::tetrahedra(&mesh.tets),
        arrays: vec![array],
        available: Vec::new(),
        notes: Vec::new(),
    }
}
