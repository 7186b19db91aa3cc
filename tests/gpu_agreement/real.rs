//! Real data at 512 x 512: the Blunt Fin and the Post, smooth, banded and linear, four views each.
//!
//! Three pictures a view: of one colour, where the order does not matter (geometry and depths); against the truth
//! (sorting by centroids); against the truth composed in that order (integration of colour).

use std::sync::Arc;

use tetralux::image::Image;
use tetralux::oracle::Oracle;
use tetralux::plan::order::centroid_depth;
use tetralux::renderer::Frame;
use tetralux::scene::{Curve, Optics, TransferFunction};
use tetralux::tet::TetMesh;

use crate::common::agreement::{Cause, Explainer, Limits, Verdict, assert_limits_bite};
use crate::common::gpu::PROJECTIONS;
use crate::common::peer_scene::PeerScene;
use crate::common::{folder, gpu, meshes};

/// Of one-colour pictures.
const GEOMETRY: Limits = Limits { psnr: 75.0, percentile_99_9: 1e-3, explained_above: 2e-3 };
/// Of pictures in the renderer's own order.
const INTEGRATION: Limits = Limits { psnr: 75.0, percentile_99_9: f64::INFINITY, explained_above: f64::INFINITY };
/// Of pictures, sorted by centroids, against the truth.
const SORTED: Limits = Limits { psnr: 45.0, ..INTEGRATION };
/// Pixels; a picture that changes that much within it cannot be met.
const SHIFT: f64 = 1e-3;

const COLOR: [f64; 3] = [0.9, 0.6, 0.3];

fn one_color(transfer: &TransferFunction) -> TransferFunction {
    let TransferFunction::Curve(mut curve) = transfer.clone() else { panic!("a 1D function") };
    curve.nodes.iter_mut().for_each(|node| node.color = COLOR);
    TransferFunction::Curve(Curve { nodes: curve.nodes })
}

/// Where all is of one colour, what is seen of it is the opacity.
fn colored(opacity: &Image) -> Image {
    let [r, g, b] = COLOR;
    let color = |p: &[f32; 4]| [r, g, b, 1.0].map(|c| (c * f64::from(p[3])) as f32);
    Image { pixels: opacity.pixels.iter().map(color).collect(), ..*opacity }
}

fn agrees(name: &str, view: usize) {
    let peers = folder("TETRALUX_PEERS");
    let scene = PeerScene::read(&peers, name);
    let mesh: Arc<TetMesh> = meshes::read(&peers.join(&scene.mesh), &scene.array);
    let (camera, transfer) = (scene.camera(view), scene.transfer());
    let plain = one_color(&transfer);
    let pictures = PROJECTIONS.map(|method| {
        let mut renderer = gpu::renderer(&mesh, gpu::by(method));
        let mut draw = |transfer| gpu::draw(&mut renderer, &camera, transfer, scene.image).image;
        (method, draw(&transfer), draw(&plain))
    });
    let oracle = Oracle::new(mesh.clone());
    let frame =
        Frame { camera: &camera, transfer: &transfer, optics: &Optics::PLAIN, size: scene.image, background: [0.0; 4] };
    let truth = oracle.image(&frame).expect("a picture");
    let in_order = oracle.render_in_order(&frame, &centroid_depth(&mesh, &camera)).expect("a picture");
    let frame_plain = Frame { transfer: &plain, ..frame };
    let view_of_mesh = oracle.view(&frame_plain).expect("a view");
    let explainer = Explainer { mesh: &mesh, frame: frame_plain, view: view_of_mesh, shift: SHIFT };
    let truth_plain = colored(&truth);
    assert_limits_bite(&truth_plain, GEOMETRY);
    for (method, got, got_plain) in pictures {
        let geometry = Verdict::new(&got_plain, &truth_plain, GEOMETRY, |pixel, error| explainer.cause(pixel, error));
        let sorted = Verdict::new(&got, &truth, SORTED, |_, _| Cause::Unknown);
        let integration = Verdict::new(&got, &in_order, INTEGRATION, |_, _| Cause::Unknown);
        println!("{name} view {view}, {method:?}: one colour {geometry}");
        println!("{name} view {view}, {method:?}: sorted     {sorted}");
        println!("{name} view {view}, {method:?}: own order  {integration}");
        geometry.assert_good(&format!("{method:?}, one colour"));
        sorted.assert_good(&format!("{method:?}, sorted by centroids"));
        integration.assert_good(&format!("{method:?}, in its own order"));
    }
}

macro_rules! views {
    ($($scene:ident)*) => {$(
        mod $scene {
            #[test]
            #[ignore = "needs TETRALUX_PEERS"]
            fn view_0() { super::agrees(stringify!($scene), 0); }
            #[test]
            #[ignore = "needs TETRALUX_PEERS"]
            fn view_1() { super::agrees(stringify!($scene), 1); }
            #[test]
            #[ignore = "needs TETRALUX_PEERS"]
            fn view_2() { super::agrees(stringify!($scene), 2); }
            #[test]
            #[ignore = "needs TETRALUX_PEERS"]
            fn view_3() { super::agrees(stringify!($scene), 3); }
        }
    )*};
}

views!(bluntfin_smooth bluntfin_band bluntfin_lin post_smooth post_band post_lin);
