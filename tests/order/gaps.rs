//! Meshes that rays leave and enter again, against pictures of the true order.

use std::sync::Arc;

use glam::DVec3;
use tetralux::image::Comparison;
use tetralux::oracle::Oracle;
use tetralux::plan::order::{VisibilityOrder, centroid_depth, exact, mpvonc};
use tetralux::renderer::Frame;
use tetralux::scene::{Camera, Curve, CurveNode, Optics, Projection, TransferFunction};
use tetralux::tet::{Adjacency, TetMesh};

use crate::common::boxes::{box_mesh, tet_mesh};
use crate::support::{camera, delaunay, fields, without};

const SIZE: [u32; 2] = [64, 48];

/// Of two meshes, one; data space.
fn joined(a: &TetMesh, b: &TetMesh) -> TetMesh {
    let place = |mesh: &TetMesh| mesh.vertices.iter().map(|&v| mesh.data_from_mesh(v)).collect::<Vec<_>>();
    let (mut points, mut tets) = (place(a), a.tets.to_vec());
    let first = points.len() as u32;
    points.extend(place(b));
    tets.extend(b.tets.iter().map(|tet| tet.map(|v| v + first)));
    tet_mesh(&points, tets, fields)
}

/// Around the unit cube, near it, within it, and parallel.
fn cameras() -> [Camera; 5] {
    let middle = DVec3::new(0.52, 0.49, 0.47);
    let perspective = Projection::Perspective { fov_y: 0.9 };
    [
        camera(DVec3::new(1.9, 1.3, 1.1), middle, perspective),
        camera(DVec3::new(-0.9, 0.4, 0.8), middle, Projection::Perspective { fov_y: 1.4 }),
        camera(DVec3::new(0.13, 0.21, 0.17), DVec3::new(0.9, 0.8, 0.7), Projection::Perspective { fov_y: 1.6 }),
        camera(DVec3::new(2.0, 0.6, 0.7), middle, Projection::Orthographic { height: 1.5 }),
        camera(DVec3::new(-1.0, -1.3, 1.7), middle, Projection::Orthographic { height: 1.8 }),
    ]
}

fn layers() -> TransferFunction {
    let node = |scalar, color| CurveNode { scalar, color, extinction: 4.0 };
    TransferFunction::Curve(Curve { nodes: vec![node(-0.3, [1.0, 0.0, 0.0]), node(1.5, [0.0, 0.2, 1.0])] })
}

/// Largest error in the picture of the cells in some order.
fn error(oracle: &Oracle, camera: &Camera, order: &VisibilityOrder) -> f64 {
    let transfer = layers();
    let frame = Frame { camera, transfer: &transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.0; 4] };
    let keys: Vec<f64> = order.ranks().iter().map(|&rank| -f64::from(rank)).collect();
    let (got, want) = (oracle.render_in_order(&frame, &keys), oracle.image(&frame).expect("a picture"));
    assert!(want.pixels.iter().filter(|p| p[3] > 0.1).count() > 500, "something is seen");
    Comparison::new(&got.expect("a picture"), &want).expect("equal sizes").max
}

#[test]
fn exact_orders_give_the_true_picture() {
    let boxed = |n| box_mesh(n, DVec3::ZERO, DVec3::ONE, fields);
    let hole = |p: DVec3| (p.x - 0.5).abs().max((p.y - 0.5).abs()) < 0.26;
    let meshes = [
        ("a hole through", without(boxed(4), hole)),
        ("a hollow", without(delaunay(3), |p| (p - 0.5).length() < 0.35)),
        ("a U", without(boxed(6), |p| (p.x - 0.5).abs() < 0.2 && p.z > 0.3)),
        ("a gap", without(delaunay(4), |p| (p.dot(DVec3::new(0.8, 0.6, 0.2)) - 0.8).abs() < 0.1)),
        (
            "large and small cells",
            joined(
                &box_mesh(1, DVec3::ZERO, DVec3::new(1.0, 1.0, 0.48), fields),
                &box_mesh(7, DVec3::new(0.0, 0.0, 0.52), DVec3::ONE, fields),
            ),
        ),
        (
            "parts that touch",
            joined(
                &box_mesh(2, DVec3::ZERO, DVec3::new(0.5, 1.0, 1.0), fields),
                &box_mesh(3, DVec3::new(0.5, 0.0, 0.0), DVec3::ONE, fields),
            ),
        ),
    ];
    for (name, mesh) in meshes {
        let oracle = Oracle::new(Arc::new(mesh));
        let mesh = oracle_mesh(&oracle);
        let adjacency = Adjacency::new(mesh);
        let mut worst = [0.0_f64; 3];
        for camera in cameras() {
            let sequenced = exact(mesh, &adjacency, &camera, SIZE);
            assert_eq!(sequenced.cycles, 0, "{name}: {camera:?}");
            let orders = [
                sequenced.order,
                mpvonc(mesh, &adjacency, &camera).order,
                VisibilityOrder::by_keys(&centroid_depth(mesh, &camera)),
            ];
            let errors = orders.map(|order| error(&oracle, &camera, &order));
            assert!(errors[0] < 1e-6, "{name}: {camera:?}: {errors:?}");
            worst = std::array::from_fn(|i| worst[i].max(errors[i]));
        }
        println!("{name}: exact {:.1e}, mpvonc {:.1e}, centroid {:.1e}", worst[0], worst[1], worst[2]);
        assert!(worst[2] > 1e-3, "{name}: centroids do as well");
    }
}

/// Ties are broken as the oracle breaks them.
#[test]
fn equal_keys_give_one_picture() {
    let oracle = Oracle::new(Arc::new(without(delaunay(3), |p| (p - 0.5).length() < 0.35)));
    for camera in cameras() {
        let depths = centroid_depth(oracle_mesh(&oracle), &camera);
        let keys: Vec<f64> = depths.iter().map(|depth| (4.0 * depth).round()).collect();
        let transfer = layers();
        let frame =
            Frame { camera: &camera, transfer: &transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.0; 4] };
        let picture = |keys: &[f64]| oracle.render_in_order(&frame, keys).expect("a picture");
        let ranked = |order: &VisibilityOrder| order.ranks().iter().map(|&r| -f64::from(r)).collect::<Vec<_>>();
        let order = VisibilityOrder::by_keys(&keys);
        assert_eq!(picture(&keys).pixels, picture(&ranked(&order)).pixels);
        // The other rule is seen.
        let mut cells: Vec<u32> = (0..keys.len() as u32).collect();
        cells.sort_by(|&a, &b| keys[b as usize].total_cmp(&keys[a as usize]).then(b.cmp(&a)));
        let other = VisibilityOrder::new(cells).expect("a permutation");
        assert_ne!(picture(&keys).pixels, picture(&ranked(&other)).pixels);
    }
}

fn oracle_mesh(oracle: &Oracle) -> &TetMesh {
    oracle.mesh()
}
