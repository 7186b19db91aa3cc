//! Kernels specialised for a transfer function and a kind of projection: what a scene does not use is compiled away.

use crate::error::Result;
use crate::gpu::cover::Cover;
use crate::gpu::device::Gpu;
use crate::gpu::kernel::{DrawKernel, Kernel};
use crate::gpu::layout::BandTotals;
use crate::gpu::light::Shading;
use crate::gpu::ordering::Keys;
use crate::gpu::transfer::TransferBuffers;

/// What kernels are specialised to, besides the transfer function.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Variant {
    /// The kind of projection.
    pub perspective: bool,
    /// What is drawn of a cell.
    pub cover: Cover,
    /// Lighting and silhouettes.
    pub shading: Shading,
    /// Fragments are listed, not blended.
    pub lists: bool,
}

/// A scene's transfer function and kernels.
pub struct SceneKernels {
    /// The function.
    pub transfer: TransferBuffers,
    /// What else.
    pub variant: Variant,
    /// Marks cells that the function can make visible, and finds their bands.
    pub candidates: Kernel,
    /// What to draw at most, where cells are drawn span by span.
    pub spans: Option<Spans>,
    /// Projects vertices.
    pub vertices: Kernel,
    /// Drops cells outside the picture.
    cull: Kernel,
    /// The same where the near plane cuts cells; made when it first does.
    cull_near: Option<Kernel>,
    /// Counts to offsets.
    pub compact: Kernel,
    /// Lists survivors and their keys.
    keys: [Option<Kernel>; Keys::ALL.len()],
    /// Corners of a chunk.
    pub corners: Kernel,
    /// Draws a chunk.
    raster: [Option<DrawKernel>; 2],
    /// Counts and lists a chunk's fragments.
    pub lists: Option<ListKernels>,
    /// Finishes the picture.
    pub resolve: DrawKernel,
    /// f16 only.
    pub slabs: Option<SlabKernels>,
    constants: Vec<(&'static str, f64)>,
    f16: bool,
}

/// What lists fragments.
pub struct ListKernels {
    /// Counts those of each pixel.
    pub tally: DrawKernel,
    /// Lists them.
    pub list: DrawKernel,
}

/// What blending in slabs needs.
pub struct SlabKernels {
    /// A slab over those behind it.
    pub resolve: DrawKernel,
    /// The most layers in a slab.
    pub layers: Kernel,
}

/// Colour behind is scaled by the transmittance (in the source's alpha), and so is the transmittance behind.
pub const BACK_TO_FRONT: wgpu::BlendState = wgpu::BlendState {
    color: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::SrcAlpha,
        operation: wgpu::BlendOperation::Add,
    },
    alpha: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::Zero,
        dst_factor: wgpu::BlendFactor::SrcAlpha,
        operation: wgpu::BlendOperation::Add,
    },
};

const ADD: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::One,
    dst_factor: wgpu::BlendFactor::One,
    operation: wgpu::BlendOperation::Add,
};

/// By how many pixels an outline may be drawn too large, so that each edge moves out by a hair.
pub const LONGEST_HAIR: f64 = 64.0;

/// A target of a draw.
pub fn target(format: wgpu::TextureFormat, blend: Option<wgpu::BlendState>) -> Option<wgpu::ColorTargetState> {
    Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL })
}

/// The spans of the cells that a function can make visible (`shared/bands.wgsl`).
#[derive(Clone, Copy, Debug)]
pub struct Spans {
    /// How many.
    pub count: u32,
    /// At most, of one cell.
    pub most: u32,
    /// They are pairs of bands.
    pub paired: bool,
    /// Some are of deep cells.
    pub deep: bool,
}

impl Spans {
    /// Bands, or pairs of them.
    pub fn of(totals: BandTotals, paired: bool) -> Self {
        let (count, most) = if paired { (totals.pairs, totals.most.div_ceil(2)) } else { (totals.bands, totals.most) };
        Self { count, most, paired, deep: totals.deep > 0 }
    }
}

