//! Orders of cells: which are right, where, and what tells that they are not.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

#[path = "../common/mod.rs"]
mod common;

mod census;
mod gaps;
mod permutation;
mod power;
mod real;
mod support;
mod walks;
