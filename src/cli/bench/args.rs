//! What was typed after `bench`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::stability::StabilityArgs;

/// What to do with runs and their records.
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
    /// Turn records into a page: error against time, growth with cells and pixels, passes, pictures, a table
    Report(ReportArgs),
    /// Tell what became worse from one list of records to another; fail (exit code 1) where something did
    Diff(DiffArgs),
    /// Draw scenes in which renderers go wrong, and hold every method to the truth (docs/stability.md)
    Stability(StabilityArgs),
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

#[derive(Debug, Args)]
pub(in crate::cli) struct ReportArgs {
    /// Records, .jsonl; pictures/HASH/NAME.exr and truth/HASH.exr beside them are shown where they are there
    #[arg(required_unless_present = "peers")]
    pub records: Vec<PathBuf>,
    /// Folder of other programs' records: every .jsonl in it
    #[arg(long, value_name = "DIR")]
    pub peers: Option<PathBuf>,
    /// Folder to write report.html and the charts to, each as NAME-light.svg and NAME-dark.svg; made if it is not there
    #[arg(short, long, value_name = "FOLDER", default_value = ".")]
    pub output: PathBuf,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct DiffArgs {
    /// Records from before, .jsonl
    pub old: PathBuf,
    /// Records from after
    pub new: PathBuf,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}
