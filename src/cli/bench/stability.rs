//! `tetralux bench stability`: every method in every case, a table, a chart a case, and pictures of what degrades.

mod chart;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::super::output;
use crate::error::{Error, Result};
use crate::gpu::{DeviceChoice, Gpu};
use crate::image::{Comparison, Image, PngEncoding};
use crate::report::stability::{Case, Entrant, Row, Trial, Verdict, cases, run as run_case, worst};

#[derive(Debug, Args)]
pub(in crate::cli) struct StabilityArgs {
    /// Folder for stability.jsonl, a chart a case and pictures of what degrades; made where it is missing
    #[arg(short, long, value_name = "FOLDER", default_value = "out/bench/stability")]
    pub output: PathBuf,
    /// What draws beside the CPU: any graphics adapter, a software one, or nothing
    #[arg(long, value_name = "DEVICE", default_value = "gpu")]
    pub device: Device,
    /// Cases to draw, by name [default: all]
    #[arg(value_name = "CASE")]
    pub cases: Vec<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Device {
    Gpu,
    Software,
    Cpu,
}

pub(super) fn run(args: &StabilityArgs) -> anyhow::Result<()> {
    let cases = chosen(&args.cases)?;
    std::fs::create_dir_all(&args.output).map_err(|e| Error::write(&args.output, e))?;
    let gpu = match args.device {
        Device::Gpu => Some(Gpu::new(DeviceChoice::Any)?),
        Device::Software => Some(Gpu::new(DeviceChoice::Software)?),
        Device::Cpu => None,
    };
    if let Some(gpu) = &gpu {
        output::note(&gpu.describe());
    }
    output::say(
        "| case | entrant | verdict | at | PSNR, dB | 99.9th percentile | largest |\n|---|---|---|---|---|---|---|",
    )?;
    let (mut lines, mut failed) = (String::new(), 0);
    for case in &cases {
        let rows = draw(case, gpu.as_ref(), &args.output)?;
        for row in &rows {
            lines.push_str(&serde_json::to_string(row)?);
            lines.push('\n');
        }
        for row in worst(&rows) {
            output::say(&line(row))?;
            if let Verdict::Fails { why } = &row.outcome.verdict {
                failed += 1;
                output::note(&format!("{}, {}, {} = {}: {why}", case.name, row.entrant, case.parameter, row.value));
            }
        }
        output::write_whole(&args.output.join(format!("{}.svg", case.name)), &chart::of(case, &rows)?)?;
    }
    output::write_whole(&args.output.join("stability.jsonl"), &lines)?;
    match failed {
        0 => Ok(()),
        _ => anyhow::bail!("{failed} rows fail"),
    }
}

fn chosen(names: &[String]) -> Result<Vec<Case>> {
    let all = cases::all();
    if let Some(unknown) = names.iter().find(|name| all.iter().all(|case| case.name != name.as_str())) {
        let known: Vec<_> = all.iter().map(|case| case.name).collect();
        return Err(Error::Asked(format!("there is no case '{unknown}'; there are {}", known.join(", "))));
    }
    Ok(all.into_iter().filter(|case| names.is_empty() || names.iter().any(|name| name == case.name)).collect())
}

/// A case by all, and the worst picture of each entrant that does not pass.
fn draw(case: &Case, gpu: Option<&Gpu>, folder: &Path) -> Result<Vec<Row>> {
    let mut entrants = Entrant::on_host(case.integrals)?;
    if gpu.is_some() {
        entrants.extend(Entrant::ON_DEVICE);
    }
    let mut pictures: Vec<(String, f64, Image)> = Vec::new();
    let rows = run_case(case, &entrants, gpu, |row, trial, got| {
        let worse = pictures.iter().all(|(entrant, rmse, _)| *entrant != row.entrant || *rmse < row.outcome.rmse);
        if let Ok(got) = got
            && worse
            && row.outcome.verdict != Verdict::Pass
        {
            pictures.retain(|(entrant, ..)| *entrant != row.entrant);
            pictures.extend(beside(trial, got).map(|picture| (row.entrant.clone(), row.outcome.rmse, picture)));
        }
    })?;
    for (entrant, _, picture) in pictures {
        let name = format!("{}-{}.png", case.name, entrant.replace([' ', ':'], "-"));
        picture.write(&folder.join(name), PngEncoding::Srgb)?;
    }
    Ok(rows)
}

/// Truth, picture and four times their difference, side by side, three pixels for one.
fn beside(trial: &Trial, got: &Image) -> Option<Image> {
    const ZOOM: u32 = 3;
    let difference = Comparison::new(got, &trial.want).ok()?.difference_picture(4.0);
    let behind = |image: &Image| image.over([0.0, 0.0, 0.0, 1.0]);
    let parts = [behind(&trial.want), behind(got), difference];
    let [width, height] = [got.width, got.height];
    let mut sheet = Image::new(ZOOM * (3 * width + 2), ZOOM * height);
    for (i, pixel) in (0..).zip(&mut sheet.pixels) {
        let [x, y] = [i % (ZOOM * (3 * width + 2)) / ZOOM, i / (ZOOM * (3 * width + 2)) / ZOOM];
        let (part, x) = (x / (width + 1), x % (width + 1));
        *pixel = match x < width {
            true => parts[part as usize].pixels[(y * width + x) as usize],
            false => [1.0; 4],
        };
    }
    Some(sheet)
}

/// Of the table.
fn line(row: &Row) -> String {
    let Row { case, entrant, value, outcome } = row;
    let mut text = format!("| {case} | {entrant} | {} | {value:e} |", outcome.verdict.word());
    // A string takes whatever is written.
    let _ = match outcome.rmse.is_finite() {
        true => write!(text, " {:.1} | {:.1e} | {:.1e} |", outcome.psnr, outcome.percentile_99_9, outcome.max),
        false => write!(text, " | | |"),
    };
    text
}
