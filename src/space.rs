//! Boxes and rays, in f64. Spaces are in names: `data` (as in the file), `mesh` (recentred and scaled), `view`, `pixel`.

use glam::DVec3;

/// An axis-aligned box; empty (`min > max`) until a point is added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower corner.
    pub min: DVec3,
    /// Upper corner.
    pub max: DVec3,
}

impl Bounds {
    /// Holds nothing.
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The smallest box around `points`.
    pub fn of(points: impl IntoIterator<Item = DVec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| Self { min: b.min.min(p), max: b.max.max(p) })
    }

    /// Midpoint.
    pub fn center(&self) -> DVec3 {
        0.5 * self.min + 0.5 * self.max
    }

    /// Length of the diagonal; 0 for an empty box.
    pub fn diagonal(&self) -> f64 {
        if self.min.cmple(self.max).all() { (self.max - self.min).length() } else { 0.0 }
    }

    /// The eight corners.
    pub fn corners(&self) -> [DVec3; 8] {
        std::array::from_fn(|i| {
            DVec3::new(
                if i & 1 == 0 { self.min.x } else { self.max.x },
                if i & 2 == 0 { self.min.y } else { self.max.y },
                if i & 4 == 0 { self.min.z } else { self.max.z },
            )
        })
    }
}

/// `origin + t * direction`; the direction is not normalised unless the maker says so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where `t = 0`.
    pub origin: DVec3,
    /// Per unit of `t`.
    pub direction: DVec3,
}

/// A closed interval of reals; empty (`min > max`) until a value is added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub min: f64,
    /// Upper end.
    pub max: f64,
}

impl Interval {
    /// Holds nothing.
    pub const EMPTY: Self = Self { min: f64::INFINITY, max: f64::NEG_INFINITY };

    /// The smallest interval around the finite `values`.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        values
            .into_iter()
            .filter(|v| v.is_finite())
            .fold(Self::EMPTY, |i, v| Self { min: i.min.min(v), max: i.max.max(v) })
    }

    /// `max - min`; 0 for an empty interval.
    pub fn length(&self) -> f64 {
        (self.max - self.min).max(0.0)
    }
}
