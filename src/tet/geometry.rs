//! Signed volumes of tetrahedra, and when they can be told from zero.

use glam::DVec3;

/// Six times the signed volume: `(b - a) x (c - a) . (d - a)`.
#[inline]
pub(crate) fn six_volumes([a, b, c, d]: [DVec3; 4]) -> f64 {
    (b - a).cross(c - a).dot(d - a)
}

/// A tetrahedron's orientation: 1 or -1 where the sign of its volume is certain, 0 where it cannot be told from zero.
#[inline]
pub(super) fn orientation([a, b, c, d]: [DVec3; 4]) -> i8 {
    determinant_sign([b - a, c - a, d - a])
}

/// The sign of `u x v . w`, or 0 where it is uncertain; the vectors may be differences that were rounded once.
///
/// The bound is the static filter of Shewchuk 1997 (*Adaptive precision floating-point arithmetic and fast robust
/// geometric predicates*, section 4.3): the determinant's rounding error is below `(7 + 56 e) e` times the sum of
/// the absolute values of its terms, e = 2^-53. It scales with the tetrahedron itself, so slivers stay: a height of
/// 1e-6 of the edges is 1e9 times above it. Exactly flat cells fall below it however they are turned.
#[inline]
pub(crate) fn determinant_sign([u, v, w]: [DVec3; 3]) -> i8 {
    let (uu, vv, ww) = (u.abs(), v.abs(), w.abs());
    let crossed = DVec3::new(uu.y * vv.z + uu.z * vv.y, uu.z * vv.x + uu.x * vv.z, uu.x * vv.y + uu.y * vv.x);
    const BOUND: f64 = 8.0 * (0.5 * f64::EPSILON);
    let (volume, bound) = (u.cross(v).dot(w), BOUND * crossed.dot(ww));
    // Written so that NaN gives 0.
    if volume > bound {
        1
    } else if volume < -bound {
        -1
    } else {
        0
    }
}

/// True where the orientation is certain, and positive.
#[inline]
pub(crate) fn is_positive(corners: [DVec3; 4]) -> bool {
    orientation(corners) == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slivers_are_told_from_flat_cells() {
        let (a, b, c) = (DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.9, 0.1, 0.4), DVec3::new(0.3, 0.8, 0.2));
        let normal = (b - a).cross(c - a).normalize();
        let inside = 0.3 * a + 0.45 * b + 0.25 * c;
        assert_eq!(orientation([a, b, c, inside]), 0);
        assert_eq!(orientation([a, b, c, inside + 1e-6 * normal]), 1);
        assert_eq!(orientation([a, b, c, inside - 1e-6 * normal]), -1);
        assert_eq!(orientation([a, b, c, c]), 0);
        assert_eq!(orientation([a, b, c, DVec3::NAN]), 0);
    }
}
