//! Cells smaller than pixels and larger than the picture; many behind one another.

use glam::DVec3;

use super::super::scenery::{Cells, hills, outside, pair};
use super::super::{Case, Setup, Shot};
use super::{SIZE, SNAPPED, by_centroids, degrades};
use crate::error::Result;
use crate::scene::{Camera, Projection};

pub const CASES: &[Case] = &[
    Case {
        name: "small-cells",
        parameter: "cells along a pixel's side",
        values: &[0.1, 0.3, 1.0, 3.0, 10.0],
        make: small_cells,
        integrals: &[],
        known: &[
            degrades(&["project", "project centroid"], [1.0, 3.0], 61.0, 0.04, SNAPPED),
            degrades(&["cellcast"], [1.0, 1.0], 67.0, 0.02, SNAPPED),
            degrades(&["cellcast"], [3.0, 3.0], 54.0, 0.07, SNAPPED),
            degrades(&["cellcast"], [10.0, 10.0], 40.0, 0.2, SNAPPED),
        ],
    },
    Case {
        name: "one-cell",
        parameter: "width of the cell / that of the picture",
        values: &[0.5, 2.0, 10.0, 1e2, 1e3, 1e4],
        make: one_cell,
        integrals: &[],
        known: &[],
    },
    Case {
        name: "layers",
        parameter: "cells that a ray meets, about",
        values: &[10.0, 100.0, 1000.0, 5000.0],
        make: layers,
        integrals: &[],
        known: &[by_centroids(57.0, 0.01), degrades(&["cellcast"], [1e3, 5e3], 80.0, 3e-3, ROUNDED)],
    },
];

const ROUNDED: &str = "tents of a thousand cells are rounded, each by itself";

/// Of a slab of [`small_cells`], along each side.
const SLAB: usize = 96;

/// A slab one cell high, seen almost from above.
fn small_cells(per_pixel: f64) -> Result<Setup> {
    let cell = 2.0 / SLAB as f64;
    let mesh = slab().mesh()?;
    let pixels = (0.9 * SLAB as f64 / per_pixel).clamp(12.0, 48.0).round();
    let projection = Projection::Orthographic { height: pixels * per_pixel * cell };
    let eye = DVec3::new(0.33, 0.21, 2.0);
    let camera = Camera { eye, target: DVec3::ZERO, up: DVec3::new(0.1, 1.0, 0.0), projection, near: None };
    Ok(Shot { camera, transfer: pair(&mesh, 60.0), size: [pixels as u32; 2], mesh }.into())
}

fn slab() -> Cells {
    let mut slab = Cells::default();
    let side = SLAB + 1;
    for i in 0..2 * side * side {
        let at = |k: usize| 2.0 * k as f64 / SLAB as f64 - 1.0;
        let p = DVec3::new(at(i % side), at(i / side % side), 0.02 * (i / side / side) as f64);
        slab.points.push(p);
        slab.values.push(hills(2.0 * p) + 0.02 * (31.0 * p.x).sin() * (23.0 * p.y).cos());
    }
    for i in 0..SLAB * SLAB {
        let base = i % SLAB + side * (i / SLAB);
        let corner = |c: usize| (base + (c & 1) + side * (c >> 1 & 1) + side * side * (c >> 2)) as u32;
        for [a, b] in [[1, 3], [1, 5], [2, 3], [2, 6], [4, 5], [4, 6]] {
            slab.tets.push([corner(0), corner(a), corner(b), corner(7)]);
        }
    }
    slab
}

/// One tetrahedron, nearer and nearer.
fn one_cell(wider: f64) -> Result<Setup> {
    let points = [(-1.0, -0.8, 0.6), (1.0, -0.7, 0.5), (0.1, 1.1, 0.7), (0.05, 0.1, -1.0)];
    let cells = Cells {
        points: points.map(|(x, y, z)| DVec3::new(x, y, z)).to_vec(),
        tets: vec![[0, 1, 2, 3]],
        values: vec![0.0, 0.4, 1.0, 0.7],
    };
    let mesh = cells.mesh()?;
    let projection = Projection::Perspective { fov_y: 2.0 * (1.0 / wider / 3.0).atan() };
    let camera = Camera {
        eye: DVec3::new(0.3, 0.4, 3.0),
        target: DVec3::new(0.07, 0.03, 0.0),
        up: DVec3::new(0.3, 1.0, 0.0),
        projection,
        near: None,
    };
    Ok(Shot { camera, transfer: pair(&mesh, 3.0), size: SIZE, mesh }.into())
}

/// A pile of thin layers.
fn layers(met: f64) -> Result<Setup> {
    // A ray along the pile meets three or four of a cube's six cells.
    let high = (met / 3.5).round().max(1.0) as usize;
    let mut pile = Cells::default();
    for i in 0..4 * (high + 1) {
        let z = 2.0 * (i / 4) as f64 / high as f64 - 1.0;
        let p = DVec3::new(2.0 * (i % 2) as f64 - 1.0, 2.0 * (i / 2 % 2) as f64 - 1.0, z);
        pile.points.push(p);
        pile.values.push(p.x + 0.4 * p.y + 1.5 * (40.0 * p.z).sin());
    }
    for layer in 0..high {
        let corner = |c: usize| (4 * layer + c) as u32;
        for [a, b] in [[1, 3], [1, 5], [2, 3], [2, 6], [4, 5], [4, 6]] {
            pile.tets.push([corner(0), corner(a), corner(b), corner(7)]);
        }
    }
    let mesh = pile.mesh()?;
    let camera = Camera { eye: DVec3::new(0.5, 0.4, 5.0), ..outside(&mesh) };
    Ok(Shot { camera, transfer: pair(&mesh, 4.0), size: [16, 16], mesh }.into())
}
