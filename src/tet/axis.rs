//! Field values on 0..1.

use crate::space::Interval;

/// Maps data units to 0..1, in f64, before anything is narrowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    /// Data value that becomes 0.
    pub low: f64,
    /// Per data unit.
    pub scale: f64,
    /// Of the normalised range: 1, or 0 for a range without extent.
    extent: f64,
}

impl Axis {
    /// Changes nothing.
    pub const SAME: Self = Self { low: 0.0, scale: 1.0, extent: 1.0 };

    /// The range becomes 0..1; a range without extent becomes 0.
    pub fn of(range: Interval) -> Self {
        let length = range.length();
        let low = if range.min.is_finite() { range.min } else { 0.0 };
        if length > 0.0 {
            Self { low, scale: 1.0 / length, extent: 1.0 }
        } else {
            Self { low, scale: 1.0, extent: 0.0 }
        }
    }

    /// The middle of the range, normalised.
    pub fn middle(self) -> f64 {
        0.5 * self.extent
    }

    /// Data value to 0..1.
    pub fn apply(self, value: f64) -> f64 {
        (value - self.low) * self.scale
    }
}
