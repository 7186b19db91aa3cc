//! Stress cases of one segment: what they ask and what 34 digits answer. A file of them is JSON:
//!
//! ```text
//! { "cases": [ { "id": int, "tags": [str],
//!     "segment": { "sf", "gf", "sb", "gb", "D" },              scalar and gradient at the front (eye side) and back; length
//!     "widgets": [ { "type": "uniform" | "gaussian" | "triangle" | "sine" | "ramp", "amax", "color": [r, g, b],
//!         "box": { "s": [lo, hi] | null, "g": [lo, hi] | null }?, "window": { "dir": [a, b], "knots": [[u, w], ...] }?,
//!         gaussian: "center", "sigma", "angle" (radians)?      triangle: "dir", "offset", "period", "duty"?
//!         sine: "dir", "offset", "period", "variant"?          ramp: "dir", "knots" } ],
//!     "expect": { "tau_k", "tau", "alpha", "C_weighted": [r, g, b], "C_unweighted": [r, g, b] },
//!     "sensitivity": { "alpha", "Cw", "Cu" } } ] }             changes when each end point moves by one f32 ulp
//! ```

use serde::Deserialize;

use crate::error::{Error, Result};
use crate::scene::{SinusoidVariant, TransferFunction, Widget, WidgetShape, Window};

/// One segment, what it leads through, and what it does to light.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// In its file.
    pub id: u32,
    /// What is hard about it.
    pub tags: Vec<String>,
    /// (scalar, gradient magnitude) at the eye's side.
    pub front: [f64; 2],
    /// (scalar, gradient magnitude) at the far side.
    pub back: [f64; 2],
    /// Data units.
    pub length: f64,
    /// Widgets, in the order of [`Expected::tau_of_widget`].
    pub transfer: TransferFunction,
    /// The answer.
    pub expected: Expected,
    /// What f32 input costs whoever computes.
    pub sensitivity: Sensitivity,
}

/// The integrals of a case.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Expected {
    /// Optical depth of each widget alone.
    #[serde(rename = "tau_k")]
    pub tau_of_widget: Vec<f64>,
    /// Optical depth.
    pub tau: f64,
    /// `1 - exp(-tau)`.
    #[serde(rename = "alpha")]
    pub opacity: f64,
    /// Colour by the weighted model.
    #[serde(rename = "C_weighted")]
    pub weighted: [f64; 3],
    /// Colour by the unweighted model.
    #[serde(rename = "C_unweighted")]
    pub unweighted: [f64; 3],
}

/// Sum of the changes when each of the four end values moves by one f32 ulp.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub struct Sensitivity {
    /// Of the opacity.
    #[serde(rename = "alpha")]
    pub opacity: f64,
    /// Of the weighted colour.
    #[serde(rename = "Cw")]
    pub weighted: f64,
    /// Of the unweighted colour.
    #[serde(rename = "Cu")]
    pub unweighted: f64,
}

/// Reads the text of a file of cases.
///
/// # Errors
/// [`Error::Asked`] where it is no JSON of this form, naming line and column, or a case lacks what its shape needs.
pub fn parse(text: &str) -> Result<Vec<Case>> {
    let file: File = serde_json::from_str(text).map_err(|e| Error::Asked(format!("segment cases: {e}")))?;
    file.cases.into_iter().map(Record::case).collect()
}

#[derive(Deserialize)]
struct File {
    cases: Vec<Record>,
}

#[derive(Deserialize)]
struct Record {
    id: u32,
    tags: Vec<String>,
    segment: Ends,
    widgets: Vec<WidgetRecord>,
    expect: Expected,
    sensitivity: Sensitivity,
}

#[derive(Deserialize)]
struct Ends {
    sf: f64,
    gf: f64,
    sb: f64,
    gb: f64,
    #[serde(rename = "D")]
    length: f64,
}

#[derive(Deserialize)]
struct WidgetRecord {
    #[serde(flatten)]
    shape: Shape,
    amax: f64,
    color: [f64; 3],
    #[serde(rename = "box")]
    ranges: Option<Ranges>,
    window: Option<Knots>,
}

