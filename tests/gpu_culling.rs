//! Dropping cells that the transfer function leaves empty changes no picture, and most of the empty ones are dropped.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::sync::Arc;

use common::gpu::{self, cells, draw};
use common::meshes;
use glam::DVec3;
use tetralux::image::{Comparison, Image};
use tetralux::mesh::synth::Sample;
use tetralux::renderer::Settings;
use tetralux::scene::{
    Camera, Curve, CurveNode, Projection, SinusoidVariant, TransferFunction, Widget, WidgetShape, Window,
};
use tetralux::tet::TetMesh;

const SIZE: [u32; 2] = [256, 256];
/// Every dropped cell would have added 1e-9 at most, but drawing it rounds the pixel by 6e-8 now and then, and there are
/// some tens on a ray. Measured: 1.3e-6.
const LIMIT: f64 = 2e-6;
/// The optical depth below which a cell is empty.
const INVISIBLE: f64 = 1e-9;
/// Least share of the empty cells that is dropped.
const DROPPED: f64 = 0.9;

/// The widest gap between neighbouring vertex values in the middle of the sorted values.
fn gap(values: &[f64]) -> [f64; 2] {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    let middle = &sorted[sorted.len() / 10..sorted.len() * 9 / 10];
    let widest = middle.windows(2).max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0]))).expect("values");
    [widest[0], widest[1]]
}

/// A transfer function, with the points of the (scalar, gradient) plane where its extinction is greatest.
struct Case {
    name: &'static str,
    transfer: TransferFunction,
    peak: [f64; 2],
    univariate: bool,
}

fn widget(shape: WidgetShape, extinction: f64, ranges: [Option<[f64; 2]>; 2]) -> TransferFunction {
    let [scalar_range, gradient_range] = ranges;
    TransferFunction::Widgets(vec![Widget {
        scalar_range,
        gradient_range,
        ..Widget::new(shape, [0.9, 0.6, 0.3], extinction)
    }])
}

/// Functions that no vertex value meets, and two wider ones over both axes.
fn cases(mesh: &TetMesh) -> Vec<Case> {
    let (_, diagonal) = meshes::center_and_diagonal(mesh);
    let [low, high] = gap(&mesh.scalar);
    let at = |x: f64| low + x * (high - low);
    let gradient = mesh.gradient_range();
    let (s, g) = (mesh.scalar_range().length(), gradient.length());
    let peak = [at(0.5), gradient.min + 0.3 * g];
    let gaussian = |sigma, angle| WidgetShape::Gaussian { center: peak, sigma, angle };
    // Thin things need much extinction to be seen.
    let thin = 30.0 / diagonal * s / (high - low);
    let node = |x, extinction| CurveNode { scalar: at(x), color: [0.9, 0.6, 0.3], extinction };
    let curve = TransferFunction::Curve(Curve { nodes: vec![node(0.3, 0.0), node(0.5, thin), node(0.7, 0.0)] });
    let wide = 30.0 / diagonal;
    let case = |name, transfer, univariate| Case { name, transfer, peak, univariate };
    let tent = vec![[at(0.3), 0.0], [at(0.5), 1.0], [at(0.7), 0.0]];
    let period = 3.0 * s;
    let isolated = WidgetShape::Triangle {
        direction: [1.0, 0.0],
        offset: peak[0] - 0.5 * period,
        period,
        duty: 0.4 * (high - low) / period,
    };
    let wave = |variant, periods: f64| WidgetShape::Sinusoid {
        direction: [1.0 / s, 0.5 / g],
        offset: 0.1 + peak[0] / s,
        period: periods,
        variant,
    };
    let windowed = |shape: WidgetShape, extinction, direction, knots| {
        let window = Some(Window { direction, knots });
        TransferFunction::Widgets(vec![Widget { window, ..Widget::new(shape, [0.9, 0.6, 0.3], extinction) }])
    };
    let steep = |a: f64, b: f64| vec![[gradient.min + a * g, 0.0], [gradient.min + b * g, 1.0]];
    vec![
        case("isolated tent", widget(isolated, thin, [None; 2]), true),
        case("ramp", widget(WidgetShape::Ramp { direction: [1.0, 0.0], knots: tent.clone() }, thin, [None; 2]), true),
        case("window", windowed(WidgetShape::Uniform, thin, [1.0, 0.0], tent), true),
        case("half wave", widget(wave(SinusoidVariant::Half, 0.4), wide, [None; 2]), false),
        case("wave in a window", windowed(wave(SinusoidVariant::Cos, 0.3), wide, [0.0, 1.0], steep(0.2, 0.5)), false),
        case("band", widget(WidgetShape::Uniform, thin, [Some([at(0.4), at(0.6)]), None]), true),
        case("narrow Gaussian", widget(gaussian([0.02 * (high - low), 1e9 * g], 0.0), 5.0 * thin, [None; 2]), true),
        case("curve's peak", curve, true),
        case("turned Gaussian", widget(gaussian([0.02 * s, 0.1 * g], 0.2 * s / g), wide, [None; 2]), false),
        case(
            "Gaussian in a box",
            widget(
                gaussian([0.1 * s, 0.2 * g], 0.0),
                wide,
                [Some([at(0.4), at(0.4) + 0.1 * s]), Some([gradient.min + 0.1 * g, gradient.min + 0.4 * g])],
            ),
            false,
        ),
    ]
}

