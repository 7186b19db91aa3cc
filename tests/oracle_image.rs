//! Laws that pictures of the oracle obey, with boxes whose chords are known.

mod common;

use std::sync::Arc;

use common::boxes::{box_mesh, chord};
use glam::DVec3;
use tetralux::image::Comparison;
use tetralux::oracle::Oracle;
use tetralux::plan::order::centroid_depth;
use tetralux::renderer::{Frame, Renderer as _};
use tetralux::scene::{Camera, Curve, CurveNode, Optics, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::TetMesh;

const MIN: DVec3 = DVec3::new(100.0, -2.0, 3.0);
const MAX: DVec3 = DVec3::new(103.0, 2.0, 6.0);
const SIZE: [u32; 2] = [70, 45];

fn uniform(extinction: f64) -> TransferFunction {
    let color = [1.0, 0.5, 0.25];
    TransferFunction::Widgets(vec![Widget::new(WidgetShape::Uniform, color, extinction)])
}

fn camera(eye: DVec3, projection: Projection) -> Camera {
    Camera { eye, target: DVec3::new(101.4, 0.1, 4.6), up: DVec3::Z, projection, near: None }
}

/// Outside, skewed; a face ahead; inside; orthographic along an axis, so that rays lie in faces, and skewed.
fn cameras() -> Vec<Camera> {
    let perspective = Projection::Perspective { fov_y: 0.6 };
    let orthographic = Projection::Orthographic { height: 5.0 };
    vec![
        camera(DVec3::new(110.0, 7.0, 9.0), perspective),
        camera(DVec3::new(101.4, -12.0, 4.6), perspective),
        camera(DVec3::new(101.9, 0.6, 4.1), Projection::Perspective { fov_y: 1.9 }),
        camera(DVec3::new(101.4, -12.0, 4.6), orthographic),
        Camera {
            eye: DVec3::new(101.5, -8.0, 4.5),
            target: DVec3::new(101.5, 0.0, 4.5),
            up: DVec3::Z,
            projection: Projection::Orthographic { height: 45.0 / 8.0 },
            near: None,
        },
        camera(DVec3::new(95.0, 7.0, 9.0), orthographic),
        Camera { near: Some(9.5), ..camera(DVec3::new(110.0, 7.0, 9.0), perspective) },
    ]
}

fn frame<'a>(camera: &'a Camera, transfer: &'a TransferFunction) -> Frame<'a> {
    Frame { camera, transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.0; 4] }
}

/// The largest error of the opacity of a uniform medium, over all cameras.
fn chord_error(mesh: TetMesh, extinction: f64) -> f64 {
    let diagonal = (MAX - MIN).length();
    let oracle = Oracle::new(Arc::new(mesh));
    let transfer = uniform(extinction);
    let mut worst = 0.0f64;
    for camera in cameras() {
        let view = oracle.view(&frame(&camera, &transfer)).expect("a view");
        for (x, y) in (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))) {
            let position = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let ray = camera.ray(SIZE, position);
            let length = chord(ray.origin, ray.direction, camera.near_depth(diagonal), MIN, MAX);
            let want = 1.0 - (-extinction * length).exp();
            let [red, .., alpha] = view.pixel(&transfer, [0.0; 4], position);
            assert!(red.is_finite() && alpha.is_finite(), "{camera:?} {position:?}");
            worst = worst.max((alpha - want).abs()).max((red - want).abs());
        }
    }
    worst
}

#[test]
fn a_uniform_medium_is_its_chord_everywhere() {
    for n in [1, 4] {
        for depth in [0.1, 3.0, 30.0] {
            let mesh = box_mesh(n, MIN, MAX, |_| [0.0; 2]);
            let error = chord_error(mesh, depth / (MAX - MIN).length());
            assert!(error < 1e-12, "{n}^3 cubes, depth {depth}: {error:e}");
        }
    }
}

#[test]
fn a_missing_cell_is_seen() {
    let mut mesh = box_mesh(4, MIN, MAX, |_| [0.0; 2]);
    Arc::make_mut(&mut mesh.tets).remove(200);
    let error = chord_error(mesh, 1.0);
    assert!(error > 1e-3, "{error:e}");
}

#[test]
fn a_cell_twice_is_seen() {
    let mut mesh = box_mesh(4, MIN, MAX, |_| [0.0; 2]);
    let again = mesh.tets[200];
    Arc::make_mut(&mut mesh.tets).push(again);
    let error = chord_error(mesh, 1.0);
    assert!(error > 1e-3, "{error:e}");
}

