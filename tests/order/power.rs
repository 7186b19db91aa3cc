//! Regular meshes and the power order.

use glam::{DMat3, DVec3};
use tetralux::plan::order::{
    PowerCensus, PowerOrder, Proof, Vantage, VisibilityOrder, centroid_depth, sampled_inversions,
};
use tetralux::scene::Camera;
use tetralux::tet::{Adjacency, TetId, TetMesh};

use crate::common::boxes::{box_mesh, tet_mesh};
use crate::common::delaunay;
use crate::common::random::Random;
use crate::support::{count, delaunay as small_delaunay, fields, mapped, moved};

fn power(mesh: &TetMesh) -> (PowerCensus, PowerOrder) {
    let census = PowerCensus::new(mesh, &Adjacency::new(mesh));
    let order = PowerOrder::new(mesh, &census.metric);
    (census, order)
}

/// As a shader does it.
fn order_f32(rows: &[[f32; 4]], mesh: &TetMesh, camera: &Camera) -> VisibilityOrder {
    let [x, y, z, w] = Vantage::new(mesh, camera).homogeneous().map(|v| v as f32);
    let keys: Vec<f64> = rows.iter().map(|r| f64::from(r[0] * x + r[1] * y + r[2] * z + r[3] * w)).collect();
    VisibilityOrder::by_keys(&keys)
}

/// Squared distance to the circumsphere's centre less its squared radius, from scratch.
fn order_by_spheres(mesh: &TetMesh, camera: &Camera) -> VisibilityOrder {
    let eye = mesh.mesh_from_data(camera.eye);
    let power = |t: u32| {
        let [a, b, c, d] = mesh.corners(TetId(t));
        let (u, v, w) = (b - a, c - a, d - a);
        let rows = DMat3::from_cols(u, v, w).transpose();
        let center = a + rows.inverse() * (0.5 * DVec3::new(u.dot(u), v.dot(v), w.dot(w)));
        eye.distance_squared(center) - a.distance_squared(center)
    };
    VisibilityOrder::by_keys(&(0..mesh.tets.len() as u32).map(power).collect::<Vec<f64>>())
}

#[test]
fn delaunay_meshes_are_in_order_for_every_eye() {
    for seed in 0..4 {
        let mesh = small_delaunay(seed);
        let (census, power) = power(&mesh);
        assert!(census.is_exact() && census.metric.is_identity(), "{}", census);
        assert_eq!(count(&mesh, 60, |camera| power.order(&mesh, camera)).wrong, 0);
        let rows = power.rows_f32();
        let rounded = count(&mesh, 60, |camera| order_f32(&rows, &mesh, camera));
        assert!(rounded.share() <= 1e-5, "{rounded:?}");
        let centroids = count(&mesh, 6, |camera| VisibilityOrder::by_keys(&centroid_depth(&mesh, camera)));
        assert!(centroids.share() > 0.1, "{centroids:?}");
    }
}

#[test]
fn images_of_delaunay_meshes_are_in_order_by_their_own_metric() {
    let mut random = Random(5);
    for seed in 0..4 {
        let flat = DMat3::from_diagonal(DVec3::new(1.0, 3.0, 0.05));
        let shear = DMat3::from_cols(DVec3::X, random.in_cube() - 0.5 + DVec3::Y, random.in_cube() - 0.5 + DVec3::Z);
        let turn = DMat3::from_axis_angle(random.direction(), random.within(0.0, 3.0));
        let mesh = mapped(&small_delaunay(seed), |p| turn * shear * flat * p + DVec3::new(1e3, -50.0, 7.0));
        let (census, power) = power(&mesh);
        assert!(census.is_exact() && !census.metric.is_identity(), "{}", census);
        assert_eq!(count(&mesh, 60, |camera| power.order(&mesh, camera)).wrong, 0);
        let rows = power.rows_f32();
        let rounded = count(&mesh, 60, |camera| order_f32(&rows, &mesh, camera));
        assert!(rounded.share() <= 1e-5, "{rounded:?}");
        // Spheres of this space do not serve.
        let spheres = count(&mesh, 6, |camera| order_by_spheres(&mesh, camera));
        assert!(spheres.share() > 0.05, "{spheres:?}");
    }
}

/// More faces than a metric is first made of: it is made to fit the others too, and comes out as it went in.
#[test]
fn metrics_fit_faces_beyond_the_sample() {
    for (stretch, seed) in [(DVec3::new(1.0, 1.0, 0.125), 77), (DVec3::new(0.2, 1.0, 0.5), 78)] {
        let mesh = mapped(&delaunay::cube(3000, 60, 10, seed, fields), |p| p * stretch);
        let (census, power) = power(&mesh);
        assert!(mesh.tets.len() > 20_000 && census.is_exact(), "{}", census);
        let want = DMat3::from_diagonal(1.0 / (stretch * stretch));
        let want = want * (3.0 / (want.x_axis.x + want.y_axis.y + want.z_axis.z));
        let error = (census.metric.matrix - want).to_cols_array().into_iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        assert!(error < 1e-2, "{error:e}");
        assert_eq!(count(&mesh, 15, |camera| power.order(&mesh, camera)).wrong, 0);
    }
}

