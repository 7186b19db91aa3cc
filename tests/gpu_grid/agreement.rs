//! Pictures of the implied tetrahedra are those of the explicit ones, composed in exact order.

use std::sync::Arc;

use glam::DVec3;
use tetralux::gpu::RayCaster;
use tetralux::image::Comparison;
use tetralux::mesh::Mesh;
use tetralux::renderer::{Frame, OrderMethod, Renderer, Settings};
use tetralux::scene::{Camera, EmissionModel, Optics, Projection, TransferFunction};
use tetralux::tet::{Domain as _, Grid, TetMesh, VoxelBox};

use crate::grids::{
    MOST, PERSPECTIVE, STRUCTURED, assert_agree, bivariate, both, camera, caster, draw, explicit, explicit_rays,
    lattice, octants, placed, renderer, univariate, waves,
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
        let [nx, ny, _] = grid.points;
        let place = |i: usize| {
            let [x, y, z] = [i % nx, i / nx % ny, i / nx / ny];
            DVec3::new(grid.places[0][x], grid.places[1][y], grid.places[2][z])
        };
        assert!(mesh.vertices.iter().enumerate().all(|(i, &v)| v == place(i)), "{voxels:?}");
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

/// What both draw alike.
#[derive(Clone, Copy, PartialEq)]
enum Share {
    /// Projected cells, of the same places.
    All,
    /// But those that the near plane may cut.
    Far,
    /// In axes of their own, where places are rounded in another way. Measured: 2.1e-5; 1.7e-4 in a pixel on an edge (H100).
    Turned,
}

fn agrees(what: &str, voxels: [usize; 3], spacing: DVec3, share: Share, cameras: impl Fn(&Grid) -> Vec<Camera>) {
    agrees_of(what, &lattice(voxels, DVec3::new(0.4, -1.0, 0.2), spacing, waves), share, cameras);
}

fn agrees_of(what: &str, mesh: &Mesh, share: Share, cameras: impl Fn(&Grid) -> Vec<Camera>) {
    let (grid, mesh) = both(mesh);
    let functions: [(&str, TransferFunction); 2] = [("1D", univariate(&grid)), ("2D", bivariate(&grid))];
    let (mut implied, mut held) = (renderer(&grid, STRUCTURED), explicit(&mesh));
    let (mut rays, mut held_rays) = (caster(&grid, STRUCTURED), explicit_rays(&mesh));
    for (name, transfer) in &functions {
        for (i, camera) in cameras(&grid).iter().enumerate() {
            let what = format!("{what}, {name}, camera {i}");
            let (got, want) = (draw(&mut implied, camera, transfer, SIZE), draw(&mut held, camera, transfer, SIZE));
            match share {
                Share::Turned => assert_agree(&got.image, &want.image, 2e-4, &what),
                Share::All => assert_agree(&got.image, &want.image, MOST, &what),
                // Rays draw the rest, and pass no rasteriser's grid, by which thin cells' edges move.
                Share::Far => {
                    let c = Comparison::new(&got.image, &want.image).expect("equal sizes");
                    assert!(c.psnr >= 85.0 && c.percentile_99_9 <= 5e-4, "{what}: {c}");
                }
            }
            let (got, want) = (draw(&mut rays, camera, transfer, SIZE), draw(&mut held_rays, camera, transfer, SIZE));
            let most = if share == Share::Turned { 5e-5 } else { MOST };
            assert_agree(&got.image, &want.image, most, &format!("{what}, rays"));
        }
    }
}

#[test]
fn pictures_agree_from_all_octants() {
    agrees("odd", [9, 7, 5], DVec3::new(0.3, 0.35, 0.5), Share::All, |grid| octants(grid, PERSPECTIVE));
    agrees("of one voxel", [1, 1, 1], DVec3::new(2.0, 1.0, 1.5), Share::All, |grid| {
        octants(grid, PERSPECTIVE)[..2].to_vec()
    });
}

#[test]
fn pictures_agree_in_parallel_projection() {
    let (voxels, spacing) = ([8, 10, 4], DVec3::new(0.3, 0.25, 0.6));
    let flat = Projection::Orthographic { height: 5.0 };
    agrees("even", voxels, spacing, Share::All, |grid| {
        let mut cameras = octants(grid, flat);
        // Straight along an axis.
        let center = grid.bounds_in_data().center();
        cameras.push(camera(center + DVec3::X * 9.0, center, flat));
        cameras
    });
    // The near plane cuts through all of it.
    agrees("cut", voxels, spacing, Share::Far, |grid| {
        let center = grid.bounds_in_data().center();
        vec![camera(center, center + DVec3::new(0.3, 1.0, 0.2), flat)]
    });
}

/// Samples that take few values are held in 8 or 16 bits, gradients in 32.
#[test]
fn pictures_of_few_values_agree() {
    for (steps, bytes) in [(40.0, 1), (200.0, 2), (f64::INFINITY, 4)] {
        let value = |p: DVec3| if steps < f64::INFINITY { (steps * waves(p)).round() / 7.0 } else { waves(p) };
        let mesh = lattice([15, 14, 17], DVec3::new(0.4, -1.0, 0.2), DVec3::splat(0.2), value);
        agrees_of(&format!("{bytes} B"), &mesh, Share::All, |grid| octants(grid, PERSPECTIVE)[..2].to_vec());
        let (grid, _) = both(&mesh);
        for (transfer, bytes) in [(univariate(&grid), bytes), (bivariate(&grid), bytes + 4)] {
            let camera = octants(&grid, PERSPECTIVE)[0];
            let stats = draw(&mut caster(&grid, STRUCTURED), &camera, &transfer, SIZE).stats;
            let sum = |of: &[&str]| -> u64 {
                stats.buffers.iter().filter(|b| of.contains(&b.name.as_str())).map(|b| b.bytes).sum()
            };
            let held = sum(&["samples", "gradients"]).div_ceil(16) as usize;
            // Of what is not needed, 16 bytes.
            let most = (grid.scalar.len() * bytes).div_ceil(16) + 2;
            assert!(held <= most && held + 4 > most, "{held} of {most}");
        }
    }
}

/// Planes at uneven distances, along one axis falling.
#[test]
fn pictures_of_uneven_grids_agree() {
    let place = |at: DVec3| DVec3::new(0.1 * at.x * at.x, 2.0 - 0.3 * at.y, 0.02 * (1.45_f64.powf(at.z) - 1.0));
    let mesh = placed([7, 6, 9], place, waves);
    agrees_of("uneven", &mesh, Share::All, |grid| octants(grid, PERSPECTIVE)[2..6].to_vec());
    // Where voxels are small, and before where they are large.
    agrees_of("uneven, within", &mesh, Share::Far, |grid| {
        let bounds = grid.bounds_in_data();
        let at = |x: f64, y: f64, z: f64| bounds.min + (bounds.max - bounds.min) * DVec3::new(x, y, z);
        vec![
            camera(at(0.03, 0.4, 0.02), at(0.9, 0.6, 0.9), PERSPECTIVE),
            camera(at(1.02, 0.4, 0.9), at(0.1, 0.6, 0.3), PERSPECTIVE),
        ]
    });
}

#[test]
fn pictures_agree_from_within_and_nearby() {
    agrees("turned axes", [18, 9, 11], DVec3::new(0.2, -0.3, 0.25), Share::Far, |grid| {
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
    let (grid, mesh) = both(&whole);
    let transfer = univariate(&grid);
    // Even and odd: the voxels' parity is that of the whole.
    let part = VoxelBox { low: [1, 4, 2], high: [9, 9, 7] };
    let corner = |at: [usize; 3]| spacing * DVec3::from_array(at.map(|n| n as f64));
    let inside = DVec3::splat(0.01);
    let bounds = tetralux::space::Bounds { min: corner(part.low) + inside, max: corner(part.high) - inside };
    let mut clipped = renderer(&grid, STRUCTURED).clipped_to(&bounds).unwrap_or_else(|e| panic!("{e}"));
    let mut rays = caster(&grid, STRUCTURED).clipped_to(&bounds).unwrap_or_else(|e| panic!("{e}"));
    let is_in = |tet: usize| {
        let at = [tet / 5 % voxels[0], tet / 5 / voxels[0] % voxels[1], tet / 5 / voxels[0] / voxels[1]];
        (0..3).all(|axis| (part.low[axis]..part.high[axis]).contains(&at[axis]))
    };
    let kept: Vec<[u32; 4]> = mesh.tets.iter().enumerate().filter(|(i, _)| is_in(*i)).map(|(_, &tet)| tet).collect();
    assert_eq!(kept.len(), 5 * part.count());
    let kept = Arc::new(TetMesh { tets: Arc::new(kept), ..(*mesh).clone() });
    let (mut held, mut held_rays) = (explicit(&kept), explicit_rays(&kept));
    for camera in &octants(&grid, PERSPECTIVE)[3..5] {
        let (got, want) = (draw(&mut clipped, camera, &transfer, SIZE), draw(&mut held, camera, &transfer, SIZE));
        assert_agree(&got.image, &want.image, MOST, "clipped");
        let (got, want) = (draw(&mut rays, camera, &transfer, SIZE), draw(&mut held_rays, camera, &transfer, SIZE));
        assert_agree(&got.image, &want.image, MOST, "clipped, rays");
    }
    let nothing = tetralux::space::Bounds { min: DVec3::splat(50.0), max: DVec3::splat(60.0) };
    assert!(renderer(&grid, STRUCTURED).clipped_to(&nothing).is_err());
}

#[test]
fn integrals_are_those_of_meshes() {
    let (grid, mesh) = both(&lattice([5, 5, 5], DVec3::ZERO, DVec3::splat(0.4), waves));
    let camera = octants(&grid, PERSPECTIVE)[6];
    let (curve, widgets) = (univariate(&grid), bivariate(&grid));
    let weighted = EmissionModel::Weighted;
    for (integral, transfer, emission) in [
        ("partial-direct", &curve, weighted),
        ("mean-scalar", &curve, weighted),
        ("preintegrated", &curve, weighted),
        ("segmented:4", &widgets, weighted),
        ("analytic", &widgets, weighted),
        ("partial", &curve, EmissionModel::Unweighted),
    ] {
        let settings = Settings { integral: integral.parse().expect("an integral"), ..STRUCTURED };
        let optics = Optics { emission, ..Optics::PLAIN };
        let frame = Frame { camera: &camera, transfer, optics: &optics, size: SIZE, background: [0.1, 0.2, 0.3, 1.0] };
        let drawn =
            |renderer: &mut dyn Renderer| renderer.render(&frame, false).unwrap_or_else(|e| panic!("{e}")).image;
        let got = drawn(&mut renderer(&grid, settings));
        let mut held = crate::common::gpu::renderer(&mesh, Settings { order: OrderMethod::PerPixel, ..settings });
        let what = format!("{integral}, {emission:?}");
        assert_agree(&got, &drawn(&mut held), MOST, &what);
        let mut held = RayCaster::new(crate::common::gpu::device(), mesh.clone(), settings).expect("a caster");
        assert_agree(&drawn(&mut caster(&grid, settings)), &drawn(&mut held), MOST, &format!("{what}, rays"));
    }
}

/// The comparison sees what it has to: of one sample changed by a hundredth of the range, the picture is another.
#[test]
fn another_sample_is_another_picture() {
    let mesh = lattice([5, 5, 5], DVec3::ZERO, DVec3::splat(0.4), waves);
    let mut other = mesh.clone();
    // In the middle.
    other.arrays[0].values[3 + 6 * (3 + 6 * 3)] += 0.03;
    let [(grid, _), (changed, _)] = [both(&mesh), both(&other)];
    let transfer = univariate(&grid);
    let camera = octants(&grid, PERSPECTIVE)[6];
    let [a, b] = [&grid, &changed].map(|grid| draw(&mut caster(grid, STRUCTURED), &camera, &transfer, SIZE).image);
    let c = Comparison::new(&a, &b).expect("equal sizes");
    assert!(c.max > 10.0 * MOST, "{c}");
}

/// What takes long goes on in the next dispatch.
#[test]
fn rays_go_on_where_they_were_left() {
    let (grid, _) = both(&lattice([20, 9, 17], DVec3::ZERO, DVec3::splat(0.4), waves));
    for transfer in [univariate(&grid), bivariate(&grid)] {
        for camera in &octants(&grid, PERSPECTIVE)[5..7] {
            let whole = draw(&mut caster(&grid, STRUCTURED), camera, &transfer, SIZE).image;
            for turns in [2, 25] {
                let mut left = caster(&grid, STRUCTURED).leaving_rays_after(turns);
                let what = format!("left after {turns} turns");
                crate::common::gpu::assert_same_bits(&draw(&mut left, camera, &transfer, SIZE).image, &whole, &what);
            }
        }
    }
}

/// Mesh space is turned with the grid; a third of the axes runs against its rotation.
#[test]
fn pictures_of_turned_grids_agree() {
    let turn = glam::DMat3::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 2.3);
    let place = |at: DVec3| DVec3::new(3.0, -1.0, 7.0) + turn * (DVec3::new(0.3, 0.4, -0.35) * at);
    let mesh = placed([8, 7, 9], place, waves);
    let (grid, explicit) = both(&mesh);
    let (a, b) = (grid.bounds_in_data(), explicit.bounds_in_data());
    assert!((a.min - b.min).abs().max_element() < 1e-12 && (a.max - b.max).abs().max_element() < 1e-12);
    let apart = |(a, b): (&f64, &f64)| (a - b).abs() / explicit.gradient_range().max;
    let worst = grid.gradient_magnitude.iter().zip(&explicit.gradient_magnitude).map(apart).fold(0.0, f64::max);
    assert!(worst < 1e-12, "{worst}");
    agrees_of("turned", &mesh, Share::Turned, |grid| octants(grid, PERSPECTIVE)[1..5].to_vec());
    agrees_of("turned, flat", &mesh, Share::Turned, |grid| {
        octants(grid, Projection::Orthographic { height: 5.0 })[6..].to_vec()
    });
    agrees_of("turned, within", &mesh, Share::Turned, |grid| {
        let center = grid.bounds_in_data().center();
        vec![camera(center + DVec3::new(0.2, 0.1, -0.3), center + DVec3::new(1.0, 0.7, 0.4), PERSPECTIVE)]
    });
}
