//! Orders: right for any mesh of five a voxel, and drawn as the host says.

use glam::DVec3;
use tetralux::plan::order::{Inversions, VisibilityOrder, sample_cameras};
use tetralux::plan::voxels;
use tetralux::renderer::Settings;
use tetralux::scene::{Camera, Projection};
use tetralux::tet::{Adjacency, Domain as _};

use crate::common::rainbow::rainbow;
use crate::grids::{PERSPECTIVE, STRUCTURED, bivariate, both, camera, draw, lattice, octants, renderer, waves};

#[test]
fn no_neighbours_are_in_the_wrong_order() {
    for (voxels, spacing) in [([11, 4, 9], DVec3::new(0.2, 0.7, 0.3)), ([8, 17, 3], DVec3::new(-0.2, 0.3, -0.9))] {
        let (grid, mesh) = both(&lattice(voxels, DVec3::ZERO, spacing, waves));
        let adjacency = Adjacency::new(&mesh);
        let count = |order: &dyn Fn(&Camera) -> VisibilityOrder| {
            let cameras = sample_cameras(&mesh, 30);
            let sum = cameras.iter().map(|c| order(c).inversions(&mesh, &adjacency, c));
            sum.fold(Inversions::default(), |sum, one| sum + one)
        };
        let found = count(&|camera| voxels::order(&grid, camera));
        assert!(found.pairs > 30 * mesh.tets.len() as u64, "{found:?}");
        assert_eq!(found.wrong, 0, "{found:?}");
        // Planted: one voxel's neighbours exchanged in each; all of it reversed.
        let exchanged = count(&|camera| {
            let mut cells = voxels::order(&grid, camera).cells().to_vec();
            let middle = cells.len() / 2;
            cells[middle - 4..middle + 4].reverse();
            VisibilityOrder::new(cells).expect("a permutation")
        });
        assert!(exchanged.wrong >= 30, "{exchanged:?}");
        let reversed = count(&|camera| {
            let cells = voxels::order(&grid, camera).cells().iter().rev().copied().collect();
            VisibilityOrder::new(cells).expect("a permutation")
        });
        assert_eq!(reversed.wrong, reversed.pairs);
    }
}

/// The first tetrahedron of `drawn` that comes too early, by the host's order.
fn out_of_order(drawn: &[u32], order: &VisibilityOrder) -> Option<u32> {
    let ranks = order.ranks();
    drawn.windows(2).find(|pair| ranks[pair[0] as usize] >= ranks[pair[1] as usize]).map(|pair| pair[1])
}

#[test]
fn cells_are_drawn_as_the_host_orders_them() {
    let (grid, mesh) = both(&lattice([17, 9, 10], DVec3::ZERO, DVec3::new(0.2, -0.3, 0.4), waves));
    let mut renderer = renderer(&grid, Settings { cull: false, ..STRUCTURED });
    let mut cameras = octants(&grid, PERSPECTIVE);
    cameras.extend(octants(&grid, Projection::Orthographic { height: 4.0 }));
    let mut views: Vec<(Camera, usize)> = cameras.iter().step_by(3).map(|&c| (c, mesh.tets.len() * 3 / 4)).collect();
    // Within, and on a plane of samples: voxels lie on both sides.
    let (bounds, wide) = (grid.bounds_in_data(), Projection::Perspective { fov_y: 1.9 });
    for at in [DVec3::new(1.53, -1.31, 1.7), DVec3::new(1.6, -1.31, 1.7)] {
        views.push((camera(bounds.min + at * DVec3::new(1.0, -1.0, 1.0), bounds.center(), wide), mesh.tets.len() / 20));
    }
    for transfer in [rainbow(&mesh, 5, 3.0), bivariate(&grid)] {
        for (camera, least) in &views {
            draw(&mut renderer, camera, &transfer, [160, 160]);
            let drawn = renderer.order().expect("an order");
            assert!(drawn.len() > *least, "{} of {}", drawn.len(), mesh.tets.len());
            let order = voxels::order(&grid, camera);
            assert_eq!(out_of_order(&drawn, &order), None);
            let mut planted = drawn.clone();
            planted.swap(drawn.len() / 2, drawn.len() / 2 + 1);
            assert!(out_of_order(&planted, &order).is_some(), "an exchange went unseen");
        }
    }
}
