//! Units: places far from zero, lengths and scalars that f32 cannot hold, cells of very different sizes.

use glam::DVec3;

use super::super::scenery::{Cells, hills, outside, pair};
use super::super::{Case, Setup, Shot, Truth};
use super::{SIZE, by_centroids};
use crate::error::Result;
use crate::scene::{Camera, Projection, TransferFunction, WidgetShape};

const UNITS: &[f64] = &[1e-30, 1e-20, 1e-10, 1.0, 1e10, 1e20, 1e30];

pub const CASES: &[Case] = &[
    Case {
        name: "offset",
        parameter: "distance from the origin / the mesh's width",
        values: &[0.0, 1.0, 1e3, 1e6, 1e9],
        make: offset,
        integrals: &[],
        known: &[by_centroids(50.0, 0.07)],
    },
    Case {
        name: "lengths",
        parameter: "unit of length",
        values: UNITS,
        make: lengths,
        integrals: &[],
        known: &[by_centroids(50.0, 0.07)],
    },
    Case {
        name: "scalars",
        parameter: "unit of the scalar",
        values: UNITS,
        make: scalars,
        integrals: &[],
        known: &[by_centroids(50.0, 0.07)],
    },
    Case {
        name: "graded-mesh",
        parameter: "largest cell / smallest",
        values: &[1.0, 10.0, 1e2, 1e3, 1e4],
        make: graded,
        integrals: &[],
        known: &[by_centroids(60.0, 0.012)],
    },
];

fn cells() -> Cells {
    Cells::of_box(4, 0.15, hills)
}

fn plain() -> Result<Shot> {
    let mesh = cells().mesh()?;
    Ok(Shot { camera: outside(&mesh), transfer: pair(&mesh, 3.0), size: SIZE, mesh })
}

fn offset(distance: f64) -> Result<Setup> {
    let (plain, by) = (plain()?, distance * DVec3::new(2.0, -1.4, 0.8));
    let camera = Camera { eye: plain.camera.eye + by, target: plain.camera.target + by, ..plain.camera };
    let shot = Shot { mesh: cells().moved(|p| p + by).mesh()?, camera, ..plain.clone() };
    Ok(Setup { shot, truth: Truth::Same(plain) })
}

fn lengths(unit: f64) -> Result<Setup> {
    let plain = plain()?;
    let camera = Camera { eye: unit * plain.camera.eye, target: unit * plain.camera.target, ..plain.camera };
    let mesh = cells().moved(|p| unit * p).mesh()?;
    let shot = Shot { camera, transfer: in_units(&plain.transfer, 1.0, unit), mesh, ..plain };
    Ok(Setup { shot, truth: Truth::Same(plain) })
}

fn scalars(unit: f64) -> Result<Setup> {
    let (plain, mut cells) = (plain()?, cells());
    cells.values.iter_mut().for_each(|s| *s *= unit);
    let shot = Shot { mesh: cells.mesh()?, transfer: in_units(&plain.transfer, unit, 1.0), ..plain.clone() };
    Ok(Setup { shot, truth: Truth::Same(plain) })
}

/// Gaussians where the scalar and the length have these units.
fn in_units(transfer: &TransferFunction, scalar: f64, length: f64) -> TransferFunction {
    let mut transfer = transfer.clone();
    if let TransferFunction::Widgets(widgets) = &mut transfer {
        for widget in widgets {
            widget.extinction /= length;
            if let WidgetShape::Gaussian { center, sigma, .. } = &mut widget.shape {
                let units = [scalar, scalar / length];
                (0..2).for_each(|axis| {
                    center[axis] *= units[axis];
                    sigma[axis] *= units[axis];
                });
            }
        }
    }
    transfer
}

/// Finer and finer towards the middle, where the picture is.
fn graded(ratio: f64) -> Result<Setup> {
    let steep = ratio.ln().max(1e-6);
    let graded = |x: f64| x.signum() * (steep * x.abs()).exp_m1() / steep.exp_m1();
    let mesh = Cells::of_box(10, 0.0, hills).moved(|p| DVec3::from_array(p.to_array().map(graded))).mesh()?;
    let opened = 2.0 / ratio.sqrt();
    let whole = outside(&mesh);
    let fov_y = 2.0 * (0.5 * opened / whole.eye.distance(whole.target)).atan();
    let camera = Camera { projection: Projection::Perspective { fov_y }, ..whole };
    Ok(Shot { camera, transfer: pair(&mesh, 6.0), size: SIZE, mesh }.into())
}
