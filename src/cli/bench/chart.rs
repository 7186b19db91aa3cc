//! What charts are drawn on: SVG by plotters, text as text, in a light and a dark version; and a frame with two
//! logarithmic axes. What a pointer finds is told beside the drawing, as plotters gives elements no names.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::marks::{DARK, LIGHT, Mark, Theme};
use super::scale::{LogScale, Notation};
use super::words;
use crate::error::{Error, Result};

/// Plotters counts in whole units: this many a pixel.
const UNITS: f64 = 4.0;
/// Of all charts, pixels.
pub(super) const WIDTH: f64 = 640.0;
pub(super) const TEXT: f64 = 13.0;
/// The average character's width, by the height; browsers choose the font, so this is a guess on the safe side.
pub(super) const CHARACTER: f64 = 0.56;
/// Height of a legend's row.
pub(super) const ROW: f64 = 19.0;

pub(super) type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// A finished chart.
#[derive(Debug)]
pub(super) struct Chart {
    /// Of its files, without the theme's name and the ending.
    pub name: String,
    /// As files.
    pub light: String,
    pub dark: String,
}

/// Something that is told where it is pointed at: lines of text.
#[derive(Debug)]
pub(super) struct Spot {
    pub at: [f64; 2],
    pub text: String,
}

/// Paper, in pixels.
pub(super) struct Canvas<'a>(DrawingArea<SVGBackend<'a>, Shift>);

impl Chart {
    pub fn new(
        name: String,
        title: String,
        height: f64,
        spots: &[Spot],
        draw: impl Fn(&Canvas<'_>, &Theme) -> Drawn,
    ) -> Result<Self> {
        let themed = |theme| svg(&title, height, spots, theme, &draw);
        let (light, dark) = (themed(&LIGHT)?, themed(&DARK)?);
        Ok(Self { name, light, dark })
    }
}

fn svg(
    title: &str,
    height: f64,
    spots: &[Spot],
    theme: &Theme,
    draw: impl Fn(&Canvas<'_>, &Theme) -> Drawn,
) -> Result<String> {
    let size = [WIDTH, height].map(|v| v.ceil() as u32);
    let units = size.map(|v| v * UNITS as u32);
    let mut text = String::new();
    {
        let canvas = Canvas(SVGBackend::with_string(&mut text, units.into()).into_drawing_area());
        let all = [[0.0, 0.0], [WIDTH, height.ceil()]];
        canvas
            .rectangle(all, theme.paper)
            .and_then(|()| canvas.text(&fitting(title, WIDTH - 32.0, 15.0), [16.0, 22.0], HPos::Left, 15.0, theme.ink))
            .and_then(|()| draw(&canvas, theme))
            .and_then(|()| canvas.0.present())
            .map_err(|e| Error::Mesh(format!("cannot draw: {e}")))?;
    }
    // Text keeps its numbers of units; only the size that it is shown at is in pixels.
    let [from, to] = [units, size].map(|[w, h]| format!("width=\"{w}\" height=\"{h}\""));
    let body = text.trim_end().trim_end_matches("</svg>").replacen(&from, &to, 1);
    let label = format!("<svg role=\"group\" aria-label=\"{}\"", words::escape(title));
    Ok(format!("{}{}</svg>\n", body.replacen("<svg", &label, 1), hits(spots)))
}

/// Circles that cannot be seen, with what they tell.
fn hits(spots: &[Spot]) -> String {
    let circle = |Spot { at: [x, y], text }: &Spot| {
        let [x, y, r] = [*x, *y, 9.0].map(|v| (UNITS * v).round());
        let text = words::escape(text);
        format!(
            "<circle class=\"hit\" cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill-opacity=\"0\"><title>{text}</title></circle>\n"
        )
    };
    spots.iter().map(circle).collect()
}

impl Canvas<'_> {
    pub fn path(&self, points: &[[f64; 2]], color: RGBColor, width: f64) -> Drawn {
        let style = ShapeStyle { color: color.to_rgba(), filled: false, stroke_width: (UNITS * width).round() as u32 };
        self.0.draw(&PathElement::new(points.iter().map(|p| units(*p)).collect::<Vec<_>>(), style))
    }

    pub fn polygon(&self, points: &[[f64; 2]], color: RGBColor) -> Drawn {
        self.0.draw(&Polygon::new(points.iter().map(|p| units(*p)).collect::<Vec<_>>(), color.filled()))
    }

    pub fn circle(&self, at: [f64; 2], radius: f64, color: RGBColor) -> Drawn {
        self.0.draw(&Circle::new(units(at), UNITS * radius, color.filled()))
    }

    pub fn rectangle(&self, corners: [[f64; 2]; 2], color: RGBColor) -> Drawn {
        self.0.draw(&Rectangle::new(corners.map(units), color.filled()))
    }

    /// Beside `at`, its middle at that height.
    pub fn text(&self, what: &str, at: [f64; 2], anchor: HPos, height: f64, ink: RGBColor) -> Drawn {
        // What plotters divides by.
        let style = ("system-ui, sans-serif", 1.24 * UNITS * height).into_text_style(&self.0);
        let what = what.chars().map(words::printable).collect::<String>();
        self.0.draw(&Text::new(what, units(at), style.color(&ink).pos(Pos::new(anchor, VPos::Center))))
    }
}

fn units(at: [f64; 2]) -> (i32, i32) {
    let [x, y] = at.map(|v| (UNITS * v).round() as i32);
    (x, y)
}

/// Pixels that text fills along x.
pub(super) fn width_of(text: &str, height: f64) -> f64 {
    CHARACTER * height * text.chars().count() as f64
}

/// `text`, cut to `width` pixels.
pub(super) fn fitting(text: &str, width: f64, height: f64) -> String {
    let most = (width / (CHARACTER * height)) as usize;
    match text.char_indices().nth(most) {
        Some(_) => text.chars().take(most.saturating_sub(1)).chain(['…']).collect(),
        None => text.to_owned(),
    }
}

/// A rectangle with logarithmic axes.
pub(super) struct Frame<'a> {
    /// Left, top, right, bottom.
    pub sides: [f64; 4],
    pub x: &'a LogScale,
    pub y: &'a LogScale,
    pub x_label: &'a str,
    pub y_label: &'a str,
    pub notations: [Notation; 2],
}

