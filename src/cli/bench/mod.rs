//! `tetralux bench`: measurements of the program itself.

mod stability;

use clap::Subcommand;

/// What to measure.
#[derive(Debug, Subcommand)]
pub(super) enum BenchCommand {
    /// Draw scenes in which renderers go wrong, and hold every method to the truth
    Stability(stability::StabilityArgs),
}

pub(super) fn run(command: &BenchCommand) -> anyhow::Result<()> {
    match command {
        BenchCommand::Stability(args) => stability::run(args),
    }
}
