//! Values into pictures, pictures into rows.

use std::sync::Arc;

use serde::Serialize;

use super::judge::{Outcome, Verdict, judge};
use super::{Case, Entrant, Setup, Shot, Truth};
use crate::error::Result;
use crate::gpu::Gpu;
use crate::image::Image;
use crate::oracle::Oracle;
use crate::space::Ray;

/// A case at one of its values, and its true picture.
pub struct Trial {
    /// The case.
    pub case: Case,
    /// Of its parameter.
    pub value: f64,
    /// What is drawn.
    pub shot: Shot,
    /// What it should be.
    pub want: Image,
}

impl Trial {
    /// Draws the truth.
    ///
    /// # Errors
    /// A mesh that cannot be made.
    pub fn new(case: &Case, value: f64) -> Result<Self> {
        let Setup { shot, truth } = (case.make)(value)?;
        let want = match truth {
            Truth::Reference => reference(&shot)?,
            Truth::Same(other) => reference(&other)?,
            Truth::Formula(formula) => by_formula(&shot, &formula),
        };
        Ok(Self { case: *case, value, shot, want })
    }

    /// What a picture, said to be by `entrant`, is worth.
    pub fn judge(&self, entrant: Entrant, got: &Result<Image>) -> Outcome {
        judge(got, &self.want, self.case.known(&entrant.to_string(), self.value))
    }
}

fn reference(shot: &Shot) -> Result<Image> {
    Oracle::new(Arc::clone(&shot.mesh)).image(&shot.frame())
}

fn by_formula(shot: &Shot, formula: &dyn Fn(&Ray) -> [f64; 4]) -> Image {
    let [width, height] = shot.size;
    let mut image = Image::new(width, height);
    for (i, pixel) in (0..).zip(&mut image.pixels) {
        let position = [i % width, i / width].map(|at| f64::from(at) + 0.5);
        *pixel = formula(&shot.camera.ray(shot.size, position)).map(|v| v as f32);
    }
    image
}

/// One picture of the suite.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// The case's name.
    pub case: &'static str,
    /// The entrant's name.
    pub entrant: String,
    /// Of the case's parameter.
    pub value: f64,
    /// What the picture is worth.
    #[serde(flatten)]
    pub outcome: Outcome,
}

/// Every entrant at every value of a case. `hear` sees each row, with its trial and its picture, as it comes.
///
/// # Errors
/// A mesh that cannot be made.
pub fn run(
    case: &Case,
    entrants: &[Entrant],
    gpu: Option<&Gpu>,
    mut hear: impl FnMut(&Row, &Trial, &Result<Image>),
) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for &value in case.values {
        let trial = Trial::new(case, value)?;
        for &entrant in entrants {
            let got = entrant.draw(&trial.shot, gpu);
            let outcome = trial.judge(entrant, &got);
            let row = Row { case: case.name, entrant: entrant.to_string(), value, outcome };
            hear(&row, &trial, &got);
            rows.push(row);
        }
    }
    Ok(rows)
}

/// Of the rows of a case the worst of each entrant, in their order: by verdict, then by error.
pub fn worst(rows: &[Row]) -> Vec<&Row> {
    let rank = |row: &Row| match row.outcome.verdict {
        Verdict::Pass => 0,
        Verdict::Degrades { .. } => 1,
        Verdict::Refuses { .. } => 2,
        Verdict::Fails { .. } => 3,
    };
    let of = |name: &str| {
        let worse = |a: &&Row, b: &&Row| rank(a).cmp(&rank(b)).then(a.outcome.rmse.total_cmp(&b.outcome.rmse));
        rows.iter().filter(|row| row.entrant == name).max_by(worse)
    };
    entrants(rows).into_iter().filter_map(of).collect()
}

/// The entrants of rows, once each.
pub fn entrants(rows: &[Row]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for row in rows {
        if !names.contains(&row.entrant.as_str()) {
            names.push(&row.entrant);
        }
    }
    names
}
