//! Widgets as shaders see them: normalised axes, mesh-space lengths, knots in one array.

use crate::error::{Error, Result};
use crate::gpu::layout::Widget as GpuWidget;
use crate::scene::{SinusoidVariant, Widget, WidgetShape, Window};
use crate::tet::Axis;

/// Widgets that the shaders hold: the length of their uniform array.
pub const MOST_WIDGETS: usize = 64;
/// The same of pieces of windows and ramps.
pub const MOST_KNOT_PIECES: usize = 512;

/// Values are below this: quotients by the smallest change of a value (1e-30) stay finite.
const MOST: f64 = 1e8;
const UNBOUNDED: [f32; 2] = [-MOST as f32, MOST as f32];

/// The shapes' numbers (`shared/widgets.wgsl`).
mod shape {
    pub const UNIFORM: u32 = 0;
    pub const GAUSSIAN: u32 = 1;
    pub const TRIANGLE: u32 = 2;
    pub const COSINE: u32 = 3;
    pub const ARCH: u32 = 4;
    pub const HALF: u32 = 5;
    pub const RAMP: u32 = 6;
}

/// How data values become what shaders see.
#[derive(Clone, Copy, Debug)]
pub struct Axes {
    /// Of the scalar.
    pub scalar: Axis,
    /// Of the gradient magnitude.
    pub gradient: Axis,
    /// See [`crate::tet::TetMesh`].
    pub data_per_mesh: f64,
    /// What colours are multiplied by: lengths of the mesh, where emission is not weighted by extinction.
    pub color_scale: f64,
    /// By how much ranges are widened, normalised.
    pub range_hair: f64,
    /// Phases are taken from near this point, normalised; from their own zero where `None`.
    pub middle: Option<[f64; 2]>,
}

impl Axes {
    /// For values between 0 and 1 that are interpolated on the device.
    pub fn normalised(scalar: Axis, gradient: Axis, data_per_mesh: f64) -> Self {
        // Scalars at entry and exit err by 3e-7.
        Self { scalar, gradient, data_per_mesh, color_scale: 1.0, range_hair: 1e-6, middle: Some([0.5; 2]) }
    }

    /// For values as they are.
    pub fn plain() -> Self {
        let same = Axis::SAME;
        Self { scalar: same, gradient: same, data_per_mesh: 1.0, color_scale: 1.0, range_hair: 0.0, middle: None }
    }

    /// A direction and the constant that make `direction . data` of normalised values.
    fn along(&self, direction: [f64; 2]) -> ([f64; 2], f64) {
        let [a, b] = direction;
        ([a / self.scalar.scale, b / self.gradient.scale], a * self.scalar.low + b * self.gradient.low)
    }
}

/// Widgets and the pieces of their windows and ramps.
#[derive(Clone, Debug, Default)]
pub struct WidgetSet {
    /// In the scene's order.
    pub widgets: Vec<GpuWidget>,
    /// `(u, weight)` at both ends of each piece.
    pub knots: Vec<[f32; 4]>,
}

impl WidgetSet {
    /// Adds a widget.
    ///
    /// # Errors
    /// Values beyond f32.
    pub fn push(&mut self, w: &Widget, axes: &Axes) -> Result<()> {
        let range = |range: Option<[f64; 2]>, axis: Axis| {
            range.map_or(UNBOUNDED, |[low, high]| {
                // Ends belong to the range: a hair wider, since values at the ends are computed.
                let ends = [axis.apply(low) - axes.range_hair, axis.apply(high) + axes.range_hair];
                // Normalised values lie between 0 and 1.
                let cuts = axes.middle.is_none() || ends[0] >= 0.0 || ends[1] <= 1.0;
                if cuts { ends.map(|e| e.clamp(-MOST, MOST) as f32) } else { UNBOUNDED }
            })
        };
        let [scalar_low, scalar_high] = range(w.scalar_range, axes.scalar);
        let [gradient_low, gradient_high] = range(w.gradient_range, axes.gradient);
        let mut gpu = GpuWidget {
            extinction: (w.extinction * axes.data_per_mesh) as f32,
            color: w.color.map(|c| (c * axes.color_scale) as f32),
            scalar_low,
            scalar_high,
            gradient_low,
            gradient_high,
            ..GpuWidget::default()
        };
        self.add_shape(&mut gpu, &w.shape, axes);
        if let Some(Window { direction, knots }) = &w.window {
            let (first, count);
            (gpu.window_direction, first, count) = self.add_knots(*direction, knots, axes);
            (gpu.knots[0], gpu.knots[1]) = (first, count);
        }
        self.check(&gpu)?;
        self.widgets.push(gpu);
        Ok(())
    }

    fn add_shape(&mut self, gpu: &mut GpuWidget, shape: &WidgetShape, axes: &Axes) {
        match shape {
            WidgetShape::Uniform => gpu.shape = shape::UNIFORM,
            WidgetShape::Gaussian { center, sigma, angle } => {
                gpu.shape = shape::GAUSSIAN;
                let (sin, cos) = angle.sin_cos();
                let [a, b] = sigma.map(|s| 1.0 / (std::f64::consts::SQRT_2 * s));
                // Data units per normalised unit.
                let (us, ug) = (1.0 / axes.scalar.scale, 1.0 / axes.gradient.scale);
                let rows = [cos * a * us, sin * a * ug, -sin * b * us, cos * b * ug];
                // Narrower than any f32 can tell; keeps squares finite.
                gpu.whiten = rows.map(|v| v.clamp(-1e12, 1e12) as f32);
                gpu.center = [axes.scalar.apply(center[0]) as f32, axes.gradient.apply(center[1]) as f32];
            }
            WidgetShape::Triangle { direction, offset, period, duty } => {
                gpu.shape = shape::TRIANGLE;
                (gpu.whiten, gpu.center) = phase(*direction, *offset, *period, axes);
                gpu.whiten[3] = *duty as f32;
            }
            WidgetShape::Sinusoid { direction, offset, period, variant } => {
                gpu.shape = match variant {
                    SinusoidVariant::Cos => shape::COSINE,
                    SinusoidVariant::Arch => shape::ARCH,
                    SinusoidVariant::Half => shape::HALF,
                };
                (gpu.whiten, gpu.center) = phase(*direction, *offset, *period, axes);
            }
            WidgetShape::Ramp { direction, knots } => {
                gpu.shape = shape::RAMP;
                let (along, first, count) = self.add_knots(*direction, knots, axes);
                gpu.whiten = [along[0], along[1], 0.0, 0.0];
                (gpu.knots[2], gpu.knots[3]) = (first, count);
            }
        }
    }