/// The kernel that marks the cells that a function can make visible, and finds their bands.
///
/// # Errors
/// A shader that does not compile.
pub fn candidates(gpu: &Gpu, transfer: &TransferBuffers, extra: &[(&'static str, f64)]) -> Result<Kernel> {
    gpu.kernel("candidates", &[&transfer.constants[..], extra].concat())
}

impl SceneKernels {
    /// Compiles. `f16`: blend into rgba16float and count layers; `candidates`: see [`candidates`]; `spans`: what is drawn
    /// instead of cells; `extra`: constants of the renderer.
    ///
    /// # Errors
    /// A shader that does not compile.
    pub fn new(
        gpu: &Gpu,
        transfer: TransferBuffers,
        variant: Variant,
        f16: bool,
        candidates: Kernel,
        spans: Option<Spans>,
        extra: &[(&'static str, f64)],
    ) -> Result<Self> {
        let flag = |b: bool| f64::from(u8::from(b));
        let mut constants = transfer.constants.clone();
        constants.extend_from_slice(extra);
        constants.push(("PERSPECTIVE", flag(variant.perspective)));
        constants.extend_from_slice(&variant.shading.constants());
        constants.push(("BANDS", flag(spans.is_some())));
        constants.push(("LONGEST_HAIR", LONGEST_HAIR));
        constants.push(("INDICES", f64::from(variant.cover.indices())));
        constants.push(("PAIRED", flag(spans.is_some_and(|s| s.paired))));
        let slab_constants = [&constants[..], &[("SLAB", 1.0)]].concat();
        let full = ["vertex", "fragment"];
        let resolve = |constants: &[_]| {
            let targets = [target(wgpu::TextureFormat::Rgba32Float, None)];
            gpu.draw_kernel("resolve", full, constants, &targets, &[], None)
        };
        Ok(Self {
            variant,
            spans,
            candidates,
            vertices: gpu.kernel("vertices", &constants)?,
            cull: gpu.kernel("cull", &constants)?,
            cull_near: None,
            compact: gpu.kernel("compact", &constants)?,
            keys: Default::default(),
            corners: gpu.kernel(variant.cover.pass(), &constants)?,
            f16,
            raster: Default::default(),
            lists: None,
            resolve: resolve(&constants)?,
            slabs: match f16 {
                false => None,
                true => Some(SlabKernels { resolve: resolve(&slab_constants)?, layers: gpu.kernel("layers", &[])? }),
            },
            transfer,
            constants,
        })
    }

    /// Makes the cull pass of frames in which the near plane cuts cells.
    ///
    /// # Errors
    /// A shader that does not compile.
    pub fn need_near_cut(&mut self, gpu: &Gpu) -> Result<()> {
        if self.cull_near.is_none() {
            let constants = [&self.constants[..], &[("NEAR_CUT", 1.0)]].concat();
            self.cull_near = Some(gpu.kernel("cull", &constants)?);
        }
        Ok(())
    }

    /// Makes the pass that lists survivors, with such keys.
    ///
    /// # Errors
    /// A shader that does not compile.
    pub fn need_keys(&mut self, gpu: &Gpu, keys: Keys) -> Result<()> {
        if self.keys(keys).is_none() {
            let constants = [&self.constants[..], &[keys.constant()]].concat();
            self.keys[keys as usize] = Some(gpu.kernel("keys", &constants)?);
        }
        Ok(())
    }

    /// The pass that lists survivors, after [`Self::need_keys`].
    pub fn keys(&self, keys: Keys) -> Option<&Kernel> {
        self.keys[keys as usize].as_ref()
    }

    /// Makes the raster pass; `deep`: spans may be of deep cells.
    ///
    /// # Errors
    /// A shader that does not compile.
    pub fn need_raster(&mut self, gpu: &Gpu, deep: bool) -> Result<()> {
        if self.raster(deep).is_some() {
            return Ok(());
        }
        let targets = if self.f16 {
            let count = wgpu::BlendState { color: ADD, alpha: ADD };
            vec![
                target(wgpu::TextureFormat::Rgba16Float, Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING)),
                target(wgpu::TextureFormat::R16Float, Some(count)),
            ]
        } else {
            vec![target(wgpu::TextureFormat::Rgba32Float, Some(BACK_TO_FRONT))]
        };
        let kernel = self.cell_kernel(gpu, "raster", if self.f16 { "_counted" } else { "" }, deep, &targets)?;
        self.raster[usize::from(deep)] = Some(kernel);
        Ok(())
    }

    /// Makes the passes that list fragments.
    ///
    /// # Errors
    /// A shader that does not compile.
    pub fn need_lists(&mut self, gpu: &Gpu) -> Result<()> {
        if self.lists.is_none() {
            let write_mask = wgpu::ColorWrites::empty();
            let format = if self.f16 { wgpu::TextureFormat::Rgba16Float } else { wgpu::TextureFormat::Rgba32Float };
            let target = wgpu::ColorTargetState { format, blend: None, write_mask };
            let kernel = |end: &'static str| {
                self.cell_kernel(gpu, "listed", end, true, std::slice::from_ref(&Some(target.clone())))
            };
            self.lists = Some(ListKernels { tally: kernel("fragment_tally")?, list: kernel("_listed")? });
        }
        Ok(())
    }

    /// A pass that draws cells; `ending`: of the fragment entry point, or all of its name.
    fn cell_kernel(
        &self,
        gpu: &Gpu,
        pass: &'static str,
        ending: &'static str,
        deep: bool,
        targets: &[Option<wgpu::ColorTargetState>],
    ) -> Result<DrawKernel> {
        let kind = CornerKind {
            bivariate: self.transfer.bivariate,
            in_spans: self.spans.is_some(),
            shaded: self.variant.shading.is_on(),
        };
        let constants = [&self.constants[..], &[("DEEP", f64::from(u8::from(deep)))]].concat();
        kind.kernel(gpu, [pass, ending], self.variant.cover, &constants, targets)
    }

    /// The raster pass, after [`Self::need_raster`].
    pub fn raster(&self, deep: bool) -> Option<&DrawKernel> {
        self.raster[usize::from(deep)].as_ref()
    }

    /// The cull pass; `near_cut` only after [`Self::need_near_cut`].
    pub fn cull(&self, near_cut: bool) -> &Kernel {
        self.cull_near.as_ref().filter(|_| near_cut).unwrap_or(&self.cull)
    }
}

/// What the corners of cells hold.
#[derive(Clone, Copy, Debug)]
pub struct CornerKind {
    /// Gradient magnitudes.
    pub bivariate: bool,
    /// The span that is drawn.
    pub in_spans: bool,
    /// Gradient vectors.
    pub shaded: bool,
}

impl CornerKind {
    /// A pass that draws cells, and the ending of its fragment entry point, or all of that one's name.
    ///
    /// # Errors
    /// A shader that does not compile.
    pub fn kernel(
        self,
        gpu: &Gpu,
        [pass, ending]: [&'static str; 2],
        cover: Cover,
        constants: &[(&'static str, f64)],
        targets: &[Option<wgpu::ColorTargetState>],
    ) -> Result<DrawKernel> {
        let attributes = corner_attributes(self.bivariate, self.in_spans, self.shaded);
        let array_stride = attributes.iter().map(|a| a.format.size()).sum();
        let corners =
            wgpu::VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes: &attributes };
        let [vertex, fragment] = raster_entries(self.bivariate, self.in_spans, self.shaded, ending);
        let entries = [vertex.as_str(), fragment.as_str()];
        gpu.draw_kernel(pass, entries, constants, targets, &[Some(corners)], cover.culled())
    }
}

/// What `project` and `faces` write of a corner, in order.
fn corner_attributes(bivariate: bool, in_spans: bool, shaded: bool) -> Vec<wgpu::VertexAttribute> {
    use wgpu::VertexFormat::{Float32, Float32x2, Float32x3, Float32x4};
    let mut formats: Vec<_> = (0..5).map(|location| (location, Float32x4)).collect();
    match (bivariate, in_spans) {
        (true, _) => formats.extend([(5, Float32x2), (6, Float32x3)]),
        (false, true) => formats.push((5, Float32x2)),
        (false, false) => formats.push((5, Float32)),
    }
    if shaded {
        formats.extend((7..11).map(|location| (location, Float32x3)));
    }
    let mut offset = 0;
    let attribute = |(shader_location, format): (u32, wgpu::VertexFormat)| {
        let attribute = wgpu::VertexAttribute { format, offset, shader_location };
        offset += format.size();
        attribute
    };
    formats.into_iter().map(attribute).collect()
}

/// Entry points of `raster` and `listed`; `ending`: of the fragment's, or all of its name.
fn raster_entries(bivariate: bool, in_spans: bool, shaded: bool, ending: &str) -> [String; 2] {
    let kind = match (bivariate, in_spans) {
        (true, _) => "_bivariate",
        (false, true) => "_band",
        (false, false) => "",
    };
    let shaded = if shaded { "_shaded" } else { "" };
    let fragment =
        if ending.starts_with("fragment") { ending.to_owned() } else { format!("fragment{kind}{shaded}{ending}") };
    [format!("vertex{kind}{shaded}"), fragment]
}
