//! The segment checker: an integral's answers to stress cases against values computed with 34 digits.
//!
//! Inputs are f32, so an answer may err by what its input's last digit means: budgets are a fixed part plus four times
//! the case's sensitivity (the change when each end value moves by one f32 ulp).

use std::collections::BTreeMap;
use std::fmt;

use crate::cpu;
use crate::error::Result;
use crate::gpu::Gpu;
use crate::gpu::segments::{self, Segment};
use crate::oracle::Shade;
use crate::oracle::cases::Case;
use crate::oracle::segment::Medium;
use crate::renderer::SegmentIntegral;
use crate::scene::{EmissionModel, Optics, TransferFunction, Widget};

/// Widgets of less optical depth are not seen.
const VISIBLE_DEPTH: f64 = 1e-6;
/// Ulps of the input that an answer may err by.
const SENSITIVITIES: f64 = 4.0;

/// What an integral makes of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Answer {
    /// `1 - exp(-tau)`.
    pub opacity: f64,
    /// Linear, premultiplied.
    pub color: [f64; 3],
    /// Pieces that the segment was cut into.
    pub pieces: u32,
}

/// Largest errors allowed, beyond what the input's rounding may cost; infinite where nothing is promised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Budget {
    /// Of the opacity.
    pub opacity: f64,
    /// Of the colour where all that is seen has one colour.
    pub one_color: f64,
    /// Of the colour elsewhere.
    pub color: f64,
    /// Of the pieces' mean over cases in which several colours are seen.
    pub mean_pieces: f64,
}

impl Budget {
    /// What an integral promises. With unweighted emission, colours are compared after division by the length and the sum of the
    /// widgets' colours.
    pub fn of(integral: SegmentIntegral, emission: EmissionModel) -> Self {
        let nothing =
            Self { opacity: f64::INFINITY, one_color: f64::INFINITY, color: f64::INFINITY, mean_pieces: f64::INFINITY };
        if emission == EmissionModel::Unweighted {
            // Of the colour over the sum of the colours times the length; 2.7e-4 were measured, by tables alone 1.2e-4.
            return Self { opacity: 2e-6, one_color: 5e-4, color: 5e-4, ..nothing };
        }
        // Rounding: 2e-6 (the worst of the 3,000 cases that are compared: see tests/gpu_segments.rs).
        let exact = Self { opacity: 2e-6, one_color: 2e-6, color: f64::INFINITY, mean_pieces: f64::INFINITY };
        match integral {
            SegmentIntegral::Analytic => exact,
            SegmentIntegral::Adaptive { tolerance } => {
                let mean_pieces = match tolerance {
                    t if t >= 1e-2 => 2.5,
                    t if t >= 1e-3 => 5.0,
                    t if t >= 1e-4 => 11.0,
                    _ => f64::INFINITY,
                };
                // Below 1e-3, f32 adds its part.
                Self { color: if tolerance < 1e-3 { tolerance + 2e-4 } else { tolerance }, mean_pieces, ..exact }
            }
            _ => nothing,
        }
    }
}

/// A case's widgets.
fn widgets(case: &Case) -> &[Widget] {
    match &case.transfer {
        TransferFunction::Widgets(widgets) => widgets,
        TransferFunction::Curve(_) => &[],
    }
}

/// Whether widgets of different colours add to what is seen.
pub fn has_several_colors(case: &Case, least_depth: f64) -> bool {
    let seen = widgets(case).iter().zip(&case.expected.tau_of_widget).filter(|(_, tau)| **tau > least_depth);
    let colors: Vec<[f64; 3]> = seen.map(|(widget, _)| widget.color).collect();
    colors.windows(2).any(|pair| pair[0] != pair[1])
}

/// Answers of a device.
///
/// # Errors
/// Widgets beyond f32 or too many of them, a lost device.
pub fn on_device(gpu: &Gpu, integral: SegmentIntegral, emission: EmissionModel, cases: &[Case]) -> Result<Vec<Answer>> {
    let single = |v: [f64; 2]| v.map(|x| x as f32);
    let segments: Vec<Segment<'_>> = cases
        .iter()
        .map(|c| Segment { front: single(c.front), back: single(c.back), length: c.length as f32, widgets: widgets(c) })
        .collect();
    let answers = segments::integrate(gpu, integral, emission, &segments)?.into_iter().map(|r| Answer {
        opacity: 1.0 - f64::from(r.transmittance),
        color: r.color.map(f64::from),
        pieces: r.pieces,
    });
    Ok(answers.collect())
}

/// Answers of the CPU engine.
///
/// # Errors
/// What it does not integrate; widgets beyond f32.
pub fn on_cpu(integral: SegmentIntegral, emission: EmissionModel, cases: &[Case]) -> Result<Vec<Answer>> {
    let optics = Optics { emission, ..Optics::PLAIN };
    let answer = |case: &Case| {
        cpu::supports(&case.transfer, &optics, integral)?;
        let seen = cpu::integrate(&case.transfer, integral, case.front, case.back, case.length)?;
        let (opacity, color) = (f64::from(seen.opacity), seen.color.map(f64::from));
        Ok(Answer { opacity, color, pieces: seen.pieces })
    };
    cases.iter().map(answer).collect()
}

/// Answers of the f64 quadrature.
pub fn of_oracle(emission: EmissionModel, cases: &[Case]) -> Vec<Answer> {
    let answer = |case: &Case| {
        let medium = Medium { transfer: &case.transfer, emission, shade: Shade::NONE };
        let s = medium.integrate(case.front, case.back, case.length, 1e-11);
        Answer { opacity: -(-s.tau).exp_m1(), color: s.color, pieces: 1 }
    };
    cases.iter().map(answer).collect()
}

