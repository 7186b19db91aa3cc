//! The `tetralux` command.

use std::process::ExitCode;

#[cfg(not(feature = "viewer"))]
use tetralux::cli::main as run;
#[cfg(feature = "viewer")]
use tetralux::viewer::main as run;

fn main() -> ExitCode {
    ExitCode::from(run(std::env::args_os()))
}
