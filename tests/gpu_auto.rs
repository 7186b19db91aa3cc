//! The integral and the method that are chosen for a tolerance hold it, on scenes that no choice was made from: graphics devices.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use common::gpu::{device, renderer};
use common::held_out::{chosen, curves, scenes};
use tetralux::gpu::{ChosenMethod, RayCaster, choose_method};
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

#[test]
fn methods_hold_tolerances() {
    let scenes: Vec<_> = curves().into_iter().chain(scenes().into_iter().skip(2).step_by(3)).collect();
    let mut kinds = std::collections::BTreeMap::<String, u32>::new();
    for scene in &scenes {
        for tolerance in [TOLERANCE, 0.02] {
            let settings = Settings { tolerance, ..Settings::default() };
            let frame = scene.frame();
            let choose = || choose_method(device(), scene.mesh.clone(), settings, &frame).expect("a choice");
            let ChosenMethod { mut renderer, why } = choose();
            assert_eq!(choose().why, why, "the same each time");
            let (integral, error) = chosen(scene, &mut *renderer, tolerance);
            let order = renderer.render(&frame, true).expect("a picture").stats.order;
            println!("{}, {tolerance:.1e}: {why}; {integral}; {order}: {error:.1e}", scene.name);
            assert!(error <= tolerance, "{}: {why}; {integral}; {order}: {error:.1e}, not {tolerance:.1e}", scene.name);
            let order = order.split(':').next().unwrap_or_default();
            *kinds.entry(format!("{}, {order}", why.split(':').next().unwrap_or_default())).or_default() += 1;
        }
    }
    println!("{kinds:?}");
    let is_software = device().is_software();
    assert_eq!(kinds.keys().any(|kind| kind.contains("projected")), is_software, "{kinds:?}");
    assert!(kinds.keys().any(|kind| kind.contains("cast")), "{kinds:?}");
}
