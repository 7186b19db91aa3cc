//! The device: which adapter, with what, and the kernels made for it.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use crate::error::{Error, Result};
use crate::gpu::shader::{Binding, BindingKind, Module};

/// What the largest shader of projection binds.
const MOST_STORAGE_BUFFERS: u32 = 13;

/// Which adapters may be used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DeviceChoice {
    /// Any; hardware is preferred.
    #[default]
    Any,
    /// A software adapter only.
    Software,
    /// A hardware adapter only.
    Hardware,
}

/// An opened device; clones are the same one.
#[derive(Clone)]
pub struct Gpu {
    /// wgpu's device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Adapter, driver, back end.
    pub info: wgpu::AdapterInfo,
    /// Largest storage binding that is used, bytes.
    pub max_binding: u64,
    // What the device complained of first, and nobody was told yet.
    complaint: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// Opens the best adapter of the choice.
    ///
    /// # Errors
    /// No such adapter; the adapter's own refusal.
    pub fn new(choice: DeviceChoice) -> Result<Self> {
        Self::with_binding_limit(choice, u64::MAX)
    }

    /// The same with storage bindings kept at or below `limit` bytes: how small adapters are tested on large ones.
    ///
    /// # Errors
    /// As [`Gpu::new`].
    pub fn with_binding_limit(choice: DeviceChoice, limit: u64) -> Result<Self> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
        adapters.retain(|a| match choice {
            DeviceChoice::Any => true,
            DeviceChoice::Software => is_software(&a.get_info()),
            DeviceChoice::Hardware => !is_software(&a.get_info()),
        });
        adapters.sort_by_key(|a| preference(a.get_info().device_type));
        let mut refusal = None;
        for adapter in adapters {
            match Self::open(&adapter, limit) {
                Ok(gpu) => return Ok(gpu),
                Err(error) => refusal = Some(error),
            }
        }
        Err(refusal.unwrap_or_else(|| {
            let kind = match choice {
                DeviceChoice::Any => "graphics",
                DeviceChoice::Software => "software graphics",
                DeviceChoice::Hardware => "hardware graphics",
            };
            Error::Device(format!(
                "no {kind} adapter was found; install a Vulkan driver (mesa-vulkan-drivers has a software one), \
                 or render with --device cpu"
            ))
        }))
    }

    fn open(adapter: &wgpu::Adapter, limit: u64) -> Result<Self> {
        let info = adapter.get_info();
        let wanted = wgpu::Features::TIMESTAMP_QUERY | wgpu::Features::FLOAT32_BLENDABLE;
        let limits = adapter.limits();
        if limits.max_storage_buffers_per_shader_stage < MOST_STORAGE_BUFFERS {
            return Err(Error::Device(format!(
                "'{}' binds {} storage buffers to a shader, and {MOST_STORAGE_BUFFERS} are needed; render with \
                 --device cpu",
                info.name, limits.max_storage_buffers_per_shader_stage
            )));
        }
        let max_binding = limits.max_storage_buffer_binding_size.min(limit);
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("tetralux"),
            required_features: adapter.features() & wanted,
            required_limits: limits,
            ..Default::default()
        }))
        .map_err(|e| Error::Device(format!("the adapter '{}' refused: {e}", info.name)))?;
        let complaint = Arc::new(Mutex::new(None));
        let heard = Arc::clone(&complaint);
        // Otherwise wgpu panics, on running out of memory too.
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            heard.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_with(|| error.to_string());
        }));
        Ok(Self { device, queue, info, max_binding, complaint })
    }

    /// True where shaders run on the host's cores.
    pub fn is_software(&self) -> bool {
        is_software(&self.info)
    }

    /// True where rgba32float can be blended.
    pub fn blends_f32(&self) -> bool {
        self.device.features().contains(wgpu::Features::FLOAT32_BLENDABLE)
    }

    /// Adapter, driver and back end in one line.
    pub fn describe(&self) -> String {
        let i = &self.info;
        format!("{} ({} {}, {:?})", i.name, i.driver, i.driver_info, i.backend)
    }

    /// Waits until all submitted work is done.
    ///
    /// # Errors
    /// A lost device; whatever it complained of since the last call (memory that ran out, say).
    pub fn wait(&self) -> Result<()> {
        let polled = self.device.poll(wgpu::PollType::wait_indefinitely());
        if let Some(text) = self.complaint.lock().unwrap_or_else(PoisonError::into_inner).take() {
            return Err(Error::Device(format!("'{}' failed: {}", self.info.name, text.trim())));
        }
        polled.map(|_| ()).map_err(|e| Error::Device(format!("the device stopped answering: {e}")))
    }

    /// An empty buffer of at least 16 bytes.
    pub fn buffer(&self, label: &str, bytes: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes.max(16).next_multiple_of(16),
            usage,
            mapped_at_creation: false,
        })
    }

    /// A storage buffer holding `data`.
    pub fn storage<T: bytemuck::Pod>(&self, label: &str, data: &[T]) -> wgpu::Buffer {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        let buffer = self.buffer(label, bytes.len() as u64, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST);
        self.write(&buffer, 0, bytes);
        buffer
    }

    /// A uniform buffer holding `data`.
    pub fn uniform<T: bytemuck::Pod>(&self, label: &str, data: &[T]) -> wgpu::Buffer {
        let bytes: &[u8] = bytemuck::cast_slice(data);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let buffer = self.buffer(label, bytes.len() as u64, usage);
        self.write(&buffer, 0, bytes);
        buffer
    }

    /// Writes `bytes` (a multiple of 4) in parts: a write is staged, and staging a whole mesh at once would double it.
    pub fn write(&self, buffer: &wgpu::Buffer, offset: u64, bytes: &[u8]) {
        const PART: usize = 16 << 20;
        for (i, part) in bytes.chunks(PART).enumerate() {
            self.queue.write_buffer(buffer, offset + (i * PART) as u64, part);
            if part.len() == PART {
                self.queue.submit([]);
            }
        }
    }

    /// The first `bytes` of `buffer` (which allows mapping), after all submitted work.
    ///
    /// # Errors
    /// A lost device.
    pub fn map<T: bytemuck::Pod>(&self, buffer: &wgpu::Buffer, bytes: u64) -> Result<Vec<T>> {
        let slice = buffer.slice(..bytes);
        slice.map_async(wgpu::MapMode::Read, |_| {});
        self.wait()?;
        let view = slice.get_mapped_range().map_err(|e| Error::Device(format!("a result could not be mapped: {e}")))?;
        let data = bytemuck::pod_collect_to_vec(&view);
        drop(view);
        buffer.unmap();
        Ok(data)
    }

    /// The first `bytes` of `buffer` (which allows copying from), after all submitted work.
    ///
    /// # Errors
    /// A lost device.
    pub fn read<T: bytemuck::Pod>(&self, buffer: &wgpu::Buffer, bytes: u64) -> Result<Vec<T>> {
        if bytes == 0 {
            return Ok(Vec::new());
        }
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        let mapped = self.buffer("read back", bytes, usage);
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &mapped, 0, bytes);
        self.queue.submit([encoder.finish()]);
        self.map(&mapped, bytes)
    }

    /// A compute kernel, specialised by `constants`.
    ///
    /// # Errors
    /// The shader does not compile, or binds more than the device does.
    pub fn kernel(&self, name: &'static str, constants: &[(&str, f64)]) -> Result<Kernel> {
        let module = Module::new(name)?;
        let (needed, most) = (storage_buffers(&module), self.device.limits().max_storage_buffers_per_shader_stage);
        if needed > most {
            return Err(Error::Device(format!(
                "'{}' binds {most} storage buffers to a shader, and '{name}' needs {needed}; use --method project, or \
                 --device cpu",
                self.info.name
            )));
        }
        let layouts = self.layouts(&module);
        let shader = self.shader(&module);
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: Some(&self.pipeline_layout(name, &layouts)),
            module: &shader,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &known_constants(&module, constants),
                zero_initialize_workgroup_memory: false,
            },
            cache: None,
        });
        Ok(Kernel { name, pipeline, bindings: module.bindings, layouts })
    }

    /// A render kernel drawing triangles, but for those `culled`; `entries` names the vertex and fragment entry points.
    ///
    /// # Errors
    /// The shader does not compile.
    pub fn draw_kernel(
        &self,
        module: Module,
        entries: [&str; 2],
        constants: &[(&str, f64)],
        targets: &[Option<wgpu::ColorTargetState>],
        vertex_buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
        culled: Option<wgpu::Face>,
    ) -> Result<DrawKernel> {
        let name = module.name;
        let layouts = self.layouts(&module);
        let shader = self.shader(&module);
        let constants = known_constants(&module, constants);
        let options =
            wgpu::PipelineCompilationOptions { constants: &constants, zero_initialize_workgroup_memory: false };
        let pipeline = self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(name),
            layout: Some(&self.pipeline_layout(name, &layouts)),
            vertex: wgpu::VertexState {
                module: &shader,
                entry_point: Some(entries[0]),
                compilation_options: options.clone(),
                buffers: vertex_buffers,
            },
            primitive: wgpu::PrimitiveState { cull_mode: culled, ..Default::default() },
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &shader,
                entry_point: Some(entries[1]),
                compilation_options: options,
                targets,
            }),
            multiview_mask: None,
            cache: None,
        });
        Ok(DrawKernel { name, pipeline, bindings: module.bindings, layouts })
    }

    fn shader(&self, module: &Module) -> wgpu::ShaderModule {
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(module.name),
            source: wgpu::ShaderSource::Wgsl(module.source.as_str().into()),
        })
    }

    fn layouts(&self, module: &Module) -> Vec<wgpu::BindGroupLayout> {
        let groups = module.bindings.iter().map(|b| b.group + 1).max().unwrap_or(0);
        (0..groups)
            .map(|group| {
                let entries: Vec<_> = module.bindings.iter().filter(|b| b.group == group).map(layout_entry).collect();
                self.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                    label: Some(module.name),
                    entries: &entries,
                })
            })
            .collect()
    }

    fn pipeline_layout(&self, name: &str, layouts: &[wgpu::BindGroupLayout]) -> wgpu::PipelineLayout {
        let groups: Vec<_> = layouts.iter().map(Some).collect();
        self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(name),
            bind_group_layouts: &groups,
            immediate_size: 0,
        })
    }

    /// Bind groups for a kernel's bindings, each found by its variable's name.
    ///
    /// # Errors
    /// A binding that `resources` lacks: named with its pass.
    pub fn bind(
        &self,
        name: &str,
        bindings: &[Binding],
        layouts: &[wgpu::BindGroupLayout],
        resources: &Resources<'_>,
    ) -> Result<Vec<wgpu::BindGroup>> {
        (0u32..)
            .zip(layouts)
            .map(|(group, layout)| {
                let entries = bindings
                    .iter()
                    .filter(|b| b.group == group)
                    .map(|b| {
                        let resource = resources.0.get(b.name.as_str()).cloned().ok_or_else(|| {
                            Error::Device(format!("pass '{name}' binds '{}', which nobody offers", b.name))
                        })?;
                        Ok(wgpu::BindGroupEntry { binding: b.index, resource })
                    })
                    .collect::<Result<Vec<_>>>()?;
                Ok(self.device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some(name),
                    layout,
                    entries: &entries,
                }))
            })
            .collect()
    }
}

