//! A transfer function for a mesh about which nobody has said anything.

use super::{TransferFunction, Widget, WidgetShape};
use crate::space::Bounds;
use crate::tet::{Domain, JointHistogram};

/// Mean optical depth over the silhouette of the mesh's box, all widgets together: neither empty nor opaque. Along
/// the box's diagonal it is two to three times as much.
const OPTICAL_DEPTH: f64 = 1.2;

/// Features that fill less of the volume than this are not made any denser: a blob of this share crossed in the middle
/// has about a hundred times its widget's share of the optical depth, a layer across the mesh the share itself.
const SMALLEST_COVERAGE: f64 = 2e-3;

/// The most widgets.
const WIDGETS: usize = 4;

/// Colours from low to high scalars, linear RGB: blue, bluish green, yellow, vermilion of Okabe and Ito 2008 (*Color
/// universal design*), told apart with any colour vision.
const PALETTE: [[f64; 3]; WIDGETS] =
    [[0.000, 0.168, 0.445], [0.000, 0.342, 0.171], [0.871, 0.776, 0.054], [0.665, 0.112, 0.000]];

/// Grey for a field without any variation, linear RGB.
const PLAIN: [f64; 3] = [0.6; 3];

/// Widgets for `mesh` from its joint histogram.
///
/// Boundaries show as ridges of high gradient over the scalar, and homogeneous regions as peaks at low gradient. So
/// up to four Gaussians are put, one after another, where most *variation* is left (volume times gradient magnitude,
/// the mean over a neighbourhood in the histogram): large homogeneous regions weigh little and stay thin. Each one's
/// extinction makes its share of the volume add the same optical depth, so that small features are dense and large
/// ones transparent. A constant field gets one uniform widget. Deterministic; shows something on every mesh.
pub fn suggest(mesh: &(impl Domain + ?Sized), histogram: &JointHistogram) -> TransferFunction {
    let constant = histogram.scalar.length() <= 1e-12 * histogram.scalar.max.abs().max(histogram.scalar.min.abs());
    let peaks = if constant { Vec::new() } else { place(histogram) };
    let mut widgets = widgets(&peaks, mesh, histogram);
    if widgets.is_empty() {
        let extinction = OPTICAL_DEPTH / mean_path(mesh.bounds_in_data(), histogram.total());
        widgets.push(Widget::new(WidgetShape::Uniform, PLAIN, extinction));
    }
    TransferFunction::Widgets(widgets)
}

/// Widgets where materials meet: up to four, after Kindlmann & Durkin (1998, *Semi-automatic generation of transfer
/// functions for direct volume rendering*).
///
/// Their position function `p(v) = -sigma^2 h(v) / g(v)`, with g the mean gradient magnitude at a value v and h the mean
/// second derivative along the gradient, is 0 at a boundary's middle. In a tetrahedron the field is linear and has no
/// second derivative; along the gradient `h = g dg/dv`, so that p is 0 where g(v) is greatest: at the top of each
/// arch that a boundary draws in the histogram. Empty for a field without any.
pub fn boundaries(mesh: &(impl Domain + ?Sized), histogram: &JointHistogram) -> Vec<Widget> {
    let columns = columns(histogram, |_| 1.0);
    let gradients: Vec<f64> = columns.iter().map(|column| column.mean).collect();
    widgets(&tops(&columns, &gradients, histogram), mesh, histogram)
}

/// Widgets in homogeneous regions: up to four, at the values that most of the volume takes where the gradient is low.
pub fn homogeneous_regions(mesh: &(impl Domain + ?Sized), histogram: &JointHistogram) -> Vec<Widget> {
    let total = histogram.total();
    let mean = bins(histogram).map(|(at, volume)| volume * at[1]).sum::<f64>() / total;
    let columns = columns(histogram, |gradient| (-gradient / (0.5 * mean).max(f64::MIN_POSITIVE)).exp());
    let volumes: Vec<f64> = columns.iter().map(|column| column.volume).collect();
    widgets(&tops(&columns, &volumes, histogram), mesh, histogram)
}

/// What is known of a scalar's bin.
#[derive(Clone, Copy, Default)]
struct Column {
    /// As weighted.
    volume: f64,
    /// Of the gradient magnitude, and the standard deviation.
    mean: f64,
    deviation: f64,
}

