//! Errors against a case's parameter, both by their logarithms, one line an entrant: an SVG.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::error::{Error, Result};
use crate::report::stability::{Case, PASS, Row, entrants};

const SIZE: (u32, u32) = (640, 300);
/// Left, top, right, bottom.
const FRAME: [i32; 4] = [60, 30, 440, 250];
/// Of errors: what is smaller or larger lies on the border.
const ERRORS: [f64; 2] = [1e-9, 10.0];
/// The first seven are told apart with any colour vision (Okabe and Ito 2008).
const COLORS: [RGBColor; 11] = [
    RGBColor(0, 0, 0),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 158, 115),
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(204, 121, 167),
    RGBColor(136, 34, 85),
    RGBColor(153, 153, 51),
    RGBColor(51, 34, 136),
    RGBColor(120, 120, 120),
];
const GREY: RGBColor = RGBColor(150, 150, 150);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = std::result::Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// The chart of a case's rows.
pub(super) fn of(case: &Case, rows: &[Row]) -> Result<String> {
    // Browsers have one; plotters measures with ours.
    plotters::style::register_font("sans-serif", FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| Error::Mesh("the built-in font does not load".into()))?;
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw(&area, case, rows).and_then(|()| area.present()).map_err(|e| Error::Mesh(format!("cannot draw: {e}")))?;
    }
    Ok(text)
}

/// The parameter's values along x: by their logarithms, zero a decade before the smallest other.
struct Along {
    first: f64,
    last: f64,
    zero: f64,
}

impl Along {
    fn new(values: &[f64]) -> Self {
        let logs = || values.iter().filter(|v| **v > 0.0).map(|v| v.log10());
        let (least, last) = (logs().fold(f64::INFINITY, f64::min), logs().fold(f64::NEG_INFINITY, f64::max));
        let zero = least - 0.08 * (last - least).max(1.0);
        Self { first: if values.contains(&0.0) { zero } else { least }, last, zero }
    }

    fn x(&self, value: f64) -> i32 {
        let log = if value > 0.0 { value.log10() } else { self.zero };
        let share = (log - self.first) / (self.last - self.first).max(1e-9);
        FRAME[0] + 8 + (share * f64::from(FRAME[2] - FRAME[0] - 16)) as i32
    }
}

fn y(error: f64) -> i32 {
    let [low, high] = ERRORS.map(f64::log10);
    let share = (error.clamp(ERRORS[0], ERRORS[1]).log10() - low) / (high - low);
    FRAME[3] - (share * f64::from(FRAME[3] - FRAME[1])) as i32
}

fn draw(area: &Area<'_>, case: &Case, rows: &[Row]) -> Drawn {
    area.fill(&WHITE)?;
    let [left, top, right, bottom] = FRAME;
    let along = Along::new(case.values);
    for decade in -9..=1 {
        let at = y(10f64.powi(decade));
        area.draw(&PathElement::new([(left, at), (right, at)], GREY.mix(0.3)))?;
        if decade % 2 == 0 {
            label(area, &format!("1e{decade}"), (left - 6, at), (HPos::Right, VPos::Center), BLACK)?;
        }
    }
    area.draw(&Rectangle::new([(left, top), (right, bottom)], BLACK))?;
    let pass = y(10f64.powf(-PASS.psnr / 20.0));
    area.draw(&PathElement::new([(left, pass), (right, pass)], GREY.stroke_width(2)))?;
    label(area, "pass", (right - 4, pass + 2), (HPos::Right, VPos::Top), GREY)?;
    let mut labelled: Option<i32> = None;
    for &value in case.values {
        let x = along.x(value);
        area.draw(&PathElement::new([(x, bottom), (x, bottom + 4)], BLACK))?;
        // Labels that would run into one another are left out.
        if labelled.is_none_or(|last| (x - last).abs() >= 40) {
            let text =
                if (0.01..1e4).contains(&value) || value == 0.0 { value.to_string() } else { format!("{value:e}") };
            let text = if text.len() > 6 { format!("{value:.0e}") } else { text };
            label(area, &text, (x, bottom + 7), (HPos::Center, VPos::Top), BLACK)?;
            labelled = Some(x);
        }
    }
    label(area, case.parameter, ((left + right) / 2, bottom + 24), (HPos::Center, VPos::Top), BLACK)?;
    label(area, &format!("{}: RMSE", case.name), (left, top - 8), (HPos::Left, VPos::Bottom), BLACK)?;
    for (i, name) in entrants(rows).into_iter().enumerate() {
        let color = COLORS[i % COLORS.len()];
        let drawn = |row: &&Row| row.entrant == name && row.outcome.rmse.is_finite();
        let points: Vec<_> = rows.iter().filter(drawn).map(|row| (along.x(row.value), y(row.outcome.rmse))).collect();
        // Later lines are thinner: they do not hide those below.
        let width = (5 - i.min(4)) as u32;
        area.draw(&PathElement::new(points.clone(), color.stroke_width(width.div_ceil(2))))?;
        for point in points {
            area.draw(&Circle::new(point, 1 + width as i32 / 2, color.filled()))?;
        }
        let row = top + 10 + 20 * i as i32;
        area.draw(&PathElement::new([(right + 14, row), (right + 34, row)], color.stroke_width(width.div_ceil(2))))?;
        label(area, name, (right + 40, row), (HPos::Left, VPos::Center), BLACK)?;
    }
    Ok(())
}

fn label(area: &Area<'_>, what: &str, at: (i32, i32), (h, v): (HPos, VPos), ink: RGBColor) -> Drawn {
    let style = ("sans-serif", 13).into_text_style(area).color(&ink).pos(Pos::new(h, v));
    area.draw(&Text::new(what.to_owned(), at, style))
}