/// A compute pipeline and what it binds.
pub struct Kernel {
    /// The pass's name.
    pub name: &'static str,
    /// Specialised pipeline.
    pub pipeline: wgpu::ComputePipeline,
    /// Used bindings.
    pub bindings: Vec<Binding>,
    layouts: Vec<wgpu::BindGroupLayout>,
}

impl Kernel {
    /// Bind groups from named resources.
    ///
    /// # Errors
    /// A binding without a resource.
    pub fn bind(&self, gpu: &Gpu, resources: &Resources<'_>) -> Result<Vec<wgpu::BindGroup>> {
        gpu.bind(self.name, &self.bindings, &self.layouts, resources)
    }
}

/// A render pipeline and what it binds.
pub struct DrawKernel {
    /// The pass's name.
    pub name: &'static str,
    /// Specialised pipeline.
    pub pipeline: wgpu::RenderPipeline,
    /// Used bindings.
    pub bindings: Vec<Binding>,
    layouts: Vec<wgpu::BindGroupLayout>,
}

impl DrawKernel {
    /// Bind groups from named resources.
    ///
    /// # Errors
    /// A binding without a resource.
    pub fn bind(&self, gpu: &Gpu, resources: &Resources<'_>) -> Result<Vec<wgpu::BindGroup>> {
        gpu.bind(self.name, &self.bindings, &self.layouts, resources)
    }
}

