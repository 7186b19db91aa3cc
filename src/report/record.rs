//! One measured run: what was drawn, by what, how long it took and how far it is from the truth. Lines of JSON, SI units.

use std::path::Path;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use crate::error::{Error, Result};
use crate::image::Comparison;

/// One cell of a plan's matrix, or what another program made of the same.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// What was drawn.
    pub subject: Subject,
    /// By what.
    pub by: Contender,
    /// Where.
    pub machine: Machine,
    /// What it took and gave; `None` where it was refused.
    pub result: Option<Measured>,
    /// Why it was refused.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
}

/// A mesh under a function from a place, as pixels: what has one true picture.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Subject {
    /// The plan's names.
    pub mesh: String,
    /// See `mesh`.
    pub scene: String,
    /// See `mesh`.
    pub view: String,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Of the data.
    pub tetrahedra: u64,
    /// Of the mesh's contents, the scene, the camera and the size, hexadecimal: pictures of equal hashes should be equal.
    pub hash: String,
}

/// A program and its choices.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contender {
    /// `tetralux`, or another's name and version.
    pub program: String,
    /// As on the command line, or another program's words.
    pub device: String,
    /// See `device`.
    pub method: String,
    /// See `device`.
    pub integral: String,
    /// See `device`.
    pub order: String,
}

/// Where it ran.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Machine {
    /// The processor's name.
    pub processor: String,
    /// Logical processors.
    pub threads: usize,
    /// Of the machine.
    pub memory_bytes: u64,
    /// Name and version.
    pub system: String,
    /// Graphics adapter and driver, or what stands for one.
    pub adapter: String,
    /// Of the program's source; ends in `-dirty` where files had changed.
    pub commit: String,
}

/// What a run took, and how far its picture is from the truth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measured {
    /// Wall clock, warm.
    pub frame_seconds: Spread,
    /// Of the process, a frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cpu_seconds: Option<f64>,
    /// By the device's clock where it has one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub passes: Vec<Pass>,
    /// Tetrahedra left to draw; `None` where that is not counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawn: Option<u64>,
    /// Opening the device, uploading, compiling.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub prepare_seconds: Option<f64>,
    /// On the device.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub device_bytes: Option<u64>,
    /// Most that the process had held by then.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub peak_bytes: Option<u64>,
    /// What `auto` took, where that is told.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub chosen: Option<String>,
    /// Against the reference.
    pub error: Deviation,
}

/// Of several frames, seconds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spread {
    /// The middle one.
    pub median: f64,
    /// The shortest.
    pub min: f64,
    /// The longest.
    pub max: f64,
    /// How many.
    pub frames: usize,
}

/// A pass of one frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pass {
    /// As `--explain` names it.
    pub name: String,
    /// See [`Measured::passes`].
    pub seconds: f64,
}

/// How far a picture is from the truth, in linear float, all channels alike.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Deviation {
    /// Largest.
    pub max: f64,
    /// Root of the mean square.
    pub rmse: f64,
    /// Decibels, peak 1; absent where the pictures are equal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub psnr: Option<f64>,
    /// What 99.9 % of the pixels do not exceed.
    pub percentile_99_9: f64,
    /// Share of pixels that err by more than 1/255.
    pub above_8_bit: f64,
}

impl Spread {
    /// Of times in any order; `None` of none.
    pub fn new(times: &[Duration]) -> Option<Self> {
        let mut seconds: Vec<f64> = times.iter().map(Duration::as_secs_f64).collect();
        seconds.sort_by(f64::total_cmp);
        let (&min, &max, frames) = (seconds.first()?, seconds.last()?, seconds.len());
        let median = 0.5 * (seconds[(frames - 1) / 2] + seconds[frames / 2]);
        Some(Self { median, min, max, frames })
    }
}

impl Deviation {
    /// `None` where a picture holds what is not finite: such a picture has no error that could be charted.
    pub fn new(c: &Comparison) -> Option<Self> {
        let psnr = c.psnr.is_finite().then_some(c.psnr);
        let (max, rmse, percentile_99_9, above_8_bit) = (c.max, c.rmse, c.percentile_99_9, c.above_8_bit);
        c.max.is_finite().then_some(Self { max, rmse, psnr, percentile_99_9, above_8_bit })
    }
}

