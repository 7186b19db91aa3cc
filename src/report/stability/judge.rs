//! From a picture and its truth to a verdict.

use std::fmt;

use serde::Serialize;

use super::{Expected, Known};
use crate::error::{Error, Result};
use crate::image::{Comparison, Image};

/// What is asked of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limits {
    /// At least, decibels.
    pub psnr: f64,
    /// At most, the pixel error that 99.9 % of the pixels keep below.
    pub percentile_99_9: f64,
}

/// Of every picture of which nothing else is known.
pub const PASS: Limits = Limits { psnr: 80.0, percentile_99_9: 1e-3 };

/// A picture whose brightest value is below this part of the truth's counts as black.
const BLACK: f64 = 1e-3;

/// What misses something errs by no more than what is there.
const MISSED: f64 = 1.0;

/// What became of one picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "verdict", rename_all = "lowercase")]
pub enum Verdict {
    /// Within [`PASS`].
    Pass,
    /// Worse, within what is known.
    Degrades {
        /// Why.
        why: String,
    },
    /// Nothing was drawn, as is known.
    Refuses {
        /// The renderer's words.
        why: String,
    },
    /// Anything else.
    Fails {
        /// What is wrong.
        why: String,
    },
}

impl Verdict {
    /// One word.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Degrades { .. } => "degrades",
            Self::Refuses { .. } => "refuses",
            Self::Fails { .. } => "fails",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pass => f.write_str("pass"),
            Self::Degrades { why } | Self::Refuses { why } | Self::Fails { why } => write!(f, "{}: {why}", self.word()),
        }
    }
}

/// How far a picture is from the truth, and what that means. Errors are in units of the truth's brightest value where that
/// is below 1; infinite where nothing was drawn.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Outcome {
    /// Largest error of a channel.
    pub max: f64,
    /// Over all channels.
    pub rmse: f64,
    /// Decibels.
    pub psnr: f64,
    /// The pixel error that 99.9 % of the pixels keep below.
    pub percentile_99_9: f64,
    /// What it means.
    #[serde(flatten)]
    pub verdict: Verdict,
}

/// Judges a picture, or the refusal to draw it.
pub(super) fn judge(got: &Result<Image>, want: &Image, known: Option<&Known>) -> Outcome {
    let got = match got {
        Ok(got) => got,
        Err(error) => return refusal(error, known),
    };
    let peak = peak(want);
    let exposure = if peak > 0.0 && peak < 1.0 { 1.0 / peak } else { 1.0 };
    let comparison = match Comparison::new(&exposed(got, exposure), &exposed(want, exposure)) {
        Ok(comparison) => comparison,
        Err(error) => return refusal(&error, None),
    };
    let Comparison { max, rmse, psnr, percentile_99_9, not_finite, .. } = comparison;
    let within = |limits: Limits| psnr >= limits.psnr && percentile_99_9 <= limits.percentile_99_9;
    let is_black = self::peak(got) < BLACK * peak;
    let known_by = known.map(|known| (known.expected, known.why.to_owned()));
    let verdict = match known_by {
        _ if not_finite > 0 => Verdict::Fails { why: format!("{not_finite} pixels are not finite") },
        _ if within(PASS) => Verdict::Pass,
        Some((Expected::Misses, why)) if max <= MISSED => Verdict::Degrades { why },
        _ if is_black => Verdict::Fails { why: "the picture is black, and the truth is not".into() },
        Some((Expected::Degrades(limits), why)) if within(limits) => Verdict::Degrades { why },
        _ => Verdict::Fails { why: format!("{psnr:.1} dB, 99.9th percentile {percentile_99_9:.1e}") },
    };
    Outcome { max, rmse, psnr, percentile_99_9, verdict }
}

fn refusal(error: &Error, known: Option<&Known>) -> Outcome {
    let why = error.to_string();
    let verdict = match known {
        Some(Known { expected: Expected::Refuses, .. }) => Verdict::Refuses { why },
        _ => Verdict::Fails { why },
    };
    let none = f64::INFINITY;
    Outcome { max: none, rmse: none, psnr: -none, percentile_99_9: none, verdict }
}

/// The largest value of any channel.
fn peak(image: &Image) -> f64 {
    image.pixels.iter().flatten().fold(0.0, |most, &v| f64::max(most, f64::from(v)))
}

fn exposed(image: &Image, factor: f64) -> Image {
    let pixels = image.pixels.iter().map(|p| p.map(|v| (factor * f64::from(v)) as f32)).collect();
    Image { pixels, ..*image }
}
