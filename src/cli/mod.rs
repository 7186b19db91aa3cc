//! The command line: `args` (what was typed), `job` (what to do), then one file or folder a command.
//!
//! Results go to stdout or to the named file, everything else to stderr. Exit codes: 0 done, 1 failed, 2 asked wrongly.

pub(crate) mod args;
mod bench;
mod compare;
pub(crate) mod device;
mod histogram;
mod info;
mod job;
pub(crate) mod legend;
pub(crate) mod load;
pub(crate) mod output;
mod parse;
mod plot;
mod progress;
mod render;
mod sample;
mod stats;
mod tables;

use std::ffi::OsString;
use std::io::ErrorKind;

use clap::Parser as _;

use crate::error::Error;

/// Does what the arguments (the program's name first) ask, prints the error if there is one, and returns the exit code.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    main_with(arguments, |_| {
        let text = "this program was built without its window: cargo install --path . --features viewer";
        Err(Error::Asked(text.into()).into())
    })
}

/// The same, with what opens the window.
pub(crate) fn main_with(
    arguments: impl IntoIterator<Item = OsString>,
    view: impl FnOnce(&args::ViewArgs) -> anyhow::Result<()>,
) -> u8 {
    let arguments = match args::Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(usage) => {
            // Help goes to stdout, mistakes to stderr; if that is closed there is nobody to tell.
            let _ = usage.print();
            return u8::try_from(usage.exit_code()).unwrap_or(2);
        }
    };
    output::end_whole();
    let Err(error) = run(&arguments.command, view) else { return 0 };
    if error.downcast_ref::<std::io::Error>().is_some_and(|e| e.kind() == ErrorKind::BrokenPipe) {
        // The reader has seen enough, as `head` does.
        return 0;
    }
    output::note(&format!("error: {error}"));
    error.downcast_ref::<Error>().map_or(1, Error::exit_code)
}

fn run(command: &args::Command, view: impl FnOnce(&args::ViewArgs) -> anyhow::Result<()>) -> anyhow::Result<()> {
    match command {
        args::Command::Render(args) => render::run(args),
        args::Command::View(args) => view(args),
        args::Command::Info(args) => info::run(args),
        args::Command::Sample(args) => sample::run(args),
        args::Command::Compare(args) => compare::run(args),
        args::Command::Histogram(args) => histogram::run(args),
        args::Command::Tables(args) => tables::run(args),
        args::Command::Bench { what } => bench::run(what),
    }
}
