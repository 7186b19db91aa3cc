//! Cells that fill one place: a ray that passes two at once sees their segments by the depth of their middles.

use std::sync::Arc;

use glam::DVec3;
use tetralux::image::Image;
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, Renderer, Settings};
use tetralux::scene::{Camera, Curve, CurveNode, Optics, Projection, TransferFunction};
use tetralux::tet::TetMesh;

use crate::common::agreement::{Explainer, Limits, Verdict, assert_limits_bite};
use crate::common::boxes::{box_mesh, tet_mesh};
use crate::common::rainbow::rainbow;
use crate::{COMPILES, engine};

const SIZE: [u32; 2] = [96, 80];
const LIMITS: Limits = Limits { psnr: 80.0, percentile_99_9: 1e-3, explained_above: 2e-3 };

/// Two boxes in each other, neither's cells linked with the other's.
pub fn boxes() -> TetMesh {
    let (mut points, mut tets, mut scalar) = (Vec::new(), Vec::new(), Vec::new());
    let parts = [(3, DVec3::ZERO, DVec3::ONE), (4, DVec3::new(0.313, 0.271, 0.357), DVec3::new(1.41, 1.33, 1.21))];
    for (k, (n, min, max)) in (0..).zip(parts) {
        let part = box_mesh(n, min, max, |p| [p.x + 0.7 * p.y * p.z + 1.3 * f64::from(k), 0.0]);
        let first = points.len() as u32;
        points.extend(part.vertices.iter().map(|&v| part.data_from_mesh(v)));
        scalar.extend_from_slice(&part.scalar);
        tets.extend(part.tets.iter().map(|tet| tet.map(|v| v + first)));
    }
    TetMesh { scalar, ..tet_mesh(&points, tets, |_| [0.0, 0.0]) }
}

/// Two cells on one side of the face that they share.
fn fold() -> TetMesh {
    let points = [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.2, 0.3, 1.0), (0.5, 0.2, 0.8)];
    let points = points.map(|(x, y, z)| DVec3::new(x, y, z));
    let mesh = tet_mesh(&points, vec![[0, 1, 2, 3], [0, 1, 2, 4]], |_| [0.0, 0.0]);
    TetMesh { scalar: vec![0.0, 1.0, 2.0, 3.0, 7.0], ..mesh }
}

/// So opaque that nothing is seen behind the first cells: what begins before these is.
fn opaque(mesh: &TetMesh) -> TransferFunction {
    let range = mesh.scalar_range();
    let node =
        |(x, color): (f64, [f64; 3])| CurveNode { scalar: range.min + x * range.length(), color, extinction: 60.0 };
    let nodes = [(0.0, [1.0, 0.2, 0.1]), (0.4, [0.2, 1.0, 0.1]), (1.0, [0.1, 0.2, 1.0])];
    TransferFunction::Curve(Curve { nodes: nodes.map(node).to_vec() })
}

/// A view from outside, of bands.
pub fn outside(mesh: &TetMesh) -> (Camera, TransferFunction) {
    let bounds = mesh.bounds_in_data();
    let eye = bounds.center() + bounds.diagonal() * DVec3::new(0.8, 0.5, 0.9);
    let projection = Projection::Perspective { fov_y: 0.8 };
    (Camera { eye, target: bounds.center(), up: DVec3::Y, projection, near: None }, rainbow(mesh, 20, 5.0))
}

/// How a picture compares with the true one.
pub fn verdict(mesh: &Arc<TetMesh>, frame: Frame<'_>, got: &Image) -> Verdict {
    let oracle = Oracle::new(mesh.clone());
    let want = oracle.image(&frame).expect("a picture");
    let explainer = Explainer { mesh, frame, view: oracle.view(&frame).expect("a view"), shift: 1e-3 };
    let verdict = Verdict::new(got, &want, LIMITS, |pixel, error| explainer.cause(pixel, error));
    assert_limits_bite(&want, LIMITS);
    verdict
}

fn agrees(name: &str, mesh: TetMesh, within: DVec3) {
    let mesh = Arc::new(mesh);
    let bounds = mesh.bounds_in_data();
    let (center, diagonal) = (bounds.center(), bounds.diagonal());
    let camera = |eye, projection| Camera { eye, target: center, up: DVec3::Y, projection, near: None };
    let functions = [("bands", rainbow(&mesh, 20, 5.0)), ("opaque", opaque(&mesh))];
    // One is enough where each takes seconds to compile.
    for (function, transfer) in &functions[..if COMPILES { 1 } else { 2 }] {
        let mut renderer = engine(&mesh, Settings::default());
        for (place, camera) in [
            ("outside", outside(&mesh).0),
            (
                "flat",
                camera(center + diagonal * DVec3::new(-0.5, 0.9, 0.3), Projection::Orthographic { height: diagonal }),
            ),
            ("within both", camera(within, Projection::Perspective { fov_y: 1.4 })),
        ] {
            assert_seen(&format!("{name}, {function}, {place}"), &mesh, &mut *renderer, (&camera, transfer));
        }
    }
}

fn assert_seen(
    what: &str,
    mesh: &Arc<TetMesh>,
    renderer: &mut dyn Renderer,
    (camera, transfer): (&Camera, &TransferFunction),
) {
    let frame = Frame { camera, transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.2, 0.1, 0.3, 1.0] };
    let got = renderer.render(&frame, false).expect("a picture").image;
    let verdict = verdict(mesh, frame, &got);
    println!("{what}: {verdict}");
    verdict.assert_good(what);
}

#[test]
fn boxes_in_each_other_are_seen_by_depth() {
    agrees("boxes", boxes(), DVec3::new(0.62, 0.55, 0.71));
}

#[test]
fn a_fold_is_seen_by_depth() {
    agrees("fold", fold(), DVec3::new(0.25, 0.22, 0.25));
}

/// Above a thin layer, whose floor reaches from before the eye to behind it: lines of rays enter the mesh behind the eye.
#[test]
fn what_begins_behind_the_eye_is_passed_once() {
    let cube = box_mesh(2, DVec3::ZERO, DVec3::ONE, |_| [0.0, 0.0]);
    let flat = |p: DVec3| DVec3::new(p.x, p.y, if p.z > 0.75 { 1.0 } else { 0.04 * p.z });
    let places: Vec<DVec3> = cube.vertices.iter().map(|&v| flat(cube.data_from_mesh(v))).collect();
    let mesh = Arc::new(tet_mesh(&places, cube.tets.to_vec(), |p| [p.x + 0.7 * p.y + 0.3 * p.z, 0.0]));
    let eye = DVec3::new(0.3, 0.1, 0.05);
    let projection = Projection::Perspective { fov_y: 1.0 };
    let camera = Camera { eye, target: eye + DVec3::X, up: DVec3::new(0.0, 1.0, 1.0), projection, near: None };
    let mut renderer = engine(&mesh, Settings::default());
    assert_seen("above a layer", &mesh, &mut *renderer, (&camera, &rainbow(&mesh, 20, 3.0)));
}
