//! `tetralux bench`: time and error, measured and charted, and a guard against what becomes worse (docs/bench.md).

mod args;
mod chart;
mod diff;
mod growth;
mod machine;
mod marks;
mod page;
mod passes;
mod peers;
mod plan;
mod points;
mod report;
mod run;
mod scale;
mod speed;
mod stability;
mod strips;
mod subject;
mod table;
mod words;

use std::path::Path;

pub(super) use args::BenchCommand;

/// Plans that come with the source.
const PLANS: &str = "bench";

pub(super) fn run(command: &BenchCommand) -> anyhow::Result<()> {
    let shipped = |name: &str| Path::new(PLANS).join(name);
    match command {
        BenchCommand::Quick(args) => run::run(&shipped("quick.toml"), args),
        BenchCommand::Full(args) => run::run(&shipped("full.toml"), args),
        BenchCommand::Gpu(args) => run::run(&shipped("gpu.toml"), args),
        BenchCommand::Run { plan, args } => run::run(plan, args),
        BenchCommand::Report(args) => report::run(args),
        BenchCommand::Diff(args) => diff::run(args),
        BenchCommand::Stability(args) => stability::run(args),
    }
}
