//! The `tetralux` command.
fn main() {}
