//! A camera's rays in view axes (x right, y up, z the view depth; origin at the eye; data units), and back to pixels.

use glam::DVec3;

use crate::scene::{Camera, Projection};
use crate::space::Ray;

/// [`Camera::ray`] as an affine function of the pixel position, which it is in view axes.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// Origin and its change a pixel, along x and y; all 0 for a perspective camera.
    origin: [[f64; 2]; 2],
    /// Direction (at view depth 1) and its change a pixel, along x and y; all 0 for an orthographic camera.
    direction: [[f64; 2]; 2],
}

impl Lens {
    /// Reads off the camera's own rays through two corners of the image, so that there is one definition of a pixel.
    pub fn new(camera: &Camera, size: [u32; 2]) -> Self {
        let basis = camera.basis();
        let axes = [basis.right, basis.up];
        let [width, height] = size.map(f64::from);
        let (near, far) = (camera.ray(size, [0.0, 0.0]), camera.ray(size, [width, height]));
        let affine = |near: DVec3, far: DVec3| {
            let at = |i: usize| axes[i].dot(near);
            let step = |i: usize, pixels: f64| axes[i].dot(far - near) / pixels;
            [[at(0), step(0, width)], [at(1), step(1, height)]]
        };
        match camera.projection {
            Projection::Perspective { .. } => {
                Self { origin: [[0.0; 2]; 2], direction: affine(near.direction, far.direction) }
            }
            Projection::Orthographic { .. } => {
                Self { origin: affine(near.origin - camera.eye, far.origin - camera.eye), direction: [[0.0; 2]; 2] }
            }
        }
    }

    /// The ray through `pixel`, view axes; `t` is the view depth.
    pub fn ray(&self, pixel: [f64; 2]) -> Ray {
        let at = |[start, step]: [f64; 2], i: usize| start + step * pixel[i];
        Ray {
            origin: DVec3::new(at(self.origin[0], 0), at(self.origin[1], 1), 0.0),
            direction: DVec3::new(at(self.direction[0], 0), at(self.direction[1], 1), 1.0),
        }
    }

    /// Where a point in front of the eye appears; not finite at depth 0 of a perspective camera.
    pub fn pixel(&self, point: DVec3) -> [f64; 2] {
        let depth = point.z;
        let solve = |v: f64, i: usize| {
            let [[origin, origin_step], [direction, direction_step]] = [self.origin[i], self.direction[i]];
            (v - origin - depth * direction) / (origin_step + depth * direction_step)
        };
        [solve(point.x, 0), solve(point.y, 1)]
    }
}
