//! Rendering on the GPU through wgpu: the only module that knows of it.

mod cells;
mod device;
pub mod layout;
mod mesh;
mod record;
mod renderer;
mod scene;
pub mod shader;
mod slabs;
mod sort;
mod store;
mod target;
mod transfer;

pub use device::{DeviceChoice, Gpu};
pub use renderer::GpuRenderer;
