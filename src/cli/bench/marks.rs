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
    /// Tests hold them apart for colour-blind eyes too.
    pub series: [RGBColor; 8],
}

/// On white paper. Found by climbing from hues that have names to what eyes of four kinds tell apart.
pub(super) const LIGHT: Theme = Theme {
    name: "light",
    paper: RGBColor(0xFF, 0xFF, 0xFF),
    ink: RGBColor(0x1C, 0x21, 0x28),
    faint: RGBColor(0x5B, 0x65, 0x70),
    grid: RGBColor(0xE3, 0xE6, 0xEA),
    series: [
        RGBColor(0x1E, 0x42, 0xD4),
        RGBColor(0xE0, 0x76, 0x0A),
        RGBColor(0x0A, 0x86, 0x73),
        RGBColor(0xC3, 0x5C, 0xC0),
        RGBColor(0x11, 0x92, 0xFD),
        RGBColor(0x5D, 0x08, 0x1E),
        RGBColor(0xA9, 0x4C, 0x0A),
        RGBColor(0x4E, 0x54, 0x5C),
    ],
};

/// The same on dark paper, hue by hue where that goes.
pub(super) const DARK: Theme = Theme {
    name: "dark",
    paper: RGBColor(0x16, 0x1B, 0x22),
    ink: RGBColor(0xE6, 0xEA, 0xEF),
    faint: RGBColor(0x9B, 0xA5, 0xB1),
    grid: RGBColor(0x2D, 0x34, 0x3D),
    series: [
        RGBColor(0x4E, 0x68, 0xE2),
        RGBColor(0xE9, 0x7A, 0x03),
        RGBColor(0x27, 0xD7, 0xA2),
        RGBColor(0xD1, 0x8B, 0xFF),
        RGBColor(0xBC, 0xF1, 0xFF),
        RGBColor(0xD2, 0x00, 0x2D),
        RGBColor(0xEF, 0xE6, 0x2E),
        RGBColor(0x88, 0x8F, 0x98),
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

    type Matrix = [[f32; 3]; 3];

    /// What protanopes, deuteranopes and tritanopes see of linear light (Machado et al. 2009, severity 1).
    const EYES: [Matrix; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152_286, 1.052_583, -0.204_868], [0.114_503, 0.786_281, 0.099_216], [-0.003_882, -0.048_116, 1.051_998]],
        [[0.367_322, 0.860_646, -0.227_968], [0.280_085, 0.672_501, 0.047_413], [-0.011_82, 0.042_94, 0.968_881]],
        [[1.255_528, -0.076_749, -0.178_779], [-0.078_411, 0.930_809, 0.147_602], [0.004_733, 0.691_367, 0.303_9]],
    ];

    fn times(matrix: &Matrix, v: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|i| (0..3).map(|k| matrix[i][k] * v[k]).sum())
    }

    /// In Oklab, where black and white are 1 apart.
    fn distance(eye: &Matrix, a: RGBColor, b: RGBColor) -> f32 {
        let lab = |RGBColor(r, g, b): RGBColor| {
            let light = [r, g, b].map(|v| linear_from_srgb(f32::from(v) / 255.0));
            let lms = [
                [0.412_221_46, 0.536_332_55, 0.051_445_995],
                [0.211_903_5, 0.680_699_5, 0.107_396_96],
                [0.088_302_46, 0.281_718_85, 0.629_978_7],
            ];
            let lab = [
                [0.210_454_26, 0.793_617_8, -0.004_072_047],
                [1.977_998_5, -2.428_592_2, 0.450_593_7],
                [0.025_904_037, 0.782_771_77, -0.808_675_77],
            ];
            times(&lab, times(&lms, times(eye, light).map(|v| v.clamp(0.0, 1.0))).map(f32::cbrt))
        };
        let (a, b) = (lab(a), lab(b));
        (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f32>().sqrt()
    }

    #[test]
    fn eyes_of_all_kinds_tell_colors_apart() {
        let [red, green] = [RGBColor(0xC0, 0x50, 0x30), RGBColor(0x7C, 0x76, 0x20)];
        assert!(distance(&EYES[0], red, green) > 0.12 && distance(&EYES[2], red, green) < 0.06, "the measure sees");
        for Theme { series, name, .. } in [LIGHT, DARK] {
            for (i, a) in series.iter().enumerate() {
                for b in &series[i + 1..] {
                    let least = EYES.iter().map(|eye| distance(eye, *a, *b)).fold(f32::INFINITY, f32::min);
                    // The closest pair of the light theme measures 0.090, that of the dark one 0.116.
                    assert!(least > 0.085, "{a:?} and {b:?} on {name} are {least} apart");
                }
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
