//! The transfer function on the device: normalised axes, mesh-space lengths, and the constants that specialise shaders.

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::layout::{Piece, Widget as GpuWidget};
use crate::gpu::mesh::Normalisation;
use crate::scene::{Curve, TransferFunction, Widget, WidgetShape};

/// Widgets and pieces that the shaders hold: the lengths of their uniform arrays.
pub const MOST_WIDGETS: usize = 64;
/// See [`MOST_WIDGETS`]; two more than the nodes of a curve, less one.
pub const MOST_PIECES: usize = 1024;

/// Normalised values are clamped to 0..1, so a range that ends beyond is as good as unbounded.
const UNBOUNDED: [f32; 2] = [-1.0, 2.0];

/// By how much ranges are widened, normalised: scalars at entry and exit err by 3e-7.
const RANGE_HAIR: f64 = 1e-6;

/// A transfer function as shaders see it.
pub struct TransferBuffers {
    /// The function it was made from.
    pub source: TransferFunction,
    /// `array<Widget>`.
    pub widgets: wgpu::Buffer,
    /// `array<Piece>`.
    pub pieces: wgpu::Buffer,
    /// `array<vec4u>`.
    pub piece_starts: wgpu::Buffer,
    /// `override` constants.
    pub constants: Vec<(&'static str, f64)>,
    /// Gradient magnitudes matter.
    pub bivariate: bool,
}

impl TransferBuffers {
    /// Normalises and uploads. `data_per_mesh`: see [`crate::tet::TetMesh`].
    ///
    /// # Errors
    /// A value that f32 cannot hold.
    pub fn new(
        gpu: &Gpu,
        transfer: &TransferFunction,
        scalar: Normalisation,
        gradient: Normalisation,
        data_per_mesh: f64,
    ) -> Result<Self> {
        let (mut widgets, mut pieces): (Vec<GpuWidget>, Vec<Piece>) = match transfer {
            TransferFunction::Widgets(list) => {
                (list.iter().map(|w| widget(w, scalar, gradient, data_per_mesh)).collect(), Vec::new())
            }
            TransferFunction::Curve(curve) => (Vec::new(), curve_pieces(curve, scalar, data_per_mesh)),
        };
        check(&widgets, &pieces)?;
        if widgets.len() > MOST_WIDGETS || pieces.len() > MOST_PIECES {
            return Err(Error::Asked(format!(
                "the transfer function has {} widgets and {} pieces of a curve; this renderer holds {MOST_WIDGETS} \
                 and {MOST_PIECES}",
                widgets.len(),
                pieces.len()
            )));
        }
        let starts = piece_starts(&pieces);
        let bivariate = widgets.iter().any(|w| {
            w.shape == 1 && (w.whiten[1] != 0.0 || w.whiten[3] != 0.0) || [w.gradient_low, w.gradient_high] != UNBOUNDED
        });
        let ranges = widgets
            .iter()
            .any(|w| [w.scalar_low, w.scalar_high] != UNBOUNDED || [w.gradient_low, w.gradient_high] != UNBOUNDED);
        let counts = [widgets.len() as f64, pieces.len() as f64];
        let flag = |b: bool| f64::from(u8::from(b));
        let constants = vec![
            ("WIDGETS", counts[0]),
            ("PIECES", counts[1]),
            ("BIVARIATE", flag(bivariate)),
            ("GAUSSIANS", flag(widgets.iter().any(|w| w.shape == 1))),
            ("RANGES", flag(ranges)),
        ];
        Ok(Self {
            source: transfer.clone(),
            widgets: {
                widgets.resize(MOST_WIDGETS, GpuWidget::default());
                gpu.uniform("widgets", &widgets)
            },
            pieces: {
                pieces.resize(MOST_PIECES, Piece::default());
                gpu.uniform("pieces", &pieces)
            },
            piece_starts: gpu.uniform("piece_starts", &starts),
            constants,
            bivariate,
        })
    }
}

fn widget(w: &Widget, scalar: Normalisation, gradient: Normalisation, data_per_mesh: f64) -> GpuWidget {
    let range = |range: Option<[f64; 2]>, axis: Normalisation| {
        range.map_or(UNBOUNDED, |[low, high]| {
            // Ends belong to the range: a hair wider, since values at the ends are computed. Those beyond every value
            // cannot cut, and are kept finite.
            let ends = [axis.apply(low) - RANGE_HAIR, axis.apply(high) + RANGE_HAIR].map(|e| e.clamp(-1.0, 2.0) as f32);
            if ends[0] < 0.0 && ends[1] > 1.0 { UNBOUNDED } else { ends }
        })
    };
    let [scalar_low, scalar_high] = range(w.scalar_range, scalar);
    let [gradient_low, gradient_high] = range(w.gradient_range, gradient);
    let (shape, center, whiten) = match w.shape {
        WidgetShape::Uniform => (0, [0.0; 2], [0.0; 4]),
        WidgetShape::Gaussian { center, sigma, angle } => {
            let (sin, cos) = angle.sin_cos();
            let [a, b] = sigma.map(|s| 1.0 / (std::f64::consts::SQRT_2 * s));
            // Data units per normalised unit.
            let (us, ug) = (1.0 / scalar.scale, 1.0 / gradient.scale);
            let rows = [cos * a * us, sin * a * ug, -sin * b * us, cos * b * ug];
            // Narrower than any f32 can tell; keeps squares finite.
            (1, [scalar.apply(center[0]), gradient.apply(center[1])], rows.map(|v| v.clamp(-1e12, 1e12) as f32))
        }
    };
    GpuWidget {
        whiten,
        center: center.map(|c| c as f32),
        extinction: (w.extinction * data_per_mesh) as f32,
        shape,
        color: w.color.map(|c| c as f32),
        pad: 0.0,
        scalar_low,
        scalar_high,
        gradient_low,
        gradient_high,
    }
}

fn curve_pieces(curve: &Curve, scalar: Normalisation, data_per_mesh: f64) -> Vec<Piece> {
    let nodes: Vec<(f64, [f32; 4])> = curve
        .nodes
        .iter()
        .map(|n| {
            let [r, g, b] = n.color;
            (scalar.apply(n.scalar), [r as f32, g as f32, b as f32, (n.extinction * data_per_mesh) as f32])
        })
        .collect();
    let (Some(first), Some(last)) = (nodes.first(), nodes.last()) else { return Vec::new() };
    let constant = |value, low: f64, high: f64| Piece {
        low: value,
        scalar_low: low as f32,
        scalar_high: high as f32,
        ..Default::default()
    };
    let mut pieces = vec![constant(first.1, first.0.min(0.0) - 1.0, first.0)];
    pieces.extend(curve.nodes.windows(2).zip(nodes.windows(2)).map(|(data, pair)| {
        let width = pair[1].0 - pair[0].0;
        let slope = |low: f64, high: f64| ((high - low) / width) as f32;
        let [a, b] = [&data[0], &data[1]];
        Piece {
            low: pair[0].1,
            slope: [
                slope(a.color[0], b.color[0]),
                slope(a.color[1], b.color[1]),
                slope(a.color[2], b.color[2]),
                slope(a.extinction * data_per_mesh, b.extinction * data_per_mesh),
            ],
            scalar_low: pair[0].0 as f32,
            scalar_high: pair[1].0 as f32,
            ..Default::default()
        }
    }));
    pieces.push(constant(last.1, last.0, last.0.max(1.0) + 1.0));
    pieces
}

/// For each of 256 equal parts of 0..1 (and for 1 itself), the first and the last piece that reach into it.
fn piece_starts(pieces: &[Piece]) -> Vec<[u32; 4]> {
    // The last piece whose low end is at or below the scalar.
    let holder = |scalar: f32| pieces.iter().take_while(|p| p.scalar_low <= scalar).count().saturating_sub(1) as u32;
    // A hair wider: the shader's rounding must not skip a piece.
    (0..257u16).map(|i| [holder((f32::from(i) - 0.01) / 256.0), holder((f32::from(i) + 1.01) / 256.0), 0, 0]).collect()
}

fn check(widgets: &[GpuWidget], pieces: &[Piece]) -> Result<()> {
    let finite = |values: &[f32]| values.iter().all(|v| v.is_finite());
    for (i, w) in widgets.iter().enumerate() {
        if !(finite(&w.color) && finite(&w.center) && finite(&w.whiten) && w.extinction.is_finite()) {
            return Err(Error::Asked(format!(
                "widget {i}: its centre, colour or extinction is beyond f32 on this mesh (centre {:?}, extinction {})",
                w.center, w.extinction
            )));
        }
    }
    for (i, p) in pieces.iter().enumerate() {
        if !(finite(&p.low) && finite(&p.slope) && p.scalar_low.is_finite() && p.scalar_high.is_finite()) {
            return Err(Error::Asked(format!("curve: the nodes around piece {i} are beyond f32 on this mesh")));
        }
    }
    Ok(())
}
