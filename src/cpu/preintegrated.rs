//! A table of a 1D function's segments over entry, exit and the logarithm of the length (Röttger et al. 2000, Weiler et al.
//! 2003). Twin of `preintegrated_segment` in `shaders/shared/curves.wgsl` and of `shaders/preintegrate.wgsl`.

use glam::Vec4;
use rayon::prelude::*;

use crate::cpu::curve::CurveMedium;
use crate::cpu::segment::{Medium, Seen};
use crate::cpu::widgets::{attenuation, phi_one};

/// The longest segment: the mesh lies within 1 of the origin.
const LONGEST: f32 = 2.0;
/// Lengths, each half as long again as the one before; shorter ones are as the first.
const LENGTHS: usize = 32;
/// `log2(1.5)`.
const LENGTH_STEP: f32 = 0.584_962_5;

/// Mean colour as seen from the front, and mean extinction in w, which change little with the length.
#[derive(Clone, Debug)]
pub struct PreIntegratedMedium {
    /// What bounds it, where cells are culled.
    pub curve: CurveMedium,
    /// Nodes along the entry and the exit.
    size: usize,
    /// Entries fastest, then exits, then lengths.
    table: Vec<Vec4>,
}

impl PreIntegratedMedium {
    /// Fills the table; `size` is at least 2.
    pub fn new(curve: CurveMedium, size: u32) -> Self {
        let size = size as usize;
        let scalar = |i: usize| i as f32 / (size - 1) as f32;
        let entry = |i: usize| {
            let (front, back) = (scalar(i % size), scalar(i / size % size));
            let level = (i / (size * size)) as f32 - (LENGTHS - 1) as f32;
            let length = LONGEST * (LENGTH_STEP * level).exp2();
            let seen = curve.segment([front, 0.0], [back, 0.0], length);
            let mean = curve.mean_extinction(front, back);
            let depth = (mean * length).min(1e25);
            // Where nothing absorbs, the colour is any.
            let color = match depth > 1e-12 {
                true => seen / (depth * phi_one(depth)),
                false => 0.5 * (curve.at(front) + curve.at(back)),
            };
            color.with_w(mean)
        };
        let table = (0..size * size * LENGTHS).into_par_iter().map(entry).collect();
        Self { curve, size, table }
    }

    /// Bilinear in entry and exit.
    fn plane(&self, [i, j]: [usize; 2], [x, y]: [f32; 2], level: usize) -> Vec4 {
        let at = |i: usize, j: usize| self.table[(level * self.size + j) * self.size + i];
        at(i, j).lerp(at(i + 1, j), x).lerp(at(i, j + 1).lerp(at(i + 1, j + 1), x), y)
    }
}

impl Medium for PreIntegratedMedium {
    fn segment(&self, front: [f32; 2], back: [f32; 2], length: f32) -> Seen {
        let last = self.size - 1;
        let place = [front[0], back[0]].map(|s| s.clamp(0.0, 1.0) * last as f32);
        let corner = place.map(|p| (p as usize).min(last - 1));
        let part = [0, 1].map(|i| place[i] - corner[i] as f32);
        let top = (LENGTHS - 1) as f32;
        let level = ((length.max(1e-30) / LONGEST).log2() / LENGTH_STEP + top).clamp(0.0, top);
        let below = (level as usize).min(LENGTHS - 2);
        let value = self.plane(corner, part, below).lerp(self.plane(corner, part, below + 1), level - below as f32);
        let depth = (value.w * length).min(1e25);
        (value * (depth * phi_one(depth))).with_w(1.0 - attenuation(depth))
    }
}
