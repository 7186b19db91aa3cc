//! Projected tetrahedra on the GPU: the passes of a frame, in order.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::DVec3;

use crate::error::{Error, Result};
use crate::gpu::device::{DrawKernel, Gpu, Kernel, Resources};
use crate::gpu::layout;
use crate::gpu::mesh::{MeshBuffers, TetRange, ranges};
use crate::gpu::record::{Recorder, Work};
use crate::gpu::sort::Sorter;
use crate::gpu::transfer::TransferBuffers;
use crate::image::Image;
use crate::renderer::{BufferSize, Frame, Rendered, Renderer, Settings, SortPlace, Stats};
use crate::scene::{Camera, Projection, TransferFunction};
use crate::tet::TetMesh;

/// Bytes of a cell's four corners with gradients.
const CORNER_BYTES: u64 = 4 * 44;

/// Parts in which the tetrahedra can be bound (`shared/tets.wgsl`).
const MOST_PARTS: usize = 4;

const STORAGE: wgpu::BufferUsages = wgpu::BufferUsages::STORAGE;

/// Renders one mesh by projection (Shirley & Tuchman 1990) in compute and raster passes.
pub struct GpuRenderer {
    gpu: Gpu,
    mesh: Arc<TetMesh>,
    settings: Settings,
    buffers: MeshBuffers,
    ranges: Vec<TetRange>,
    chunk_cells: u32,
    range_uniforms: Vec<wgpu::Buffer>,
    chunk_uniforms: Vec<wgpu::Buffer>,
    cells: CellBuffers,
    indices: wgpu::Buffer,
    frame: wgpu::Buffer,
    sorter: Sorter,
    scene: Option<SceneState>,
    target: Option<Target>,
}

/// Buffers with an entry a cell (or a bit, or a block of 256 cells).
struct CellBuffers {
    candidates: wgpu::Buffer,
    clipped: wgpu::Buffer,
    survivors: wgpu::Buffer,
    block_counts: wgpu::Buffer,
    counts: wgpu::Buffer,
    draws: wgpu::Buffer,
    projected: wgpu::Buffer,
    projected_gradients: wgpu::Buffer,
    corners: wgpu::Buffer,
    keys: wgpu::Buffer,
    order: wgpu::Buffer,
}

/// What depends on the transfer function and the projection kind: specialised kernels.
struct SceneState {
    transfer: TransferBuffers,
    perspective: bool,
    vertices: Kernel,
    cull: Kernel,
    compact: Kernel,
    keys: Kernel,
    project: Kernel,
    raster: DrawKernel,
    resolve: DrawKernel,
}

/// What depends on the picture's size.
struct Target {
    size: [u32; 2],
    blended: wgpu::TextureView,
    picture: wgpu::Texture,
    picture_view: wgpu::TextureView,
}

impl GpuRenderer {
    /// Uploads the mesh.
    ///
    /// # Errors
    /// A mesh beyond the device's limits (with the numbers), a device that refuses.
    pub fn new(gpu: Gpu, mesh: Arc<TetMesh>, settings: Settings) -> Result<Self> {
        let buffers = MeshBuffers::new(&gpu, &mesh, 0, 0)?;
        let ranges = ranges(buffers.tet_count, gpu.max_binding);
        check_size(&gpu, &buffers, &ranges)?;
        let range_uniforms = ranges
            .iter()
            .map(|r| {
                let range = layout::Range { first_tet: r.first, tet_count: r.count, ..Default::default() };
                gpu.uniform("range", &[range])
            })
            .collect();
        let chunk_cells = chunk_cells(buffers.tet_count);
        let chunk_uniforms = (0..buffers.tet_count)
            .step_by(chunk_cells as usize)
            .map(|first_cell| {
                gpu.uniform("chunk", &[layout::Chunk { first_cell, cells: chunk_cells, ..Default::default() }])
            })
            .collect();
        let cells = CellBuffers::new(&gpu, &buffers, chunk_cells);
        let indices = outline_indices(chunk_cells);
        let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST;
        let index_buffer = gpu.buffer("indices", indices.len() as u64 * 4, usage);
        gpu.write(&index_buffer, 0, bytemuck::cast_slice(&indices));
        let frame = gpu.uniform("frame", &[layout::Frame::default()]);
        let on_host = match settings.sort {
            SortPlace::Auto => gpu.is_software(),
            SortPlace::Host => true,
            SortPlace::Gpu => false,
        };
        let sorter = Sorter::new(&gpu, buffers.tet_count, on_host)?;
        Ok(Self {
            gpu,
            mesh,
            settings,
            buffers,
            ranges,
            chunk_cells,
            range_uniforms,
            chunk_uniforms,
            cells,
            indices: index_buffer,
            frame,
            sorter,
            scene: None,
            target: None,
        })
    }