/// All corners of a cube are on one sphere: its six cells have one key, which is wrong for many of them. There are
/// metrics that tell them apart.
#[test]
fn lattices_have_no_ties_by_a_metric_that_is_found() {
    for n in [1, 2, 6] {
        let mesh = box_mesh(n, DVec3::new(-0.1, 0.2, 0.3), DVec3::new(0.2, 0.5, 0.6), fields);
        let (census, power) = power(&mesh);
        assert!(census.is_exact() && !census.metric.is_identity(), "{}", census);
        let (rows, found) = (power.rows_f32(), census.metric);
        assert_eq!(count(&mesh, 60, |camera| power.order(&mesh, camera)).wrong, 0, "{found}");
        assert_eq!(count(&mesh, 60, |camera| order_f32(&rows, &mesh, camera)).wrong, 0, "{found}");
        let perspective = |camera: &Camera| order_by_spheres(&mesh, camera);
        let spheres = count(&mesh, 60, perspective);
        assert!(spheres.share() > 0.1, "ties are no order: {spheres:?}");
    }
}

#[test]
fn moved_meshes_are_not_promised_anything() {
    for seed in 0..4 {
        let mesh = moved(&small_delaunay(seed), 0.05, 9);
        let (census, power) = power(&mesh);
        assert!(!census.is_exact() && census.not_convex.count > 100, "{}", census);
        assert!(census.to_string().contains("not exact"), "{}", census);
        let adjacency = Adjacency::new(&mesh);
        let sum = sampled_inversions(&mesh, &adjacency, 12, |camera| power.order(&mesh, camera));
        assert!(sum.share() > 1e-3, "{sum:?}");
    }
}

/// One point, moved so far that few faces are wrong, is found among all of them.
#[test]
fn one_moved_point_is_found() {
    let mesh = small_delaunay(7);
    let middle = mesh.vertices.iter().position(|v| v.length() < 0.1).expect("a point in the middle");
    let mut found = 0;
    for turn in 0..20 {
        let mut random = Random(turn);
        let mut mesh = mesh.clone();
        mesh.vertices[middle] += 0.03 * random.direction();
        let (census, power) = power(&mesh);
        let order = |camera: &Camera| power.order(&mesh, camera);
        let sum = sampled_inversions(&mesh, &Adjacency::new(&mesh), 60, order);
        // Never promised and broken.
        assert!(!census.is_exact() || sum.wrong == 0, "{sum:?} {}", census);
        found += u64::from(!census.is_exact());
    }
    assert!(found > 10, "{found} of 20");
}

/// A cell as flat as 1e-12 of its edges, with a circumsphere as large as that is small, is no worse than others.
#[test]
fn huge_circumspheres_do_not_matter() {
    let mut random = Random(3);
    for height in [1e-3, 1e-6, 1e-9, 1e-12] {
        // d is over the triangle's plane and outside its circle: its sphere with a, b, c lies above, and e below.
        let [a, b, c] = [DVec3::ZERO, DVec3::X, DVec3::new(0.4, 0.9, 0.0)];
        let (d, e) = (DVec3::new(1.1, 1.0, height), DVec3::new(0.5, 0.3, -1.0));
        let turn = DMat3::from_axis_angle(random.direction(), random.within(0.0, 3.0));
        let points = [a, b, c, d, e].map(|p| turn * p);
        let mesh = tet_mesh(&points, vec![[0, 1, 2, 3], [0, 2, 1, 4]], fields);
        let (census, power) = power(&mesh);
        assert_eq!(census.proof(), Proof::Neighbors, "{height:e}: {}", census);
        assert_eq!(count(&mesh, 90, |camera| power.order(&mesh, camera)).wrong, 0, "{height:e}");
        // Of eyes within the flatter one, 32 bits do not tell the side.
        if height > 1e-10 {
            let rows = power.rows_f32();
            assert_eq!(count(&mesh, 90, |camera| order_f32(&rows, &mesh, camera)).wrong, 0, "{height:e}");
        }
    }
}

/// Every eighth cell of so many shares no face with any other: those of which a metric is first made.
#[test]
fn a_metric_is_found_among_cells_that_share_nothing() {
    const LONE: u32 = 131_000;
    let lattice = box_mesh(1, DVec3::ZERO, DVec3::ONE, fields);
    let mut points: Vec<DVec3> = lattice.vertices.iter().map(|&v| lattice.data_from_mesh(v)).collect();
    let joined = lattice.tets.iter().copied();
    let lone = (0..LONE).map(|i| [0, 1, 2, 3].map(|corner| points.len() as u32 + 4 * i + corner));
    let mut tets: Vec<[u32; 4]> = lone.collect();
    tets.splice(1..1, joined);
    for i in 0..LONE {
        let place = 2.0 * DVec3::new(f64::from(1 + i % 50), f64::from(i / 50 % 50), f64::from(i / 2500));
        points.extend([DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z].map(|corner| place + corner));
    }
    let mesh = tet_mesh(&points, tets, fields);
    let (census, _) = power(&mesh);
    assert!(census.interior_faces == 6 && !census.metric.is_identity(), "{census}");
    assert_eq!(census.proof(), Proof::Neighbors, "{census}");
}
