//! The device: which adapter, and its buffers.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use crate::error::{Error, Result};
use crate::gpu::kernel::Made;

/// What the largest shader of projection binds.
pub(super) const MOST_STORAGE_BUFFERS: u32 = 13;

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
    instance: wgpu::Instance,
    adapter: wgpu::Adapter,
    /// Adapter, driver, back end.
    pub info: wgpu::AdapterInfo,
    /// Largest storage binding that is used, bytes.
    pub max_binding: u64,
    // What the device complained of first, and nobody was told yet.
    complaint: Arc<Mutex<Option<String>>>,
    pub(super) made: Arc<Mutex<Made>>,
}

/// The process's one way to its drivers, but for a window's. NVIDIA's found no adapter any more after it was loaded and
/// unloaded some thirty times (580.159).
fn instance() -> &'static wgpu::Instance {
    static INSTANCE: OnceLock<wgpu::Instance> = OnceLock::new();
    INSTANCE.get_or_init(new_instance)
}

fn new_instance() -> wgpu::Instance {
    wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env())
}

impl Gpu {
    /// Opens the best adapter of the choice.
    ///
    /// # Errors
    /// No such adapter; the adapter's own refusal.
    pub fn new(choice: DeviceChoice) -> Result<Self> {
        Self::with_binding_limit(choice, u64::MAX)
    }

    /// Opens the best adapter for a window. lavapipe's threads are an instance's: the window has its own, and does not wait
    /// for what other devices draw.
    ///
    /// # Errors
    /// As [`Gpu::new`].
    pub fn for_window() -> Result<Self> {
        Self::of(&new_instance(), DeviceChoice::Any, u64::MAX)
    }

    /// The same with storage bindings kept at or below `limit` bytes: how small adapters are tested on large ones.
    ///
    /// # Errors
    /// As [`Gpu::new`].
    pub fn with_binding_limit(choice: DeviceChoice, limit: u64) -> Result<Self> {
        Self::of(instance(), choice, limit)
    }

    fn of(instance: &wgpu::Instance, choice: DeviceChoice, limit: u64) -> Result<Self> {
        let mut adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
        adapters.retain(|a| match choice {
            DeviceChoice::Any => true,
            DeviceChoice::Software => is_software(&a.get_info()),
            DeviceChoice::Hardware => !is_software(&a.get_info()),
        });
        adapters.sort_by_key(|a| preference(a.get_info().device_type));
        let mut refusal = None;
        for adapter in adapters {
            match Self::open(instance, &adapter, limit) {
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

    fn open(instance: &wgpu::Instance, adapter: &wgpu::Adapter, limit: u64) -> Result<Self> {
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
        Ok(Self {
            device,
            queue,
            instance: instance.clone(),
            adapter: adapter.clone(),
            info,
            max_binding,
            complaint,
            made: Arc::default(),
        })
    }

    /// What a window needs to draw on the same device: instance, adapter, device, queue.
    pub fn parts(&self) -> (wgpu::Instance, wgpu::Adapter, wgpu::Device, wgpu::Queue) {
        (self.instance.clone(), self.adapter.clone(), self.device.clone(), self.queue.clone())
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
