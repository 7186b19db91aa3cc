//! Dropping voxels that the function leaves empty changes no picture, and most of the empty ones are dropped.

use glam::DVec3;
use tetralux::image::Comparison;
use tetralux::renderer::Settings;
use tetralux::scene::{Curve, CurveNode, TransferFunction, Widget, WidgetShape};
use tetralux::space::Bounds;
use tetralux::tet::Domain as _;

use crate::common::gpu::cells;
use crate::grids::{PERSPECTIVE, STRUCTURED, both, draw, lattice, octants, renderer};

#[test]
fn what_is_dropped_is_not_seen() {
    let blob = |p: DVec3| (-3.0 * (p - DVec3::new(1.1, 0.9, 1.4)).length_squared()).exp();
    let (grid, mesh) = both(&lattice([26, 24, 19], DVec3::ZERO, DVec3::splat(0.11), blob));
    let range = grid.scalar_range();
    let node =
        |at: f64, extinction| CurveNode { scalar: range.min + at * range.length(), color: [0.9, 0.5, 0.2], extinction };
    // Thinner than voxels: what makes it lies between samples, and few of them have it.
    let shell = [(0.0, 0.0), (0.6, 0.0), (0.62, 20.0), (0.64, 0.0), (1.0, 0.0)].map(|(at, e)| node(at, e));
    let shell = TransferFunction::Curve(Curve { nodes: shell.to_vec() });
    let center = [range.min + 0.3 * range.length(), 0.77 * grid.gradient_range().max];
    let sigma = [0.02 * range.length(), 0.04 * grid.gradient_range().max];
    let narrow = Widget::new(WidgetShape::Gaussian { center, sigma, angle: 0.0 }, [0.2, 0.6, 0.9], 30.0);
    let narrow = TransferFunction::Widgets(vec![narrow]);
    let all = mesh.tets.len() as u64;
    for (name, transfer, most) in [("shell", shell, all / 8), ("2D", narrow, all / 4)] {
        let (mut culled, mut whole) =
            (renderer(&grid, STRUCTURED), renderer(&grid, Settings { cull: false, ..STRUCTURED }));
        let bounds = grid.bounds_in_data();
        let short = Bounds { max: bounds.center(), ..bounds };
        let mut too_few = renderer(&grid, STRUCTURED).clipped_to(&short).unwrap_or_else(|e| panic!("{e}"));
        for camera in &octants(&grid, PERSPECTIVE)[2..4] {
            let got = draw(&mut culled, camera, &transfer, [90, 80]);
            let want = draw(&mut whole, camera, &transfer, [90, 80]);
            let c = Comparison::new(&got.image, &want.image).expect("equal sizes");
            // Which spans are drawn depends on how many there are: 9e-6 was measured.
            assert!(c.max < 2e-5, "{name}: {c}");
            let planted = draw(&mut too_few, camera, &transfer, [90, 80]);
            assert!(Comparison::new(&planted.image, &want.image).expect("equal sizes").max > 2e-5, "{name}");
            let (shown, drawn) = (cells(&got, "that the function can show"), cells(&got, "drawn"));
            assert!(drawn <= shown && shown < most, "{name}: {drawn} of {shown} of {most}");
            assert_eq!(cells(&want, "that the function can show"), all);
            println!("{name}: {drawn} of {shown} of {all} are drawn");
        }
    }
}
