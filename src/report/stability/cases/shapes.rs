//! Cells that are hardly cells: slivers, needles, flat ones.

use glam::DVec3;

use super::super::scenery::{Cells, hills, outside, pair, seen};
use super::super::{Case, Setup, Shot, Truth};
use super::{F32_PLACES, SIZE, SNAPPED, by_centroids, degrades};
use crate::error::Result;
use crate::scene::Projection;

const HEIGHTS: &[f64] = &[0.25, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6];

pub const CASES: &[Case] = &[
    Case {
        name: "slivers",
        parameter: "height of a cell / its width",
        values: HEIGHTS,
        make: |h| split([(1.0 - h) / 3.0, (1.0 - h) / 3.0, (1.0 - h) / 3.0, h]),
        integrals: &[],
        known: &[by_centroids(44.0, 0.12)],
    },
    Case {
        name: "wedges",
        parameter: "distance of a cell's edges / their length",
        values: HEIGHTS,
        make: |h| split([0.5 * (1.0 - h), 0.5 * (1.0 - h), 0.5 * h, 0.5 * h]),
        integrals: &[],
        known: &[by_centroids(44.0, 0.12)],
    },
    Case {
        name: "needles",
        parameter: "width of a cell / its length",
        values: HEIGHTS,
        make: |h| split([1.0 - h, h / 3.0, h / 3.0, h / 3.0]),
        integrals: &[],
        known: &[by_centroids(44.0, 0.12)],
    },
    Case {
        name: "flat-mesh",
        parameter: "height of the mesh / its width",
        values: &[1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6],
        make: flat_mesh,
        integrals: &[],
        known: &[
            by_centroids(31.0, 0.3),
            degrades(&["cpu", "rays"], [1e-5, 1e-5], 69.0, 5e-3, F32_PLACES),
            degrades(&["cpu", "rays"], [1e-6, 1e-6], 50.0, 0.06, F32_PLACES),
            degrades(&["project"], [1e-6, 1e-3], 36.0, 0.06, SNAPPED),
        ],
    },
];

/// Cells cut into four, some of them thin. Cutting changes nothing.
fn split(weights: [f64; 4]) -> Result<Setup> {
    let cells = Cells::of_box(3, 0.15, hills);
    let whole = cells.clone().mesh()?;
    let whole = Shot { camera: outside(&whole), transfer: pair(&whole, 3.0), size: SIZE, mesh: whole };
    let shot = Shot { mesh: cells.split(weights).mesh()?, ..whole.clone() };
    Ok(Setup { shot, truth: Truth::Same(whole) })
}

/// A box that is thin one way, seen askew from above.
fn flat_mesh(height: f64) -> Result<Setup> {
    let mesh = Cells::of_box(4, 0.15, hills).moved(|p| p * DVec3::new(1.0, 1.0, height)).mesh()?;
    let camera = seen(&mesh, Projection::Perspective { fov_y: 0.6 });
    let mut shot = Shot { camera, transfer: pair(&mesh, 3.0 / height), size: SIZE, mesh };
    shot.camera.eye = DVec3::new(1.3, 0.9, 4.0);
    Ok(shot.into())
}
