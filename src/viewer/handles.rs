//! Where a widget is taken hold of on the histogram, and what a pull does to it. Nothing here knows a window.

use std::f64::consts::FRAC_PI_2;

use crate::scene::{Widget, WidgetShape, stretch_gaussian};

/// Data units to points of the screen along both axes; y falls as the gradient grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Map {
    /// Data at the plot's lower left corner.
    pub origin: [f64; 2],
    /// Points a data unit, positive.
    pub scale: [f64; 2],
    /// The lower left corner, points.
    pub corner: [f64; 2],
}

impl Map {
    /// Data to points.
    pub fn point(&self, at: [f64; 2]) -> [f64; 2] {
        let [x, y] = [0, 1].map(|i| (at[i] - self.origin[i]) * self.scale[i]);
        [self.corner[0] + x, self.corner[1] - y]
    }

    /// Points to data.
    pub fn data(&self, point: [f64; 2]) -> [f64; 2] {
        let away = [point[0] - self.corner[0], self.corner[1] - point[1]];
        [0, 1].map(|i| self.origin[i] + away[i] / self.scale[i])
    }

    /// Data differences to points, y upwards.
    fn vector(&self, v: [f64; 2]) -> [f64; 2] {
        [v[0] * self.scale[0], v[1] * self.scale[1]]
    }
}

/// What is taken hold of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grip {
    /// The whole widget.
    Body,
    /// The end of a Gaussian's first or second axis, at two standard deviations.
    Axis(usize),
    /// Beyond the first axis.
    Turn,
    /// A corner of a box; bit 0: its right side, bit 1: its upper one.
    Corner(usize),
    /// The next peak of a wave, or the last knot of a ramp.
    Period,
}

/// A place to take hold of, points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// What it does.
    pub grip: Grip,
    /// Where it is.
    pub at: [f64; 2],
}

/// Standard deviations at which a Gaussian's axes end.
pub const REACH: f64 = 2.0;
/// From the end of the first axis to where it is turned, points.
const TURN_AWAY: f64 = 22.0;

/// A Gaussian in points: standard deviations, and the first axis's direction, y upwards.
fn gaussian_on_screen(sigma: [f64; 2], angle: f64, map: &Map) -> ([f64; 2], [[f64; 2]; 2]) {
    let (sigma, angle) = stretch_gaussian(sigma, angle, map.scale);
    let (sin, cos) = angle.sin_cos();
    (sigma, [[cos, sin], [-sin, cos]])
}

/// The handles of a widget; `shown`: what the plot shows, data units, along each axis.
pub fn handles(widget: &Widget, map: &Map, shown: [[f64; 2]; 2]) -> Vec<Handle> {
    let handle = |grip, at| Handle { grip, at };
    match &widget.shape {
        WidgetShape::Gaussian { center, sigma, angle } => {
            let middle = map.point(*center);
            let (sigma, axes) = gaussian_on_screen(*sigma, *angle, map);
            let along = |axis: usize, by: f64| [middle[0] + by * axes[axis][0], middle[1] - by * axes[axis][1]];
            vec![
                handle(Grip::Body, middle),
                handle(Grip::Axis(0), along(0, REACH * sigma[0])),
                handle(Grip::Axis(1), along(1, REACH * sigma[1])),
                handle(Grip::Turn, along(0, REACH * sigma[0] + TURN_AWAY)),
            ]
        }
        WidgetShape::Uniform => {
            let [s, g] = box_of(widget, shown);
            let mut all = vec![handle(Grip::Body, map.point([0.5 * (s[0] + s[1]), 0.5 * (g[0] + g[1])]))];
            all.extend((0..4).map(|c| handle(Grip::Corner(c), map.point([s[c & 1], g[c >> 1]]))));
            all
        }
        shape => {
            let Some((first, step)) = phases(shape) else { return Vec::new() };
            let middle = anchor(widget, shown, map, first);
            let step = step_on_screen(step, map);
            vec![handle(Grip::Body, middle), handle(Grip::Period, [middle[0] + step[0], middle[1] - step[1]])]
        }
    }
}

