//! The histogram as a picture, and axes beside it.

use eframe::egui::{Align2, Color32, ColorImage, FontId, Painter, Pos2, Rect, Stroke, pos2, vec2};

use super::handles::Map;
use crate::tet::JointHistogram;

/// Decades of the largest bin that are told apart.
const DECADES: f64 = 6.0;

/// The largest volume a bin.
pub fn most(histogram: &JointHistogram) -> f64 {
    histogram.counts.iter().copied().fold(f64::MIN_POSITIVE, f64::max)
}

/// Volume a bin, on a logarithmic scale that ends at `most`; row 0 is the highest gradient.
pub fn image(histogram: &JointHistogram, most: f64, is_dark: bool) -> ColorImage {
    let [width, height] = histogram.bins;
    let color = |volume: f64| {
        let share = (1.0 + (volume / most).log10() / DECADES).clamp(0.0, 1.0) as f32;
        let share = if volume > 0.0 { 0.12 + 0.88 * share } else { 0.0 };
        let gray = if is_dark { 24.0 + 190.0 * share } else { 250.0 - 205.0 * share };
        Color32::from_gray(gray as u8)
    };
    let rows = (0..height).rev().flat_map(|j| histogram.counts[j * width..(j + 1) * width].iter());
    ColorImage::new([width, height], rows.map(|&volume| color(volume)).collect())
}

/// From the lowest gradient to where all but a ten-thousandth of the volume lies, of all scalars: single steep cells would
/// leave the rest a line.
pub fn where_volume_is(histogram: &JointHistogram, all: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let ([width, height], total) = (histogram.bins, histogram.total());
    let mut below = 0.0;
    let is_low = |j: &usize| {
        below += histogram.counts[j * width..(j + 1) * width].iter().sum::<f64>();
        below < 0.9999 * total
    };
    let rows = (0..height).take_while(is_low).count() + 1;
    let share = (1.15 * rows as f64 / height as f64).min(1.0);
    [all[0], [all[1][0], all[1][0] + share * (all[1][1] - all[1][0])]]
}

/// The map of a plot that shows this in a rectangle.
pub fn map(rect: Rect, shown: [[f64; 2]; 2]) -> Map {
    let points = [f64::from(rect.width()), f64::from(rect.height())];
    Map {
        origin: [shown[0][0], shown[1][0]],
        scale: [0, 1].map(|axis| points[axis] / (shown[axis][1] - shown[axis][0]).max(f64::MIN_POSITIVE)),
        corner: [rect.left().into(), rect.bottom().into()],
    }
}

/// Points as egui has them.
pub fn to_pos(point: [f64; 2]) -> Pos2 {
    pos2(point[0] as f32, point[1] as f32)
}

/// Ticks of a plot of this size, along each axis.
fn counts(rect: Rect) -> [f64; 2] {
    [f64::from(rect.width()) / 70.0, f64::from(rect.height()) / 40.0]
}

/// The place nearest to a point (of the screen) at which both axes have a tick, or half of one.
pub fn snapped(point: [f64; 2], rect: Rect, shown: [[f64; 2]; 2]) -> [f64; 2] {
    let (map, counts) = (map(rect, shown), counts(rect));
    let data = map.data(point);
    map.point([0, 1].map(|axis| match step(shown[axis][0], shown[axis][1], counts[axis]) {
        Some(step) => (2.0 * data[axis] / step).round() * step / 2.0,
        None => data[axis],
    }))
}

/// A round number, about so many of which fill a range.
fn step(low: f64, high: f64, count: f64) -> Option<f64> {
    let rough = (high - low) / count;
    if !(rough > 0.0 && rough.is_finite()) {
        return None;
    }
    let power = 10f64.powf(rough.log10().floor());
    Some([1.0, 2.0, 5.0, 10.0].map(|m| m * power).into_iter().find(|&s| s >= rough).unwrap_or(10.0 * power))
}

/// Round numbers within a range, about so many.
pub fn ticks(low: f64, high: f64, count: f64) -> Vec<f64> {
    let Some(step) = step(low, high, count) else { return Vec::new() };
    let first = (low / step).ceil();
    let steps = ((high / step).floor() - first).clamp(-1.0, 100.0) as i64;
    (0..=steps).map(|i| (first + i as f64) * step).collect()
}

/// A number as short as an axis has room for.
pub fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".into();
    }
    let size = value.abs();
    if (1e-3..1e5).contains(&size) {
        let digits = (3 - size.log10().floor() as i32).clamp(0, 6) as usize;
        let text = format!("{value:.digits$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{value:.2e}")
    }
}

/// Names and numbers along both axes, inside the plot's margins.
pub fn axes(painter: &Painter, rect: Rect, shown: [[f64; 2]; 2], names: [&str; 2], ink: Color32) {
    let map = map(rect, shown);
    let font = FontId::proportional(10.5);
    let stroke = Stroke::new(1.0, ink);
    painter.rect_stroke(rect, 0.0, stroke, eframe::egui::StrokeKind::Outside);
    let counts = counts(rect);
    for s in ticks(shown[0][0], shown[0][1], counts[0]) {
        let at = to_pos(map.point([s, shown[1][0]]));
        painter.line_segment([at, at + vec2(0.0, 4.0)], stroke);
        painter.text(at + vec2(0.0, 5.0), Align2::CENTER_TOP, short(s), font.clone(), ink);
    }
    for g in ticks(shown[1][0], shown[1][1], counts[1]) {
        let at = to_pos(map.point([shown[0][0], g]));
        painter.line_segment([at, at - vec2(4.0, 0.0)], stroke);
        painter.text(at - vec2(5.0, 0.0), Align2::RIGHT_CENTER, short(g), font.clone(), ink);
    }
    painter.text(rect.right_bottom() + vec2(0.0, 18.0), Align2::RIGHT_TOP, names[0], font.clone(), ink);
    painter.text(rect.left_top() - vec2(0.0, 3.0), Align2::LEFT_BOTTOM, names[1], font, ink);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within() {
        assert_eq!(ticks(0.0, 10.0, 5.0), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(ticks(-0.3, 0.35, 3.0), [0.0]);
        assert_eq!(ticks(1.0, 1.0, 5.0), [0.0; 0]);
        assert_eq!(ticks(0.0, f64::INFINITY, 5.0), [0.0; 0]);
        assert!(ticks(4.2e5, 4.3e5, 4.0).iter().all(|t| (4.2e5..=4.3e5).contains(t)));
    }

    #[test]
    fn places_snap_to_ticks_or_halves() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(350.0, 200.0));
        let shown = [[0.0, 10.0], [0.0, 1.0]];
        let map = map(rect, shown);
        let got = map.data(snapped(map.point([3.4, 0.37]), rect, shown));
        assert!((got[0] - 3.0).abs() < 1e-9 && (got[1] - 0.4).abs() < 1e-9, "{got:?}");
    }

    #[test]
    fn numbers_are_short() {
        let texts = [0.0, 0.25, 1.0, -12.5, 123.0, 99_999.0, 1e6, 1.5e-7].map(short);
        assert_eq!(texts, ["0", "0.25", "1", "-12.5", "123", "99999", "1.00e6", "1.50e-7"]);
    }
}
