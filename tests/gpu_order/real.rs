//! Real meshes at 512 x 512 under thin bands of all colours, against the oracle.

use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, OrderMethod, Settings};

use crate::common::rainbow::rainbow;
use crate::common::{folder, gpu, meshes};
use crate::scenes::{Truth, cameras, plain};

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
    can: "can.vtu" "VEL",
}
