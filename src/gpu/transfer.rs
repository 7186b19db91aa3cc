//! The transfer function on the device: normalised axes, mesh-space lengths, and the constants that specialise shaders.

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::layout::{Piece, Widget as GpuWidget};
use crate::gpu::mesh::Normalisation;
use crate::scene::{Curve, TransferFunction, Widget, WidgetShape};

/// Equal parts of 0..1 in the table that finds a scalar's piece.
const PIECE_STARTS: usize = 257;

/// Normalised values are clamped to 0..1, so a range that ends beyond is as good as unbounded.
const UNBOUNDED: [f32; 2] = [-1.0, 2.0];

/// A transfer function as shaders see it.
pub struct TransferBuffers {
    /// The function it was made from.
    pub source: TransferFunction,
    /// `array<Widget>`.
    pub widgets: wgpu::Buffer,
    /// `array<Piece>`.
    pub pieces: wgpu::Buffer,
    /// `array<u32>`.
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
        let starts = piece_starts(&pieces);
        let bivariate = widgets.iter().any(|w| {
            w.shape == 1 && (w.whiten[1] != 0.0 || w.whiten[3] != 0.0) || [w.gradient_low, w.gradient_high] != UNBOUNDED
        });
        let ranges = widgets
            .iter()
            .any(|w| [w.scalar_low, w.scalar_high] != UNBOUNDED || [w.gradient_low, w.gradient_high] != UNBOUNDED);
        let counts = [widgets.len() as f64, pieces.len() as f64];
        // Bindings must hold one element.
        if widgets.is_empty() {
            widgets.push(GpuWidget::default());
        }
        if pieces.is_empty() {
            pieces.push(Piece::default());
        }
        let flag = |b: bool| f64::from(u8::from(b));
        let constants = vec![
            ("WIDGETS", counts[0]),
            ("PIECES", counts[1]),
            ("PIECE_STARTS", PIECE_STARTS as f64),
            ("BIVARIATE", flag(bivariate)),
            ("GAUSSIANS", flag(widgets.iter().any(|w| w.shape == 1))),
            ("RANGES", flag(ranges)),
        ];
        Ok(Self {
            source: transfer.clone(),
            widgets: gpu.storage("widgets", &widgets),
            pieces: gpu.storage("pieces", &pieces),
            piece_starts: gpu.storage("piece_starts", &starts),
            constants,
            bivariate,
        })
    }
}

fn widget(w: &Widget, scalar: Normalisation, gradient: Normalisation, data_per_mesh: f64) -> GpuWidget {
    let range = |range: Option<[f64; 2]>, axis: Normalisation| {
        range.map_or(UNBOUNDED, |[low, high]| {
            // An end beyond every value cannot cut; ends are kept finite.
            let ends = [axis.apply(low).clamp(-1.0, 2.0) as f32, axis.apply(high).clamp(-1.0, 2.0) as f32];
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
        high: value,
        scalar_low: low as f32,
        scalar_high: high as f32,
        ..Default::default()
    };
    let mut pieces = vec![constant(first.1, first.0.min(0.0) - 1.0, first.0)];
    pieces.extend(nodes.windows(2).map(|pair| Piece {
        low: pair[0].1,
        high: pair[1].1,
        scalar_low: pair[0].0 as f32,
        scalar_high: pair[1].0 as f32,
        inverse_width: (1.0 / (pair[1].0 - pair[0].0)).min(1e30) as f32,
        pad: 0.0,
    }));
    pieces.push(constant(last.1, last.0, last.0.max(1.0) + 1.0));
    pieces
}

/// For each of equal parts of 0..1, the first piece that reaches into it.
fn piece_starts(pieces: &[Piece]) -> Vec<u32> {
    (0..PIECE_STARTS)
        .map(|i| {
            // A part early: the table's rounding must not skip a piece.
            let scalar = (i as f32 - 0.01) / (PIECE_STARTS - 1) as f32;
            pieces.iter().take_while(|p| p.scalar_high <= scalar).count().min(pieces.len().saturating_sub(1)) as u32
        })
        .collect()
}

fn check(widgets: &[GpuWidget], pieces: &[Piece]) -> Result<()> {
    let finite = |values: &[f32]| values.iter().all(|v| v.is_finite());
    for (i, w) in widgets.iter().enumerate() {
        if !(finite(&w.color) && finite(&w.center) && w.extinction.is_finite()) {
            return Err(Error::Asked(format!(
                "widget {i}: its centre, colour or extinction is beyond f32 on this mesh (centre {:?}, extinction {})",
                w.center, w.extinction
            )));
        }
    }
    for (i, p) in pieces.iter().enumerate() {
        if !(finite(&p.low) && finite(&p.high) && p.scalar_low.is_finite() && p.scalar_high.is_finite()) {
            return Err(Error::Asked(format!("curve: the nodes around piece {i} are beyond f32 on this mesh")));
        }
    }
    Ok(())
}
