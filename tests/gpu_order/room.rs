//! Lists that do not fit at once: pictures in strips, in many dispatches, of any size.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use tetralux::gpu::{Gpu, GpuRenderer};
use tetralux::renderer::{Frame, Method, OrderMethod, Rendered, Renderer as _, Settings};
use tetralux::tet::TetMesh;

use crate::common::boxes::box_mesh;
use crate::common::gpu::{self, assert_same_bits};
use crate::common::rainbow::rainbow;
use crate::per_pixel::by;
use crate::scenes::{cameras, mapped_delaunay, moved, plain};

/// Devices, the second of which binds so many bytes.
fn devices(bytes: u64) -> [Gpu; 2] {
    [gpu::device(), Gpu::with_binding_limit(gpu::choice(), bytes).unwrap_or_else(|e| panic!("{e}"))]
}

fn renderer(gpu: &Gpu, mesh: &Arc<TetMesh>, settings: Settings) -> GpuRenderer {
    GpuRenderer::new(gpu.clone(), mesh.clone(), settings).unwrap_or_else(|e| panic!("{e}"))
}

fn drawn(mut renderer: GpuRenderer, frame: &Frame<'_>) -> Rendered {
    renderer.render(frame, false).unwrap_or_else(|e| panic!("{e}"))
}

/// Strips of a picture, from its notes.
fn strips(drawn: &Rendered) -> u32 {
    let words = drawn.stats.notes.iter().find_map(|note| note.split_once(" fragments were listed, in "));
    let number = words.and_then(|(_, rest)| rest.split(' ').next()).and_then(|word| word.parse().ok());
    number.unwrap_or_else(|| panic!("no strips in {:?}", drawn.stats.notes))
}

/// 162 cells.
fn cubes() -> Arc<TetMesh> {
    Arc::new(box_mesh(3, DVec3::ZERO, DVec3::ONE, |p| [p.x + 0.3 * p.y * p.y - 0.4 * p.z, 0.0]))
}

/// 64 KiB bind the colours of 4,096 fragments: less than some rows have, let alone pictures.
#[test]
fn strips_and_dispatches_change_no_bit() {
    let mesh = mapped_delaunay(DMat3::IDENTITY);
    let transfer = rainbow(&mesh, 20, 10.0);
    let size = [128, 100];
    let [device, small] = devices(64 << 10);
    for camera in &cameras(&mesh)[..2] {
        let frame = Frame { size, ..plain(camera, &transfer) };
        let whole = drawn(renderer(&device, &mesh, by(Method::Project)), &frame);
        assert_eq!(strips(&whole), 1);
        let in_strips = drawn(renderer(&small, &mesh, by(Method::Project)), &frame);
        assert!(strips(&in_strips) >= 20, "{} strips", strips(&in_strips));
        assert_same_bits(&in_strips.image, &whole.image, "in strips");
        // Turns are one at least.
        for turns in [0, 5, 100] {
            let left = drawn(renderer(&device, &mesh, by(Method::Project)).leaving_lists_after(turns), &frame);
            assert_same_bits(&left.image, &whole.image, &format!("left after {turns} turns"));
        }
        let both = renderer(&small, &mesh, by(Method::Project)).leaving_lists_after(40);
        assert_same_bits(&drawn(both, &frame).image, &whole.image, "left, in strips");
    }
}

/// 16 KiB bind the states of 512 pixels.
#[test]
fn rows_wider_than_a_strip_are_drawn() {
    let mesh = cubes();
    let (transfer, camera) = (rainbow(&mesh, 9, 10.0), &cameras(&mesh)[0]);
    let frame = Frame { size: [600, 6], ..plain(camera, &transfer) };
    let [device, small] = devices(16 << 10);
    let whole = drawn(renderer(&device, &mesh, by(Method::Project)), &frame);
    let cut = drawn(renderer(&small, &mesh, by(Method::Project)), &frame);
    assert!(strips(&cut) >= 7, "{} strips", strips(&cut));
    assert_same_bits(&cut.image, &whole.image, "wide rows");
}

/// What one picture left in larger buffers is not seen in the next.
#[test]
fn sizes_follow_each_other() {
    let mesh = cubes();
    let (transfer, camera) = (rainbow(&mesh, 9, 10.0), &cameras(&mesh)[1]);
    let device = gpu::device();
    let mut kept = renderer(&device, &mesh, by(Method::Project));
    for size in [[96, 80], [33, 50], [120, 31]] {
        let frame = Frame { size, ..plain(camera, &transfer) };
        let image = kept.render(&frame, false).unwrap_or_else(|e| panic!("{e}")).image;
        let alone = drawn(renderer(&device, &mesh, by(Method::Project)), &frame).image;
        assert_same_bits(&image, &alone, &format!("{size:?}"));
    }
}

/// Fragments of 20,480 pixels cannot be counted in 64 KiB: `auto` sorts, and says so; lists that were asked for are
/// refused.
#[test]
fn pictures_too_large_for_lists_are_sorted() {
    let mesh = moved();
    let (transfer, camera) = (rainbow(&mesh, 9, 10.0), &cameras(&mesh)[0]);
    let frame = Frame { size: [160, 128], ..plain(camera, &transfer) };
    let [device, small] = devices(64 << 10);
    let auto = Settings { order: OrderMethod::Auto, ..Settings::default() };
    let listed = drawn(renderer(&device, &mesh, auto), &frame);
    assert!(listed.stats.order.starts_with("per-pixel"), "{}", listed.stats.order);
    let sorted = drawn(renderer(&small, &mesh, auto), &frame);
    assert!(sorted.stats.order.starts_with("centroid"), "{}", sorted.stats.order);
    assert!(sorted.stats.notes.iter().any(|n| n.contains("too many for lists")), "{:?}", sorted.stats.notes);
    assert_same_bits(&sorted.image, &drawn(renderer(&device, &mesh, gpu::by_centroids()), &frame).image, "sorted");
    let refused = renderer(&small, &mesh, by(Method::Project)).render(&frame, false).expect_err("lists").to_string();
    assert!(refused.contains("--order centroid"), "{refused}");
}