impl Frame<'_> {
    pub fn draw(&self, canvas: &Canvas<'_>, theme: &Theme) -> Drawn {
        let [left, top, right, bottom] = self.sides;
        for (x, label) in self.x.ticks(self.notations[0]) {
            canvas.path(&[[x, top], [x, bottom]], theme.grid, 1.0)?;
            canvas.text(&label, [x, bottom + 13.0], HPos::Center, TEXT, theme.faint)?;
        }
        for (y, label) in self.y.ticks(self.notations[1]) {
            canvas.path(&[[left, y], [right, y]], theme.grid, 1.0)?;
            canvas.text(&label, [left - 7.0, y], HPos::Right, TEXT, theme.faint)?;
        }
        canvas.path(&[[left, top], [left, bottom], [right, bottom]], theme.faint, 1.0)?;
        canvas.text(self.x_label, [right, bottom + 31.0], HPos::Right, TEXT, theme.ink)?;
        canvas.text(self.y_label, [16.0, top - 13.0], HPos::Left, TEXT, theme.ink)
    }
}

/// Columns of marks and what they mean.
pub(super) struct Legend(pub Vec<Vec<(Sign, String)>>);

/// What stands before a legend's text.
#[derive(Clone, Copy)]
pub(super) enum Sign {
    /// A method's colour.
    Color(Mark),
    /// A shape alone.
    Shape(Mark),
    Whole(Mark),
    Box(usize),
    Line,
}

impl Legend {
    pub fn height(&self) -> f64 {
        ROW * self.0.iter().map(Vec::len).max().unwrap_or(0) as f64
    }

    /// Below `top`.
    pub fn draw(&self, canvas: &Canvas<'_>, theme: &Theme, top: f64) -> Drawn {
        let width = (WIDTH - 32.0) / self.0.len() as f64;
        let inked = Theme { series: [theme.faint; 8], ..*theme };
        let entries = self.0.iter().enumerate().flat_map(|(c, column)| (0..).zip(column).map(move |(r, e)| (c, r, e)));
        for (column, row, (sign, text)) in entries {
            let at = [24.0 + width * column as f64, top + ROW * (f64::from(row) + 0.5)];
            match *sign {
                Sign::Whole(mark) => mark.draw(canvas, theme, at, 5.0)?,
                Sign::Color(mark) => {
                    Mark { shape: super::marks::Shape::Circle, ..mark }.draw(canvas, theme, at, 6.0)?
                }
                Sign::Shape(mark) => Mark { hollow: false, ..mark }.draw(canvas, &inked, at, 5.0)?,
                Sign::Box(color) => {
                    let corners = [[at[0] - 6.0, at[1] - 6.0], [at[0] + 6.0, at[1] + 6.0]];
                    canvas.rectangle(corners, theme.series[color])?;
                }
                Sign::Line => canvas.path(&[[at[0] - 8.0, at[1]], [at[0] + 8.0, at[1]]], theme.faint, 1.5)?,
            }
            let text = fitting(text, width - 20.0, TEXT);
            canvas.text(&text, [at[0] + 14.0, at[1]], HPos::Left, TEXT, theme.ink)?;
        }
        Ok(())
    }
}
