//! What points look like: a colour a method, a shape an integral.

use plotters::style::RGBColor;

use super::chart::{Canvas, Drawn};
use super::points::{Point, rank};
use super::words;
use crate::report::record::Contender;

/// A chart's colours. Tests hold them to a contrast of 3 to 1 with the paper.
#[derive(Debug)]
pub(super) struct Theme {
    pub name: &'static str,
    pub paper: RGBColor,
    pub ink: RGBColor,
    /// Of less important text and lines.
    pub faint: RGBColor,
    pub grid: RGBColor,
    /// Told apart by colour-blind eyes as well as can be: they differ in lightness too.
    pub series: [RGBColor; 8],
}

/// On white paper; after Okabe and Ito, darkened.
pub(super) const LIGHT: Theme = Theme {
    name: "light",
    paper: RGBColor(0xFF, 0xFF, 0xFF),
    ink: RGBColor(0x1C, 0x21, 0x28),
    faint: RGBColor(0x5B, 0x65, 0x70),
    grid: RGBColor(0xE3, 0xE6, 0xEA),
    series: [
        RGBColor(0x00, 0x5F, 0xA8),
        RGBColor(0xD5, 0x5E, 0x00),
        RGBColor(0x00, 0x8F, 0x68),
        RGBColor(0xB4, 0x4F, 0x97),
        RGBColor(0x2B, 0x91, 0xCB),
        RGBColor(0x6E, 0x15, 0x3A),
        RGBColor(0xA5, 0x83, 0x00),
        RGBColor(0x6A, 0x70, 0x78),
    ],
};

/// The same on dark paper, lightened.
pub(super) const DARK: Theme = Theme {
    name: "dark",
    paper: RGBColor(0x16, 0x1B, 0x22),
    ink: RGBColor(0xE6, 0xEA, 0xEF),
    faint: RGBColor(0x9B, 0xA5, 0xB1),
    grid: RGBColor(0x2D, 0x34, 0x3D),
    series: [
        RGBColor(0x3F, 0x8E, 0xE0),
        RGBColor(0xFF, 0x8B, 0x3D),
        RGBColor(0x1F, 0xC7, 0x9A),
        RGBColor(0xE0, 0x8A, 0xC8),
        RGBColor(0x8F, 0xD3, 0xFF),
        RGBColor(0xD2, 0x4A, 0x74),
        RGBColor(0xF3, 0xD2, 0x4B),
        RGBColor(0x8D, 0x94, 0x9D),
    ],
};

/// A point's look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Mark {
    pub shape: Shape,
    /// Of [`Theme::series`].
    pub color: usize,
    /// The ninth method and those after it are drawn hollow.
    pub hollow: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Circle,
    Square,
    Up,
    Diamond,
    Down,
    Plus,
    Star,
    Cross,
    Left,
    Right,
    Hourglass,
    Hexagon,
}

const SHAPES: [Shape; 12] = {
    use Shape::*;
    [Circle, Square, Up, Diamond, Down, Plus, Star, Cross, Left, Right, Hourglass, Hexagon]
};

/// Who has which look: the same in every chart of a page.
#[derive(Debug)]
pub(super) struct Looks {
    methods: Vec<String>,
    integrals: Vec<String>,
}

