//! Logarithmic axes: ranges of whole room, and ticks with labels.

/// From data to pixels.
#[derive(Clone, Debug)]
pub(super) struct LogScale {
    /// Logarithms to base 10 at `pixels`.
    ends: [f64; 2],
    pixels: [f64; 2],
}

/// How numbers are written along an axis.
#[derive(Clone, Copy, Debug)]
pub(super) enum Notation {
    /// `0.01`, `10`, `1000`.
    Plain,
    /// `10⁻³`.
    Powers,
    /// `20 k`, `1 M`.
    Counts,
}

impl LogScale {
    /// Shows all `values` (what is not above 0 is passed over), with room around them: a decade at least.
    pub fn new(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Self {
        let logs = values.filter(|v| v.is_finite() && *v > 0.0).map(f64::log10);
        let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
        let room = (0.07 * (high - low)).max(0.5 * (1.0 - (high - low))).max(0.12);
        Self { ends: [low - room, high + room], pixels }
    }

    /// The same with this many pixels more before the smallest value.
    #[must_use]
    pub fn with_room_before(mut self, pixels: f64) -> Self {
        let share = pixels / (self.pixels[1] - self.pixels[0]);
        self.ends[0] -= (self.ends[1] - self.ends[0]) * share / (1.0 - share);
        self
    }

    pub fn at(&self, value: f64) -> f64 {
        let share = (value.log10() - self.ends[0]) / (self.ends[1] - self.ends[0]);
        self.pixels[0] + share * (self.pixels[1] - self.pixels[0])
    }

    /// Positions and labels: powers of ten, and 2 and 5 of them where there are few.
    pub fn ticks(&self, notation: Notation) -> Vec<(f64, String)> {
        let decades = self.ends[1] - self.ends[0];
        let (mantissas, step): (&[u32], usize) = match decades {
            d if d < 2.2 => (&[1, 2, 5], 1),
            d if d < 7.5 => (&[1], 1),
            d => (&[1], (d / 6.0).ceil() as usize),
        };
        let exponents = (self.ends[0].floor() as i32..=self.ends[1].ceil() as i32).step_by(step);
        let all = exponents.flat_map(|e| mantissas.iter().map(move |m| (*m, e)));
        let value = |(m, e): (u32, i32)| f64::from(m) * 10_f64.powi(e);
        all.filter(|t| (self.ends[0]..=self.ends[1]).contains(&value(*t).log10()))
            .map(|(m, e)| (self.at(value((m, e))), notation.label(m, e)))
            .collect()
    }
}

impl Notation {
    /// Of `mantissa * 10^exponent`.
    fn label(self, mantissa: u32, exponent: i32) -> String {
        match self {
            Self::Plain if (-3..=5).contains(&exponent) => {
                let decimals = usize::try_from(-exponent).unwrap_or(0);
                format!("{:.decimals$}", f64::from(mantissa) * 10_f64.powi(exponent))
            }
            Self::Counts if (0..=11).contains(&exponent) => {
                let unit = ["", " k", " M", " G"][exponent as usize / 3];
                format!("{}{unit}", mantissa * 10_u32.pow(exponent as u32 % 3))
            }
            _ if mantissa == 1 => format!("10{}", superscript(exponent)),
            _ => format!("{mantissa}·10{}", superscript(exponent)),
        }
    }
}

fn superscript(number: i32) -> String {
    let raise = |c: char| match c {
        '-' => '⁻',
        c => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][c as usize - '0' as usize],
    };
    number.to_string().chars().map(raise).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(values: &[f64], notation: Notation) -> Vec<String> {
        let scale = LogScale::new(values.iter().copied(), [0.0, 100.0]);
        let ticks = scale.ticks(notation);
        assert!(ticks.iter().all(|(at, _)| (0.0..=100.0).contains(at)), "{ticks:?}");
        ticks.into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn there_are_few_ticks_and_two_at_least() {
        assert_eq!(labels(&[1.0, 1000.0], Notation::Plain), ["1", "10", "100", "1000"]);
        assert_eq!(labels(&[3.0], Notation::Plain), ["1", "2", "5"]);
        assert_eq!(labels(&[1e-5, 1e-3], Notation::Powers), ["10⁻⁵", "10⁻⁴", "10⁻³"]);
        assert_eq!(labels(&[2e5, 3e6], Notation::Counts), ["200 k", "500 k", "1 M", "2 M"]);
        for values in [&[1e-300, 1e300][..], &[1.0, 1.0], &[], &[0.0, -1.0], &[f64::NAN, 1e9], &[1e-12, 1.0]] {
            let count = labels(values, Notation::Powers).len();
            assert!((2..=9).contains(&count), "{count} ticks of {values:?}");
        }
    }

    #[test]
    fn values_are_within_the_frame() {
        let scale = LogScale::new([2.0, 30.0].into_iter(), [300.0, 0.0]);
        assert!(scale.at(2.0) < 300.0 && scale.at(30.0) > 0.0 && scale.at(2.0) > scale.at(30.0));
        let scale = LogScale::new([2.0, 30.0].into_iter(), [0.0, 300.0]).with_room_before(100.0);
        assert!(scale.at(2.0) > 100.0 && scale.at(30.0) < 300.0, "{scale:?}");
    }
}
