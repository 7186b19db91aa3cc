//! From a choice of device to a renderer: the only place here that makes one.

use std::sync::Arc;

use indicatif::ProgressBar;

use super::args::Device;
use super::output::note;
use crate::error::Result;
use crate::oracle::Oracle;
use crate::renderer::{Renderer, Settings};
use crate::tet::TetMesh;

/// The renderer for `device`. `bar` follows pictures of renderers that know how far they are.
pub(super) fn renderer(
    mesh: &Arc<TetMesh>,
    device: Device,
    settings: Settings,
    bar: &ProgressBar,
) -> Result<Box<dyn Renderer>> {
    let _ = settings;
    match device {
        Device::Oracle => Ok(reference(mesh, bar)),
        Device::Auto | Device::Gpu | Device::Software => {
            note("rendering on the CPU with the f64 reference, which is slow");
            Ok(reference(mesh, bar))
        }
    }
}

fn reference(mesh: &Arc<TetMesh>, bar: &ProgressBar) -> Box<dyn Renderer> {
    let bar = bar.clone();
    let progress = move |share: f64| bar.set_position((1000.0 * share) as u64);
    Box::new(Oracle::new(Arc::clone(mesh)).with_progress(Box::new(progress)))
}
