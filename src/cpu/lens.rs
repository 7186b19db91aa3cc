//! Rays of a picture, in mesh space, and the axes of one ray.

use glam::{DVec2, DVec3, Vec4, Vec4Swizzles as _};

use crate::cpu::mesh::CellMesh;
use crate::scene::{Basis, Camera, Projection};

/// A camera in mesh space. In its view axes (x right, y up, z forward, from the eye) the ray of film position `f` goes
/// through `(f.x, f.y, 1)`, from the eye for perspective and along z otherwise.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    pub eye: DVec3,
    pub basis: Basis,
    pub perspective: bool,
    /// View depth, mesh units, where the picture begins.
    pub near: f64,
    film_origin: DVec2,
    film_step: DVec2,
}

impl Lens {
    /// `mesh_diagonal`: data units.
    pub fn new(camera: &Camera, size: [u32; 2], mesh: &CellMesh, mesh_diagonal: f64) -> Self {
        let [width, height] = size.map(f64::from);
        let (perspective, half) = match camera.projection {
            Projection::Perspective { fov_y } => (true, (0.5 * fov_y).tan()),
            Projection::Orthographic { height } => (false, 0.5 * height / mesh.data_per_mesh),
        };
        let step = 2.0 * half / height;
        let near = camera.near_depth(mesh_diagonal) / mesh.data_per_mesh;
        Self {
            eye: (camera.eye - mesh.center_in_data) / mesh.data_per_mesh,
            basis: camera.basis(),
            perspective,
            // Nothing is seen behind the eye, whatever was asked.
            near: if perspective { near.max(0.0) } else { near },
            film_origin: DVec2::new(-0.5 * width * step, 0.5 * height * step),
            film_step: DVec2::new(step, -step),
        }
    }

    /// One parallel ray: at film position (0, 0).
    pub fn along(origin: DVec3, direction: DVec3, near: f64) -> Self {
        let forward = direction.normalize();
        let (right, up) = forward.any_orthonormal_pair();
        // A left-handed pair, as cameras have it.
        let up = if right.cross(up).dot(forward) > 0.0 { -up } else { up };
        let zero = DVec2::ZERO;
        let basis = Basis { right, up, forward };
        Self { eye: origin, basis, perspective: false, near, film_origin: zero, film_step: zero }
    }

    /// Where a pixel's centre lies on the film.
    pub fn film(&self, pixel: [u32; 2]) -> DVec2 {
        self.film_origin + self.film_step * DVec2::new(f64::from(pixel[0]) + 0.5, f64::from(pixel[1]) + 0.5)
    }

    /// The pixel position of a film position.
    pub fn pixel(&self, film: DVec2) -> DVec2 {
        (film - self.film_origin) / self.film_step
    }

    /// Of a pixel, on the film.
    pub fn pixel_size(&self) -> f64 {
        self.film_step.x
    }

    /// A point in view axes.
    pub fn view(&self, p: DVec3) -> DVec3 {
        let from_eye = p - self.eye;
        let Basis { right, up, forward } = self.basis;
        DVec3::new(from_eye.dot(right), from_eye.dot(up), from_eye.dot(forward))
    }

    /// The axes of the ray through a film position.
    pub fn ray(&self, film: DVec2) -> RayAxes {
        let Basis { right, up, forward } = self.basis;
        let across = film.x * right + film.y * up;
        let (origin, direction) = match self.perspective {
            true => (self.eye, forward + across),
            false => (self.eye + across, forward),
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
        RayAxes {
            x: axis(|v| v.x),
            y: axis(|v| v.y),
            z: axis(|v| v.z),
            offset: Vec4::new(offset(right), offset(up), offset(along), 0.0),
            near: (self.near * length - start) as f32,
        }
    }
}

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
}

impl RayAxes {
    /// `vertex`: position and scalar.
    #[inline(always)]
    pub fn apply(&self, vertex: Vec4) -> Vec4 {
        // The multiplications by 0 leave the scalar as it is.
        self.x * vertex.xxxx()
            + self.y * vertex.yyyy()
            + (self.z * vertex.zzzz() + (self.offset + vertex * Vec4::new(0.0, 0.0, 0.0, 1.0)))
    }
}