    /// Makes kernels and marks candidates where the transfer function or the kind of projection changed.
    fn prepare_scene(&mut self, transfer: &TransferFunction, perspective: bool) -> Result<()> {
        if self.scene.as_ref().is_some_and(|s| s.transfer.source == *transfer && s.perspective == perspective) {
            return Ok(());
        }
        let b = &self.buffers;
        let transfer = TransferBuffers::new(&self.gpu, transfer, b.scalar, b.gradient, self.mesh.data_per_mesh)?;
        if transfer.bivariate {
            self.buffers.need_gradients(&self.gpu, &self.mesh, 0);
            self.cells.need_gradients(&self.gpu, &self.buffers);
        }
        let mut constants = transfer.constants.clone();
        let flag = |b: bool| f64::from(u8::from(b));
        constants.push(("PERSPECTIVE", flag(perspective)));
        constants.push(("CULL", flag(self.settings.cull)));
        constants.push(("TET_PARTS", self.ranges.len() as f64));
        if let Some(first) = self.ranges.first() {
            constants.push(("TETS_A_PART", f64::from(first.count)));
        }
        let candidates = self.gpu.kernel("candidates", &constants)?;
        self.write_frame(&layout::Frame {
            tet_count: self.buffers.tet_count,
            vertex_count: self.buffers.vertex_count,
            ..Default::default()
        });
        let mut recorder = Recorder::new(&self.gpu, false);
        for (range, uniform) in self.ranges.iter().zip(&self.range_uniforms) {
            let resources = self.range_resources(self.resources(Some(&transfer)), *range, uniform);
            recorder.compute(&candidates, &candidates.bind(&self.gpu, &resources)?, Work::Items(range.count))?;
        }
        recorder.submit();
        let blended = wgpu::ColorTargetState {
            format: wgpu::TextureFormat::Rgba32Float,
            blend: Some(BACK_TO_FRONT),
            write_mask: wgpu::ColorWrites::ALL,
        };
        let written = wgpu::ColorTargetState { blend: None, ..blended.clone() };
        let attributes = wgpu::vertex_attr_array![
            0 => Float32x2, 1 => Float32x2, 2 => Float32x3, 3 => Float32x2, 4 => Float32x2
        ];
        let (entries, used) = match transfer.bivariate {
            true => (["vertex_bivariate", "fragment_bivariate"], 5),
            false => (["vertex", "fragment"], 4),
        };
        let corners = wgpu::VertexBufferLayout {
            array_stride: attributes[used - 1].offset + attributes[used - 1].format.size(),
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &attributes[..used],
        };
        self.scene = Some(SceneState {
            perspective,
            vertices: self.gpu.kernel("vertices", &constants)?,
            cull: self.gpu.kernel("cull", &constants)?,
            compact: self.gpu.kernel("compact", &constants)?,
            keys: self.gpu.kernel("keys", &constants)?,
            project: self.gpu.kernel("project", &constants)?,
            raster: self.gpu.draw_kernel("raster", entries, &constants, blended, &[Some(corners)])?,
            resolve: self.gpu.draw_kernel("resolve", ["vertex", "fragment"], &constants, written, &[])?,
            transfer,
        });
        Ok(())
    }

