//! How the camera opens.

use super::super::scenery::{Cells, hills, pair, seen};
use super::super::{Case, Setup, Shot};
use super::{SIZE, by_centroids};
use crate::error::Result;
use crate::scene::Projection;

pub const CASES: &[Case] = &[
    Case {
        name: "perspective",
        parameter: "vertical angle, degrees",
        values: &[5.0, 15.0, 45.0, 90.0, 120.0, 150.0, 170.0],
        make: |degrees| through(|_| Projection::Perspective { fov_y: degrees.to_radians() }),
        integrals: &[],
        known: &[by_centroids(50.0, 0.08)],
    },
    Case {
        name: "parallel",
        parameter: "height of the picture / the mesh's diagonal",
        values: &[1e-4, 1e-3, 1e-2, 0.1, 1.0, 3.0],
        make: |height| through(|diagonal| Projection::Orthographic { height: height * diagonal }),
        integrals: &[],
        known: &[by_centroids(56.0, 0.05)],
    },
];

fn through(lens: impl Fn(f64) -> Projection) -> Result<Setup> {
    let mesh = Cells::of_box(4, 0.15, hills).mesh()?;
    let camera = seen(&mesh, lens(mesh.bounds_in_data().diagonal()));
    Ok(Shot { camera, transfer: pair(&mesh, 3.0), size: SIZE, mesh }.into())
}