    /// Direction, first piece, number of pieces.
    fn add_knots(&mut self, direction: [f64; 2], knots: &[[f64; 2]], axes: &Axes) -> ([f32; 2], u32, u32) {
        let (along, shift) = axes.along(direction);
        // Of length one, if not so by chance already: knots of any unit fit f32 then.
        let length = along[0].hypot(along[1]);
        let unit = if (0.1..=10.0).contains(&length) { 1.0 } else { 1.0 / length };
        let first = self.knots.len() as u32;
        let place = |u: f64| ((u - shift) * unit).clamp(-MOST, MOST) as f32;
        self.knots.extend(
            knots.windows(2).map(|pair| [place(pair[0][0]), pair[0][1] as f32, place(pair[1][0]), pair[1][1] as f32]),
        );
        (along.map(|a| (a * unit) as f32), first, self.knots.len() as u32 - first)
    }

    fn check(&self, w: &GpuWidget) -> Result<()> {
        let finite = |values: &[f32]| values.iter().all(|v| v.is_finite());
        let index = self.widgets.len();
        if !(finite(&w.color) && finite(&w.center) && finite(&w.whiten) && w.extinction.is_finite()) {
            return Err(Error::Asked(format!(
                "widget {index}: its position, colour or extinction is beyond f32 on this mesh (at {:?}, scaled by {:?}, \
                 extinction {}): give values nearer to the data's",
                w.center, w.whiten, w.extinction
            )));
        }
        if !finite(&w.window_direction) || !self.knots.iter().all(|k| finite(k)) {
            return Err(Error::Asked(format!("widget {index}: its knots are beyond f32 on this mesh")));
        }
        Ok(())
    }

    /// Gradient magnitudes matter.
    pub fn bivariate(&self) -> bool {
        self.widgets.iter().any(|w| {
            [w.gradient_low, w.gradient_high] != UNBOUNDED
                || w.whiten[1] != 0.0
                || (w.shape == shape::GAUSSIAN && w.whiten[3] != 0.0)
                || w.window_direction[1] != 0.0
        })
    }

    /// All colours are equal.
    pub fn one_color(&self) -> bool {
        self.widgets.windows(2).all(|pair| pair[0].color == pair[1].color)
    }

    /// The constants that compile away what no widget is or has.
    pub fn constants(&self) -> Vec<(&'static str, f64)> {
        let any = |test: &dyn Fn(&GpuWidget) -> bool| f64::from(u8::from(self.widgets.iter().any(test)));
        let bounded = |w: &GpuWidget| {
            [w.scalar_low, w.scalar_high] != UNBOUNDED || [w.gradient_low, w.gradient_high] != UNBOUNDED
        };
        vec![
            ("GAUSSIANS", any(&|w| w.shape == shape::GAUSSIAN)),
            ("TRIANGLES", any(&|w| w.shape == shape::TRIANGLE)),
            ("COSINES", any(&|w| w.shape == shape::COSINE)),
            ("ARCHES", any(&|w| w.shape == shape::ARCH || w.shape == shape::HALF)),
            ("RAMPS", any(&|w| w.shape == shape::RAMP)),
            ("WINDOWS", any(&|w| w.knots[1] > 0)),
            ("RANGES", any(&bounded)),
            ("BIVARIATE", f64::from(u8::from(self.bivariate()))),
            ("ONE_COLOR", f64::from(u8::from(self.one_color()))),
            ("WIDGET_TURNS", self.widgets.iter().map(turns).max().unwrap_or(1).into()),
        ]
    }
}

/// Turns of loops for one widget, at most: a window's pieces, and in each of them the ramp's.
fn turns(widget: &GpuWidget) -> u32 {
    let [_, window, _, ramp] = widget.knots;
    (1 + window) * (1 + ramp)
}

/// Phase per normalised unit of both axes and at the centre, and a centre whose phase is next to nothing: what is added to
/// a phase there keeps its digits. Whole periods are left out.
fn phase(direction: [f64; 2], offset: f64, period: f64, axes: &Axes) -> ([f32; 4], [f32; 2]) {
    let (along, shift) = axes.along(direction);
    let per = along.map(|a| (a / period).clamp(-1e30, 1e30));
    let constant = (shift - offset) / period;
    let at = |p: [f64; 2]| per[0] * p[0] + per[1] * p[1] + constant;
    let middle = axes.middle.unwrap_or([0.0; 2]);
    let whole = if axes.middle.is_some() { at(middle).round() } else { 0.0 };
    // From the middle, straight to the nearest zero.
    let squared = per[0] * per[0] + per[1] * per[1];
    let back = (at(middle) - whole) / squared;
    let center = [0, 1].map(|i| (middle[i] - back * per[i]) as f32);
    let rest = at(center.map(f64::from)) - whole;
    ([per[0] as f32, per[1] as f32, rest as f32, 0.0], center)
}
