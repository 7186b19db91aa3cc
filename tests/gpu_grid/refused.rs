//! What is no grid, and what is not drawn of one: errors that say what does it.

use std::path::Path;
use std::process::Command;

use glam::DVec3;
use tetralux::mesh::{Mesh, Topology};
use tetralux::renderer::{Frame, Method, Renderer as _, Settings};
use tetralux::scene::{Lighting, Optics};
use tetralux::tet::{FieldChoice, Grid};

use crate::common::gpu;
use crate::grids::{PERSPECTIVE, STRUCTURED, bivariate, both, lattice, octants, waves};

fn small() -> Mesh {
    lattice([3, 4, 2], DVec3::ZERO, DVec3::ONE, waves)
}

#[test]
fn other_meshes_are_refused() {
    assert!(Grid::check(&small()).is_ok());
    let changed = |change: &dyn Fn(&mut Mesh)| {
        let mut mesh = small();
        change(&mut mesh);
        mesh
    };
    let blank = |mesh: &mut Mesh| {
        let mut blank = vec![false; mesh.points.len()];
        blank[7] = true;
        mesh.topology = Topology::Structured { points: [4, 5, 3], blank };
    };
    let cells = |mesh: &mut Mesh| {
        let (kinds, nodes) = (vec![tetralux::mesh::CellKind::Tetrahedron], vec![0, 1, 4, 20]);
        mesh.topology = Topology::Cells { kinds, nodes };
    };
    for (mesh, why) in [
        (changed(&cells), "explicit cells"),
        (changed(&blank), "blanked"),
        (changed(&|mesh| mesh.points[9].y += 1e-9), "sheared or curved"),
        (changed(&|mesh| mesh.points.iter_mut().for_each(|p| p.x = (p.x - 1.0).abs())), "along the first axis"),
    ] {
        let error = Grid::check(&mesh).expect_err(why);
        let text = error.to_string();
        assert!(text.contains(why) && text.contains("--order centroid"), "{text}");
        assert_eq!(error.exit_code(), 2);
    }
    let holey = changed(&|mesh| mesh.arrays[0].values[3] = f64::NAN);
    let error = Grid::new(holey, &FieldChoice::default()).expect_err("not finite").to_string();
    assert!(error.contains("1 of 60 samples"), "{error}");
    let short = changed(&|mesh| mesh.points.truncate(59));
    assert!(Grid::check(&short).expect_err("too few").to_string().contains("cannot be made of 59 points"));
}

#[test]
fn what_is_not_drawn_is_refused() {
    let (grid, _) = both(&small());
    let make = |settings| tetralux::gpu::GridRenderer::new(gpu::device(), grid.clone(), settings);
    let wrong = make(Settings { method: Method::CellCast, ..STRUCTURED }).err().expect("an error");
    assert!(wrong.to_string().contains("--method project"), "{wrong}");
    let small = tetralux::gpu::Gpu::with_binding_limit(gpu::choice(), 128).unwrap_or_else(|e| panic!("{e}"));
    let wrong = tetralux::gpu::GridRenderer::new(small, grid.clone(), STRUCTURED).err().expect("an error");
    assert!(wrong.to_string().contains("4 x 5 x 3 samples"), "{wrong}");
    let lighting = Lighting {
        direction: DVec3::Z,
        space: tetralux::scene::LightSpace::View,
        ambient: 0.2,
        diffuse: 0.7,
        specular: 0.1,
        shininess: 9.0,
    };
    let (camera, transfer) = (octants(&grid, PERSPECTIVE)[0], bivariate(&grid));
    let optics = Optics { lighting: Some(lighting), ..Optics::PLAIN };
    let frame = Frame { camera: &camera, transfer: &transfer, optics: &optics, size: [8, 8], background: [0.0; 4] };
    let error = make(STRUCTURED).expect("a renderer").render(&frame, false).expect_err("no lighting");
    assert!(error.to_string().contains("--order"), "{error}");
}

fn run(arguments: &[&str]) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_tetralux")).args(arguments).output().expect("the program runs");
    (output.status.code().unwrap_or(-1), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn the_command_line_tells_what_to_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let raw = file("cube.raw");
    std::fs::write(&raw, (0..64_u8).collect::<Vec<_>>()).expect("written");
    let picture = file("cube.png");
    let on = |device: &str, mesh: &str, more: &[&str]| {
        let common = ["render", mesh, "-o", &picture, "--size", "32x32", "--device", device];
        run(&[&common, more].concat())
    };
    let render = |mesh: &str, more: &[&str]| on("gpu", mesh, &[&["--order", "structured"][..], more].concat());
    let (code, text) = render(&raw, &["--dims", "4x4x4", "--sample-type", "u8", "--explain"]);
    assert_eq!(code, 0, "{text}");
    assert!(text.contains("135  after in the grid") && text.contains("B a voxel"), "{text}");
    let clip = ["--dims", "4x4x4", "--sample-type", "u8", "--clip"];
    assert_eq!(render(&raw, &[&clip[..], &["1,0,0,2,2,2"]].concat()).0, 0);
    for (arguments, code, why) in [
        (["--dims", "4x4x5", "--sample-type", "u8"], 1, "80"),
        (["--dims", "4x4x4", "--spacing", "0,1,1"], 2, "each must be above 0"),
    ] {
        let (got, text) = render(&raw, &arguments);
        assert!(got == code && text.contains(why), "{got}: {text}");
    }
    let fire = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/data/fire_ug.vtu");
    let fire = fire.to_string_lossy();
    let (code, text) = render(&fire, &[]);
    assert!(code == 2 && text.contains("--order centroid"), "{code}: {text}");
    let cube = ["--dims", "4x4x4", "--sample-type", "u8"];
    let (code, text) = on("cpu", &raw, &[&cube[..], &["--order", "structured"]].concat());
    assert!(code == 2 && text.contains("drawn by graphics devices"), "{code}: {text}");
    for contrary in ["--weld", "--split=6"] {
        let (code, text) = render(&raw, &[&cube[..], &[contrary]].concat());
        assert!(code == 2 && text.contains("leave out --split 6 and --weld"), "{code}: {text}");
    }
    // Of itself, a grid is taken as one where nothing needs a mesh.
    for (more, is_grid) in [
        (&[][..], true),
        (&["--method", "project"], true),
        (&["--method", "raycast", "--split", "5"], true),
        (&["--clip", "1,0,0,2,2,2"], false),
        (&["--split", "6"], false),
        (&["--method", "cellcast"], false),
        (&["--order", "centroid"], false),
        (&["--light", "0,0,1"], false),
    ] {
        let (code, text) = on("gpu", &raw, &[&cube[..], &["--explain"], more].concat());
        assert!(code == 0 && text.contains("in the grid") == is_grid, "{more:?}: {code}: {text}");
    }
    let (code, text) = on("gpu", &fire, &["--clip", "1e6,0,0,2e6,1,1"]);
    assert!(code == 2 && text.contains("nothing of the mesh lies in the box"), "{code}: {text}");
    let voxels = [&cube[..], &["--order", "structured", "--clip", "1,0,0,2,2,2"]].concat();
    let (code, text) = on("gpu", &raw, &voxels);
    assert!(code == 0, "{code}: {text}");
}
