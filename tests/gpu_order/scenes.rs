//! What is drawn, and what is asked of it.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use tetralux::gpu::GpuRenderer;
use tetralux::image::Image;
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, Rendered, Renderer as _, Settings};
use tetralux::scene::{Camera, Optics, Projection, TransferFunction};
use tetralux::tet::TetMesh;

use crate::common::agreement::{Cause, Explainer, Limits, Verdict, assert_limits_bite};
use crate::common::boxes::tet_mesh;
use crate::common::random::Random;
pub use crate::common::views::three as cameras;
use crate::common::{delaunay, gpu, meshes};

pub const SIZE: [u32; 2] = [160, 128];
/// Of an exact order; larger errors have to be explained.
pub const EXACT: Limits = Limits { psnr: 80.0, percentile_99_9: 1e-3, explained_above: 2e-3 };

fn field(p: DVec3) -> [f64; 2] {
    [p.x + 0.6 * (5.0 * p.y).sin() + 0.5 * p.z * p.z, 0.0]
}

/// A Delaunay mesh of random points in a cube, under a linear map of its places.
pub fn mapped_delaunay(map: DMat3) -> Arc<TetMesh> {
    let mesh = delaunay::cube(600, 30, 10, 5, field);
    let places: Vec<DVec3> = mesh.vertices.iter().map(|&p| mesh.data_from_mesh(p)).collect();
    let mapped: Vec<DVec3> = places.iter().map(|&p| map * p).collect();
    // The field stays with the vertices.
    Arc::new(TetMesh { scalar: mesh.scalar, ..tet_mesh(&mapped, mesh.tets.to_vec(), |_| [0.0, 0.0]) })
}

/// A layer as of a boundary: cells twenty times as wide as high, askew.
pub fn stretched() -> DMat3 {
    DMat3::from_cols(DVec3::new(1.0, 0.1, 0.0), DVec3::new(0.0, 1.0, 0.0), DVec3::new(0.2, 0.0, 0.05))
}

/// Vertices inside moved after meshing: no triangulation that a power diagram knows.
pub fn moved() -> Arc<TetMesh> {
    let mut mesh = Arc::unwrap_or_clone(meshes::sample(tetralux::mesh::synth::Sample::Tangle, 6_000));
    let mut random = Random(11);
    let before = mesh.vertices.clone();
    for (v, &old) in before.iter().enumerate() {
        let bounds = mesh.bounds();
        if (old - bounds.min).min_element() < 1e-6 || (bounds.max - old).min_element() < 1e-6 {
            continue;
        }
        let step = 0.03 * (random.in_cube() - 0.5);
        mesh.vertices[v] = old + step;
        let turned = |tet: &[u32; 4]| {
            let [a, b, c, d] = tet.map(|v| mesh.vertices[v as usize]);
            tet.contains(&(v as u32)) && (b - a).cross(c - a).dot(d - a) <= 1e-7
        };
        if mesh.tets.iter().any(turned) {
            mesh.vertices[v] = old;
        }
    }
    Arc::new(mesh)
}

/// Three cells each of which hides a part of the next, seen along z.
pub fn cycle() -> Arc<TetMesh> {
    let (mut points, mut tets) = (Vec::new(), Vec::new());
    for k in 0..3 {
        let turn = DMat3::from_rotation_z(std::f64::consts::TAU / 3.0 * f64::from(k));
        let first = points.len() as u32;
        points.extend(
            [(-1.2, 0.3, 0.3), (-1.2, 0.6, 0.3), (1.2, 0.45, -0.4), (1.2, 0.45, -0.2)]
                .map(|(x, y, z)| turn * DVec3::new(x, y, z)),
        );
        tets.push([first, first + 1, first + 2, first + 3]);
    }
    let mut mesh = tet_mesh(&points, tets, |p| [p.x - 0.3 * p.y + p.z, 0.0]);
    for tet in Arc::make_mut(&mut mesh.tets) {
        let [a, b, c, d] = tet.map(|v| mesh.vertices[v as usize]);
        if (b - a).cross(c - a).dot(d - a) < 0.0 {
            tet.swap(2, 3);
        }
    }
    // Each has a part of the range of its own.
    mesh.scalar = (0..12).map(|v| f64::from(v / 4) + 0.2 * f64::from(v % 4)).collect();
    Arc::new(mesh)
}

