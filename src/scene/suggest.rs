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
    let depth_per_extinction = mean_path(mesh.bounds_in_data(), histogram.total());
    let constant = histogram.scalar.length() <= 1e-12 * histogram.scalar.max.abs().max(histogram.scalar.min.abs());
    let shapes = if constant { Vec::new() } else { place(histogram) };
    let colors = spread_colors(&shapes);
    let mut widgets = Vec::new();
    for (&peak, color) in shapes.iter().zip(colors) {
        let coverage = peak.coverage(histogram).max(SMALLEST_COVERAGE);
        let extinction = OPTICAL_DEPTH / shapes.len() as f64 / (depth_per_extinction * coverage);
        if extinction.is_finite() {
            widgets.push(Widget::new(peak.shape(), color, extinction));
        }
    }
    if widgets.is_empty() {
        let extinction = OPTICAL_DEPTH / depth_per_extinction;
        widgets.push(Widget::new(WidgetShape::Uniform, PLAIN, extinction));
    }
    TransferFunction::Widgets(widgets)
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
