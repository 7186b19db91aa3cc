//! Error against time: one chart a mesh, scene and size, with the contenders that no other beats.

use plotters::style::text_anchor::HPos;

use super::chart::{Canvas, Chart, Drawn, Frame, Legend, Sign, Spot, TEXT, WIDTH, width_of};
use super::marks::{Looks, Theme};
use super::points::{Point, Points};
use super::scale::{LogScale, Notation};
use super::words;
use crate::error::Result;
use crate::report::front::front;

const LEFT: f64 = 76.0;
const RIGHT: f64 = WIDTH - 18.0;
const TOP: f64 = 66.0;
const BOTTOM: f64 = 400.0;
/// Of the line of pictures that equal the reference, which a logarithm has no place for.
const ZERO: f64 = BOTTOM - 14.0;
/// For labels: nothing but them lies before the front.
const ROOM: f64 = 110.0;
/// The smallest label.
const SMALL: f64 = 11.5;

/// All charts, in the order of groups.
pub(super) fn charts(points: &Points<'_>, looks: &Looks) -> Result<Vec<Chart>> {
    points.groups().map(|group| chart(points, group, looks)).collect()
}

fn chart(points: &Points<'_>, group: &[Point<'_>], looks: &Looks) -> Result<Chart> {
    let plot = Plot::new(group);
    let legend = legend(group, looks);
    let subject = group[0].subject;
    let note = points.host_note(group[0].group.host);
    let title = format!("{} · {}, {}{note}", subject.mesh, subject.scene, words::size(subject));
    let [width, height] = subject.size;
    let name = format!("speed-{}-{}-{width}x{height}", subject.mesh, subject.scene);
    let spots: Vec<Spot> = group.iter().zip(&plot.at).map(|(point, at)| Spot { at: *at, text: told(point) }).collect();
    let top = BOTTOM + 50.0;
    Chart::new(words::file_name(&name), title, top + legend.height() + 8.0, &spots, |canvas, theme| {
        plot.draw(canvas, theme, group, looks)?;
        legend.draw(canvas, theme, top)
    })
}

/// What a point tells: `name: value` on each line but the first.
pub(super) fn told(point: &Point<'_>) -> String {
    let Point { subject, by, seconds, error, .. } = point;
    let [median, min, max] = [seconds.median, seconds.min, seconds.max].map(words::milliseconds);
    let mut lines = vec![
        words::method(by),
        format!("integral: {}", by.integral),
        format!("order: {}", by.order),
        format!("mesh: {}, {} tetrahedra", subject.mesh, words::grouped(subject.tetrahedra)),
        format!("scene: {}, {}", subject.scene, words::size(subject)),
        format!("views: {}, {} frames", point.views, seconds.frames),
        format!("time: {median} ms ({min} to {max})"),
        format!("RMSE: {}", words::short(error.rmse)),
        format!("PSNR: {}", error.psnr.map_or("equal to the reference".into(), |p| format!("{p:.1} dB"))),
        format!("maximum: {}", words::short(error.max)),
        format!("99.9 %: {}", words::short(error.percentile_99_9)),
    ];
    lines.extend(point.bytes.map(|b| format!("memory: {}", words::bytes(b))));
    lines.push(format!("adapter: {}", point.adapter));
    lines.join("\n")
}

/// Where everything lies.
struct Plot {
    x: LogScale,
    y: LogScale,
    has_zero: bool,
    at: Vec<[f64; 2]>,
    front: Vec<usize>,
}