/// The ranges of a widget, or what is shown.
pub fn box_of(widget: &Widget, shown: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    [widget.scalar_range.unwrap_or(shown[0]), widget.gradient_range.unwrap_or(shown[1])]
}

/// A line of constant `direction . (s, g)`: the direction, and where along it.
#[derive(Clone, Copy)]
struct Level {
    direction: [f64; 2],
    at: f64,
}

/// Of waves and ramps: the line that is held (a peak, the first knot) and the way to the next one along the direction.
fn phases(shape: &WidgetShape) -> Option<(Level, Level)> {
    let pair = |direction, at, by| Some((Level { direction, at }, Level { direction, at: by }));
    match shape {
        WidgetShape::Triangle { direction, offset, period, .. }
        | WidgetShape::Sinusoid { direction, offset, period, .. } => pair(*direction, offset + 0.5 * period, *period),
        WidgetShape::Ramp { direction, knots } => {
            let (first, last) = (knots.first()?[0], knots.last()?[0]);
            pair(*direction, first, last - first)
        }
        _ => None,
    }
}

/// The level's point nearest, on the screen, to the middle of what the widget covers.
fn anchor(widget: &Widget, shown: [[f64; 2]; 2], map: &Map, level: Level) -> [f64; 2] {
    let middle = middle_of(widget, shown, map);
    let away = level.at - dot(level.direction, map.data(middle));
    let step = step_on_screen(Level { at: away, ..level }, map);
    [middle[0] + step[0], middle[1] - step[1]]
}

/// The middle of what a widget covers, points.
fn middle_of(widget: &Widget, shown: [[f64; 2]; 2], map: &Map) -> [f64; 2] {
    let [s, g] = box_of(widget, shown);
    map.point([0.5 * (s[0] + s[1]), 0.5 * (g[0] + g[1])])
}

