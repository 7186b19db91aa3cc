//! Segments over each other, front to back.

use glam::Vec4;
use pulp::Simd;

use crate::cpu::empty::EmptyCells;
use crate::cpu::lanes::{Floats, Mask};
use crate::cpu::segment::{LaneMedium, Seen, Segments};
use crate::cpu::sink::{RaySink, Sink};

/// What is seen of a medium along each lane's ray.
pub struct Composite<'a, S: Simd, M: LaneMedium> {
    medium: &'a M,
    kept: M::Kept<S>,
    empty: &'a EmptyCells,
    has_empty: bool,
    color: [Floats<S>; 3],
    transmittance: Floats<S>,
    /// Where a ray ends.
    least: Floats<S>,
}

impl<S: Simd, M: LaneMedium> Clone for Composite<'_, S, M> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Simd, M: LaneMedium> Copy for Composite<'_, S, M> {}

impl<'a, S: Simd, M: LaneMedium> Composite<'a, S, M> {
    /// Nothing yet. Rays end where their transmittance is `least`.
    #[inline(always)]
    pub fn new(simd: S, medium: &'a M, empty: &'a EmptyCells, least: f32) -> Self {
        let [zero, one, least] = [0.0, 1.0, least].map(|value| Floats::splat(simd, value));
        let (kept, has_empty) = (medium.kept(simd), empty.count() > 0);
        Self { medium, kept, empty, has_empty, color: [zero; 3], transmittance: one, least }
    }
}

impl<S: Simd, M: LaneMedium> Sink<S> for Composite<'_, S, M> {
    #[inline(always)]
    fn is_choosy(&self) -> bool {
        self.has_empty
    }

    #[inline(always)]
    fn wants(&self, cell: u32) -> bool {
        !self.empty.has(cell)
    }

    #[inline(always)]
    fn segments(&mut self, segments: &Segments<S>) -> Mask<S> {
        if segments.which.any() {
            let seen = self.medium.segments(&mut self.kept, segments);
            for (sum, color) in self.color.iter_mut().zip(seen.color) {
                *sum = self.transmittance.mul_add(color, *sum);
            }
            self.transmittance = self.transmittance - self.transmittance * seen.opacity;
        }
        self.transmittance.above(self.least)
    }
}

impl<S: Simd, M: LaneMedium> RaySink<S> for Composite<'_, S, M> {
    type Seen = Seen;

    #[inline(always)]
    fn wants_more(&self, lane: usize) -> bool {
        self.transmittance.values()[lane] > self.least.values()[lane]
    }

    #[inline(always)]
    fn take(&mut self, lane: usize) -> Seen {
        let [r, g, b] = self.color.each_mut().map(|color| std::mem::take(&mut color.values_mut()[lane]));
        let transmittance = std::mem::replace(&mut self.transmittance.values_mut()[lane], 1.0);
        Vec4::new(r, g, b, 1.0 - transmittance)
    }
}
