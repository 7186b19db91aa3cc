//! Where the eye is: in a face's plane, on an edge, at a vertex, inside, far away.

use glam::DVec3;

use super::super::scenery::{Cells, hills, outside, pair};
use super::super::{Case, Setup, Shot};
use super::{SIZE, SNAPPED, by_centroids, degrades};
use crate::error::Result;
use crate::scene::{Camera, Projection};
use crate::tet::TetMesh;

const DISTANCES: &[f64] = &[0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 0.1];

const PIECES: &str = "pieces of the cells around the eye have f32 vertices, 5e-4 of the depth at the near plane";

pub const CASES: &[Case] = &[
    Case {
        name: "edge-on",
        parameter: "tilt of faces against the rays, radians",
        values: &[0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3, 0.1],
        make: edge_on,
        integrals: &[],
        known: &[degrades(&["project", "project centroid", "cellcast"], [1e-5, 1e-5], 36.0, 0.3, SNAPPED)],
    },
    Case {
        name: "eye-at-face",
        parameter: "distance from a face's plane / a cell",
        values: DISTANCES,
        make: |distance| at(distance, 3),
        integrals: &[],
        known: &[by_centroids(60.0, 6e-3)],
    },
    Case {
        name: "eye-at-edge",
        parameter: "distance from an edge / a cell",
        values: DISTANCES,
        make: |distance| at(distance, 2),
        integrals: &[],
        known: &[
            by_centroids(59.0, 0.01),
            degrades(&["project"], [0.0, 1e-6], 76.0, 4e-3, PIECES),
            degrades(&["cellcast"], [0.0, 1e-9], 57.0, 0.05, PIECES),
        ],
    },
    Case {
        name: "eye-at-vertex",
        parameter: "distance from a vertex / a cell",
        values: DISTANCES,
        make: |distance| at(distance, 1),
        integrals: &[],
        known: &[
            by_centroids(54.0, 0.03),
            degrades(&["project"], [0.0, 1e-4], 74.0, 6e-3, PIECES),
            degrades(&["cellcast"], [0.0, 1e-6], 61.0, 0.04, PIECES),
        ],
    },
    Case {
        name: "eye-through-hull",
        parameter: "distance from the middle / that of the hull",
        values: &[0.0, 0.3, 0.7, 0.99, 0.999_999, 1.0, 1.000_001, 1.01],
        make: through_hull,
        integrals: &[],
        known: &[by_centroids(53.0, 0.03)],
    },
    Case {
        name: "near-plane",
        parameter: "near depth / the mesh's diagonal",
        values: &[0.0, 1e-9, 1e-6, 1e-4, 1e-2, 0.1],
        make: near_plane,
        integrals: &[],
        known: &[by_centroids(57.0, 0.02)],
    },
    Case {
        name: "eye-far",
        parameter: "distance / a cell",
        values: &[10.0, 1e2, 1e3, 1e4, 1e5, 1e6],
        make: far,
        integrals: &[],
        known: &[by_centroids(51.0, 0.06)],
    },
];

/// Edge length of a cube of [`cells`].
const CELL: f64 = 0.5;

fn cells() -> Cells {
    Cells::of_box(4, 0.15, hills)
}

/// Along the lattice's planes, with columns of pixels that lie in them.
fn edge_on(tilt: f64) -> Result<Setup> {
    let mesh = Cells::of_box(4, 0.0, hills).mesh()?;
    let projection = Projection::Orthographic { height: f64::from(SIZE[1]) / 20.0 };
    let eye = 3.0 * DVec3::new(tilt.sin(), 0.3 * tilt.sin(), tilt.cos());
    let camera = Camera { eye, target: DVec3::ZERO, up: DVec3::Y, projection, near: None };
    Ok(Shot { camera, transfer: pair(&mesh, 3.0), size: SIZE, mesh }.into())
}

/// Near the middle of the first so many corners of an inner cell, looking along what they span.
fn at(distance: f64, corners: usize) -> Result<Setup> {
    let mesh = cells().mesh()?;
    let cell = inner_cell(&mesh);
    let middle = cell[..corners].iter().sum::<DVec3>() / corners as f64;
    let normal = (cell[1] - cell[0]).cross(cell[2] - cell[0]).normalize();
    let eye = middle + distance * CELL * normal;
    let along = if corners == 1 { normal + 0.3 * (cell[1] - cell[0]) } else { cell[1] - cell[0] };
    let projection = Projection::Perspective { fov_y: 1.2 };
    let camera =
        Camera { eye, target: eye + along, up: normal + 0.4 * along.any_orthonormal_vector(), projection, near: None };
    Ok(Shot { camera, transfer: pair(&mesh, 4.0), size: SIZE, mesh }.into())
}

/// Corners of the cell nearest to the middle.
fn inner_cell(mesh: &TetMesh) -> [DVec3; 4] {
    let corners = |tet: &[u32; 4]| tet.map(|v| mesh.data_from_mesh(mesh.vertices[v as usize]));
    let far = |cell: &[DVec3; 4]| (cell.iter().sum::<DVec3>() / 4.0).length();
    mesh.tets.iter().map(corners).min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or_default()
}

fn through_hull(place: f64) -> Result<Setup> {
    let mesh = cells().mesh()?;
    let eye = place * DVec3::new(0.2, 0.1, 1.0);
    let projection = Projection::Perspective { fov_y: 1.4 };
    let camera = Camera { eye, target: eye - DVec3::new(0.3, 0.1, 1.0), up: DVec3::Y, projection, near: None };
    Ok(Shot { camera, transfer: pair(&mesh, 4.0), size: SIZE, mesh }.into())
}

fn near_plane(depth: f64) -> Result<Setup> {
    let mesh = cells().mesh()?;
    let near = Some(depth * mesh.bounds_in_data().diagonal());
    let eye = DVec3::new(0.13, -0.08, 0.21);
    let projection = Projection::Perspective { fov_y: 1.2 };
    let camera = Camera { eye, target: eye + DVec3::new(-0.5, 0.2, -1.0), up: DVec3::Y, projection, near };
    Ok(Shot { camera, transfer: pair(&mesh, 4.0), size: SIZE, mesh }.into())
}

/// Farther away through a longer lens.
fn far(distance: f64) -> Result<Setup> {
    let mesh = cells().mesh()?;
    let near_by = outside(&mesh);
    let away = (near_by.eye - near_by.target).normalize();
    let fov_y = 2.0 * (1.6 / (distance * CELL)).atan();
    let eye = near_by.target + distance * CELL * away;
    let camera = Camera { eye, projection: Projection::Perspective { fov_y }, ..near_by };
    Ok(Shot { camera, transfer: pair(&mesh, 3.0), size: SIZE, mesh }.into())
}