#[derive(Deserialize)]
#[serde(tag = "type", rename_all = "lowercase")]
enum Shape {
    Uniform,
    Gaussian { center: [f64; 2], sigma: [f64; 2], angle: Option<f64> },
    Triangle { dir: [f64; 2], offset: f64, period: f64, duty: Option<f64> },
    Sine { dir: [f64; 2], offset: f64, period: f64, variant: Option<Variant> },
    Ramp(Knots),
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Variant {
    Cos,
    Arch,
    Half,
}

#[derive(Deserialize)]
struct Ranges {
    s: Option<[f64; 2]>,
    g: Option<[f64; 2]>,
}

#[derive(Deserialize)]
struct Knots {
    dir: [f64; 2],
    knots: Vec<[f64; 2]>,
}

impl Record {
    fn case(self) -> Result<Case> {
        let Ends { sf, gf, sb, gb, length } = self.segment;
        if self.widgets.len() != self.expect.tau_of_widget.len() {
            let (widgets, depths) = (self.widgets.len(), self.expect.tau_of_widget.len());
            return Err(Error::Asked(format!("segment case {}: {widgets} widgets and {depths} depths", self.id)));
        }
        Ok(Case {
            id: self.id,
            tags: self.tags,
            front: [sf, gf],
            back: [sb, gb],
            length,
            transfer: TransferFunction::Widgets(self.widgets.into_iter().map(WidgetRecord::widget).collect()),
            expected: self.expect,
            sensitivity: self.sensitivity,
        })
    }
}

impl WidgetRecord {
    fn widget(self) -> Widget {
        let shape = match self.shape {
            Shape::Uniform => WidgetShape::Uniform,
            Shape::Gaussian { center, sigma, angle } => {
                WidgetShape::Gaussian { center, sigma, angle: angle.unwrap_or(0.0) }
            }
            Shape::Triangle { dir, offset, period, duty } => {
                WidgetShape::Triangle { direction: dir, offset, period, duty: duty.unwrap_or(1.0) }
            }
            Shape::Sine { dir, offset, period, variant } => {
                let variant = match variant {
                    Some(Variant::Cos) | None => SinusoidVariant::Cos,
                    Some(Variant::Arch) => SinusoidVariant::Arch,
                    Some(Variant::Half) => SinusoidVariant::Half,
                };
                WidgetShape::Sinusoid { direction: dir, offset, period, variant }
            }
            Shape::Ramp(Knots { dir, knots }) => WidgetShape::Ramp { direction: dir, knots },
        };
        Widget {
            scalar_range: self.ranges.as_ref().and_then(|r| r.s),
            gradient_range: self.ranges.as_ref().and_then(|r| r.g),
            window: self.window.map(|Knots { dir, knots }| Window { direction: dir, knots }),
            ..Widget::new(shape, self.color, self.amax)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CASE: &str = r#"{"cases": [{"id": 7, "tags": ["single"],
        "segment": {"sf": 0, "gf": 1, "sb": 2, "gb": 3, "D": 4},
        "widgets": [{"type": "sine", "amax": 5, "color": [1, 0, 0.5], "dir": [0, 1], "offset": 0.25, "period": 0.5,
            "box": {"s": null, "g": [0, 9]}, "window": {"dir": [1, 0], "knots": [[0, 1], [1, 0]]}}],
        "expect": {"tau_k": [1], "tau": 1, "alpha": 0.6, "C_weighted": [1, 2, 3], "C_unweighted": [4, 5, 6]},
        "sensitivity": {"alpha": 0, "Cw": 1, "Cu": 2}}]}"#;

    #[test]
    fn a_case_is_read_whole() {
        let case = &parse(CASE).unwrap()[0];
        assert_eq!((case.id, case.front, case.back, case.length), (7, [0.0, 1.0], [2.0, 3.0], 4.0));
        let TransferFunction::Widgets(widgets) = &case.transfer else { panic!("widgets") };
        let variant = SinusoidVariant::Cos;
        let shape = WidgetShape::Sinusoid { direction: [0.0, 1.0], offset: 0.25, period: 0.5, variant };
        assert_eq!((&widgets[0].shape, widgets[0].extinction), (&shape, 5.0));
        assert_eq!((widgets[0].scalar_range, widgets[0].gradient_range), (None, Some([0.0, 9.0])));
        assert_eq!(widgets[0].window.as_ref().unwrap().knots.len(), 2);
        assert_eq!((case.expected.unweighted, case.sensitivity.weighted), ([4.0, 5.0, 6.0], 1.0));
    }

    #[test]
    fn wrong_cases_are_refused() {
        for (from, to, part) in [
            ("\"sine\"", "\"cube\"", "cube"),
            ("\"period\": 0.5,", "", "period"),
            ("\"tau_k\": [1]", "\"tau_k\": []", "1 widgets and 0 depths"),
            ("{\"cases\"", "[", "line 1"),
        ] {
            let error = parse(&CASE.replace(from, to)).expect_err(from).to_string();
            assert!(error.contains(part) && error.starts_with("segment case"), "{error}");
        }
    }
}
