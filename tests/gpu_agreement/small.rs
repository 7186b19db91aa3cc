//! The bundled mesh and a procedural one, small pictures: every kind of transfer function, in a second each.

use std::sync::Arc;

use glam::DVec3;
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::plan::order::centroid_depth;
use tetralux::renderer::Frame;
use tetralux::scene::{Camera, Curve, CurveNode, Optics, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::TetMesh;

use crate::common::agreement::{Explainer, Limits, Verdict, assert_limits_bite};
use crate::common::gpu::PROJECTIONS;
use crate::common::{gpu, meshes};

const SIZE: [u32; 2] = [128, 128];
const ONE_COLOR: Limits = Limits { psnr: 75.0, percentile_99_9: 1e-3, explained_above: 2e-3 };
/// Within a cell the colours of several widgets are weighted by their depths alone, as if evenly mixed (exact for one
/// colour): the error is that of a cell's share of the picture. Measured: 65 dB on the
/// fire and on the sample.
const MIXED: Limits = Limits { psnr: 62.0, percentile_99_9: f64::INFINITY, explained_above: f64::INFINITY };
const SHIFT: f64 = 1e-3;

/// Ranges of the mesh's fields, to place functions by.
struct Axes {
    scalar: [f64; 2],
    gradient: [f64; 2],
    diagonal: f64,
}

impl Axes {
    fn of(mesh: &TetMesh) -> Self {
        let (s, g) = (mesh.scalar_range(), mesh.gradient_range());
        let (_, diagonal) = meshes::center_and_diagonal(mesh);
        Self { scalar: [s.min, s.length()], gradient: [g.min, g.length()], diagonal }
    }

    fn s(&self, x: f64) -> f64 {
        self.scalar[0] + x * self.scalar[1]
    }

    fn g(&self, x: f64) -> f64 {
        self.gradient[0] + x * self.gradient[1]
    }

    fn widget(&self, shape: WidgetShape, color: [f64; 3], depth: f64) -> Widget {
        Widget::new(shape, color, depth / self.diagonal)
    }

    fn gaussian(&self, center: [f64; 2], sigma: [f64; 2], angle: f64) -> WidgetShape {
        let [s, g] = [self.scalar[1], self.gradient[1]];
        // The angle turns (scalar, gradient) in data units, so it is small where gradients are.
        let sigma = [sigma[0] * s, sigma[1] * g];
        WidgetShape::Gaussian {
            center: [self.s(center[0]), self.g(center[1])],
            sigma,
            angle: angle * sigma[0] / sigma[1],
        }
    }

    fn band(&self) -> Widget {
        let scalar_range = Some([self.s(0.3), self.s(0.35)]);
        Widget { scalar_range, ..self.widget(WidgetShape::Uniform, GOLD, 30.0) }
    }

    fn curve(&self, colors: [[f64; 3]; 5]) -> TransferFunction {
        let nodes = [(0.0, 0.0), (0.2, 8.0), (0.4, 0.0), (0.7, 3.0), (1.0, 20.0)];
        let node = |((x, depth), color)| CurveNode { scalar: self.s(x), color, extinction: depth / self.diagonal };
        TransferFunction::Curve(Curve { nodes: nodes.into_iter().zip(colors).map(node).collect() })
    }
}

impl Axes {
    /// 400 nodes, every second without extinction.
    fn teeth(&self) -> TransferFunction {
        let node = |i: u32| CurveNode {
            scalar: self.s(f64::from(i) / 399.0),
            color: GOLD,
            extinction: f64::from(i % 2) * 6.0 / self.diagonal,
        };
        TransferFunction::Curve(Curve { nodes: (0..400).map(node).collect() })
    }
}

const GOLD: [f64; 3] = [0.9, 0.6, 0.3];
const BLUE: [f64; 3] = [0.1, 0.3, 0.9];

fn cameras(mesh: &TetMesh) -> [Camera; 2] {
    cameras_from(mesh, DVec3::new(0.7, 0.45, 0.85))
}

fn cameras_from(mesh: &TetMesh, first: DVec3) -> [Camera; 2] {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let eye = |away: DVec3| target + diagonal * away;
    let perspective = Projection::Perspective { fov_y: 0.8 };
    let flat = Projection::Orthographic { height: 0.8 * diagonal };
    [
        Camera { eye: eye(first), target, up: DVec3::Y, projection: perspective, near: None },
        Camera { eye: eye(DVec3::new(-0.5, 0.9, 0.3)), target, up: DVec3::Z, projection: flat, near: None },
    ]
}

/// Against the truth where `own_order` is false. True where the cells were drawn in bands.
fn agrees(mesh: &Arc<TetMesh>, what: &str, transfer: &TransferFunction, limits: Limits, own_order: bool) -> bool {
    agrees_from(mesh, what, transfer, limits, own_order, &cameras(mesh))
}

fn agrees_from(
    mesh: &Arc<TetMesh>,
    what: &str,
    transfer: &TransferFunction,
    limits: Limits,
    own_order: bool,
    cameras: &[Camera],
) -> bool {
    agrees_at(mesh, what, transfer, limits, own_order, cameras, SIZE)
}

fn agrees_at(
    mesh: &Arc<TetMesh>,
    what: &str,
    transfer: &TransferFunction,
    limits: Limits,
    own_order: bool,
    cameras: &[Camera],
    size: [u32; 2],
) -> bool {
    let mut in_bands = false;
    let mut renderers = PROJECTIONS.map(|method| (method, gpu::renderer(mesh, gpu::by(method))));
    let oracle = Oracle::new(mesh.clone());
    for &camera in cameras {
        let frame = Frame { camera: &camera, transfer, optics: &Optics::PLAIN, size, background: [0.0; 4] };
        let want = match own_order {
            true => oracle.render_in_order(&frame, &centroid_depth(mesh, &camera)),
            false => oracle.image(&frame),
        };
        let want = want.expect("a picture");
        let seen = want.pixels.iter().filter(|p| p[3] > 0.01).count();
        assert!(seen > 1_000, "{what}: seen in {seen} pixels");
        let explainer = Explainer { mesh, frame, view: oracle.view(&frame).expect("a view"), shift: SHIFT };
        for (method, renderer) in &mut renderers {
            let drawn = gpu::draw(renderer, &camera, transfer, size);
            in_bands = drawn.stats.cells.iter().any(|(stage, _)| stage == "spans of them");
            let verdict = Verdict::new(&drawn.image, &want, limits, |pixel, error| explainer.cause(pixel, error));
            println!("{what}, {method:?}: {verdict}");
            verdict.assert_good(&format!("{what}, {method:?}"));
        }
        if limits.explained_above.is_finite() {
            assert_limits_bite(&want, limits);
        }
    }
    in_bands
}

fn all_functions(mesh: &Arc<TetMesh>, what: &str) {
    let axes = Axes::of(mesh);
    let uniform = |depth| axes.widget(WidgetShape::Uniform, GOLD, depth);
    let turned = axes.widget(axes.gaussian([0.4, 0.2], [0.03, 0.2], 0.7), GOLD, 30.0);
    let in_ranges = Widget {
        scalar_range: Some([axes.s(0.03), axes.s(0.6)]),
        gradient_range: Some([axes.g(0.02), axes.g(0.5)]),
        ..axes.widget(axes.gaussian([0.3, 0.2], [0.3, 0.2], 0.0), GOLD, 20.0)
    };
    for (name, transfer) in [
        ("uniform", TransferFunction::Widgets(vec![uniform(2.0)])),
        ("band", TransferFunction::Widgets(vec![axes.band()])),
        ("turned Gaussian", TransferFunction::Widgets(vec![turned.clone()])),
        ("Gaussian with ranges", TransferFunction::Widgets(vec![in_ranges.clone()])),
        ("several", TransferFunction::Widgets(vec![turned.clone(), in_ranges.clone(), axes.band(), uniform(0.5)])),
    ] {
        agrees(mesh, &format!("{what}, {name}"), &transfer, ONE_COLOR, false);
    }
    let in_bands = agrees(mesh, &format!("{what}, curve"), &axes.curve([GOLD; 5]), ONE_COLOR, false);
    assert!(in_bands, "{what}: few spans, and not drawn by them");
    let teeth = axes.teeth();
    assert!(
        !agrees(mesh, &format!("{what}, many nodes"), &teeth, ONE_COLOR, false),
        "{what}: too many spans for the room"
    );
    let colors = [GOLD, BLUE, [1.0; 3], [0.0, 0.9, 0.2], [0.8, 0.0, 0.1]];
    agrees(mesh, &format!("{what}, curve of colours, own order"), &axes.curve(colors), ONE_COLOR, true);
    let mixed = TransferFunction::Widgets(vec![turned, Widget { color: BLUE, ..in_ranges }]);
    agrees(mesh, &format!("{what}, widgets of colours, own order"), &mixed, MIXED, true);
}

/// The rasteriser snaps three corners of a cell, on a line within 0.003 pixel, each its own way, by 0.002.
#[test]
fn a_face_seen_edge_on_agrees() {
    let mesh = meshes::sample(Sample::Tangle, 20_000);
    let transfer = TransferFunction::Widgets(vec![Axes::of(&mesh).band()]);
    let [camera, _] = cameras_from(&mesh, DVec3::new(0.7, 0.5, 0.8));
    agrees_from(&mesh, "tangle, edge-on", &transfer, ONE_COLOR, false, &[camera]);
}

#[test]
fn the_fire_agrees() {
    all_functions(&meshes::fire(), "fire");
}

#[test]
fn a_sample_agrees() {
    all_functions(&meshes::sample(Sample::Tangle, 20_000), "tangle");
}