/// Along z, at [`cycle`].
pub fn along_z() -> Camera {
    Camera {
        eye: DVec3::new(0.0, 0.0, 6.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        projection: Projection::Perspective { fov_y: 0.5 },
        near: None,
    }
}

/// The true picture, and whether `got` is it within `limits`.
pub struct Truth<'a> {
    pub frame: Frame<'a>,
    pub image: Image,
    explainer: Explainer<'a>,
}

impl<'a> Truth<'a> {
    pub fn new(oracle: &'a Oracle, mesh: &'a TetMesh, frame: Frame<'a>) -> Self {
        let image = oracle.image(&frame).expect("a picture");
        let seen = image.pixels.iter().filter(|p| p[3] > 0.01).count();
        assert!(seen > 1_000, "seen in {seen} pixels");
        let explainer = Explainer { mesh, frame, view: oracle.view(&frame).expect("a view"), shift: 1e-3 };
        Self { frame, image, explainer }
    }

    pub fn verdict(&self, got: &Image, limits: Limits) -> Verdict {
        self.verdict_against(got, &self.image, limits)
    }

    /// As [`verdict`](Self::verdict), of another picture of the scene in the truth's place.
    pub fn verdict_against(&self, got: &Image, want: &Image, limits: Limits) -> Verdict {
        let opacity_errs = |[x, y]: [u32; 2], error| {
            let opacity = |image: &Image| f64::from(image.pixels[(y * image.width + x) as usize][3]);
            (opacity(got) - opacity(want)).abs() >= 0.9 * error
        };
        Verdict::new(got, want, limits, |pixel, error| match self.explainer.cause(pixel, error) {
            Cause::Unknown if opacity_errs(pixel, error) => Cause::Opacity,
            cause => cause,
        })
    }

    pub fn psnr(&self, got: &Image) -> f64 {
        self.verdict(got, Limits { explained_above: f64::INFINITY, ..EXACT }).comparison.psnr
    }

    /// Draws, compares and fails where the picture is not good.
    pub fn assert_drawn(&self, what: &str, renderer: &mut GpuRenderer) -> Rendered {
        let drawn = renderer.render(&self.frame, false).unwrap_or_else(|e| panic!("{what}: {e}"));
        let verdict = self.verdict(&drawn.image, EXACT);
        println!("{what}: {verdict}");
        verdict.assert_good(what);
        assert_limits_bite(&self.image, EXACT);
        drawn
    }
}

/// What opacities of a pixel, from the same fragments in two orders, differ by at most: seen from outside (measured:
/// 1.2e-7), and from within, where values near the eye are rounded otherwise in each pass (4.7e-5).
pub const ROUNDING: [f64; 2] = [1e-6, 2e-4];

/// Largest difference of a pixel's opacity.
fn opacity_difference(a: &Image, b: &Image) -> f64 {
    let pairs = a.pixels.iter().zip(&b.pixels);
    // Phrased so that NaN is the largest.
    pairs.map(|(a, b)| f64::from(a[3] - b[3]).abs()).fold(0.0, |most, x| if x <= most { most } else { x })
}

/// Fails unless opacities are those of the same cells, drawn by the same rasteriser in another order, which changes none: a
/// fragment that was lost or listed twice is seen, which the truth excuses as [`Cause::Opacity`].
pub fn assert_same_opacity(what: &str, got: &Image, sorted: &Image, limit: f64) {
    let difference = opacity_difference(got, sorted);
    println!("{what}: opacities differ by {difference:.1e}");
    assert!(difference <= limit, "{what}: opacities differ by {difference:.1e}");
    let mut planted = got.clone();
    let seen = planted.pixels.iter_mut().find(|p| p[3] > 0.1).expect("something is seen");
    seen[3] -= 2.0 * limit as f32;
    assert!(opacity_difference(&planted, got) > limit, "{what}: a planted difference was not seen");
}

/// A frame of plain optics.
pub fn plain<'a>(camera: &'a Camera, transfer: &'a TransferFunction) -> Frame<'a> {
    Frame { camera, transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.1, 0.2, 0.3, 1.0] }
}

/// PSNR of the picture of settings.
pub fn psnr(truth: &Truth<'_>, mesh: &Arc<TetMesh>, settings: Settings) -> f64 {
    truth.psnr(&gpu::renderer(mesh, settings).render(&truth.frame, false).expect("a picture").image)
}
