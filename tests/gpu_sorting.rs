//! Sorting on the host and on the GPU gives the same pictures; so do parts of the mesh bound one by one, and frames in
//! any succession.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::sync::Arc;

use common::boxes::box_mesh;
use common::gpu::{self, assert_same_bits, cells, draw};
use common::meshes;
use glam::DVec3;
use tetralux::error::Error;
use tetralux::gpu::{Gpu, GpuRenderer};
use tetralux::image::{Comparison, Image};
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::plan::order::centroid_depth;
use tetralux::renderer::{Frame, Renderer as _, SegmentIntegral, Settings, SortPlace};
use tetralux::scene::{Camera, Curve, CurveNode, Optics, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::TetMesh;

const SIZE: [u32; 2] = [96, 96];

/// Colour changes all over the scalar's range, so that any exchange of two cells on a ray is seen.
fn colorful(mesh: &TetMesh) -> TransferFunction {
    let (range, (_, diagonal)) = (mesh.scalar_range(), meshes::center_and_diagonal(mesh));
    let primaries = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let nodes = (0..13).map(|i| CurveNode {
        scalar: range.min + f64::from(i) / 12.0 * range.length(),
        color: primaries[i as usize % 3],
        extinction: 8.0 / diagonal,
    });
    let nodes = nodes.collect();
    TransferFunction::Curve(Curve { nodes })
}

/// Sees all of the mesh.
fn camera(mesh: &TetMesh, from: DVec3, perspective: bool) -> Camera {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let projection = match perspective {
        true => Projection::Perspective { fov_y: 0.6 },
        false => Projection::Orthographic { height: diagonal },
    };
    let up = if from.x == 0.0 && from.z == 0.0 { DVec3::X } else { DVec3::Y };
    Camera { eye: target + 2.0 * diagonal * from.normalize(), target, up, projection, near: None }
}

/// The first `count` cells of a jittered box.
fn first_cells(count: usize) -> Arc<TetMesh> {
    let mut mesh = Arc::unwrap_or_clone(meshes::sample(Sample::Tangle, count.max(600)));
    Arc::make_mut(&mut mesh.tets).truncate(count);
    Arc::new(mesh)
}

fn sorted_at(place: SortPlace, mesh: &Arc<TetMesh>, camera: &Camera, size: [u32; 2]) -> (Image, u64) {
    let mut renderer = gpu::renderer(mesh, Settings { sort: place, ..gpu::by_centroids() });
    let rendered = draw(&mut renderer, camera, &colorful(mesh), size);
    (rendered.image.clone(), cells(&rendered, "drawn"))
}

/// Returns how many cells were sorted.
fn both_sorts_agree(mesh: &Arc<TetMesh>, camera: &Camera, size: [u32; 2]) -> u64 {
    let (host, on_host) = sorted_at(SortPlace::Host, mesh, camera, size);
    let (gpu, on_gpu) = sorted_at(SortPlace::Gpu, mesh, camera, size);
    assert_eq!(on_host, on_gpu);
    assert_same_bits(&gpu, &host, &format!("{on_host} cells"));
    on_host
}

#[test]
fn both_sorts_agree_around_the_sizes_of_groups_and_tiles() {
    for count in [1, 255, 256, 257, 1023, 1024, 1025] {
        let mesh = first_cells(count);
        let sorted = both_sorts_agree(&mesh, &camera(&mesh, DVec3::new(1.0, 0.7, 0.4), true), [256, 256]);
        assert_eq!(sorted, count as u64, "every cell covers a pixel");
    }
}

#[test]
fn both_sorts_agree_beyond_a_chunk() {
    let mesh = meshes::sample(Sample::Tangle, 73_002);
    let sorted = both_sorts_agree(&mesh, &camera(&mesh, DVec3::new(1.0, 0.7, 0.4), true), [512, 512]);
    assert!(sorted > 65_536, "more than one chunk is drawn: {sorted}");
}

#[test]
fn both_sorts_agree_where_thousands_of_keys_are_equal() {
    let field = |p: DVec3| [(17.0 * p.x).sin() + (13.0 * p.y).sin() + (11.0 * p.z).sin(), 0.0];
    let mesh = Arc::new(box_mesh(14, DVec3::splat(-1.0), DVec3::splat(1.0), field));
    for axis in [DVec3::X, DVec3::NEG_Y, DVec3::Z] {
        let camera = camera(&mesh, axis, false);
        let keys = centroid_depth(&mesh, &camera);
        let mut distinct: Vec<i64> = keys.iter().map(|k| (k * 1e6).round() as i64).collect();
        distinct.sort_unstable();
        distinct.dedup();
        assert!(distinct.len() * 100 < keys.len(), "{} distinct keys of {}", distinct.len(), keys.len());
        both_sorts_agree(&mesh, &camera, SIZE);
    }
}

/// Bit-equal pictures would also come of no sorting at all.
#[test]
fn the_order_is_back_to_front() {
    let mesh = meshes::sample(Sample::Tangle, 3_000);
    let camera = camera(&mesh, DVec3::new(1.0, 0.7, 0.4), true);
    let transfer = colorful(&mesh);
    let frame =
        Frame { camera: &camera, transfer: &transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.0; 4] };
    let oracle = Oracle::new(mesh.clone());
    let keys = centroid_depth(&mesh, &camera);
    let front_first: Vec<f64> = keys.iter().map(|key| -key).collect();
    let mut swapped = keys.clone();
    let (near, far) = (keys.iter().copied().fold(f64::INFINITY, f64::min), keys.iter().copied().fold(0.0, f64::max));
    // A cell near the front, drawn behind all others.
    let middle =
        keys.iter().position(|&k| (k - near - 0.25 * (far - near)).abs() < 0.02 * (far - near)).expect("a cell");
    swapped[middle] = 2.0 * far;
    let wrong = |got: &Image, keys: &[f64]| {
        let want = oracle.render_in_order(&frame, keys).expect("a picture");
        Comparison::new(got, &want).expect("equal sizes").pixels_above(2e-3).count()
    };
    for place in [SortPlace::Host, SortPlace::Gpu] {
        let (got, _) = sorted_at(place, &mesh, &camera, SIZE);
        let counts = [&keys, &front_first, &swapped].map(|keys| wrong(&got, keys));
        println!("{place:?}: wrong pixels in this order, the reverse, and with a cell misplaced: {counts:?}");
        // One on an edge between cells.
        assert!(counts[0] <= 1 && counts[1] > 1_000 && counts[2] > 2, "{place:?}: {counts:?}");
    }
}

