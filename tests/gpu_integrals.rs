//! Pictures by every integral against the oracle's, cells in the same order: how near each is, and what it refuses.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::sync::Arc;

use common::integral_scene::{camera, curve};
use common::{gpu, meshes};
use tetralux::image::{Comparison, Image};
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::plan::order::centroid_depth;
use tetralux::renderer::{Frame, Method, Renderer as _, SegmentIntegral, Settings};
use tetralux::scene::{EmissionModel, Optics, SinusoidVariant, TransferFunction, Widget, WidgetShape, Window};
use tetralux::tet::TetMesh;

const SIZE: [u32; 2] = [96, 96];

fn mesh() -> Arc<TetMesh> {
    meshes::sample(Sample::Tangle, 6_000)
}

/// Every shape in turn, in two colours and more.
fn widgets(mesh: &TetMesh) -> TransferFunction {
    let (s, g) = (mesh.scalar_range(), mesh.gradient_range());
    let (_, diagonal) = meshes::center_and_diagonal(mesh);
    let at = |x: f64| s.min + x * s.length();
    let steep = |x: f64| g.min + x * g.length();
    let along = [1.0 / s.length(), 0.0];
    let offset = s.min / s.length();
    let window = Some(Window { direction: [0.0, 1.0], knots: vec![[steep(0.1), 0.2], [steep(0.6), 1.0]] });
    TransferFunction::Widgets(vec![
        Widget {
            window,
            ..Widget::new(
                WidgetShape::Triangle { direction: along, offset, period: 0.2, duty: 0.5 },
                [1.0, 0.2, 0.1],
                40.0 / diagonal,
            )
        },
        Widget::new(
            WidgetShape::Sinusoid { direction: along, offset, period: 0.3, variant: SinusoidVariant::Cos },
            [0.1, 0.9, 0.2],
            5.0 / diagonal,
        ),
        Widget::new(
            WidgetShape::Ramp { direction: [1.0, 0.0], knots: vec![[at(0.5), 0.0], [at(0.6), 1.0], [at(0.9), 0.3]] },
            [0.1, 0.3, 1.0],
            10.0 / diagonal,
        ),
        Widget {
            gradient_range: Some([steep(0.2), steep(0.8)]),
            ..Widget::new(
                WidgetShape::Gaussian {
                    center: [at(0.3), steep(0.4)],
                    sigma: [0.04 * s.length(), 0.3 * g.length()],
                    angle: 0.0,
                },
                [1.0, 1.0, 0.2],
                40.0 / diagonal,
            )
        },
    ])
}

fn draw(
    mesh: &Arc<TetMesh>,
    transfer: &TransferFunction,
    method: Method,
    integral: &str,
    optics: &Optics,
) -> tetralux::Result<Image> {
    let integral: SegmentIntegral = integral.parse()?;
    let mut renderer = gpu::renderer(mesh, Settings { integral, ..gpu::by(method) });
    let camera = camera(mesh);
    let frame = Frame { camera: &camera, transfer, optics, size: SIZE, background: [0.0; 4] };
    Ok(renderer.render(&frame, false)?.image)
}

fn truth(mesh: &Arc<TetMesh>, transfer: &TransferFunction, optics: &Optics) -> Image {
    let camera = camera(mesh);
    let frame = Frame { camera: &camera, transfer, optics, size: SIZE, background: [0.0; 4] };
    Oracle::new(mesh.clone()).render_in_order(&frame, &centroid_depth(mesh, &camera)).expect("a picture")
}

