//! The picture on the screen. egui's own shader filters by hand, in a branch that software rasterisers always run: a picture
//! took most of a frame's time. Where there is no wgpu (tests without a device), it is egui's after all.

use std::sync::Arc;

use eframe::egui::{self, Color32, ColorImage, Context, Painter, Rect, TextureHandle, TextureOptions, pos2};
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, RenderState, wgpu};

/// Draws pictures by one small pipeline.
pub struct Press {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipeline: wgpu::RenderPipeline,
    /// Smooth, and not.
    samplers: [wgpu::Sampler; 2],
    format: wgpu::TextureFormat,
}

/// Makes pictures that can be drawn.
#[derive(Clone, Default)]
pub struct Easel(Option<Arc<Press>>);

/// A picture that can be drawn.
pub enum Pane {
    /// By the small pipeline.
    Own(Arc<Press>, Arc<wgpu::BindGroup>),
    /// By egui.
    Common(TextureHandle),
}

impl Easel {
    /// For the window's device, where it has one.
    pub fn new(state: Option<&RenderState>) -> Self {
        Self(state.map(|state| Arc::new(Press::new(state))))
    }

    /// Takes a picture; `is_smooth`: its pixels are larger than the screen's.
    pub fn pane(&self, ctx: &Context, picture: ColorImage, is_smooth: bool) -> Pane {
        match &self.0 {
            Some(press) => Pane::Own(Arc::clone(press), Arc::new(press.upload(&picture, is_smooth))),
            None => {
                let options = if is_smooth { TextureOptions::LINEAR } else { TextureOptions::NEAREST };
                Pane::Common(ctx.load_texture("picture", picture, options))
            }
        }
    }
}

impl Pane {
    /// Over `rect`, of which the painter shows what it shows.
    pub fn draw(&self, painter: &Painter, rect: Rect) {
        match self {
            Self::Own(press, group) => {
                let print = Print { press: Arc::clone(press), group: Arc::clone(group) };
                painter.add(Callback::new_paint_callback(rect, print));
            }
            Self::Common(texture) => {
                let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                painter.image(texture.id(), rect, whole, Color32::WHITE);
            }
        }
    }
}

impl Press {
    fn new(state: &RenderState) -> Self {
        let device = &state.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("picture"),
            source: wgpu::ShaderSource::Wgsl(include_str!("../../shaders/viewer/picture.wgsl").into()),
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("picture"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("corner"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(state.target_format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let samplers = [wgpu::FilterMode::Linear, wgpu::FilterMode::Nearest].map(|filter| {
            device.create_sampler(&wgpu::SamplerDescriptor {
                mag_filter: filter,
                min_filter: filter,
                ..Default::default()
            })
        });
        // What the screen decodes is encoded again.
        let format = match state.target_format.is_srgb() {
            true => wgpu::TextureFormat::Rgba8UnormSrgb,
            false => wgpu::TextureFormat::Rgba8Unorm,
        };
        Self { device: device.clone(), queue: state.queue.clone(), pipeline, samplers, format }
    }

    fn upload(&self, picture: &ColorImage, is_smooth: bool) -> wgpu::BindGroup {
        let [width, height] = picture.size.map(|n| n as u32);
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: self.format,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
        self.queue.write_texture(texture.as_image_copy(), bytemuck::cast_slice(&picture.pixels), layout, size);
        let sampler = &self.samplers[usize::from(!is_smooth)];
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("picture"),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(&texture.create_view(&Default::default())),
                },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(sampler) },
            ],
        })
    }
}

/// A picture within egui's pass.
struct Print {
    press: Arc<Press>,
    group: Arc<wgpu::BindGroup>,
}

impl CallbackTrait for Print {
    fn paint(&self, _: egui::PaintCallbackInfo, pass: &mut wgpu::RenderPass<'static>, _: &CallbackResources) {
        pass.set_pipeline(&self.press.pipeline);
        pass.set_bind_group(0, &*self.group, &[]);
        pass.draw(0..3, 0..1);
    }
}