fn gaussians(mesh: &TetMesh) -> TransferFunction {
    let (s, g, (_, diagonal)) = (mesh.scalar_range(), mesh.gradient_range(), meshes::center_and_diagonal(mesh));
    let shape = WidgetShape::Gaussian {
        center: [s.min + 0.4 * s.length(), g.min + 0.3 * g.length()],
        sigma: [0.1 * s.length(), 0.2 * g.length()],
        angle: 0.3,
    };
    let extinction = 20.0 / diagonal;
    TransferFunction::Widgets(vec![Widget {
        shape,
        color: [0.2, 0.9, 0.4],
        extinction,
        scalar_range: None,
        gradient_range: None,
        window: None,
    }])
}

#[test]
fn frames_leave_nothing_behind() {
    let mesh = meshes::sample(Sample::MarschnerLobb, 6_000);
    let (curve, widgets) = (colorful(&mesh), gaussians(&mesh));
    let side = DVec3::new(1.0, 0.7, 0.4);
    let (perspective, flat) = (camera(&mesh, side, true), camera(&mesh, side, false));
    let close = Camera { eye: perspective.target + 0.6 * (perspective.eye - perspective.target), ..perspective };
    let frames = [
        (&perspective, &curve, SIZE),
        (&perspective, &curve, SIZE),
        (&flat, &curve, SIZE),
        (&flat, &widgets, SIZE),
        (&perspective, &widgets, [130, 70]),
        (&close, &widgets, [130, 70]),
        (&perspective, &curve, [1, 300]),
        (&close, &curve, SIZE),
        (&perspective, &curve, SIZE),
    ];
    for place in [SortPlace::Host, SortPlace::Gpu] {
        let settings = Settings { sort: place, ..gpu::by_centroids() };
        let mut kept = gpu::renderer(&mesh, settings);
        for (i, &(camera, transfer, size)) in frames.iter().enumerate() {
            if i % 2 == 1 {
                let frame = Frame { camera, transfer, optics: &Optics::PLAIN, size, background: [0.0; 4] };
                kept.render_only(&frame).expect("a frame");
            }
            let got = draw(&mut kept, camera, transfer, size).image;
            let fresh = draw(&mut gpu::renderer(&mesh, settings), camera, transfer, size).image;
            assert_same_bits(&got, &fresh, &format!("{place:?}, frame {i}"));
        }
    }
}

