//! Fragments in lists: right whatever the order of cells, in any number of strips and dispatches.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use tetralux::gpu::RayCaster;
use tetralux::image::Comparison;
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, Method, OrderMethod, Renderer as _, SegmentIntegral, Settings};
use tetralux::scene::{
    Curve, CurveNode, LightSpace, Lighting, Optics, Silhouette, SilhouetteMode, TransferFunction, Widget, WidgetShape,
};
use tetralux::tet::TetMesh;

use crate::common::boxes::{box_mesh, tet_mesh};
use crate::common::gpu::{self, assert_same_bits};
use crate::common::meshes;
use crate::common::rainbow::rainbow;
use crate::scenes::{
    EXACT, ROUNDING, SIZE, Truth, along_z, assert_same_opacity, cameras, cycle, mapped_delaunay, moved, plain, psnr,
    stretched,
};

pub fn by(method: Method) -> Settings {
    Settings { method, order: OrderMethod::PerPixel, ..Settings::default() }
}

#[test]
fn pictures_are_exact_where_centroids_are_not() {
    for (name, mesh) in [
        ("Delaunay", mapped_delaunay(DMat3::IDENTITY)),
        ("stretched Delaunay", mapped_delaunay(stretched())),
        ("moved", moved()),
        ("tangle", meshes::sample(Sample::Tangle, 10_000)),
    ] {
        let transfer = rainbow(&mesh, 20, 10.0);
        let oracle = Oracle::new(mesh.clone());
        // Their fragments are listed in one way: one mesh tells.
        let methods = if name == "Delaunay" { &gpu::PROJECTIONS[..] } else { &[Method::Project] };
        let both = |method| (method, [by(method), gpu::by(method)].map(|settings| gpu::renderer(&mesh, settings)));
        let mut renderers: Vec<_> = methods.iter().map(|&method| both(method)).collect();
        for (i, camera) in cameras(&mesh).iter().enumerate() {
            // Over no background, so that opacities tell.
            let frame = Frame { background: [0.0; 4], ..plain(camera, &transfer) };
            let truth = Truth::new(&oracle, &mesh, frame);
            for (method, [lists, sorts]) in &mut renderers {
                let what = format!("{name}, camera {i}, {method:?}");
                let drawn = truth.assert_drawn(&what, lists);
                let notes = &drawn.stats.notes;
                assert!(notes.iter().any(|n| n.contains("fragments were listed")), "{notes:?}");
                let sorted = sorts.render(&truth.frame, false).expect("a picture").image;
                let is_cut = notes.iter().any(|n| n.contains("cells near the eye were cut"));
                assert_same_opacity(&what, &drawn.image, &sorted, ROUNDING[usize::from(is_cut)]);
                let sorted = truth.psnr(&sorted);
                println!("{what}, by centroids: {sorted:.1} dB");
                assert!(sorted < 80.0 || name == "tangle", "{what}: the order does not matter here, {sorted} dB");
            }
        }
    }
}

#[test]
fn three_cells_in_a_cycle_hide_each_other() {
    let (mesh, camera) = (cycle(), along_z());
    let nodes = [(0.0, [1.0, 0.2, 0.1]), (1.1, [0.1, 1.0, 0.2]), (2.4, [0.2, 0.1, 1.0])];
    let node = |(scalar, color)| CurveNode { scalar, color, extinction: 20.0 };
    let transfer = TransferFunction::Curve(Curve { nodes: nodes.map(node).to_vec() });
    let oracle = Oracle::new(mesh.clone());
    let truth = Truth::new(&oracle, &mesh, plain(&camera, &transfer));
    for method in gpu::PROJECTIONS {
        truth.assert_drawn(&format!("cycle, {method:?}"), &mut gpu::renderer(&mesh, by(method)));
    }
    // Whatever the order of three cells, one pair is wrong.
    let sorted = psnr(&truth, &mesh, gpu::by_centroids());
    assert!(sorted < 40.0, "{sorted} dB");
}

/// What shaders are specialised to: each has entry points of its own.
#[test]
fn all_kinds_of_scenes_are_exact() {
    let mesh = meshes::fire();
    let (s, g, (_, diagonal)) = (mesh.scalar_range(), mesh.gradient_range(), meshes::center_and_diagonal(&mesh));
    let gaussian = |at: [f64; 2], color| {
        let center = [s.min + at[0] * s.length(), g.min + at[1] * g.length()];
        let sigma = [0.1 * s.length(), 0.2 * g.length()];
        Widget::new(WidgetShape::Gaussian { center, sigma, angle: 0.0 }, color, 40.0 / diagonal)
    };
    let bivariate =
        TransferFunction::Widgets(vec![gaussian([0.3, 0.2], [1.0, 0.5, 0.1]), gaussian([0.6, 0.3], [0.1, 0.4, 1.0])]);
    let univariate = rainbow(&mesh, 12, 10.0);
    let lighting = Lighting {
        direction: DVec3::new(0.3, 0.5, 0.8),
        space: LightSpace::View,
        ambient: 0.3,
        diffuse: 0.6,
        specular: 0.2,
        shininess: 8.0,
    };
    let silhouette = Silhouette { exponent: 1.5, strength: 0.9, mode: SilhouetteMode::Depth };
    let lit = Optics { lighting: Some(lighting), silhouette: Some(silhouette), ..Optics::PLAIN };
    let oracle = Oracle::new(mesh.clone());
    let integral = SegmentIntegral::Adaptive { tolerance: 1e-3 };
    let mut renderer = gpu::renderer(&mesh, Settings { integral, ..by(Method::Project) });
    for (function, transfer) in [("univariate", &univariate), ("bivariate", &bivariate)] {
        for (optics_name, optics) in [("plain", &Optics::PLAIN), ("lit", &lit)] {
            // Lit pieces of cells around the eye have middles of their own.
            let count = if optics.uses_gradients() { 2 } else { 3 };
            for (i, camera) in cameras(&mesh)[..count].iter().enumerate() {
                let frame = Frame { optics, ..plain(camera, transfer) };
                let truth = Truth::new(&oracle, &mesh, frame);
                truth.assert_drawn(&format!("{function}, {optics_name}, camera {i}"), &mut renderer);
            }
        }
    }
}

