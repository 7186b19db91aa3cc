//! What is drawn.

use std::sync::Arc;

use glam::DVec3;
use tetralux::gpu::{GridCaster, GridRenderer, RayCaster};
use tetralux::image::{Comparison, Image};
use tetralux::mesh::{ArrayInfo, Association, DataArray, Mesh, Topology};
use tetralux::renderer::{Frame, OrderMethod, Rendered, Renderer, Settings};
use tetralux::scene::{Camera, Curve, CurveNode, Optics, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::{Domain as _, FieldChoice, Grid, HexSplit, TetMesh};

use crate::common::gpu;

/// Linear float: the most that pictures of the implied and of the explicit tetrahedra may differ.
pub const MOST: f64 = 1e-5;

pub const STRUCTURED: Settings = Settings { order: OrderMethod::Structured, ..DEFAULT };
const DEFAULT: Settings = Settings {
    method: tetralux::renderer::Method::Project,
    integral: tetralux::renderer::SegmentIntegral::Adaptive { tolerance: 1e-3 },
    order: OrderMethod::PerPixel,
    cull: true,
    sort: tetralux::renderer::SortPlace::Auto,
    blend: tetralux::renderer::BlendFormat::Auto,
    layout: tetralux::renderer::CellLayout::Auto,
    least_transmittance: 1e-5,
    tolerance: tetralux::renderer::TOLERANCE,
};

/// Samples of `value` at the corners of so many voxels.
pub fn lattice(voxels: [usize; 3], origin: DVec3, spacing: DVec3, value: impl Fn(DVec3) -> f64) -> Mesh {
    placed(voxels, |at| origin + spacing * at, value)
}

/// The same, where `place` puts the corner of whole numbers.
pub fn placed(voxels: [usize; 3], place: impl Fn(DVec3) -> DVec3, value: impl Fn(DVec3) -> f64) -> Mesh {
    let n = voxels.map(|n| n + 1);
    let at = |i: usize| DVec3::new((i % n[0]) as f64, (i / n[0] % n[1]) as f64, (i / n[0] / n[1]) as f64);
    let points: Vec<DVec3> = (0..n.iter().product()).map(|i| place(at(i))).collect();
    let values = points.iter().map(|&p| value(p)).collect();
    mesh_of(points, Topology::Structured { points: n, blank: Vec::new() }, values)
}

pub fn mesh_of(points: Vec<DVec3>, topology: Topology, values: Vec<f64>) -> Mesh {
    let (name, association, components) = ("value".to_owned(), Association::Point, 1);
    Mesh {
        points,
        topology,
        available: vec![ArrayInfo { name: name.clone(), association, components }],
        arrays: vec![DataArray { name, association, components, values }],
        notes: Vec::new(),
    }
}

/// Waves along no axis.
pub fn waves(p: DVec3) -> f64 {
    (1.9 * p.x + 0.4).sin() + (1.3 * p.y - 0.7 * p.z).cos() + 0.3 * (2.1 * p.z * p.x).sin()
}

/// The same grid, implied and explicit.
pub fn both(mesh: &Mesh) -> (Arc<Grid>, Arc<TetMesh>) {
    let (grid, _) = Grid::new(mesh.clone(), &FieldChoice::default()).unwrap_or_else(|e| panic!("{e}"));
    let (mesh, _) = TetMesh::new(mesh.clone(), &FieldChoice::default(), HexSplit::FiveAlternating).expect("tetrahedra");
    (Arc::new(grid), Arc::new(mesh))
}

pub fn renderer(grid: &Arc<Grid>, settings: Settings) -> GridRenderer {
    GridRenderer::new(gpu::device(), grid.clone(), settings).unwrap_or_else(|e| panic!("{e}"))
}

pub fn caster(grid: &Arc<Grid>, settings: Settings) -> GridCaster {
    GridCaster::new(gpu::device(), grid.clone(), settings).unwrap_or_else(|e| panic!("{e}"))
}

pub fn explicit(mesh: &Arc<TetMesh>) -> impl Renderer + use<> {
    gpu::renderer(mesh, DEFAULT)
}

pub fn explicit_rays(mesh: &Arc<TetMesh>) -> impl Renderer + use<> {
    RayCaster::new(gpu::device(), mesh.clone(), DEFAULT).unwrap_or_else(|e| panic!("{e}"))
}

pub fn draw(renderer: &mut dyn Renderer, camera: &Camera, transfer: &TransferFunction, size: [u32; 2]) -> Rendered {
    let frame = Frame { camera, transfer, optics: &Optics::PLAIN, size, background: [0.1, 0.2, 0.3, 1.0] };
    renderer.render(&frame, false).unwrap_or_else(|e| panic!("{e}"))
}

/// Two ranges of the scalar, each of two colours, and nothing between them.
pub fn univariate(grid: &Grid) -> TransferFunction {
    let (range, extent) = (grid.scalar_range(), grid.bounds_in_data().diagonal());
    let node = |(at, color, depth): (f64, [f64; 3], f64)| CurveNode {
        scalar: range.min + at * range.length(),
        color,
        extinction: depth / extent,
    };
    let nodes = [
        (0.0, [0.1, 0.2, 1.0], 1.0),
        (0.2, [0.1, 0.9, 0.9], 6.0),
        (0.4, [1.0, 1.0, 1.0], 0.0),
        (0.55, [0.9, 0.9, 0.1], 0.0),
        (0.75, [0.2, 0.8, 0.1], 9.0),
        (1.0, [1.0, 0.1, 0.1], 2.0),
    ];
    TransferFunction::Curve(Curve { nodes: nodes.map(node).to_vec() })
}

/// Boundaries and a peak, over both axes.
pub fn bivariate(grid: &Grid) -> TransferFunction {
    let (s, g, extent) = (grid.scalar_range(), grid.gradient_range(), grid.bounds_in_data().diagonal());
    let gaussian = |at: [f64; 2], color| {
        let center = [s.min + at[0] * s.length(), g.min + at[1] * g.length()];
        let sigma = [0.08 * s.length(), 0.15 * g.length()];
        Widget::new(WidgetShape::Gaussian { center, sigma, angle: 0.0 }, color, 30.0 / extent)
    };
    TransferFunction::Widgets(vec![gaussian([0.3, 0.3], [1.0, 0.5, 0.1]), gaussian([0.7, 0.5], [0.1, 0.4, 1.0])])
}

pub fn camera(eye: DVec3, target: DVec3, projection: Projection) -> Camera {
    Camera { eye, target, up: DVec3::new(0.13, 0.21, 0.9), projection, near: None }
}

pub const PERSPECTIVE: Projection = Projection::Perspective { fov_y: 0.7 };

/// One that looks from each octant.
pub fn octants(grid: &Grid, projection: Projection) -> Vec<Camera> {
    let bounds = grid.bounds_in_data();
    let from = |octant: u32| {
        let sign = |axis: u32| if octant >> axis & 1 == 1 { 1.0 } else { -1.0 };
        DVec3::new(sign(0), 0.71 * sign(1), 0.43 * sign(2)) * bounds.diagonal() * 1.1
    };
    (0..8).map(|octant| camera(bounds.center() + from(octant), bounds.center(), projection)).collect()
}

/// Fails unless the pictures agree to `most`, and unless anything is seen.
pub fn assert_agree(got: &Image, want: &Image, most: f64, what: &str) {
    let c = Comparison::new(got, want).expect("equal sizes");
    assert!(c.max <= most, "{what}: {c}");
    let first = want.pixels[0];
    let seen = want.pixels.iter().filter(|p| (0..3).any(|c| (p[c] - first[c]).abs() > 0.02)).count();
    assert!(seen > want.pixels.len() / 20, "{what}: {seen} pixels show anything");
}
