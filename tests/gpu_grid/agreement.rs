//! Pictures of the implied tetrahedra are those of the explicit ones, composed in exact order.

use glam::DVec3;
use tetralux::renderer::Settings;
use tetralux::scene::{Camera, Projection, TransferFunction};
use tetralux::tet::{Domain as _, Grid};

use crate::grids::{
    PERSPECTIVE, STRUCTURED, assert_agree, bivariate, both, camera, caster, draw, explicit, explicit_rays, lattice,
    octants, renderer, univariate, waves,
};

const SIZE: [u32; 2] = [56, 48];

/// Values, ranges and gradients, before anything is drawn.
#[test]
fn grids_hold_what_meshes_do() {
    for (voxels, spacing) in
        [([1, 1, 1], DVec3::ONE), ([2, 3, 1], DVec3::new(0.1, 20.0, 3.0)), ([9, 8, 5], DVec3::new(-0.3, 0.2, 0.45))]
    {
        let (grid, mesh) = both(&lattice(voxels, DVec3::new(5.0, -2.0, 1.0), spacing, waves));
        assert_eq!(grid.tet_count(), mesh.tets.len() as u64);
        assert_eq!(grid.scalar, mesh.scalar);
        assert_eq!((grid.center_in_data, grid.data_per_mesh), (mesh.center_in_data, mesh.data_per_mesh));
        let part = grid.tets_of(&grid.all());
        assert_eq!((&part.vertices, &part.tets), (&mesh.vertices, &mesh.tets), "{voxels:?}");
        let most = mesh.gradient_range().max;
        let error = |(a, b): (&f64, &f64)| (a - b).abs() / most;
        let pairs = || grid.gradient_magnitude.iter().zip(&mesh.gradient_magnitude);
        let worst = pairs().map(error).fold(0.0, f64::max);
        assert!(worst < 1e-12, "{voxels:?}: {worst}");
        // They do differ from sample to sample.
        assert!(pairs().any(|(a, _)| (a - grid.gradient_magnitude[0]).abs() > 1e-3 * most));
        let bins = [16, 16];
        let (a, b) = (grid.histogram(bins), mesh.histogram(bins));
        let apart: f64 = a.counts.iter().zip(&b.counts).map(|(x, y)| (x - y).abs()).sum();
        assert!(apart < 1e-2 * b.total(), "{voxels:?}: {apart} of {}", b.total());
    }
}

fn agrees(what: &str, voxels: [usize; 3], spacing: DVec3, cameras: impl Fn(&Grid) -> Vec<Camera>) {
    let (grid, mesh) = both(&lattice(voxels, DVec3::new(0.4, -1.0, 0.2), spacing, waves));
    let functions: [(&str, TransferFunction); 2] = [("1D", univariate(&grid)), ("2D", bivariate(&grid))];
    let (mut implied, mut held) = (renderer(&grid, STRUCTURED), explicit(&mesh));
    let (mut rays, mut held_rays) = (caster(&grid, STRUCTURED), explicit_rays(&mesh));
    for (name, transfer) in &functions {
        for (i, camera) in cameras(&grid).iter().enumerate() {
            let what = format!("{what}, {name}, camera {i}");
            let (got, want) = (draw(&mut implied, camera, transfer, SIZE), draw(&mut held, camera, transfer, SIZE));
            assert_agree(&got.image, &want.image, &what);
            let (got, want) = (draw(&mut rays, camera, transfer, SIZE), draw(&mut held_rays, camera, transfer, SIZE));
            assert_agree(&got.image, &want.image, &format!("{what}, rays"));
        }
    }
}

#[test]
fn pictures_agree_from_all_octants() {
    agrees("odd", [9, 7, 5], DVec3::new(0.3, 0.35, 0.5), |grid| octants(grid, PERSPECTIVE));
    agrees("of one voxel", [1, 1, 1], DVec3::new(2.0, 1.0, 1.5), |grid| octants(grid, PERSPECTIVE)[..2].to_vec());
}

