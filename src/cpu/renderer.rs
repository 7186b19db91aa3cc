//! Pictures by ray casting on the CPU.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::Vec4;
use pulp::Arch;

use crate::cpu::cast::Setting;
use crate::cpu::empty::EmptyCells;
use crate::cpu::picture::{Picture, TILE};
use crate::cpu::segment::LaneByLane;
use crate::cpu::transfer::{Compiled, known};
use crate::cpu::widgets::Axes;
use crate::error::{Error, Result};
use crate::image::Image;
use crate::plan::entries::BoundaryView;
use crate::plan::eye;
use crate::plan::lens::Lens;
use crate::renderer::{
    BufferSize, Frame, Method, PassTime, RayCounts, Rendered, Renderer, SegmentIntegral, Settings, Stats,
};
use crate::scene::{Optics, TransferFunction};
use crate::tet::{LinkedMesh, TetMesh};

/// Renders one mesh by casting rays through its cells, in f32 on all cores.
pub struct CpuRenderer {
    mesh: Arc<TetMesh>,
    cells: LinkedMesh,
    settings: Settings,
    /// The instructions to use: the widest that the processor has.
    arch: Arch,
    scene: Option<Scene>,
}

/// What depends on the transfer function.
struct Scene {
    source: TransferFunction,
    compiled: Compiled,
    empty: EmptyCells,
}

/// Whether this engine can render with these.
///
/// # Errors
/// What it cannot.
pub fn supports(transfer: &TransferFunction, optics: &Optics, integral: SegmentIntegral) -> Result<()> {
    if *optics != Optics::PLAIN {
        return Err(Error::Asked(
            "unweighted emission, lighting and silhouettes cannot be cast on the CPU yet: use --device oracle".into(),
        ));
    }
    known(transfer, integral)
}

impl CpuRenderer {
    /// Finds neighbours and reorders cells.
    ///
    /// # Errors
    /// [`Error::Asked`] for a method that is not ray casting.
    pub fn new(mesh: Arc<TetMesh>, settings: Settings) -> Result<Self> {
        if matches!(settings.method, Method::Project | Method::CellCast) {
            return Err(Error::Asked(
                "the CPU engine casts rays: ask for --method raycast, or for project and cellcast with --device gpu"
                    .into(),
            ));
        }
        let cells = LinkedMesh::new(&mesh);
        Ok(Self { mesh, cells, settings, arch: Arch::new(), scene: None })
    }

    /// Another field, time step or place of the vertices, on the same tetrahedra: links nothing anew.
    ///
    /// # Errors
    /// A mesh of other tetrahedra.
    pub fn replace(&mut self, mesh: Arc<TetMesh>) -> Result<()> {
        self.cells.replace(&self.mesh, &mesh)?;
        self.mesh = mesh;
        // Functions are normalised to the field's ranges, and what is transparent has changed.
        self.scene = None;
        Ok(())
    }

    /// Compiles the transfer function where it changed.
    fn prepare_scene(&mut self, frame: &Frame<'_>) -> Result<()> {
        supports(frame.transfer, frame.optics, self.settings.integral)?;
        if frame.size.contains(&0) {
            return Err(Error::Asked("the image has no pixels: ask for at least 1x1".into()));
        }
        if self.scene.as_ref().is_some_and(|scene| scene.source == *frame.transfer) {
            return Ok(());
        }
        let cells = &self.cells;
        let (scalar, gradient, data_per_mesh) = (cells.scalar, cells.gradient, self.mesh.data_per_mesh);
        // Fields at the ends of ranges are means of f32 values, and err by about as much.
        let axes = Axes { scalar, gradient, data_per_mesh, range_hair: 1e-7 };
        let compiled = Compiled::new(frame.transfer, self.settings.integral, &axes)?;
        let empty = if self.settings.cull { EmptyCells::new(cells, &compiled) } else { EmptyCells::none(cells) };
        self.scene = Some(Scene { source: frame.transfer.clone(), compiled, empty });
        Ok(())
    }

