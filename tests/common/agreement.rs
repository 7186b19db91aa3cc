//! Is a picture the one it should be, and what explains the pixels that are not?

use std::fmt;

use tetralux::image::{Comparison, Image};
use tetralux::oracle::View;
use tetralux::scene::TransferFunction;

/// What is asked of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// At least, decibels.
    pub psnr: f64,
    /// At most, the pixel error that 99.9 % of the pixels keep below.
    pub percentile_99_9: f64,
    /// Every larger pixel error has to be explained.
    pub explained_above: f64,
    /// Explained: moving the ray by so many pixels changes the true pixel as much.
    pub shift: f64,
}

/// A pixel whose error its surroundings do not explain.
#[derive(Clone, Copy, Debug)]
pub struct Unexplained {
    /// Column and row.
    pub pixel: [u32; 2],
    /// Of the worst channel.
    pub error: f64,
    /// Change of the true pixel at the limit's shift.
    pub sensitivity: f64,
    /// The smallest of 2, 4, 8, 16 and 32 times that shift which would have explained it.
    pub enough: Option<f64>,
}

/// How a picture compares.
#[derive(Clone, Debug)]
pub struct Verdict {
    pub comparison: Comparison,
    /// Pixels above the limit that are explained.
    pub explained: usize,
    pub unexplained: Vec<Unexplained>,
    limits: Limits,
}

impl Verdict {
    /// Compares; `sensitivity` of a pixel is how much it changes when its ray moves by so many pixels.
    pub fn new(got: &Image, want: &Image, limits: Limits, sensitivity: impl Fn([u32; 2], f64) -> f64) -> Self {
        let comparison = Comparison::new(got, want).expect("equal sizes");
        let (mut explained, mut unexplained) = (0, Vec::new());
        for (pixel, error) in comparison.pixels_above(limits.explained_above) {
            let here = sensitivity(pixel, limits.shift);
            if here >= error {
                explained += 1;
                continue;
            }
            let factors = [2.0, 4.0, 8.0, 16.0, 32.0].map(|factor| factor * limits.shift);
            let enough = factors.into_iter().find(|&shift| sensitivity(pixel, shift) >= error);
            unexplained.push(Unexplained { pixel, error, sensitivity: here, enough });
        }
        Self { comparison, explained, unexplained, limits }
    }

    /// What the picture fails; empty for a good one.
    pub fn failures(&self) -> Vec<String> {
        let (c, l) = (&self.comparison, self.limits);
        let mut failures = Vec::new();
        // Phrased so that NaN fails.
        if !(c.psnr >= l.psnr) {
            failures.push(format!("PSNR {:.2} dB, below {}", c.psnr, l.psnr));
        }
        if !(c.percentile_99_9 <= l.percentile_99_9) {
            failures.push(format!("99.9th percentile {:.3e}, above {:.1e}", c.percentile_99_9, l.percentile_99_9));
        }
        if !self.unexplained.is_empty() {
            let worst = self.unexplained.iter().max_by(|a, b| a.error.total_cmp(&b.error));
            failures.push(format!(
                "{} pixels above {:.1e} are not explained by a shift of {:.1e} pixels, the worst is {worst:?}",
                self.unexplained.len(),
                l.explained_above,
                l.shift
            ));
        }
        failures
    }

    /// Fails with all that is known of the comparison.
    pub fn assert_good(&self, what: &str) {
        let failures = self.failures();
        assert!(failures.is_empty(), "{what}: {}\n{}", failures.join("; "), self.comparison);
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let c = &self.comparison;
        let above = c.pixels_above(self.limits.explained_above).count();
        write!(f, "{:6.2} dB  99.9% {:.1e}  max {:.1e}", c.psnr, c.percentile_99_9, c.max)?;
        write!(f, "  above {:.0e}: {above}, not explained {}", self.limits.explained_above, self.unexplained.len())?;
        if !self.unexplained.is_empty() {
            let most = self.unexplained.iter().map(|u| u.enough.unwrap_or(f64::INFINITY)).fold(0.0, f64::max);
            write!(f, " (a shift of {most:.0e} would explain all)")?;
        }
        Ok(())
    }
}

/// [`View::sensitivity`] of whole pixels.
pub fn sensitivity_of<'a>(view: &'a View<'_>, transfer: &'a TransferFunction) -> impl Fn([u32; 2], f64) -> f64 + 'a {
    |[x, y], shift| view.sensitivity(transfer, [f64::from(x) + 0.5, f64::from(y) + 0.5], shift)
}

/// Fails unless `limits` reject pictures whose errors lie just above them: noise everywhere, in 2 pixels of a thousand,
/// and a single wrong pixel; and accept the same just below.
pub fn assert_limits_bite(want: &Image, limits: Limits) {
    let count = want.pixels.len();
    let with = |error: f64, every: usize, first: usize| {
        let mut image = want.clone();
        image.pixels.iter_mut().skip(first).step_by(every).for_each(|p| p.iter_mut().for_each(|v| *v += error as f32));
        Verdict::new(&image, want, limits, |_, _| 0.0)
    };
    let noise = 10f64.powf(-limits.psnr / 20.0);
    for (error, every, first, what) in [
        (noise, 1, 0, "PSNR"),
        (limits.percentile_99_9, 500, 250, "percentile"),
        (limits.explained_above, count, count / 2, "pixels above"),
    ] {
        let (above, below) = (with(1.02 * error, every, first), with(0.98 * error, every, first));
        assert!(above.failures().iter().any(|f| f.contains(what)), "planted {what} not seen: {above}");
        assert!(below.failures().iter().all(|f| !f.contains(what)), "{what} seen where there is none: {below}");
    }
}
