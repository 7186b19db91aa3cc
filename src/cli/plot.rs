//! A frame with two labelled axes, drawn into a picture. Ticks are our own: plotters' search for key points does not end
//! on ranges that are tiny beside their position, and fields have such ranges.

use std::sync::Once;

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::error::{Error, Result};
use crate::image::{Image, linear_from_srgb};
use crate::space::Interval;

/// What plotters draws on.
pub(super) type Area<'a> = DrawingArea<BitMapBackend<'a>, Shift>;

const FONT: &str = "tetralux";
const TEXT_HEIGHT: i32 = 14;

/// A picture of `size` pixels, drawn by `draw`: opaque, linear.
pub(super) fn picture(size: [u32; 2], draw: impl FnOnce(&Area<'_>) -> Drawn) -> Result<Image> {
    static REGISTER: Once = Once::new();
    let mut font = Ok(());
    REGISTER.call_once(|| {
        font = plotters::style::register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT);
    });
    font.map_err(|_| Error::Mesh("the built-in font does not load".into()))?;
    let mut bytes = vec![255_u8; 3 * size[0] as usize * size[1] as usize];
    {
        let area = BitMapBackend::with_buffer(&mut bytes, (size[0], size[1])).into_drawing_area();
        draw(&area).and_then(|()| area.present()).map_err(|e| Error::Mesh(format!("cannot draw: {e}")))?;
    }
    let linear: Vec<f32> = (0..=255).map(|v| linear_from_srgb(f32::from(v as u8) / 255.0)).collect();
    let pixels = bytes.chunks_exact(3).map(|p| {
        let [r, g, b] = [p[0], p[1], p[2]].map(|v| linear[usize::from(v)]);
        [r, g, b, 1.0]
    });
    Ok(Image { width: size[0], height: size[1], pixels: pixels.collect() })
}

/// Result of drawing.
pub(super) type Drawn = Result<(), DrawingAreaErrorKind<<BitMapBackend<'static> as DrawingBackend>::ErrorType>>;

/// Two axes around a rectangle of pixels.
pub(super) struct Axes<'a> {
    /// Left, top, right, bottom of the plot, pixels; the plot is inside.
    pub frame: [i32; 4],
    /// Along x, left to right.
    pub x: Interval,
    /// Along y, bottom to top.
    pub y: Interval,
    /// Below the x axis.
    pub x_label: &'a str,
    /// Above the y axis.
    pub y_label: &'a str,
    /// Of lines and text.
    pub ink: RGBColor,
}

impl Axes<'_> {
    /// Pixels along x and y.
    pub fn size(&self) -> [i32; 2] {
        let [left, top, right, bottom] = self.frame;
        [right - left, bottom - top]
    }

    /// Calls `color` for each pixel's middle, in data units, and paints what it answers.
    pub fn fill(&self, area: &Area<'_>, color: impl Fn(f64, f64) -> Option<RGBColor>) -> Drawn {
        let [width, height] = self.size();
        for row in 0..height {
            let y = self.y.min + self.y.length() * (1.0 - (f64::from(row) + 0.5) / f64::from(height));
            for column in 0..width {
                let x = self.x.min + self.x.length() * (f64::from(column) + 0.5) / f64::from(width);
                if let Some(color) = color(x, y) {
                    area.draw_pixel((self.frame[0] + column, self.frame[1] + row), &color)?;
                }
            }
        }
        Ok(())
    }

    /// The frame, its ticks and its labels.
    pub fn draw(&self, area: &Area<'_>) -> Drawn {
        let [left, top, right, bottom] = self.frame;
        area.draw(&Rectangle::new([(left - 1, top - 1), (right, bottom)], self.ink))?;
        for (value, label) in ticks(self.x, self.size()[0] / 60) {
            let x = left + position(self.x, value, right - left);
            area.draw(&PathElement::new([(x, bottom), (x, bottom + 4)], self.ink))?;
            text(area, &label, (x, bottom + 6), (HPos::Center, VPos::Top), self.ink)?;
        }
        for (value, label) in ticks(self.y, self.size()[1] / 40) {
            let y = bottom - position(self.y, value, bottom - top);
            area.draw(&PathElement::new([(left - 5, y), (left - 1, y)], self.ink))?;
            text(area, &label, (left - 8, y), (HPos::Right, VPos::Center), self.ink)?;
        }
        let below = bottom + 10 + TEXT_HEIGHT;
        text(area, self.x_label, ((left + right) / 2, below), (HPos::Center, VPos::Top), self.ink)?;
        text(area, self.y_label, (left, top - 6), (HPos::Left, VPos::Bottom), self.ink)
    }
}

