//! The linked mesh on the device, in one of two layouts.

use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::gpu::device::Gpu;
use crate::gpu::kernel::Resources;
use crate::gpu::mesh::relative_gradients;
use crate::renderer::CellLayout;
use crate::tet::{Cell, LinkedMesh, TetMesh};

/// Parts in which links and ids can be bound (`shared/linked.wgsl`).
const LINKS: [&str; 4] = ["links_a", "links_b", "links_c", "links_d"];
const IDS: [&str; 4] = ["ids_a", "ids_b", "ids_c", "ids_d"];

/// Cells that a side can name: three bits of a word say which side (`tet/boundary.rs`), and all bits set mean none.
const MOST_CELLS: u64 = (1 << 29) - 1;

/// Cells turned into an upload at a time.
const CELLS_AT_ONCE: usize = 1 << 18;

/// Device buffers of a linked mesh.
pub struct LinkedBuffers {
    /// [`CellLayout::Fast`] or [`CellLayout::Compact`].
    pub layout: CellLayout,
    links: Vec<wgpu::Buffer>,
    /// Compact only.
    ids: Vec<wgpu::Buffer>,
    places: wgpu::Buffer,
    scalars: wgpu::Buffer,
    /// 16 bytes until a scene needs them; so are vectors.
    gradients: wgpu::Buffer,
    gradient_vectors: wgpu::Buffer,
    has_gradients: bool,
    has_vectors: bool,
    cells: u32,
    slots: u64,
    part_cells: u32,
}

impl LinkedBuffers {
    /// Uploads all but gradients.
    ///
    /// # Errors
    /// A mesh beyond the device's limits, with the numbers.
    pub fn new(gpu: &Gpu, mesh: &LinkedMesh, wanted: CellLayout) -> Result<Self> {
        let (cells, vertices) = (mesh.cells.len() as u64, mesh.vertices.len() as u64);
        let layout = choose(gpu, cells, vertices, wanted)?;
        let part_cells = (gpu.max_binding / 16).min(MOST_CELLS) as u32;
        let parts = |label: &str, words: fn(&Cell) -> [u32; 4]| -> Vec<wgpu::Buffer> {
            let part = |part: &[Cell]| {
                let buffer = storage(gpu, label, part.len() as u64 * 16);
                for (i, some) in part.chunks(CELLS_AT_ONCE).enumerate() {
                    let words: Vec<[u32; 4]> = some.par_iter().map(words).collect();
                    gpu.write(&buffer, (i * CELLS_AT_ONCE * 16) as u64, bytemuck::cast_slice(&words));
                }
                buffer
            };
            mesh.cells.chunks(part_cells as usize).map(part).collect()
        };
        let slots = if layout == CellLayout::Fast { cells * 4 } else { vertices };
        let buffers = Self {
            layout,
            links: parts("links", |cell| cell.links),
            ids: if layout == CellLayout::Fast { Vec::new() } else { parts("ids", |cell| cell.vertices) },
            places: storage(gpu, "places", slots * 12),
            scalars: storage(gpu, "scalars", slots * 4),
            gradients: storage(gpu, "gradients", 16),
            gradient_vectors: storage(gpu, "gradient_vectors", 16),
            has_gradients: false,
            has_vectors: false,
            cells: cells as u32,
            slots,
            part_cells,
        };
        buffers.put_places(gpu, mesh);
        buffers.put_scalars(gpu, mesh);
        Ok(buffers)
    }

    /// Uploads the vertices' places, of the same topology.
    pub fn put_places(&self, gpu: &Gpu, mesh: &LinkedMesh) {
        self.put(gpu, mesh, &self.places, |v| mesh.vertices[v as usize].truncate().to_array());
    }

    fn put_scalars(&self, gpu: &Gpu, mesh: &LinkedMesh) {
        self.put(gpu, mesh, &self.scalars, |v| mesh.vertices[v as usize].w);
    }

    /// Uploads another field's values, and what was uploaded of its gradients.
    pub fn put_field(&mut self, gpu: &Gpu, mesh: &LinkedMesh, source: &TetMesh) {
        self.put_scalars(gpu, mesh);
        if std::mem::take(&mut self.has_gradients) {
            self.need_gradients(gpu, mesh);
        }
        if std::mem::take(&mut self.has_vectors) {
            self.need_gradient_vectors(gpu, mesh, source);
        }
    }

    /// Uploads gradient magnitudes, if no scene needed them before.
    pub fn need_gradients(&mut self, gpu: &Gpu, mesh: &LinkedMesh) {
        if self.has_gradients {
            return;
        }
        if self.gradients.size() < self.slots * 4 {
            self.gradients = storage(gpu, "gradients", self.slots * 4);
        }
        self.put(gpu, mesh, &self.gradients, |v| mesh.gradients[v as usize]);
        self.has_gradients = true;
    }

