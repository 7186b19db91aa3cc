//! Blending in f16 without its errors: the sorted cells are cut into slabs in which no pixel has more than 64 layers,
//! each blended in f16 and resolved over the ones behind it in f32. How many layers a slab has is known only when it
//! was drawn: each slab counts them, and slabs that had too many are cut and drawn again.

/// Most layers a pixel blends in f16. An adapter that rounds to nearest errs by less than 1e-3 after 256; lavapipe, which
/// rounds towards zero, by 1.5e-2, and by 3.5e-3 after 64 (Blunt Fin, default function).
pub const MOST_LAYERS: u32 = 64;

/// Counting in f16 stops here.
const COUNT_SATURATES: u32 = 2048;

/// Cuts of the sorted cells, as shares of their number: they stay useful when the number changes a little.
#[derive(Clone, Debug, PartialEq)]
pub struct Slabs {
    /// Ascending, from 0 to 1.
    cuts: Vec<f64>,
}

impl Default for Slabs {
    fn default() -> Self {
        Self { cuts: vec![0.0, 1.0] }
    }
}

impl Slabs {
    /// The slabs' cell ranges, back to front; empty ones are left out.
    pub fn ranges(&self, cells: u32) -> Vec<std::ops::Range<u32>> {
        let at = |share: f64| (share * f64::from(cells)).round() as u32;
        self.cuts.windows(2).map(|w| at(w[0])..at(w[1])).filter(|r| !r.is_empty()).collect()
    }

    /// Cuts the slabs that had too many layers; true where any had. `layers`: of each of [`Self::ranges`].
    pub fn refine(&mut self, cells: u32, layers: &[u32]) -> bool {
        let ranges = self.ranges(cells);
        let mut cuts = vec![0.0];
        let mut refined = false;
        for (range, &layers) in ranges.iter().zip(layers) {
            let mut parts = 1;
            if layers > MOST_LAYERS {
                refined = true;
                // A fifth more than the count asks for: layers are not spread evenly. A saturated count says little.
                let wanted = if layers >= COUNT_SATURATES { 16 } else { (layers * 6).div_ceil(MOST_LAYERS * 5).max(2) };
                parts = wanted.min(range.len() as u32).max(1);
            }
            let (start, length) = (f64::from(range.start), range.len() as f64);
            cuts.extend((1..=parts).map(|i| (start + length * f64::from(i) / f64::from(parts)) / f64::from(cells)));
        }
        if refined {
            if let Some(last) = cuts.last_mut() {
                *last = 1.0;
            }
            self.cuts = cuts;
        }
        refined
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slabs_cover_every_cell_once_and_end_small_enough() {
        // Layers that cannot be spread evenly: each cell of the far quarter covers one pixel.
        let layers_of = |r: &std::ops::Range<u32>| r.clone().filter(|&c| c < 25_000).count().min(2048) as u32;
        let mut slabs = Slabs::default();
        let cells = 100_003;
        for round in 0.. {
            assert!(round < 12, "refining ends");
            let ranges = slabs.ranges(cells);
            assert_eq!(ranges.first().map(|r| r.start), Some(0));
            assert_eq!(ranges.last().map(|r| r.end), Some(cells));
            assert!(ranges.windows(2).all(|w| w[0].end == w[1].start));
            let layers: Vec<u32> = ranges.iter().map(layers_of).collect();
            if !slabs.refine(cells, &layers) {
                assert!(layers.iter().all(|&l| l <= MOST_LAYERS));
                break;
            }
        }
        assert!(slabs.ranges(cells).len() < 1600, "{} slabs", slabs.ranges(cells).len());
        assert!(slabs.ranges(0).is_empty());
    }
}
