//! Ray casting on a graphics device.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod casting;
mod common;

use std::sync::Arc;

use common::gpu;
use tetralux::gpu::RayCaster;
use tetralux::renderer::{Renderer, Settings};
use tetralux::tet::TetMesh;

const COMPILES: bool = true;

fn engine(mesh: &Arc<TetMesh>, settings: Settings) -> Box<dyn Renderer> {
    Box::new(RayCaster::new(gpu::device(), mesh.clone(), settings).unwrap_or_else(|e| panic!("{e}")))
}
