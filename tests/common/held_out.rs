//! Scenes that no choice was made from: sums of widgets at random over samples and the fire.

use std::sync::Arc;

use glam::DVec3;
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, Renderer, choose_integral};
use tetralux::scene::{Camera, Curve, CurveNode, Optics, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::TetMesh;

use super::meshes;
use super::random::Random;

/// Larger than the pictures by which integrals are chosen, and of another shape.
const SIZE: [u32; 2] = [180, 120];

pub struct Scene {
    pub name: String,
    pub mesh: Arc<TetMesh>,
    pub transfer: TransferFunction,
    pub camera: Camera,
}

impl Scene {
    pub fn frame(&self) -> Frame<'_> {
        let Self { transfer, camera, .. } = self;
        Frame { camera, transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.0; 4] }
    }
}

/// A few widgets of one kind or of several, from wide to narrow, from thin to dense.
fn widgets(mesh: &TetMesh, random: &mut Random, count: usize) -> TransferFunction {
    let (s, g) = (mesh.scalar_range(), mesh.gradient_range());
    let (_, diagonal) = meshes::center_and_diagonal(mesh);
    let one = |random: &mut Random| {
        let center = [s.min + random.within(0.1, 0.9) * s.length(), g.min + random.within(0.05, 0.8) * g.length()];
        let extinction = 10f64.powf(random.within(0.3, 2.2)) / diagonal;
        let color = random.in_cube().to_array();
        let shape = match (3.0 * random.unit()) as u32 {
            0 => WidgetShape::Uniform,
            _ => WidgetShape::Gaussian {
                center,
                sigma: [random.within(0.02, 0.3) * s.length(), random.within(0.05, 0.5) * g.length()],
                angle: 0.0,
            },
        };
        let low = s.min + random.within(0.0, 0.7) * s.length();
        let scalar_range = (shape == WidgetShape::Uniform).then_some([low, low + random.within(0.1, 0.3) * s.length()]);
        Widget { scalar_range, ..Widget::new(shape, color, extinction) }
    };
    TransferFunction::Widgets((0..count).map(|_| one(random)).collect())
}

/// Deterministic.
pub fn scenes() -> Vec<Scene> {
    let mut random = Random(20_26);
    let named = [
        ("fire", meshes::fire()),
        ("sphere flow", meshes::sample(Sample::SphereFlow, 6_000)),
        ("hydrogen", meshes::sample(Sample::Hydrogen, 9_000)),
    ];
    let mut scenes = Vec::new();
    for (name, mesh) in named {
        let (center, diagonal) = meshes::center_and_diagonal(&mesh);
        for count in [1, 2, 4] {
            let transfer = widgets(&mesh, &mut random, count);
            let eye = center + random.within(0.9, 1.6) * diagonal * random.direction();
            let projection = Projection::Perspective { fov_y: random.within(0.4, 0.9) };
            let camera = Camera { eye, target: center, up: DVec3::new(0.1, 0.2, 1.0), projection, near: None };
            scenes.push(Scene { name: format!("{name}, {count} widgets"), mesh: mesh.clone(), transfer, camera });
        }
    }
    scenes
}

/// Functions of the scalar alone, from few narrow bands to the whole range, from so thin that no order of cells matters to
/// dense, over the same meshes and the same places.
pub fn curves() -> Vec<Scene> {
    let mut random = Random(26_11);
    let of = |scene: Scene| {
        let (range, diagonal) = (scene.mesh.scalar_range(), meshes::center_and_diagonal(&scene.mesh).1);
        let width = 10f64.powf(random.within(-1.7, 0.0));
        let depth = 10f64.powf(random.within(-1.0, 1.5));
        // Around what is somewhere in the mesh.
        let vertex = (random.unit() * scene.mesh.scalar.len() as f64) as usize;
        let low = ((scene.mesh.scalar[vertex] - range.min) / range.length() - 0.5 * width).clamp(0.0, 1.0 - width);
        let mut node = |at: f64, depth: f64| CurveNode {
            scalar: range.min + at * range.length(),
            color: random.in_cube().to_array(),
            extinction: depth / width / diagonal,
        };
        let nodes = vec![node(low, 0.0), node(low + 0.5 * width, depth), node(low + width, 0.0)];
        let name = format!("{}: a curve of width {width:.2} and depth {depth:.2}", scene.name);
        Scene { name, transfer: TransferFunction::Curve(Curve { nodes }), ..scene }
    };
    scenes().into_iter().map(of).collect()
}

/// What is chosen for a tolerance, and by how much the picture errs.
pub fn chosen(scene: &Scene, renderer: &mut dyn Renderer, tolerance: f64) -> (String, f64) {
    let Scene { mesh, .. } = scene;
    let frame = scene.frame();
    let choice = choose_integral(renderer, &frame, tolerance).expect("a choice");
    let got = renderer.render(&frame, false).expect("a picture").image;
    let want = Oracle::new(mesh.clone()).image(&frame).expect("the truth");
    assert!(want.pixels.iter().filter(|p| p[3] > 1e-3).count() > 20, "{}: nothing is seen", scene.name);
    (choice.integral.to_string(), tetralux::image::Comparison::new(&got, &want).expect("equal sizes").max)
}
