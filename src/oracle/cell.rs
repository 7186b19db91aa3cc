//! One tetrahedron against one ray: the interval inside, and the fields at its ends.

use glam::DVec3;

use crate::space::{Interval, Ray};

/// Outward faces of a positively oriented tetrahedron: face `k` is opposite vertex `k` and turns counter-clockwise
/// when seen from outside.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// A triangle's plane as both of its cells compute it, from its vertices in the order of their ids: the same bits for
/// both, hence the same entry and exit; `outward` then differs in sign alone.
#[derive(Clone, Copy, Debug, Default)]
struct Face {
    vertices: [usize; 3],
    normal: DVec3,
    offset: f64,
    outward: f64,
}

/// A tetrahedron in view axes.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// Its index in the mesh.
    pub id: u32,
    corners: [DVec3; 4],
    /// (scalar, gradient magnitude) at the corners.
    fields: [[f64; 2]; 4],
    /// Gradient vectors at the corners, view axes; where they are needed.
    gradients: Option<[DVec3; 4]>,
    faces: [Face; 4],
}

/// Where a ray is inside a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// View depth of entry and exit, `enter < exit`.
    pub enter: f64,
    /// See `enter`.
    pub exit: f64,
    /// Index of the face of entry; `None` where the picture begins inside the cell.
    enter_face: Option<u8>,
    /// Index of the face of exit.
    exit_face: u8,
}

impl Cell {
    /// `ids` are the mesh's vertices, `corners` their positions in view axes (a left-handed system), `fields` their
    /// scalar and gradient magnitude, `gradients` their gradient vectors in view axes. Positively oriented in data space.
    pub fn new(
        id: u32,
        ids: [u32; 4],
        corners: [DVec3; 4],
        fields: [[f64; 2]; 4],
        gradients: Option<[DVec3; 4]>,
    ) -> Self {
        let faces = FACES.map(|face| {
            let mut vertices = face;
            vertices.sort_unstable_by_key(|&v| ids[v]);
            let even = (0..3).any(|turn| (0..3).all(|i| vertices[i] == face[(i + turn) % 3]));
            let [a, b, c] = vertices.map(|v| corners[v]);
            let normal = (b - a).cross(c - a);
            // Counter-clockwise in data space is clockwise in view axes, where z points away from the eye.
            Face { vertices, normal, offset: normal.dot(a), outward: if even { -1.0 } else { 1.0 } }
        });
        Self { id, corners, fields, gradients, faces }
    }

    /// The part of `ray` beyond `near` that lies inside; `None` where it has no length.
    ///
    /// A ray that lies exactly in a face's plane belongs to one of the two cells there: the one it would be in if its
    /// pixel were moved right by an infinitesimal, and up by an infinitesimal of that.
    pub fn clip(&self, ray: &Ray, near: f64) -> Option<Crossing> {
        let (mut enter, mut exit) = (near, f64::INFINITY);
        let (mut enter_face, mut exit_face) = (None, 0);
        for (index, face) in (0u8..).zip(&self.faces) {
            let approach = face.outward * face.normal.dot(ray.direction);
            let inside = face.outward * (face.offset - face.normal.dot(ray.origin));
            if approach < 0.0 {
                let t = inside / approach;
                if t > enter {
                    (enter, enter_face) = (t, Some(index));
                }
            } else if approach > 0.0 {
                let t = inside / approach;
                if t < exit {
                    (exit, exit_face) = (t, index);
                }
            } else if inside < 0.0 || (inside == 0.0 && face.outward * tie_breaker(face.normal) > 0.0) {
                return None;
            }
        }
        (enter < exit && exit < f64::INFINITY).then_some(Crossing { enter, exit, enter_face, exit_face })
    }

    /// (scalar, gradient magnitude) where the ray enters and leaves.
    pub fn fields_at_ends(&self, ray: &Ray, crossing: &Crossing) -> [[f64; 2]; 2] {
        self.weights_at_ends(ray, crossing).map(|weights| self.mix(&weights))
    }

    /// The gradient, interpolated linearly, halfway between entry and exit; `None` where the corners have none.
    pub fn gradient_midway(&self, ray: &Ray, crossing: &Crossing) -> Option<DVec3> {
        let gradients = self.gradients?;
        // What is linear is in the middle the mean of its ends.
        let ends = self.weights_at_ends(ray, crossing);
        Some(ends.iter().flatten().map(|&(v, weight)| 0.5 * weight * gradients[v]).sum())
    }

    /// Corners and their weights where the ray enters and leaves.
    fn weights_at_ends(&self, ray: &Ray, crossing: &Crossing) -> [[(usize, f64); 4]; 2] {
        let point = |t: f64| ray.origin + t * ray.direction;
        let front = match crossing.enter_face {
            Some(face) => self.weights_on_face(face, point(crossing.enter)),
            None => self.weights_inside(point(crossing.enter)),
        };
        [front, self.weights_on_face(crossing.exit_face, point(crossing.exit))]
    }

    /// In the face's triangle, which stays well conditioned where the cell is flat.
    fn weights_on_face(&self, face: u8, point: DVec3) -> [(usize, f64); 4] {
        let Face { vertices, normal, .. } = self.faces[usize::from(face)];
        let [a, b, c] = vertices.map(|v| self.corners[v]);
        let area = normal.length_squared();
        let toward_b = (point - a).cross(c - a).dot(normal) / area;
        let toward_c = (b - a).cross(point - a).dot(normal) / area;
        let opposite = (usize::from(face), 0.0);
        [(vertices[0], 1.0 - toward_b - toward_c), (vertices[1], toward_b), (vertices[2], toward_c), opposite]
    }

    /// By the distances from the four faces.
    fn weights_inside(&self, point: DVec3) -> [(usize, f64); 4] {
        let mut weights = [(0, 0.0); 4];
        for (v, face) in self.faces.iter().enumerate() {
            let height = face.normal.dot(self.corners[v]) - face.offset;
            weights[v] = (v, (face.normal.dot(point) - face.offset) / height);
        }
        weights
    }

    /// The weighted sum, kept within the corners' range, which rounding could leave.
    fn mix(&self, weights: &[(usize, f64)]) -> [f64; 2] {
        std::array::from_fn(|i| {
            let range = Interval::of(self.fields.map(|f| f[i]));
            weights.iter().map(|&(v, weight)| weight * self.fields[v][i]).sum::<f64>().max(range.min).min(range.max)
        })
    }
}

/// The first component that is not 0 along pixel x, then y. The view's y axis points up.
fn tie_breaker(normal: DVec3) -> f64 {
    if normal.x != 0.0 { normal.x } else { normal.y }
}
