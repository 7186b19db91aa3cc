//! Blending in f16 slabs against f32, pictures that strain the numbers, and cameras far away.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::sync::Arc;

use common::gpu::{PROJECTIONS, by, draw, renderer};
use common::meshes;
use glam::DVec3;
use tetralux::image::{Comparison, Image};
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::renderer::{BlendFormat, Frame, Method, Settings, SortPlace};
use tetralux::scene::{Camera, Curve, CurveNode, Optics, Projection, TransferFunction};
use tetralux::tet::TetMesh;

const SIZE: [u32; 2] = [96, 96];

/// Largest error of a channel that f16 slabs may have. Measured on lavapipe, which rounds halves towards zero: 4.5e-3;
/// without slabs 3e-2 and more.
const F16_ERROR: f64 = 1e-2;

fn curve(mesh: &TetMesh, extinctions: [f64; 3], colors: [[f64; 3]; 3]) -> TransferFunction {
    let range = mesh.scalar_range();
    let nodes = (0..3).map(|i| CurveNode {
        scalar: range.min + 0.5 * i as f64 * range.length(),
        color: colors[i],
        extinction: extinctions[i],
    });
    TransferFunction::Curve(Curve { nodes: nodes.collect() })
}

fn rainbow(mesh: &TetMesh, depth: f64) -> TransferFunction {
    let k = depth / meshes::center_and_diagonal(mesh).1;
    curve(mesh, [0.5 * k, k, 2.0 * k], [[1.0, 0.2, 0.1], [0.2, 1.0, 0.1], [0.1, 0.2, 1.0]])
}

/// `distance` in diagonals; the mesh fills the picture.
fn camera(mesh: &TetMesh, distance: f64, perspective: bool) -> Camera {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let eye = target + distance * diagonal * DVec3::new(0.5, 0.62, 0.6).normalize();
    let projection = match perspective {
        true => Projection::Perspective { fov_y: 2.0 * (0.5 / distance).atan() },
        false => Projection::Orthographic { height: diagonal },
    };
    Camera { eye, target, up: DVec3::Y, projection, near: None }
}

fn truth(mesh: &Arc<TetMesh>, camera: &Camera, transfer: &TransferFunction) -> Image {
    let frame = Frame { camera, transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.0; 4] };
    Oracle::new(mesh.clone()).image(&frame).expect("a picture")
}

#[test]
fn f16_slabs_come_near_f32() {
    PROJECTIONS.into_iter().for_each(f16_slabs_of);
}

fn f16_slabs_of(method: Method) {
    // More than 64 layers, so that there are several slabs, and several frames, so that they are found and kept.
    let mesh = meshes::sample(Sample::Tangle, 60_000);
    let (camera, transfer) = (camera(&mesh, 2.0, true), rainbow(&mesh, 4.0));
    let want = draw(&mut renderer(&mesh, by(method)), &camera, &transfer, SIZE).image;
    let mut f16 = renderer(&mesh, Settings { blend: BlendFormat::F16, ..by(method) });
    let first = draw(&mut f16, &camera, &transfer, SIZE);
    let again = draw(&mut f16, &camera, &transfer, SIZE);
    assert_eq!(first.image, again.image);
    let note = first.stats.notes.iter().find(|n| n.contains("f16")).expect("a note on slabs");
    assert!(!note.contains("in 1 slabs"), "{note}");
    let comparison = Comparison::new(&first.image, &want).expect("equal sizes");
    println!("f16, {method:?}, {note}: largest error {:.1e}, PSNR {:.1}", comparison.max, comparison.psnr);
    assert!(comparison.max <= F16_ERROR && comparison.psnr > 45.0, "{comparison}");
    assert!(comparison.max > 0.0, "f16 was not used");
    let mut planted = first.image;
    planted.pixels[SIZE[0] as usize * 48 + 48][0] += 1.5 * F16_ERROR as f32;
    assert!(Comparison::new(&planted, &want).expect("equal sizes").max > F16_ERROR);
}

