//! Direct volume rendering of unstructured meshes with transfer functions of a scalar and its gradient magnitude.
//!
//! ```text
//! file --mesh::read--> Mesh --TetMesh::new--> TetMesh + Census
//! TetMesh + Scene --Renderer--> Image + Stats --Comparison--> numbers
//! ```
//!
//! Each module uses only those before it; `tests/architecture.rs` checks that.
//!
//! | module | what lives there |
//! | --- | --- |
//! | [`error`], [`space`] | one error type; boxes, rays, intervals |
//! | [`tables`] | functions of two arguments that shaders look up, their generator, and look-ups on the host |
//! | [`mesh`] | what a file said: one reader per format ([`mesh::read`]), no geometry; [`mesh::synth`] makes meshes |
//! | [`tet`] | what a renderer needs, whatever the view: [`tet::TetMesh`] or [`tet::Grid`], [`tet::Census`], histogram |
//! | [`scene`] | what the user chose: [`scene::Camera`], [`scene::TransferFunction`], [`scene::Optics`], the scene file |
//! | [`plan`] | what a view implies, without colour: where rays enter, the near plane's cuts, the order of cells |
//! | [`image`] | linear pictures, PNG and EXR, [`image::Comparison`] |
//! | [`renderer`] | [`renderer::Renderer`] and the closed sets of choices |
//! | [`oracle`] | the integral in f64 by quadrature: the truth |
//! | [`cpu`] | ray casting from cell to cell in f32 on all cores, for machines without a graphics processor |
//! | [`gpu`] | projection and ray casting on wgpu: the only module that knows of it; its passes are the files of `shaders/` |
//! | [`report`] | what runs are worth: [`report::record`], [`report::diff`]; [`report::segments`] holds an integral against the truth, [`report::stability`] every method in scenes where they go wrong |
//! | `cli` | the command line (feature `cli`): arguments, jobs, one file a command |
//! | `viewer` | the window (feature `viewer`): a picture, and its function drawn on the joint histogram |
//!
//! # From a file to a picture
//!
//! ```no_run
//! use std::{path::Path, sync::Arc};
//! use tetralux::gpu::{DeviceChoice, Gpu, GpuRenderer};
//! use tetralux::image::PngEncoding;
//! use tetralux::mesh::{self, ReadOptions};
//! use tetralux::renderer::{Frame, Renderer, Settings};
//! use tetralux::scene::Scene;
//! use tetralux::tet::{FieldChoice, HexSplit, TetMesh};
//!
//! # fn main() -> tetralux::Result<()> {
//! let mesh = mesh::read(Path::new("examples/data/fire_ug.vtu"), &ReadOptions::default())?;
//! let (mesh, census) = TetMesh::new(mesh, &FieldChoice::parse("t"), HexSplit::default())?;
//! let scene = Scene::read(Some(Path::new("examples/fire.toml")), &[])?;
//! let (camera, transfer) = scene.resolve(&mesh)?;
//! let mut renderer = GpuRenderer::new(Gpu::new(DeviceChoice::Any)?, Arc::new(mesh), Settings::default())?;
//! let background = scene.premultiplied_background();
//! let frame = Frame { camera: &camera, transfer: &transfer, optics: &scene.optics, size: scene.size, background };
//! let rendered = renderer.render(&frame, false)?;
//! rendered.image.write(Path::new("fire.png"), PngEncoding::Srgb)?;
//! # Ok(())
//! # }
//! ```

#[cfg(feature = "cli")]
pub mod cli;
pub mod cpu;
pub mod error;
pub mod gpu;
pub mod image;
pub mod mesh;
pub mod oracle;
pub mod plan;
pub mod renderer;
pub mod report;
pub mod scene;
pub mod space;
pub mod tables;
pub mod tet;

pub use error::{Error, Result};
#[cfg(feature = "viewer")]
pub mod viewer;