#[test]
fn nothing_is_seen_of_a_mesh_behind_the_camera() {
    let mesh = meshes::sample(Sample::Tangle, 6_000);
    for perspective in [true, false] {
        let toward = camera(&mesh, DVec3::new(1.0, 0.7, 0.4), perspective);
        let away = Camera { target: 2.0 * toward.eye - toward.target, ..toward };
        let mut renderer = gpu::renderer(&mesh, gpu::by_centroids());
        let picture = draw(&mut renderer, &away, &colorful(&mesh), SIZE).image;
        assert!(picture.pixels.iter().all(|p| *p == [0.0; 4]));
        let seen = draw(&mut renderer, &toward, &colorful(&mesh), SIZE).image;
        assert!(seen.pixels.iter().any(|p| p[3] > 0.1), "and it is there when the camera turns");
    }
}

#[test]
fn a_background_lies_behind() {
    let mesh = first_cells(600);
    let (camera, transfer) = (camera(&mesh, DVec3::new(1.0, 0.7, 0.4), true), colorful(&mesh));
    let mut renderer = gpu::renderer(&mesh, gpu::by_centroids());
    let plain = draw(&mut renderer, &camera, &transfer, SIZE).image;
    let background = [0.1, 0.3, 0.2, 0.5];
    let frame = Frame { camera: &camera, transfer: &transfer, optics: &Optics::PLAIN, size: SIZE, background };
    let got = renderer.render(&frame, false).expect("a picture").image;
    let comparison = Comparison::new(&got, &plain.over(background)).expect("equal sizes");
    assert!(comparison.max < 1e-6, "{comparison}");
    assert!(Comparison::new(&got, &plain).expect("equal sizes").max > 0.1);
}

/// 1 MiB binds 65,536 tetrahedra.
fn small_bindings() -> Gpu {
    Gpu::with_binding_limit(gpu::choice(), 1 << 20).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_mesh_bound_in_parts_gives_the_same_picture() {
    let mesh = meshes::sample(Sample::Tangle, 180_000);
    assert!((131_072..196_608).contains(&mesh.tets.len()), "three parts: {}", mesh.tets.len());
    let (camera, transfer) = (camera(&mesh, DVec3::new(1.0, 0.7, 0.4), true), colorful(&mesh));
    let whole = draw(&mut gpu::renderer(&mesh, gpu::by_centroids()), &camera, &transfer, SIZE);
    for sort in [SortPlace::Host, SortPlace::Gpu] {
        let settings = Settings { sort, ..gpu::by_centroids() };
        let mut renderer = GpuRenderer::new(small_bindings(), mesh.clone(), settings).unwrap_or_else(|e| panic!("{e}"));
        let parts = draw(&mut renderer, &camera, &transfer, SIZE);
        assert_eq!(cells(&parts, "drawn"), cells(&whole, "drawn"));
        assert_same_bits(&parts.image, &whole.image, &format!("{sort:?}"));
    }
}

#[test]
fn a_mesh_of_more_than_four_parts_is_refused_with_the_numbers() {
    let mesh = meshes::sample(Sample::Tangle, 280_000);
    let count = mesh.tets.len();
    assert!(count > 4 * 65_536);
    let refusal = GpuRenderer::new(small_bindings(), mesh, gpu::by_centroids()).err().expect("a refusal");
    let Error::Device(text) = refusal else { panic!("another error: {refusal}") };
    assert!(text.contains(&count.to_string()) && text.contains("262144"), "{text}");
}

/// A function that shows nothing of the data draws no span: neither those of the frame before.
#[test]
fn nothing_is_left_of_the_frame_before() {
    let mesh = meshes::sample(Sample::Tangle, 2_000);
    let (range, (_, diagonal)) = (mesh.scalar_range(), meshes::center_and_diagonal(&mesh));
    let camera = camera(&mesh, DVec3::new(1.0, 0.7, 0.4), true);
    let beyond = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 9.0)].map(|(at, extinction)| CurveNode {
        scalar: range.min + at * range.length(),
        color: [1.0, 0.5, 0.2],
        extinction: extinction / diagonal,
    });
    let beyond = TransferFunction::Curve(Curve { nodes: beyond.to_vec() });
    for sort in [SortPlace::Host, SortPlace::Gpu] {
        let settings = Settings { sort, integral: SegmentIntegral::Analytic, ..gpu::by_centroids() };
        let mut renderer = gpu::renderer(&mesh, settings);
        let before = draw(&mut renderer, &camera, &colorful(&mesh), SIZE);
        assert!(cells(&before, "drawn") > 2_000);
        let after = draw(&mut renderer, &camera, &beyond, SIZE);
        assert_eq!(cells(&after, "spans of them"), 0);
        let shown = after.image.pixels.iter().filter(|p| **p != [0.0; 4]).count();
        assert_eq!(shown, 0, "{sort:?}: {shown} pixels show what is not there");
    }
}
