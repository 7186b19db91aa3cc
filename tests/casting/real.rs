//! Real data at 512 x 512 against the oracle: 1D and 2D functions, four views each, two of them from inside.

use std::sync::Arc;

use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, SegmentIntegral, Settings};
use tetralux::scene::Optics;
use tetralux::tet::TetMesh;

use crate::common::agreement::{Explainer, Limits, Verdict, assert_limits_bite};
use crate::common::{folder, meshes, views};
use crate::engine;

const SIZE: [u32; 2] = [512, 512];
/// Issue 4; larger errors lie where the true picture changes as much within [`SHIFT`] pixels.
pub const LIMITS: Limits = Limits { psnr: 80.0, percentile_99_9: 1e-3, explained_above: 2e-3 };
pub const SHIFT: f64 = 1e-3;

fn agrees(file: &str, array: &str) {
    let mesh: Arc<TetMesh> = meshes::read(&folder("TETRALUX_DATA").join("tet").join(file), array);
    let integral = SegmentIntegral::Adaptive { tolerance: 1e-3 };
    let mut renderer = engine(&mesh, Settings { integral, ..Settings::default() });
    let oracle = Oracle::new(mesh.clone());
    for (function, transfer) in [("1D", views::curve(&mesh)), ("2D", views::widgets(&mesh))] {
        for (place, camera) in views::four(&mesh) {
            let optics = &Optics::PLAIN;
            let frame = Frame { camera: &camera, transfer: &transfer, optics, size: SIZE, background: [0.0; 4] };
            let rendered = renderer.render(&frame, false).expect("a picture");
            let want = oracle.image(&frame).expect("a picture");
            let explainer = Explainer { mesh: &mesh, frame, view: oracle.view(&frame).expect("a view"), shift: SHIFT };
            let verdict = Verdict::new(&rendered.image, &want, LIMITS, |pixel, error| explainer.cause(pixel, error));
            let rays = rendered.stats.rays.expect("counts");
            println!("{file}, {function}, {place}: {verdict} {rays:?}");
            let seen = want.pixels.iter().filter(|p| p[3] > 0.01).count();
            assert!(seen > 3_000, "{file}, {function}, {place}: seen in {seen} pixels");
            assert_limits_bite(&want, LIMITS);
            verdict.assert_good(&format!("{file}, {function}, {place}"));
            assert_eq!(rays.lost, 0, "{file}, {function}, {place}");
        }
    }
}

macro_rules! meshes {
    ($($name:ident: $file:literal $array:literal,)*) => {$(
        #[test]
        #[ignore = "needs TETRALUX_DATA"]
        fn $name() { agrees($file, $array); }
    )*};
}

meshes! {
    blunt_fin: "bluntfin_tet.vtu" "Density",
    post: "post_tet.vtu" "StagnationEnergy",
    disk: "disk_out_ref.vtu" "Temp",
    can: "can.vtu" "VEL",
    cavity: "driven_cavity.vtu" "Velocity",
    oneram6: "oneram6_small.vtu" "Mach",
    bracket: "mech_bracket.vtu" "xdsp",
}

#[test]
#[ignore = "takes a minute"]
fn fire() {
    agrees("../registry/fire_ug.vtu", "t");
}
