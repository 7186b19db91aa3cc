//! Real volumes: the implied tetrahedra against the explicit ones.

use std::sync::Arc;

use tetralux::image::Comparison;
use tetralux::mesh::ReadOptions;
use tetralux::scene::{Camera, Projection};
use tetralux::tet::Domain as _;

use crate::common::folder;
use crate::common::rainbow::rainbow;
use crate::grids::{STRUCTURED, bivariate, both, draw, explicit, renderer};

/// `TETRALUX_DATA`: the folder that holds `structured/fuel.vti`.
#[test]
#[ignore = "reads real data"]
fn volumes_agree() {
    for name in ["fuel", "neghip"] {
        let path = folder("TETRALUX_DATA").join(format!("structured/{name}.vti"));
        let (grid, mesh) =
            both(&tetralux::mesh::read(&path, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}")));
        let bounds = grid.bounds_in_data();
        let projection = Projection::Perspective { fov_y: 0.5 };
        let around = Camera::fit(&bounds, 1.0, [0.6, 0.4], 1.0, projection);
        let within = Camera { eye: bounds.center() - 0.2 * (bounds.max - bounds.min), ..around };
        let (mut implied, mut held) = (renderer(&grid, STRUCTURED), explicit(&Arc::clone(&mesh)));
        for (function, transfer) in [("1D", rainbow(&mesh, 6, 3.0)), ("2D", bivariate(&grid))] {
            for (view, camera) in [("around", &around), ("within", &within)] {
                let got = draw(&mut implied, camera, &transfer, [256, 256]);
                let want = draw(&mut held, camera, &transfer, [256, 256]);
                let c = Comparison::new(&got.image, &want.image).expect("equal sizes");
                println!("{name}, {function}, {view}: {:.1} dB, worst {:.1e}", c.psnr, c.max);
                assert!(c.psnr > 100.0, "{name}, {function}, {view}: {c}");
            }
        }
    }
}