    fn prepare_target(&mut self, size: [u32; 2]) -> Result<()> {
        if self.target.as_ref().is_some_and(|t| t.size == size) {
            return Ok(());
        }
        let most = self.gpu.device.limits().max_texture_dimension_2d;
        if size[0] == 0 || size[1] == 0 || size[0] > most || size[1] > most {
            return Err(Error::Asked(format!(
                "a picture of {}x{} pixels is not possible on '{}': each side must be 1 to {most}",
                size[0], size[1], self.gpu.info.name
            )));
        }
        let texture = |label, usage| {
            self.gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba32Float,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let blended = texture("blended", wgpu::TextureUsages::TEXTURE_BINDING);
        let picture = texture("picture", wgpu::TextureUsages::COPY_SRC);
        self.target = Some(Target {
            size,
            blended: blended.create_view(&wgpu::TextureViewDescriptor::default()),
            picture_view: picture.create_view(&wgpu::TextureViewDescriptor::default()),
            picture,
        });
        Ok(())
    }

    fn resources<'a>(&'a self, transfer: Option<&'a TransferBuffers>) -> Resources<'a> {
        let (b, c) = (&self.buffers, &self.cells);
        let mut r = Resources::default()
            .with("frame", &self.frame)
            .with("vertices", &b.vertices)
            .with("gradients", &b.gradients)
            .with("projected", &c.projected)
            .with("projected_gradients", &c.projected_gradients)
            .with("clipped", &c.clipped)
            .with("block_counts", &c.block_counts)
            .with("counts", &c.counts)
            .with("draws", &c.draws)
            .with("corners", &c.corners)
            .with("volumes", &b.volumes)
            .with("keys", &c.keys)
            .with("order", &c.order);
        for (i, name) in ["tets_a", "tets_b", "tets_c", "tets_d"].into_iter().enumerate() {
            let part = self
                .ranges
                .get(i)
                .or(self.ranges.first())
                .map_or((0, 16), |p| (u64::from(p.first) * 16, u64::from(p.count) * 16));
            r = r.with_part(name, &b.tets, part.0, part.1);
        }
        if let Some(t) = transfer {
            r = r.with("widgets", &t.widgets).with("pieces", &t.pieces).with("piece_starts", &t.piece_starts);
        }
        r
    }

    /// The parts of the per-cell buffers that belong to one range.
    fn range_resources<'a>(&'a self, r: Resources<'a>, range: TetRange, uniform: &'a wgpu::Buffer) -> Resources<'a> {
        let (first, count) = (u64::from(range.first), u64::from(range.count));
        let blocks = count.div_ceil(256);
        let (b, c) = (&self.buffers, &self.cells);
        r.with("range", uniform)
            .with_part("tets", &b.tets, first * 16, count * 16)
            .with_part("volumes", &b.volumes, first * 4, count * 4)
            .with_part("candidates", &c.candidates, first / 8, blocks * 32)
            .with_part("survivors", &c.survivors, first / 8, blocks * 32)
            .with_part("block_counts", &c.block_counts, first / 64, blocks * 4)
            .with_part("block_offsets", &c.block_counts, first / 64, blocks * 4)
    }

    fn write_frame(&self, frame: &layout::Frame) {
        self.gpu.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(frame));
    }

    /// Records and submits a frame; the picture is left in the target.
    fn draw_frame(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Stats> {
        let perspective = matches!(frame.camera.projection, Projection::Perspective { .. });
        self.prepare_scene(frame.transfer, perspective)?;
        self.prepare_target(frame.size)?;
        self.write_frame(&frame_uniform(frame, &self.mesh, &self.buffers, self.chunk_cells));
        let scene = self.scene.as_ref().ok_or_else(unprepared)?;
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let mut recorder = Recorder::new(&self.gpu, timed);
        let all = self.resources(Some(&scene.transfer));
        let gpu = &self.gpu;

        recorder.compute(&scene.vertices, &scene.vertices.bind(gpu, &all)?, Work::Items(self.buffers.vertex_count))?;
        for (range, uniform) in self.ranges.iter().zip(&self.range_uniforms) {
            let part = self.range_resources(all.clone(), *range, uniform);
            recorder.compute(&scene.cull, &scene.cull.bind(gpu, &part)?, Work::Items(range.count))?;
        }
        recorder.compute(&scene.compact, &scene.compact.bind(gpu, &all)?, Work::Groups(1))?;
        for (range, uniform) in self.ranges.iter().zip(&self.range_uniforms) {
            let part = self.range_resources(all.clone(), *range, uniform);
            recorder.compute(&scene.keys, &scene.keys.bind(gpu, &part)?, Work::Items(range.count))?;
        }
        self.sorter.sort(gpu, &mut recorder, &self.cells.counts, &self.cells.keys, &self.cells.order)?;
        let raster_groups = scene.raster.bind(gpu, &all)?;
        let mut load = wgpu::LoadOp::Clear(wgpu::Color { r: 0.0, g: 0.0, b: 0.0, a: 1.0 });
        for (chunk, uniform) in (0u64..).zip(&self.chunk_uniforms) {
            let resources = all.clone().with("chunk", uniform);
            recorder.compute(&scene.project, &scene.project.bind(gpu, &resources)?, Work::Items(self.chunk_cells))?;
            recorder.draw(&scene.raster, &raster_groups, &target.blended, load, |pass| {
                pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
                pass.set_vertex_buffer(0, self.cells.corners.slice(..));
                pass.draw_indexed_indirect(&self.cells.draws, chunk * 20);
            })?;
            load = wgpu::LoadOp::Load;
        }
        let textures = all.clone().with_texture("blended", &target.blended).with_texture("behind", &target.blended);
        let overwrite = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        recorder.draw(
            &scene.resolve,
            &scene.resolve.bind(gpu, &textures)?,
            &target.picture_view,
            overwrite,
            |pass| {
                pass.draw(0..3, 0..1);
            },
        )?;
        let passes = recorder.finish()?;
        Ok(Stats { passes, adapter: self.gpu.describe(), buffers: self.buffer_sizes(), ..Default::default() })
    }

    fn buffer_sizes(&self) -> Vec<BufferSize> {
        let (b, c) = (&self.buffers, &self.cells);
        [
            ("vertices", &b.vertices),
            ("gradients", &b.gradients),
            ("tets", &b.tets),
            ("volumes", &b.volumes),
            ("candidates", &c.candidates),
            ("clipped", &c.clipped),
            ("survivors", &c.survivors),
            ("block_counts", &c.block_counts),
            ("draws", &c.draws),
            ("projected", &c.projected),
            ("projected_gradients", &c.projected_gradients),
            ("corners", &c.corners),
            ("keys", &c.keys),
            ("order", &c.order),
            ("indices", &self.indices),
        ]
        .into_iter()
        .chain(self.sorter.buffers())
        .map(|(name, buffer)| BufferSize { name: name.to_owned(), bytes: buffer.size() })
        .collect()
    }

    fn read_picture(&self) -> Result<Image> {
        let target = self.target.as_ref().ok_or_else(unprepared)?;
        let [width, height] = target.size;
        let row = (u64::from(width) * 16).next_multiple_of(u64::from(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT));
        let usage = wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ;
        let staging = self.gpu.buffer("picture, mapped", row * u64::from(height), usage);
        let mut recorder = Recorder::new(&self.gpu, false);
        recorder.encoder().copy_texture_to_buffer(
            target.picture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row as u32),
                    rows_per_image: None,
                },
            },
            target.picture.size(),
        );
        recorder.submit();
        let texels: Vec<[f32; 4]> = self.gpu.map(&staging, row * u64::from(height))?;
        let mut image = Image::new(width, height);
        let rows = texels.chunks_exact((row / 16) as usize).zip(image.pixels.chunks_exact_mut(width as usize));
        for (from, to) in rows {
            to.copy_from_slice(&from[..width as usize]);
        }
        Ok(image)
    }
}

