//! The mesh on the device: what does not depend on the view.

use glam::DVec3;
use rayon::prelude::*;

use crate::gpu::device::Gpu;
use crate::plan::near::NearCut;
use crate::tet::{Axis, TetMesh};

/// Ranges begin at multiples of this, so that every binding's offset is aligned.
const RANGE_STEP: u64 = 65_536;

/// A part of the tetrahedra that fits one binding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TetRange {
    /// First tetrahedron.
    pub first: u32,
    /// How many.
    pub count: u32,
}

/// Device buffers of a mesh.
pub struct MeshBuffers {
    /// Position (mesh space) and scalar (0..1) of each vertex.
    pub vertices: wgpu::Buffer,
    /// Gradient magnitude (0..1) of each vertex; 16 bytes until a scene needs it.
    pub gradients: wgpu::Buffer,
    /// Gradient vector of each vertex, three floats; the longest has length 1. 16 bytes until a scene needs it.
    pub gradient_vectors: wgpu::Buffer,
    /// Vertex ids of each tetrahedron, ascending.
    pub tets: wgpu::Buffer,
    /// 6 x volume of each tetrahedron as rounded to f32, negative where ascending ids are an odd permutation.
    pub volumes: wgpu::Buffer,
    /// Number of vertices.
    pub vertex_count: u32,
    /// Number of tetrahedra.
    pub tet_count: u32,
    /// How scalars became 0..1.
    pub scalar: Axis,
    /// How gradient magnitudes became 0..1.
    pub gradient: Axis,
    has_gradients: bool,
    // What `gradient_vectors` holds of the mesh.
    vectors: Vec<[f32; 3]>,
}

impl MeshBuffers {
    /// Uploads a mesh with room for `spare_vertices` more, and for `tet_capacity` tetrahedra in all (pieces of cells cut
    /// by the near plane).
    pub fn new(gpu: &Gpu, mesh: &TetMesh, spare_vertices: u64, tet_capacity: u64) -> Self {
        let scalar = Axis::of(mesh.scalar_range());
        let gradient = Axis::of(mesh.gradient_range());
        let positions: Vec<[f32; 4]> = mesh
            .vertices
            .par_iter()
            .zip(&mesh.scalar)
            .map(|(p, &s)| [p.x as f32, p.y as f32, p.z as f32, scalar.apply(s) as f32])
            .collect();
        let vertices = padded(gpu, "vertices", &positions, spare_vertices);
        let (tets, volumes): (Vec<[u32; 4]>, Vec<f32>) =
            mesh.tets.par_iter().map(|&tet| ascending(tet, |v| at(positions[v as usize]))).unzip();
        let spare_tets = tet_capacity - tets.len() as u64;
        let tet_buffer = padded(gpu, "tets", &tets, spare_tets);
        drop(tets);
        let volumes = padded(gpu, "volumes", &volumes, spare_tets);
        let gradients = gpu.storage("gradients", &[0.0f32; 4]);
        Self {
            vertices,
            gradients,
            gradient_vectors: gpu.storage("gradient_vectors", &[0.0f32; 4]),
            tets: tet_buffer,
            volumes,
            vertex_count: mesh.vertices.len() as u32,
            tet_count: mesh.tets.len() as u32,
            scalar,
            gradient,
            has_gradients: false,
            vectors: Vec::new(),
        }
    }

