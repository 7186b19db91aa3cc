//! Orders of cells on the device: as exact as what the host proves of them, and counted where they are not.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::plan::near;
use tetralux::plan::order::Inversions;
use tetralux::renderer::{Frame, OrderMethod, Renderer as _, Settings, SortPlace};
use tetralux::scene::{
    Camera, Curve, CurveNode, EmissionModel, LightSpace, Lighting, Optics, Projection, TransferFunction, Widget,
    WidgetShape,
};
use tetralux::tet::{Adjacency, TetMesh};

use crate::common::boxes::{box_mesh, tet_mesh};
use crate::common::gpu::{self, assert_same_bits};
use crate::common::meshes;
use crate::common::rainbow::rainbow;
use crate::scenes::{SIZE, Truth, along_z, cameras, cycle, mapped_delaunay, moved, plain, stretched};

fn by(order: OrderMethod) -> Settings {
    Settings { order, ..gpu::by_centroids() }
}

#[test]
fn power_is_exact_where_the_census_says_so() {
    for (name, map) in [("Delaunay", DMat3::IDENTITY), ("stretched", stretched())] {
        let mesh = mapped_delaunay(map);
        let transfer = rainbow(&mesh, 20, 10.0);
        let oracle = Oracle::new(mesh.clone());
        let mut renderers = gpu::PROJECTIONS
            .map(|method| (method, gpu::renderer(&mesh, Settings { method, ..by(OrderMethod::Power) })));
        for (i, camera) in cameras(&mesh).iter().enumerate() {
            let truth = Truth::new(&oracle, &mesh, plain(camera, &transfer));
            for (method, renderer) in &mut renderers {
                let drawn = truth.assert_drawn(&format!("{name}, power, camera {i}, {method:?}"), renderer);
                assert!(drawn.stats.order.contains("power: asked for; exact"), "{}", drawn.stats.order);
                let told = renderer.render(&truth.frame, true).expect("a picture").stats;
                let Inversions { pairs, wrong } = told.inversions.expect("counted");
                assert!(pairs > 500 && wrong as f64 <= 1e-5 * pairs as f64, "{name}, camera {i}: {wrong} of {pairs}");
            }
        }
    }
}

#[test]
fn power_says_that_it_is_not_exact() {
    let mesh = moved();
    let transfer = rainbow(&mesh, 20, 10.0);
    let camera = cameras(&mesh)[0];
    let told =
        |order| gpu::renderer(&mesh, by(order)).render(&plain(&camera, &transfer), true).expect("a picture").stats;
    let power = told(OrderMethod::Power);
    assert!(power.order.contains("not exact"), "{}", power.order);
    assert!(power.inversions.expect("counted").wrong > 0);
    assert!(told(OrderMethod::Centroid).inversions.expect("counted").share() > 0.1);
    assert_eq!(told(OrderMethod::Mpvonc).inversions.expect("counted").wrong, 0);
}

#[test]
fn hosts_orders_are_exact_for_convex_meshes_wherever_they_are_sorted() {
    for (name, mesh) in [("moved", moved()), ("tangle", meshes::sample(Sample::Tangle, 8_000))] {
        let transfer = rainbow(&mesh, 20, 10.0);
        let oracle = Oracle::new(mesh.clone());
        for (i, camera) in cameras(&mesh).iter().enumerate() {
            let truth = Truth::new(&oracle, &mesh, plain(camera, &transfer));
            let mut pictures = Vec::new();
            for (order, sort) in [
                (OrderMethod::Mpvonc, SortPlace::Host),
                (OrderMethod::Mpvonc, SortPlace::Gpu),
                (OrderMethod::Exact, SortPlace::Host),
            ] {
                let mut renderer = gpu::renderer(&mesh, Settings { sort, ..by(order) });
                let drawn = truth.assert_drawn(&format!("{name}, {order}, camera {i}, {sort:?}"), &mut renderer);
                pictures.push(drawn.image);
            }
            assert_same_bits(&pictures[0], &pictures[1], &format!("{name}, camera {i}: sorted on the GPU"));
        }
    }
}