impl Plot {
    fn new(group: &[Point<'_>]) -> Self {
        let values: Vec<[f64; 2]> = group.iter().map(|p| [1e3 * p.seconds.median, p.error.rmse]).collect();
        let has_zero = values.iter().any(|v| v[1] <= 0.0);
        let x = LogScale::new(values.iter().map(|v| v[0]), [LEFT, RIGHT]).with_room_before(ROOM);
        let y = LogScale::new(values.iter().map(|v| v[1]), [if has_zero { ZERO - 22.0 } else { BOTTOM }, TOP]);
        let at = values.iter().map(|v| [x.at(v[0]), if v[1] > 0.0 { y.at(v[1]) } else { ZERO }]).collect();
        Self { has_zero, at, front: front(&values), x, y }
    }

    fn draw(&self, canvas: &Canvas<'_>, theme: &Theme, group: &[Point<'_>], looks: &Looks) -> Drawn {
        Frame {
            sides: [LEFT, TOP, RIGHT, BOTTOM],
            x: &self.x,
            y: &self.y,
            x_label: "milliseconds a frame",
            y_label: "RMSE of the worst view, linear",
            notations: [Notation::Plain, Notation::Powers],
        }
        .draw(canvas, theme)?;
        if self.has_zero {
            canvas.path(&[[LEFT, ZERO], [RIGHT, ZERO]], theme.grid, 1.0)?;
            canvas.text("0, equal", [LEFT - 7.0, ZERO], HPos::Right, TEXT, theme.faint)?;
        }
        canvas.path(&self.steps(), theme.faint, 1.5)?;
        for (point, at) in group.iter().zip(&self.at) {
            looks.of(point.by).draw(canvas, theme, *at, 6.0)?;
        }
        for (at, anchor, text) in self.labels(group) {
            canvas.text(&text, at, anchor, SMALL, theme.ink)?;
        }
        Ok(())
    }

    /// The front as a stair: above and right of it all is beaten.
    fn steps(&self) -> Vec<[f64; 2]> {
        let mut steps = Vec::new();
        let mut height = TOP;
        for [x, y] in self.front.iter().map(|&i| self.at[i]) {
            steps.extend([[x, height], [x, y]]);
            height = y;
        }
        steps.push([RIGHT, height]);
        steps
    }

    /// Of the points of the front, where there is room.
    fn labels(&self, group: &[Point<'_>]) -> Vec<([f64; 2], HPos, String)> {
        let mut taken: Vec<[f64; 4]> = self.at.iter().map(|[x, y]| [x - 7.0, y - 7.0, x + 7.0, y + 7.0]).collect();
        let mut labels = Vec::new();
        for &i in &self.front {
            let [x, y] = self.at[i];
            let text = match group[i].error.psnr {
                Some(psnr) => format!("{} {psnr:.0} dB", group[i].by.integral),
                None => group[i].by.integral.clone(),
            };
            let width = width_of(&text, SMALL);
            let before = [8.0, 2.0, 14.0, -5.0].map(|dy| ([x - 10.0, y + dy], HPos::Right));
            let after = [-9.0, 10.0].map(|dy| ([x + 10.0, y + dy], HPos::Left));
            for ([x, y], anchor) in before.into_iter().chain(after) {
                let left = if matches!(anchor, HPos::Right) { x - width } else { x };
                let place = [left, y - 7.0, left + width, y + 7.0];
                let inside = place[0] > LEFT && place[2] < RIGHT && place[1] > TOP && place[3] < BOTTOM;
                if inside && !taken.iter().any(|other| overlap(other, &place)) {
                    taken.push(place);
                    labels.push(([x, y], anchor, text));
                    break;
                }
            }
        }
        labels
    }
}

fn overlap(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// Methods, and beside them integrals and the front.
fn legend(group: &[Point<'_>], looks: &Looks) -> Legend {
    let mut columns: [Vec<(Sign, String)>; 2] = [Vec::new(), Vec::new()];
    for point in group {
        let mark = looks.of(point.by);
        let texts = [words::method(point.by), words::integral(point.by).to_owned()];
        for ((column, sign), text) in columns.iter_mut().zip([Sign::Color(mark), Sign::Shape(mark)]).zip(texts) {
            if !column.iter().any(|(_, known)| *known == text) {
                column.push((sign, text));
            }
        }
    }
    columns[1].push((Sign::Line, "not beaten in both".into()));
    Legend(columns.into())
}
