//! Where cells are seen from.

use glam::DVec3;

use crate::scene::{Camera, Projection};
use crate::tet::{TetMesh, determinant_sign};

/// The eye in homogeneous coordinates, mesh space: a point for perspective, the direction towards it for parallel rays.
/// Whether it stands before a plane, and how far, is one formula for both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vantage {
    /// The point, or the direction towards the eye (of length 1).
    pub point: DVec3,
    /// There is a point.
    pub perspective: bool,
}

impl Vantage {
    /// Of a camera.
    pub fn new(mesh: &TetMesh, camera: &Camera) -> Self {
        match camera.projection {
            Projection::Perspective { .. } => Self { point: mesh.mesh_from_data(camera.eye), perspective: true },
            Projection::Orthographic { .. } => Self { point: -camera.basis().forward, perspective: false },
        }
    }

    /// `[x, y, z, 1]` of a point, `[x, y, z, 0]` of a direction.
    pub fn homogeneous(&self) -> [f64; 4] {
        [self.point.x, self.point.y, self.point.z, if self.perspective { 1.0 } else { 0.0 }]
    }

    /// 1 where a triangle is seen counter-clockwise, -1 where clockwise, 0 where its plane holds the eye within
    /// rounding.
    pub(super) fn side(&self, [a, b, c]: [DVec3; 3]) -> i8 {
        determinant_sign([b - a, c - a, self.towards(a)])
    }

    /// How much of the view a triangle fills: the solid angle (van Oosterom & Strackee 1983), or for parallel rays
    /// the projected area in square mesh units.
    pub(super) fn extent(&self, [a, b, c]: [DVec3; 3]) -> f64 {
        if !self.perspective {
            return 0.5 * (b - a).cross(c - a).dot(self.point).abs();
        }
        let [u, v, w] = [a, b, c].map(|p| self.towards(p));
        let [lu, lv, lw] = [u, v, w].map(DVec3::length);
        let denominator = lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv;
        2.0 * u.cross(v).dot(w).abs().atan2(denominator)
    }

    fn towards(&self, p: DVec3) -> DVec3 {
        if self.perspective { self.point - p } else { self.point }
    }
}
