//! The GPU pipeline against the oracle: pictures of real and of small meshes.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

#[path = "../common/mod.rs"]
mod common;

mod real;
mod small;
