//! `tetralux bench diff`: a guard against what becomes worse.

use super::args::DiffArgs;
use crate::cli::output;
use crate::report::diff::Differences;
use crate::report::record::Record;

pub(super) fn run(args: &DiffArgs) -> anyhow::Result<()> {
    let found = Differences::new(&Record::read(&args.old)?, &Record::read(&args.new)?);
    let text = if args.json { serde_json::to_string(&found)? } else { found.to_string() };
    output::say(&text)?;
    let (old, new) = (args.old.display(), args.new.display());
    anyhow::ensure!(!found.is_worse(), "something became worse from {old} to {new}");
    anyhow::ensure!(
        found.compared > 0,
        "nothing could be compared: {old} and {new} have no run of one subject in common"
    );
    Ok(())
}
