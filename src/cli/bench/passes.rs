//! What share of a frame each pass takes: a bar a contender.

use plotters::style::text_anchor::HPos;

use super::chart::{Canvas, Chart, Drawn, Legend, ROW, Sign, Spot, TEXT, WIDTH, fitting, width_of};
use super::marks::Theme;
use super::points::{Point, Points};
use super::words;
use crate::error::Result;

const LEFT: f64 = 16.0;
const RIGHT: f64 = WIDTH - 18.0;
const TOP: f64 = 42.0;
/// The contender's name, then its bar.
const BAR: f64 = 46.0;
/// Passes with a colour of their own; the last colour is for the rest.
const COLORS: usize = 7;

/// One chart a group in which passes were timed.
pub(super) fn charts(points: &Points<'_>) -> Result<Vec<Chart>> {
    let names = largest(&points.points);
    let timed = |group: &[Point<'_>]| group.iter().any(|p| total(p) > 0.0);
    points.groups().filter(|group| timed(group)).map(|group| chart(points, group, &names)).collect()
}

fn total(point: &Point<'_>) -> f64 {
    point.passes.iter().map(|(_, seconds)| seconds).sum()
}

/// The passes that take the largest shares, summed over all contenders.
fn largest<'a>(points: &[Point<'a>]) -> Vec<&'a str> {
    let mut shares: Vec<(&str, f64)> = Vec::new();
    for point in points.iter().filter(|p| total(p) > 0.0) {
        for (name, seconds) in &point.passes {
            match shares.iter_mut().find(|(known, _)| known == name) {
                Some((_, share)) => *share += seconds / total(point),
                None => shares.push((name, seconds / total(point))),
            }
        }
    }
    shares.sort_by(|a, b| b.1.total_cmp(&a.1));
    shares.into_iter().take(COLORS).map(|(name, _)| name).collect()
}

fn chart(points: &Points<'_>, group: &[Point<'_>], names: &[&str]) -> Result<Chart> {
    let bars: Vec<&Point<'_>> = group.iter().filter(|p| total(p) > 0.0).collect();
    let color = |pass: &str| names.iter().position(|n| *n == pass).unwrap_or(COLORS);
    let mut entries: Vec<(Sign, String)> = Vec::new();
    let used = |c: usize| bars.iter().any(|p| p.passes.iter().any(|(name, _)| color(name) == c));
    for c in (0..=COLORS).filter(|c| used(*c)) {
        entries.push((Sign::Box(c), names.get(c).map_or("other passes".into(), |n| (*n).to_owned())));
    }
    let rows = entries.len().div_ceil(3).max(1);
    let legend = Legend(entries.chunks(rows).map(<[_]>::to_vec).collect());
    let subject = group[0].subject;
    let [width, height] = subject.size;
    let host = group[0].group.host;
    let title = format!("{} · {}, {}{}", subject.mesh, subject.scene, words::size(subject), points.host_note(host));
    let name = format!("passes-{}-{}-{width}x{height}", subject.mesh, subject.scene);
    let bottom = TOP + BAR * bars.len() as f64;
    let spots: Vec<Spot> = bars.iter().enumerate().flat_map(|(row, point)| spots(point, row)).collect();
    Chart::new(words::file_name(&name), title, bottom + legend.height() + 16.0, &spots, |canvas, theme| {
        for (row, point) in bars.iter().enumerate() {
            bar(canvas, theme, point, row, color)?;
        }
        legend.draw(canvas, theme, bottom + 8.0)
    })
}

/// Left and right of each pass.
fn pieces<'a>(point: &'a Point<'a>) -> impl Iterator<Item = (&'a str, f64, [f64; 2])> {
    let total = total(point);
    let mut from = LEFT;
    point.passes.iter().map(move |(name, seconds)| {
        let left = from;
        from += (RIGHT - LEFT) * seconds / total;
        (*name, *seconds, [left, from])
    })
}

fn spots(point: &Point<'_>, row: usize) -> Vec<Spot> {
    let all = total(point);
    let spot = |(name, seconds, [left, right]): (&str, f64, [f64; 2])| Spot {
        at: [0.5 * (left + right), TOP + BAR * row as f64 + 29.0],
        text: format!(
            "{name}\nshare: {:.1} %\ntime: {} ms\nof: {}",
            100.0 * seconds / all,
            words::milliseconds(seconds / point.views as f64),
            words::method(point.by)
        ),
    };
    pieces(point).filter(|(_, _, [left, right])| right - left >= 2.0).map(spot).collect()
}

fn bar(canvas: &Canvas<'_>, theme: &Theme, point: &Point<'_>, row: usize, color: impl Fn(&str) -> usize) -> Drawn {
    let top = TOP + BAR * row as f64;
    let time = format!("{} ms in passes", words::milliseconds(total(point) / point.views as f64));
    let by = point.by;
    let who = format!("{} {} {}", words::method(by), by.integral, by.order);
    let who = fitting(&who, RIGHT - LEFT - width_of(&time, TEXT) - 10.0, TEXT);
    canvas.text(&who, [LEFT, top + 10.0], HPos::Left, TEXT, theme.ink)?;
    canvas.text(&time, [RIGHT, top + 10.0], HPos::Right, TEXT, theme.faint)?;
    for (name, _, [left, right]) in pieces(point) {
        let corners = [[left, top + 20.0], [(right - 1.0).max(left), top + 20.0 + ROW]];
        canvas.rectangle(corners, theme.series[color(name)])?;
        if width_of(name, TEXT) + 8.0 < right - left {
            canvas.text(name, [left + 5.0, top + 20.0 + ROW / 2.0], HPos::Left, TEXT, theme.paper)?;
        }
    }
    Ok(())
}
