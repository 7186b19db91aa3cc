//! Meshes whose cells have no simple order.

use glam::{DMat3, DVec3};

use super::super::scenery::{BLUE, Cells, GREEN, ORANGE, bands, hills, outside};
use super::super::{Case, Setup, Shot};
use super::{SIZE, by_centroids};
use crate::error::Result;
use crate::scene::{Camera, Curve, CurveNode, Projection, TransferFunction};

pub const CASES: &[Case] = &[
    Case {
        name: "tunnels",
        parameter: "tunnels along each side",
        values: &[1.0, 2.0, 3.0],
        make: tunnels,
        integrals: &[],
        known: &[by_centroids(29.0, 0.7)],
    },
    Case {
        name: "cycle",
        parameter: "cells that hide one another in a circle",
        values: &[3.0, 4.0, 5.0, 7.0, 8.0],
        make: cycle,
        integrals: &[],
        known: &[by_centroids(28.0, 0.5)],
    },
];

/// A box through which square tunnels lead along x and along z.
fn tunnels(count: f64) -> Result<Setup> {
    let n = 2.0 * count + 1.0;
    let odd = |x: f64| ((0.5 * (x + 1.0) * n) as usize) % 2 == 1;
    let keep = |p: DVec3| !(odd(p.x) && odd(p.y) || odd(p.y) && odd(p.z));
    let mesh = Cells::of_box(n as usize, 0.0, hills).kept(keep).mesh()?;
    Ok(Shot { camera: outside(&mesh), transfer: bands(&mesh, 12, 8.0), size: SIZE, mesh }.into())
}

/// Beams around the z axis, each of which hides the next one's end.
fn cycle(count: f64) -> Result<Setup> {
    let (mut cells, beams) = (Cells::default(), count as u32);
    // Their middle lines cross at two thirds of this.
    let reach = 1.5 * 0.45 * (std::f64::consts::PI / count).tan();
    for k in 0..beams {
        let turn = DMat3::from_rotation_z(std::f64::consts::TAU / count * f64::from(k));
        let first = cells.points.len() as u32;
        let corners = [(-reach, 0.3, 0.3), (-reach, 0.6, 0.3), (reach, 0.45, -0.4), (reach, 0.45, -0.2)];
        cells.points.extend(corners.map(|(x, y, z)| turn * DVec3::new(x, y, z)));
        cells.tets.push([first, first + 1, first + 2, first + 3]);
        // Each has a part of the range of its own.
        cells.values.extend((0..4).map(|v| f64::from(k) + 0.2 * f64::from(v)));
    }
    let mesh = cells.mesh()?;
    let projection = Projection::Perspective { fov_y: 2.0 * (0.18 * reach.hypot(0.6)).atan() };
    let camera = Camera { eye: DVec3::new(0.0, 0.0, 6.0), target: DVec3::ZERO, up: DVec3::Y, projection, near: None };
    let nodes = (0..2 * beams).map(|i| CurveNode {
        scalar: f64::from(i / 2) + 0.6 * f64::from(i % 2),
        color: [ORANGE, BLUE, GREEN][(i / 2) as usize % 3],
        extinction: 12.0,
    });
    let transfer = TransferFunction::Curve(Curve { nodes: nodes.collect() });
    Ok(Shot { mesh, camera, transfer, size: SIZE }.into())
}
