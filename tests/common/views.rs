//! Where meshes are seen from, and the functions of one and two variables that they are seen by.

use glam::DVec3;
use tetralux::scene::{Camera, Curve, CurveNode, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::{TetId, TetMesh};

use super::meshes;

/// Outside in perspective and parallel; inside, where the near plane cuts cells.
pub fn three(mesh: &TetMesh) -> [Camera; 3] {
    let (target, diagonal) = meshes::center_and_diagonal(mesh);
    let camera = |away: DVec3, projection| {
        let eye = target + diagonal * away;
        Camera { eye, target, up: DVec3::Y, projection, near: None }
    };
    [
        camera(DVec3::new(0.7, 0.45, 0.85), Projection::Perspective { fov_y: 0.8 }),
        camera(DVec3::new(-0.5, 0.9, 0.3), Projection::Orthographic { height: 0.8 * diagonal }),
        camera(DVec3::new(0.03, -0.02, 0.05), Projection::Perspective { fov_y: 1.2 }),
    ]
}

/// Four views: from outside, from far above, and two from within a cell.
pub fn four(mesh: &TetMesh) -> [(&'static str, Camera); 4] {
    let (center, diagonal) = meshes::center_and_diagonal(mesh);
    let camera = |eye, target, fov_y| {
        let projection = Projection::Perspective { fov_y };
        Camera { eye, target, up: DVec3::new(0.1, 0.2, 0.9), projection, near: None }
    };
    let away = |x, y, z| center + diagonal * DVec3::new(x, y, z);
    let centroid = |tet: u32| mesh.data_from_mesh(mesh.corners(TetId(tet)).iter().sum::<DVec3>() / 4.0);
    // In the cell around the place, more or less.
    let within = |x, y, z| {
        let far = |tet: &u32| centroid(*tet).distance(away(x, y, z));
        let nearest = (0..mesh.tets.len() as u32).min_by(|a, b| far(a).total_cmp(&far(b)));
        centroid(nearest.expect("cells"))
    };
    [
        ("outside", camera(away(0.6, 0.5, 0.7), center, 0.7)),
        ("above", camera(away(-0.3, 2.0, 1.4), center, 0.4)),
        ("inside", camera(within(0.07, 0.05, 0.04), within(-0.3, 0.1, 0.1), 1.2)),
        ("inside, wide", camera(within(-0.11, 0.03, -0.05), within(0.4, -0.1, 0.05), 1.7)),
    ]
}

/// Bands and slopes of several colours.
pub fn curve(mesh: &TetMesh) -> TransferFunction {
    let s = mesh.scalar_range();
    let (_, diagonal) = meshes::center_and_diagonal(mesh);
    let nodes = [
        (0.0, 0.5, [0.1, 0.2, 0.9]),
        (0.25, 3.0, [0.1, 0.9, 0.8]),
        (0.3, 25.0, [1.0, 0.3, 0.1]),
        (0.36, 1.0, [0.9, 0.9, 0.2]),
        (1.0, 12.0, [0.3, 1.0, 0.3]),
    ];
    let node = |(x, depth, color): (f64, f64, [f64; 3])| CurveNode {
        scalar: s.min + x * s.length(),
        color,
        extinction: depth / diagonal,
    };
    TransferFunction::Curve(Curve { nodes: nodes.map(node).to_vec() })
}

/// Two Gaussians over scalar and gradient magnitude, and a wave, of three colours.
pub fn widgets(mesh: &TetMesh) -> TransferFunction {
    let (s, g) = (mesh.scalar_range(), mesh.gradient_range());
    let (_, diagonal) = meshes::center_and_diagonal(mesh);
    let gaussian = |at: [f64; 2], width: [f64; 2]| WidgetShape::Gaussian {
        center: [s.min + at[0] * s.length(), g.min + at[1] * g.length()],
        sigma: [width[0] * s.length(), width[1] * g.length()],
        angle: 0.0,
    };
    let wave = WidgetShape::Triangle {
        direction: [1.0 / s.length(), 0.0],
        offset: s.min / s.length(),
        period: 0.25,
        duty: 0.5,
    };
    TransferFunction::Widgets(vec![
        Widget::new(gaussian([0.35, 0.1], [0.08, 0.15]), [1.0, 0.6, 0.1], 30.0 / diagonal),
        Widget::new(gaussian([0.7, 0.3], [0.1, 0.3]), [0.2, 0.4, 1.0], 40.0 / diagonal),
        Widget::new(wave, [0.2, 0.9, 0.3], 4.0 / diagonal),
    ])
}
