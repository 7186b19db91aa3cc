//! A quadratic form of space.

use std::fmt;

use glam::{DMat3, DVec3};

/// A symmetric 3 x 3 matrix M, by which a squared length is `v . M v`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Metric {
    /// The matrix, mesh space; its trace is 3, or where that is not positive its largest entry 1.
    pub matrix: DMat3,
}

impl Metric {
    /// Of Euclid.
    pub const IDENTITY: Self = Self { matrix: DMat3::IDENTITY };

    /// Scales a symmetric matrix to trace 3; by its largest entry where the trace is not positive, which no image of a
    /// Delaunay mesh needs.
    pub(super) fn scaled(matrix: DMat3) -> Self {
        let trace = matrix.x_axis.x + matrix.y_axis.y + matrix.z_axis.z;
        let largest = matrix.to_cols_array().into_iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs()));
        let scale = if trace > 1e-9 * largest { 3.0 / trace } else { 1.0 / largest };
        Self { matrix: matrix * scale }
    }

    /// True of Euclid's.
    pub fn is_identity(&self) -> bool {
        *self == Self::IDENTITY
    }

    /// `v . M v`.
    pub fn square(&self, v: DVec3) -> f64 {
        v.dot(self.matrix * v)
    }
}

impl fmt::Display for Metric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_identity() {
            return f.write_str("identity");
        }
        let [x, y, z] = [self.matrix.x_axis, self.matrix.y_axis, self.matrix.z_axis];
        write!(f, "xx {:.4}, yy {:.4}, zz {:.4}, xy {:.4}, xz {:.4}, yz {:.4}", x.x, y.y, z.z, x.y, x.z, y.z)
    }
}