/// Checks that each integral's signal-to-noise ratio lies between the bounds, decibels: no worse, and not better than it
/// can be, which would be a truth that errs alike.
fn check(transfer: &TransferFunction, optics: &Optics, expected: &[(&str, f64, f64)]) {
    let mesh = mesh();
    let want = truth(&mesh, transfer, optics);
    let mut wrong = Vec::new();
    for &(integral, least, most) in expected {
        for method in gpu::PROJECTIONS {
            let got = draw(&mesh, transfer, method, integral, optics).expect(integral);
            let comparison = Comparison::new(&got, &want).expect("equal sizes");
            println!("{integral}, {method:?}: {:.1} dB, worst pixel {:.1e}", comparison.psnr, comparison.max);
            if !(least..=most).contains(&comparison.psnr) {
                wrong.push(format!("{integral}, {method:?}: {:.1} dB, not {least} to {most}", comparison.psnr));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn widgets_by_every_integral() {
    check(
        &widgets(&mesh()),
        &Optics::PLAIN,
        &[
            ("adaptive:1e-4", 100.0, 200.0), // 111.6
            ("adaptive:1e-3", 85.0, 200.0),  // 91.0
            ("adaptive:1e-2", 65.0, 100.0),  // 70.1
            ("analytic", 40.0, 60.0),        // 42.9: colours mixed as if evenly
            ("partial-direct", 44.0, 60.0),  // 47.5: sinusoids linear by eighths
            ("partial", 44.0, 60.0),         // 47.5
            ("segmented:32", 66.0, 90.0),    // 71.7
            ("segmented:4", 45.0, 60.0),     // 49.1
            ("mean-scalar", 28.0, 40.0),     // 32.2
            ("vertex-linear", 20.0, 30.0),   // 24.4
        ],
    );
}

#[test]
fn curves_by_every_integral() {
    check(
        &curve(&mesh()),
        &Optics::PLAIN,
        &[
            ("adaptive", 105.0, 200.0),        // 115.0
            ("analytic", 105.0, 200.0),        // 115.0
            ("partial-direct", 105.0, 200.0),  // 115.5
            ("partial", 100.0, 200.0),         // 111.2
            ("preintegrated:256", 60.0, 80.0), // 65.4
            ("preintegrated:32", 33.0, 50.0),  // 37.2: the band is narrower than a node
            ("segmented:16", 46.0, 65.0),      // 51.7
            ("mean-scalar", 16.0, 25.0),       // 18.9
            ("vertex-linear", 14.0, 25.0),     // 17.7
        ],
    );
}

#[test]
fn unweighted_emission_glows() {
    let optics = Optics { emission: EmissionModel::Unweighted, ..Optics::PLAIN };
    check(&widgets(&mesh()), &optics, &[("adaptive", 40.0, 200.0)]);
    check(&curve(&mesh()), &optics, &[("adaptive", 95.0, 200.0), ("partial", 95.0, 200.0)]); // 100.6
}

/// By tables of visible lengths, one widget at a time.
#[test]
fn tabled_emission_glows() {
    let mesh = mesh();
    let (s, g) = (mesh.scalar_range(), mesh.gradient_range());
    let (_, diagonal) = meshes::center_and_diagonal(&mesh);
    let gaussian = WidgetShape::Gaussian {
        center: [s.min + 0.3 * s.length(), g.min + 0.4 * g.length()],
        sigma: [0.04 * s.length(), 0.3 * g.length()],
        angle: 0.2,
    };
    let wave = |variant| WidgetShape::Sinusoid {
        direction: [1.0 / s.length(), 0.1 / g.length()],
        offset: s.min / s.length(),
        period: 0.04,
        variant,
    };
    let optics = Optics { emission: EmissionModel::Unweighted, ..Optics::PLAIN };
    for shape in [gaussian, wave(SinusoidVariant::Cos), wave(SinusoidVariant::Arch)] {
        for depth in [3.0, 300.0] {
            let widget = Widget::new(shape.clone(), [1.0, 0.6, 0.2], depth / diagonal);
            let alone = TransferFunction::Widgets(vec![widget]);
            // Measured: 93.3 to 114.8 dB by tables, 86.5 to 112.7 by pieces.
            check(&alone, &optics, &[("analytic", 75.0, 200.0), ("adaptive", 75.0, 200.0)]);
        }
    }
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let mesh = mesh();
    let refusal = |transfer: &TransferFunction, integral: &str, optics: &Optics| {
        draw(&mesh, transfer, Method::Project, integral, optics).expect_err("a refusal").to_string()
    };
    assert!(refusal(&widgets(&mesh), "preintegrated", &Optics::PLAIN).contains("functions of the scalar alone"));
}
