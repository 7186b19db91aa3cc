//! What a view of a mesh implies: integers and geometry, no colour.

pub mod entries;
pub mod eye;
pub mod lens;
pub mod near;
pub mod order;
pub mod voxels;
