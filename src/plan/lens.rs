//! Rays of a picture, in mesh space.

use glam::{DVec2, DVec3};

use crate::scene::{Basis, Camera, Projection};
use crate::tet::Domain;

/// A camera's axes in mesh space, which may be turned.
pub fn basis_in_mesh(camera: &Camera, mesh: &(impl Domain + ?Sized)) -> Basis {
    let turned = |axis| mesh.turn().transpose() * axis;
    let Basis { right, up, forward } = camera.basis();
    Basis { right: turned(right), up: turned(up), forward: turned(forward) }
}

/// A camera in mesh space. In its view axes (x right, y up, z forward, from the eye) the ray of film position `f` goes
/// through `(f.x, f.y, 1)`, from the eye for perspective and along z otherwise.
#[derive(Clone, Copy, Debug)]
pub struct Lens {
    /// Mesh space.
    pub eye: DVec3,
    /// Its directions.
    pub basis: Basis,
    /// Rays meet in the eye.
    pub perspective: bool,
    /// View depth, mesh units, where the picture begins.
    pub near: f64,
    /// The picture's upper left corner on the film.
    pub film_origin: DVec2,
    /// From pixel to pixel on the film.
    pub film_step: DVec2,
}

impl Lens {
    /// For a picture of `size` pixels.
    pub fn new(camera: &Camera, size: [u32; 2], mesh: &dyn Domain) -> Self {
        let [width, height] = size.map(f64::from);
        let (perspective, half) = match camera.projection {
            Projection::Perspective { fov_y } => (true, (0.5 * fov_y).tan()),
            Projection::Orthographic { height } => (false, 0.5 * height / mesh.data_per_mesh()),
        };
        let step = 2.0 * half / height;
        let near = camera.near_depth(mesh.bounds_in_data().diagonal()) / mesh.data_per_mesh();
        Self {
            eye: mesh.mesh_from_data(camera.eye),
            basis: basis_in_mesh(camera, mesh),
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
}