/// Fields that are affine in space are affine along every ray, whatever the cells: one cell deep or many, the same.
#[test]
fn affine_fields_do_not_depend_on_the_cells() {
    let fields = |p: DVec3| [p.x + 0.3 * p.y - 0.2 * p.z, 5.0 + p.z];
    let transfer = TransferFunction::Widgets(vec![
        Widget {
            shape: WidgetShape::Gaussian { center: [101.0, 9.0], sigma: [0.2, 0.8], angle: 0.4 },
            color: [1.0, 0.2, 0.1],
            extinction: 2.0,
            scalar_range: None,
            // Not at a height where rays run along it.
            gradient_range: Some([8.47, 10.52]),
            window: None,
        },
        Widget {
            shape: WidgetShape::Uniform,
            color: [0.1, 0.3, 1.0],
            extinction: 0.8,
            scalar_range: Some([100.0, 101.2]),
            gradient_range: None,
            window: None,
        },
    ]);
    for camera in cameras() {
        let picture = |n| {
            let oracle = Oracle::new(Arc::new(box_mesh(n, MIN, MAX, fields)));
            oracle.image(&frame(&camera, &transfer)).expect("a picture")
        };
        let (few, many) = (picture(1), picture(5));
        assert!(few.pixels.iter().any(|p| p[3] > 0.3), "something is seen");
        let comparison = Comparison::new(&few, &many).expect("equal sizes");
        assert!(comparison.max < 2e-7, "{camera:?}: {comparison}");
    }
}

fn layers() -> TransferFunction {
    let node = |scalar, color| CurveNode { scalar, color, extinction: 1.5 };
    TransferFunction::Curve(Curve { nodes: vec![node(100.0, [1.0, 0.0, 0.0]), node(103.0, [0.0, 0.0, 1.0])] })
}

#[test]
fn order_matters_for_colours_and_only_for_them() {
    let oracle = Oracle::new(Arc::new(box_mesh(4, MIN, MAX, |p| [p.x + 0.5 * p.y, 0.0])));
    for camera in cameras() {
        let depths = centroid_depth(oracle.mesh(), &camera);
        let reversed: Vec<f64> = depths.iter().map(|d| -d).collect();
        let (colored, plain) = (layers(), uniform(0.5));
        let compare = |transfer: &TransferFunction, keys: &[f64]| {
            let frame = frame(&camera, transfer);
            let want = oracle.image(&frame).expect("a picture");
            Comparison::new(&oracle.render_in_order(&frame, keys).expect("a picture"), &want).expect("equal sizes")
        };
        let (right, wrong) = (compare(&colored, &depths), compare(&colored, &reversed));
        assert!(right.rmse < 0.1 * wrong.rmse, "{camera:?}: {right}\n{wrong}");
        assert!(wrong.max > 0.05, "a reversed order is seen: {wrong}");
        for keys in [&depths, &reversed] {
            assert!(compare(&plain, keys).max < 2e-7, "one colour has no order");
        }
    }
    let camera = &cameras()[0];
    assert!(oracle.render_in_order(&frame(camera, &layers()), &[1.0]).is_err(), "too few keys");
}

/// Two cells side by side, a gap, and the ray through both.
#[test]
fn rays_re_enter_meshes_with_gaps() {
    let mut mesh = box_mesh(3, MIN, MAX, |_| [0.0; 2]);
    let third = (MAX - MIN) / 3.0;
    let centers: Vec<DVec3> = (0..mesh.tets.len() as u32)
        .map(|tet| mesh.data_from_mesh(mesh.corners(tetralux::tet::TetId(tet)).iter().sum::<DVec3>() / 4.0))
        .collect();
    let inside = |p: &DVec3| (MIN.y + third.y..MIN.y + 2.0 * third.y).contains(&p.y);
    let mut keep = centers.iter().map(|p| !inside(p));
    Arc::make_mut(&mut mesh.tets).retain(|_| keep.next().unwrap_or(true));
    let camera = camera(DVec3::new(101.3, -12.0, 4.7), Projection::Orthographic { height: 1.0 });
    let camera = Camera { target: camera.eye + DVec3::Y, ..camera };
    let transfer = uniform(0.5);
    let oracle = Oracle::new(Arc::new(mesh));
    let [.., alpha] = oracle.pixel(&frame(&camera, &transfer), [35.0, 22.5]).expect("a pixel");
    let want = 1.0 - (-0.5 * 2.0 * third.y).exp();
    assert!((alpha - want).abs() < 1e-12, "{alpha} {want}");
}

