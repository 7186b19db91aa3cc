//! What is done with what rays pass.

use pulp::Simd;

use crate::cpu::lanes::Mask;
use crate::cpu::segment::Segments;

/// What is done with the segments of rays.
pub trait Sink<S: Simd>: Copy {
    /// Whether fields of some cells are not wanted.
    fn is_choosy(&self) -> bool;

    /// Whether fields are wanted for a cell.
    fn wants(&self, cell: u32) -> bool;

    /// The lanes whose rest of the ray is wanted.
    fn segments(&mut self, segments: &Segments<S>) -> Mask<S>;
}

/// What keeps what is seen along each lane's ray.
pub trait RaySink<S: Simd>: Sink<S> {
    type Seen;

    /// Whether the rest of a lane's ray is wanted.
    fn wants_more(&self, lane: usize) -> bool;

    /// What a lane's ray has seen. The lane begins anew.
    fn take(&mut self, lane: usize) -> Self::Seen;
}
