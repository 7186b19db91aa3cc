//! `tetralux bench`: what runs are worth, as charts and as a guard against what becomes worse.

mod args;
mod chart;
mod diff;
mod growth;
mod marks;
mod page;
mod passes;
mod points;
mod report;
mod scale;
mod speed;
mod strips;
mod table;
mod words;

pub(super) use args::BenchCommand;

pub(super) fn run(command: &BenchCommand) -> anyhow::Result<()> {
    match command {
        BenchCommand::Report(args) => report::run(args),
        BenchCommand::Diff(args) => diff::run(args),
    }
}