#[test]
fn pixels_and_pictures_agree_and_backgrounds_show() {
    let mut oracle = Oracle::new(Arc::new(box_mesh(3, MIN, MAX, |p| [p.x, 0.0])));
    let (camera, transfer) = (cameras()[0], layers());
    let frame = Frame { background: [0.25, 0.5, 0.0, 0.5], ..frame(&camera, &transfer) };
    let rendered = oracle.render(&frame, true).expect("a picture");
    assert_eq!(rendered.stats.adapter, "CPU (oracle, f64)");
    assert_eq!(rendered.stats.cells[0], ("mesh".to_string(), 162));
    assert_eq!(rendered.stats.passes.len(), 2);
    for (x, y) in [(0, 0), (35, 22), (31, 31), (32, 32), (69, 44)] {
        let pixel = oracle.pixel(&frame, [f64::from(x) + 0.5, f64::from(y) + 0.5]).expect("a pixel");
        let got = rendered.image.pixels[(y * SIZE[0] + x) as usize];
        assert_eq!(got, pixel.map(|v| v as f32), "({x}, {y})");
    }
    assert_eq!(rendered.image.pixels[0], frame.background, "nothing is seen in the corner");
    assert!(oracle.image(&Frame { size: [0, 5], ..frame }).is_err());
}

#[test]
fn silhouettes_are_sensitive_and_insides_are_not() {
    let oracle = Oracle::new(Arc::new(box_mesh(3, MIN, MAX, |p| [p.x, 0.0])));
    // Straight at a face, so that the silhouette is a step.
    let camera = Camera {
        eye: DVec3::new(101.5, -8.0, 4.5),
        target: DVec3::new(101.5, 0.0, 4.5),
        up: DVec3::Z,
        projection: Projection::Orthographic { height: 45.0 / 8.0 },
        near: None,
    };
    let transfer = uniform(2.0);
    let at = |position| oracle.sensitivity(&frame(&camera, &transfer), position, 1e-3).expect("a number");
    // Eight pixels a unit: the left edge lies at 35 - 12 = 23 pixels.
    assert!(at([35.5, 22.5]) < 1e-9);
    assert!(at([23.0 + 5e-4, 22.5]) > 0.9);
}

#[test]
fn progress_reaches_the_end() {
    let heard = Arc::new(std::sync::Mutex::new(Vec::new()));
    let listener = Arc::clone(&heard);
    let oracle = Oracle::new(Arc::new(box_mesh(1, MIN, MAX, |_| [0.0; 2]))).with_progress(Arc::new(move |fraction| {
        listener.lock().expect("no panic").push(fraction);
        true
    }));
    let (camera, transfer) = (cameras()[0], uniform(1.0));
    oracle.image(&frame(&camera, &transfer)).expect("a picture");
    let heard = heard.lock().expect("no panic");
    assert_eq!((heard.len(), heard.iter().copied().fold(0.0, f64::max)), (6, 1.0), "3 x 2 tiles");
}

#[test]
fn a_part_is_that_of_the_picture_and_can_be_given_up() {
    let mesh = Arc::new(box_mesh(1, MIN, MAX, |_| [0.0; 2]));
    let (camera, transfer) = (cameras()[0], uniform(1.0));
    let frame = frame(&camera, &transfer);
    let oracle = Oracle::new(Arc::clone(&mesh));
    let all = oracle.image(&frame).expect("a picture");
    let part = oracle.part(&frame, [20, 7, 41, 33]).expect("a part");
    assert_eq!([part.width, part.height], [21, 26]);
    let row = |y: usize| &all.pixels[(7 + y) * all.width as usize + 20..][..21];
    assert!((0..26).all(|y| part.pixels[21 * y..][..21] == *row(y)));
    assert!(part.pixels.iter().any(|p| p[3] > 0.0) && part.pixels != all.pixels[..part.pixels.len()]);
    for area in [[5, 5, 5, 9], [0, 0, frame.size[0] + 1, 1]] {
        assert!(oracle.part(&frame, area).is_err(), "{area:?}");
    }
    let error = Oracle::new(mesh).with_progress(Arc::new(|_| false)).image(&frame).expect_err("nobody waits for it");
    assert!(error.to_string().contains("given up"), "{error}");
}
