//! Pictures of strongly varying colour: the orders of cells against the oracle, which knows none.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod cells;
#[path = "../common/mod.rs"]
mod common;
mod compose;
mod per_pixel;
mod real;
mod room;
mod scenes;