/// A box before another one, and one with a hole: neighbours tell nothing of what lies across.
#[test]
fn exact_looks_across_gaps() {
    let boxes = [(DVec3::ZERO, DVec3::new(1.0, 1.0, 0.3)), (DVec3::new(0.1, -0.2, 0.5), DVec3::new(1.1, 0.7, 1.4))];
    let (mut points, mut tets) = (Vec::new(), Vec::new());
    for (min, max) in boxes {
        let part = box_mesh(4, min, max, |_| [0.0, 0.0]);
        let first = points.len() as u32;
        points.extend(part.vertices.iter().map(|&v| part.data_from_mesh(v)));
        tets.extend(part.tets.iter().map(|tet| tet.map(|v| v + first)));
    }
    let mesh = Arc::new(tet_mesh(&points, tets, |p| [p.x + 0.7 * p.y + 1.3 * p.z, 0.0]));
    let transfer = rainbow(&mesh, 20, 10.0);
    let oracle = Oracle::new(mesh.clone());
    for (i, camera) in cameras(&mesh).iter().enumerate() {
        let truth = Truth::new(&oracle, &mesh, plain(camera, &transfer));
        truth.assert_drawn(&format!("two boxes, camera {i}"), &mut gpu::renderer(&mesh, by(OrderMethod::Exact)));
    }
}

#[test]
fn circles_of_cells_are_told() {
    let (mesh, camera) = (cycle(), along_z());
    let transfer = rainbow(&mesh, 7, 10.0);
    let told = gpu::renderer(&mesh, by(OrderMethod::Exact)).render(&plain(&camera, &transfer), false);
    let notes = told.expect("a picture").stats.notes;
    assert!(notes.iter().any(|note| note.starts_with("1 circles of cells")), "{notes:?}");
}

/// What is counted is what was drawn: a reversed list has every pair wrong.
#[test]
fn counted_inversions_are_those_of_the_drawn_cells() {
    let mesh = moved();
    let camera = cameras(&mesh)[0];
    let transfer = rainbow(&mesh, 20, 10.0);
    let mut renderer = gpu::renderer(&mesh, by(OrderMethod::Mpvonc));
    let stats = renderer.render(&plain(&camera, &transfer), true).expect("a picture").stats;
    let mut drawn = renderer.order().expect("an order");
    assert!(drawn.len() < mesh.tets.len(), "some cells are culled");
    let adjacency = Adjacency::new(&mesh);
    let counted = Inversions::of_drawn(&mesh, &adjacency, &camera, &drawn);
    assert_eq!((stats.inversions, counted.wrong), (Some(counted), 0));
    let all = Inversions::of_drawn(&mesh, &adjacency, &camera, &(0..mesh.tets.len() as u32).collect::<Vec<_>>());
    assert!(counted.pairs < all.pairs);
    drawn.reverse();
    let reversed = Inversions::of_drawn(&mesh, &adjacency, &camera, &drawn);
    assert_eq!((reversed.pairs, reversed.wrong), (counted.pairs, counted.pairs));
}

#[test]
fn auto_takes_what_the_scene_needs() {
    let (regular, other) = (mapped_delaunay(DMat3::IDENTITY), moved());
    let thick = |mesh: &TetMesh| rainbow(mesh, 20, 10.0);
    // Of which no order changes more than 1/1024, and of which one might: at most ten times as deep.
    let thin = |mesh: &TetMesh| rainbow(mesh, 20, 0.0066);
    let thicker = |mesh: &TetMesh| rainbow(mesh, 20, 0.0069);
    let gold = |mesh: &TetMesh| {
        let (range, (_, diagonal)) = (mesh.scalar_range(), meshes::center_and_diagonal(mesh));
        let node = |scalar, depth: f64| CurveNode { scalar, color: [0.9, 0.6, 0.3], extinction: depth / diagonal };
        TransferFunction::Curve(Curve { nodes: vec![node(range.min, 0.0), node(range.max, 30.0)] })
    };
    let widget = |mesh: &TetMesh| {
        let depth = 30.0 / meshes::center_and_diagonal(mesh).1;
        TransferFunction::Widgets(vec![Widget::new(WidgetShape::Uniform, [0.9, 0.6, 0.3], depth)])
    };
    let unweighted = Optics { emission: EmissionModel::Unweighted, ..Optics::PLAIN };
    let lighting = Lighting {
        direction: DVec3::Z,
        space: LightSpace::View,
        ambient: 0.3,
        diffuse: 0.6,
        specular: 0.2,
        shininess: 8.0,
    };
    let lit = Optics { lighting: Some(lighting), ..Optics::PLAIN };
    for (what, mesh, transfer, optics, want) in [
        ("thick, regular", &regular, thick(&regular), &Optics::PLAIN, "power: "),
        ("thick, not regular", &other, thick(&other), &Optics::PLAIN, "per-pixel: "),
        ("thin", &other, thin(&other), &Optics::PLAIN, "centroid: "),
        ("less thin", &other, thicker(&other), &Optics::PLAIN, "per-pixel: "),
        ("thin, lit", &other, thin(&other), &lit, "per-pixel: "),
        ("thin, unweighted", &other, thin(&other), &unweighted, "per-pixel: "),
        ("one colour", &other, gold(&other), &Optics::PLAIN, "centroid: "),
        ("one widget", &other, widget(&other), &Optics::PLAIN, "centroid: "),
        ("one colour, unweighted", &other, widget(&other), &unweighted, "per-pixel: "),
    ] {
        let camera = cameras(mesh)[0];
        let frame = Frame { optics, ..plain(&camera, &transfer) };
        let stats = gpu::renderer(mesh, by(OrderMethod::Auto)).render(&frame, false).expect("a picture").stats;
        assert!(stats.order.starts_with(want), "{what}: {}", stats.order);
    }
}

