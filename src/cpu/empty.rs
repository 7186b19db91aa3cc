//! Cells that a transfer function leaves transparent.

use glam::Vec2;
use rayon::prelude::*;

use crate::cpu::curve::CurveMedium;
use crate::cpu::transfer::Compiled;
use crate::cpu::widgets::{AnyWidget, Classifier, extremes};
use crate::tet::{Cell, LinkedMesh};

/// Optical depth, and colour: a ray through 1,000 cells that are left out errs by 1e-6 at most.
const INVISIBLE: f32 = 1e-9;
/// No segment is longer, mesh units: the mesh's radius is at most 1.
const LONGEST: f32 = 2.0;

/// One bit a cell: transparent, whatever ray.
#[derive(Debug, Default)]
pub struct EmptyCells {
    words: Vec<u64>,
}

impl EmptyCells {
    /// Conservative: a cell's values lie in the convex hull of its vertices' values, and what bounds the extinction there
    /// bounds the cell.
    pub fn new(mesh: &LinkedMesh, compiled: &Compiled) -> Self {
        let words = mesh
            .cells
            .par_chunks(64)
            .map(|cells| {
                (0..).zip(cells).fold(0, |bits, (i, cell)| {
                    let is_empty = cell_bound(mesh, compiled, cell) * LONGEST < INVISIBLE;
                    bits | u64::from(is_empty) << i
                })
            })
            .collect();
        Self { words }
    }

    /// None.
    pub fn none(mesh: &LinkedMesh) -> Self {
        Self { words: vec![0; mesh.cells.len().div_ceil(64)] }
    }

    #[inline(always)]
    pub fn has(&self, cell: u32) -> bool {
        self.words[(cell / 64) as usize] >> (cell % 64) & 1 != 0
    }

    pub fn count(&self) -> u64 {
        self.words.iter().map(|w| u64::from(w.count_ones())).sum()
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.words[..])
    }
}

/// Extinction and emission within the cell do not exceed it.
fn cell_bound(mesh: &LinkedMesh, compiled: &Compiled, cell: &Cell) -> f32 {
    let scalars = cell.vertices.map(|v| mesh.vertices[v as usize].w);
    let gradients = cell.vertices.map(|v| mesh.gradients[v as usize]);
    let corners = std::array::from_fn(|i| Vec2::new(scalars[i], gradients[i]));
    let of_any = |widgets: &[AnyWidget]| widgets.iter().map(|w| w.bound(corners)).sum();
    match compiled {
        Compiled::Curve(curve) => curve_bound(curve, scalars),
        Compiled::Plain(sum) => sum.widgets.iter().map(|w| w.bound(corners)).sum(),
        Compiled::Any(sum) => of_any(&sum.widgets),
        Compiled::Adaptive(sum) => of_any(&sum.widgets),
        Compiled::Partial(sum) => of_any(&sum.widgets),
        Compiled::PreIntegrated(table) => curve_bound(&table.curve, scalars),
        Compiled::Points(medium) => match &medium.classifier {
            Classifier::Curve(curve) => curve_bound(curve, scalars),
            Classifier::Widgets(widgets) => of_any(widgets),
        },
    }
}

/// The largest extinction or emission.
fn curve_bound(curve: &CurveMedium, scalars: [f32; 4]) -> f32 {
    let [low, high] = extremes(scalars);
    let mut most = 0.0_f32;
    for piece in &curve.pieces[curve.holder(low)..] {
        if piece.low > high {
            break;
        }
        for s in [low.max(piece.low), high.min(piece.high)] {
            let value = piece.start + (s - piece.low) * piece.slope;
            most = most.max(value.w * value.truncate().max_element().max(1.0));
        }
    }
    most
}
