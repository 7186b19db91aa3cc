//! Lighting and silhouettes on the GPU against the oracle.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::sync::Arc;

use common::agreement::{Cause, Explainer, Limits, Verdict, assert_limits_bite};
use common::boxes::box_mesh;
use common::gpu::{PROJECTIONS, assert_same_bits, by, renderer};
use common::meshes;
use glam::DVec3;
use tetralux::gpu::GpuRenderer;
use tetralux::image::{Comparison, Image};
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::plan::order::centroid_depth;
use tetralux::renderer::{BlendFormat, Frame, Method, Rendered, Renderer as _, Settings};
use tetralux::scene::{
    Camera, Curve, CurveNode, EmissionModel, LightSpace, Lighting, Optics, Projection, Silhouette, SilhouetteMode,
    TransferFunction, Widget, WidgetShape,
};
use tetralux::tet::TetMesh;

const SIZE: [u32; 2] = [96, 96];
/// Against pictures composed in the renderer's own order, since colours differ from cell to cell. Measured: 102 to 134 dB,
/// 7.4e-5 and, the largest, 1.1e-3.
const LIMITS: Limits = Limits { psnr: 92.0, percentile_99_9: 2e-4, explained_above: 2e-3 };
/// Pixels; a picture that changes that much within it cannot be met.
const SHIFT: f64 = 1e-3;
const GOLD: [f64; 3] = [0.9, 0.6, 0.3];

fn lighting(space: LightSpace) -> Lighting {
    let direction = DVec3::new(0.3, 0.4, 0.9).normalize();
    Lighting { ambient: 0.3, diffuse: 0.6, specular: 0.4, shininess: 20.0, direction, space }
}

fn silhouette(mode: SilhouetteMode) -> Silhouette {
    Silhouette { exponent: 1.5, strength: 0.9, mode }
}

/// Every kind of shading, alone and together.
fn all_optics() -> [(&'static str, Optics); 5] {
    let optics = |space: Option<LightSpace>, mode: Option<SilhouetteMode>| Optics {
        lighting: space.map(lighting),
        silhouette: mode.map(silhouette),
        ..Optics::PLAIN
    };
    [
        ("lit in view", optics(Some(LightSpace::View), None)),
        ("outlined by opacity", optics(None, Some(SilhouetteMode::Opacity))),
        ("outlined by depth", optics(None, Some(SilhouetteMode::Depth))),
        ("lit in the world, by opacity", optics(Some(LightSpace::World), Some(SilhouetteMode::Opacity))),
        ("lit in view, by depth", optics(Some(LightSpace::View), Some(SilhouetteMode::Depth))),
    ]
}

fn curve(mesh: &TetMesh, nodes: impl Iterator<Item = (f64, f64)>) -> TransferFunction {
    let (range, diagonal) = (mesh.scalar_range(), meshes::center_and_diagonal(mesh).1);
    let node = |(x, depth): (f64, f64)| CurveNode {
        scalar: range.min + x * range.length(),
        color: GOLD,
        extinction: depth / diagonal,
    };
    TransferFunction::Curve(Curve { nodes: nodes.map(node).collect() })
}

/// So few nodes that there is room for all bands: cells are drawn in them, unless opacities are outlined.
fn bands(mesh: &TetMesh) -> TransferFunction {
    curve(mesh, [(0.0, 1.0), (0.6, 12.0), (1.0, 2.0)].into_iter())
}

/// 400 nodes, every second without extinction: too many for bands.
fn teeth(mesh: &TetMesh) -> TransferFunction {
    curve(mesh, (0..400).map(|i| (f64::from(i) / 399.0, f64::from(i % 2) * 6.0)))
}

/// A Gaussian of both fields, and one of the scalar alone.
fn gaussian(mesh: &TetMesh, bivariate: bool) -> TransferFunction {
    let (s, g) = (mesh.scalar_range(), mesh.gradient_range());
    let wide = if bivariate { 0.3 } else { 1e9 };
    let shape = WidgetShape::Gaussian {
        center: [s.min + 0.4 * s.length(), g.min + 0.2 * g.length()],
        sigma: [0.15 * s.length(), wide * g.length()],
        angle: 0.0,
    };
    let depth = 12.0 / meshes::center_and_diagonal(mesh).1;
    TransferFunction::Widgets(vec![Widget::new(shape, GOLD, depth)])
}

fn cameras(mesh: &TetMesh) -> [Camera; 2] {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let camera =
        |away: DVec3, up, projection| Camera { eye: target + diagonal * away, target, up, projection, near: None };
    [
        camera(DVec3::new(0.7, 0.45, 0.85), DVec3::Y, Projection::Perspective { fov_y: 0.8 }),
        camera(DVec3::new(-0.5, 0.9, 0.3), DVec3::Z, Projection::Orthographic { height: 0.8 * diagonal }),
    ]
}

/// In the middle of the mesh.
fn inside(mesh: &TetMesh) -> Camera {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let eye = target + diagonal * DVec3::new(0.03, -0.02, 0.05);
    let projection = Projection::Perspective { fov_y: 1.2 };
    Camera { eye, target: target + diagonal * DVec3::X, up: DVec3::Y, projection, near: None }
}

fn frame<'a>(camera: &'a Camera, transfer: &'a TransferFunction, optics: &'a Optics) -> Frame<'a> {
    Frame { camera, transfer, optics, size: SIZE, background: [0.0; 4] }
}

