//! `tetralux tables`: the files under `tables/`, made or compared.

use std::path::{Path, PathBuf};

use super::args::TablesArgs;
use super::{output, progress};
use crate::error::{Error, Result};
use crate::tables::{Difference, Kind, Table2, generate, index};

pub(super) fn run(args: &TablesArgs) -> anyhow::Result<()> {
    if !args.output.is_dir() {
        return Err(Error::write(&args.output, "there is no such folder; make it first").into());
    }
    let tables = progress::step("integrating", || Kind::ALL.map(generate));
    if args.check {
        check(&args.output, &tables)?
    } else {
        write(&args.output, &tables)?
    }
    Ok(())
}

fn file(folder: &Path, table: &Table2) -> PathBuf {
    folder.join(format!("{}.f32", table.name))
}

fn write(folder: &Path, tables: &[Table2]) -> Result<()> {
    let mut files: Vec<_> = tables.iter().map(|table| (file(folder, table), table.bytes())).collect();
    files.push((folder.join("index.json"), index().into_bytes()));
    output::write_together(&files)?;
    for (path, bytes) in &files {
        output::note(&format!("{} bytes: {}", bytes.len(), path.display()));
    }
    Ok(())
}

/// Reports on every file; the error names the first that is not what it should be.
fn check(folder: &Path, tables: &[Table2]) -> Result<()> {
    let read = |path: &Path| std::fs::read(path).map_err(|e| Error::io(path, e));
    let mut outcome = Ok(());
    for table in tables {
        let path = file(folder, table);
        let checked = read(&path)
            .and_then(|bytes| table.compare(&bytes).map_err(|e| Error::malformed(&path, e.to_string())))
            .and_then(|difference| judge(table, &path, difference));
        match checked {
            Ok(text) => output::note(&text),
            Err(error) => outcome = outcome.and(Err(error)),
        }
    }
    let path = folder.join("index.json");
    outcome.and(read(&path)).and_then(|text| match text == index().as_bytes() {
        true => Ok(()),
        false => Err(Error::malformed(&path, "not what is generated; `tetralux tables` writes it anew")),
    })
}

fn judge(table: &Table2, path: &Path, difference: Difference) -> Result<String> {
    let Difference { values, units, node: [i, j] } = difference;
    let count = table.values.len();
    if units > Difference::TOLERATED {
        let what = format!(
            "{values} of {count} values differ from what is generated, that of node ({i}, {j}) by {units} units in the \
             last place; `tetralux tables` writes them anew"
        );
        return Err(Error::malformed(path, what));
    }
    Ok(match values {
        0 => format!("the same: {}", path.display()),
        _ => format!("{values} of {count} values differ in their last place: {}", path.display()),
    })
}