impl Record {
    /// True where `other` measured the same by the same, on the same machine and commit.
    pub fn repeats(&self, other: &Self) -> bool {
        (&self.subject, &self.by, &self.machine) == (&other.subject, &other.by, &other.machine)
    }

    /// Reads lines of JSON; empty ones are passed over.
    ///
    /// # Errors
    /// [`Error::Io`] where the file cannot be read, [`Error::Malformed`] with the line that is no record.
    pub fn read(path: &Path) -> Result<Vec<Self>> {
        let text = std::fs::read_to_string(path).map_err(|source| Error::io(path, source))?;
        let line = |(i, line): (usize, &str)| {
            let record: Self = serde_json::from_str(line)
                .map_err(|e| Error::malformed(path, format!("line {}: no record of a run: {e}", i + 1)))?;
            if record.result.is_some() == record.refused.is_some() {
                let what = format!("line {}: a run has either a result or the reason why it was refused", i + 1);
                return Err(Error::malformed(path, what));
            }
            Ok(record)
        };
        text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()).map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One of each kind.
    fn examples() -> Vec<Record> {
        let subject = Subject {
            mesh: "fire".into(),
            scene: "bands".into(),
            view: "front".into(),
            size: [64, 48],
            tetrahedra: 1_000,
            hash: "00ff".into(),
        };
        let by = Contender {
            program: "tetralux".into(),
            device: "cpu".into(),
            method: "auto".into(),
            integral: "adaptive:0.001".into(),
            order: "auto".into(),
        };
        let machine = Machine {
            processor: "a processor".into(),
            threads: 2,
            memory_bytes: 1 << 30,
            system: "Linux".into(),
            adapter: "cores".into(),
            commit: "abc".into(),
        };
        let times = [3, 1, 2].map(Duration::from_secs);
        let measured = Measured {
            frame_seconds: Spread::new(&times).expect("times"),
            cpu_seconds: Some(1.5),
            passes: vec![Pass { name: "cull".into(), seconds: 1e-3 }],
            drawn: Some(12),
            prepare_seconds: None,
            device_bytes: None,
            peak_bytes: Some(99),
            chosen: None,
            error: Deviation { max: 0.1, rmse: 0.01, psnr: Some(40.0), percentile_99_9: 0.05, above_8_bit: 0.2 },
        };
        let mut refused = Record { subject, by, machine, result: Some(measured), refused: None };
        let drawn = refused.clone();
        refused.result = None;
        refused.refused = Some("no such order".into());
        vec![drawn, refused]
    }

    #[test]
    fn what_is_written_is_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("records.jsonl");
        let lines: Vec<String> = examples().iter().map(|r| serde_json::to_string(r).expect("JSON")).collect();
        std::fs::write(&path, lines.join("\n\n")).expect("written");
        assert_eq!(Record::read(&path).expect("records"), examples());
    }

    #[test]
    fn a_line_that_is_no_record_is_named() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("records.jsonl");
        let good = serde_json::to_string(&examples()[0]).expect("JSON");
        let neither = {
            let mut record = examples()[0].clone();
            record.result = None;
            serde_json::to_string(&record).expect("JSON")
        };
        for bad in ["{", "{\"subject\": 1}", neither.as_str(), &good.replace("\"view\"", "\"angle\"")] {
            std::fs::write(&path, format!("{good}\n\n{bad}\n")).expect("written");
            let message = Record::read(&path).expect_err("no record").to_string();
            assert!(message.contains("line 3"), "{message}");
        }
    }

    #[test]
    fn the_middle_of_times() {
        let spread = Spread::new(&[4, 1, 3, 2].map(Duration::from_secs)).expect("times");
        assert_eq!((spread.median, spread.min, spread.max, spread.frames), (2.5, 1.0, 4.0, 4));
        assert_eq!(Spread::new(&[]), None);
    }
}
