//! Media that segments are integrated in. 1D functions are in `curve.rs`, widgets in a folder of their own.

use glam::Vec4;
use pulp::{Scalar, Simd};

use crate::cpu::lanes::{Floats, Mask};

/// What is seen of one segment: premultiplied colour, and opacity in w.
pub type Seen = Vec4;

/// A medium that segments are integrated in.
pub trait Medium: Sync {
    /// What is seen of a segment from `front` to `back` ((scalar, gradient magnitude), 0..1) of a length in mesh units.
    fn segment(&self, front: [f32; 2], back: [f32; 2], length: f32) -> Seen;
}

/// One segment a lane.
pub struct Segments<S: Simd> {
    /// The lanes that have one. In others the length is 0, and the fields are any finite ones.
    pub which: Mask<S>,
    /// (Scalar, gradient magnitude) at the ends.
    pub front: [Floats<S>; 2],
    pub back: [Floats<S>; 2],
    /// Mesh units.
    pub length: Floats<S>,
    /// Distance of the middle along the ray.
    pub middle: Floats<S>,
}

impl Segments<Scalar> {
    /// A single one.
    pub fn one(front: [f32; 2], back: [f32; 2], length: f32) -> Self {
        let float = |value: f32| Floats::splat(Scalar, value);
        let (front, back, length) = (front.map(float), back.map(float), float(length));
        Self { which: length.above(float(0.0)), front, back, length, middle: float(0.0) }
    }
}

/// What is seen of one segment a lane. Nothing where there is none.
#[derive(Clone, Copy)]
pub struct SeenLanes<S: Simd> {
    /// Premultiplied.
    pub color: [Floats<S>; 3],
    pub opacity: Floats<S>,
}

impl<S: Simd> SeenLanes<S> {
    #[inline(always)]
    pub fn set(&mut self, lane: usize, seen: Seen) {
        for (lanes, value) in self.color.iter_mut().zip(seen.to_array()) {
            lanes.values_mut()[lane] = value;
        }
        self.opacity.values_mut()[lane] = seen.w;
    }
}

impl SeenLanes<Scalar> {
    /// Of a single segment.
    pub fn one(&self) -> Seen {
        let [r, g, b, opacity] = [self.color[0], self.color[1], self.color[2], self.opacity].map(|v| v.values()[0]);
        Vec4::new(r, g, b, opacity)
    }
}

/// A medium that the segments of all lanes are integrated in at once.
pub trait LaneMedium: Sync {
    /// What it keeps from a ray's segment to the next.
    type Kept<S: Simd>: Copy;

    fn kept<S: Simd>(&self, simd: S) -> Self::Kept<S>;

    fn segments<S: Simd>(&self, kept: &mut Self::Kept<S>, segments: &Segments<S>) -> SeenLanes<S>;
}

/// A medium that integrates segment by segment.
pub struct LaneByLane<'a>(pub &'a dyn Medium);

impl LaneMedium for LaneByLane<'_> {
    type Kept<S: Simd> = ();

    fn kept<S: Simd>(&self, _: S) {}

    #[inline(always)]
    fn segments<S: Simd>(&self, (): &mut (), segments: &Segments<S>) -> SeenLanes<S> {
        let Segments { which, front, back, length, .. } = segments;
        let zero = length.all(0.0);
        let mut seen = SeenLanes { color: [zero; 3], opacity: zero };
        for lane in which.lanes() {
            let ends = [front, back].map(|end| [end[0].values()[lane], end[1].values()[lane]]);
            seen.set(lane, self.0.segment(ends[0], ends[1], length.values()[lane]));
        }
        seen
    }
}
