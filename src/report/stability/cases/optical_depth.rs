//! From next to nothing to a wall, and segments along which hardly anything changes.

use glam::DVec3;

use super::super::scenery::{BLUE, Cells, GREEN, ORANGE, gaussian, hills, outside, pair};
use super::super::{Case, Setup, Shot, Truth};
use super::{ANY, INTEGRALS, SIZE, by_centroids, degrades};
use crate::error::Result;
use crate::scene::{Camera, Projection, SinusoidVariant, TransferFunction, Widget, WidgetShape};
use crate::space::Ray;

const DEPTHS: &[f64] = &[1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6];

const OPACITY: &str = "opacity is 1 less an f32 transmittance, in steps of 6e-8; colours are right";
const EVEN: &str = "colours of a cell are mixed evenly, whichever is in front";
const LINEAR: &str = "the function counts as linear between its special points, of which a Gaussian has few";
const SAMPLED: &str = "the function is known at a few points of a segment";
const HOST: &[&str] = &["cpu", "cpu analytic", "cpu partial:256", "cpu mean-scalar"];
const DEVICE: &[&str] = &["rays", "project", "project centroid", "cellcast"];

pub const CASES: &[Case] = &[
    Case {
        name: "optical-depth",
        parameter: "optical depth of the diagonal",
        values: DEPTHS,
        make: uniform,
        integrals: &[],
        known: &[
            degrades(HOST, [1e-8, 1e-8], 9.0, 2.0, OPACITY),
            degrades(HOST, [1e-6, 1e-6], 30.0, 0.4, OPACITY),
            degrades(&["cpu"], [1e-4, 1e-4], 70.0, 5e-3, OPACITY),
            degrades(DEVICE, [1e-8, 1e-8], -32.0, 200.0, OPACITY),
            degrades(DEVICE, [1e-6, 1e-6], 15.0, 2.0, OPACITY),
            degrades(DEVICE, [1e-4, 1e-4], 54.0, 0.02, OPACITY),
        ],
    },
    Case {
        name: "optical-depth-colours",
        parameter: "optical depth of the diagonal, about",
        values: DEPTHS,
        make: colors,
        integrals: INTEGRALS,
        known: &[
            degrades(HOST, [1e-8, 1e-8], 9.0, 2.0, OPACITY),
            degrades(HOST, [1e-6, 1e-6], 30.0, 0.4, OPACITY),
            degrades(&["cpu"], [1e-4, 1e-4], 70.0, 5e-3, OPACITY),
            degrades(DEVICE, [1e-8, 1e-8], -32.0, 200.0, OPACITY),
            degrades(DEVICE, [1e-6, 1e-6], 15.0, 2.0, OPACITY),
            degrades(DEVICE, [1e-4, 1e-4], 54.0, 0.02, OPACITY),
            by_centroids(47.0, 0.05),
            degrades(&["cpu analytic"], ANY, 27.0, 0.5, EVEN),
            degrades(&["cpu partial:256"], ANY, 54.0, 0.03, LINEAR),
            degrades(&["cpu segmented:8"], [1e-8, 1e-6], 9.0, 2.0, OPACITY),
            degrades(&["cpu segmented:8"], ANY, 61.0, 0.01, SAMPLED),
            degrades(&["cpu mean-scalar"], ANY, 27.0, 0.6, SAMPLED),
        ],
    },
    Case {
        name: "entry-is-exit",
        parameter: "change of the scalar along a ray / across it",
        values: &[0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 0.1],
        make: entry_is_exit,
        integrals: INTEGRALS,
        known: &[
            by_centroids(63.0, 0.03),
            degrades(&["cpu analytic"], [0.01, 1.0], 57.0, 0.03, EVEN),
            degrades(&["cpu partial:256"], [0.01, 1.0], 55.0, 0.02, LINEAR),
            degrades(&["cpu mean-scalar"], [0.01, 1.0], 48.0, 0.06, SAMPLED),
        ],
    },
];

/// A uniform medium in the box: what is seen depends on the chord alone.
fn uniform(depth: f64) -> Result<Setup> {
    let mesh = Cells::of_box(4, 0.15, hills).mesh()?;
    let extinction = depth / mesh.bounds_in_data().diagonal();
    let transfer = TransferFunction::Widgets(vec![Widget::new(WidgetShape::Uniform, ORANGE, extinction)]);
    let truth = move |ray: &Ray| {
        let opacity = -(-extinction * chord(ray)).exp_m1();
        [ORANGE[0], ORANGE[1], ORANGE[2], 1.0].map(|c| c * opacity)
    };
    let shot = Shot { camera: outside(&mesh), transfer, size: SIZE, mesh };
    Ok(Setup { shot, truth: Truth::Formula(Box::new(truth)) })
}

/// Length of a ray in the box [-1, 1]^3, which lies before the eye.
fn chord(ray: &Ray) -> f64 {
    let (a, b) = ((-1.0 - ray.origin) / ray.direction, (1.0 - ray.origin) / ray.direction);
    (a.max(b).min_element() - a.min(b).max_element()).max(0.0) * ray.direction.length()
}

fn colors(depth: f64) -> Result<Setup> {
    let mesh = Cells::of_box(4, 0.15, hills).mesh()?;
    Ok(Shot { camera: outside(&mesh), transfer: pair(&mesh, depth), size: SIZE, mesh }.into())
}

/// An affine field, seen along its contours but for `change`.
fn entry_is_exit(change: f64) -> Result<Setup> {
    let mesh = Cells::of_box(4, 0.15, |p| p.x + 0.3 * p.y + change * p.z).mesh()?;
    let wave = |offset, color| {
        let variant = SinusoidVariant::Cos;
        Widget::new(WidgetShape::Sinusoid { direction: [1.0, 0.0], offset, period: 0.2, variant }, color, 0.7)
    };
    let tents = WidgetShape::Triangle { direction: [1.0, 0.0], offset: 0.05, period: 0.3, duty: 0.5 };
    let transfer = TransferFunction::Widgets(vec![
        gaussian(&mesh, 0.2, 0.05, ORANGE, 2.0),
        wave(0.0, BLUE),
        Widget::new(tents, GREEN, 0.9),
    ]);
    let camera = Camera {
        eye: DVec3::new(0.03, 0.02, 3.0),
        target: DVec3::new(0.03, 0.02, 0.0),
        up: DVec3::new(0.2, 1.0, 0.0),
        projection: Projection::Orthographic { height: 2.6 },
        near: None,
    };
    Ok(Shot { mesh, camera, transfer, size: SIZE }.into())
}
