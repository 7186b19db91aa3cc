//! Cells that a transfer function leaves transparent.

use glam::Vec2;
use rayon::prelude::*;

use crate::cpu::mesh::CellMesh;
use crate::cpu::segment::{CurveMedium, WidgetMedium};
use crate::cpu::transfer::Compiled;

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
    pub fn new(mesh: &CellMesh, compiled: &Compiled) -> Self {
        let words = mesh
            .cells
            .par_chunks(64)
            .map(|cells| {
                (0..).zip(cells).fold(0, |bits, (i, cell)| {
                    let scalars = cell.vertices.map(|v| mesh.vertices[v as usize].w);
                    let bound = match compiled {
                        Compiled::Curve(curve) => curve_bound(curve, scalars),
                        Compiled::Widgets(sum) => {
                            let gradients = cell.vertices.map(|v| mesh.gradients[v as usize]);
                            let corners = std::array::from_fn(|i| Vec2::new(scalars[i], gradients[i]));
                            sum.widgets.iter().map(|w| widget_bound(w, corners)).sum()
                        }
                    };
                    bits | u64::from(bound * LONGEST < INVISIBLE) << i
                })
            })
            .collect();
        Self { words }
    }

    /// None.
    pub fn none(mesh: &CellMesh) -> Self {
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

fn bounds(values: [f32; 4]) -> [f32; 2] {
    let [a, b, c, d] = values;
    [a.min(b).min(c.min(d)), a.max(b).max(c.max(d))]
}

/// The largest extinction or emission.
fn curve_bound(curve: &CurveMedium, scalars: [f32; 4]) -> f32 {
    let [low, high] = bounds(scalars);
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

fn widget_bound(widget: &WidgetMedium, corners: [Vec2; 4]) -> f32 {
    let beyond = |range: Option<[f32; 2]>, values: [f32; 4]| {
        let [low, high] = bounds(values);
        range.is_some_and(|[from, to]| high < from || low > to)
    };
    if beyond(widget.scalar, corners.map(|c| c.x)) || beyond(widget.gradient, corners.map(|c| c.y)) {
        return 0.0;
    }
    let peak = match &widget.gaussian {
        None => 1.0,
        Some(gaussian) => {
            let whitened = corners.map(|c| gaussian.whitened(c));
            let distance = |values: [f32; 4]| {
                let [low, high] = bounds(values);
                low.max(-high).max(0.0)
            };
            let (x, y) = (distance(whitened.map(|p| p.x)), distance(whitened.map(|p| p.y)));
            (-(x * x + y * y)).exp()
        }
    };
    widget.extinction * widget.color.max_element().max(1.0) * peak
}