#[test]
fn pictures_agree_in_parallel_projection() {
    let height = 5.0;
    agrees("even", [8, 10, 4], DVec3::new(0.3, 0.25, 0.6), |grid| {
        let mut cameras = octants(grid, Projection::Orthographic { height });
        // Straight along an axis, and through all of the mesh's near plane.
        let center = grid.bounds_in_data().center();
        cameras.push(camera(center + DVec3::X * 9.0, center, Projection::Orthographic { height }));
        cameras.push(camera(center, center + DVec3::new(0.3, 1.0, 0.2), Projection::Orthographic { height }));
        cameras
    });
}

#[test]
fn pictures_agree_from_within_and_nearby() {
    agrees("turned axes", [18, 9, 11], DVec3::new(0.2, -0.3, 0.25), |grid| {
        let bounds = grid.bounds_in_data();
        let at = |x: f64, y: f64, z: f64| bounds.min + (bounds.max - bounds.min) * DVec3::new(x, y, z);
        let mut cameras = vec![
            camera(at(0.52, 0.47, 0.31), at(0.1, 0.8, 0.9), Projection::Perspective { fov_y: 1.2 }),
            // On a sample, along an axis.
            camera(bounds.min + DVec3::new(1.0, 0.6, 0.5), at(0.95, 0.45, 0.5), PERSPECTIVE),
            // Before a side, nearer than a voxel.
            camera(at(-0.01, 0.4, 0.6), at(1.0, 0.5, 0.4), PERSPECTIVE),
        ];
        // A near plane that cuts through the grid.
        cameras.push(Camera { near: Some(2.0), ..camera(at(-0.3, 0.4, 0.6), at(1.0, 0.5, 0.4), PERSPECTIVE) });
        cameras
    });
}

#[test]
fn a_clipped_grid_is_the_grid_of_its_voxels() {
    let (voxels, spacing) = ([12, 10, 9], DVec3::new(0.3, 0.25, 0.35));
    let whole = lattice(voxels, DVec3::ZERO, spacing, waves);
    let (grid, _) = both(&whole);
    let transfer = univariate(&grid);
    // Even steps keep the parity.
    let part = tetralux::tet::VoxelBox { low: [2, 4, 2], high: [9, 9, 7] };
    let corner = |at: [usize; 3]| spacing * DVec3::from_array(at.map(|n| n as f64));
    let inside = DVec3::splat(0.01);
    let bounds = tetralux::space::Bounds { min: corner(part.low) + inside, max: corner(part.high) - inside };
    let mut clipped = renderer(&grid, STRUCTURED).clipped_to(&bounds).unwrap_or_else(|e| panic!("{e}"));
    let mut alone = explicit(&std::sync::Arc::new(grid.tets_of(&part)));
    for camera in &octants(&grid, PERSPECTIVE)[3..5] {
        let (got, want) = (draw(&mut clipped, camera, &transfer, SIZE), draw(&mut alone, camera, &transfer, SIZE));
        assert_agree(&got.image, &want.image, "clipped");
    }
    let nothing = tetralux::space::Bounds { min: DVec3::splat(50.0), max: DVec3::splat(60.0) };
    assert!(renderer(&grid, STRUCTURED).clipped_to(&nothing).is_err());
}

#[test]
fn integrals_are_those_of_meshes() {
    let (grid, mesh) = both(&lattice([5, 5, 5], DVec3::ZERO, DVec3::splat(0.4), waves));
    let transfer = univariate(&grid);
    let camera = octants(&grid, PERSPECTIVE)[6];
    for integral in ["partial-direct", "mean-scalar", "segmented:4"] {
        let integral = integral.parse().expect("an integral");
        let settings = Settings { integral, ..STRUCTURED };
        let got = draw(&mut renderer(&grid, settings), &camera, &transfer, SIZE);
        let order = tetralux::renderer::OrderMethod::PerPixel;
        let mut held = crate::common::gpu::renderer(&mesh, Settings { order, ..settings });
        assert_agree(&got.image, &draw(&mut held, &camera, &transfer, SIZE).image, &format!("{integral}"));
    }
}
