//! From a choice of device to a renderer: the only place here that makes one.

use std::sync::Arc;

use indicatif::ProgressBar;

use super::args::Device;
use super::output::note;
use crate::error::{Error, Result};
use crate::gpu::{DeviceChoice, Gpu, GpuRenderer};
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
    match device {
        Device::Oracle => Ok(reference(mesh, bar)),
        Device::Gpu => graphics(mesh, DeviceChoice::Any, settings),
        Device::Software => graphics(mesh, DeviceChoice::Software, settings),
        Device::Auto => match graphics(mesh, DeviceChoice::Any, settings) {
            Err(Error::Device(why)) => {
                note(&format!("note: {why}"));
                note("note: rendering on the CPU with the f64 reference instead, which is slow");
                Ok(reference(mesh, bar))
            }
            other => other,
        },
    }
}

fn graphics(mesh: &Arc<TetMesh>, choice: DeviceChoice, settings: Settings) -> Result<Box<dyn Renderer>> {
    Ok(Box::new(GpuRenderer::new(Gpu::new(choice)?, Arc::clone(mesh), settings)?))
}

fn reference(mesh: &Arc<TetMesh>, bar: &ProgressBar) -> Box<dyn Renderer> {
    let bar = bar.clone();
    let progress = move |share: f64| bar.set_position((1000.0 * share) as u64);
    Box::new(Oracle::new(Arc::clone(mesh)).with_progress(Box::new(progress)))
}
