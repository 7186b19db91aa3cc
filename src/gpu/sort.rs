//! Depth sort of the surviving cells: radix passes on the GPU, or std's sort on the host.

use rayon::prelude::*;

use crate::error::Result;
use crate::gpu::device::Gpu;
use crate::gpu::kernel::{Kernel, Resources};
use crate::gpu::layout::Counts;
use crate::gpu::record::{Recorder, Work};

/// Offset of the sort's dispatch in [`Counts`].
const SORT_GROUPS: u64 = std::mem::offset_of!(Counts, sort_groups_x) as u64;

/// Workgroup memory of `sort_scatter`.
const TILE_BYTES: u32 = 19_456;

/// Sorts the cells of a frame.
pub struct Sorter {
    place: Place,
}

enum Place {
    // Keys and cells, one behind the other.
    Host { mapped: wgpu::Buffer },
    Gpu(Box<GpuSort>),
}

struct GpuSort {
    rounds: [[Kernel; 2]; 4],
    scan: Kernel,
    keys: wgpu::Buffer,
    values: wgpu::Buffer,
    digit_counts: wgpu::Buffer,
    digit_totals: wgpu::Buffer,
}

impl Sorter {
    /// For at most `capacity` cells.
    ///
    /// # Errors
    /// A shader that does not compile.
    pub fn new(gpu: &Gpu, capacity: u32, on_host: bool) -> Result<Self> {
        // WebGPU's default is less than a tile of the radix sort takes.
        let on_host = on_host || gpu.device.limits().max_compute_workgroup_storage_size < TILE_BYTES;
        let place = if on_host {
            let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
            Place::Host { mapped: gpu.buffer("sort pairs, mapped", u64::from(capacity).max(1) * 8, usage) }
        } else {
            Place::Gpu(Box::new(GpuSort::new(gpu, capacity)?))
        };
        Ok(Self { place })
    }

    /// The order is known to the host.
    pub fn sorts_on_host(&self) -> bool {
        matches!(self.place, Place::Host { .. })
    }

    /// Buffers held, by label.
    pub fn buffers(&self) -> Vec<(&'static str, &wgpu::Buffer)> {
        match &self.place {
            Place::Host { mapped } => vec![("sort pairs, mapped", mapped)],
            Place::Gpu(s) => {
                vec![("sort keys", &s.keys), ("sort values", &s.values), ("sort counts", &s.digit_counts)]
            }
        }
    }

    /// Sorts `order` by `keys`: ascending, ties by cell. Where it sorts on the host, submits what is recorded and returns
    /// the sorted order.
    ///
    /// # Errors
    /// A lost device.
    pub fn sort(
        &self,
        gpu: &Gpu,
        recorder: &mut Recorder<'_>,
        counts: &wgpu::Buffer,
        keys: &wgpu::Buffer,
        order: &wgpu::Buffer,
    ) -> Result<Option<Vec<u32>>> {
        match &self.place {
            Place::Host { mapped } => sort_on_host(gpu, recorder, mapped, [counts, keys, order]).map(Some),
            Place::Gpu(sort) => sort.record(gpu, recorder, [counts, keys, order]).map(|()| None),
        }
    }
}

impl GpuSort {
    fn new(gpu: &Gpu, capacity: u32) -> Result<Self> {
        let round = |shift: f64| -> Result<[Kernel; 2]> {
            let constants = [("SHIFT", shift)];
            Ok([gpu.kernel("sort_count", &constants)?, gpu.kernel("sort_scatter", &constants)?])
        };
        let bytes = u64::from(capacity) * 4;
        let usage = wgpu::BufferUsages::STORAGE;
        Ok(Self {
            rounds: [round(0.0)?, round(8.0)?, round(16.0)?, round(24.0)?],
            scan: gpu.kernel("sort_scan", &[])?,
            keys: gpu.buffer("sort keys", bytes, usage),
            values: gpu.buffer("sort values", bytes, usage),
            digit_counts: gpu.buffer("sort counts", u64::from(capacity.div_ceil(1024)) * 1024, usage),
            digit_totals: gpu.buffer("sort totals", 1024, usage),
        })
    }

    /// 4 rounds of 8 bits.
    fn record(&self, gpu: &Gpu, recorder: &mut Recorder<'_>, [counts, keys, order]: [&wgpu::Buffer; 3]) -> Result<()> {
        let shared = Resources::default()
            .with("counts", counts)
            .with("digit_counts", &self.digit_counts)
            .with("digit_totals", &self.digit_totals);
        for (round, [count, scatter]) in self.rounds.iter().enumerate() {
            let (from, to) = ((keys, order), (&self.keys, &self.values));
            let (from, to) = if round % 2 == 0 { (from, to) } else { (to, from) };
            let r = shared
                .clone()
                .with("keys_in", from.0)
                .with("values_in", from.1)
                .with("keys_out", to.0)
                .with("values_out", to.1);
            recorder.compute(count, &count.bind(gpu, &r)?, Work::Indirect(counts, SORT_GROUPS))?;
            recorder.compute(&self.scan, &self.scan.bind(gpu, &r)?, Work::Groups(256))?;
            recorder.compute(scatter, &scatter.bind(gpu, &r)?, Work::Indirect(counts, SORT_GROUPS))?;
        }
        Ok(())
    }
}

/// How many cells survived the last frame.
///
/// # Errors
/// A lost device.
pub fn survivors(gpu: &Gpu, counts: &wgpu::Buffer) -> Result<u32> {
    let counts: Vec<Counts> = gpu.read(counts, size_of::<Counts>() as u64)?;
    Ok(counts.first().map_or(0, |c| c.survivors))
}

fn sort_on_host(
    gpu: &Gpu,
    recorder: &mut Recorder<'_>,
    mapped: &wgpu::Buffer,
    [counts, keys, order]: [&wgpu::Buffer; 3],
) -> Result<Vec<u32>> {
    recorder.submit();
    let survivors = u64::from(survivors(gpu, counts)?);
    if survivors == 0 {
        return Ok(Vec::new());
    }
    recorder.encoder().copy_buffer_to_buffer(keys, 0, mapped, 0, survivors * 4);
    recorder.encoder().copy_buffer_to_buffer(order, 0, mapped, survivors * 4, survivors * 4);
    recorder.submit();
    let words: Vec<u32> = gpu.map(mapped, survivors * 8)?;
    let sorted = recorder.host("sort", || {
        let (keys, cells) = words.split_at(words.len() / 2);
        let mut pairs: Vec<u64> =
            keys.iter().zip(cells).map(|(&key, &cell)| u64::from(key) << 32 | u64::from(cell)).collect();
        pairs.par_sort_unstable();
        pairs.into_iter().map(|pair| pair as u32).collect::<Vec<u32>>()
    });
    gpu.write(order, 0, bytemuck::cast_slice(&sorted));
    Ok(sorted)
}
