//! Segments on the device, each under widgets of its own: what the integrals are checked with, without a mesh.

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::integral;
use crate::gpu::kernel::{Kernel, Resources};
use crate::gpu::layout::{SegmentCase, SegmentResult};
use crate::gpu::record::{Recorder, Work};
use crate::gpu::widgets::{Axes, WidgetSet};
use crate::renderer::SegmentIntegral;
use crate::scene::{EmissionModel, TransferFunction, Widget};

/// What no segment gives: a place that still holds it was not written.
const SENTINEL: u32 = 0xdead_beef;

/// Segments in one dispatch.
const MOST_CASES: usize = 1 << 20;

/// A ray in one cell and the widgets it meets, as f32 takes them: nothing is normalised.
#[derive(Clone, Copy, Debug)]
pub struct Segment<'a> {
    /// Scalar and gradient magnitude at the eye's side.
    pub front: [f32; 2],
    /// The same at the other.
    pub back: [f32; 2],
    /// In the unit of length of the extinctions.
    pub length: f32,
    /// At most 64.
    pub widgets: &'a [Widget],
}

/// What came of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Integrated {
    /// Linear, premultiplied.
    pub color: [f32; 3],
    /// exp(-optical depth).
    pub transmittance: f32,
    /// Pieces that the segment was cut into.
    pub pieces: u32,
}

/// Integrates segments on the device.
///
/// # Errors
/// Widgets beyond f32 or too many of them; a lost device.
pub fn integrate(
    gpu: &Gpu,
    integral: SegmentIntegral,
    emission: EmissionModel,
    segments: &[Segment<'_>],
) -> Result<Vec<Integrated>> {
    integral::check(integral, &TransferFunction::Widgets(Vec::new()))?;
    let mut results = Vec::with_capacity(segments.len());
    for part in segments.chunks(MOST_CASES) {
        results.extend(integrate_part(gpu, integral, emission, part)?);
    }
    Ok(results)
}

fn integrate_part(
    gpu: &Gpu,
    integral: SegmentIntegral,
    emission: EmissionModel,
    segments: &[Segment<'_>],
) -> Result<Vec<Integrated>> {
    let mut set = WidgetSet::default();
    let mut cases = Vec::with_capacity(segments.len());
    for (i, s) in segments.iter().enumerate() {
        if s.widgets.len() > super::widgets::MOST_WIDGETS {
            let most = super::widgets::MOST_WIDGETS;
            return Err(Error::Asked(format!("segment {i} has {} widgets; {most} are held at most", s.widgets.len())));
        }
        cases.push(SegmentCase {
            front: s.front,
            back: s.back,
            extent: s.length,
            first_widget: set.widgets.len() as u32,
            widget_count: s.widgets.len() as u32,
            pad: 0,
        });
        for widget in s.widgets {
            set.push(widget, &Axes::plain()).map_err(|e| Error::Asked(format!("segment {i}: {e}")))?;
        }
    }
    let kernel = kernel(gpu, integral, emission, &set, cases.len())?;
    let empty = [SegmentResult { pieces: SENTINEL, ..SegmentResult::default() }];
    let bytes = (cases.len() * size_of::<SegmentResult>()) as u64;
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC;
    let results = gpu.buffer("results", bytes, usage);
    gpu.write(&results, 0, bytemuck::cast_slice(&empty.repeat(cases.len())));
    // Never empty: a binding has a size.
    set.widgets.push(Default::default());
    set.knots.push(Default::default());
    let widgets = gpu.storage("case_widgets", &set.widgets);
    let knots = gpu.storage("case_knots", &set.knots);
    let cases = gpu.storage("cases", &cases);
    let table = integral::psi_table(gpu, integral)?;
    let visible_lengths = integral::visible_lengths(gpu, integral, emission);
    let resources = Resources::default()
        .with("table", &table)
        .with("visible_lengths", &visible_lengths)
        .with("case_widgets", &widgets)
        .with("case_knots", &knots)
        .with("cases", &cases)
        .with("results", &results);
    let groups = kernel.bind(gpu, &resources)?;
    let mut recorder = Recorder::new(gpu, false);
    recorder.compute(&kernel, &groups, Work::Groups(segments.len().div_ceil(64) as u32))?;
    recorder.submit();
    let results: Vec<SegmentResult> = gpu.read(&results, bytes)?;
    if let Some(i) = results.iter().position(|r| r.pieces == SENTINEL) {
        return Err(Error::Device(format!("'{}' left segment {i} out", gpu.info.name)));
    }
    let result = |r: SegmentResult| {
        let [red, green, blue, transmittance] = r.color;
        Integrated { color: [red, green, blue], transmittance, pieces: r.pieces }
    };
    Ok(results.into_iter().map(result).collect())
}

/// One kernel for all segments: it knows every kind that any of them has.
fn kernel(
    gpu: &Gpu,
    integral: SegmentIntegral,
    emission: EmissionModel,
    set: &WidgetSet,
    cases: usize,
) -> Result<Kernel> {
    let mut constants = set.constants();
    constants.retain(|(name, _)| *name != "ONE_COLOR");
    constants.extend(integral::constants(integral, emission));
    constants.push(("CASES", cases as f64));
    gpu.kernel("segments", &constants)
}
