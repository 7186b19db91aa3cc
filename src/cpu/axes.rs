//! The axes of one ray.

use glam::{DVec2, DVec3, Vec4, Vec4Swizzles as _};

use crate::plan::lens::Lens;
use crate::scene::Basis;

/// Brings vertices into a ray's axes: two across it, the distance along it; the scalar is kept. The first two turn
/// against the third as right and up do against forward.
#[derive(Clone, Copy, Debug)]
pub struct RayAxes {
    x: Vec4,
    y: Vec4,
    z: Vec4,
    offset: Vec4,
    /// Where the picture begins, along the ray.
    pub near: f32,
    /// Of a unit of view depth, the distance along the ray, and where that is counted from.
    per_depth: f64,
    start: f64,
}

impl RayAxes {
    /// Of the ray through a film position.
    pub fn new(lens: &Lens, film: DVec2) -> Self {
        let Basis { right, up, forward } = lens.basis;
        let across = film.x * right + film.y * up;
        let (origin, direction) = match lens.perspective {
            true => (lens.eye, forward + across),
            false => (lens.eye + across, forward),
        };
        let length = direction.length();
        let along = direction / length;
        // Distances are counted from where the ray is nearest to the mesh's centre, wherever the eye is: a far eye
        // costs no digits.
        let start = -origin.dot(along);
        let from = origin + start * along;
        let right = along.cross(up).normalize();
        let up = right.cross(along);
        let axis = |get: fn(DVec3) -> f64| Vec4::new(get(right) as f32, get(up) as f32, get(along) as f32, 0.0);
        let offset = |axis: DVec3| -axis.dot(from) as f32;
        Self {
            x: axis(|v| v.x),
            y: axis(|v| v.y),
            z: axis(|v| v.z),
            offset: Vec4::new(offset(right), offset(up), offset(along), 0.0),
            near: (lens.near * length - start) as f32,
            per_depth: length,
            start,
        }
    }

    /// The distance along the ray of a view depth.
    pub fn at_depth(&self, view_depth: f64) -> f64 {
        view_depth * self.per_depth - self.start
    }

    /// Of each axis its components, and what is added to the products.
    pub fn rows(&self) -> [[f32; 4]; 3] {
        [0, 1, 2].map(|i| [self.x[i], self.y[i], self.z[i], self.offset[i]])
    }

    /// `vertex`: position and scalar. The order of operations is that of all lanes' walks.
    #[inline(always)]
    pub fn apply(&self, vertex: Vec4) -> Vec4 {
        // The multiplications by 0 leave the scalar as it is.
        self.x * vertex.xxxx()
            + self.y * vertex.yyyy()
            + (self.z * vertex.zzzz() + (self.offset + vertex * Vec4::new(0.0, 0.0, 0.0, 1.0)))
    }
}
