//! How wrong an order is.

use std::ops::Add;

use glam::DVec3;
use rayon::prelude::*;

use crate::plan::order::face::{Across, Face};
use crate::plan::order::{Vantage, VisibilityOrder};
use crate::scene::{Camera, Projection};
use crate::tet::{Adjacency, TetId, TetMesh};

/// Neighbours, and those in the wrong order: the eye, strictly on one cell's side of the shared face's plane, sees that
/// cell before the other.
///
/// Neighbours whose plane holds the eye within rounding are not counted, nor those on one side of their face.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Inversions {
    /// Neighbours one of which hides the other.
    pub pairs: u64,
    /// Of these, those where it is drawn first.
    pub wrong: u64,
}

/// The rank of a cell that was not drawn.
const NOT_DRAWN: u32 = u32::MAX;

impl Inversions {
    pub(super) fn count(mesh: &TetMesh, adjacency: &Adjacency, vantage: &Vantage, ranks: &[u32]) -> Self {
        let of_cell = |tet: usize| {
            let mut counted = Self::default();
            for (corner, &neighbor) in adjacency.neighbors[tet].iter().enumerate() {
                // Each pair once; the boundary has the largest number.
                if neighbor as usize <= tet || neighbor as usize >= ranks.len() {
                    continue;
                }
                if ranks[tet] == NOT_DRAWN || ranks[neighbor as usize] == NOT_DRAWN {
                    continue;
                }
                let face = Face::new(mesh.tets[tet], corner);
                let side = face.side(mesh, vantage);
                if side == 0 || matches!(Across::new(mesh, adjacency, tet, corner, &face), Across::Fold(_)) {
                    continue;
                }
                let is_drawn_later = ranks[tet] > ranks[neighbor as usize];
                counted.pairs += 1;
                counted.wrong += u64::from(is_drawn_later != (side < 0));
            }
            counted
        };
        (0..mesh.tets.len()).into_par_iter().map(of_cell).reduce(Self::default, Self::add)
    }

    /// Of some of a mesh's cells, listed back to front. What is no cell of the mesh is passed over.
    pub fn of_drawn(mesh: &TetMesh, adjacency: &Adjacency, camera: &Camera, drawn: &[u32]) -> Self {
        let mut ranks = vec![NOT_DRAWN; mesh.tets.len()];
        for (rank, &cell) in (0..).zip(drawn) {
            if let Some(place) = ranks.get_mut(cell as usize) {
                *place = rank;
            }
        }
        Self::count(mesh, adjacency, &Vantage::new(mesh, camera), &ranks)
    }

    /// The wrong ones' share; 0 where there are no pairs.
    pub fn share(&self) -> f64 {
        self.wrong as f64 / self.pairs.max(1) as f64
    }
}

impl Add for Inversions {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { pairs: self.pairs + other.pairs, wrong: self.wrong + other.wrong }
    }
}

/// Cameras that look at the mesh's centre: in turn perspective ones around the mesh, ones within it, and parallel ones.
/// The same for every call; more only add to fewer.
pub fn sample_cameras(mesh: &TetMesh, count: usize) -> Vec<Camera> {
    let bounds = mesh.bounds_in_data();
    let (center, diagonal) = (bounds.center(), bounds.diagonal());
    // Multiples of irrational numbers fill the unit cube evenly (Roberts 2018, after Kronecker).
    const PLASTIC: [f64; 3] = [0.819_172_513_396_164_4, 0.671_043_606_703_789_3, 0.549_700_477_901_970_4];
    let camera = |i: usize| {
        let [u, v, w] = PLASTIC.map(|step| (0.5 + step * (i + 1) as f64).fract());
        let (azimuth, z) = (std::f64::consts::TAU * u, 2.0 * v - 1.0);
        let r = (1.0 - z * z).sqrt();
        let direction = DVec3::new(r * azimuth.cos(), r * azimuth.sin(), z);
        let cell = TetId((w * mesh.tets.len() as f64) as u32);
        let perspective = Projection::Perspective { fov_y: 1.0 };
        let (eye, projection) = match i % 3 {
            0 => (center + (0.6 + 2.0 * w) * diagonal * direction, perspective),
            // The mean of a cell's corners, off the middle, lies within.
            1 if !mesh.tets.is_empty() => {
                let [a, b, c, d] = mesh.corners(cell);
                (mesh.data_from_mesh(0.4 * a + 0.3 * b + 0.2 * c + 0.1 * d), perspective)
            }
            _ => (center + diagonal * direction, Projection::Orthographic { height: diagonal }),
        };
        let target = if eye == center { center + direction } else { center };
        let up = (target - eye).normalize().any_orthonormal_vector();
        Camera { eye, target, up, projection, near: None }
    };
    (0..count).map(camera).collect()
}

/// Tests orders for [`sample_cameras`], all together.
pub fn sampled_inversions(
    mesh: &TetMesh,
    adjacency: &Adjacency,
    count: usize,
    mut order: impl FnMut(&Camera) -> VisibilityOrder,
) -> Inversions {
    let cameras = sample_cameras(mesh, count);
    cameras.iter().map(|c| order(c).inversions(mesh, adjacency, c)).fold(Inversions::default(), Inversions::add)
}
