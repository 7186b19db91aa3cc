//! Grids whose tetrahedra are implied, against the mesh that holds them: pictures, orders, and what is dropped.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod agreement;
#[path = "../common/mod.rs"]
mod common;
mod culling;
mod grids;
mod order;
mod real;
mod refused;
