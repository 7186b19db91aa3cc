//! A uniform medium fills a box without gap or overlap: every pixel is `1 - exp(-k * chord)`.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::sync::Arc;

use common::agreement::{Cause, Explainer, Limits, SNAP, Verdict};
use common::boxes::{box_mesh, chord};
use common::random::Random;
use common::{delaunay, gpu};
use glam::DVec3;
use tetralux::gpu::GpuRenderer;
use tetralux::image::Image;
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, Method};
use tetralux::scene::{Camera, Optics, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::TetMesh;

const SIZE: [u32; 2] = [64, 64];
/// Issue 2: of every pixel's opacity.
const LIMIT: f64 = 1e-4;
/// Optical depths along the box's diagonal.
const DEPTHS: [f64; 3] = [0.1, 3.0, 30.0];
/// At most this share of the pixels lies so near to an edge of a thin or steep cell that the rasteriser's snapping, by up
/// to 1/512 pixel, takes the cell away or adds one, and changes the pixel by more than the limit. Measured: 1.0e-3
/// on the regular mesh and 2.1e-3 on the random one (k * diagonal = 3), at most 1.6e-4 and 3e-4 for the other depths.
const MOST_SNAPPED: f64 = 3e-3;
const COLOR: [f64; 3] = [1.0, 0.5, 0.25];
const DIAGONAL: f64 = 1.732_050_807_568_877_2;

/// 10,368 cells, all hexahedra cut alike.
fn regular() -> Arc<TetMesh> {
    Arc::new(box_mesh(12, DVec3::ZERO, DVec3::ONE, |p| [p.x, 0.0]))
}

/// A random Delaunay mesh with its slivers.
fn random() -> Arc<TetMesh> {
    let mesh = delaunay::cube(1_500, 40, 8, 7, |p| [p.x, 0.0]);
    assert!(mesh.tets.len() > 10_000, "{}", mesh.tets.len());
    Arc::new(mesh)
}

fn medium(extinction: f64) -> TransferFunction {
    TransferFunction::Widgets(vec![Widget::new(WidgetShape::Uniform, COLOR, extinction)])
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// All of the box lies beyond the near depth.
    Outside,
    /// The near depth cuts cells.
    Inside,
}

/// Deterministic cameras: perspective and orthographic ones in turn.
fn cameras(place: Place, count: usize) -> Vec<Camera> {
    let mut random = Random(place as u64 + 1);
    (0..count)
        .map(|i| {
            let target = DVec3::splat(0.5) + 0.2 * random.direction();
            let away = random.direction();
            let distance = match place {
                Place::Outside => random.within(1.3, 3.0) * DIAGONAL,
                Place::Inside => random.within(0.05, 0.4),
            };
            let (eye, up) = (target + distance * away, random.direction());
            let projection = match i % 4 {
                3 => Projection::Orthographic { height: random.within(0.4, 1.8) },
                _ => Projection::Perspective { fov_y: random.within(0.3, 1.4) },
            };
            Camera { eye, target, up, projection, near: None }
        })
        .collect()
}

/// What 50 pictures' pixels amount to.
#[derive(Clone, Copy, Debug, Default)]
struct Total {
    seen: usize,
    worst: f64,
    /// Above the limit, because the rasteriser moves a cell's edges.
    snapped: usize,
    /// Above the limit for no such reason.
    unknown: usize,
    /// Too near to the outline to tell.
    left_out: usize,
}

fn chord_at(camera: &Camera, position: [f64; 2]) -> f64 {
    let ray = camera.ray(SIZE, position);
    chord(ray.origin, ray.direction, camera.near_depth(DIAGONAL), DVec3::ZERO, DVec3::ONE)
}

/// True where a step of `shift` pixels crosses the box's outline.
fn at_outline(camera: &Camera, [x, y]: [f64; 2], shift: f64) -> bool {
    let steps = [(-1.0, -1.0), (0.0, -1.0), (1.0, -1.0), (-1.0, 0.0), (1.0, 0.0), (-1.0, 1.0), (0.0, 1.0), (1.0, 1.0)];
    let seen = chord_at(camera, [x, y]) > 0.0;
    steps.iter().any(|(dx, dy)| (chord_at(camera, [x + shift * dx, y + shift * dy]) > 0.0) != seen)
}

/// Draws a frame and compares it with the chords' opacities; `mesh` is what the renderer is believed to hold.
fn check(renderer: &mut GpuRenderer, mesh: &TetMesh, camera: &Camera, extinction: f64, total: &mut Total) {
    let transfer = medium(extinction);
    let got = gpu::draw(renderer, camera, &transfer, SIZE).image;
    let mut want = Image::new(SIZE[0], SIZE[1]);
    for (i, pixel) in want.pixels.iter_mut().enumerate() {
        let position = [(i % SIZE[0] as usize) as f64 + 0.5, (i / SIZE[0] as usize) as f64 + 0.5];
        if at_outline(camera, position, SNAP / 2.0) {
            *pixel = got.pixels[i];
            total.left_out += 1;
            continue;
        }
        let opacity = -(-extinction * chord_at(camera, position)).exp_m1();
        *pixel = [COLOR[0], COLOR[1], COLOR[2], 1.0].map(|c| (c * opacity) as f32);
        total.seen += usize::from(opacity > 0.0);
    }
    let oracle = Oracle::new(Arc::new(mesh.clone()));
    let frame = Frame { camera, transfer: &transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.0; 4] };
    let explainer = Explainer { mesh, frame, view: oracle.view(&frame).expect("a view"), shift: SNAP };
    let limits = Limits { psnr: f64::NEG_INFINITY, percentile_99_9: f64::INFINITY, explained_above: LIMIT };
    let verdict = Verdict::new(&got, &want, limits, |pixel, error| explainer.cause(pixel, error));
    total.unknown += verdict.count(Cause::Unknown);
    total.snapped += verdict.large.len() - verdict.count(Cause::Unknown);
    total.worst = total.worst.max(verdict.comparison.max);
}

