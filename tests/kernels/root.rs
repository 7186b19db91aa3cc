//! What the translation's runtime lacks.

use naga_rust_rt::Scalar;

/// The square root, as a method.
pub trait SquareRoot {
    fn sqrt(self) -> Self;
}

impl SquareRoot for Scalar<f32> {
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
}

impl SquareRoot for Scalar<f64> {
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
}
