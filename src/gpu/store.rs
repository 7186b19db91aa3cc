//! What the device holds of a mesh, and how it is cut into the pieces that bindings and draws can take.

use crate::error::{Error, Result};
use crate::gpu::cells::CellBuffers;
use crate::gpu::cover::Cover;
use crate::gpu::device::Gpu;
use crate::gpu::kernel::Resources;
use crate::gpu::layout;
use crate::gpu::mesh::{MeshBuffers, TetRange, part_size, ranges};
use crate::gpu::sort::Sorter;
use crate::plan::near::NearCut;
use crate::tet::TetMesh;

/// Parts in which the tetrahedra can be bound (`shared/tets.wgsl`).
const PARTS: [&str; 4] = ["tets_a", "tets_b", "tets_c", "tets_d"];

/// Bits of a span below its cell, its rank and [`DEEP_SPAN`] (`shared/bands.wgsl`).
pub const SPAN_BITS: u32 = 6;

/// Set in spans of deep cells.
pub const DEEP_SPAN: u32 = 32;

/// Buffers of a mesh and of its cells, with room for the pieces of cells that the near plane cuts.
pub struct Store {
    /// The mesh.
    pub mesh: MeshBuffers,
    /// Per-cell buffers.
    pub cells: CellBuffers,
    /// The sort.
    pub sorter: Sorter,
    /// Ranges of the mesh's tetrahedra that one dispatch takes.
    pub ranges: Vec<TetRange>,
    /// Cells projected at a time.
    pub chunk_cells: u32,
    /// At most so many cells, or spans of them, are drawn.
    pub most_drawn: u32,
    /// A `Chunk` each.
    pub chunks: Vec<wgpu::Buffer>,
    /// The triangles of a chunk's cells.
    pub indices: wgpu::Buffer,
    range_uniforms: Vec<wgpu::Buffer>,
    pieces_uniform: wgpu::Buffer,
    spare_vertices: u64,
    spare_tets: u64,
    /// Tetrahedra that the buffers hold, the gap before the pieces included.
    capacity: u64,
    part: u32,
}

/// The near plane's pieces, where they were put.
#[derive(Clone, Copy, Debug, Default)]
pub struct Pieces {
    /// Behind the mesh's tetrahedra.
    pub range: TetRange,
    /// Behind the mesh's vertices.
    pub vertices: u32,
    /// Their spans, where cells are drawn span by span.
    pub spans: u32,
}

impl Store {
    /// Uploads `mesh`, leaving room.
    ///
    /// # Errors
    /// A mesh beyond the device's limits, with the numbers.
    pub fn new(
        gpu: &Gpu,
        mesh: &TetMesh,
        cover: Cover,
        sort_on_host: bool,
        spare_vertices: u64,
        spare_tets: u64,
    ) -> Result<Self> {
        let tets = mesh.tets.len() as u32;
        let capacity = if spare_tets == 0 { u64::from(tets) } else { u64::from(pieces_start(tets)) + spare_tets };
        check_size(gpu, mesh.vertices.len() as u64 + spare_vertices, capacity)?;
        let chunk_cells = chunk_cells(tets);
        // Room for the spans of functions that cut few cells.
        let most_drawn = (capacity * 3 / 2).min(gpu.max_binding / 4).max(1);
        let buffers = MeshBuffers::new(gpu, mesh, spare_vertices, capacity);
        let cells =
            CellBuffers::new(gpu, u64::from(buffers.vertex_count) + spare_vertices, capacity, most_drawn, chunk_cells);
        let ranges = ranges(tets, gpu.max_binding);
        let range_uniforms = ranges.iter().map(|r| gpu.uniform("range", &[r.uniform()])).collect();
        let chunks = (0..most_drawn)
            .step_by(chunk_cells as usize)
            .map(|first| {
                let first_cell = first as u32;
                gpu.uniform("chunk", &[layout::Chunk { first_cell, cells: chunk_cells, ..Default::default() }])
            })
            .collect();
        let indices = triangle_indices(cover, chunk_cells);
        let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST;
        let index_buffer = gpu.buffer("indices", indices.len() as u64 * 4, usage);
        gpu.write(&index_buffer, 0, bytemuck::cast_slice(&indices));
        Ok(Self {
            mesh: buffers,
            cells,
            sorter: Sorter::new(gpu, most_drawn as u32, sort_on_host)?,
            ranges,
            chunk_cells,
            most_drawn: most_drawn as u32,
            chunks,
            indices: index_buffer,
            range_uniforms,
            pieces_uniform: gpu.uniform("range", &[layout::Range::default()]),
            spare_vertices,
            spare_tets,
            capacity,
            part: part_size(gpu.max_binding),
        })
    }