    /// Writes the near plane's pieces: vertices behind the mesh's, tetrahedra from `start`.
    pub fn put_pieces(&self, gpu: &Gpu, mesh: &TetMesh, cut: &NearCut, start: u32) {
        let narrow = |p: DVec3, s: f64| [p.x as f32, p.y as f32, p.z as f32, self.scalar.apply(s) as f32];
        let added: Vec<[f32; 4]> = cut.vertices.iter().map(|v| narrow(v.position, v.scalar)).collect();
        let position = |v: u32| match v.checked_sub(self.vertex_count) {
            Some(i) => at(added[i as usize]),
            None => at(narrow(mesh.vertices[v as usize], 0.0)),
        };
        let (tets, volumes): (Vec<[u32; 4]>, Vec<f32>) = cut.tets.iter().map(|&tet| ascending(tet, position)).unzip();
        let first_vertex = u64::from(self.vertex_count);
        gpu.write(&self.vertices, first_vertex * 16, bytemuck::cast_slice(&added));
        gpu.write(&self.tets, u64::from(start) * 16, bytemuck::cast_slice(&tets));
        gpu.write(&self.volumes, u64::from(start) * 4, bytemuck::cast_slice(&volumes));
        if self.has_gradients {
            let values: Vec<f32> =
                cut.vertices.iter().map(|v| self.gradient.apply(v.gradient_magnitude) as f32).collect();
            gpu.write(&self.gradients, first_vertex * 4, bytemuck::cast_slice(&values));
        }
        if !self.vectors.is_empty() {
            let mut made: Vec<[f32; 3]> = Vec::with_capacity(cut.vertices.len());
            for vertex in &cut.vertices {
                let [from, to] = vertex.ends.map(|end| match (end as usize).checked_sub(self.vectors.len()) {
                    Some(i) => made[i],
                    None => self.vectors[end as usize],
                });
                made.push(std::array::from_fn(|i| from[i] + vertex.share as f32 * (to[i] - from[i])));
            }
            gpu.write(&self.gradient_vectors, first_vertex * 12, bytemuck::cast_slice(&made));
        }
    }

    /// Uploads gradient magnitudes, if no scene needed them before.
    pub fn need_gradients(&mut self, gpu: &Gpu, mesh: &TetMesh, spare_vertices: u64) {
        if self.has_gradients {
            return;
        }
        let values: Vec<f32> = mesh.gradient_magnitude.par_iter().map(|&g| self.gradient.apply(g) as f32).collect();
        self.gradients = padded(gpu, "gradients", &values, spare_vertices);
        self.has_gradients = true;
    }

    /// Uploads gradient vectors, if no scene needed them before.
    pub fn need_gradient_vectors(&mut self, gpu: &Gpu, mesh: &TetMesh, spare_vertices: u64) {
        if !self.vectors.is_empty() {
            return;
        }
        self.vectors = relative_gradients(mesh);
        self.gradient_vectors = padded(gpu, "gradient_vectors", &self.vectors, spare_vertices);
    }
}

/// The gradient at each vertex; the longest has length 1.
pub fn relative_gradients(mesh: &TetMesh) -> Vec<[f32; 3]> {
    let steepest = mesh.gradient_range().max;
    // Divided first: a reciprocal may be beyond f64.
    let relative = |g: DVec3| if steepest > 0.0 { (g / steepest).as_vec3().to_array() } else { [0.0; 3] };
    mesh.vertex_gradients().into_par_iter().map(relative).collect()
}

/// Tetrahedra (16 bytes each) that one binding holds.
pub fn part_size(max_binding: u64) -> u32 {
    (max_binding / 16 / RANGE_STEP * RANGE_STEP).clamp(RANGE_STEP, 1 << 31) as u32
}

/// `tet_count` tetrahedra in ranges that fit one binding.
pub fn ranges(tet_count: u32, max_binding: u64) -> Vec<TetRange> {
    let most = part_size(max_binding);
    (0..tet_count)
        .step_by(most as usize)
        .map(|first| TetRange { first, count: (tet_count - first).min(most) })
        .collect()
}

/// A tetrahedron's vertices in ascending order, and 6 x its signed volume from the f32 positions: faces shared by two
/// cells are then evaluated from the same vertices in the same order. Cells that rounding flattened get 0.
fn ascending(tet: [u32; 4], at: impl Fn(u32) -> DVec3) -> ([u32; 4], f32) {
    let six_volumes = |t: [u32; 4]| (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).dot(at(t[3]) - at(t[0]));
    let mut sorted = tet;
    sorted.sort_unstable();
    let volume = six_volumes(tet);
    if volume <= 0.0 || volume.is_nan() {
        return (sorted, 0.0);
    }
    (sorted, six_volumes(sorted) as f32)
}

fn at(p: [f32; 4]) -> DVec3 {
    DVec3::new(f64::from(p[0]), f64::from(p[1]), f64::from(p[2]))
}

fn padded<T: bytemuck::Pod>(gpu: &Gpu, label: &str, data: &[T], spare: u64) -> wgpu::Buffer {
    let size = size_of::<T>() as u64;
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
    let buffer = gpu.buffer(label, (data.len() as u64 + spare) * size, usage);
    gpu.write(&buffer, 0, bytemuck::cast_slice(data));
    buffer
}
