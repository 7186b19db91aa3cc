//! Rendering on the GPU through wgpu: the only module that knows of it.

mod cells;
mod choice;
mod cover;
mod device;
mod frame;
mod grid;
mod integral;
mod kernel;
pub mod layout;
mod light;
mod linked;
mod lists;
mod mesh;
mod ordering;
mod raycast;
mod rays;
mod record;
mod renderer;
mod runner;
mod scene;
pub mod segments;
pub mod shader;
mod slabs;
mod sort;
mod specialise;
mod store;
mod target;
mod transfer;
mod widgets;

pub use choice::{ChosenMethod, choose_method};
pub use device::{DeviceChoice, Gpu};
pub use grid::{GridCaster, GridRenderer};
pub use raycast::RayCaster;
pub use renderer::GpuRenderer;
