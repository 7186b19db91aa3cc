//! Direct volume rendering of unstructured meshes with bivariate transfer functions.

#[cfg(feature = "cli")]
pub mod cli;
pub mod error;
pub mod gpu;
pub mod image;
pub mod mesh;
pub mod oracle;
pub mod plan;
pub mod renderer;
pub mod scene;
pub mod space;
pub mod tet;

pub use error::{Error, Result};
