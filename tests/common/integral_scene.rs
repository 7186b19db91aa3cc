//! What pictures by every integral are made of.

use glam::DVec3;
use tetralux::scene::{Camera, Curve, CurveNode, Projection, TransferFunction};
use tetralux::tet::TetMesh;

use super::meshes;

/// Sees most of the mesh.
pub fn camera(mesh: &TetMesh) -> Camera {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let eye = target + diagonal * DVec3::new(0.7, 0.45, 0.85);
    Camera { eye, target, up: DVec3::Y, projection: Projection::Perspective { fov_y: 0.8 }, near: None }
}

/// A thin band among gentle slopes.
pub fn curve(mesh: &TetMesh) -> TransferFunction {
    let s = mesh.scalar_range();
    let (_, diagonal) = meshes::center_and_diagonal(mesh);
    let nodes = [
        (0.0, 0.0, [0.0, 0.0, 1.0]),
        (0.3, 2.0, [0.0, 1.0, 1.0]),
        (0.32, 60.0, [1.0, 0.2, 0.0]),
        (0.35, 2.0, [1.0, 1.0, 0.0]),
        (1.0, 15.0, [0.2, 1.0, 0.2]),
    ];
    let node = |(x, depth, color): (f64, f64, [f64; 3])| CurveNode {
        scalar: s.min + x * s.length(),
        color,
        extinction: depth / diagonal,
    };
    TransferFunction::Curve(Curve { nodes: nodes.map(node).to_vec() })
}