fn is_watertight(method: Method, mesh: &Arc<TetMesh>, place: Place, count: usize, what: &str) {
    let mut renderer = gpu::renderer(mesh, gpu::by(method));
    for depth in DEPTHS {
        let mut total = Total::default();
        for camera in cameras(place, count) {
            check(&mut renderer, mesh, &camera, depth / DIAGONAL, &mut total);
        }
        println!("{what}, {method:?}, {place:?}, k * diagonal = {depth}: {total:?}");
        assert!(total.seen > 1_000 * count && total.left_out * 1_000 < total.seen, "{total:?}");
        assert!(total.unknown == 0, "{what}, {method:?}, {place:?}, depth {depth}: {total:?}");
        assert!(
            total.snapped as f64 <= MOST_SNAPPED * total.seen as f64,
            "{what}, {method:?}, {place:?}, depth {depth}: {total:?}"
        );
    }
}

#[test]
fn a_regular_box_is_watertight() {
    is_watertight(Method::Project, &regular(), Place::Outside, 28, "regular");
}

#[test]
fn a_regular_box_is_watertight_from_inside() {
    is_watertight(Method::Project, &regular(), Place::Inside, 10, "regular");
}

#[test]
fn a_delaunay_box_is_watertight() {
    is_watertight(Method::Project, &random(), Place::Outside, 28, "random");
}

#[test]
fn a_delaunay_box_is_watertight_from_inside() {
    is_watertight(Method::Project, &random(), Place::Inside, 10, "random");
}

#[test]
fn front_faces_of_a_regular_box_are_watertight() {
    is_watertight(Method::CellCast, &regular(), Place::Outside, 12, "regular");
    is_watertight(Method::CellCast, &regular(), Place::Inside, 4, "regular");
}

#[test]
fn front_faces_of_a_delaunay_box_are_watertight() {
    is_watertight(Method::CellCast, &random(), Place::Outside, 12, "random");
    is_watertight(Method::CellCast, &random(), Place::Inside, 4, "random");
}

/// The same check sees a single cell of 10,000 missing.
#[test]
fn a_missing_cell_is_seen() {
    for whole in [regular(), random()] {
        let mut mesh = TetMesh::clone(&whole);
        // Below the surface, where even the densest medium lets it be seen, and behind several sides.
        let distance = |tet: &[u32; 4]| {
            let center = tet.map(|v| mesh.data_from_mesh(mesh.vertices[v as usize])).iter().sum::<DVec3>() / 4.0;
            center.distance(DVec3::splat(0.92))
        };
        let cell = (0..mesh.tets.len()).min_by(|&i, &j| distance(&mesh.tets[i]).total_cmp(&distance(&mesh.tets[j])));
        Arc::make_mut(&mut mesh.tets).swap_remove(cell.expect("cells"));
        let mut renderer = gpu::renderer(&Arc::new(mesh), gpu::by(Method::Project));
        for depth in DEPTHS {
            let mut total = Total::default();
            for camera in cameras(Place::Outside, 12) {
                check(&mut renderer, &whole, &camera, depth / DIAGONAL, &mut total);
            }
            println!("a cell is missing, k * diagonal = {depth}: {total:?}");
            assert!(total.unknown > 10, "depth {depth}: {total:?}");
        }
    }
}