#[test]
fn ramps_to_absurd_extinctions_end() {
    // A loop that took steps too small never ended here.
    let mesh = meshes::sample(Sample::Tangle, 2_000);
    let colors = [[1.0, 0.5, 0.2]; 3];
    for top in [1e4, 1e9, 1e20] {
        let transfer = curve(&mesh, [0.0, 0.0, top], colors);
        let camera = camera(&mesh, 2.0, true);
        let got = draw(&mut renderer(&mesh, common::gpu::by_centroids()), &camera, &transfer, SIZE).image;
        let comparison = Comparison::new(&got, &truth(&mesh, &camera, &transfer)).expect("equal sizes");
        println!(
            "up to {top:.0e}: {} pixels above 2e-3, {} not finite",
            comparison.pixels_above(2e-3).count(),
            comparison.not_finite
        );
        assert_eq!(comparison.not_finite, 0);
        // The surface where it begins is as steep as a silhouette. At 1e20 the reference's quadrature fails, not this.
        if top < 1e10 {
            assert!(comparison.pixels_above(2e-3).count() < 60, "{comparison}");
        }
    }
}

/// From transparent to opaque within less and less of the scalar's range; `before`: another node before, which makes the
/// step the upper band of its pair.
#[test]
fn steps_of_any_steepness_are_drawn() {
    let mesh = meshes::sample(Sample::Tangle, 2_000);
    let (range, k) = (mesh.scalar_range(), 6.0 / meshes::center_and_diagonal(&mesh).1);
    let camera = camera(&mesh, 2.0, true);
    for width in [1e-3, 1e-5, 1e-7, 1e-8] {
        for before in [false, true] {
            let middle = [(0.4, 0.0), (0.5, 0.0), (0.5 + width, k)];
            let nodes = middle[usize::from(!before)..].iter().map(|&(x, extinction)| CurveNode {
                scalar: range.min + x * range.length(),
                color: [1.0, 0.5, 0.2],
                extinction,
            });
            let transfer = TransferFunction::Curve(Curve { nodes: nodes.collect() });
            let want = truth(&mesh, &camera, &transfer);
            for method in PROJECTIONS {
                let drawn = draw(&mut renderer(&mesh, by(method)), &camera, &transfer, SIZE);
                assert!(drawn.stats.pipelines.contains("bands"), "{}", drawn.stats.pipelines);
                let comparison = Comparison::new(&drawn.image, &want).expect("equal sizes");
                let what = format!("a step {width:.0e} wide, {before}, {method:?}");
                println!("{what}: PSNR {:.1}, largest {:.1e}", comparison.psnr, comparison.max);
                // Its surface is a silhouette.
                assert!(comparison.not_finite == 0 && comparison.psnr > 70.0, "{what}: {comparison}");
            }
        }
    }
}

/// The host knows which draws hold no deep cells; a GPU that sorts does not. Of 20,000 cells some are deep.
#[test]
fn draws_with_and_without_deep_cells_agree() {
    let mesh = meshes::sample(Sample::Tangle, 20_000);
    let k = 1.0 / meshes::center_and_diagonal(&mesh).1;
    let transfer = curve(&mesh, [0.5 * k, 2.0 * k, 200.0 * k], [[1.0, 0.2, 0.1], [0.2, 1.0, 0.1], [0.1, 0.2, 1.0]]);
    let camera = camera(&mesh, 2.0, true);
    let by = |sort| {
        let mut renderer = renderer(&mesh, Settings { sort, ..common::gpu::by_centroids() });
        draw(&mut renderer, &camera, &transfer, [256, 256]).image
    };
    let comparison = Comparison::new(&by(SortPlace::Host), &by(SortPlace::Gpu)).expect("equal sizes");
    println!("deep and other draws: largest difference {:.1e}", comparison.max);
    assert!(comparison.max < 1e-5, "{comparison}");
    let want = Image { pixels: vec![[0.0; 4]; 256 * 256], width: 256, height: 256 };
    assert!(Comparison::new(&by(SortPlace::Host), &want).expect("equal sizes").max > 0.5, "something is seen");
}

#[test]
fn far_cameras_see_the_same() {
    let mesh = meshes::sample(Sample::Tangle, 6_000);
    let transfer = curve(&mesh, [0.5, 1.0, 2.0], [[1.0, 0.5, 0.2]; 3]);
    for perspective in [true, false] {
        for distance in [2.0, 1e3, 1e5] {
            let camera = camera(&mesh, distance, perspective);
            let want = truth(&mesh, &camera, &transfer);
            for method in PROJECTIONS {
                let got = draw(&mut renderer(&mesh, by(method)), &camera, &transfer, SIZE).image;
                let comparison = Comparison::new(&got, &want).expect("equal sizes");
                let what = format!("{distance:.0e} diagonals away, perspective {perspective}, {method:?}");
                println!("{what}: PSNR {:.1}", comparison.psnr);
                assert!(comparison.psnr > 75.0, "{what}: {comparison}");
            }
        }
    }
}
