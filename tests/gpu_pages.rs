//! What `docs/integrals.md` and `docs/order.md` are made by, small; and what `--explain` tells of pipelines.

#![allow(clippy::duplicate_mod, reason = "each example brings what they share")]

use std::sync::Arc;

use tetralux::gpu::{DeviceChoice, Gpu, GpuRenderer};
use tetralux::renderer::{Frame, Renderer as _, Settings};
use tetralux::scene::Scene;

#[path = "../examples/integrals_page.rs"]
#[expect(dead_code, reason = "its main is another program's")]
mod integrals_page;
#[path = "../examples/orders.rs"]
#[expect(dead_code, reason = "its main is another program's")]
mod orders;
#[path = "../examples/papers.rs"]
#[expect(dead_code, reason = "its main is another program's")]
mod papers;

/// Every line is drawn, by each program and integral.
#[test]
fn papers_lines_are_measured() {
    let mesh = tetralux::mesh::synth::Sample::Tangle.mesh(3_000);
    let (mesh, _) =
        tetralux::tet::TetMesh::new(mesh, &Default::default(), tetralux::tet::HexSplit::default()).expect("a mesh");
    let mesh = Arc::new(mesh);
    let size = [48, 32];
    let univariate = papers::univariate("tangle", &mesh, size).expect("lines");
    let bivariate = papers::bivariate("tangle", &mesh, size).expect("lines");
    assert_eq!((univariate.len(), bivariate.len()), (12, 4));
    let grid = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/xml/image.vti");
    let volume = papers::volume("grid", &grid, size).expect("lines");
    for line in univariate.iter().chain(&bivariate).chain(&volume) {
        assert!(!line.contains("not drawn") && line.matches('|').count() == 8, "{line}");
    }
    assert!(volume[0].contains('%') && !volume[1].contains('%'), "{volume:?}");
    let missing = papers::line("grid", "project", &Err(tetralux::Error::Asked("no such file".into())));
    assert!(missing.contains("no such file"), "{missing}");
}

#[test]
fn orders_stand_in_the_order_of_their_page() {
    let mesh = tetralux::mesh::synth::Sample::Tangle.mesh(6_000);
    let (mesh, _) =
        tetralux::tet::TetMesh::new(mesh, &Default::default(), tetralux::tet::HexSplit::default()).expect("a mesh");
    let rows = orders::rows(&Arc::new(mesh), 10.0, [64, 48]).expect("rows");
    let names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
    assert_eq!(names, ["centroid", "power", "mpvonc", "exact", "per-pixel", "(raycast)"]);
    let of = |name: &str| rows.iter().find(|row| row.name == name).expect("a row");
    for exact in ["mpvonc", "exact", "per-pixel", "(raycast)"] {
        assert!(of(exact).psnr > of("centroid").psnr + 20.0, "{:?}, {:?}", of(exact), of("centroid"));
    }
    let wrong = |name: &str| of(name).inversions.map(|counted| counted.wrong);
    assert_eq!((wrong("mpvonc"), wrong("exact"), wrong("per-pixel")), (Some(0), Some(0), None));
    assert!(wrong("centroid") > Some(1_000), "{rows:?}");
    assert!(of("exact").bytes > of("centroid").bytes, "ranks take room: {rows:?}");
}

#[test]
fn integrals_stand_in_the_order_of_their_page() {
    use integrals_page::{INTEGRALS, Row, THIN_BAND, TWO_COLORS, of_widgets, rows, sheet};
    let size = Some([48, 32]);
    let thin_band = rows(THIN_BAND, &INTEGRALS, size).expect("rows");
    let image = sheet(&thin_band).expect("a picture");
    assert_eq!([image.width, image.height], [4 * 48 + 16, 4 * 32 + 12]);
    let find = |rows: &[Row], name: &str| rows.iter().find(|row| row.0 == name).expect("a row").2.psnr;
    let psnr = |name: &str| find(&thin_band, name);
    // The thin band separates them by far: a picture of the wrong integral would stand out.
    for exact in ["partial", "partial-direct", "analytic", "adaptive:1e-3"] {
        for crude in ["vertex-linear", "mean-scalar"] {
            assert!(psnr(exact) > psnr(crude) + 20.0, "{exact} {}, {crude} {}", psnr(exact), psnr(crude));
        }
    }
    // Two colours within a cell separate what knows depths alone from what bounds the colour.
    let two_colors = rows(TWO_COLORS, &of_widgets(), size).expect("rows");
    let psnr = |name: &str| find(&two_colors, name);
    assert!(psnr("adaptive:1e-3") > psnr("analytic") + 20.0, "{} and {}", psnr("adaptive:1e-3"), psnr("analytic"));
}

#[test]
fn pipelines_tell_what_they_are_made_for() {
    let mesh = tetralux::mesh::synth::Sample::Tangle.mesh(200);
    let (mesh, _) =
        tetralux::tet::TetMesh::new(mesh, &Default::default(), tetralux::tet::HexSplit::default()).expect("a mesh");
    let mesh = Arc::new(mesh);
    let gpu = Gpu::new(DeviceChoice::Any).expect("an adapter");
    let mut renderer = GpuRenderer::new(gpu, Arc::clone(&mesh), Settings::default()).expect("a renderer");
    for (transfer, parts) in [
        (
            "[[transfer.widget]]\nshape = 'triangle'\nperiod = 2\ncolor = [1, 0, 0]\nextinction = 1\n\
             gradient_range = [1, 2]",
            [
                "1 widgets (triangle, with ranges) of scalar and gradient in one colour",
                "weighted",
                "adaptive:0.001, a loop",
            ],
        ),
        // Every value of the field lies between the nodes; or some lie below one.
        ("[transfer.curve]\npoints = [[-99, 1, 0, 0, 1], [999, 1, 0, 0, 2]]", ["a curve", "weighted", "band by band"]),
        ("[transfer.curve]\npoints = [[0, 1, 0, 0, 1], [9, 1, 0, 0, 2]]", ["a curve", "weighted", "pairs of bands"]),
    ] {
        let scene = Scene::parse(transfer, &[]).expect("a scene");
        let (camera, transfer) = scene.resolve(&*mesh).expect("a camera");
        let frame =
            Frame { camera: &camera, transfer: &transfer, optics: &scene.optics, size: [16, 12], background: [0.0; 4] };
        let told = renderer.render(&frame, false).expect("a picture").stats.pipelines;
        for part in parts {
            assert!(told.contains(part), "'{told}' lacks '{part}'");
        }
    }
}
