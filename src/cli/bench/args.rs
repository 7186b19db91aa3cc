//! What was typed after `bench`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

/// What to do with runs and their records.
#[derive(Debug, Subcommand)]
pub(in crate::cli) enum BenchCommand {
    /// Turn records into a page: error against time, growth with cells and pixels, passes, pictures, a table
    Report(ReportArgs),
    /// Tell what became worse from one list of records to another; fail (exit code 1) where something did
    Diff(DiffArgs),
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