    /// True where the pieces fit the spare room.
    pub fn has_room_for(&self, cut: &NearCut) -> bool {
        cut.vertices.len() as u64 <= self.spare_vertices && cut.tets.len() as u64 <= self.spare_tets
    }

    /// Constants of the shaders that visit tetrahedra in any order.
    pub fn constants(&self) -> [(&'static str, f64); 2] {
        let parts = if self.capacity <= u64::from(self.part) { 1.0 } else { PARTS.len() as f64 };
        [("TET_PARTS", parts), ("PART_TETS", f64::from(self.part))]
    }

    /// Uploads gradient magnitudes, if no scene needed them before.
    pub fn need_gradients(&mut self, gpu: &Gpu, mesh: &TetMesh) {
        self.mesh.need_gradients(gpu, mesh, self.spare_vertices);
    }

    /// Uploads gradient vectors and makes room for them at corners, if no scene needed them before.
    pub fn need_gradient_vectors(&mut self, gpu: &Gpu, mesh: &TetMesh) {
        self.mesh.need_gradient_vectors(gpu, mesh, self.spare_vertices);
        self.cells.need_shaded_corners(gpu, self.chunk_cells);
    }

    /// Makes room for the bands of cells, if no scene needed them before.
    pub fn need_bands(&mut self, gpu: &Gpu) {
        if self.cells.cell_bands.size() < self.capacity * 4 {
            self.cells.cell_bands = gpu.buffer("cell_bands", self.capacity * 4, wgpu::BufferUsages::STORAGE);
        }
    }

    /// True where no scene needed power rows before.
    pub fn needs_power_rows(&self) -> bool {
        self.cells.power_rows.size() < self.capacity * 16
    }

    /// Uploads a row a tetrahedron.
    pub fn put_power_rows(&mut self, gpu: &Gpu, rows: &[[f32; 4]]) {
        self.cells.power_rows = gpu.buffer("power_rows", self.capacity * 16, self.cells.power_rows.usage());
        gpu.write(&self.cells.power_rows, 0, bytemuck::cast_slice(rows));
    }

    /// True where no scene needed ranks before.
    pub fn needs_ranks(&self) -> bool {
        self.cells.ranks.size() < self.capacity * 4
    }

    /// Uploads a rank a tetrahedron, with those of the pieces.
    pub fn put_ranks(&mut self, gpu: &Gpu, ranks: &[u32]) {
        if self.needs_ranks() {
            self.cells.ranks = gpu.buffer("ranks", self.capacity * 4, self.cells.ranks.usage());
        }
        gpu.write(&self.cells.ranks, 0, bytemuck::cast_slice(ranks));
    }

    /// True where this many spans, at most `most` of them in one cell, can be drawn.
    pub fn holds_spans(&self, spans: u64, most: u32) -> bool {
        spans <= u64::from(self.most_drawn) && most <= DEEP_SPAN && self.capacity <= 1 << (32 - SPAN_BITS)
    }

    /// Puts the near plane's pieces behind the mesh. They must fit.
    pub fn put_pieces(&self, gpu: &Gpu, mesh: &TetMesh, cut: &NearCut) -> Pieces {
        let start = pieces_start(self.mesh.tet_count);
        let range = TetRange { first: start, count: cut.tets.len() as u32 };
        self.mesh.put_pieces(gpu, mesh, cut, start);
        gpu.write(&self.cells.clipped, 0, bytemuck::cast_slice(&cut.clipped));
        gpu.write(&self.pieces_uniform, 0, bytemuck::bytes_of(&range.uniform()));
        Pieces { range, vertices: cut.vertices.len() as u32, spans: 0 }
    }

    /// Whole buffers, by the names that shaders give them.
    pub fn resources(&self) -> Resources<'_> {
        let (b, c) = (&self.mesh, &self.cells);
        let mut r = Resources::default()
            .with("vertices", &b.vertices)
            .with("gradients", &b.gradients)
            .with("gradient_vectors", &b.gradient_vectors)
            .with("volumes", &b.volumes);
        for (name, buffer) in c.list() {
            r = r.with(name, buffer);
        }
        let size = b.tets.size();
        let part = u64::from(self.part) * 16;
        for (i, name) in (0u64..).zip(PARTS) {
            // A part that the mesh does not reach is bound to its first.
            let first = if i * part < size { i * part } else { 0 };
            r = r.with_part(name, &b.tets, first, part.min(size - first));
        }
        r
    }

