//! What was typed after `bench`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

/// What to measure, or what to make of what was measured.
#[derive(Debug, Subcommand)]
pub(in crate::cli) enum BenchCommand {
    /// Small meshes, in under 3 minutes on 2 cores (bench/quick.toml)
    Quick(RunArgs),
    /// All methods, integrals and orders (bench/full.toml)
    Full(RunArgs),
    /// What a hardware adapter is for: large meshes and pictures (bench/gpu.toml)
    Gpu(RunArgs),
    /// A plan of one's own (docs/bench.md)
    Run {
        /// Plan file (TOML)
        plan: PathBuf,
        #[command(flatten)]
        args: RunArgs,
    },
}

#[derive(Debug, Args)]
pub(in crate::cli) struct RunArgs {
    /// Folder of records, pictures and report; a run that was cut off goes on there [default: out/bench/NAME]
    #[arg(short, long, value_name = "FOLDER")]
    pub output: Option<PathBuf>,
    /// Folder of meshes that the plan names by 'data'
    #[arg(long, value_name = "FOLDER")]
    pub data: Option<PathBuf>,
    /// Folder of other programs' records (.jsonl), for the report
    #[arg(long, value_name = "FOLDER")]
    pub peers: Option<PathBuf>,
    /// Write meshes, cameras, functions and reference pictures there, for other programs (scripts/peer_vtk.py)
    #[arg(long, value_name = "FOLDER")]
    pub for_peers: Option<PathBuf>,
}