    /// Uploads gradient vectors, if no scene needed them before.
    pub fn need_gradient_vectors(&mut self, gpu: &Gpu, mesh: &LinkedMesh, source: &TetMesh) {
        if self.has_vectors {
            return;
        }
        let vectors = relative_gradients(source);
        if self.gradient_vectors.size() < self.slots * 12 {
            self.gradient_vectors = storage(gpu, "gradient_vectors", self.slots * 12);
        }
        self.put(gpu, mesh, &self.gradient_vectors, |v| vectors[mesh.original[v as usize] as usize]);
        self.has_vectors = true;
    }

    /// Writes a value a slot.
    fn put<T: bytemuck::Pod + Send + Sync>(
        &self,
        gpu: &Gpu,
        mesh: &LinkedMesh,
        buffer: &wgpu::Buffer,
        value: impl Fn(u32) -> T + Sync + Send,
    ) {
        if self.layout == CellLayout::Compact {
            let values: Vec<T> = (0..self.slots as u32).into_par_iter().map(&value).collect();
            gpu.write(buffer, 0, bytemuck::cast_slice(&values));
            return;
        }
        for (i, some) in mesh.cells.chunks(CELLS_AT_ONCE).enumerate() {
            let of_corners = |cell: &Cell| {
                let [a, b, c, d] = cell.vertices;
                [value(a), value(b), value(c), value(d)]
            };
            let values: Vec<[T; 4]> = some.par_iter().map(of_corners).collect();
            gpu.write(buffer, (i * CELLS_AT_ONCE * 4 * size_of::<T>()) as u64, bytemuck::cast_slice(&values));
        }
    }

    /// `override` constants of `shared/linked.wgsl`.
    pub fn constants(&self) -> [(&'static str, f64); 4] {
        [
            ("CELLS", f64::from(self.cells)),
            ("CELL_PARTS", self.links.len() as f64),
            ("PART_CELLS", f64::from(self.part_cells)),
            ("SLOT_PER_CORNER", f64::from(u8::from(self.layout == CellLayout::Fast))),
        ]
    }

    /// What shaders bind; a part that there is not is the first.
    pub fn resources(&self) -> Resources<'_> {
        let mut resources = Resources::default()
            .with("places", &self.places)
            .with("scalars", &self.scalars)
            .with("gradients", &self.gradients)
            .with("gradient_vectors", &self.gradient_vectors);
        for (part, (links, ids)) in LINKS.into_iter().zip(IDS).enumerate() {
            resources = resources.with(links, self.links.get(part).unwrap_or(&self.links[0]));
            resources = resources.with(ids, self.ids.get(part).or(self.ids.first()).unwrap_or(&self.gradients));
        }
        resources
    }

    /// Labels and buffers, for the report.
    pub fn list(&self) -> Vec<(&'static str, &wgpu::Buffer)> {
        let parts = LINKS.into_iter().zip(&self.links).chain(IDS.into_iter().zip(&self.ids));
        let rest = [
            ("places", &self.places),
            ("scalars", &self.scalars),
            ("gradients", &self.gradients),
            ("gradient_vectors", &self.gradient_vectors),
        ];
        parts.chain(rest).collect()
    }
}

fn storage(gpu: &Gpu, label: &str, bytes: u64) -> wgpu::Buffer {
    gpu.buffer(label, bytes, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST)
}

/// The layout that is wanted, if the device can hold it.
fn choose(gpu: &Gpu, cells: u64, vertices: u64, wanted: CellLayout) -> Result<CellLayout> {
    let most_cells = LINKS.len() as u64 * (gpu.max_binding / 16);
    let fits_fast = cells * 48 <= gpu.max_binding && cells <= MOST_CELLS;
    let fits_compact = cells <= most_cells.min(MOST_CELLS) && vertices * 12 <= gpu.max_binding;
    match wanted {
        CellLayout::Auto | CellLayout::Fast if fits_fast => Ok(CellLayout::Fast),
        CellLayout::Auto | CellLayout::Compact if fits_compact => Ok(CellLayout::Compact),
        _ => Err(Error::Device(format!(
            "the mesh has {cells} tetrahedra and {vertices} vertices; '{}' binds {} MiB at once, which is room for {} \
             in the fast layout and for {most_cells} of at most {} vertices in the compact one; {}",
            gpu.info.name,
            gpu.max_binding >> 20,
            gpu.max_binding / 48,
            gpu.max_binding / 12,
            if fits_compact { "use --layout compact" } else { "render with --device cpu, or a coarser mesh" }
        ))),
    }
}
