//! The `tetralux` command.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(tetralux::cli::main(std::env::args_os()))
}
