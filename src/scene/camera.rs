//! The camera: where a pixel's ray starts and goes.

use glam::DVec3;

use crate::space::{Bounds, Ray};

/// How the view volume opens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// `fov_y`: full vertical angle, radians.
    Perspective {
        /// Radians, in (0, pi).
        fov_y: f64,
    },
    /// `height`: of the image, data units.
    Orthographic {
        /// Data units.
        height: f64,
    },
}

/// A camera in data space. Pixels are square; the image's height fixes the scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position (of the image plane's centre for an orthographic camera).
    pub eye: DVec3,
    /// Looked-at point.
    pub target: DVec3,
    /// Roughly upwards; not parallel to the view direction.
    pub up: DVec3,
    /// Perspective or orthographic.
    pub projection: Projection,
    /// Depth (along the view direction, data units) where the picture begins. `None`: 1e-4 of the mesh's diagonal for
    /// a perspective camera, 0 for an orthographic one.
    pub near: Option<f64>,
}

/// Orthonormal view axes, data space: x right, y up, z forward (away from the eye).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Basis {
    /// To the image's right.
    pub right: DVec3,
    /// To the image's top.
    pub up: DVec3,
    /// Away from the eye.
    pub forward: DVec3,
}

impl Camera {
    /// A camera that looks at the middle of `bounds` (data space) from `direction` = (azimuth, elevation), radians: at
    /// (0, 0) it stands on the +x side with z upwards. Its distance is such that the bounding sphere, shrunk by `zoom`,
    /// touches the nearer borders of an image of `aspect` = width / height.
    pub fn fit(bounds: &Bounds, aspect: f64, direction: [f64; 2], zoom: f64, projection: Projection) -> Self {
        let [(sin_a, cos_a), (sin_e, cos_e)] = direction.map(f64::sin_cos);
        let radius = 0.5 * bounds.diagonal();
        let distance = match projection {
            Projection::Perspective { fov_y } => {
                let half_angle = ((0.5 * fov_y).tan() * aspect.min(1.0)).atan();
                radius / zoom / half_angle.sin()
            }
            // Depth does not show, so the eye may stand safely outside.
            Projection::Orthographic { .. } => 2.0 * radius,
        };
        let target = bounds.center();
        Self {
            eye: target + distance * DVec3::new(cos_e * cos_a, cos_e * sin_a, sin_e),
            target,
            // The derivative by elevation: upright at every elevation, the poles included.
            up: DVec3::new(-sin_e * cos_a, -sin_e * sin_a, cos_e),
            projection,
            near: None,
        }
    }

    /// The view axes.
    pub fn basis(&self) -> Basis {
        let forward = (self.target - self.eye).normalize();
        let right = forward.cross(self.up).normalize();
        Basis { right, up: right.cross(forward), forward }
    }

    /// The depth where the picture begins, for a mesh of this diagonal.
    pub fn near_depth(&self, mesh_diagonal: f64) -> f64 {
        self.near.unwrap_or(match self.projection {
            Projection::Perspective { .. } => 1e-4 * mesh_diagonal,
            Projection::Orthographic { .. } => 0.0,
        })
    }

    /// The ray through image position `pixel` (x right, y down, the first pixel's centre at (0.5, 0.5)) of an image of
    /// `size`. Its direction has length 1 along the view direction, so `t` is the view depth.
    pub fn ray(&self, size: [u32; 2], pixel: [f64; 2]) -> Ray {
        let basis = self.basis();
        let (w, h) = (f64::from(size[0]), f64::from(size[1]));
        let (x, y) = ((2.0 * pixel[0] - w) / h, 1.0 - 2.0 * pixel[1] / h);
        match self.projection {
            Projection::Perspective { fov_y } => {
                let tan = (0.5 * fov_y).tan();
                Ray { origin: self.eye, direction: basis.forward + (x * tan) * basis.right + (y * tan) * basis.up }
            }
            Projection::Orthographic { height } => {
                let half = 0.5 * height;
                Ray { origin: self.eye + (x * half) * basis.right + (y * half) * basis.up, direction: basis.forward }
            }
        }
    }
}
