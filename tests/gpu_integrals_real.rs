//! Pictures by every integral on real meshes against the oracle's, cells in the same order.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::sync::Arc;

use common::integral_scene::curve;
use common::{folder, gpu, meshes};
use glam::DVec3;
use tetralux::image::Comparison;
use tetralux::oracle::Oracle;
use tetralux::plan::order::centroid_depth;
use tetralux::renderer::{Frame, Renderer as _, SegmentIntegral, Settings};
use tetralux::scene::{Camera, Optics, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::TetMesh;

const SIZE: [u32; 2] = [128, 128];

fn camera(mesh: &TetMesh) -> Camera {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let eye = target + diagonal * DVec3::new(0.6, 0.5, 0.8);
    Camera { eye, target, up: DVec3::Y, projection: Projection::Perspective { fov_y: 0.7 }, near: None }
}

/// A turned Gaussian, a wave and a ramp, overlapping, each of a colour.
fn widgets(mesh: &TetMesh) -> TransferFunction {
    let (s, g) = (mesh.scalar_range(), mesh.gradient_range());
    let (_, diagonal) = meshes::center_and_diagonal(mesh);
    let at = |x: f64| s.min + x * s.length();
    let gaussian = WidgetShape::Gaussian {
        center: [at(0.4), g.min + 0.15 * g.length()],
        sigma: [0.05 * s.length(), 0.2 * g.length()],
        angle: 0.2 * s.length() / g.length(),
    };
    let wave = WidgetShape::Triangle {
        direction: [1.0 / s.length(), 0.0],
        offset: s.min / s.length(),
        period: 0.2,
        duty: 0.5,
    };
    let ramp = WidgetShape::Ramp { direction: [1.0, 0.0], knots: vec![[at(0.3), 0.0], [at(0.5), 1.0], [at(0.9), 0.2]] };
    TransferFunction::Widgets(vec![
        Widget::new(gaussian, [1.0, 0.8, 0.1], 60.0 / diagonal),
        Widget::new(wave, [0.9, 0.1, 0.2], 20.0 / diagonal),
        Widget::new(ramp, [0.1, 0.4, 1.0], 6.0 / diagonal),
    ])
}

struct Expected {
    integral: &'static str,
    /// At least, decibels.
    psnr: f64,
    /// At most, of the 99.9th percentile of the pixels' errors.
    percentile: f64,
}

const fn expected(integral: &'static str, psnr: f64, percentile: f64) -> Expected {
    Expected { integral, psnr, percentile }
}

/// What a comparison fails, if anything.
fn failure(c: &Comparison, limit: &Expected) -> Option<String> {
    let good = c.psnr >= limit.psnr && c.percentile_99_9 <= limit.percentile;
    (!good).then(|| format!("{}: {:.1} dB, 99.9% {:.1e}", limit.integral, c.psnr, c.percentile_99_9))
}

fn check(mesh: &Arc<TetMesh>, what: &str, transfer: &TransferFunction, limits: &[Expected]) {
    let camera = camera(mesh);
    let frame = Frame { camera: &camera, transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.0; 4] };
    let want = Oracle::new(mesh.clone()).render_in_order(&frame, &centroid_depth(mesh, &camera)).expect("a picture");
    let seen = want.pixels.iter().filter(|p| p[3] > 0.01).count();
    assert!(seen > 1_000, "{what}: seen in {seen} pixels");
    println!("{what}:");
    let mut wrong = Vec::new();
    for limit in limits {
        let integral: SegmentIntegral = limit.integral.parse().expect("an integral");
        for method in gpu::PROJECTIONS {
            let mut renderer = gpu::renderer(mesh, Settings { integral, ..gpu::by(method) });
            let got = renderer.render(&frame, false).expect("a picture").image;
            let c = Comparison::new(&got, &want).expect("equal sizes");
            let (psnr, percentile) = (c.psnr, c.percentile_99_9);
            println!(
                "    {:18} {method:8?} {psnr:6.1} dB  99.9% {percentile:.1e}  worst {:.1e}",
                limit.integral, c.max
            );
            wrong.extend(failure(&c, limit).map(|f| format!("{method:?}, {f}")));
        }
        let mut planted = want.clone();
        planted.pixels.iter_mut().step_by(500).for_each(|p| p[1] += 1.1 * limit.percentile as f32);
        let planted = Comparison::new(&planted, &want).expect("equal sizes");
        assert!(failure(&planted, limit).is_some(), "a planted error went unnoticed");
    }
    assert!(wrong.is_empty(), "{what}: {wrong:#?}");
}

fn by_every_integral(mesh: &Arc<TetMesh>, what: &str) {
    check(mesh, &format!("{what}, widgets"), &widgets(mesh), WIDGETS);
    check(mesh, &format!("{what}, curve"), &curve(mesh), CURVE);
}

/// The worst of four meshes measured beside. Where colours are exact, what is left are edges that the rasteriser rounds.
const WIDGETS: &[Expected] = &[
    expected("adaptive:1e-4", 84.0, 5e-4), // Post 86.2, 3.0e-4; the others 93.8 to 113.9
    expected("adaptive:1e-3", 84.0, 5e-4), // Post 86.2, 3.0e-4; the others 93.1 to 100.8
    expected("analytic", 58.0, 2.5e-2),    // fire 60.0, 1.9e-2
    expected("partial-direct", 44.0, 8e-2), // fire 45.8, 6.5e-2: Gaussians linear by standard deviations
    expected("partial", 44.0, 8e-2),       // the same
    expected("segmented:10", 74.0, 2.5e-3), // fire 76.6, 1.8e-3
    expected("mean-scalar", 38.0, 1.6e-1), // fire 39.7, 1.2e-1
    expected("vertex-linear", 33.0, 2.2e-1), // fire 35.0, 1.7e-1
];
const CURVE: &[Expected] = &[
    expected("adaptive", 90.0, 3e-4),       // Post 92.3, 1.9e-4; the others 102.4 to 108.8
    expected("analytic", 90.0, 3e-4),       // the same
    expected("partial-direct", 90.0, 3e-4), // the same
    expected("partial", 90.0, 3e-4),        // the same
    expected("preintegrated:256", 56.0, 3e-2), // Blunt Fin 58.7, 2.2e-2
    expected("segmented:10", 54.0, 3e-2),   // fire 56.1, 2.4e-2
    expected("mean-scalar", 29.0, 4e-1),    // fire 31.0, 3.2e-1
    expected("vertex-linear", 28.0, 4.5e-1), // fire 29.4, 3.7e-1
];

fn read(file: &str, array: &str) -> Arc<TetMesh> {
    meshes::read(&folder("TETRALUX_DATA").join("tet").join(file), array)
}

#[test]
#[ignore = "needs TETRALUX_DATA"]
fn the_blunt_fin() {
    by_every_integral(&read("bluntfin_tet.vtu", "Density"), "Blunt Fin");
}

#[test]
#[ignore = "needs TETRALUX_DATA"]
fn the_post() {
    by_every_integral(&read("post_tet.vtu", "StagnationEnergy"), "Post");
}

#[test]
#[ignore = "needs TETRALUX_DATA"]
fn the_disk() {
    by_every_integral(&read("disk_out_ref.vtu", "Temp"), "disk_out_ref");
}

#[test]
#[ignore = "takes a minute"]
fn the_fire() {
    by_every_integral(&meshes::fire(), "fire");
}
