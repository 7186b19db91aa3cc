//! Rendering on the GPU through wgpu: the only module that knows of it.

mod device;
pub mod layout;
mod mesh;
mod record;
mod renderer;
pub mod shader;
mod sort;
mod transfer;

pub use device::{DeviceChoice, Gpu};
pub use renderer::GpuRenderer;
