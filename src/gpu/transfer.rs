//! The transfer function on the device: normalised axes, mesh-space lengths, and the constants that specialise shaders.

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::integral;
use crate::gpu::kernel::Resources;
use crate::gpu::layout::Piece;
use crate::gpu::store::{DEEP_SPAN, SPAN_BITS};
use crate::gpu::widgets::{Axes, MOST_KNOT_PIECES, MOST_WIDGETS, WidgetSet};
use crate::renderer::SegmentIntegral;
use crate::scene::{Curve, CurveNode, EmissionModel, TransferFunction};
use crate::tet::Axis;

/// Pieces of a curve that the shaders hold: the length of their uniform array; two more than the nodes, less one.
pub const MOST_PIECES: usize = 1024;

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
    /// Pieces of windows and ramps, `array<vec4f>`.
    pub knots: wgpu::Buffer,
    /// What the integral looks up, `array<vec4f>`.
    pub table: wgpu::Buffer,
    /// Tables of unweighted emission, `array<f32>`.
    pub visible_lengths: wgpu::Buffer,
    /// The emission model it was made for.
    pub emission: EmissionModel,
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
        integral: SegmentIntegral,
        emission: EmissionModel,
        scalar: Axis,
        gradient: Axis,
        data_per_mesh: f64,
    ) -> Result<Self> {
        let mut axes = Axes::normalised(scalar, gradient, data_per_mesh);
        if emission == EmissionModel::Unweighted {
            axes.color_scale = data_per_mesh;
        }
        let mut set = WidgetSet::default();
        let nodes: Vec<(f64, [f64; 4])> = match transfer {
            TransferFunction::Widgets(list) => {
                list.iter().try_for_each(|w| set.push(w, &axes))?;
                Vec::new()
            }
            TransferFunction::Curve(curve) => curve_nodes(curve, scalar, data_per_mesh, axes.color_scale),
        };
        let mut pieces: Vec<Piece> = nodes.windows(2).map(|pair| piece(pair[0], pair[1])).collect();
        check(&pieces)?;
        integral::check(integral, transfer)?;
        if set.widgets.len() > MOST_WIDGETS || set.knots.len() > MOST_KNOT_PIECES || pieces.len() > MOST_PIECES {
            return Err(Error::Asked(format!(
                "the transfer function has {} widgets, {} pieces of ramps and windows and {} pieces of a curve; this \
                 renderer holds {MOST_WIDGETS}, {MOST_KNOT_PIECES} and {MOST_PIECES}: give it fewer",
                set.widgets.len(),
                set.knots.len(),
                pieces.len()
            )));
        }
        let places: Vec<f64> = nodes.iter().map(|n| n.0).collect();
        let padded = |mut values: Vec<[f32; 4]>| {
            values.resize(MOST_PIECES + 1, [0.0; 4]);
            values
        };
        let mut constants = set.constants();
        constants.push(("WIDGETS", set.widgets.len() as f64));
        constants.push(("PIECES", pieces.len() as f64));
        constants.push(("SPAN_BITS", f64::from(SPAN_BITS)));
        constants.push(("DEEP_SPAN", f64::from(DEEP_SPAN)));
        constants.extend(integral::constants(integral, emission));
        let bivariate = set.bivariate();
        let mut buffers = Self {
            source: transfer.clone(),
            emission,
            table: integral::psi_table(gpu, integral)?,
            visible_lengths: integral::visible_lengths(gpu, integral, emission),
            widgets: {
                set.widgets.resize(MOST_WIDGETS, Default::default());
                gpu.uniform("widgets", &set.widgets)
            },
            pieces: {
                pieces.resize(MOST_PIECES, Piece::default());
                gpu.uniform("pieces", &pieces)
            },
            nodes: gpu.uniform("nodes", &padded(apart(&places).map(|n| [n, 0.0, 0.0, 0.0]).collect())),
            node_values: gpu.uniform("node_values", &padded(nodes.iter().map(|n| n.1.map(|v| v as f32)).collect())),
            piece_starts: gpu.uniform("piece_starts", &piece_starts(&places)),
            knots: {
                set.knots.resize(MOST_KNOT_PIECES, Default::default());
                gpu.uniform("knots", &set.knots)
            },
            constants,
            bivariate,
        };
        if let SegmentIntegral::PreIntegrated { size } = integral {
            let resources = buffers.offer(Resources::default());
            buffers.table = integral::preintegrated_table(gpu, size, &buffers.constants, &resources)?;
        }
        Ok(buffers)
    }

    /// What the shaders were specialised for: kinds of widgets, emission, integral, and how cells are drawn. `paired`:
    /// they are drawn span by span, by bands or pairs of bands.
    pub fn describe(&self, integral: SegmentIntegral, paired: Option<bool>) -> String {
        let on = |name: &str| self.constants.iter().any(|(n, value)| *n == name && *value > 0.0);
        let function = match &self.source {
            TransferFunction::Curve(_) => "a curve".to_owned(),
            TransferFunction::Widgets(list) => {
                let kinds: Vec<&str> = [
                    ("GAUSSIANS", "gaussian"),
                    ("TRIANGLES", "triangle"),
                    ("COSINES", "cos"),
                    ("ARCHES", "arch or half"),
                    ("RAMPS", "ramp"),
                    ("WINDOWS", "with windows"),
                    ("RANGES", "with ranges"),
                ]
                .into_iter()
                .filter_map(|(constant, kind)| on(constant).then_some(kind))
                .collect();
                let kinds = if kinds.is_empty() { "uniform".to_owned() } else { kinds.join(", ") };
                let axes = if on("BIVARIATE") { "scalar and gradient" } else { "scalar" };
                let colors = if on("ONE_COLOR") { "one colour" } else { "several colours" };
                format!("{} widgets ({kinds}) of {axes} in {colors}", list.len())
            }
        };
        let emission = if self.emission == EmissionModel::Unweighted { "unweighted" } else { "weighted" };
        let way = match paired {
            Some(false) => "drawn band by band",
            Some(true) => "drawn by pairs of bands",
            None => "a loop over each cell's widgets or pieces",
        };
        format!("shaders are specialised for {function}, {emission} emission, {integral}, {way}")
    }

    /// Adds the buffers to what kernels may bind.
    #[must_use]
    pub fn offer<'a>(&'a self, resources: Resources<'a>) -> Resources<'a> {
        resources
            .with("widgets", &self.widgets)
            .with("pieces", &self.pieces)
            .with("nodes", &self.nodes)
            .with("node_values", &self.node_values)
            .with("piece_starts", &self.piece_starts)
            .with("knots", &self.knots)
            .with("table", &self.table)
            .with("visible_lengths", &self.visible_lengths)
    }
}

