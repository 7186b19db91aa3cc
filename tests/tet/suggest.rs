//! The transfer function for a mesh without a scene.

use tetralux::mesh::Mesh;
use tetralux::scene::{TransferFunction, Widget, WidgetShape, suggest};
use tetralux::tet::{JointHistogram, TetId, TetMesh};

use crate::support::{build, grid};

fn widgets(mesh: &TetMesh) -> Vec<Widget> {
    match suggest(mesh, &JointHistogram::new(mesh, [256, 256])) {
        TransferFunction::Widgets(widgets) => widgets,
        TransferFunction::Curve(curve) => panic!("{curve:?}"),
    }
}

fn profile(widget: &Widget, s: f64, g: f64) -> f64 {
    match widget.shape {
        WidgetShape::Uniform => 1.0,
        WidgetShape::Gaussian { center, sigma, .. } => {
            (-0.5 * (((s - center[0]) / sigma[0]).powi(2) + ((g - center[1]) / sigma[1]).powi(2))).exp()
        }
        ref other => panic!("no suggestion is made of {other:?}"),
    }
}

/// Optical depth along the box's diagonal if the extinction were spread evenly, from values at the centroids: another
/// way than the histogram's.
fn depth_along_diagonal(mesh: &TetMesh, widgets: &[Widget]) -> f64 {
    let mut sums = (0.0, 0.0);
    for t in 0..mesh.tets.len() {
        let mean = |values: &[f64]| mesh.tets[t].iter().map(|&v| values[v as usize]).sum::<f64>() / 4.0;
        let (s, g) = (mean(&mesh.scalar), mean(&mesh.gradient_magnitude));
        let volume = mesh.volume_in_data(TetId(t as u32));
        sums.0 += volume * widgets.iter().map(|w| w.extinction * profile(w, s, g)).sum::<f64>();
        sums.1 += volume;
    }
    sums.0 / sums.1 * mesh.bounds_in_data().diagonal()
}

fn with_field(field: impl Fn(f64, f64, f64) -> f64) -> Mesh {
    let mut mesh = grid([21, 21, 21]);
    mesh.arrays[0].values = mesh.points.iter().map(|p| field(p.x - 0.5, p.y - 0.5, p.z - 0.5)).collect();
    mesh
}

#[test]
fn every_kind_of_field_shows_and_none_is_opaque() {
    let ball = |x: f64, y: f64, z: f64| (-20.0 * ((x * x + y * y + z * z).sqrt() - 0.3)).tanh();
    let fields: [(&str, Mesh); 8] = [
        ("linear", with_field(|x, _, _| x)),
        ("radius", with_field(|x, y, z| (x * x + y * y + z * z).sqrt())),
        ("ball", with_field(ball)),
        ("waves", with_field(|x, y, z| (9.0 * x).sin() * (7.0 * y).cos() + z)),
        ("huge", with_field(|x, y, z| 1e20 * (x * x + y + z))),
        ("tiny", with_field(|x, y, z| 1e-20 * (x * x + y + z))),
        ("offset", with_field(|x, y, z| 1e6 + 1e-3 * (x * x + y + z))),
        ("spike", with_field(|x, y, z| (-4000.0 * (x * x + y * y + z * z)).exp())),
    ];
    for (name, mesh) in fields {
        let (mesh, _) = build(mesh);
        let widgets = widgets(&mesh);
        assert!((1..=4).contains(&widgets.len()), "{name} {widgets:?}");
        let depth = depth_along_diagonal(&mesh, &widgets);
        // Measured: 3.1 to 3.3; the spike, all but a point of which is one homogeneous region, 1.3.
        let least = if name == "spike" { 0.5 } else { 2.5 };
        assert!(depth > least && depth < 4.0, "{name} {depth} {widgets:?}");
        assert!(widgets.iter().all(|w| w.extinction > 0.0 && w.extinction.is_finite()));
        assert!(widgets.windows(2).all(|w| w[0].color != w[1].color));
    }
}

#[test]
fn the_boundary_of_a_ball_is_found() {
    let ball = |x: f64, y: f64, z: f64| (-20.0 * ((x * x + y * y + z * z).sqrt() - 0.3)).tanh();
    let (mesh, _) = build(with_field(ball));
    let peak = widgets(&mesh)
        .into_iter()
        .filter_map(|w| match w.shape {
            WidgetShape::Gaussian { center, .. } => Some(center),
            _ => None,
        })
        .max_by(|a, b| a[1].total_cmp(&b[1]))
        .unwrap();
    // The steepest place: value 0, gradient 20 (less what the grid smooths).
    assert!(peak[0].abs() < 0.5 && peak[1] > 8.0, "{peak:?}");
}

#[test]
fn a_constant_field_gets_a_uniform_widget_at_any_scale() {
    for scale in [1e-20, 1.0, 1e20] {
        let mut mesh = with_field(|_, _, _| 3.0);
        mesh.points.iter_mut().for_each(|p| *p *= scale);
        let (mesh, _) = build(mesh);
        let widgets = widgets(&mesh);
        assert_eq!((widgets.len(), &widgets[0].shape), (1, &WidgetShape::Uniform));
        let depth = depth_along_diagonal(&mesh, &widgets);
        assert!(depth > 2.0 && depth < 4.0, "{depth}");
    }
}
