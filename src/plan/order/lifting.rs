//! Whether a mesh is the lower hull of points lifted by a quadratic form, and by which.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::plan::order::Metric;
use crate::plan::order::face::{Across, Face};
use crate::plan::order::nearest::{Form, dot, nearest_to_origin};
use crate::tet::{Adjacency, FACES, Finding, TetId, TetMesh, six_volumes};

/// How far off a coordinate in mesh space is counted to be: the rounding that its making left, and that of the sums
/// here.
const ROUNDING: f64 = 4.0 * 0.5 * f64::EPSILON;
/// Faces to begin with.
const SAMPLE: usize = 32_768;
/// Faces that a round adds.
const ADDED: usize = 4096;
/// Rounds of finding a metric and looking for faces that it fails. Measured: 1 to 3 until none does, of 43,000
/// faces half of which it began with.
const MOST_ROUNDS: usize = 12;

/// How the lifted faces meet.
#[derive(Clone, Debug, Default)]
pub(super) struct Lifting {
    /// Interior faces between cells that do not overlap.
    pub faces: u64,
    /// Pairs that lie on one side of their face.
    pub folds: u64,
    /// Cells and corners of faces where it is not convex.
    pub concave: Vec<(u32, u8)>,
    /// The same of faces where that cannot be told.
    pub flat: Vec<(u32, u8)>,
}

impl Lifting {
    /// Lifts every vertex v by `v . M v` and looks at all interior faces.
    pub fn new(mesh: &TetMesh, adjacency: &Adjacency, metric: &Metric) -> Self {
        let add = |mut lifting: Self, tet: usize| {
            lifting.add_faces_of(mesh, adjacency, metric, tet);
            lifting
        };
        (0..mesh.tets.len()).into_par_iter().fold(Self::default, add).reduce(Self::default, Self::merge)
    }

    fn add_faces_of(&mut self, mesh: &TetMesh, adjacency: &Adjacency, metric: &Metric, tet: usize) {
        for corner in 0..4 {
            let p = match pair(mesh, adjacency, tet, corner) {
                Pair::None => continue,
                Pair::Fold => {
                    self.folds += 1;
                    continue;
                }
                Pair::Beyond(p) => p,
            };
            self.faces += 1;
            let (height, tolerance) = height(mesh.corners(TetId(tet as u32)), p, metric);
            if height > tolerance {
                continue;
            }
            let failed = if height < -tolerance { &mut self.concave } else { &mut self.flat };
            failed.push((tet as u32, corner as u8));
        }
    }

    /// In the order of cells.
    fn merge(mut self, other: Self) -> Self {
        self.faces += other.faces;
        self.folds += other.folds;
        self.concave.extend(other.concave);
        self.flat.extend(other.flat);
        self
    }