impl Looks {
    pub fn new(points: &[Point<'_>]) -> Self {
        let mut contenders: Vec<&Contender> = points.iter().map(|p| p.by).collect();
        contenders.sort_by_key(|by| rank(by));
        let (mut methods, mut integrals) = (Vec::new(), Vec::new());
        for by in contenders {
            let (method, integral) = (words::method(by), words::integral(by).to_owned());
            if !methods.contains(&method) {
                methods.push(method);
            }
            if !integrals.contains(&integral) {
                integrals.push(integral);
            }
        }
        Self { methods, integrals }
    }

    pub fn of(&self, by: &Contender) -> Mark {
        let place = |list: &[String], name: &str| list.iter().position(|n| n == name).unwrap_or(0);
        let method = place(&self.methods, &words::method(by));
        Mark {
            shape: SHAPES[place(&self.integrals, words::integral(by)) % SHAPES.len()],
            color: method % LIGHT.series.len(),
            hollow: (method / LIGHT.series.len()) % 2 == 1,
        }
    }
}

impl Mark {
    /// Around `at`, with a rim of paper that parts it from what it covers.
    pub fn draw(self, canvas: &Canvas<'_>, theme: &Theme, at: [f64; 2], radius: f64) -> Drawn {
        self.shape.draw(canvas, at, radius + 1.5, theme.paper)?;
        self.shape.draw(canvas, at, radius, theme.series[self.color])?;
        if self.hollow { self.shape.draw(canvas, at, 0.55 * radius, theme.paper) } else { Ok(()) }
    }
}

impl Shape {
    fn draw(self, canvas: &Canvas<'_>, at: [f64; 2], radius: f64, color: RGBColor) -> Drawn {
        let corners = self.corners();
        if corners.is_empty() {
            return canvas.circle(at, 0.9 * radius, color);
        }
        let place = |[x, y]: [f64; 2]| [at[0] + radius * x, at[1] + radius * y];
        canvas.polygon(&corners.into_iter().map(place).collect::<Vec<_>>(), color)
    }

    /// Of a polygon about as large as the unit circle, y down; none of a circle.
    fn corners(self) -> Vec<[f64; 2]> {
        let turned = |corners: Vec<[f64; 2]>, degrees: f64| {
            let (s, c) = degrees.to_radians().sin_cos();
            corners.into_iter().map(|[x, y]| [c * x - s * y, s * x + c * y]).collect()
        };
        let around = |count: u32, radius: fn(u32) -> f64| -> Vec<[f64; 2]> {
            let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(count);
            (0..count).map(|i| [radius(i) * angle(i).sin(), -radius(i) * angle(i).cos()]).collect()
        };
        let plus = || {
            let (a, b) = (0.36, 1.05);
            let quarter = [[-a, -a], [-a, -b], [a, -b]];
            (0..4).flat_map(|i| turned(quarter.to_vec(), 90.0 * f64::from(i))).collect::<Vec<_>>()
        };
        let triangle = || around(3, |_| 1.15);
        match self {
            Self::Circle => Vec::new(),
            Self::Square => turned(around(4, |_| 1.15), 45.0),
            Self::Diamond => around(4, |_| 1.2),
            Self::Up => triangle(),
            Self::Right => turned(triangle(), 90.0),
            Self::Down => turned(triangle(), 180.0),
            Self::Left => turned(triangle(), 270.0),
            Self::Plus => plus(),
            Self::Cross => turned(plus(), 45.0),
            Self::Star => around(10, |i| if i % 2 == 0 { 1.3 } else { 0.55 }),
            Self::Hexagon => around(6, |_| 1.05),
            Self::Hourglass => vec![[-0.9, -0.95], [0.9, -0.95], [-0.9, 0.95], [0.9, 0.95]],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::linear_from_srgb;

    /// As WCAG defines it.
    fn contrast(a: RGBColor, b: RGBColor) -> f32 {
        let luminance = |RGBColor(r, g, b): RGBColor| {
            let [r, g, b] = [r, g, b].map(|v| linear_from_srgb(f32::from(v) / 255.0));
            0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05
        };
        let [a, b] = [a, b].map(luminance);
        a.max(b) / a.min(b)
    }

    #[test]
    fn colors_can_be_read_on_their_paper() {
        assert!(contrast(RGBColor(255, 255, 0), LIGHT.paper) < 3.0, "yellow on white would not do");
        for theme in [LIGHT, DARK] {
            for color in theme.series {
                assert!(contrast(color, theme.paper) >= 3.0, "{color:?} on {}", theme.name);
            }
            for text in [theme.ink, theme.faint] {
                assert!(contrast(text, theme.paper) >= 4.5, "{text:?} on {}", theme.name);
            }
        }
    }

    #[test]
    fn no_two_colors_of_a_theme_are_equal() {
        // The page finds them in the charts by their values.
        for Theme { paper, ink, faint, grid, series, .. } in [LIGHT, DARK] {
            let mut all = [vec![paper, ink, faint, grid], series.to_vec()].concat();
            let count = all.len();
            all.sort_by_key(|c| (c.0, c.1, c.2));
            all.dedup();
            assert_eq!(all.len(), count);
        }
    }
}
