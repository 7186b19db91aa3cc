//! What a view of a mesh implies: integers and geometry, no colour.

pub mod near;
pub mod order;