/// Resources by the names that shaders give them.
#[derive(Clone, Default)]
pub struct Resources<'a>(HashMap<&'static str, wgpu::BindingResource<'a>>);

impl<'a> Resources<'a> {
    /// Adds or replaces a whole buffer.
    #[must_use]
    pub fn with(mut self, name: &'static str, buffer: &'a wgpu::Buffer) -> Self {
        self.0.insert(name, buffer.as_entire_binding());
        self
    }

    /// Adds or replaces `size` bytes of a buffer from `offset`.
    #[must_use]
    pub fn with_part(mut self, name: &'static str, buffer: &'a wgpu::Buffer, offset: u64, size: u64) -> Self {
        let binding = wgpu::BufferBinding { buffer, offset, size: std::num::NonZeroU64::new(size) };
        self.0.insert(name, wgpu::BindingResource::Buffer(binding));
        self
    }

    /// Adds or replaces a texture.
    #[must_use]
    pub fn with_texture(mut self, name: &'static str, view: &'a wgpu::TextureView) -> Self {
        self.0.insert(name, wgpu::BindingResource::TextureView(view));
        self
    }
}

fn layout_entry(binding: &Binding) -> wgpu::BindGroupLayoutEntry {
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    wgpu::BindGroupLayoutEntry {
        binding: binding.index,
        visibility: binding.stages,
        ty: match binding.kind {
            BindingKind::Uniform => buffer(wgpu::BufferBindingType::Uniform),
            BindingKind::Read => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
            BindingKind::ReadWrite => buffer(wgpu::BufferBindingType::Storage { read_only: false }),
            BindingKind::Texture => wgpu::BindingType::Texture {
                sample_type: wgpu::TextureSampleType::Float { filterable: false },
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            BindingKind::WriteTexture => wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::WriteOnly,
                format: wgpu::TextureFormat::Rgba32Float,
                view_dimension: wgpu::TextureViewDimension::D2,
            },
        },
        count: None,
    }
}