/// Two meshes in one place: each pixel's fragments are composed by depth, whatever the order of cells in the file.
#[test]
fn cells_that_overlap_give_one_picture_in_any_order() {
    let one = box_mesh(4, DVec3::ZERO, DVec3::ONE, |p| [p.x + 0.3 * p.y, 0.0]);
    let other = box_mesh(3, DVec3::splat(0.4), DVec3::splat(1.4), |p| [2.0 + p.z, 0.0]);
    let copy = box_mesh(4, DVec3::ZERO, DVec3::ONE, |p| [p.x + 0.3 * p.y, 0.0]);
    let mut points = Vec::new();
    let (mut scalar, mut tets) = (Vec::new(), Vec::new());
    for part in [&one, &other, &copy] {
        let first = points.len() as u32;
        points.extend(part.vertices.iter().map(|&v| part.data_from_mesh(v)));
        scalar.extend_from_slice(&part.scalar);
        tets.extend(part.tets.iter().map(|tet| tet.map(|v| v + first)));
    }
    let backwards: Vec<[u32; 4]> = tets.iter().rev().copied().collect();
    let [mesh, reversed] = [tets, backwards]
        .map(|tets| Arc::new(TetMesh { scalar: scalar.clone(), ..tet_mesh(&points, tets, |_| [0.0, 0.0]) }));
    let transfer = rainbow(&mesh, 9, 10.0);
    for camera in &cameras(&mesh)[..2] {
        let draw = |mesh| gpu::draw(&mut gpu::renderer(mesh, by(Method::Project)), camera, &transfer, SIZE).image;
        let image = draw(&mesh);
        assert_same_bits(&draw(&reversed), &image, "cells listed backwards");
        // Of a copy at the same place, which is before the other does not matter: they look alike.
        let oracle = Oracle::new(mesh.clone());
        let frame = Frame { background: [0.0; 4], ..plain(camera, &transfer) };
        let truth = Truth::new(&oracle, &mesh, frame);
        let c = Comparison::new(&image, &truth.image).expect("equal sizes");
        println!("overlapping: {:.1} dB, worst {:.1e}", c.psnr, c.max);
        assert!(c.psnr > 60.0, "{c}");
    }
}

#[test]
fn nothing_to_see_is_the_background() {
    let mesh = meshes::sample(Sample::Tangle, 600);
    let range = mesh.scalar_range();
    let band = Widget {
        scalar_range: Some([range.max + 1.0, range.max + 2.0]),
        ..Widget::new(WidgetShape::Uniform, [1.0; 3], 3.0)
    };
    let transfer = TransferFunction::Widgets(vec![band]);
    let camera = cameras(&mesh)[0];
    let frame = plain(&camera, &transfer);
    let drawn = gpu::renderer(&mesh, by(Method::Project)).render(&frame, false).expect("a picture");
    assert!(drawn.image.pixels.iter().all(|&p| p == frame.background), "{:?}", drawn.image.pixels[0]);
}

/// Rays have no order, and no rasteriser's edges.
#[test]
fn rays_see_what_lists_and_exact_orders_draw() {
    for (name, mesh, orders) in [
        ("Delaunay", mapped_delaunay(DMat3::IDENTITY), &[OrderMethod::PerPixel, OrderMethod::Power][..]),
        ("moved", moved(), &[OrderMethod::PerPixel, OrderMethod::Exact]),
    ] {
        let transfer = rainbow(&mesh, 20, 10.0);
        let settings = Settings { method: Method::RayCast, ..Settings::default() };
        let mut caster = RayCaster::new(gpu::device(), mesh.clone(), settings).expect("a caster");
        for (i, camera) in cameras(&mesh).iter().enumerate() {
            let frame = plain(camera, &transfer);
            let cast = caster.render(&frame, false).expect("a picture").image;
            for &order in orders {
                let drawn = gpu::renderer(&mesh, Settings { order, ..by(Method::Project) }).render(&frame, false);
                let c = Comparison::new(&drawn.expect("a picture").image, &cast).expect("equal sizes");
                println!("{name}, {order}, camera {i}: {:.1} dB, 99.9 % {:.1e}", c.psnr, c.percentile_99_9);
                assert!(c.psnr >= EXACT.psnr && c.percentile_99_9 <= EXACT.percentile_99_9, "{name}, {order}: {c}");
            }
            let sorted = gpu::renderer(&mesh, gpu::by_centroids()).render(&frame, false).expect("a picture").image;
            let c = Comparison::new(&sorted, &cast).expect("equal sizes");
            assert!(c.psnr < EXACT.psnr, "{name}, camera {i}: the order by centroids went unnoticed");
        }
    }
}
