//! A uniform medium fills a box without gap or overlap: every pixel is `1 - exp(-k * chord)`.

use std::sync::Arc;

use glam::DVec3;
use tetralux::renderer::{Frame, Renderer, Settings};
use tetralux::scene::{Camera, Optics, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::TetMesh;

use crate::common::boxes::{box_mesh, chord};
use crate::common::delaunay;
use crate::common::random::Random;
use crate::engine;

const SIZE: [u32; 2] = [64, 64];
/// Of every pixel's opacity and colour.
const LIMIT: f64 = 1e-4;
/// Optical depths along the box's diagonal.
const DEPTHS: [f64; 3] = [0.1, 3.0, 30.0];
const COLOR: [f64; 3] = [1.0, 0.5, 0.25];
const DIAGONAL: f64 = 1.732_050_807_568_877_2;
/// Pixels: rays are rounded to f32, which moves them by 1e-7 of the mesh's size, so whether one grazes the box cannot be
/// told nearer.
const GRAZING: f64 = 1e-4;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    Outside,
    Inside,
    /// Inside, where several cells meet.
    AtVertex,
    /// Along the axes, so that faces are seen edge-on and rays meet vertices and edges exactly.
    Aligned,
}

fn cameras(place: Place, mesh: &TetMesh, count: usize) -> Vec<Camera> {
    let mut random = Random(place as u64 + 1);
    (0..count)
        .map(|i| {
            let mut target = DVec3::splat(0.5) + 0.2 * random.direction();
            let mut up = random.direction();
            let eye = match place {
                Place::Outside => target + random.within(1.3, 3.0) * DIAGONAL * random.direction(),
                Place::Inside => target + random.within(0.05, 0.25) * random.direction(),
                Place::AtVertex => {
                    let near = |v: &DVec3| (mesh.data_from_mesh(*v) - target).length();
                    let nearest = mesh.vertices.iter().min_by(|a, b| near(a).total_cmp(&near(b))).expect("vertices");
                    target += 0.3 * random.direction();
                    mesh.data_from_mesh(*nearest)
                }
                Place::Aligned => {
                    target = DVec3::splat(0.5);
                    up = DVec3::AXES[(i + 1) % 3];
                    target + random.within(1.0, 3.0) * DVec3::AXES[i % 3]
                }
            };
            let projection = match i % 4 {
                // A pixel is a power of two wide: rays at the corners of the regular box's cells.
                3 => Projection::Orthographic {
                    height: if place == Place::Aligned { 2.0 } else { random.within(0.4, 1.8) },
                },
                _ => Projection::Perspective { fov_y: random.within(0.3, 1.4) },
            };
            Camera { eye, target, up, projection, near: None }
        })
        .collect()
}

fn chord_at(camera: &Camera, position: [f64; 2]) -> f64 {
    let ray = camera.ray(SIZE, position);
    chord(ray.origin, ray.direction, camera.near_depth(DIAGONAL), DVec3::ZERO, DVec3::ONE)
}

/// Smallest and largest chord within [`GRAZING`].
fn chords_near(camera: &Camera, [x, y]: [f64; 2]) -> [f64; 2] {
    let steps = [-GRAZING, 0.0, GRAZING];
    let all = steps.iter().flat_map(|dx| steps.map(|dy| chord_at(camera, [x + dx, y + dy])));
    all.fold([f64::INFINITY, 0.0], |[low, high], c| [low.min(c), high.max(c)])
}

/// Pixels seen, pixels beyond the limit, and the worst error.
fn check(renderer: &mut dyn Renderer, camera: &Camera, extinction: f64) -> (usize, usize, f64) {
    let transfer = TransferFunction::Widgets(vec![Widget::new(WidgetShape::Uniform, COLOR, extinction)]);
    let frame = Frame { camera, transfer: &transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.0; 4] };
    let got = renderer.render(&frame, false).expect("a picture").image;
    let (mut seen, mut bad, mut worst) = (0, 0, 0.0_f64);
    for (i, pixel) in got.pixels.iter().enumerate() {
        let position = [(i % SIZE[0] as usize) as f64 + 0.5, (i / SIZE[0] as usize) as f64 + 0.5];
        let [low, high] = chords_near(camera, position).map(|c| -(-extinction * c).exp_m1());
        let error = (0..4).fold(0.0, |most: f64, c| {
            let (got, factor) = (f64::from(pixel[c]), [COLOR[0], COLOR[1], COLOR[2], 1.0][c]);
            most.max(low * factor - got).max(got - high * factor)
        });
        seen += usize::from(high > 0.0);
        // Phrased so that NaN fails.
        bad += usize::from(error.is_nan() || error > LIMIT);
        worst = worst.max(error);
    }
    (seen, bad, worst)
}

fn meshes() -> [(&'static str, Arc<TetMesh>); 2] {
    let regular = box_mesh(8, DVec3::ZERO, DVec3::ONE, |p| [p.x, 0.0]);
    let random = delaunay::cube(1_500, 40, 8, 7, |p| [p.x, 0.0]);
    [("regular", Arc::new(regular)), ("random", Arc::new(random))]
}

fn is_watertight(place: Place) {
    for (name, mesh) in meshes() {
        let mut renderer = engine(&mesh, Settings::default());
        let (mut seen, mut bad, mut worst) = (0, 0, 0.0_f64);
        for camera in cameras(place, &mesh, 24) {
            for depth in DEPTHS {
                let (s, b, w) = check(&mut *renderer, &camera, depth / DIAGONAL);
                (seen, bad, worst) = (seen + s, bad + b, worst.max(w));
            }
        }
        println!("{name}, {place:?}: {bad} of {seen} pixels, worst {worst:.1e}");
        assert!(seen > 24 * 3 * 500, "{name}, {place:?}: {seen} pixels seen");
        assert_eq!(bad, 0, "{name}, {place:?}: worst {worst}");
    }
}

#[test]
fn boxes_are_watertight() {
    is_watertight(Place::Outside);
}

#[test]
fn boxes_are_watertight_from_inside() {
    is_watertight(Place::Inside);
}

#[test]
fn boxes_are_watertight_from_a_vertex() {
    is_watertight(Place::AtVertex);
}

#[test]
fn boxes_are_watertight_along_the_axes() {
    is_watertight(Place::Aligned);
}

/// The same check sees a single cell missing.
#[test]
fn a_missing_cell_is_seen() {
    for (name, mesh) in meshes() {
        let mut holed = TetMesh::clone(&mesh);
        let distance = |tet: &[u32; 4]| {
            let center = tet.map(|v| mesh.data_from_mesh(mesh.vertices[v as usize])).iter().sum::<DVec3>() / 4.0;
            center.distance(DVec3::splat(0.9))
        };
        let cell = (0..mesh.tets.len()).min_by(|&i, &j| distance(&mesh.tets[i]).total_cmp(&distance(&mesh.tets[j])));
        Arc::make_mut(&mut holed.tets).swap_remove(cell.expect("cells"));
        let mut renderer = engine(&Arc::new(holed), Settings::default());
        for depth in DEPTHS {
            let cameras = cameras(Place::Outside, &mesh, 12);
            let bad: usize = cameras.iter().map(|camera| check(&mut *renderer, camera, depth / DIAGONAL).1).sum();
            println!("{name}, a cell is missing, k * diagonal = {depth}: {bad} pixels");
            // Behind something dense, little is seen of it.
            assert!(bad > if depth < 10.0 { 10 } else { 0 }, "{name}, depth {depth}: {bad}");
        }
    }
}
