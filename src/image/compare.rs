//! Two images turned into numbers: how far apart they are, where, and how often.

use std::fmt;

use serde::Serialize;

use super::Image;
use crate::error::{Error, Result};

/// Error thresholds whose exceeding pixels are counted.
const SWEEP: [f64; 10] = [1e-6, 1e-5, 1e-4, 1e-3, 2e-3, 1.0 / 255.0, 1e-2, 3e-2, 0.1, 0.3];

/// The pixel where two images differ most.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct WorstPixel {
    /// Column and row; row 0 is the top.
    pub pixel: [u32; 2],
    /// Of the first image.
    pub got: [f32; 4],
    /// Of the second image.
    pub want: [f32; 4],
}

/// How an image differs from the one it should be. All four channels count alike: linear premultiplied colour and
/// opacity. A pixel's error is that of its worst channel.
///
/// A pixel with a value that is not finite, in either image, has an infinite error: the maximum and the RMSE are
/// infinite and the PSNR is minus infinity, so that every limit fails. In JSON infinities are `null`.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// Width and height.
    pub size: [u32; 2],
    /// Largest error of any channel.
    pub max: f64,
    /// Root of the mean square over all channels of all pixels.
    pub rmse: f64,
    /// `-20 log10(rmse)`: peak 1, decibels; infinite for equal images.
    pub psnr: f64,
    /// The pixel error that 99.9 % of the pixels do not exceed.
    pub percentile_99_9: f64,
    /// Fraction of pixels with an error above 1/255.
    pub above_8_bit: f64,
    /// (threshold, pixels with an error above it), thresholds increasing.
    pub sweep: Vec<(f64, u64)>,
    /// Pixels that hold NaN or infinity in either image.
    pub not_finite: u64,
    /// The first of the pixels with the largest error.
    pub worst: WorstPixel,
    /// Signed difference of each pixel, row by row.
    #[serde(skip)]
    differences: Vec<[f32; 4]>,
}

impl Comparison {
    /// Compares `got` with `want`; fails where their sizes differ or they are empty.
    pub fn new(got: &Image, want: &Image) -> Result<Self> {
        let size = [got.width, got.height];
        if size != [want.width, want.height] {
            let sizes = format!("{}x{} and {}x{}", got.width, got.height, want.width, want.height);
            return Err(Error::Asked(format!("images of different sizes cannot be compared: {sizes} pixels")));
        }
        let mut errors: Vec<f64> = got.pixels.iter().zip(&want.pixels).map(|(g, w)| pixel_error(g, w)).collect();
        let Some((at, max)) = (0..).zip(errors.iter().copied()).reduce(|a, b| if b.1 > a.1 { b } else { a }) else {
            return Err(Error::Asked("images without pixels cannot be compared".into()));
        };
        let squares: f64 = got.pixels.iter().zip(&want.pixels).map(|(g, w)| square_error(g, w)).sum();
        let rmse = if max.is_finite() { (squares / (4 * errors.len()) as f64).sqrt() } else { f64::INFINITY };
        let above = |threshold: f64| errors.iter().filter(|&&e| e > threshold).count() as u64;
        let sweep: Vec<(f64, u64)> = SWEEP.map(|threshold| (threshold, above(threshold))).to_vec();
        let above_8_bit = above(1.0 / 255.0) as f64 / errors.len() as f64;
        let not_finite = errors.iter().filter(|e| e.is_infinite()).count() as u64;
        // The smallest value that at most a thousandth of the pixels exceed.
        let rank = errors.len() - 1 - errors.len() / 1000;
        let percentile_99_9 = *errors.select_nth_unstable_by(rank, f64::total_cmp).1;
        let difference = |(g, w): (&[f32; 4], &[f32; 4])| std::array::from_fn(|c| g[c] - w[c]);
        Ok(Self {
            size,
            max,
            rmse,
            psnr: -20.0 * rmse.log10(),
            percentile_99_9,
            above_8_bit,
            sweep,
            not_finite,
            worst: WorstPixel {
                pixel: [at as u32 % size[0], at as u32 / size[0]],
                got: got.pixels[at],
                want: want.pixels[at],
            },
            differences: got.pixels.iter().zip(&want.pixels).map(difference).collect(),
        })
    }

    /// Number of pixels compared.
    pub fn pixel_count(&self) -> u64 {
        self.differences.len() as u64
    }

    /// Pixels whose error exceeds `threshold`, row by row, with their error.
    pub fn pixels_above(&self, threshold: f64) -> impl Iterator<Item = ([u32; 2], f64)> {
        let width = self.size[0];
        (0u32..).zip(&self.differences).filter_map(move |(i, difference)| {
            let error = pixel_error(difference, &[0.0; 4]);
            (error > threshold).then_some(([i % width, i / width], error))
        })
    }

    /// Absolute differences of colour times `scale`, opaque; the difference of opacity is added to all three, and
    /// pixels that are not finite are magenta.
    pub fn difference_picture(&self, scale: f32) -> Image {
        let show = |&[r, g, b, a]: &[f32; 4]| match [r, g, b, a].iter().all(|v| v.is_finite()) {
            true => [scale * (r.abs() + a.abs()), scale * (g.abs() + a.abs()), scale * (b.abs() + a.abs()), 1.0],
            false => [1.0, 0.0, 1.0, 1.0],
        };
        Image { width: self.size[0], height: self.size[1], pixels: self.differences.iter().map(show).collect() }
    }
}

/// Largest absolute difference of a channel; infinite where a value is not finite.
fn pixel_error(got: &[f32; 4], want: &[f32; 4]) -> f64 {
    if !got.iter().chain(want).all(|v| v.is_finite()) {
        return f64::INFINITY;
    }
    (0..4).map(|c| (f64::from(got[c]) - f64::from(want[c])).abs()).fold(0.0, f64::max)
}

/// Sum of the squared differences of the channels.
fn square_error(got: &[f32; 4], want: &[f32; 4]) -> f64 {
    (0..4).map(|c| (f64::from(got[c]) - f64::from(want[c])).powi(2)).sum()
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.size;
        writeln!(f, "pixels           {width} x {height}, linear premultiplied RGBA")?;
        if self.not_finite > 0 {
            writeln!(f, "not finite       {} pixels", self.not_finite)?;
        }
        writeln!(f, "max error        {:.3e}", self.max)?;
        writeln!(f, "RMSE             {:.3e}", self.rmse)?;
        writeln!(f, "PSNR             {:.2} dB", self.psnr)?;
        writeln!(f, "99.9th percentile {:.3e}", self.percentile_99_9)?;
        writeln!(f, "above 1/255      {:.4} %", 100.0 * self.above_8_bit)?;
        let WorstPixel { pixel: [x, y], got, want } = self.worst;
        writeln!(f, "worst pixel      ({x}, {y})")?;
        writeln!(f, "  got            {got:?}")?;
        writeln!(f, "  want           {want:?}")?;
        write!(f, "pixels with an error above a threshold")?;
        for (threshold, count) in &self.sweep {
            let percent = 100.0 * *count as f64 / self.pixel_count() as f64;
            write!(f, "\n  {threshold:<14.2e} {count:>9}  {percent:>8.4} %")?;
        }
        Ok(())
    }
}
