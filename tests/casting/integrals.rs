//! Pictures by every integral against the oracle's: how near each is.

use std::sync::Arc;

use tetralux::image::Comparison;
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, SegmentIntegral, Settings};
use tetralux::scene::{Optics, SinusoidVariant, TransferFunction, Widget, WidgetShape, Window};
use tetralux::tet::TetMesh;

use crate::common::integral_scene::{camera, curve};
use crate::common::meshes;
use crate::engine;

const SIZE: [u32; 2] = [96, 96];

/// Every shape in turn, each of its own colour; a window and a range.
fn widgets(mesh: &TetMesh) -> TransferFunction {
    let (s, g) = (mesh.scalar_range(), mesh.gradient_range());
    let (_, diagonal) = meshes::center_and_diagonal(mesh);
    let at = |x: f64| s.min + x * s.length();
    let steep = |x: f64| g.min + x * g.length();
    let (along, offset) = ([1.0 / s.length(), 0.0], s.min / s.length());
    let window = Some(Window { direction: [0.0, 1.0], knots: vec![[steep(0.1), 0.2], [steep(0.6), 1.0]] });
    let wave = |variant, period| WidgetShape::Sinusoid { direction: along, offset, period, variant };
    let triangle = WidgetShape::Triangle { direction: along, offset, period: 0.2, duty: 0.5 };
    let ramp = WidgetShape::Ramp { direction: [1.0, 0.0], knots: vec![[at(0.5), 0.0], [at(0.6), 1.0], [at(0.9), 0.3]] };
    let sigma = [0.04 * s.length(), 0.3 * g.length()];
    let gaussian = WidgetShape::Gaussian { center: [at(0.3), steep(0.4)], sigma, angle: 0.0 };
    TransferFunction::Widgets(vec![
        Widget { window, ..Widget::new(triangle, [1.0, 0.2, 0.1], 40.0 / diagonal) },
        Widget::new(wave(SinusoidVariant::Cos, 0.3), [0.1, 0.9, 0.2], 5.0 / diagonal),
        Widget::new(wave(SinusoidVariant::Half, 0.5), [0.4, 0.2, 0.9], 8.0 / diagonal),
        Widget::new(ramp, [0.1, 0.3, 1.0], 10.0 / diagonal),
        Widget {
            gradient_range: Some([steep(0.2), steep(0.8)]),
            ..Widget::new(gaussian, [1.0, 1.0, 0.2], 40.0 / diagonal)
        },
    ])
}

/// Checks that each integral's signal-to-noise ratio lies between the bounds, decibels: no worse, and not better than it
/// can be, which would be a truth that errs alike.
fn check(transfer: impl Fn(&TetMesh) -> TransferFunction, expected: &[(&str, f64, f64)]) {
    let mesh: Arc<TetMesh> = meshes::sample(Sample::Tangle, 6_000);
    let (camera, transfer) = (camera(&mesh), transfer(&mesh));
    let frame =
        Frame { camera: &camera, transfer: &transfer, optics: &Optics::PLAIN, size: SIZE, background: [0.0; 4] };
    let want = Oracle::new(mesh.clone()).image(&frame).expect("a picture");
    let mut wrong = Vec::new();
    for &(name, least, most) in expected {
        let integral: SegmentIntegral = name.parse().expect(name);
        let mut renderer = engine(&mesh, Settings { integral, ..Default::default() });
        let got = renderer.render(&frame, false).expect(name).image;
        let comparison = Comparison::new(&got, &want).expect("equal sizes");
        println!("{name}: {:.1} dB, worst pixel {:.1e}", comparison.psnr, comparison.max);
        if !(least..=most).contains(&comparison.psnr) {
            wrong.push(format!("{name}: {:.1} dB, not {least} to {most}", comparison.psnr));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn curves_by_every_integral() {
    check(
        curve,
        &[
            ("adaptive", 110.0, 200.0),        // 123.6
            ("analytic", 110.0, 200.0),        // 123.6
            ("partial-direct", 110.0, 200.0),  // 123.6
            ("partial", 110.0, 200.0),         // 123.6
            ("preintegrated:256", 60.0, 80.0), // 65.5
            ("preintegrated:32", 33.0, 50.0),  // 37.3: the band is narrower than a node
            ("segmented:16", 46.0, 65.0),      // 51.7
            ("mean-scalar", 16.0, 25.0),       // 18.9
            ("vertex-linear", 14.0, 25.0),     // 17.7
        ],
    );
}

#[test]
fn widgets_by_every_integral() {
    check(
        widgets,
        &[
            ("adaptive:1e-4", 100.0, 200.0), // 113.3
            ("adaptive:1e-3", 85.0, 200.0),  // 92.0
            ("adaptive:1e-2", 65.0, 100.0),  // 70.6
            ("analytic", 38.0, 50.0),        // 41.6: colours mixed as if evenly
            ("partial-direct", 47.0, 60.0),  // 51.5: sinusoids linear by eighths
            ("partial", 47.0, 60.0),         // 51.5
            ("segmented:32", 66.0, 90.0),    // 72.3
            ("segmented:4", 45.0, 60.0),     // 49.1
            ("mean-scalar", 27.0, 40.0),     // 30.9
            ("vertex-linear", 20.0, 30.0),   // 24.2
        ],
    );
}