/// Writes `what` at a pixel.
pub(super) fn text(area: &Area<'_>, what: &str, at: (i32, i32), (h, v): (HPos, VPos), ink: RGBColor) -> Drawn {
    let style = (FONT, TEXT_HEIGHT).into_text_style(area).color(&ink).pos(Pos::new(h, v));
    area.draw(&Text::new(what.to_owned(), at, style))
}

fn position(range: Interval, value: f64, pixels: i32) -> i32 {
    let share = (value - range.min) / range.length();
    if share.is_finite() { (share * f64::from(pixels)).round() as i32 } else { 0 }
}

/// About `count` round values within `range`, two at least, with labels that tell them apart.
fn ticks(range: Interval, count: i32) -> Vec<(f64, String)> {
    let rough = range.length() / f64::from(count.clamp(2, 10));
    let decade = 10_f64.powf(rough.log10().floor());
    let largest = range.min.abs().max(range.max.abs());
    let inside = |step: f64| {
        let first = (range.min / step).ceil();
        let values = (0..30).map(move |i| (first + f64::from(i)) * step);
        values.take_while(|v| *v <= range.max + 1e-9 * step).collect::<Vec<_>>()
    };
    // The coarsest step that is fine enough; finer where it leaves fewer than two.
    let steps = [0.2, 0.5, 1.0, 2.0, 5.0, 10.0].map(|m| m * decade);
    let coarsest = steps.into_iter().find(|step| *step >= rough);
    let fits = |step: &f64| coarsest.is_some_and(|most| *step <= most) && inside(*step).len() >= 2;
    let fitting = steps.into_iter().rev().find(fits);
    let Some(step) = fitting.filter(|s| s.is_finite() && *s > 1e-13 * largest) else {
        let value = range.min;
        return if value.is_finite() { vec![(value, format!("{value}"))] } else { Vec::new() };
    };
    let exact = |v: f64| if v.abs() < 1e-9 * step { 0.0 } else { v };
    inside(step).into_iter().map(|v| (v, label(exact(v), step, largest))).collect()
}

/// `value` with the digits that `step` needs.
fn label(value: f64, step: f64, largest: f64) -> String {
    let decimals = (-step.log10()).ceil().max(0.0) as usize;
    if largest < 1e5 && decimals <= 4 {
        return format!("{value:.decimals$}");
    }
    if value == 0.0 {
        return "0".into();
    }
    let digits = (value.abs().log10().floor() - step.log10().floor()).clamp(0.0, 15.0) as usize;
    format!("{value:.digits$e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(min: f64, max: f64) -> Vec<String> {
        ticks(Interval { min, max }, 5).into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn ticks_are_round() {
        assert_eq!(labels(0.0, 1.0), ["0.0", "0.2", "0.4", "0.6", "0.8", "1.0"]);
        assert_eq!(labels(-3.0, 5.0), ["-2", "0", "2", "4"]);
        let two = ticks(Interval { min: 0.19, max: 4.98 }, 2);
        assert_eq!(two.iter().map(|t| t.1.as_str()).collect::<Vec<_>>(), ["2", "4"]);
        assert_eq!(labels(0.0, 3e7), ["0", "1e7", "2e7", "3e7"]);
        assert_eq!(labels(1e-9, 3e-9), ["1.0e-9", "1.5e-9", "2.0e-9", "2.5e-9", "3.0e-9"]);
    }

    #[test]
    fn odd_ranges_end() {
        for (min, max) in
            [(1.0, 1.0), (1e300, 1.1e300), (1.0, 1.0 + 1e-15), (0.0, 5e-324), (f64::INFINITY, f64::NEG_INFINITY)]
        {
            assert!(labels(min, max).len() <= 30, "{min} {max}");
        }
        assert_eq!(labels(7.5, 7.5), ["7.5"]);
    }
}
