//! The integral that is chosen for a tolerance holds it, on scenes that no choice was made from: graphics devices.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use common::gpu::{device, renderer};
use common::held_out::{chosen, scenes};
use tetralux::gpu::RayCaster;
use tetralux::renderer::{OrderMethod, Settings, TOLERANCE};

#[test]
fn tolerances_hold() {
    // One widget is integrated in closed form by most; several colours are what errs.
    for scene in scenes().iter().filter(|scene| !scene.name.ends_with(" 1 widgets")) {
        let mut caster = RayCaster::new(device(), scene.mesh.clone(), Settings::default()).expect("a caster");
        let (integral, error) = chosen(scene, &mut caster, TOLERANCE);
        println!("{}, rays: {integral} errs by {error:.1e}", scene.name);
        assert!(error <= TOLERANCE, "{}, rays: {integral} errs by {error:.1e}", scene.name);
        // In an exact order: the integral's share of the error.
        if scene.name.starts_with("hydrogen") {
            let mut lists = renderer(&scene.mesh, Settings { order: OrderMethod::PerPixel, ..Settings::default() });
            let (integral, error) = chosen(scene, &mut lists, TOLERANCE);
            println!("{}, lists: {integral} errs by {error:.1e}", scene.name);
            assert!(error <= TOLERANCE, "{}, lists: {integral} errs by {error:.1e}", scene.name);
        }
    }
}