impl Renderer for GpuRenderer {
    fn render(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Rendered> {
        let mut stats = self.draw_frame(frame, timed)?;
        let survivors = self.sorter.survivors(&self.gpu, &self.cells.counts)?;
        stats.cells =
            vec![("mesh".to_owned(), u64::from(self.buffers.tet_count)), ("visible".to_owned(), u64::from(survivors))];
        Ok(Rendered { image: self.read_picture()?, stats })
    }

    fn render_only(&mut self, frame: &Frame<'_>) -> Result<Duration> {
        let start = Instant::now();
        self.draw_frame(frame, false)?;
        Ok(start.elapsed())
    }

    fn mesh(&self) -> &TetMesh {
        &self.mesh
    }
}

/// Colour behind is scaled by the transmittance (in the source's alpha), and so is the transmittance behind.
const BACK_TO_FRONT: wgpu::BlendState = wgpu::BlendState {
    color: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::SrcAlpha,
        operation: wgpu::BlendOperation::Add,
    },
    alpha: wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::Zero,
        dst_factor: wgpu::BlendFactor::SrcAlpha,
        operation: wgpu::BlendOperation::Add,
    },
};

impl CellBuffers {
    fn new(gpu: &Gpu, mesh: &MeshBuffers, chunk_cells: u32) -> Self {
        let tets = u64::from(mesh.tet_count);
        let vertices = u64::from(mesh.vertex_count);
        let blocks = tets.div_ceil(256);
        let chunks = tets.div_ceil(u64::from(chunk_cells));
        let copied = STORAGE | wgpu::BufferUsages::COPY_SRC;
        let indirect = STORAGE | wgpu::BufferUsages::INDIRECT | wgpu::BufferUsages::COPY_SRC;
        Self {
            candidates: gpu.buffer("candidates", blocks * 32, STORAGE | wgpu::BufferUsages::COPY_DST),
            clipped: gpu.buffer("clipped", 16, STORAGE | wgpu::BufferUsages::COPY_DST),
            survivors: gpu.buffer("survivors", blocks * 32, copied),
            block_counts: gpu.buffer("block_counts", blocks * 4, STORAGE),
            counts: gpu.buffer("counts", size_of::<layout::Counts>() as u64, indirect),
            draws: gpu.buffer("draws", chunks * 20, STORAGE | wgpu::BufferUsages::INDIRECT),
            projected: gpu.buffer("projected", vertices * 16, STORAGE),
            projected_gradients: gpu.buffer("projected_gradients", 16, STORAGE),
            corners: gpu.buffer("corners", u64::from(chunk_cells) * CORNER_BYTES, STORAGE | wgpu::BufferUsages::VERTEX),
            keys: gpu.buffer("keys", tets * 4, copied),
            order: gpu.buffer("order", tets * 4, copied | wgpu::BufferUsages::COPY_DST),
        }
    }

