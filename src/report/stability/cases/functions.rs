//! Functions with features far smaller than what a cell holds of the scalar.

use super::super::scenery::{BLUE, Cells, GREEN, ORANGE, cell_range, gaussian, hills, outside};
use super::super::{Case, Expected, Known, Setup, Shot};
use super::{ANY, INTEGRALS, SIZE, by_centroids, degrades};
use crate::error::Result;
use crate::scene::{Curve, CurveNode, SinusoidVariant, TransferFunction, Widget, WidgetShape};
use crate::tet::TetMesh;

const NARROW: &[f64] = &[1.0, 0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-5];
const PEAKS: &[f64] = &[0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 1000.0];
/// Optical depth of one feature crossed at right angles.
const CROSSING: f64 = 1.2;
/// Mean gradient of [`hills`].
const SLOPE: f64 = 1.3;

const SAMPLED: &str = "the function is known at a few points of a segment, and features lie between them";
const EVEN: &str = "colours of a cell are mixed evenly, whichever is in front";
const LINEAR: &str = "the function counts as linear between its special points, of which a Gaussian has few";
const TABLE: &str = "a table's 128 nodes over all scalars are wider than the feature";
const TOLERANCE: &str = "each cell's colours may err by the tolerance, 1e-3, and a ray adds up a dozen";
const NODES: &str = "nodes are f32 of the mesh's range, and so is their distance";
const EXACT: &[&str] = &["cpu", "rays", "project", "cellcast"];

const fn misses(entrants: &'static [&'static str], values: [f64; 2]) -> Known {
    Known { entrants, values, expected: Expected::Misses, why: SAMPLED }
}

pub const CASES: &[Case] = &[
    Case {
        name: "narrow-gaussian",
        parameter: "standard deviation / a cell's range",
        values: NARROW,
        make: narrow_gaussian,
        integrals: INTEGRALS,
        known: &[
            by_centroids(39.0, 0.2),
            degrades(&["cpu analytic"], ANY, 40.0, 0.15, EVEN),
            degrades(&["cpu partial:256"], [0.01, 1.0], 33.0, 0.4, LINEAR),
            degrades(&["cpu partial:256"], ANY, 17.0, 0.6, LINEAR),
            degrades(&["cpu segmented:8"], [0.1, 1.0], 50.0, 0.05, SAMPLED),
            misses(&["cpu segmented:8", "cpu mean-scalar"], ANY),
        ],
    },
    Case {
        name: "narrow-blob",
        parameter: "standard deviations / a cell's ranges",
        values: &[1.0, 0.3, 0.1, 0.03, 0.01],
        make: narrow_blob,
        integrals: &[],
        known: &[by_centroids(55.0, 0.03)],
    },
    Case {
        name: "narrow-tent",
        parameter: "half width / a cell's range",
        values: NARROW,
        make: narrow_tent,
        integrals: &["preintegrated", "segmented:8", "mean-scalar"],
        known: &[
            by_centroids(39.0, 0.2),
            degrades(EXACT, [0.0, 1.1e-4], 52.0, 0.015, NODES),
            degrades(&["cpu preintegrated:128"], [0.1, 1.0], 50.0, 0.06, TABLE),
            degrades(&["cpu preintegrated:128"], ANY, 26.0, 0.95, TABLE),
            misses(&["cpu segmented:8", "cpu mean-scalar"], ANY),
        ],
    },
    Case {
        name: "waves",
        parameter: "peaks a cell",
        values: PEAKS,
        make: |peaks| waves(peaks, false),
        integrals: &["adaptive:0.0001", "analytic", "partial", "segmented:8", "mean-scalar", "preintegrated"],
        known: &[
            by_centroids(45.0, 0.06),
            degrades(EXACT, [1.0, 100.0], 72.0, 2.5e-3, TOLERANCE),
            Known {
                entrants: &["cpu preintegrated:128"],
                values: ANY,
                expected: Expected::Refuses,
                why: "it holds functions of the scalar alone",
            },
            degrades(&["cpu analytic"], ANY, 40.0, 0.15, EVEN),
            degrades(&["cpu partial:256"], ANY, 25.0, 0.4, LINEAR),
            degrades(&["cpu segmented:8", "cpu mean-scalar"], ANY, 15.0, 0.8, SAMPLED),
        ],
    },
    Case {
        name: "tents",
        parameter: "peaks a cell",
        values: PEAKS,
        make: |peaks| waves(peaks, true),
        integrals: &["adaptive:0.0001"],
        known: &[by_centroids(44.0, 0.15), degrades(EXACT, [1.0, 100.0], 66.0, 4e-3, TOLERANCE)],
    },
];

