//! `tetralux bench`: time and error, measured and charted (docs/bench.md).

pub(super) mod args;
mod machine;
mod peers;
mod plan;
mod report;
mod run;
mod subject;

use std::path::Path;

use args::BenchCommand;

/// Plans that come with the source, by name.
const PLANS: &str = "bench";

pub(super) fn run(command: &BenchCommand) -> anyhow::Result<()> {
    let shipped = |name: &str| Path::new(PLANS).join(name);
    match command {
        BenchCommand::Quick(args) => run::run(&shipped("quick.toml"), args),
        BenchCommand::Full(args) => run::run(&shipped("full.toml"), args),
        BenchCommand::Gpu(args) => run::run(&shipped("gpu.toml"), args),
        BenchCommand::Run { plan, args } => run::run(plan, args),
    }
}