    /// The best metric that is found: Euclid's where that makes all faces convex, otherwise one that does, otherwise
    /// whichever of those tried fails the fewest.
    pub fn find(mesh: &TetMesh, adjacency: &Adjacency) -> (Metric, Self) {
        let euclid = (Metric::IDENTITY, Self::new(mesh, adjacency, &Metric::IDENTITY));
        if euclid.1.failures() == 0 {
            return euclid;
        }
        let whitening = Whitening::new(mesh);
        let mut forms = whitening.sample(mesh, adjacency);
        // Cells that share no face may be most of the sample, or all.
        whitening.add(mesh, adjacency, &euclid.1, &mut forms);
        let mut best = euclid;
        let mut keep = |metric: Metric, lifting: Self| {
            if lifting.failures() < best.1.failures() {
                best = (metric, lifting);
            }
            best.1.failures() == 0
        };
        for _ in 0..MOST_ROUNDS {
            let Some(form) = nearest_to_origin(&forms) else { break };
            let metric = whitening.metric(&form);
            let lifting = Self::new(mesh, adjacency, &metric);
            whitening.add(mesh, adjacency, &lifting, &mut forms);
            if keep(metric, lifting) {
                return best;
            }
        }
        // None makes all convex: at least not one that is far from the mesh's own proportions.
        let metric = whitening.metric(&[1.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
        keep(metric, Self::new(mesh, adjacency, &metric));
        best
    }

    /// Count and first of some faces.
    pub fn finding(faces: &[(u32, u8)]) -> Finding {
        Finding { count: faces.len() as u64, first: faces.first().map(|(tet, _)| format!("tetrahedron {tet}")) }
    }

    fn failures(&self) -> usize {
        self.concave.len() + self.flat.len()
    }
}

enum Pair {
    None,
    Fold,
    /// The neighbour's vertex that is not on the face.
    Beyond(DVec3),
}

/// Each pair once: seen from the smaller cell.
fn pair(mesh: &TetMesh, adjacency: &Adjacency, tet: usize, corner: usize) -> Pair {
    let neighbor = adjacency.neighbors[tet][corner] as usize;
    if neighbor <= tet || neighbor >= mesh.tets.len() {
        return Pair::None;
    }
    match Across::new(mesh, adjacency, tet, corner, &Face::new(mesh.tets[tet], corner)) {
        Across::Open => Pair::None,
        Across::Fold(_) => Pair::Fold,
        Across::Cell(_, opposite) => Pair::Beyond(mesh.vertices[mesh.tets[neighbor][opposite] as usize]),
    }
}

/// Barycentric coordinates of the origin.
fn weights(corners: [DVec3; 4]) -> [f64; 4] {
    let volume = six_volumes(corners);
    std::array::from_fn(|i| {
        let mut moved = corners;
        moved[i] = DVec3::ZERO;
        six_volumes(moved) / volume
    })
}

/// How high `p` is lifted above the affine function L through a cell's lifted corners, and how much of that moving all
/// points by [`ROUNDING`] along each axis may change: for Euclid's metric, the power of p to the circumsphere.
///
/// With p's barycentric coordinates w and u = v - p, the height is `-sum w (u . M u)`: no difference of large numbers.
/// Its derivative by p is `2 M p - grad L`, by a corner v it is `-w (2 M v - grad L)`.
fn height(corners: [DVec3; 4], p: DVec3, metric: &Metric) -> (f64, f64) {
    let from_p = corners.map(|v| v - p);
    let (w, squares) = (weights(from_p), from_p.map(|u| metric.square(u)));
    let height = -(0..4).map(|i| w[i] * squares[i]).sum::<f64>();
    let gradient = gradient(from_p, squares);
    let corner_changes = (0..4).map(|i| w[i].abs() * (2.0 * (metric.matrix * from_p[i]) - gradient).length());
    let change = gradient.length() + corner_changes.sum::<f64>();
    (height, 3_f64.sqrt() * ROUNDING * change)
}

/// Gradient of the affine function with these values at a cell's corners.
pub(super) fn gradient(corners: [DVec3; 4], values: [f64; 4]) -> DVec3 {
    let inward = |i: usize| {
        let [a, b, c] = FACES[i].map(|k| corners[k]);
        (c - a).cross(b - a)
    };
    // Values relative to one corner's, so that a common part does not round.
    (1..4).map(|i| (values[i] - values[0]) * inward(i)).sum::<DVec3>() / six_volumes(corners)
}

/// Linear coordinates in which the mesh's edges are as long in all directions, so that the inequalities of stretched
/// meshes do not all point one way.
struct Whitening {
    white_from_mesh: DMat3,
}

impl Whitening {
    fn new(mesh: &TetMesh) -> Self {
        let step = mesh.tets.len().div_ceil(SAMPLE).max(1);
        let mut covariance = DMat3::ZERO;
        for tet in (0..mesh.tets.len()).step_by(step) {
            let corners = mesh.corners(TetId(tet as u32));
            for i in 0..4 {
                let edge = corners[(i + 1) % 4] - corners[i];
                covariance += DMat3::from_cols(edge * edge.x, edge * edge.y, edge * edge.z);
            }
        }
        // Cholesky's triangle, by rows.
        let [x, y, z] = [covariance.x_axis, covariance.y_axis, covariance.z_axis];
        let a = x.x.sqrt();
        let (b, c) = (x.y / a, x.z / a);
        let d = (y.y - b * b).sqrt();
        let e = (y.z - b * c) / d;
        let f = (z.z - c * c - e * e).sqrt();
        let lower = DMat3::from_cols(DVec3::new(a, b, c), DVec3::new(0.0, d, e), DVec3::new(0.0, 0.0, f));
        let inverse = lower.inverse();
        Self { white_from_mesh: if inverse.is_finite() { inverse } else { DMat3::IDENTITY } }
    }

    fn sample(&self, mesh: &TetMesh, adjacency: &Adjacency) -> Vec<Form> {
        // Two interior faces a cell, each seen from one of its cells.
        let step = (2 * mesh.tets.len()).div_ceil(SAMPLE).max(1);
        let cells = (0..mesh.tets.len()).step_by(step);
        cells.flat_map(|tet| (0..4).filter_map(move |i| self.form(mesh, adjacency, tet, i))).collect()
    }

    /// Adds up to [`ADDED`] of the faces that fail.
    fn add(&self, mesh: &TetMesh, adjacency: &Adjacency, lifting: &Lifting, forms: &mut Vec<Form>) {
        let step = lifting.failures().div_ceil(ADDED).max(1);
        let failed = lifting.concave.iter().chain(&lifting.flat).step_by(step);
        forms.extend(failed.filter_map(|&(tet, corner)| self.form(mesh, adjacency, tet as usize, corner.into())));
    }

    /// The vector whose product with a metric (off-diagonal entries times the root of 2) is positive where the lifting
    /// is convex, of length 1.
    fn form(&self, mesh: &TetMesh, adjacency: &Adjacency, tet: usize, corner: usize) -> Option<Form> {
        let Pair::Beyond(p) = pair(mesh, adjacency, tet, corner) else { return None };
        let from_p = mesh.corners(TetId(tet as u32)).map(|v| v - p);
        let w = weights(from_p);
        let mut form = [0.0; 6];
        for i in 0..4 {
            let u = self.white_from_mesh * from_p[i];
            let root = std::f64::consts::SQRT_2;
            let products = [u.x * u.x, u.y * u.y, u.z * u.z, root * u.x * u.y, root * u.x * u.z, root * u.y * u.z];
            form.iter_mut().zip(products).for_each(|(sum, product)| *sum -= w[i] * product);
        }
        let length = dot(&form, &form).sqrt();
        let form = form.map(|v| v / length);
        form.iter().all(|v| v.is_finite()).then_some(form)
    }

    /// In mesh space.
    fn metric(&self, form: &Form) -> Metric {
        let [xx, yy, zz, xy, xz, yz] = *form;
        let [xy, xz, yz] = [xy, xz, yz].map(|v| v * std::f64::consts::FRAC_1_SQRT_2);
        let white = DMat3::from_cols(DVec3::new(xx, xy, xz), DVec3::new(xy, yy, yz), DVec3::new(xz, yz, zz));
        let matrix = self.white_from_mesh.transpose() * white * self.white_from_mesh;
        // Symmetric to the bit.
        Metric::scaled(0.5 * (matrix + matrix.transpose()))
    }
}
