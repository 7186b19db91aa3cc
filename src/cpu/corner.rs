//! Corners of faces as seen along the rays of all lanes.

use pulp::Simd;

use crate::cpu::lanes::{Floats, Mask};

/// One corner of a face a lane: across the ray, along it, scalar, and gradient magnitude.
#[derive(Clone, Copy)]
pub struct Corner<S: Simd> {
    pub x: Floats<S>,
    pub y: Floats<S>,
    pub z: Floats<S>,
    pub scalar: Floats<S>,
    pub gradient: Floats<S>,
}

impl<S: Simd> Corner<S> {
    /// `self x other`, and where its sign is not certain. It errs by 1.5 ulp at most (Kahan; Jeannerod, Louvet and Muller
    /// 2013, "Further analysis of Kahan's algorithm for the accurate computation of 2x2 determinants"), so even faces
    /// seen nearly edge-on are met where their corners say. Only of numbers that f32 cannot hold it errs by more.
    #[inline(always)]
    pub fn cross(&self, other: &Self) -> (Floats<S>, Mask<S>) {
        let product = self.y * other.x;
        let rounding = self.y.fused(other.x, -product);
        let value = self.x.fused(other.y, -product) - rounding;
        (value, !value.abs().above(value.all(1e-30)))
    }
}