/// All of the mesh in the picture.
fn camera(mesh: &TetMesh) -> Camera {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let eye = target + 1.6 * diagonal * DVec3::new(0.6, 0.5, 0.7).normalize();
    Camera { eye, target, up: DVec3::Y, projection: Projection::Perspective { fov_y: 0.7 }, near: None }
}

/// Largest extinction found in the cell, at a lattice of points and, for functions of the scalar alone, at its peak.
fn densest(mesh: &TetMesh, tet: &[u32; 4], case: &Case) -> f64 {
    const STEPS: u32 = 12;
    let at = |weights: [u32; 4], values: &[f64]| -> f64 {
        tet.iter().zip(weights).map(|(&v, w)| values[v as usize] * f64::from(w)).sum::<f64>() / f64::from(STEPS)
    };
    let extinction = |s, g| case.transfer.extinction_and_emission(s, g).0;
    let mut most = 0.0f64;
    for a in 0..=STEPS {
        for b in 0..=STEPS - a {
            for c in 0..=STEPS - a - b {
                let weights = [a, b, c, STEPS - a - b - c];
                most = most.max(extinction(at(weights, &mesh.scalar), at(weights, &mesh.gradient_magnitude)));
            }
        }
    }
    if case.univariate {
        let scalars = tet.map(|v| mesh.scalar[v as usize]);
        let range = scalars.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], &s| [l.min(s), h.max(s)]);
        most = most.max(extinction(case.peak[0].clamp(range[0], range[1]), case.peak[1]));
    }
    most
}

fn longest_edge(mesh: &TetMesh, tet: &[u32; 4]) -> f64 {
    let corners = tet.map(|v| mesh.vertices[v as usize]);
    let pairs = corners.iter().flat_map(|a| corners.iter().map(move |b| a.distance(*b)));
    pairs.fold(0.0, f64::max) * mesh.data_per_mesh
}

fn same_picture(a: &Image, b: &Image) -> Result<f64, String> {
    let comparison = Comparison::new(a, b).expect("equal sizes");
    if comparison.max <= LIMIT { Ok(comparison.max) } else { Err(comparison.to_string()) }
}

fn changes_no_picture(mesh: &Arc<TetMesh>, what: &str) {
    let camera = camera(mesh);
    let mut all = gpu::renderer(mesh, Settings { cull: false, ..gpu::by_centroids() });
    let mut culled = gpu::renderer(mesh, gpu::by_centroids());
    for case in cases(mesh) {
        let want = draw(&mut all, &camera, &case.transfer, SIZE);
        let got = draw(&mut culled, &camera, &case.transfer, SIZE);
        let seen = want.image.pixels.iter().filter(|p| p[3] > 0.01).count();
        assert!(seen > 100, "{what}, {}: the widget is seen in {seen} pixels", case.name);
        let difference = same_picture(&got.image, &want.image).unwrap_or_else(|e| panic!("{what}, {}: {e}", case.name));
        let mut planted = want.image.clone();
        planted.pixels[seen][2] += 1.1 * LIMIT as f32;
        assert!(same_picture(&planted, &want.image).is_err(), "a planted error went unnoticed");

        let empty = mesh.tets.iter().filter(|t| densest(mesh, t, &case) * longest_edge(mesh, t) <= INVISIBLE).count();
        let dropped = mesh.tets.len() - cells(&got, "that the function can show") as usize;
        let share = dropped as f64 / empty as f64;
        println!(
            "{what}, {}: {} cells, {empty} are empty, {dropped} dropped ({share:.4}); largest difference {difference:.1e}",
            case.name,
            mesh.tets.len()
        );
        assert!((DROPPED..=1.0).contains(&share), "{what}, {}: {dropped} of {empty} dropped", case.name);
    }
}

#[test]
fn culling_changes_no_picture_of_the_fire() {
    changes_no_picture(&meshes::fire(), "fire");
}

#[test]
fn culling_changes_no_picture_of_a_sample() {
    changes_no_picture(&meshes::sample(Sample::Tangle, 20_000), "tangle");
}