/// Ranks are those of the camera of the frame, and pieces near the eye have room.
#[test]
fn frames_in_any_succession_are_the_same() {
    let mesh = moved();
    let transfer = rainbow(&mesh, 20, 10.0);
    let views: Vec<Camera> = cameras(&mesh).into_iter().chain([along(&mesh)]).collect();
    for order in [OrderMethod::Exact, OrderMethod::PerPixel] {
        let mut kept = gpu::renderer(&mesh, by(order));
        for i in [0, 2, 3, 0, 2] {
            let fresh = gpu::draw(&mut gpu::renderer(&mesh, by(order)), &views[i], &transfer, [96, 64]).image;
            let again = gpu::draw(&mut kept, &views[i], &transfer, [96, 64]).image;
            assert_same_bits(&again, &fresh, &format!("{order}, view {i}"));
        }
    }
}

/// Cells behind the eye and beside the picture are clipped, and none has pieces: ranks end with the mesh.
#[test]
fn cells_that_are_clipped_without_pieces_leave_the_others_in_order() {
    let mesh = mapped_delaunay(DMat3::IDENTITY);
    let transfer = rainbow(&mesh, 20, 10.0);
    let oracle = Oracle::new(mesh.clone());
    let (center, diagonal) = meshes::center_and_diagonal(&mesh);
    let whole = cameras(&mesh)[0];
    let ahead = |eye: DVec3, direction: DVec3| Camera { eye, target: eye + diagonal * direction, ..whole };
    // The cube's far side is seen past a corner; what is behind and beside the eye is not.
    let past = ahead(center + diagonal * DVec3::new(-0.45, 0.0, -0.23), DVec3::Z);
    let behind = ahead(whole.eye, whole.eye - whole.target);
    let beside = ahead(center + diagonal * DVec3::X, DVec3::Z);
    for view in [&past, &behind, &beside] {
        let cut = near::cut(&mesh, view, f64::from(SIZE[0]) / f64::from(SIZE[1])).expect("clipped cells");
        assert!(cut.tets.is_empty(), "{} pieces", cut.tets.len());
    }
    let [truth, truth_past] = [&whole, &past].map(|view| Truth::new(&oracle, &mesh, plain(view, &transfer)));
    for order in [OrderMethod::Exact, OrderMethod::Mpvonc, OrderMethod::Power] {
        let mut renderer = gpu::renderer(&mesh, by(order));
        truth_past.assert_drawn(&format!("{order}, past a corner"), &mut renderer);
        for nothing in [&behind, &beside] {
            let frame = plain(nothing, &transfer);
            let image = renderer.render(&frame, false).unwrap_or_else(|e| panic!("{order}: {e}")).image;
            assert!(image.pixels.iter().all(|&p| p == frame.background), "{order}: nothing is there");
        }
        truth.assert_drawn(&format!("{order}, the whole mesh"), &mut renderer);
        truth_past.assert_drawn(&format!("{order}, past a corner again"), &mut renderer);
    }
}

fn along(mesh: &TetMesh) -> Camera {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let eye = target + diagonal * DVec3::new(-0.06, 0.04, -0.05);
    Camera { eye, target, up: DVec3::Y, projection: Projection::Perspective { fov_y: 1.0 }, near: None }
}
