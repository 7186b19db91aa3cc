//! The integral that is chosen for a tolerance holds it, on scenes that no choice was made from: the CPU engine.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use common::held_out::{Scene, chosen, scenes};
use tetralux::cpu::CpuRenderer;
use tetralux::renderer::{SegmentIntegral, Settings, TOLERANCE};

/// Half of what 8 bits tell apart; and what a preview may err by.
const TOLERANCES: [f64; 2] = [TOLERANCE, 0.02];

fn renderer(scene: &Scene, settings: Settings) -> CpuRenderer {
    CpuRenderer::new(scene.mesh.clone(), settings).expect("a renderer")
}

#[test]
fn tolerances_hold() {
    let mut kinds = std::collections::BTreeSet::new();
    for scene in scenes() {
        let mut renderer = renderer(&scene, Settings::default());
        for tolerance in TOLERANCES {
            let (integral, error) = chosen(&scene, &mut renderer, tolerance);
            println!("{}, {tolerance:.1e}: {integral} errs by {error:.1e}", scene.name);
            assert!(error <= tolerance, "{}: {integral} errs by {error:.1e}, not {tolerance:.1e}", scene.name);
            kinds.insert(integral);
        }
    }
    assert!(kinds.len() > 2, "a choice is made: {kinds:?}");
}

/// A choice that looked at nothing would be wrong somewhere.
#[test]
fn the_cheapest_alone_would_not_do() {
    let settings = Settings { integral: SegmentIntegral::MeanScalar, ..Settings::default() };
    let wrong = scenes().into_iter().filter(|scene: &Scene| {
        let optics = tetralux::scene::Optics::PLAIN;
        let Scene { camera, transfer, .. } = scene;
        let frame =
            tetralux::renderer::Frame { camera, transfer, optics: &optics, size: [64, 48], background: [0.0; 4] };
        let got = tetralux::renderer::Renderer::render(&mut renderer(scene, settings), &frame, false);
        let want = tetralux::oracle::Oracle::new(scene.mesh.clone()).image(&frame).expect("the truth");
        let error = tetralux::image::Comparison::new(&got.expect("a picture").image, &want).expect("sizes").max;
        error > TOLERANCE
    });
    assert!(wrong.count() > 2);
}
