//! The scenes of the renderers that users have today at 512 x 512 against the oracle, four views from outside and two from
//! within.

use glam::DVec3;
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, Settings};
use tetralux::scene::{Camera, Optics, Projection};

use super::real::{LIMITS, SHIFT};
use crate::common::agreement::{Explainer, Verdict, assert_limits_bite};
use crate::common::peer_scene::PeerScene;
use crate::common::{folder, meshes};
use crate::engine;

fn agrees(name: &str) {
    let peers = folder("TETRALUX_PEERS");
    let scene = PeerScene::read(&peers, name);
    let mesh = meshes::read(&peers.join(&scene.mesh), &scene.array);
    let transfer = scene.transfer();
    let mut renderer = engine(&mesh, Settings::default());
    let oracle = Oracle::new(mesh.clone());
    let (center, diagonal) = meshes::center_and_diagonal(&mesh);
    let within = |x: f64, y: f64| Camera {
        eye: center + diagonal * DVec3::new(x, y, 0.05),
        near: None,
        projection: Projection::Perspective { fov_y: 1.2 },
        ..scene.camera(0)
    };
    let views = (0..4).map(|view| scene.camera(view)).chain([within(0.1, 0.06), within(-0.12, 0.03)]);
    for (view, camera) in views.enumerate() {
        let (optics, size) = (&Optics::PLAIN, scene.image);
        let frame = Frame { camera: &camera, transfer: &transfer, optics, size, background: [0.0; 4] };
        let rendered = renderer.render(&frame, false).expect("a picture");
        let want = oracle.image(&frame).expect("a picture");
        let explainer = Explainer { mesh: &mesh, frame, view: oracle.view(&frame).expect("a view"), shift: SHIFT };
        let verdict = Verdict::new(&rendered.image, &want, LIMITS, |pixel, error| explainer.cause(pixel, error));
        println!("{name} view {view}: {verdict} {:?}", rendered.stats.rays);
        assert_limits_bite(&want, LIMITS);
        verdict.assert_good(name);
    }
}

macro_rules! scenes {
    ($($scene:ident)*) => {$(
        #[test]
        #[ignore = "needs TETRALUX_PEERS"]
        fn $scene() { agrees(stringify!($scene)); }
    )*};
}

scenes!(bluntfin_smooth bluntfin_band bluntfin_lin post_smooth post_band post_lin);
