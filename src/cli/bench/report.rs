//! `tetralux bench report`: records turned into a page and charts.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::args::ReportArgs;
use super::growth::Against;
use super::marks::{DARK, LIGHT, Looks};
use super::page::{self, Section};
use super::points::{Points, last_of_each};
use super::{growth, passes, speed, strips};
use crate::cli::output;
use crate::error::{Error, Result};
use crate::report::record::Record;

/// A record, and the folder that its pictures are beside.
pub(super) struct Run {
    pub record: Record,
    pub folder: PathBuf,
}

pub(super) fn run(args: &ReportArgs) -> anyhow::Result<()> {
    let runs = read(args)?;
    let records: Vec<&Record> = runs.iter().map(|run| &run.record).collect();
    let points = Points::new(&records);
    let mut sections = sections(&points)?;
    name_apart(&mut sections);
    let strips = strips::strips(&runs)?;
    let page = page::page(&records, &points, &sections, &strips);
    let mut files = vec![(args.output.join("report.html"), page.into_bytes())];
    for chart in sections.into_iter().flat_map(|section| section.charts) {
        for (theme, svg) in [(LIGHT.name, chart.light), (DARK.name, chart.dark)] {
            files.push((args.output.join(format!("{}-{theme}.svg", chart.name)), svg.into_bytes()));
        }
    }
    std::fs::create_dir_all(&args.output).map_err(|e| Error::write(&args.output, e))?;
    output::write_together(&files)?;
    let [(path, _), charts @ ..] = &files[..] else { return Ok(()) };
    output::note(&format!("{} runs, {} charts: {}", records.len(), charts.len() / 2, path.display()));
    Ok(())
}

/// All records; of those that repeat each other, the last.
fn read(args: &ReportArgs) -> Result<Vec<Run>> {
    let mut files = args.records.clone();
    if let Some(folder) = &args.peers {
        files.extend(records_in(folder)?);
    }
    let mut runs = Vec::new();
    for file in &files {
        let folder = file.parent().unwrap_or(Path::new("")).to_owned();
        runs.extend(Record::read(file)?.into_iter().map(|record| Run { record, folder: folder.clone() }));
    }
    if runs.is_empty() {
        let names = files.iter().map(|f| f.display().to_string()).collect::<Vec<_>>().join(", ");
        return Err(Error::Mesh(format!("there are no records to report on: {names}")));
    }
    Ok(last_of_each(runs, |run| &run.record))
}

fn records_in(folder: &Path) -> Result<Vec<PathBuf>> {
    let entries = std::fs::read_dir(folder).map_err(|e| Error::io(folder, e))?;
    let paths = entries.map(|entry| entry.map(|e| e.path()).map_err(|e| Error::io(folder, e)));
    let mut files = paths.collect::<Result<Vec<_>>>()?;
    files.retain(|file| file.extension().is_some_and(|e| e == "jsonl"));
    files.sort();
    match files.is_empty() {
        true => Err(Error::Mesh(format!("the folder holds no .jsonl file: {}", folder.display()))),
        false => Ok(files),
    }
}

fn sections(points: &Points<'_>) -> Result<Vec<Section>> {
    let looks = Looks::new(&points.points);
    let (tetrahedra, few_tetrahedra) = growth::charts(points, &looks, Against::Tetrahedra)?;
    let (pixels, few_pixels) = growth::charts(points, &looks, Against::Pixels)?;
    let all = [
        Section {
            id: "speed",
            title: "Error against time",
            text: "Down and to the left is better. Colours are methods, shapes are integrals. The stair goes through \
                   the runs that no other beats in both; what lies above it is slower and further from the truth than \
                   one of them.",
            charts: speed::charts(points, &looks)?,
            left_out: Vec::new(),
        },
        Section {
            id: "cells",
            title: "Time against tetrahedra",
            text: "Of meshes under one scene at one size. The exponent p of time ~ tetrahedra^p is a least-squares fit \
                   of the logarithms, with its standard error. Of more than a dozen contenders, the one of each method with \
                   the smallest error is drawn.",
            charts: tetrahedra,
            left_out: few_tetrahedra,
        },
        Section {
            id: "pixels",
            title: "Time against pixels",
            text: "Of one mesh under one scene, in the same way.",
            charts: pixels,
            left_out: few_pixels,
        },
        Section {
            id: "passes",
            title: "Passes",
            text: "What share of the passes' time each takes, over all views.",
            charts: passes::charts(points)?,
            left_out: Vec::new(),
        },
    ];
    Ok(all.into_iter().filter(|s| !s.charts.is_empty() || !s.left_out.is_empty()).collect())
}

/// Names that differ in characters alone that files cannot have would name one file.
fn name_apart(sections: &mut [Section]) {
    let mut taken = HashSet::new();
    for chart in sections.iter_mut().flat_map(|section| &mut section.charts) {
        let name = chart.name.clone();
        for i in 2.. {
            if taken.insert(chart.name.to_lowercase()) {
                break;
            }
            chart.name = format!("{name}-{i}");
        }
    }
}
