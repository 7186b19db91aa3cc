//! Emission models, lighting and silhouettes in pictures of the oracle, where they can be computed by hand: affine
//! fields, whose gradient is the same everywhere, in uniform media.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::sync::Arc;

use common::boxes::{box_mesh, chord};
use glam::DVec3;
use tetralux::oracle::Oracle;
use tetralux::renderer::Frame;
use tetralux::scene::{
    Camera, EmissionModel, LightSpace, Lighting, Optics, Projection, Silhouette, SilhouetteMode, TransferFunction,
    Widget, WidgetShape,
};
use tetralux::tet::TetMesh;

const MIN: DVec3 = DVec3::new(10.0, -2.0, 3.0);
const MAX: DVec3 = DVec3::new(13.0, 2.0, 6.0);
const SIZE: [u32; 2] = [31, 23];
const COLOR: [f64; 3] = [1.0, 0.5, 0.25];
const EXTINCTION: f64 = 0.7;
const GRADIENT: DVec3 = DVec3::new(0.5, -0.7, 1.1);
/// The worst difference that was measured is 6e-15.
const LIMIT: f64 = 1e-12;

fn mesh(n: usize) -> TetMesh {
    box_mesh(n, MIN, MAX, |p| [GRADIENT.dot(p), GRADIENT.length()])
}

fn transfer(extinction: f64) -> TransferFunction {
    TransferFunction::Widgets(vec![Widget::new(WidgetShape::Uniform, COLOR, extinction)])
}

fn cameras() -> [Camera; 2] {
    let camera =
        |eye, projection| Camera { eye, target: DVec3::new(11.4, 0.1, 4.6), up: DVec3::Z, projection, near: None };
    [
        camera(DVec3::new(20.0, 7.0, 9.0), Projection::Perspective { fov_y: 0.6 }),
        camera(DVec3::new(5.0, 7.0, 9.0), Projection::Orthographic { height: 5.0 }),
    ]
}

fn lighting(space: LightSpace) -> Lighting {
    let direction = DVec3::new(0.3, 0.4, 0.9).normalize();
    Lighting { ambient: 0.2, diffuse: 0.6, specular: 0.5, shininess: 7.0, direction, space }
}

fn silhouette(mode: SilhouetteMode) -> Silhouette {
    Silhouette { exponent: 1.5, strength: 0.8, mode }
}

/// Largest difference of the picture from `want(camera, unit ray, chord)`, over both cameras.
fn worst(mesh: TetMesh, optics: Optics, want: impl Fn(&Camera, DVec3, f64) -> [f64; 4]) -> f64 {
    let diagonal = (MAX - MIN).length();
    let oracle = Oracle::new(Arc::new(mesh));
    let transfer = transfer(EXTINCTION);
    let mut worst = 0.0f64;
    for camera in cameras() {
        let frame = Frame { camera: &camera, transfer: &transfer, optics: &optics, size: SIZE, background: [0.0; 4] };
        let view = oracle.view(&frame).expect("a view");
        for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
            let position = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let ray = camera.ray(SIZE, position);
            let length = chord(ray.origin, ray.direction, camera.near_depth(diagonal), MIN, MAX);
            let want = want(&camera, ray.direction.normalize(), length);
            let got = view.pixel(&transfer, [0.0; 4], position);
            assert!(got.iter().all(|v| v.is_finite()), "{camera:?} {position:?}");
            worst = (0..4).fold(worst, |m, c| m.max((got[c] - want[c]).abs()));
        }
    }
    println!("worst difference {worst:.1e}");
    worst
}

/// What the documentation says lighting does: the factor on colours, and the white that is added.
fn lit(camera: &Camera, ray: DVec3, light: &Lighting) -> (f64, f64) {
    let basis = camera.basis();
    let toward_light = match light.space {
        LightSpace::World => light.direction,
        LightSpace::View => {
            let d = light.direction;
            d.x * basis.right + d.y * basis.up - d.z * basis.forward
        }
    };
    let weight = 1.0 / (1.0 + 1e-6);
    let n = GRADIENT.normalize();
    let sum = toward_light - ray;
    let h = sum / (sum.length_squared() + 1e-6).sqrt();
    let factor = 1.0 + weight * (light.ambient + light.diffuse * n.dot(toward_light).abs() - 1.0);
    (factor, weight * light.specular * n.dot(h).abs().powf(light.shininess))
}

/// The silhouette's factor.
fn outlined(ray: DVec3, silhouette: &Silhouette) -> f64 {
    let facing = (1.0 - GRADIENT.normalize().dot(ray).abs()).powf(silhouette.exponent);
    1.0 + silhouette.strength * (facing - 1.0) / (1.0 + 1e-6)
}

#[test]
fn lit_media_have_the_colours_of_the_formula() {
    for space in [LightSpace::View, LightSpace::World] {
        let light = lighting(space);
        let optics = Optics { lighting: Some(light), ..Optics::PLAIN };
        let want = |off: f64| {
            move |camera: &Camera, ray: DVec3, length: f64| {
                let opacity = 1.0 - (-EXTINCTION * length).exp();
                let (factor, white) = lit(camera, ray, &light);
                let [r, g, b] = COLOR.map(|c| opacity * (factor * c + white + off));
                [r, g, b, opacity]
            }
        };
        let error = worst(mesh(3), optics, want(0.0));
        assert!(error < LIMIT, "{space:?}: {error:e}");
        assert!(worst(mesh(1), optics, want(1e-11)) > LIMIT, "a wrong colour must show");
    }
    // The two spaces differ, so that neither can stand for the other.
    let world = Optics { lighting: Some(lighting(LightSpace::World)), ..Optics::PLAIN };
    let light = lighting(LightSpace::View);
    let error = worst(mesh(1), world, |camera, ray, length| {
        let opacity = 1.0 - (-EXTINCTION * length).exp();
        let (factor, white) = lit(camera, ray, &light);
        let [r, g, b] = COLOR.map(|c| opacity * (factor * c + white));
        [r, g, b, opacity]
    });
    assert!(error > 0.01, "{error:e}");
}