/// Of each bin of the scalar, by `weight` of the gradient magnitude; smoothed over what two hundredths of the range hold.
fn columns(histogram: &JointHistogram, weight: impl Fn(f64) -> f64) -> Vec<Column> {
    let width = histogram.bins[0];
    let mut sums = vec![[0.0; 3]; width];
    for (index, &volume) in histogram.counts.iter().enumerate() {
        let [_, gradient] = histogram.bin_center(index % width, index / width);
        let volume = volume * weight(gradient);
        let of = &mut sums[index % width];
        *of = [of[0] + volume, of[1] + volume * gradient, of[2] + volume * gradient * gradient];
    }
    let reach = (width / 100).max(1);
    let smooth = |i: usize| {
        let near = i.saturating_sub(reach)..(i + reach + 1).min(width);
        let [volume, first, second] = near.fold([0.0; 3], |sum, j| std::array::from_fn(|k| sum[k] + sums[j][k]));
        if volume <= 0.0 {
            return Column::default();
        }
        let mean = first / volume;
        Column { volume, mean, deviation: (second / volume - mean * mean).max(0.0).sqrt() }
    };
    (0..width).map(smooth).collect()
}

/// Gaussians at the highest maxima of `heights` over the scalar, which are as wide as these.
fn tops(columns: &[Column], heights: &[f64], histogram: &JointHistogram) -> Vec<Peak> {
    let last = heights.len() - 1;
    let highest = heights.iter().copied().fold(0.0, f64::max);
    // Where a maximum's slopes end: at a rise again by a tenth of the highest, or below e^(-1/2) of it.
    let slope = |from: usize, step: &dyn Fn(usize) -> Option<usize>| {
        let (mut at, mut lowest) = (from, heights[from]);
        while let Some(next) = step(at) {
            if heights[next] > lowest + 0.1 * highest {
                return None;
            }
            lowest = lowest.min(heights[next]);
            at = next;
            if heights[at] <= 0.607 * heights[from] {
                break;
            }
        }
        Some(at)
    };
    let up = |i: usize| (i < last).then_some(i + 1);
    let down = |i: usize| i.checked_sub(1);
    let is_top = |i: usize| {
        let around = i.saturating_sub(1)..(i + 2).min(last + 1);
        heights[i] > 0.05 * highest && around.clone().all(|j| heights[j] <= heights[i])
    };
    let mut found: Vec<(f64, Peak)> = Vec::new();
    let bin = histogram.scalar.length() / heights.len() as f64;
    let floor = (histogram.gradient.length() / 60.0).max(f64::MIN_POSITIVE);
    for i in (0..=last).filter(|&i| is_top(i)) {
        let ends = [slope(i, &down), slope(i, &up)];
        let [Some(low), Some(high)] = ends else { continue };
        let sigma = [(0.5 * bin * (high - low) as f64).max(bin), columns[i].deviation.max(floor)];
        let center = [histogram.bin_center(i, 0)[0], columns[i].mean];
        // Of a plateau, its first bin.
        if found.last().is_none_or(|(_, peak)| center[0] - peak.center[0] > sigma[0]) {
            found.push((heights[i], Peak { center, sigma }));
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.truncate(WIDGETS);
    let mut peaks: Vec<Peak> = found.into_iter().map(|(_, peak)| peak).collect();
    peaks.sort_by(|a, b| a.center[0].total_cmp(&b.center[0]));
    peaks
}

/// Coloured, and as dense as their shares of the volume let them add the same optical depth.
fn widgets(peaks: &[Peak], mesh: &(impl Domain + ?Sized), histogram: &JointHistogram) -> Vec<Widget> {
    let depth_per_extinction = mean_path(mesh.bounds_in_data(), histogram.total());
    let widget = |(peak, color): (&Peak, [f64; 3])| {
        let coverage = peak.coverage(histogram).max(SMALLEST_COVERAGE);
        let extinction = OPTICAL_DEPTH / peaks.len() as f64 / (depth_per_extinction * coverage);
        extinction.is_finite().then(|| Widget::new(peak.shape(), color, extinction))
    };
    peaks.iter().zip(spread_colors(peaks)).filter_map(widget).collect()
}

/// Length of the mesh along a ray, averaged over all rays that meet its box: volume over mean projected area, which is
/// a quarter of the box's surface (Cauchy).
fn mean_path(bounds: Bounds, volume: f64) -> f64 {
    let d = bounds.max - bounds.min;
    volume / (0.5 * (d.x * d.y + d.y * d.z + d.z * d.x))
}

/// An axis-aligned Gaussian over (scalar, gradient magnitude).
#[derive(Clone, Copy)]
struct Peak {
    center: [f64; 2],
    sigma: [f64; 2],
}

impl Peak {
    fn profile(&self, at: [f64; 2]) -> f64 {
        let square = |axis: usize| ((at[axis] - self.center[axis]) / self.sigma[axis]).powi(2);
        (-0.5 * (square(0) + square(1))).exp()
    }

    /// The mean of the profile over the volume.
    fn coverage(&self, histogram: &JointHistogram) -> f64 {
        bins(histogram).map(|(at, volume)| volume * self.profile(at)).sum::<f64>() / histogram.total()
    }

    fn shape(&self) -> WidgetShape {
        WidgetShape::Gaussian { center: self.center, sigma: self.sigma, angle: 0.0 }
    }
}

/// The bins that hold something: centre and volume.
fn bins(histogram: &JointHistogram) -> impl Iterator<Item = ([f64; 2], f64)> + '_ {
    let width = histogram.bins[0];
    let all = histogram.counts.iter().enumerate().filter(|(_, volume)| **volume > 0.0);
    all.map(move |(i, &volume)| (histogram.bin_center(i % width, i / width), volume))
}

/// Puts Gaussians where most variation is not yet covered.
fn place(histogram: &JointHistogram) -> Vec<Peak> {
    let mut left: Vec<([f64; 2], f64)> = bins(histogram).map(|(at, volume)| (at, volume * at[1])).collect();
    let total: f64 = left.iter().map(|(_, weight)| weight).sum();
    let spread = spread(&left, total);
    // A twelfth of where the variation lies (four standard deviations or so), but wide enough for the bins to sample.
    let lengths = [histogram.scalar.length(), histogram.gradient.length()];
    let sigma: [f64; 2] = std::array::from_fn(|axis| {
        let bin = lengths[axis] / histogram.bins[axis] as f64;
        let floor = if bin > 0.0 { bin } else { 0.1 * histogram.gradient.max.abs().max(f64::MIN_POSITIVE) };
        let share = if axis == 0 { 0.33 } else { 0.67 };
        (share * spread[axis]).max(floor)
    });
    let mut peaks = Vec::new();
    while peaks.len() < WIDGETS {
        let Some(center) = densest(&left, sigma, histogram) else { break };
        let peak = Peak { center, sigma };
        // Twice as wide, so that the next one stands apart.
        let wide = Peak { center, sigma: [2.0 * sigma[0], 1e3 * sigma[1]] };
        let covered: f64 = left.iter().map(|&(at, weight)| weight * peak.profile(at)).sum();
        // Overflow gives NaN, and then a uniform widget.
        if covered.is_nan() || covered <= 0.01 * total {
            break;
        }
        left.iter_mut().for_each(|(at, weight)| *weight *= 1.0 - wide.profile(*at));
        peaks.push(peak);
    }
    peaks.sort_by(|a, b| a.center[0].total_cmp(&b.center[0]));
    peaks
}

/// Weighted standard deviations.
fn spread(weighted: &[([f64; 2], f64)], total: f64) -> [f64; 2] {
    std::array::from_fn(|axis| {
        let mean = weighted.iter().map(|(at, weight)| weight * at[axis]).sum::<f64>() / total;
        (weighted.iter().map(|(at, weight)| weight * (at[axis] - mean).powi(2)).sum::<f64>() / total).sqrt()
    })
}

/// Where the weight around is greatest: the mean position in the fullest of the boxes of one `sigma` by one `sigma`.
fn densest(left: &[([f64; 2], f64)], sigma: [f64; 2], histogram: &JointHistogram) -> Option<[f64; 2]> {
    let mut boxes: std::collections::BTreeMap<[i64; 2], (f64, [f64; 2])> = std::collections::BTreeMap::new();
    let low = [histogram.scalar.min, histogram.gradient.min];
    for &(at, weight) in left {
        let key = std::array::from_fn(|axis| ((at[axis] - low[axis]) / sigma[axis]) as i64);
        let sum = boxes.entry(key).or_default();
        sum.0 += weight;
        (0..2).for_each(|axis| sum.1[axis] += weight * at[axis]);
    }
    let (weight, sums) = boxes.into_values().max_by(|a, b| a.0.total_cmp(&b.0))?;
    (weight > 0.0).then(|| sums.map(|sum| sum / weight))
}

/// Colours by the order of the scalar; fewer widgets take colours that lie further apart.
fn spread_colors(peaks: &[Peak]) -> Vec<[f64; 3]> {
    let last = peaks.len().saturating_sub(1).max(1);
    (0..peaks.len()).map(|i| PALETTE[i * (WIDGETS - 1) / last]).collect()
}