    fn need_gradients(&mut self, gpu: &Gpu, mesh: &MeshBuffers) {
        if self.projected_gradients.size() == 16 {
            self.projected_gradients = gpu.buffer("projected_gradients", u64::from(mesh.vertex_count) * 4, STORAGE);
        }
    }
}

/// Cells projected and drawn at a time; their corners are made anew for each chunk. An eighth of the mesh, so that the
/// corners cost at most 22 bytes a tetrahedron of meshes above 131,072.
fn chunk_cells(tets: u32) -> u32 {
    (1u32 << (tets / 8).max(1).ilog2()).clamp(16_384, 262_144)
}

/// Each cell's outline as two triangles.
fn outline_indices(cells: u32) -> Vec<u32> {
    (0..cells).flat_map(|cell| [0, 1, 2, 0, 2, 3].map(|corner: u32| cell * 4 + corner)).collect()
}

/// Refuses meshes beyond the device, with the numbers.
fn check_size(gpu: &Gpu, mesh: &MeshBuffers, ranges: &[TetRange]) -> Result<()> {
    let tets = u64::from(mesh.tet_count);
    if ranges.len() > MOST_PARTS || tets * 4 > gpu.max_binding {
        let most = (gpu.max_binding / 4).min(MOST_PARTS as u64 * gpu.max_binding / 16);
        return Err(Error::Device(format!(
            "the mesh has {tets} tetrahedra and '{}' binds {} MiB at once, room for {most}; render with \
             --device oracle, or a coarser mesh",
            gpu.info.name,
            gpu.max_binding >> 20
        )));
    }
    Ok(())
}

/// The frame as shaders see it: mesh space, the eye in two f32 parts.
fn frame_uniform(frame: &Frame<'_>, mesh: &TetMesh, buffers: &MeshBuffers, chunk_cells: u32) -> layout::Frame {
    let camera: &Camera = frame.camera;
    let basis = camera.basis();
    let eye = mesh.mesh_from_data(camera.eye);
    let high = eye.as_vec3();
    let low = (eye - high.as_dvec3()).as_vec3();
    let [width, height] = frame.size.map(f64::from);
    let aspect = width / height;
    // Half the image's height at depth 1 (perspective) or everywhere (orthographic, mesh units).
    let half = match camera.projection {
        Projection::Perspective { fov_y } => (0.5 * fov_y).tan(),
        Projection::Orthographic { height } => 0.5 * height / mesh.data_per_mesh,
    };
    let row = |axis: DVec3, extent: f64| (axis / extent).as_vec3().to_array();
    layout::Frame {
        eye_high: high.to_array(),
        tet_count: buffers.tet_count,
        eye_low: low.to_array(),
        vertex_count: buffers.vertex_count,
        x_row: row(basis.right, half * aspect),
        pixel_width: width as f32,
        y_row: row(basis.up, half),
        pixel_height: height as f32,
        forward: basis.forward.as_vec3().to_array(),
        ray_scale_x: (2.0 * half / height) as f32,
        ray_scale_y: (-2.0 * half / height) as f32,
        ray_offset_x: (-half * aspect) as f32,
        ray_offset_y: half as f32,
        chunk_cells,
        background: frame.background,
    }
}

fn unprepared() -> Error {
    Error::Device("internal: a frame was drawn before it was prepared".to_owned())
}
