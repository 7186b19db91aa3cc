//! Real meshes at 512 x 512: under thin bands of all colours against the oracle, and rays against lists.

use tetralux::gpu::RayCaster;
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, Method, OrderMethod, Renderer as _, SegmentIntegral, Settings};

use crate::common::agreement::{SNAP, assert_limits_bite};
use crate::common::rainbow::rainbow;
use crate::common::{folder, gpu, meshes, views};
use crate::scenes::{EXACT, Truth, cameras, plain};

fn agrees(file: &str, array: &str) {
    let mesh = meshes::read(&folder("TETRALUX_DATA").join("tet").join(file), array);
    let transfer = rainbow(&mesh, 20, 10.0);
    let oracle = Oracle::new(mesh.clone());
    for method in gpu::PROJECTIONS {
        let settings = Settings { method, order: OrderMethod::PerPixel, ..Settings::default() };
        let mut renderer = gpu::renderer(&mesh, settings);
        for (i, camera) in cameras(&mesh).iter().enumerate() {
            let frame = Frame { size: [512, 512], background: [0.0; 4], ..plain(camera, &transfer) };
            let truth = Truth::new(&oracle, &mesh, frame);
            truth.assert_drawn(&format!("{file}, {method:?}, camera {i}"), &mut renderer);
        }
    }
}

/// Rays see what lists of the same mesh's cells compose: functions of one and two variables, two views of four from inside.
fn rays_agree(file: &str, array: &str) {
    let mesh = meshes::read(&folder("TETRALUX_DATA").join("tet").join(file), array);
    let integral = SegmentIntegral::Adaptive { tolerance: 1e-3 };
    let by = |method| Settings { method, integral, order: OrderMethod::PerPixel, ..Settings::default() };
    let mut caster = RayCaster::new(gpu::device(), mesh.clone(), by(Method::RayCast)).expect("a caster");
    let mut lists = gpu::renderer(&mesh, by(Method::Project));
    let oracle = Oracle::new(mesh.clone());
    for (function, transfer) in [("1D", views::curve(&mesh)), ("2D", views::widgets(&mesh))] {
        for (place, camera) in views::four(&mesh) {
            let what = format!("{file}, {function}, {place}");
            let frame = Frame { size: [512, 512], background: [0.0; 4], ..plain(&camera, &transfer) };
            let cast = caster.render(&frame, false).unwrap_or_else(|e| panic!("{what}: {e}")).image;
            let listed = lists.render(&frame, false).unwrap_or_else(|e| panic!("{what}: {e}")).image;
            // Rays pass no grid of a rasteriser, to which lists owe their edges.
            let verdict = Truth::new(&oracle, &mesh, frame).within(SNAP).verdict_against(&listed, &cast, EXACT);
            println!("{what}, rays and lists: {verdict}");
            verdict.assert_good(&what);
            assert_limits_bite(&cast, EXACT);
        }
    }
}

macro_rules! meshes {
    ($($name:ident $rays:ident: $file:literal $array:literal,)*) => {$(
        #[test]
        #[ignore = "needs TETRALUX_DATA"]
        fn $name() { agrees($file, $array); }

        #[test]
        #[ignore = "needs TETRALUX_DATA"]
        fn $rays() { rays_agree($file, $array); }
    )*};
}

meshes! {
    blunt_fin blunt_fin_rays: "bluntfin_tet.vtu" "Density",
    post post_rays: "post_tet.vtu" "StagnationEnergy",
    can can_rays: "can.vtu" "VEL",
}