    /// The ranges to dispatch, each with its parts of the per-cell buffers.
    pub fn range_resources<'a>(
        &'a self,
        all: &Resources<'a>,
        pieces: Option<Pieces>,
    ) -> Vec<(TetRange, Resources<'a>)> {
        let extra = pieces.filter(|p| p.range.count > 0).map(|p| (p.range, &self.pieces_uniform));
        let ranges = self.ranges.iter().copied().zip(&self.range_uniforms);
        ranges.chain(extra).map(|(range, uniform)| (range, self.of_range(all.clone(), range, uniform))).collect()
    }

    fn of_range<'a>(&'a self, all: Resources<'a>, range: TetRange, uniform: &'a wgpu::Buffer) -> Resources<'a> {
        let (first, count) = (u64::from(range.first), u64::from(range.count));
        let blocks = count.div_ceil(256);
        let (b, c) = (&self.mesh, &self.cells);
        // Those that no scene needed have no parts.
        let mut all = all;
        for (name, buffer, bytes) in
            [("cell_bands", &c.cell_bands, 4), ("power_rows", &c.power_rows, 16), ("ranks", &c.ranks, 4)]
        {
            if buffer.size() >= self.capacity * bytes {
                all = all.with_part(name, buffer, first * bytes, count * bytes);
            }
        }
        all.with("range", uniform)
            .with_part("tets", &b.tets, first * 16, count * 16)
            .with_part("volumes", &b.volumes, first * 4, count * 4)
            .with_part("candidates", &c.candidates, first / 8, blocks * 32)
            .with_part("survivors", &c.survivors, first / 8, blocks * 32)
            .with_part("word_offsets", &c.word_offsets, first / 8, blocks * 32)
            .with_part("block_counts", &c.block_counts, first / 64, blocks * 4)
            .with_part("block_offsets", &c.block_offsets, first / 64, blocks * 4)
    }

    /// Labels and buffers, for the report.
    pub fn list(&self) -> Vec<(&'static str, &wgpu::Buffer)> {
        let b = &self.mesh;
        let mut list = vec![
            ("vertices", &b.vertices),
            ("gradients", &b.gradients),
            ("gradient_vectors", &b.gradient_vectors),
            ("tets", &b.tets),
            ("volumes", &b.volumes),
        ];
        list.extend(self.cells.list());
        list.push(("indices", &self.indices));
        list.extend(self.sorter.buffers());
        list
    }
}

impl TetRange {
    fn uniform(self) -> layout::Range {
        layout::Range { first_tet: self.first, tet_count: self.count, ..Default::default() }
    }
}

/// Where pieces begin: aligned so that every per-cell buffer can be bound from there.
fn pieces_start(tets: u32) -> u32 {
    tets.next_multiple_of(16_384)
}

/// Cells projected and drawn at a time; their corners are made anew for each chunk. At most an eighth of the mesh, so
/// that corners cost at most 22 bytes a tetrahedron of meshes above 131,072.
fn chunk_cells(tets: u32) -> u32 {
    (1u32 << (tets / 8).max(1).ilog2()).clamp(16_384, 262_144).min(tets.max(1).next_multiple_of(256))
}

/// The triangles of so many cells.
pub fn triangle_indices(cover: Cover, cells: u32) -> Vec<u32> {
    (0..cells).flat_map(|cell| cover.triangles().iter().map(move |corner| cell * 4 + corner)).collect()
}

/// Refuses meshes beyond the device, with the numbers.
fn check_size(gpu: &Gpu, vertices: u64, tets: u64) -> Result<()> {
    let most_vertices = gpu.max_binding / 16;
    let most_tets = (gpu.max_binding / 4)
        .min(PARTS.len() as u64 * u64::from(part_size(gpu.max_binding)))
        .min(gpu.device.limits().max_buffer_size / 16);
    if vertices > most_vertices || tets > most_tets {
        return Err(Error::Device(format!(
            "the mesh and its pieces at the near plane need room for {vertices} vertices and {tets} tetrahedra; '{}' \
             binds {} MiB at once, which is room for {most_vertices} and {most_tets}; render with --device cpu, or \
             a coarser mesh",
            gpu.info.name,
            gpu.max_binding >> 20
        )));
    }
    Ok(())
}
