//! Kernels: specialised pipelines, what they bind, and those that a device keeps.

use std::borrow::Cow;
use std::collections::{HashMap, VecDeque};
use std::sync::{Arc, PoisonError};

use naga::ShaderStage;

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::shader::{Binding, BindingKind, Module};
use crate::gpu::specialise::specialised;

/// Kernels of either kind that are kept: several scenes' of a renderer or two.
const MOST_KEPT: usize = 64;

/// What a device made and may be asked for again, since compiling takes longer than a frame.
#[derive(Default)]
pub(super) struct Made {
    kernels: Recent<KernelKey, Kernel>,
    draws: Recent<DrawKey, DrawKernel>,
}

/// A pass and the constants that it declares.
type KernelKey = (&'static str, Vec<(String, u64)>);

/// All that a render pipeline is made of.
#[derive(PartialEq)]
struct DrawKey {
    kernel: KernelKey,
    entries: [String; 2],
    targets: Vec<Option<wgpu::ColorTargetState>>,
    vertices: Vec<wgpu::VertexAttribute>,
    culled: Option<wgpu::Face>,
}

/// The last things that were asked for.
struct Recent<K, V>(VecDeque<(K, V)>);

impl<K, V> Default for Recent<K, V> {
    fn default() -> Self {
        Self(VecDeque::new())
    }
}

impl<K: PartialEq, V: Clone> Recent<K, V> {
    fn get(&mut self, key: &K) -> Option<V> {
        let at = self.0.iter().position(|(known, _)| known == key)?;
        let found = self.0.remove(at)?;
        let value = found.1.clone();
        self.0.push_back(found);
        Some(value)
    }

    fn put(&mut self, key: K, value: V) {
        if self.0.len() == MOST_KEPT {
            self.0.pop_front();
        }
        self.0.push_back((key, value));
    }
}

impl Gpu {
    /// A compute kernel, specialised by `constants`.
    ///
    /// # Errors
    /// The shader does not compile, or binds more than the device does.
    pub fn kernel(&self, name: &'static str, constants: &[(&str, f64)]) -> Result<Kernel> {
        let module = Module::known(name)?;
        let constants = known_constants(&module, constants);
        let key = key_of(name, &constants);
        if let Some(kernel) = self.made(|made| made.kernels.get(&key)) {
            return Ok(kernel);
        }
        let (needed, most) = (storage_buffers(&module), self.device.limits().max_storage_buffers_per_shader_stage);
        if needed > most {
            return Err(Error::Device(format!(
                "'{}' binds {most} storage buffers to a shader, and '{name}' needs {needed}; use --method project, or \
                 --device cpu",
                self.info.name
            )));
        }
        let layouts = self.layouts(&module);
        let pipeline = self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: Some(&self.pipeline_layout(name, &layouts)),
            module: &self.shader(&module, &[(ShaderStage::Compute, "main")], &constants)?,
            entry_point: Some("main"),
            compilation_options: specialised_already(),
            cache: None,
        });
        let kernel = Kernel { name, pipeline, bindings: module.bindings.as_slice().into(), layouts: layouts.into() };
        self.made(|made| made.kernels.put(key, kernel.clone()));
        Ok(kernel)
    }

    /// A render kernel drawing triangles, but for those `culled`; `entries` names the vertex and fragment entry points.
    ///
    /// # Errors
    /// The shader does not compile.
    pub fn draw_kernel(
        &self,
        name: &'static str,
        entries: [&str; 2],
        constants: &[(&str, f64)],
        targets: &[Option<wgpu::ColorTargetState>],
        vertex_buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
        culled: Option<wgpu::Face>,
    ) -> Result<DrawKernel> {
        let module = Module::known(name)?;
        let constants = known_constants(&module, constants);
        let key = DrawKey {
            kernel: key_of(name, &constants),
            entries: entries.map(str::to_owned),
            targets: targets.to_vec(),
            vertices: vertex_buffers.iter().flatten().flat_map(|buffer| buffer.attributes).copied().collect(),
            culled,
        };
        if let Some(kernel) = self.made(|made| made.draws.get(&key)) {
            return Ok(kernel);
        }
        let layouts = self.layouts(&module);
        let stages = [(ShaderStage::Vertex, entries[0]), (ShaderStage::Fragment, entries[1])];
        let shader = self.shader(&module, &stages, &constants)?;
        let pipeline = self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(name),
            layout: Some(&self.pipeline_layout(name, &layouts)),
            vertex: wgpu::VertexState {
                module: &shader,
                entry_point: Some(entries[0]),
                compilation_options: specialised_already(),
                buffers: vertex_buffers,
            },
            primitive: wgpu::PrimitiveState { cull_mode: culled, ..Default::default() },
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &shader,
                entry_point: Some(entries[1]),
                compilation_options: specialised_already(),
                targets,
            }),
            multiview_mask: None,
            cache: None,
        });
        let kernel =
            DrawKernel { name, pipeline, bindings: module.bindings.as_slice().into(), layouts: layouts.into() };
        self.made(|made| made.draws.put(key, kernel.clone()));
        Ok(kernel)
    }

    fn made<T>(&self, act: impl FnOnce(&mut Made) -> T) -> T {
        act(&mut self.made.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn shader(
        &self,
        module: &Module,
        entries: &[(ShaderStage, &str)],
        constants: &[(&str, f64)],
    ) -> Result<wgpu::ShaderModule> {
        let source = specialised(module.name, &module.naga, entries, constants)?;
        Ok(self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(module.name),
            source: wgpu::ShaderSource::Naga(Cow::Owned(source)),
        }))
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

/// A compute pipeline and what it binds; clones are the same one.
#[derive(Clone)]
pub struct Kernel {
    /// The pass's name.
    pub name: &'static str,
    /// Specialised pipeline.
    pub pipeline: wgpu::ComputePipeline,
    /// Used bindings.
    pub bindings: Arc<[Binding]>,
    layouts: Arc<[wgpu::BindGroupLayout]>,
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

/// A render pipeline and what it binds; clones are the same one.
#[derive(Clone)]
pub struct DrawKernel {
    /// The pass's name.
    pub name: &'static str,
    /// Specialised pipeline.
    pub pipeline: wgpu::RenderPipeline,
    /// Used bindings.
    pub bindings: Arc<[Binding]>,
    layouts: Arc<[wgpu::BindGroupLayout]>,
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

fn specialised_already() -> wgpu::PipelineCompilationOptions<'static> {
    wgpu::PipelineCompilationOptions { constants: &[], zero_initialize_workgroup_memory: false }
}

/// What tells kernels apart.
fn key_of(name: &'static str, constants: &[(&str, f64)]) -> KernelKey {
    (name, constants.iter().map(|(name, value)| ((*name).to_owned(), value.to_bits())).collect())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::device::MOST_STORAGE_BUFFERS;
    use crate::gpu::shader::pass_names;

    #[test]
    fn no_pass_of_projection_binds_more_than_is_asked_for() {
        let of_rays = ["raycast", "raylist", "occupied"];
        let count = |pass| storage_buffers(&Module::new(pass).expect("a pass"));
        let most = pass_names().filter(|pass| !of_rays.contains(pass)).map(count).max();
        assert_eq!(most, Some(MOST_STORAGE_BUFFERS));
    }

    #[test]
    fn what_was_asked_for_last_is_kept() {
        let mut recent = Recent::default();
        for i in 0..MOST_KEPT {
            recent.put(i, 10 * i);
        }
        assert_eq!(recent.get(&0), Some(0));
        recent.put(MOST_KEPT, 1);
        assert_eq!((recent.get(&1), recent.get(&0), recent.get(&MOST_KEPT)), (None, Some(0), Some(1)));
    }
}