/// Errors of the cases with one tag.
#[derive(Clone, Debug, Default)]
struct Row {
    opacity: Vec<f64>,
    color: Vec<f64>,
    pieces: u64,
}

/// How far answers are from the truth.
#[derive(Clone, Debug)]
pub struct SegmentReport {
    rows: BTreeMap<String, Row>,
    all: Row,
    /// Mean pieces of the cases in which several colours are seen.
    pub mean_pieces: f64,
    /// What exceeds the budget, one line each, the worst first.
    pub failures: Vec<String>,
}

impl SegmentReport {
    /// Compares. Something not finite fails whatever the budget is.
    pub fn new(cases: &[Case], answers: &[Answer], emission: EmissionModel, budget: &Budget) -> Self {
        let mut report = Self { rows: BTreeMap::new(), all: Row::default(), mean_pieces: 0.0, failures: Vec::new() };
        let mut failures: Vec<(f64, String)> = Vec::new();
        let mut several = [0u64; 2];
        if cases.len() != answers.len() {
            failures.push((f64::INFINITY, format!("{} cases have {} answers", cases.len(), answers.len())));
        }
        for (case, answer) in cases.iter().zip(answers) {
            let opacity = finite_difference(answer.opacity, case.expected.opacity);
            let (want, sensitivity, scale) = match emission {
                EmissionModel::Weighted => (case.expected.weighted, case.sensitivity.weighted, 1.0),
                EmissionModel::Unweighted => {
                    let colors = widgets(case).iter().flat_map(|w| w.color).fold(0.0, f64::max);
                    let scale = 1.0 / (colors * case.length * widgets(case).len() as f64).max(1e-30);
                    (case.expected.unweighted, case.sensitivity.unweighted, scale)
                }
            };
            let color = (0..3).map(|c| finite_difference(answer.color[c] * scale, want[c] * scale)).fold(0.0, f64::max);
            for row in case.tags.iter().cloned() {
                report.rows.entry(row).or_default().add(opacity, color, answer.pieces);
            }
            report.all.add(opacity, color, answer.pieces);
            let most_color = if has_several_colors(case, 0.0) { budget.color } else { budget.one_color };
            let mut judge = |what: &str, error: f64, most: f64, sensitivity: f64| {
                let most = most + SENSITIVITIES * sensitivity;
                if !(error <= most && error.is_finite()) {
                    let tags = case.tags.join(" ");
                    let text = format!("case {} ({tags}): {what} errs by {error:.2e}, {most:.2e} is allowed", case.id);
                    failures.push((error / most, text));
                }
            };
            judge("opacity", opacity, budget.opacity, case.sensitivity.opacity);
            judge("colour", color, most_color, sensitivity * scale);
            if has_several_colors(case, VISIBLE_DEPTH) {
                several = [several[0] + 1, several[1] + u64::from(answer.pieces)];
            }
        }
        report.mean_pieces = several[1] as f64 / several[0].max(1) as f64;
        if report.mean_pieces > budget.mean_pieces {
            let (got, most) = (report.mean_pieces, budget.mean_pieces);
            failures
                .push((f64::INFINITY, format!("{got:.2} pieces where several colours are seen, {most} are allowed")));
        }
        failures.sort_by(|a, b| b.0.total_cmp(&a.0));
        report.failures = failures.into_iter().map(|(_, text)| text).collect();
        report
    }

    /// Largest error of the opacity and of the colour.
    pub fn worst(&self) -> [f64; 2] {
        [&self.all.opacity, &self.all.color].map(|errors| errors.iter().copied().fold(0.0, f64::max))
    }
}

/// Infinite where an answer is not a number.
fn finite_difference(got: f64, want: f64) -> f64 {
    let difference = (got - want).abs();
    if difference.is_finite() { difference } else { f64::INFINITY }
}

impl Row {
    fn add(&mut self, opacity: f64, color: f64, pieces: u32) {
        self.opacity.push(opacity);
        self.color.push(color);
        self.pieces += u64::from(pieces);
    }

    /// A line of the table.
    fn write(&self, name: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [opacity, color] = [&self.opacity, &self.color].map(|errors| {
            let mut sorted = errors.clone();
            sorted.sort_by(f64::total_cmp);
            let at = |part: f64| sorted.get((part * (sorted.len() - 1) as f64) as usize).copied().unwrap_or_default();
            [at(1.0), at(0.99)]
        });
        let count = self.opacity.len();
        let infinite = self.opacity.iter().chain(&self.color).filter(|e| e.is_infinite()).count();
        write!(
            f,
            "{name:<18} {count:>5} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.1e}",
            opacity[0], opacity[1], color[0], color[1]
        )?;
        writeln!(f, " {:>8.2} {infinite:>10}", self.pieces as f64 / count.max(1) as f64)
    }
}

impl fmt::Display for SegmentReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "tag                cases   opacity       p99    colour       p99   pieces not finite")?;
        for (tag, row) in &self.rows {
            row.write(tag, f)?;
        }
        self.all.write("all", f)?;
        writeln!(f, "mean pieces where several colours are seen: {:.2}", self.mean_pieces)?;
        for line in self.failures.iter().take(20) {
            writeln!(f, "{line}")?;
        }
        match self.failures.len() {
            0 => write!(f, "all within the budgets"),
            n => write!(f, "{n} beyond the budgets"),
        }
    }
}
