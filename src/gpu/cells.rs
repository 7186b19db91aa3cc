//! Device buffers with an entry a cell, a bit a cell, or a block of 256 cells: what a frame's passes hand on.

use crate::gpu::device::Gpu;
use crate::gpu::layout;

/// Bytes of a cell's four corners with gradient magnitudes.
const CORNER_BYTES: u64 = 4 * 100;

/// More with gradient vectors.
const SHADED_BYTES: u64 = 4 * 48;

const STORAGE: wgpu::BufferUsages = wgpu::BufferUsages::STORAGE;

/// Buffers of the cells; sizes follow the mesh, not the view.
pub struct CellBuffers {
    /// One bit a cell: the transfer function can make it visible.
    pub candidates: wgpu::Buffer,
    /// One bit a cell: cut by the near plane, drawn as pieces.
    pub clipped: wgpu::Buffer,
    /// One bit a cell: drawn in this frame.
    pub survivors: wgpu::Buffer,
    /// The bands of each candidate, packed (`shared/bands.wgsl`); 16 bytes until a scene needs it.
    pub cell_bands: wgpu::Buffer,
    /// [`layout::BandTotals`].
    pub band_totals: wgpu::Buffer,
    /// Cells, or their spans, before each word of `survivors` in its block.
    pub word_offsets: wgpu::Buffer,
    /// Survivors of each block of 256 cells, or their spans.
    pub block_counts: wgpu::Buffer,
    /// Survivors before each block.
    pub block_offsets: wgpu::Buffer,
    /// [`layout::Counts`].
    pub counts: wgpu::Buffer,
    /// Arguments of an indexed draw a chunk.
    pub draws: wgpu::Buffer,
    /// What power keys are made of; 16 bytes until a scene needs it.
    pub power_rows: wgpu::Buffer,
    /// Ranks of cells; 16 bytes until a scene needs it.
    pub ranks: wgpu::Buffer,
    /// Clip position of each vertex.
    pub projected: wgpu::Buffer,
    /// Corners of one chunk's cells.
    pub corners: wgpu::Buffer,
    /// Sort keys of the survivors, or of their spans.
    pub keys: wgpu::Buffer,
    /// The survivors or their spans, sorted back to front.
    pub order: wgpu::Buffer,
}

impl CellBuffers {
    /// For so many vertices and tetrahedra, of which so many cells or spans are drawn in chunks.
    pub fn new(gpu: &Gpu, vertices: u64, tets: u64, most_drawn: u64, chunk_cells: u32) -> Self {
        let blocks = tets.div_ceil(256);
        let chunks = most_drawn.div_ceil(u64::from(chunk_cells));
        let copied = STORAGE | wgpu::BufferUsages::COPY_SRC;
        let indirect = STORAGE | wgpu::BufferUsages::INDIRECT;
        let written = STORAGE | wgpu::BufferUsages::COPY_DST;
        Self {
            candidates: gpu.buffer("candidates", blocks * 32, copied),
            clipped: gpu.buffer("clipped", blocks * 32, written),
            survivors: gpu.buffer("survivors", blocks * 32, copied),
            cell_bands: gpu.buffer("cell_bands", 16, STORAGE),
            band_totals: gpu.buffer("band_totals", 16, copied | wgpu::BufferUsages::COPY_DST),
            word_offsets: gpu.buffer("word_offsets", blocks * 32, STORAGE),
            block_counts: gpu.buffer("block_counts", blocks * 4, STORAGE),
            block_offsets: gpu.buffer("block_offsets", blocks * 4, STORAGE),
            counts: gpu.buffer("counts", size_of::<layout::Counts>() as u64, indirect | wgpu::BufferUsages::COPY_SRC),
            draws: gpu.buffer("draws", chunks * 20, indirect),
            power_rows: gpu.buffer("power_rows", 16, written),
            ranks: gpu.buffer("ranks", 16, written),
            projected: gpu.buffer("projected", vertices * 8, STORAGE),
            corners: corners(gpu, u64::from(chunk_cells) * CORNER_BYTES),
            keys: gpu.buffer("keys", most_drawn * 4, copied),
            order: gpu.buffer("order", most_drawn * 4, copied | wgpu::BufferUsages::COPY_DST),
        }
    }

    /// Makes room for gradient vectors at the corners of a chunk's cells, if no scene needed them before.
    pub fn need_shaded_corners(&mut self, gpu: &Gpu, chunk_cells: u32) {
        let size = u64::from(chunk_cells) * (CORNER_BYTES + SHADED_BYTES);
        if self.corners.size() < size {
            self.corners = corners(gpu, size);
        }
    }

    /// Labels and buffers, for the report.
    pub fn list(&self) -> [(&'static str, &wgpu::Buffer); 16] {
        [
            ("candidates", &self.candidates),
            ("clipped", &self.clipped),
            ("survivors", &self.survivors),
            ("cell_bands", &self.cell_bands),
            ("band_totals", &self.band_totals),
            ("word_offsets", &self.word_offsets),
            ("block_counts", &self.block_counts),
            ("block_offsets", &self.block_offsets),
            ("counts", &self.counts),
            ("draws", &self.draws),
            ("power_rows", &self.power_rows),
            ("ranks", &self.ranks),
            ("projected", &self.projected),
            ("corners", &self.corners),
            ("keys", &self.keys),
            ("order", &self.order),
        ]
    }
}

fn corners(gpu: &Gpu, bytes: u64) -> wgpu::Buffer {
    gpu.buffer("corners", bytes, STORAGE | wgpu::BufferUsages::VERTEX)
}
