//! The transfer function on the device: normalised axes, mesh-space lengths, and the constants that specialise shaders.

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::layout::{Piece, Widget as GpuWidget};
use crate::gpu::mesh::Normalisation;
use crate::scene::{Curve, CurveNode, TransferFunction, Widget, WidgetShape};

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
    /// Where pieces begin, `array<vec4f>`.
    pub nodes: wgpu::Buffer,
    /// Colour and extinction there, `array<vec4f>`.
    pub node_values: wgpu::Buffer,
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
        let (mut widgets, nodes): (Vec<GpuWidget>, Vec<(f64, [f64; 4])>) = match transfer {
            TransferFunction::Widgets(list) => {
                let widgets = list.iter().enumerate();
                let widgets = widgets.map(|(index, w)| widget(index, w, scalar, gradient, data_per_mesh));
                (widgets.collect::<Result<_>>()?, Vec::new())
            }
            TransferFunction::Curve(curve) => (Vec::new(), curve_nodes(curve, scalar, data_per_mesh)),
        };
        let mut pieces: Vec<Piece> = nodes.windows(2).map(|pair| piece(pair[0], pair[1])).collect();
        check(&widgets, &pieces)?;
        if widgets.len() > MOST_WIDGETS || pieces.len() > MOST_PIECES {
            return Err(Error::Asked(format!(
                "the transfer function has {} widgets and {} pieces of a curve; this renderer holds {MOST_WIDGETS} \
                 and {MOST_PIECES}",
                widgets.len(),
                pieces.len()
            )));
        }
        let places: Vec<f64> = nodes.iter().map(|n| n.0).collect();
        let padded = |mut values: Vec<[f32; 4]>| {
            values.resize(MOST_PIECES + 1, [0.0; 4]);
            values
        };
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
            nodes: gpu.uniform("nodes", &padded(places.iter().map(|&n| [n as f32, 0.0, 0.0, 0.0]).collect())),
            node_values: gpu.uniform("node_values", &padded(nodes.iter().map(|n| n.1.map(|v| v as f32)).collect())),
            piece_starts: gpu.uniform("piece_starts", &piece_starts(&places)),
            constants,
            bivariate,
        })
    }
}

fn widget(
    index: usize,
    w: &Widget,
    scalar: Normalisation,
    gradient: Normalisation,
    data_per_mesh: f64,
) -> Result<GpuWidget> {
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
        _ if w.window.is_some() => return Err(unknown(index, "a window")),
        WidgetShape::Triangle { .. } => return Err(unknown(index, "a triangle wave")),
        WidgetShape::Sinusoid { .. } => return Err(unknown(index, "a sinusoid")),
        WidgetShape::Ramp { .. } => return Err(unknown(index, "a ramp")),
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
    Ok(GpuWidget {
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
    })
}

fn unknown(index: usize, what: &str) -> Error {
    Error::Asked(format!("widget {index}: {what} cannot be drawn on a graphics device yet: use --device oracle"))
}

/// The curve's nodes, normalised, with their colours and extinctions; and one more at either end, so that the first and
/// last piece are constant and reach beyond 0..1.
fn curve_nodes(curve: &Curve, scalar: Normalisation, data_per_mesh: f64) -> Vec<(f64, [f64; 4])> {
    let node = |n: &CurveNode| {
        let [r, g, b] = n.color;
        (scalar.apply(n.scalar), [r, g, b, n.extinction * data_per_mesh])
    };
    let mut nodes: Vec<(f64, [f64; 4])> = curve.nodes.iter().map(node).collect();
    if let (Some(&first), Some(&last)) = (nodes.first(), nodes.last()) {
        nodes.insert(0, (first.0.min(0.0) - 1.0, first.1));
        nodes.push((last.0.max(1.0) + 1.0, last.1));
    }
    nodes
}

fn piece((from, low): (f64, [f64; 4]), (to, high): (f64, [f64; 4])) -> Piece {
    let slope: [f64; 4] = std::array::from_fn(|i| (high[i] - low[i]) / (to - from));
    Piece { origin: std::array::from_fn(|i| (low[i] - slope[i] * from) as f32), slope: slope.map(|v| v as f32) }
}

/// For each of 256 equal parts of 0..1 (and for 1 itself), the first and the last piece that reach into it.
fn piece_starts(nodes: &[f64]) -> Vec<[u32; 4]> {
    let pieces = nodes.len().saturating_sub(1);
    // The last piece that begins at or below the scalar.
    let holder = |at: f64| nodes[..pieces].iter().take_while(|&&n| n <= at).count().saturating_sub(1) as u32;
    // A hair wider: the shader's rounding must not skip a piece.
    (0..257u16).map(|i| [holder((f64::from(i) - 0.01) / 256.0), holder((f64::from(i) + 1.01) / 256.0), 0, 0]).collect()
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
        if !(finite(&p.origin) && finite(&p.slope)) {
            return Err(Error::Asked(format!("curve: the nodes around piece {i} are beyond f32 on this mesh")));
        }
    }
    Ok(())
}