    fn draw(&mut self, frame: &Frame<'_>) -> Result<Drawn> {
        let start = Instant::now();
        self.prepare_scene(frame)?;
        let scene = self.scene.as_ref().ok_or_else(|| Error::Asked("no scene was prepared".into()))?;
        let prepared = start.elapsed();
        let lens = Lens::new(frame.camera, frame.size, &*self.mesh);
        let around = eye::sides_around(&self.cells, &lens);
        let picture = Picture {
            arch: self.arch,
            setting: Setting { mesh: &self.cells, lens: &lens, around: &around },
            view: BoundaryView::new(&self.cells.boundary, &lens, frame.size, TILE, &around),
            empty: &scene.empty,
            size: frame.size,
            background: Vec4::from(frame.background),
            least: self.settings.least_transmittance as f32,
        };
        let binned = start.elapsed();
        let bivariate = scene.compiled.is_bivariate();
        let (image, counts) = match &scene.compiled {
            Compiled::Curve(medium) => picture.cast(medium, medium, bivariate),
            Compiled::Plain(medium) => picture.cast(medium, medium, bivariate),
            Compiled::Any(medium) => picture.cast(&LaneByLane(medium), medium, bivariate),
            Compiled::Adaptive(medium) => picture.cast(&LaneByLane(medium), medium, bivariate),
            Compiled::Partial(medium) => picture.cast(&LaneByLane(medium), medium, bivariate),
            Compiled::Points(medium) => picture.cast(&LaneByLane(medium), medium, bivariate),
            Compiled::PreIntegrated(medium) => picture.cast(&LaneByLane(medium), medium, bivariate),
        };
        let cast = start.elapsed();
        Ok(Drawn { image, counts, times: [prepared, binned - prepared, cast - binned] })
    }

    fn stats(&self, drawn: &Drawn, timed: bool) -> Stats {
        let scene = self.scene.as_ref();
        let cells = self.cells.cells.len() as u64;
        let visible = cells - scene.map_or(0, |s| s.empty.count());
        let steps = drawn.counts.steps;
        let work = [
            format!("{cells} cells"),
            format!("{} boundary faces", self.cells.boundary.faces.len()),
            format!("{steps} steps"),
        ];
        let names = ["host: classify", "host: bin", "host: cast"];
        let passes = names.into_iter().zip(work).zip(drawn.times);
        let pass = |((name, work), time): ((&str, String), Duration)| PassTime { pass: name.into(), work, time };
        let sizes = self.cells.sizes().into_iter();
        let sizes = sizes.chain(scene.map(|s| ("empty cells", s.empty.bytes())));
        Stats {
            pipelines: Default::default(),
            cells: vec![("in the mesh".into(), cells), ("that the function can show".into(), visible)],
            rays: Some(drawn.counts),
            passes: if timed { passes.map(pass).collect() } else { Vec::new() },
            buffers: sizes.map(|(name, bytes)| BufferSize { name: name.into(), bytes: bytes as u64 }).collect(),
            adapter: describe(),
            order: "along each ray: exact".to_owned(),
            inversions: None,
            notes: Vec::new(),
        }
    }
}

struct Drawn {
    image: Image,
    counts: RayCounts,
    times: [Duration; 3],
}

/// What stands for an adapter where rays are cast on the host.
pub fn describe() -> String {
    format!("CPU ({} threads, ray casting)", rayon::current_num_threads())
}

impl Renderer for CpuRenderer {
    fn render(&mut self, frame: &Frame<'_>, timed: bool) -> Result<Rendered> {
        let drawn = self.draw(frame)?;
        let stats = self.stats(&drawn, timed);
        Ok(Rendered { image: drawn.image, stats })
    }

    fn render_only(&mut self, frame: &Frame<'_>) -> Result<Duration> {
        let start = Instant::now();
        self.draw(frame)?;
        Ok(start.elapsed())
    }

