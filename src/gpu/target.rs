//! The textures of a picture.

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::record::Recorder;
use crate::image::Image;

/// What is drawn into.
pub struct Target {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Cells blended back to front: premultiplied colour, transmittance.
    pub blended: wgpu::TextureView,
    /// The finished picture: premultiplied colour, opacity.
    pub picture: wgpu::TextureView,
    /// f16 only.
    pub slabs: Option<SlabTarget>,
    picture_texture: wgpu::Texture,
}

/// What blending in slabs draws into besides.
pub struct SlabTarget {
    /// Layers of the slab at each pixel.
    pub layers: wgpu::TextureView,
    /// Resolved slabs, each over the ones before, in turns.
    pub resolved: [wgpu::TextureView; 2],
}

impl Target {
    /// Textures of this size; `f16`: blend into slabs.
    ///
    /// # Errors
    /// A size that the device does not have.
    pub fn new(gpu: &Gpu, size: [u32; 2], f16: bool) -> Result<Self> {
        let limits = gpu.device.limits();
        let most = limits.max_texture_dimension_2d;
        let too_large = row_bytes(size[0]) * u64::from(size[1]) > limits.max_buffer_size;
        if size.iter().any(|&side| side == 0 || side > most) || too_large {
            return Err(Error::Asked(format!(
                "a picture of {}x{} pixels is not possible on '{}': each side must be 1 to {most}, and 16 bytes a \
                 pixel fit {} MiB",
                size[0],
                size[1],
                gpu.info.name,
                limits.max_buffer_size >> 20
            )));
        }
        let texture = |label, format, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let bound = wgpu::TextureUsages::TEXTURE_BINDING;
        let f32_format = wgpu::TextureFormat::Rgba32Float;
        let blend_format = if f16 { wgpu::TextureFormat::Rgba16Float } else { f32_format };
        let picture_texture = texture(
            "picture",
            f32_format,
            bound | wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::STORAGE_BINDING,
        );
        Ok(Self {
            size,
            blended: view(&texture("blended", blend_format, bound)),
            picture: view(&picture_texture),
            slabs: f16.then(|| SlabTarget {
                layers: view(&texture("layers", wgpu::TextureFormat::R16Float, bound)),
                resolved: [0, 1].map(|_| view(&texture("resolved", f32_format, bound))),
            }),
            picture_texture,
        })
    }

    /// The finished picture.
    ///
    /// # Errors
    /// A lost device.
    pub fn read(&self, gpu: &Gpu) -> Result<Image> {
        let [width, height] = self.size;
        let row = row_bytes(width);
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        let staging = gpu.buffer("picture, mapped", row * u64::from(height), usage);
        let mut recorder = Recorder::new(gpu, false);
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row as u32), rows_per_image: None };
        recorder.encoder().copy_texture_to_buffer(
            self.picture_texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &staging, layout },
            self.picture_texture.size(),
        );
        recorder.submit();
        let texels: Vec<[f32; 4]> = gpu.map(&staging, row * u64::from(height))?;
        let mut image = Image::new(width, height);
        let rows = texels.chunks_exact((row / 16) as usize).zip(image.pixels.chunks_exact_mut(width as usize));
        for (from, to) in rows {
            to.copy_from_slice(&from[..width as usize]);
        }
        Ok(image)
    }
}

/// Bytes of a row of a read-back picture.
fn row_bytes(width: u32) -> u64 {
    (u64::from(width) * 16).next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT))
}