/// The curve's nodes, normalised, with their colours and extinctions; and one more at either end, so that the first and
/// last piece are constant and reach beyond 0..1.
fn curve_nodes(curve: &Curve, scalar: Axis, data_per_mesh: f64, color_scale: f64) -> Vec<(f64, [f64; 4])> {
    let node = |n: &CurveNode| {
        let [r, g, b] = n.color.map(|c| c * color_scale);
        (scalar.apply(n.scalar), [r, g, b, n.extinction * data_per_mesh])
    };
    let mut nodes: Vec<(f64, [f64; 4])> = curve.nodes.iter().map(node).collect();
    if let (Some(&first), Some(&last)) = (nodes.first(), nodes.last()) {
        nodes.insert(0, (first.0.min(0.0) - 1.0, first.1));
        nodes.push((last.0.max(1.0) + 1.0, last.1));
    }
    nodes
}

/// Places in f32, each above the one before: bands have a width.
fn apart(places: &[f64]) -> impl Iterator<Item = f32> {
    // What f32 tells apart up to 1.
    const LEAST: f32 = f32::EPSILON;
    places.iter().scan(f32::NEG_INFINITY, |before, &place| {
        *before = (place as f32).max(*before + LEAST).max(before.next_up());
        Some(*before)
    })
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

fn check(pieces: &[Piece]) -> Result<()> {
    let finite = |values: &[f32]| values.iter().all(|v| v.is_finite());
    for (i, p) in pieces.iter().enumerate() {
        if !(finite(&p.origin) && finite(&p.slope)) {
            return Err(Error::Asked(format!("curve: the nodes around piece {i} are beyond f32 on this mesh")));
        }
    }
    Ok(())
}