fn shot(transfer: impl Fn(&TetMesh) -> TransferFunction) -> Result<Setup> {
    let mesh = Cells::of_box(4, 0.15, hills).mesh()?;
    Ok(Shot { camera: outside(&mesh), transfer: transfer(&mesh), size: SIZE, mesh }.into())
}

/// Of two features: where, and of which colour.
fn places(mesh: &TetMesh) -> [(f64, [f64; 3]); 2] {
    let range = mesh.scalar_range();
    [(0.37, ORANGE), (0.61, BLUE)].map(|(share, color)| (range.min + share * range.length(), color))
}

fn narrow_gaussian(width: f64) -> Result<Setup> {
    shot(|mesh| {
        let sigma = width * cell_range(mesh);
        let extinction = CROSSING * SLOPE / (2.5 * sigma);
        let widget = |(center, color)| gaussian(mesh, center, sigma, color, extinction);
        TransferFunction::Widgets(places(mesh).map(widget).to_vec())
    })
}

fn narrow_blob(width: f64) -> Result<Setup> {
    shot(|mesh| {
        let gradient = mesh.gradient_range();
        let sigma = [width * cell_range(mesh), width * 0.5 * gradient.length()];
        let extinction = CROSSING * SLOPE / (2.5 * sigma[0]);
        let widget = |(center, color)| {
            let center = [center, gradient.min + 0.4 * gradient.length()];
            Widget::new(WidgetShape::Gaussian { center, sigma, angle: 0.3 }, color, extinction)
        };
        TransferFunction::Widgets(places(mesh).map(widget).to_vec())
    })
}

fn narrow_tent(width: f64) -> Result<Setup> {
    shot(|mesh| {
        let half_width = width * cell_range(mesh);
        let peak = CROSSING * SLOPE / half_width;
        let mut nodes: Vec<CurveNode> = Vec::new();
        for (center, color) in places(mesh) {
            for (off, extinction) in [(-half_width, 0.0), (0.0, peak), (half_width, 0.0)] {
                nodes.push(CurveNode { scalar: center + off, color, extinction });
            }
        }
        // Wide tents overlap: what is left is still a function with corners.
        nodes.sort_by(|a, b| a.scalar.total_cmp(&b.scalar));
        TransferFunction::Curve(Curve { nodes })
    })
}

fn waves(peaks: f64, narrow: bool) -> Result<Setup> {
    // The reference takes its time: a ray through a few cells meets thousands of peaks.
    let few = peaks > 30.0;
    let mesh = Cells::of_box(if few { 2 } else { 4 }, 0.15, hills).mesh()?;
    let transfer = {
        let period = cell_range(&mesh) / peaks;
        let wave = |shift: f64, color: [f64; 3]| {
            let (direction, offset) = ([1.0, 0.0], mesh.scalar_range().min + shift * period);
            let shape = match narrow {
                true => WidgetShape::Triangle { direction, offset, period, duty: 0.2 },
                false => WidgetShape::Sinusoid { direction, offset, period, variant: SinusoidVariant::Cos },
            };
            Widget::new(shape, color, if narrow { 3.0 } else { 0.6 })
        };
        TransferFunction::Widgets(vec![wave(0.0, ORANGE), wave(0.37, BLUE), wave(0.7, GREEN)])
    };
    Ok(Shot { camera: outside(&mesh), transfer, size: if few { [16, 16] } else { [32, 32] }, mesh }.into())
}
