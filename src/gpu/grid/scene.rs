//! A grid's kernels for a transfer function and a kind of projection, and the bricks that the function can show.

use crate::error::Result;
use crate::gpu::cover::Cover;
use crate::gpu::device::Gpu;
use crate::gpu::grid::store::GridStore;
use crate::gpu::kernel::{DrawKernel, Kernel, Resources};
use crate::gpu::layout::{self, BrickCount};
use crate::gpu::light::Shading;
use crate::gpu::record::{Recorder, Work};
use crate::gpu::renderer::PAIRS_PAY;
use crate::gpu::scene::{BACK_TO_FRONT, CornerKind, LONGEST_HAIR, Spans, target};
use crate::gpu::store::DEEP_SPAN;
use crate::gpu::transfer::TransferBuffers;
use crate::renderer::{SegmentIntegral, Settings};
use crate::scene::{EmissionModel, TransferFunction};

/// A brick that the function can show.
#[derive(Clone, Copy, Debug)]
pub struct ShownBrick {
    /// Along each axis.
    pub at: [usize; 3],
    /// Tetrahedra that it can show.
    pub cells: u32,
    /// Of them, or of their spans, what is listed at most.
    pub listed: u32,
}

/// A scene's transfer function and kernels.
pub struct GridScene {
    /// The function.
    pub transfer: TransferBuffers,
    /// The kind of projection.
    pub perspective: bool,
    /// What to draw instead of cells.
    pub spans: Option<Spans>,
    /// The bricks to visit, in no order.
    pub shown: Vec<ShownBrick>,
    /// Marks a batch's tetrahedra.
    pub cull: Kernel,
    /// Counts to offsets.
    pub compact: Kernel,
    /// Lists a batch's tetrahedra.
    pub list: Kernel,
    /// Corners of a chunk.
    pub project: Kernel,
    /// Puts the picture of what is near before the rest.
    pub near: DrawKernel,
    /// Finishes the picture.
    pub resolve: DrawKernel,
    /// Draws a chunk.
    pub raster: Option<DrawKernel>,
    constants: Vec<(&'static str, f64)>,
}

impl GridScene {
    /// Compiles, and finds the bricks that can be seen.
    ///
    /// # Errors
    /// A shader that does not compile; a lost device.
    pub fn new(
        gpu: &Gpu,
        store: &GridStore,
        transfer: TransferBuffers,
        perspective: bool,
        settings: Settings,
    ) -> Result<Self> {
        let flag = |b: bool| f64::from(u8::from(b));
        let weighted = transfer.emission == EmissionModel::Weighted;
        let mut constants = transfer.constants.clone();
        constants.push(store.samples.constant());
        // What is transparent glows, too, where emission is not weighted by extinction.
        constants.push(("CULL", flag(settings.cull && weighted)));
        let counts = count_bricks(gpu, store, &transfer, &constants)?;
        // Spans are drawn by the exact integral.
        let exact = matches!(settings.integral, SegmentIntegral::Analytic | SegmentIntegral::Adaptive { .. });
        let curve = matches!(transfer.source, TransferFunction::Curve(_));
        let spans = if curve && exact && weighted { spans(&counts) } else { None };
        let listed = |count: &BrickCount| match spans {
            None => count.cells,
            Some(spans) => {
                if spans.paired {
                    count.pairs
                } else {
                    count.bands
                }
            }
        };
        let shown = counts
            .iter()
            .map(|(at, count)| ShownBrick { at: *at, cells: count.cells, listed: listed(count) })
            .collect();
        constants.push(("PERSPECTIVE", flag(perspective)));
        constants.extend_from_slice(&Shading::default().constants());
        constants.push(("BANDS", flag(spans.is_some())));
        constants.push(("PAIRED", flag(spans.is_some_and(|s| s.paired))));
        constants.push(("LONGEST_HAIR", LONGEST_HAIR));
        constants.push(("INDICES", f64::from(Cover::Outline.indices())));
        let f32_format = wgpu::TextureFormat::Rgba32Float;
        let draw = |pass, blend| {
            gpu.draw_kernel(pass, ["vertex", "fragment"], &constants, &[target(f32_format, blend)], &[], None)
        };
        Ok(Self {
            perspective,
            spans,
            shown,
            cull: gpu.kernel("grid_cull", &constants)?,
            compact: gpu.kernel("compact", &constants)?,
            list: gpu.kernel("grid_list", &constants)?,
            project: gpu.kernel("grid_project", &constants)?,
            near: draw("grid_near", Some(BACK_TO_FRONT))?,
            resolve: draw("resolve", None)?,
            raster: None,
            transfer,
            constants,
        })
    }