    fn set_integral(&mut self, integral: SegmentIntegral) {
        self.settings.integral = integral;
        self.scene = None;
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    #[cfg(target_arch = "x86_64")]
    use pulp::x86::{V3, V4};

    use super::*;
    use crate::mesh::synth::{Sample, tet_box};
    use crate::scene::{Camera, Curve, CurveNode, Projection, Widget, WidgetShape};
    use crate::tet::{BuildOptions, FieldChoice};

    /// All that this processor has.
    fn instructions() -> Vec<Arch> {
        let mut all = vec![Arch::Scalar];
        #[cfg(target_arch = "x86_64")]
        all.extend(V3::try_new().map(Arch::V3).into_iter().chain(V4::try_new().map(Arch::V4)));
        #[cfg(not(target_arch = "x86_64"))]
        all.push(Arch::new());
        all
    }

    fn largest_difference(a: &Image, b: &Image) -> f32 {
        let pairs = a.pixels.iter().flatten().zip(b.pixels.iter().flatten());
        // Phrased so that NaN is the largest.
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, |most, x| if x <= most { most } else { x })
    }

    /// A jittered box from outside, and a regular one along its axes, where rays meet vertices, edges and faces
    /// edge-on, with pixels at powers of two.
    #[test]
    fn pictures_do_not_depend_on_the_instructions() {
        let eye = DVec3::new(2.0, 3.0, 4.0);
        let up = DVec3::Y;
        let from_outside =
            Camera { eye, target: DVec3::ZERO, up, projection: Projection::Perspective { fov_y: 0.6 }, near: None };
        let projection = Projection::Orthographic { height: 4.0 };
        let along_axis = Camera { eye: DVec3::new(0.0, 0.0, 3.0), projection, ..from_outside };
        let node = |scalar, extinction| CurveNode { scalar, color: [scalar, 0.5, 1.0 - scalar], extinction };
        let nodes = vec![node(0.0, 0.1), node(0.3, 0.4), node(0.6, 0.2), node(1.0, 9.0)];
        let shape = WidgetShape::Gaussian { center: [0.4, 1.0], sigma: [0.2, 2.0], angle: 0.0 };
        let clipped =
            Widget { scalar_range: Some([0.5, 0.7]), ..Widget::new(WidgetShape::Uniform, [0.2, 0.9, 0.5], 0.3) };
        let widgets = vec![Widget::new(shape, [1.0, 0.5, 0.2], 0.5), clipped];
        // Both widgets' colours mixed evenly: one medium in lanes.
        let settings = Settings { integral: SegmentIntegral::Analytic, ..Settings::default() };
        let transfers = [TransferFunction::Curve(Curve { nodes }), TransferFunction::Widgets(widgets)];
        let meshes = [(Sample::MarschnerLobb.mesh(3_000), "ml", from_outside), (tet_box(8, 0.0, 1), "x", along_axis)];
        for ((mesh, field, camera), transfer) in meshes.iter().flat_map(|mesh| transfers.iter().map(move |t| (mesh, t)))
        {
            let (mesh, _) =
                TetMesh::new(mesh.clone(), &FieldChoice::parse(field), BuildOptions::default()).expect("a mesh");
            let mut renderer = CpuRenderer::new(Arc::new(mesh), settings).expect("a renderer");
            let optics = &Optics::PLAIN;
            let frame = Frame { camera, transfer, optics, size: [64, 64], background: [0.0; 4] };
            let drawn: Vec<Drawn> = instructions()
                .into_iter()
                .map(|arch| {
                    renderer.arch = arch;
                    renderer.draw(&frame).expect("a picture")
                })
                .collect();
            assert!(drawn[0].counts.steps > 10_000, "{:?}", drawn[0].counts);
            for other in &drawn[1..] {
                assert_eq!(other.counts, drawn[0].counts);
                // Products and sums are rounded together or not: 6e-7.
                let difference = largest_difference(&other.image, &drawn[0].image);
                assert!(difference < 2e-6, "{difference}");
            }
            let mut planted = drawn[0].image.clone();
            planted.pixels[2080][1] += 3e-6;
            assert!(largest_difference(&planted, &drawn[0].image) > 2e-6);
        }
    }
}