/// The constants that the module declares: one list serves all passes of a scene.
fn known_constants<'a>(module: &Module, constants: &[(&'a str, f64)]) -> Vec<(&'a str, f64)> {
    let declared = |name: &str| module.naga.overrides.iter().any(|(_, o)| o.name.as_deref() == Some(name));
    constants.iter().copied().filter(|(name, _)| declared(name)).collect()
}

/// Storage buffers that a pass binds.
fn storage_buffers(module: &Module) -> u32 {
    let storage = |b: &&Binding| matches!(b.kind, BindingKind::Read | BindingKind::ReadWrite);
    module.bindings.iter().filter(storage).count() as u32
}

fn is_software(info: &wgpu::AdapterInfo) -> bool {
    info.device_type == wgpu::DeviceType::Cpu
}

fn preference(device_type: wgpu::DeviceType) -> u8 {
    match device_type {
        wgpu::DeviceType::DiscreteGpu => 0,
        wgpu::DeviceType::IntegratedGpu => 1,
        wgpu::DeviceType::VirtualGpu => 2,
        wgpu::DeviceType::Other => 3,
        wgpu::DeviceType::Cpu => 4,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::pass_names;

    #[test]
    fn no_pass_of_projection_binds_more_than_is_asked_for() {
        let of_rays = ["raycast", "raylist", "occupied"];
        let count = |pass| storage_buffers(&Module::new(pass).expect("a pass"));
        let most = pass_names().filter(|pass| !of_rays.contains(pass)).map(count).max();
        assert_eq!(most, Some(MOST_STORAGE_BUFFERS));
    }
}