fn draw(renderer: &mut GpuRenderer, camera: &Camera, transfer: &TransferFunction, optics: &Optics) -> Rendered {
    renderer.render(&frame(camera, transfer, optics), false).unwrap_or_else(|e| panic!("{e}"))
}

fn in_bands(rendered: &Rendered) -> bool {
    rendered.stats.cells.iter().any(|(stage, _)| stage == "spans of them")
}

fn largest_difference(a: &Image, b: &Image) -> f64 {
    Comparison::new(a, b).expect("equal sizes").max
}

/// Pictures by all optics agree with the oracle's; `banded`: cells are drawn in bands where that is possible.
fn agrees(
    mesh: &Arc<TetMesh>,
    what: &str,
    transfer: &TransferFunction,
    cameras: &[Camera],
    limits: Limits,
    banded: bool,
) {
    let mut renderers = PROJECTIONS.map(|method| (method, renderer(mesh, by(method))));
    let oracle = Oracle::new(mesh.clone());
    let mut failures = Vec::new();
    for (index, camera) in cameras.iter().enumerate() {
        let plain = draw(&mut renderers[0].1, camera, transfer, &Optics::PLAIN).image;
        for (name, optics) in all_optics() {
            let frame = frame(camera, transfer, &optics);
            let want = oracle.render_in_order(&frame, &centroid_depth(mesh, camera)).expect("a picture");
            let seen = want.pixels.iter().filter(|p| p[3] > 0.01).count();
            assert!(seen > 500, "{what}, {name}: seen in {seen} pixels");
            let shading = largest_difference(&plain, &want);
            assert!(shading > 0.02, "{what}, {name}: shading changes {shading}");
            let explainer = Explainer { mesh, frame, view: oracle.view(&frame).expect("a view"), shift: SHIFT };
            if limits.explained_above.is_finite() {
                assert_limits_bite(&want, limits);
            }
            let by_opacity = optics.silhouette.is_some_and(|s| s.mode == SilhouetteMode::Opacity);
            // Lighting and silhouettes alone are parts of the same shader: outlines stand for both methods there.
            let together = optics.lighting.is_some() && optics.silhouette.is_some();
            for (method, renderer) in renderers.iter_mut().filter(|(m, _)| together || *m == Method::Project) {
                let what = format!("{what}, camera {index}, {name}, {method:?}");
                let drawn = draw(renderer, camera, transfer, &optics);
                assert_eq!(in_bands(&drawn), banded && !by_opacity, "{what}: bands");
                let verdict = Verdict::new(&drawn.image, &want, limits, |pixel, error| explainer.cause(pixel, error));
                println!("{what}: {verdict}");
                failures.extend(verdict.failures().into_iter().map(|f| format!("{what}: {f}")));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

macro_rules! agreements {
    ($($module:ident: $mesh:expr;)*) => {$(
        mod $module {
            use super::*;

            #[test]
            fn bands_agree() {
                let mesh = $mesh;
                agrees(&mesh, concat!(stringify!($module), ", bands"), &bands(&mesh), &cameras(&mesh), LIMITS, true);
            }

            #[test]
            fn many_nodes_agree() {
                let mesh = $mesh;
                agrees(&mesh, concat!(stringify!($module), ", teeth"), &teeth(&mesh), &cameras(&mesh), LIMITS, false);
            }

            #[test]
            fn a_bivariate_function_agrees() {
                let mesh = $mesh;
                let what = concat!(stringify!($module), ", bivariate");
                agrees(&mesh, what, &gaussian(&mesh, true), &cameras(&mesh), LIMITS, false);
            }

            #[test]
            fn a_function_of_the_scalar_agrees() {
                let mesh = $mesh;
                let what = concat!(stringify!($module), ", Gaussian");
                agrees(&mesh, what, &gaussian(&mesh, false), &cameras(&mesh), LIMITS, false);
            }
        }
    )*};
}

agreements! {
    fire: meshes::fire();
    tangle: meshes::sample(Sample::Tangle, 20_000);
}

const MIN: DVec3 = DVec3::new(-1.0, -1.0, -1.0);
const MAX: DVec3 = DVec3::new(1.0, 1.0, 1.0);
const GRADIENT: DVec3 = DVec3::new(0.5, -0.7, 1.1);

/// A cube of `6 n^3` cells with this gradient everywhere.
fn affine(n: usize) -> Arc<TetMesh> {
    Arc::new(box_mesh(n, MIN, MAX, |p| [GRADIENT.dot(p), GRADIENT.length()]))
}

fn uniform(depth: f64) -> TransferFunction {
    TransferFunction::Widgets(vec![Widget::new(WidgetShape::Uniform, GOLD, depth)])
}

/// In a field of one gradient, what the near plane cuts into pieces is shaded as the whole is, but for opacities, which
/// do not add.
#[test]
fn a_camera_inside_agrees() {
    let mesh = affine(4);
    let transfer = uniform(1.5);
    let camera = inside(&mesh);
    let oracle = Oracle::new(mesh.clone());
    for (method, (name, optics)) in PROJECTIONS.into_iter().flat_map(|m| all_optics().map(|o| (m, o))) {
        let mut renderer = renderer(&mesh, by(method));
        let drawn = draw(&mut renderer, &camera, &transfer, &optics);
        assert!(drawn.stats.notes.iter().any(|note| note.contains("pieces")), "{:?}", drawn.stats.notes);
        let frame = frame(&camera, &transfer, &optics);
        let want = oracle.image(&frame).expect("a picture");
        let verdict = Verdict::new(&drawn.image, &want, LIMITS, |_, _| Cause::Unknown);
        println!("inside, {name}, {method:?}: {verdict}");
        match optics.silhouette.map(|s| s.mode) {
            // Measured: 1.3e-2.
            Some(SilhouetteMode::Opacity) => assert!(verdict.comparison.max < 0.02, "{name}, {method:?}: {verdict}"),
            _ => verdict.assert_good(&format!("{name}, {method:?}")),
        }
    }
}

/// Pieces of cells near the eye are shaded by their own middles, which is finer than the oracle's whole cells: the
/// pictures differ by that. Measured: 79.8 dB (99.9 %: 1.0e-3) for the fire, 69.6 dB (1.7e-3) for the sample, whose cells
/// are larger.
#[test]
fn a_camera_inside_real_data_comes_near() {
    let limits = Limits { psnr: 67.0, percentile_99_9: 2.5e-3, explained_above: f64::INFINITY };
    for (name, mesh) in [("fire", meshes::fire()), ("tangle", meshes::sample(Sample::Tangle, 20_000))] {
        agrees(&mesh, &format!("inside {name}, bands"), &bands(&mesh), &[inside(&mesh)], limits, true);
        agrees(&mesh, &format!("inside {name}, bivariate"), &gaussian(&mesh, true), &[inside(&mesh)], limits, false);
    }
}

/// Measured on a mesh of 6 and one of 48 cells: 2.1e-5 where plain pictures differ by 1.8e-5 (rounding of deep cells), and
/// 1.4e-6 where they do by 2.4e-6. Outlined opacities differ by 0.1 to 0.3.
#[test]
fn splitting_cells_changes_nothing_but_outlined_opacities() {
    let (coarse, fine) = (affine(1), affine(2));
    let transfer = uniform(1.5);
    let mut renderers = [&coarse, &fine].map(|mesh| renderer(mesh, common::gpu::by_centroids()));
    for camera in cameras(&coarse) {
        let mut changes = |optics: &Optics| {
            let [a, b] = renderers.each_mut().map(|r| draw(r, &camera, &transfer, optics).image);
            largest_difference(&a, &b)
        };
        let plain = changes(&Optics::PLAIN);
        assert!(plain <= 3e-5, "plain: {plain:e}");
        for (name, optics) in all_optics() {
            let difference = changes(&optics);
            println!("split, {name}: {difference:.1e}");
            match optics.silhouette.map(|s| s.mode) {
                Some(SilhouetteMode::Opacity) => assert!(difference > 0.01, "{name}: {difference:e}"),
                _ => assert!(difference <= plain + 1e-5, "{name}: {difference:e}"),
            }
        }
    }
}

/// A field that is constant but for rounding noise, and steep in one far corner: the noise does not show.
#[test]
fn noise_where_the_gradient_vanishes_does_not_sparkle() {
    let noise = |p: DVec3| (p.x * 7919.0 + p.y * 104_729.0 + p.z * 1_299_709.0).sin();
    let noisy = box_mesh(6, MIN, MAX, |p| [5.0 + 1e-12 * noise(p), if p == MIN { 1.0 } else { 1e-12 }]);
    // Steep indeed, so that the scalars' noise is what it is in the vertices' gradients: a part in 1e9.
    let constant = box_mesh(6, MIN, MAX, |_| [5.0, 0.0]);
    let transfer = uniform(1.5);
    for (what, mesh) in [("noisy", Arc::new(noisy)), ("constant", Arc::new(constant))] {
        let mut renderer = renderer(&mesh, common::gpu::by_centroids());
        for camera in cameras(&mesh) {
            let plain = draw(&mut renderer, &camera, &transfer, &Optics::PLAIN).image;
            for (name, optics) in all_optics() {
                let got = draw(&mut renderer, &camera, &transfer, &optics).image;
                let difference = largest_difference(&got, &plain);
                println!("{what}, {name}: {difference:.1e}");
                assert!(got.pixels.iter().flatten().all(|v| v.is_finite()), "{what}, {name}");
                assert!(difference <= 1e-5, "{what}, {name}: {difference:e}");
            }
        }
    }
}

/// The largest difference of a pixel from the mean of its four neighbours, and where it is.
fn sparkle(image: &Image) -> (f64, usize) {
    let [width, height] = [image.width as usize, image.height as usize];
    let mut worst = (0.0, 0);
    for (x, y) in (1..height - 1).flat_map(|y| (1..width - 1).map(move |x| (x, y))) {
        let at = y * width + x;
        let around = [at - 1, at + 1, at - width, at + width].map(|i| image.pixels[i]);
        for channel in 0..4 {
            let mean = around.iter().map(|p| f64::from(p[channel])).sum::<f64>() / 4.0;
            let off = (f64::from(image.pixels[at][channel]) - mean).abs();
            if off > worst.0 || off.is_nan() {
                worst = (off, at);
            }
        }
    }
    worst
}

/// The distance from a point within: the gradient vanishes there, and the picture sparkles no more than the true one.
#[test]
fn where_a_gradient_vanishes_the_picture_is_smooth() {
    let center = DVec3::new(0.0625, -0.03125, 0.125);
    let mesh = Arc::new(box_mesh(16, MIN, MAX, |p| [(p - center).length_squared(), 2.0 * (p - center).length()]));
    let shell = curve(&mesh, [(0.0, 30.0), (0.02, 10.0), (0.05, 0.0), (1.0, 0.0)].into_iter());
    let mut renderer = renderer(&mesh, common::gpu::by_centroids());
    let oracle = Oracle::new(mesh.clone());
    let mut camera = cameras(&mesh)[0];
    camera.target = center;
    camera.projection = Projection::Perspective { fov_y: 0.2 };
    for (name, optics) in all_optics() {
        let got = draw(&mut renderer, &camera, &shell, &optics).image;
        let frame = frame(&camera, &shell, &optics);
        let want = oracle.render_in_order(&frame, &centroid_depth(&mesh, &camera)).expect("a picture");
        let ((off, at), (truly_off, _)) = (sparkle(&got), sparkle(&want));
        let verdict = Verdict::new(&got, &want, LIMITS, |_, _| Cause::Unknown);
        println!("vanishing, {name}: {off:.2e} at {at}, truly {truly_off:.2e}; {verdict}");
        assert!(off <= truly_off + 1e-3, "{name}: pixel {at} is off by {off:e}; truly {truly_off:e}");
        let mut planted = got.clone();
        planted.pixels[SIZE[0] as usize * 40 + 40][1] += (truly_off + 0.01) as f32 * 2.0;
        assert!(sparkle(&planted).0 > truly_off + 1e-3, "{name}: a planted sparkle went unnoticed");
    }
}

/// Slabs blended in f16 have the same shading.
#[test]
fn f16_slabs_come_near() {
    let mesh = meshes::sample(Sample::Tangle, 20_000);
    let [camera, _] = cameras(&mesh);
    let settings = |method, blend| Settings { blend, ..by(method) };
    let functions =
        [("bands", bands(&mesh)), ("bivariate", gaussian(&mesh, true)), ("Gaussian", gaussian(&mesh, false))];
    for (method, (what, transfer)) in PROJECTIONS.into_iter().flat_map(|m| functions.each_ref().map(|f| (m, f))) {
        let mut renderers = [BlendFormat::F32, BlendFormat::F16].map(|blend| renderer(&mesh, settings(method, blend)));
        for (name, optics) in all_optics() {
            let [a, b] = renderers.each_mut().map(|r| draw(r, &camera, transfer, &optics).image);
            let difference = largest_difference(&a, &b);
            println!("f16, {what}, {name}, {method:?}: {difference:.1e}");
            assert!(difference <= 1e-2, "{what}, {name}, {method:?}: {difference:e}");
        }
    }
}

/// One renderer draws by any optics in turn, and plain pictures are as they were.
#[test]
fn optics_may_change_from_frame_to_frame() {
    let mesh = meshes::sample(Sample::Tangle, 20_000);
    let transfer = bands(&mesh);
    let views = [cameras(&mesh)[0], inside(&mesh), cameras(&mesh)[1]];
    let mut changing = renderer(&mesh, common::gpu::by_centroids());
    for camera in &views {
        for (name, optics) in all_optics() {
            let mut fresh = renderer(&mesh, common::gpu::by_centroids());
            let plain = draw(&mut fresh, camera, &transfer, &Optics::PLAIN).image;
            let shaded = draw(&mut renderer(&mesh, common::gpu::by_centroids()), camera, &transfer, &optics).image;
            assert_same_bits(&draw(&mut changing, camera, &transfer, &optics).image, &shaded, name);
            assert_same_bits(&draw(&mut changing, camera, &transfer, &Optics::PLAIN).image, &plain, "plain");
            assert!(largest_difference(&plain, &shaded) > 0.01, "{name}");
        }
    }
}

/// What is not drawn yet is refused in words.
#[test]
fn lit_unweighted_emission_is_refused() {
    let mesh = affine(1);
    let lit = all_optics().into_iter().map(|(_, optics)| optics).find(|o| o.lighting.is_some()).expect("lit optics");
    let optics = Optics { emission: EmissionModel::Unweighted, ..lit };
    let (transfer, [camera, _]) = (uniform(1.0), cameras(&mesh));
    let refusal = renderer(&mesh, common::gpu::by_centroids()).render(&frame(&camera, &transfer, &optics), false);
    let message = refusal.expect_err("not on a device").to_string();
    assert!(message.contains("unweighted") && message.contains("--device oracle"), "{message}");
}
