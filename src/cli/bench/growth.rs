//! Time against cells and against pixels, with the exponents that fit.

use super::chart::{Canvas, Chart, Drawn, Frame, Legend, Sign, Spot, WIDTH};
use super::marks::{Looks, Mark, Theme};
use super::points::{Point, Points, median, rank};
use super::scale::{LogScale, Notation};
use super::{speed, words};
use crate::error::Result;
use crate::report::front::{Growth, different};

/// What time is drawn against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Against {
    /// Of meshes under one scene at one size.
    Tetrahedra,
    /// Of one mesh under one scene.
    Pixels,
}

const LEFT: f64 = 76.0;
const RIGHT: f64 = WIDTH - 18.0;
const TOP: f64 = 66.0;
const BOTTOM: f64 = 340.0;

/// More lines than these nobody follows.
const MOST: usize = 12;

/// One contender.
struct Series<'a> {
    mark: Mark,
    points: Vec<([f64; 2], &'a Point<'a>)>,
    /// Through the medians where several points have one place along x.
    line: Vec<[f64; 2]>,
    text: String,
}

/// The charts, and what has too few sizes for one.
pub(super) fn charts(points: &Points<'_>, looks: &Looks, against: Against) -> Result<(Vec<Chart>, Vec<String>)> {
    let mut sorted: Vec<&Point<'_>> = points.points.iter().collect();
    let shared = |p: &Point<'_>| (against.shared(p), p.group.host);
    // A stable sort: contenders stay in their order.
    sorted.sort_by_key(|p| shared(p));
    let (mut charts, mut left_out) = (Vec::new(), Vec::new());
    for group in sorted.chunk_by(|a, b| shared(a) == shared(b)) {
        let what = against.shared(group[0]);
        let title = format!("{what}{}", points.host_note(group[0].group.host));
        match different(group.iter().map(|p| against.of(p))) {
            count @ ..3 => left_out.push(format!("{title}: {count} of the three sizes that a growth takes")),
            _ => charts.push(chart(&what, title, group, looks, against)?),
        }
    }
    Ok((charts, left_out))
}

impl Against {
    /// What the points of a chart have in common.
    fn shared(self, point: &Point<'_>) -> String {
        match self {
            Self::Tetrahedra => format!("{}, {}", point.group.scene, words::size(point.subject)),
            Self::Pixels => format!("{} · {}", point.group.mesh, point.group.scene),
        }
    }

    fn of(self, point: &Point<'_>) -> f64 {
        match self {
            Self::Tetrahedra => point.subject.tetrahedra as f64,
            Self::Pixels => point.group.size.map(f64::from).iter().product(),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Tetrahedra => "tetrahedra",
            Self::Pixels => "pixels",
        }
    }
}

fn chart(what: &str, title: String, group: &[&Point<'_>], looks: &Looks, against: Against) -> Result<Chart> {
    let series = fewer(series(group, looks, against));
    let all = || series.iter().flat_map(|s| s.points.iter());
    let x = LogScale::new(all().map(|p| p.0[0]), [LEFT, RIGHT]);
    let y = LogScale::new(all().map(|p| p.0[1]), [BOTTOM, TOP]);
    let at = |[a, b]: [f64; 2]| [x.at(a), y.at(b)];
    let spots: Vec<Spot> = all().map(|(p, point)| Spot { at: at(*p), text: speed::told(point) }).collect();
    let entries = series.iter().map(|s| (Sign::Whole(s.mark), s.text.clone())).collect();
    let legend = Legend(vec![entries]);
    let name = format!("{}-{what}", against.name()).replace(" · ", "-").replace(", ", "-").replace('×', "x");
    let draw = |canvas: &Canvas<'_>, theme: &Theme| -> Drawn {
        Frame {
            sides: [LEFT, TOP, RIGHT, BOTTOM],
            x: &x,
            y: &y,
            x_label: against.name(),
            y_label: "milliseconds a frame",
            notations: [Notation::Counts, Notation::Plain],
        }
        .draw(canvas, theme)?;
        for s in &series {
            let line: Vec<_> = s.line.iter().map(|p| at(*p)).collect();
            canvas.path(&line, theme.series[s.mark.color], 1.5)?;
        }
        for (s, p) in series.iter().flat_map(|s| s.points.iter().map(move |(p, _)| (s, p))) {
            s.mark.draw(canvas, theme, at(*p), 5.0)?;
        }
        legend.draw(canvas, theme, BOTTOM + 50.0)
    };
    Chart::new(words::file_name(&name), title, BOTTOM + 58.0 + legend.height(), &spots, draw)
}

fn series<'a>(group: &[&'a Point<'a>], looks: &Looks, against: Against) -> Vec<Series<'a>> {
    let mut sorted = group.to_vec();
    sorted.sort_by_key(|p| (rank(p.by), p.adapter));
    let of = |points: &[&'a Point<'a>]| {
        let by = points[0].by;
        let points: Vec<_> = points.iter().map(|p| ([against.of(p), 1e3 * p.seconds.median], *p)).collect();
        let values: Vec<[f64; 2]> = points.iter().map(|p| p.0).collect();
        let grows = match Growth::new(&values) {
            Some(g) => format!("exponent {:.2} ± {:.2}", g.exponent, g.standard_error),
            None => "too few sizes to fit".into(),
        };
        let text = format!("{grows}: {} {} {}", words::method(by), by.integral, by.order);
        Series { mark: looks.of(by), line: medians(&values), points, text }
    };
    sorted.chunk_by(|a, b| (a.by, a.adapter) == (b.by, b.adapter)).map(of).collect()
}

/// Of each method the contender with the smallest error, where there are too many.
fn fewer(mut series: Vec<Series<'_>>) -> Vec<Series<'_>> {
    if series.len() <= MOST {
        return series;
    }
    let method = |s: &Series<'_>| words::method(s.points[0].1.by);
    let error = |s: &Series<'_>| s.points.iter().map(|(_, p)| p.error.rmse).fold(0.0, f64::max);
    let least = |s: &Series<'_>| {
        let others = series.iter().filter(|other| method(other) == method(s));
        others.min_by(|a, b| error(a).total_cmp(&error(b))).is_some_and(|best| std::ptr::eq(best, s))
    };
    let kept: Vec<bool> = series.iter().map(least).collect();
    let mut kept = kept.into_iter();
    series.retain(|_| kept.next().unwrap_or(false));
    series
}

/// One point a place along x.
fn medians(values: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = values.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let middle = |same: &[[f64; 2]]| Some([same[0][0], median(same.iter().map(|v| v[1]))?]);
    sorted.chunk_by(|a, b| a[0] == b[0]).filter_map(middle).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_goes_through_the_middle() {
        assert_eq!(medians(&[[2.0, 5.0], [1.0, 1.0], [2.0, 7.0], [2.0, 1.0]]), [[1.0, 1.0], [2.0, 5.0]]);
    }
}
