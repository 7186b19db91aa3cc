//! Real volumes: the implied tetrahedra against the explicit ones.

use tetralux::image::Comparison;
use tetralux::mesh::ReadOptions;
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, OrderMethod, Renderer, Settings};
use tetralux::scene::{Camera, Optics, Projection};
use tetralux::tet::Domain as _;

use crate::common::folder;
use crate::common::rainbow::rainbow;
use crate::grids::{MOST, STRUCTURED, bivariate, both, caster, draw, explicit, explicit_rays, renderer};

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
        let (mut implied, mut held) = (renderer(&grid, STRUCTURED), explicit(&mesh));
        // Its cells are drawn by bands, as the implied ones are.
        let exact = Settings { order: OrderMethod::Exact, ..STRUCTURED };
        let mut in_order = crate::common::gpu::renderer(&mesh, exact);
        let (mut rays, mut held_rays) = (caster(&grid, STRUCTURED), explicit_rays(&mesh));
        for (function, transfer) in [("1D", rainbow(&mesh, 6, 3.0)), ("2D", bivariate(&grid))] {
            for (view, camera) in [("around", &around), ("within", &within)] {
                let drawn = |renderer: &mut dyn Renderer| draw(renderer, camera, &transfer, [256, 256]).image;
                // Measured: 3.5e-6; none, or 1.5e-6 from within; 9.5e-6, in thin bands.
                let pairs = [
                    ("lists", drawn(&mut implied), drawn(&mut held), MOST),
                    ("an exact order", drawn(&mut implied), drawn(&mut in_order), MOST),
                    ("rays", drawn(&mut rays), drawn(&mut held_rays), MOST),
                ];
                for (what, got, want, most) in &pairs {
                    let c = Comparison::new(got, want).expect("equal sizes");
                    println!("{name}, {function}, {view}, {what}: {:.1} dB, worst {:.1e}", c.psnr, c.max);
                    assert!(c.max <= *most, "{name}, {function}, {view}, {what}: {c}");
                }
                // In thin bands, rays through either are up to 1.2e-5 from the truth. Of several colours the integral's
                // tolerance is the most of either.
                let frame = Frame {
                    camera,
                    transfer: &transfer,
                    optics: &Optics::PLAIN,
                    size: [256, 256],
                    background: [0.1, 0.2, 0.3, 1.0],
                };
                let truth = Oracle::new(mesh.clone()).image(&frame).expect("the truth");
                for (what, got) in [("the grid", &pairs[2].1), ("its mesh", &pairs[2].2)] {
                    let c = Comparison::new(got, &truth).expect("equal sizes");
                    println!("{name}, {function}, {view}, rays through {what}: {:.1} dB, worst {:.1e}", c.psnr, c.max);
                    assert!(c.psnr >= 90.0, "{name}, {function}, {view}, rays through {what}: {c}");
                }
            }
        }
    }
}
