//! Records passes and, where asked, times each: by timestamp queries on hardware, by the host's clock around submit and
//! wait on software adapters (their timestamps lie).

use std::time::{Duration, Instant};

use crate::error::Result;
use crate::gpu::device::Gpu;
use crate::gpu::kernel::{DrawKernel, Kernel};
use crate::renderer::PassTime;

/// Most passes of one frame that are timed; the rest run all the same.
const MOST_TIMED: u32 = 2048;

/// How much a compute pass does.
#[derive(Clone, Copy)]
pub enum Work<'a> {
    /// Workgroups of 256 covering this many items.
    Items(u32),
    /// Workgroups as they are.
    Groups(u32),
    /// Workgroups along x and y.
    Tiles([u32; 2]),
    /// Workgroup counts read from a buffer at this offset.
    Indirect(&'a wgpu::Buffer, u64),
}

enum Timing {
    Off,
    Clock,
    Timestamps(wgpu::QuerySet),
}

/// Collects the passes of one frame.
pub struct Recorder<'g> {
    gpu: &'g Gpu,
    encoder: Option<wgpu::CommandEncoder>,
    timing: Timing,
    times: Vec<PassTime>,
    // Passes whose time is in the query set: index into `times`.
    queried: Vec<usize>,
}

impl<'g> Recorder<'g> {
    /// Nothing recorded yet.
    pub fn new(gpu: &'g Gpu, timed: bool) -> Self {
        let timing = if !timed {
            Timing::Off
        } else if gpu.is_software() || !gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY) {
            Timing::Clock
        } else {
            Timing::Timestamps(gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("pass times"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * MOST_TIMED,
            }))
        };
        Self { gpu, encoder: None, timing, times: Vec::new(), queried: Vec::new() }
    }

    /// The encoder, for copies.
    pub fn encoder(&mut self) -> &mut wgpu::CommandEncoder {
        self.encoder.get_or_insert_with(|| {
            self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") })
        })
    }

    /// Records one dispatch.
    ///
    /// # Errors
    /// A lost device (only while timing by the clock).
    pub fn compute(&mut self, kernel: &Kernel, groups: &[wgpu::BindGroup], work: Work<'_>) -> Result<()> {
        let text = match work {
            Work::Items(n) => format!("{n} items"),
            Work::Groups(n) => format!("{n} groups"),
            Work::Tiles([x, y]) => format!("{x} x {y} tiles"),
            Work::Indirect(..) => "indirect".to_owned(),
        };
        self.timed(kernel.name, text, |recorder, queries| {
            let writes = queries.as_ref().map(|(set, i)| wgpu::ComputePassTimestampWrites {
                query_set: set,
                beginning_of_pass_write_index: Some(2 * i),
                end_of_pass_write_index: Some(2 * i + 1),
            });
            let mut pass = recorder.encoder().begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some(kernel.name),
                timestamp_writes: writes,
            });
            pass.set_pipeline(&kernel.pipeline);
            for (i, group) in (0u32..).zip(groups) {
                pass.set_bind_group(i, group, &[]);
            }
            match work {
                Work::Items(n) => {
                    let [x, y] = grid(n.div_ceil(256));
                    pass.dispatch_workgroups(x, y, 1);
                }
                Work::Groups(n) => {
                    let [x, y] = grid(n);
                    pass.dispatch_workgroups(x, y, 1);
                }
                Work::Tiles([x, y]) => pass.dispatch_workgroups(x, y, 1),
                Work::Indirect(buffer, offset) => pass.dispatch_workgroups_indirect(buffer, offset),
            }
        })
    }

    /// Records one render pass into `targets`; `draw` issues the draws.
    ///
    /// # Errors
    /// A lost device (only while timing by the clock).
    pub fn draw(
        &mut self,
        kernel: &DrawKernel,
        groups: &[wgpu::BindGroup],
        targets: &[(&wgpu::TextureView, wgpu::LoadOp<wgpu::Color>)],
        draw: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) -> Result<()> {
        self.timed(kernel.name, "draw".to_owned(), |recorder, queries| {
            let writes = queries.as_ref().map(|(set, i)| wgpu::RenderPassTimestampWrites {
                query_set: set,
                beginning_of_pass_write_index: Some(2 * i),
                end_of_pass_write_index: Some(2 * i + 1),
            });
            let attachments: Vec<_> = targets
                .iter()
                .map(|&(view, load)| {
                    Some(wgpu::RenderPassColorAttachment {
                        view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
                    })
                })
                .collect();
            let mut pass = recorder.encoder().begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(kernel.name),
                color_attachments: &attachments,
                depth_stencil_attachment: None,
                timestamp_writes: writes,
                occlusion_query_set: None,
                multiview_mask: None,
            });
            pass.set_pipeline(&kernel.pipeline);
            for (i, group) in (0u32..).zip(groups) {
                pass.set_bind_group(i, group, &[]);
            }
            draw(&mut pass);
        })
    }

    /// Work of the host, timed with the passes.
    pub fn host<T>(&mut self, name: &str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let value = work();
        if !matches!(self.timing, Timing::Off) {
            self.times.push(PassTime { pass: format!("host: {name}"), work: String::new(), time: start.elapsed() });
        }
        value
    }

    /// Submits what is recorded.
    pub fn submit(&mut self) {
        if let Some(encoder) = self.encoder.take() {
            self.gpu.queue.submit([encoder.finish()]);
        }
    }

    /// Submits, waits and returns the passes' times.
    ///
    /// # Errors
    /// A lost device.
    pub fn finish(mut self) -> Result<Vec<PassTime>> {
        let bytes = self.queried.len() as u64 * 16;
        let mut staging = None;
        if let Timing::Timestamps(set) = &self.timing
            && bytes > 0
        {
            let usage = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
            let resolved = self.gpu.buffer("timestamps", bytes, usage);
            let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
            let mapped = self.gpu.buffer("timestamps, mapped", bytes, usage);
            let set = set.clone();
            let count = 2 * self.queried.len() as u32;
            self.encoder().resolve_query_set(&set, 0..count, &resolved, 0);
            self.encoder().copy_buffer_to_buffer(&resolved, 0, &mapped, 0, bytes);
            staging = Some(mapped);
        }
        self.submit();
        self.gpu.wait()?;
        if let Some(mapped) = staging {
            let ticks: Vec<u64> = self.gpu.map(&mapped, bytes)?;
            let period = f64::from(self.gpu.queue.get_timestamp_period());
            for (i, &pass) in self.queried.iter().enumerate() {
                let span = ticks[2 * i + 1].saturating_sub(ticks[2 * i]);
                self.times[pass].time = Duration::from_secs_f64(span as f64 * period * 1e-9);
            }
        }
        Ok(self.times)
    }

    fn timed(
        &mut self,
        name: &str,
        work: String,
        record: impl FnOnce(&mut Self, Option<(wgpu::QuerySet, u32)>),
    ) -> Result<()> {
        match &self.timing {
            Timing::Off => record(self, None),
            Timing::Clock => {
                self.submit();
                self.gpu.wait()?;
                let start = Instant::now();
                record(self, None);
                self.submit();
                self.gpu.wait()?;
                self.times.push(PassTime { pass: name.to_owned(), work, time: start.elapsed() });
            }
            Timing::Timestamps(set) => {
                let index = self.queried.len() as u32;
                if index >= MOST_TIMED {
                    record(self, None);
                    return Ok(());
                }
                let set = set.clone();
                self.queried.push(self.times.len());
                self.times.push(PassTime { pass: name.to_owned(), work, time: Duration::ZERO });
                record(self, Some((set, index)));
            }
        }
        Ok(())
    }
}

/// Workgroups along x and y: at most 65,535 along each.
fn grid(groups: u32) -> [u32; 2] {
    let rows = groups.div_ceil(65_535).max(1);
    [groups.div_ceil(rows), rows]
}