    /// Makes the raster pass.
    ///
    /// # Errors
    /// A shader that does not compile.
    pub fn need_raster(&mut self, gpu: &Gpu) -> Result<()> {
        if self.raster.is_none() {
            let kind = CornerKind { bivariate: self.transfer.bivariate, in_spans: self.spans.is_some(), shaded: false };
            let deep = self.spans.is_none_or(|spans| spans.deep);
            let constants = [&self.constants[..], &[("DEEP", f64::from(u8::from(deep)))]].concat();
            let targets = [target(wgpu::TextureFormat::Rgba32Float, Some(BACK_TO_FRONT))];
            let kernel = kind.kernel(gpu, ["raster", ""], Cover::Outline, &constants, &targets)?;
            self.raster = Some(kernel);
        }
        Ok(())
    }
}

/// What a brick is called in lists.
pub fn packed(at: [usize; 3]) -> u32 {
    (at[0] | at[1] << 10 | at[2] << 20) as u32
}

/// What [`packed`] was made of.
pub fn unpacked(brick: u32) -> [usize; 3] {
    [brick & 1023, brick >> 10 & 1023, brick >> 20].map(|n| n as usize)
}

/// Spans, in the form of which fewer are drawn, where no cell has too many.
fn spans(counts: &[([usize; 3], BrickCount)]) -> Option<Spans> {
    let sum = |of: fn(&BrickCount) -> u32| counts.iter().map(|(_, c)| f64::from(of(c))).sum::<f64>();
    let most = counts.iter().map(|(_, c)| c.most & 0xffff).max().unwrap_or(0);
    let deep = counts.iter().any(|(_, c)| c.most > 0xffff);
    let paired = sum(|c| c.bands) > PAIRS_PAY * sum(|c| c.pairs) || most > DEEP_SPAN;
    let most = if paired { most.div_ceil(2) } else { most };
    // Batches count for themselves.
    (most <= DEEP_SPAN).then_some(Spans { count: 0, most, paired, deep })
}

/// The bricks that the function can show by the ranges of their samples, and what they can show by their tetrahedra;
/// those that can show nothing are left out.
fn count_bricks(
    gpu: &Gpu,
    store: &GridStore,
    transfer: &TransferBuffers,
    constants: &[(&'static str, f64)],
) -> Result<Vec<([usize; 3], BrickCount)>> {
    let [nx, ny, nz] = store.samples.bricks_along;
    let bricks = nx * ny * nz;
    let copied = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
    let shown = gpu.buffer("shown", bricks as u64 * 4, copied);
    let frame = gpu.uniform("frame", &[layout::Frame { vertex_count: bricks as u32, ..Default::default() }]);
    let held = transfer.offer(store.resources());
    let run = |name, resources: Resources<'_>, work| {
        let kernel = gpu.kernel(name, constants)?;
        let mut recorder = Recorder::new(gpu, false);
        recorder.compute(&kernel, &kernel.bind(gpu, &resources)?, work)?;
        recorder.submit();
        Ok(())
    };
    run("grid_bricks", held.clone().with("frame", &frame).with("shown", &shown), Work::Items(bricks as u32))?;
    let flags: Vec<u32> = gpu.read(&shown, bricks as u64 * 4)?;
    let at = |brick: usize| [brick % nx, brick / nx % ny, brick / nx / ny];
    let places: Vec<[usize; 3]> = (0..bricks).filter(|&b| flags[b] != 0).map(at).collect();
    if places.is_empty() {
        return Ok(Vec::new());
    }
    let list = gpu.storage("bricks", &places.iter().map(|&at| packed(at)).collect::<Vec<u32>>());
    let bytes = (places.len() * size_of::<BrickCount>()) as u64;
    let counted = gpu.buffer("brick_counts", bytes, copied);
    let frame = gpu.uniform("frame", &[layout::Frame { tet_count: places.len() as u32 * 256, ..Default::default() }]);
    let resources = held.with("frame", &frame).with("bricks", &list).with("brick_counts", &counted);
    run("grid_candidates", resources, Work::Groups(places.len() as u32))?;
    let counts: Vec<BrickCount> = gpu.read(&counted, bytes)?;
    Ok(places.into_iter().zip(counts).filter(|(_, count)| count.cells > 0).collect())
}
