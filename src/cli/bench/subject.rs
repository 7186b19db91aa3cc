//! What is drawn, by its contents, and its true picture.

use std::path::{Path, PathBuf};

use indicatif::ProgressBar;

use super::plan::Shot;
use crate::cli::output;
use crate::error::{Error, Result};
use crate::image::{Image, PngEncoding};
use crate::oracle::Oracle;
use crate::renderer::{Frame, Renderer as _};
use crate::tet::TetMesh;

/// Of a mesh's contents.
pub(super) fn mesh_hash(mesh: &TetMesh) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    let mut floats = |values: &[f64]| {
        hasher.update(bytemuck::cast_slice(values));
    };
    floats(&mesh.center_in_data.to_array());
    floats(&[mesh.data_per_mesh]);
    for vertex in &mesh.vertices {
        floats(&vertex.to_array());
    }
    floats(&mesh.scalar);
    floats(&mesh.gradient_magnitude);
    hasher.update(bytemuck::cast_slice(mesh.tets.as_slice()));
    hasher.finalize()
}

/// Of all that makes a picture, hexadecimal.
pub(super) fn hash(mesh: blake3::Hash, shot: &Shot, size: [u32; 2]) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(mesh.as_bytes());
    // Rust writes floats such that they are read back to the bit.
    let Shot { camera, transfer, optics } = shot;
    hasher.update(format!("{camera:?} {transfer:?} {optics:?} {size:?}").as_bytes());
    hasher.finalize().to_hex()[..24].to_owned()
}

/// A frame without background.
pub(super) fn frame(shot: &Shot, size: [u32; 2]) -> Frame<'_> {
    Frame { camera: &shot.camera, transfer: &shot.transfer, optics: &shot.optics, size, background: [0.0; 4] }
}

/// Where a reference picture is kept.
pub(super) fn truth_path(folder: &Path, hash: &str) -> PathBuf {
    folder.join("truth").join(format!("{hash}.exr"))
}

/// The reference picture, made once for each hash. A file that cannot be read is made again.
///
/// # Errors
/// A folder that cannot be written.
pub(super) fn truth(folder: &Path, hash: &str, mesh: &std::sync::Arc<TetMesh>, frame: &Frame<'_>) -> Result<Image> {
    let path = truth_path(folder, hash);
    if let Ok(image) = Image::read(&path) {
        return Ok(image);
    }
    let image = Oracle::new(mesh.clone()).render(frame, false)?.image;
    make_folder_of(&path)?;
    output::whole(|| image.write(&path, PngEncoding::Linear))?;
    Ok(image)
}

/// Makes the folder that `path` lies in.
///
/// # Errors
/// [`Error::Write`].
pub(super) fn make_folder_of(path: &Path) -> Result<()> {
    let folder = path.parent().unwrap_or(Path::new(""));
    std::fs::create_dir_all(folder).map_err(|e| Error::write(folder, e))
}

/// A bar over so many steps, hidden where stderr is no terminal.
pub(super) fn bar(steps: u64) -> ProgressBar {
    let bar = ProgressBar::new(steps);
    match indicatif::ProgressStyle::with_template("{bar:30} {pos}/{len}, {eta} left  {wide_msg}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