/// The shortest way on the screen, y upwards, along which `direction . (s, g)` grows by `at`.
fn step_on_screen(level: Level, map: &Map) -> [f64; 2] {
    // Of the level as a function of points, the gradient.
    let rise = [0, 1].map(|i| level.direction[i] / map.scale[i]);
    let square = dot(rise, rise);
    rise.map(|v| v * level.at / square)
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// Pulls `grip` of `widget` to `to`; `by`: from where it was, points. What would make no widget changes nothing.
pub fn pull(widget: &mut Widget, grip: Grip, to: [f64; 2], by: [f64; 2], map: &Map, shown: [[f64; 2]; 2]) {
    let mut next = widget.clone();
    pull_any(&mut next, grip, to, by, map, shown);
    if is_sound(&next) {
        *widget = next;
    }
}

fn pull_any(widget: &mut Widget, grip: Grip, to: [f64; 2], by: [f64; 2], map: &Map, shown: [[f64; 2]; 2]) {
    let shift = [by[0] / map.scale[0], -by[1] / map.scale[1]];
    match (grip, &mut widget.shape) {
        (Grip::Body, _) => move_by(widget, shift),
        (Grip::Axis(_), WidgetShape::Gaussian { center, sigma, angle }) => {
            let middle = map.point(*center);
            let (mut on_screen, axes) = gaussian_on_screen(*sigma, *angle, map);
            let away = [to[0] - middle[0], middle[1] - to[1]];
            // Which axis is the first depends on which is longer; the one that is held lies along the way to it.
            let axis = usize::from(dot(away, axes[1]).abs() > dot(away, axes[0]).abs());
            on_screen[axis] = (dot(away, axes[axis]).abs() / REACH).max(0.5);
            let turn = axes[0][1].atan2(axes[0][0]);
            (*sigma, *angle) = stretch_gaussian(on_screen, turn, map.scale.map(f64::recip));
        }
        (Grip::Turn, WidgetShape::Gaussian { center, sigma, angle }) => {
            let middle = map.point(*center);
            let (on_screen, axes) = gaussian_on_screen(*sigma, *angle, map);
            let angle_of = |at: [f64; 2]| (middle[1] - at[1]).atan2(at[0] - middle[0]);
            let by = angle_of(to) - angle_of([to[0] - by[0], to[1] - by[1]]);
            let turn = axes[0][1].atan2(axes[0][0]) + by;
            (*sigma, *angle) = stretch_gaussian(on_screen, turn, map.scale.map(f64::recip));
        }
        (Grip::Corner(corner), _) => {
            let ([mut s, mut g], at) = (box_of(widget, shown), map.data(to));
            s[corner & 1] = at[0];
            g[corner >> 1] = at[1];
            (widget.scalar_range, widget.gradient_range) = (Some(ordered(s)), Some(ordered(g)));
        }
        (Grip::Period, shape) => {
            let Some((first, step)) = phases(shape) else { return };
            let middle = middle_of(widget, shown, map);
            // The held line and the next one lie so far from the middle, along one way.
            let away = |to: [f64; 2]| [to[0] - middle[0], middle[1] - to[1]];
            let held = away(anchor(widget, shown, map, first));
            let next = step_on_screen(step, map);
            let length = next[0].hypot(next[1]);
            let near = dot(held, next) / length;
            let (toward, side) = (away(to), (near + length).signum());
            let distance = toward[0].hypot(toward[1]);
            let width = side * distance - near;
            if distance < 2.0 || width < 2.0 {
                return;
            }
            let way = toward.map(|v| side * v / distance);
            // Phases grow by 1 over the width.
            let rise = map.vector(way.map(|v| v / width));
            let (rising, at) = (rise[0].hypot(rise[1]), [middle[0] + near * way[0], middle[1] - near * way[1]]);
            let direction = rise.map(|v| v / rising);
            let held = dot(direction, map.data(at));
            set_phases(&mut widget.shape, direction, held, 1.0 / rising);
        }
        _ => {}
    }
}

fn set_phases(shape: &mut WidgetShape, toward: [f64; 2], held: f64, step: f64) {
    match shape {
        WidgetShape::Triangle { direction, offset, period, .. }
        | WidgetShape::Sinusoid { direction, offset, period, .. } => {
            (*direction, *offset, *period) = (toward, held - 0.5 * step, step);
        }
        WidgetShape::Ramp { direction, knots } => {
            if let ([first, ..], [.., last]) = (&knots[..], &knots[..]) {
                let (from, length) = (first[0], last[0] - first[0]);
                *direction = toward;
                knots.iter_mut().for_each(|knot| knot[0] = held + (knot[0] - from) / length * step);
            }
        }
        _ => {}
    }
}

fn ordered([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

fn move_by(widget: &mut Widget, by: [f64; 2]) {
    match &mut widget.shape {
        WidgetShape::Gaussian { center, .. } => *center = [center[0] + by[0], center[1] + by[1]],
        WidgetShape::Triangle { direction, offset, .. } | WidgetShape::Sinusoid { direction, offset, .. } => {
            *offset += dot(*direction, by);
        }
        WidgetShape::Ramp { direction, knots } => {
            let along = dot(*direction, by);
            knots.iter_mut().for_each(|knot| knot[0] += along);
        }
        WidgetShape::Uniform => {}
    }
    let moved = |range: &mut Option<[f64; 2]>, by: f64| *range = range.map(|range| range.map(|v| v + by));
    moved(&mut widget.scalar_range, by[0]);
    moved(&mut widget.gradient_range, by[1]);
}

/// What a scene file takes.
fn is_sound(widget: &Widget) -> bool {
    let finite = |values: &[f64]| values.iter().all(|v| v.is_finite());
    let ranges = [widget.scalar_range, widget.gradient_range];
    ranges.iter().flatten().all(|range| finite(range))
        && match &widget.shape {
            WidgetShape::Uniform => true,
            WidgetShape::Gaussian { center, sigma, angle } => {
                finite(center) && finite(sigma) && sigma.iter().all(|s| *s > 0.0) && angle.is_finite()
            }
            WidgetShape::Triangle { direction, offset, period, .. }
            | WidgetShape::Sinusoid { direction, offset, period, .. } => {
                finite(direction) && finite(&[*offset, *period]) && *period > 0.0
            }
            WidgetShape::Ramp { knots, .. } => {
                knots.iter().all(|knot| finite(knot)) && knots.windows(2).all(|pair| pair[0][0] < pair[1][0])
            }
        }
}

/// The line around where a Gaussian's profile is `exp(-REACH^2 / 2)`, points.
pub fn ellipse(center: [f64; 2], sigma: [f64; 2], angle: f64, map: &Map) -> Vec<[f64; 2]> {
    const SIDES: u32 = 64;
    let middle = map.point(center);
    let (sigma, axes) = gaussian_on_screen(sigma, angle, map);
    (0..SIDES)
        .map(|i| {
            let (sin, cos) = (4.0 * FRAC_PI_2 * f64::from(i) / f64::from(SIDES)).sin_cos();
            let along = [REACH * sigma[0] * cos, REACH * sigma[1] * sin];
            let [x, y] = [0, 1].map(|i| along[0] * axes[0][i] + along[1] * axes[1][i]);
            [middle[0] + x, middle[1] - y]
        })
        .collect()
}

/// Lines where a wave has its peaks, or a ramp its knots, within what is shown, each as two points far outside.
pub fn crests(shape: &WidgetShape, map: &Map, shown: [[f64; 2]; 2]) -> Vec<[[f64; 2]; 2]> {
    const MOST: usize = 200;
    let Some((first, step)) = phases(shape) else { return Vec::new() };
    let corners = [0, 1, 2, 3].map(|c: usize| dot(first.direction, [shown[0][c & 1], shown[1][c >> 1]]));
    let (low, high) = corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &v| (a.min(v), b.max(v)));
    let levels: Vec<f64> = match shape {
        WidgetShape::Ramp { knots, .. } => {
            knots.iter().map(|knot| knot[0]).filter(|u| (low..=high).contains(u)).collect()
        }
        _ => {
            let from = ((low - first.at) / step.at).ceil();
            let count = ((high - first.at) / step.at - from).floor();
            // Too many to be told apart are none.
            let count = if (0.0..MOST as f64).contains(&count) { count as usize + 1 } else { 0 };
            (0..count).map(|i| first.at + (from + i as f64) * step.at).collect()
        }
    };
    let middle = [0, 1].map(|axis| 0.5 * (shown[axis][0] + shown[axis][1]));
    let line = |level: f64| {
        let away = level - dot(first.direction, middle);
        let step = step_on_screen(Level { direction: first.direction, at: away }, map);
        let at = map.point(middle);
        let at = [at[0] + step[0], at[1] - step[1]];
        let rise = [0, 1].map(|i| first.direction[i] / map.scale[i]);
        let length = rise[0].hypot(rise[1]);
        let along = [rise[1] / length, rise[0] / length];
        [-1.0, 1.0].map(|side| [at[0] + side * 1e4 * along[0], at[1] + side * 1e4 * along[1]])
    };
    levels.into_iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAP: Map = Map { origin: [2.0, 0.0], scale: [100.0, 0.01], corner: [50.0, 400.0] };
    const SHOWN: [[f64; 2]; 2] = [[2.0, 6.0], [0.0, 3e4]];

    fn gaussian(angle: f64) -> Widget {
        let shape = WidgetShape::Gaussian { center: [4.0, 1e4], sigma: [0.3, 2e3], angle };
        Widget::new(shape, [1.0; 3], 1.0)
    }

    fn place(widget: &Widget, grip: Grip) -> [f64; 2] {
        handles(widget, &MAP, SHOWN).into_iter().find(|h| h.grip == grip).expect("a handle").at
    }

    fn close(a: [f64; 2], b: [f64; 2]) -> bool {
        (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-6
    }

    #[test]
    fn a_map_goes_both_ways() {
        assert_eq!(MAP.point([3.0, 1e4]), [150.0, 300.0]);
        assert!(close(MAP.data([150.0, 300.0]), [3.0, 1e4]));
    }

    #[test]
    fn what_is_pulled_comes_along() {
        let wave = WidgetShape::Sinusoid {
            direction: [0.6, 0.8],
            offset: 1.0,
            period: 700.0,
            variant: crate::scene::SinusoidVariant::Cos,
        };
        let ramp = WidgetShape::Ramp { direction: [1.0, 0.0], knots: vec![[3.0, 0.0], [3.5, 1.0], [5.0, 0.0]] };
        let uniform = Widget { scalar_range: Some([3.0, 4.0]), ..Widget::new(WidgetShape::Uniform, [1.0; 3], 1.0) };
        let cases = [
            (gaussian(0.0), vec![Grip::Body, Grip::Axis(0), Grip::Axis(1)]),
            (gaussian(1e-4), vec![Grip::Body]),
            (uniform, vec![Grip::Corner(0), Grip::Corner(3)]),
            (Widget::new(wave, [1.0; 3], 1.0), vec![Grip::Period]),
            (Widget::new(ramp, [1.0; 3], 1.0), vec![Grip::Period]),
        ];
        for (widget, grips) in cases {
            for grip in grips {
                let mut pulled = widget.clone();
                let from = place(&widget, grip);
                // Along an axis it does not leave that.
                let by = match grip {
                    Grip::Axis(0) => [13.0, 0.0],
                    Grip::Axis(_) => [0.0, -9.0],
                    _ => [13.0, -9.0],
                };
                let to = [from[0] + by[0], from[1] + by[1]];
                pull(&mut pulled, grip, to, by, &MAP, SHOWN);
                assert_ne!(pulled, widget, "{grip:?}");
                assert!(close(place(&pulled, grip), to), "{grip:?}: {:?}, not {to:?}", place(&pulled, grip));
            }
        }
    }

    #[test]
    fn a_turn_keeps_the_widths_on_the_screen() {
        let mut widget = gaussian(0.0);
        let middle = place(&widget, Grip::Body);
        let away = |w: &Widget, axis| {
            let at = place(w, Grip::Axis(axis));
            [at[0] - middle[0], middle[1] - at[1]]
        };
        let lengths = |w: &Widget| {
            let mut lengths = [0, 1].map(|axis| away(w, axis)[0].hypot(away(w, axis)[1]));
            lengths.sort_by(f64::total_cmp);
            lengths
        };
        let before = lengths(&widget);
        // In small steps, as a pointer goes, from the right to above.
        let at = |turn: f64| [middle[0] + 80.0 * turn.cos(), middle[1] - 80.0 * turn.sin()];
        for i in 1..=30_i32 {
            let [from, to] = [i - 1, i].map(|i| at(f64::from(i) * 0.5 * FRAC_PI_2 / 30.0));
            pull(&mut widget, Grip::Turn, to, [to[0] - from[0], to[1] - from[1]], &MAP, SHOWN);
        }
        assert!(close(lengths(&widget), before), "{:?}, not {before:?}", lengths(&widget));
        let [x, y] = away(&widget, 0);
        assert!((x.abs() - y.abs()).abs() < 1e-6, "an eighth of a turn: {x}, {y}");
    }

    #[test]
    fn what_would_be_no_widget_is_left() {
        let mut widget = gaussian(0.0);
        let before = widget.clone();
        pull(&mut widget, Grip::Body, [0.0; 2], [f64::NAN, 0.0], &MAP, SHOWN);
        assert_eq!(widget, before);
        // An axis is never pulled to nothing.
        pull(&mut widget, Grip::Axis(0), place(&before, Grip::Body), [0.0; 2], &MAP, SHOWN);
        let WidgetShape::Gaussian { sigma, .. } = widget.shape else { panic!("it stays a Gaussian") };
        assert!(sigma[0] > 0.0);
    }

    #[test]
    fn crests_are_where_the_profile_peaks() {
        let shape = WidgetShape::Triangle { direction: [1.0, 1e-4], offset: 0.1, period: 0.8, duty: 1.0 };
        let lines = crests(&shape, &MAP, SHOWN);
        assert!((5..12).contains(&lines.len()), "{}", lines.len());
        for [a, b] in lines {
            for share in [0.45, 0.5, 0.55] {
                let [s, g] = MAP.data([0, 1].map(|i| a[i] + share * (b[i] - a[i])));
                assert!((shape.profile(s, g) - 1.0).abs() < 1e-6, "{s}, {g}");
            }
        }
        let many = WidgetShape::Triangle { direction: [1.0, 0.0], offset: 0.0, period: 1e-9, duty: 1.0 };
        assert!(crests(&many, &MAP, SHOWN).is_empty());
    }
}