#[test]
fn depth_silhouettes_scale_the_depth_whatever_the_cells() {
    let outline = silhouette(SilhouetteMode::Depth);
    let optics = Optics { silhouette: Some(outline), ..Optics::PLAIN };
    for n in [1, 3] {
        let error = worst(mesh(n), optics, |_, ray, length| {
            let opacity = 1.0 - (-EXTINCTION * outlined(ray, &outline) * length).exp();
            let [r, g, b] = COLOR.map(|c| c * opacity);
            [r, g, b, opacity]
        });
        assert!(error < LIMIT, "{n}^3 cubes: {error:e}");
    }
}

/// A single tetrahedron around the whole box would do; six in a cube serve, seen one at a time.
#[test]
fn opacity_silhouettes_scale_what_each_cell_comes_to() {
    let outline = silhouette(SilhouetteMode::Opacity);
    let optics = Optics { silhouette: Some(outline), ..Optics::PLAIN };
    let whole = mesh(1);
    let mut seen = 0;
    for index in 0..whole.tets.len() {
        let one = TetMesh { tets: Arc::new(vec![whole.tets[index]]), ..whole.clone() };
        let oracle = Oracle::new(Arc::new(one));
        let transfer = transfer(EXTINCTION);
        for camera in cameras() {
            let picture = |optics: &Optics, position| {
                let frame = Frame { camera: &camera, transfer: &transfer, optics, size: SIZE, background: [0.0; 4] };
                oracle.pixel(&frame, position).expect("a pixel")
            };
            for position in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y])) {
                let position = position.map(|v| f64::from(v) + 0.5);
                let plain = picture(&Optics::PLAIN, position);
                let factor = outlined(camera.ray(SIZE, position).direction.normalize(), &outline);
                let got = picture(&optics, position);
                let error = (0..4).fold(0.0f64, |m, c| m.max((got[c] - factor * plain[c]).abs()));
                assert!(error < LIMIT, "cell {index}, {position:?}: {got:?}, not {factor} x {plain:?}");
                seen += usize::from(plain[3] > 0.1 && factor < 0.9);
            }
        }
    }
    assert!(seen > 500, "{seen} pixels");
    // Opacities do not add: this is what the other mode is for.
    let opacity = |n: usize| {
        worst(mesh(n), optics, |_, ray, length| {
            let opacity = outlined(ray, &outline) * (1.0 - (-EXTINCTION * length).exp());
            let [r, g, b] = COLOR.map(|c| c * opacity);
            [r, g, b, opacity]
        })
    };
    assert!(opacity(3) > 0.01, "finer cells must be seen to differ");
}

#[test]
fn unweighted_emission_fills_the_support() {
    let optics = Optics { emission: EmissionModel::Unweighted, lighting: None, silhouette: None };
    let error = worst(mesh(3), optics, |_, _, length| {
        // int_0^L c exp(-k l) dl
        let opacity = 1.0 - (-EXTINCTION * length).exp();
        let [r, g, b] = COLOR.map(|c| c * opacity / EXTINCTION);
        [r, g, b, opacity]
    });
    assert!(error < LIMIT, "{error:e}");
}

/// Density multiplies both sides of the unweighted model.
#[test]
fn depth_silhouettes_scale_unweighted_emission_too() {
    let outline = silhouette(SilhouetteMode::Depth);
    let optics = Optics {
        emission: EmissionModel::Unweighted,
        silhouette: Some(outline),
        lighting: Some(lighting(LightSpace::World)),
    };
    let error = worst(mesh(3), optics, |camera, ray, length| {
        let opacity = 1.0 - (-EXTINCTION * outlined(ray, &outline) * length).exp();
        let (factor, white) = lit(camera, ray, &lighting(LightSpace::World));
        let [r, g, b] = COLOR.map(|c| (factor * c + white) * opacity / EXTINCTION);
        [r, g, b, opacity]
    });
    assert!(error < LIMIT, "{error:e}");
}

/// Without a gradient there is nothing to light: the plain picture, and no sparkle next to it.
#[test]
fn constant_fields_are_neither_lit_nor_outlined() {
    let optics = Optics {
        lighting: Some(lighting(LightSpace::View)),
        silhouette: Some(silhouette(SilhouetteMode::Opacity)),
        ..Optics::PLAIN
    };
    let plain = |_: &Camera, _: DVec3, length: f64| {
        let opacity = 1.0 - (-EXTINCTION * length).exp();
        let [r, g, b] = COLOR.map(|c| c * opacity);
        [r, g, b, opacity]
    };
    let constant = box_mesh(3, MIN, MAX, |_| [5.0, 0.0]);
    let error = worst(constant, optics, plain);
    assert!(error < LIMIT, "{error:e}");
    // Rounding noise of any direction, a millionth of a millionth of the mesh's steepest gradient.
    let noise = |p: DVec3| (p.x * 7919.0 + p.y * 104_729.0 + p.z * 1_299_709.0).sin();
    let noisy = box_mesh(3, MIN, MAX, |p| [5.0 + 1e-12 * noise(p), if p == MIN { 1.0 } else { 1e-12 }]);
    let error = worst(noisy, optics, plain);
    assert!(error < 1e-9, "{error:e}");
}
