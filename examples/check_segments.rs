//! How far an integral is from the truth on stress cases: errors by tag, pieces, and what exceeds the budgets.
//!
//! `cargo run --release --example check_segments -- CASES.json [--integral I] [--emission weighted|unweighted]
//! [--device gpu|software|cpu|oracle]`
//!
//! Ends with 1 where a budget is exceeded, 2 where something else went wrong.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program")]

use std::process::ExitCode;

use tetralux::gpu::{DeviceChoice, Gpu};
use tetralux::oracle::cases::parse;
use tetralux::renderer::SegmentIntegral;
use tetralux::report::segments::{Budget, SegmentReport, of_oracle, on_cpu, on_device};
use tetralux::scene::EmissionModel;
use tetralux::{Error, Result};

struct Asked {
    file: String,
    integral: SegmentIntegral,
    emission: EmissionModel,
    device: Device,
}

/// Who integrates.
enum Device {
    Adapter(DeviceChoice),
    Cpu,
    Oracle,
}

fn asked() -> Result<Asked> {
    let usage = || {
        Error::Asked("usage: check_segments CASES.json [--integral I] [--emission weighted|unweighted] [--device gpu|software|cpu|oracle]".into())
    };
    let mut arguments = std::env::args().skip(1);
    let mut file = None;
    let mut integral = SegmentIntegral::default();
    let mut emission = EmissionModel::Weighted;
    let mut device = Device::Adapter(DeviceChoice::Any);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--integral" => integral = arguments.next().ok_or_else(usage)?.parse()?,
            "--emission" => {
                emission = match arguments.next().as_deref() {
                    Some("weighted") => EmissionModel::Weighted,
                    Some("unweighted") => EmissionModel::Unweighted,
                    _ => return Err(usage()),
                }
            }
            "--device" => {
                device = match arguments.next().as_deref() {
                    Some("gpu") => Device::Adapter(DeviceChoice::Any),
                    Some("software") => Device::Adapter(DeviceChoice::Software),
                    Some("cpu") => Device::Cpu,
                    Some("oracle") => Device::Oracle,
                    _ => return Err(usage()),
                }
            }
            flag if flag.starts_with('-') => return Err(usage()),
            path => file = Some(path.to_owned()),
        }
    }
    Ok(Asked { file: file.ok_or_else(usage)?, integral, emission, device })
}

fn check() -> Result<bool> {
    let Asked { file, integral, emission, device } = asked()?;
    let text = std::fs::read_to_string(&file).map_err(|e| Error::io(file.as_ref(), e))?;
    let cases = parse(&text)?;
    let (answers, name, budget) = match device {
        Device::Adapter(choice) => {
            let gpu = Gpu::new(choice)?;
            (
                on_device(&gpu, integral, emission, &cases)?,
                format!("{integral} on {}", gpu.describe()),
                Budget::of(integral, emission),
            )
        }
        Device::Cpu => {
            (on_cpu(integral, emission, &cases)?, format!("{integral} on the CPU"), Budget::of(integral, emission))
        }
        Device::Oracle => {
            let most = 1e-9;
            let budget = Budget { opacity: most, one_color: most, color: most, mean_pieces: f64::INFINITY };
            (of_oracle(emission, &cases), "quadrature in f64".to_owned(), budget)
        }
    };
    let report = SegmentReport::new(&cases, &answers, emission, &budget);
    println!("{name}\n{report}");
    Ok(report.failures.is_empty())
}

fn main() -> ExitCode {
    match check() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
