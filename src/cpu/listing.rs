//! Segments of rays that pass two cells at once: kept, and composed by their middles.

use std::cell::RefCell;
use std::cmp::Ordering;

use glam::Vec4;
use pulp::Simd;

use crate::cpu::empty::EmptyCells;
use crate::cpu::lanes::{MOST_LANES, Mask};
use crate::cpu::segment::{LaneByLane, LaneMedium as _, Medium, Seen, Segments};
use crate::cpu::sink::{RaySink, Sink};

/// The segments of each lane's ray: distance of the middle, and what is seen.
pub type Lists = RefCell<[Vec<(f32, Seen)>; MOST_LANES]>;

/// Keeps what is seen of a medium along each lane's ray.
#[derive(Clone, Copy)]
pub struct Listing<'a> {
    pub medium: &'a dyn Medium,
    pub empty: &'a EmptyCells,
    pub lists: &'a Lists,
}

impl<S: Simd> Sink<S> for Listing<'_> {
    fn is_choosy(&self) -> bool {
        true
    }

    fn wants(&self, cell: u32) -> bool {
        !self.empty.has(cell)
    }

    fn segments(&mut self, segments: &Segments<S>) -> Mask<S> {
        let seen = LaneByLane(self.medium).segments(&mut (), segments);
        let mut lists = self.lists.borrow_mut();
        for lane in segments.which.lanes() {
            let [r, g, b] = seen.color.map(|color| color.values()[lane]);
            let one = Vec4::new(r, g, b, seen.opacity.values()[lane]);
            lists[lane].push((segments.middle.values()[lane], one));
        }
        // All, to the end: what comes later may lie before.
        segments.middle.above(segments.middle.all(f32::NEG_INFINITY))
    }
}

impl<S: Simd> RaySink<S> for Listing<'_> {
    type Seen = Seen;

    fn wants_more(&self, _: usize) -> bool {
        true
    }

    fn take(&mut self, lane: usize) -> Seen {
        let mut list = std::mem::take(&mut self.lists.borrow_mut()[lane]);
        list.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| by_color(a.1, b.1)));
        list.into_iter().fold(Vec4::ZERO, |sum, (_, seen)| sum + (1.0 - sum.w) * seen)
    }
}

/// Which of two segments at one depth comes first, as `compose.wgsl` has it: the more opaque one.
fn by_color(a: Seen, b: Seen) -> Ordering {
    let keys = |seen: Seen| [1.0 - seen.w, seen.x, seen.y, seen.z];
    let pairs = keys(a).into_iter().zip(keys(b));
    pairs.map(|(a, b)| a.total_cmp(&b)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_decide_at_one_depth() {
        let [dim, red, green] = [[0.0, 0.0, 0.0, 0.2], [0.3, 0.1, 0.0, 0.5], [0.1, 0.4, 0.0, 0.5]].map(Vec4::from);
        let mut seen = [dim, red, green];
        seen.sort_by(|a, b| by_color(*a, *b));
        assert_eq!(seen, [green, red, dim]);
        assert_eq!(by_color(red, red), Ordering::Equal);
    }
}
