//! The cases, by theme.

mod eyes;
mod functions;
mod lenses;
mod optical_depth;
mod order;
mod scales;
mod shapes;
mod sizes;

use super::{Case, Expected, Known, Limits};

/// All of them.
pub fn all() -> Vec<Case> {
    [
        functions::CASES,
        optical_depth::CASES,
        shapes::CASES,
        eyes::CASES,
        scales::CASES,
        order::CASES,
        sizes::CASES,
        lenses::CASES,
    ]
    .concat()
}

/// Of most pictures: many enough that a percentile means something, few enough for the reference.
const SIZE: [u32; 2] = [48, 48];

/// What the default integral is compared with.
const INTEGRALS: &[&str] = &["analytic", "partial", "segmented:8", "mean-scalar"];

/// Every value.
const ANY: [f64; 2] = [0.0, f64::INFINITY];

/// What is known of `entrants` at `values`: that they stay within these limits.
const fn degrades(
    entrants: &'static [&'static str],
    values: [f64; 2],
    psnr: f64,
    percentile_99_9: f64,
    why: &'static str,
) -> Known {
    Known { entrants, values, expected: Expected::Degrades(Limits { psnr, percentile_99_9 }), why }
}

/// What is known of drawing by the depths of centroids.
const fn by_centroids(psnr: f64, percentile_99_9: f64) -> Known {
    degrades(&["project centroid"], ANY, psnr, percentile_99_9, "cells are not drawn in their order")
}

const SNAPPED: &str = "faces seen almost edge-on are narrower than a rasteriser's grid of 1/256 pixel";
const F32_PLACES: &str = "vertices are f32: 6e-8 of the mesh's radius";
