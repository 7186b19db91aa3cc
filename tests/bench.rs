//! `tetralux bench`: a plan is measured, gone on with, and what became worse is caught.

mod common;

use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use common::meshes;
use glam::DVec3;
use tetralux::cpu::CpuRenderer;
use tetralux::image::{Comparison, Image};
use tetralux::mesh::synth::Sample;
use tetralux::oracle::Oracle;
use tetralux::renderer::{Frame, Renderer as _, Settings};
use tetralux::report::record::{Deviation, Record};
use tetralux::scene::{Camera, Curve, CurveNode, Optics, Projection, TransferFunction};
use tetralux::tet::TetMesh;

const PLAN: &str = "
repeats = 2
sizes = [[24, 20], [40, 32]]
[[mesh]]
name = 'tangle'
sample = 'tangle'
tetrahedra = 600
[[scene]]
name = 'curve'
transfer.curve.points = [[0, 1, 0, 0, 1], [1, 0, 1, 0, 9]]
[[scene]]
name = 'widget'
[[scene.transfer.widget]]
shape = 'gaussian'
center = [0.5, 0.4]
sigma = [0.1, 0.3]
color = [1, 0.5, 0.2]
extinction = 20
[[view]]
name = 'outside'
camera = { azimuth = 40, elevation = 15 }
[[view]]
name = 'within'
at = [0.4, 0.5, 0.45]
camera = { fov_y = 70 }
[[matrix]]
devices = ['cpu']
methods = ['auto']
integrals = ['adaptive:0.001', 'mean-scalar', 'auto']
[[matrix]]
devices = ['cpu']
methods = ['auto']
integrals = ['preintegrated']
sizes = [[24, 20]]
views = ['outside']
";

fn bench(arguments: &[&str]) -> (i32, String) {
    let program = Command::new(env!("CARGO_BIN_EXE_tetralux")).arg("bench").args(arguments).output();
    let output = program.expect("the program runs");
    let text = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    (output.status.code().unwrap_or(-1), text)
}

fn name(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

#[test]
fn a_plan_is_measured_and_gone_on_with() {
    let folder = tempfile::tempdir().expect("a folder");
    let (plan, out, peers) = (folder.path().join("small.toml"), folder.path().join("out"), folder.path().join("peers"));
    std::fs::write(&plan, PLAN).expect("written");
    let run = || bench(&["run", name(&plan), "-o", name(&out), "--for-peers", name(&peers)]);
    let (code, text) = run();
    assert_eq!(code, 0, "{text}");
    let records = Record::read(&out.join("records.jsonl")).expect("records");
    // Two scenes, two views, two sizes, three contenders; and one more on two.
    assert_eq!(records.len(), 2 * 2 * 2 * 3 + 2);
    let refused: Vec<_> = records.iter().filter_map(|r| r.refused.as_deref()).collect();
    assert!(matches!(refused[..], [why] if why.contains("widgets")), "{refused:?}");
    for record in &records {
        let Some(measured) = &record.result else { continue };
        assert!(measured.frame_seconds.frames == 2 && measured.frame_seconds.median > 0.0);
        let exact = record.by.integral == "adaptive:0.001";
        assert!(measured.error.rmse < if exact { 1e-4 } else { 0.1 }, "{record:?}");
        let picture = out.join("pictures").join(&record.subject.hash);
        assert_eq!(
            std::fs::read_dir(&picture).expect("pictures").count(),
            if measured_by_four(record) { 4 } else { 3 }
        );
        assert!(out.join("truth").join(format!("{}.exr", record.subject.hash)).exists());
    }
    assert!(out.join("report.html").exists());
    let subjects = std::fs::read_dir(&peers).expect("subjects").count();
    assert_eq!(subjects, 2 * 2 * 2 + 1, "a folder each, and one of meshes");
    // A line that was cut off is measured again, and nothing else where the source is known.
    let lines = std::fs::read_to_string(out.join("records.jsonl")).expect("lines");
    std::fs::write(out.join("records.jsonl"), &lines[..lines.len() - 20]).expect("written");
    let command = Command::new(env!("CARGO_BIN_EXE_tetralux"))
        .args(["bench", "run", name(&plan), "-o", name(&out)])
        .env("TETRALUX_COMMIT", "of another time")
        .output();
    assert!(command.expect("runs").status.success());
    let again = Record::read(&out.join("records.jsonl")).expect("records");
    assert_eq!(again.len(), 2 * records.len() - 1, "another source is measured anew");
    let command = Command::new(env!("CARGO_BIN_EXE_tetralux"))
        .args(["bench", "run", name(&plan), "-o", name(&out)])
        .env("TETRALUX_COMMIT", "of another time")
        .output();
    assert!(command.expect("runs").status.success());
    assert_eq!(Record::read(&out.join("records.jsonl")).expect("records"), again, "the same one is not");
}

/// True of subjects that the second matrix names, and that its contender draws.
fn measured_by_four(record: &Record) -> bool {
    let s = &record.subject;
    s.size == [24, 20] && s.view == "outside" && s.scene == "curve"
}

#[test]
fn plans_that_cannot_be_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let plan = folder.path().join("bad.toml");
    for (from, to, why) in [
        ("repeats = 2", "repeats = 0", "repeats"),
        ("sample = 'tangle'\n", "sample = 'knot'\n", "knot"),
        ("tetrahedra = 600", "", "tetrahedra"),
        ("methods = ['auto']", "methods = ['magic']", "magic"),
        ("'mean-scalar'", "'mean'", "'mean'"),
        ("views = ['outside']", "views = ['above']", "above"),
        ("name = 'widget'", "name = 'curve'", "two scene"),
        ("shape = 'gaussian'", "shape = 'cone'", "cone"),
        ("sizes = [[24, 20]]\nviews", "sizes = [[9, 9]]\nviews", "9x9"),
        ("[[view]]\nname = 'within'", "[[view]]\nwhere = 1\nname = 'within'", "where"),
    ] {
        let text = PLAN.replacen(from, to, 1);
        assert_ne!(text, PLAN, "{from}");
        std::fs::write(&plan, text).expect("written");
        let (code, text) = bench(&["run", name(&plan), "-o", name(&folder.path().join("out"))]);
        assert!(code != 0 && text.contains(why) && text.contains("bad.toml"), "{why}: {code} {text}");
    }
    let (code, text) = bench(&["run", name(&folder.path().join("none.toml"))]);
    assert!(code == 1 && text.contains("none.toml"), "{code} {text}");
    std::fs::write(&plan, PLAN.replace("sample = 'tangle'\ntetrahedra = 600", "data = 'a.vtu'")).expect("written");
    let (code, text) = bench(&["run", name(&plan), "-o", name(&folder.path().join("out"))]);
    assert!(code == 2 && text.contains("--data"), "{code} {text}");
}

/// What a program that is right, or wrong in one thing, makes of a frame, as the error of a record.
fn error_of(got: &Image, want: &Image) -> Deviation {
    Deviation::new(&Comparison::new(got, want).expect("equal sizes")).expect("finite")
}

/// Without one of its cells, which is seen.
fn without_a_cell(mesh: &TetMesh, camera: &Camera) -> TetMesh {
    let nearest = |tet: &&[u32; 4]| {
        let middle: DVec3 = tet.iter().map(|&v| mesh.data_from_mesh(mesh.vertices[v as usize])).sum::<DVec3>() / 4.0;
        middle.distance(camera.eye)
    };
    let dropped = mesh.tets.iter().min_by(|a, b| nearest(a).total_cmp(&nearest(b))).copied().expect("cells");
    let tets = mesh.tets.iter().filter(|tet| **tet != dropped).copied().collect();
    TetMesh { tets: Arc::new(tets), ..mesh.clone() }
}

#[test]
fn planted_faults_are_caught() {
    let mesh = meshes::sample(Sample::Tangle, 2_000);
    let (center, diagonal) = meshes::center_and_diagonal(&mesh);
    let (s, per) = (mesh.scalar_range(), 1.0 / diagonal);
    let node = |at: f64, color, extinction: f64| CurveNode {
        scalar: s.min + at * s.length(),
        color,
        extinction: extinction * per,
    };
    let curve = |scale: f64| {
        let nodes = vec![
            node(0.0, [1.0, 0.1, 0.0], 3.0 * scale),
            node(0.5, [0.0, 1.0, 0.2], 9.0 * scale),
            node(1.0, [0.1, 0.0, 1.0], 30.0 * scale),
        ];
        TransferFunction::Curve(Curve { nodes })
    };
    let (eye, projection) = (center + diagonal * DVec3::new(0.8, 0.6, 0.5), Projection::Perspective { fov_y: 0.7 });
    let camera = Camera { eye, target: center, up: DVec3::Z, projection, near: None };
    let (right, wrong) = (curve(1.0), curve(1.01));
    let frame =
        |transfer| Frame { camera: &camera, transfer, optics: &Optics::PLAIN, size: [48, 40], background: [0.0; 4] };
    let oracle = Oracle::new(mesh.clone());
    let want = oracle.image(&frame(&right)).expect("the truth");
    let cast = |mesh: &Arc<TetMesh>, transfer| {
        let mut renderer = CpuRenderer::new(mesh.clone(), Settings::default()).expect("a renderer");
        renderer.render(&frame(transfer), false).expect("a picture").image
    };
    // From behind to before, as larger keys lie behind.
    let forward = (camera.target - camera.eye).normalize();
    let depth = |tet: &[u32; 4]| -> f64 {
        tet.iter().map(|&v| forward.dot(mesh.data_from_mesh(mesh.vertices[v as usize]) - camera.eye)).sum()
    };
    let reversed: Vec<f64> = mesh.tets.iter().map(|tet| -depth(tet)).collect();
    let good = error_of(&cast(&mesh, &right), &want);
    let faults = [
        ("1 % wrong", error_of(&cast(&mesh, &wrong), &want)),
        ("reversed", error_of(&oracle.render_in_order(&frame(&right), &reversed).expect("a picture"), &want)),
        ("a cell dropped", error_of(&cast(&Arc::new(without_a_cell(&mesh, &camera)), &right), &want)),
    ];
    let folder = tempfile::tempdir().expect("a folder");
    let file = |name: &str| folder.path().join(name);
    std::fs::write(file("small.toml"), PLAN).expect("written");
    let (code, text) = bench(&["run", name(&file("small.toml")), "-o", name(&file("out"))]);
    assert_eq!(code, 0, "{text}");
    let mut records = Record::read(&file("out").join("records.jsonl")).expect("records");
    let write = |name: &str, records: &[Record]| {
        let lines: Vec<String> = records.iter().map(|r| serde_json::to_string(r).expect("JSON")).collect();
        std::fs::write(file(name), lines.join("\n")).expect("written");
    };
    let set = |records: &mut [Record], error: Deviation| {
        records[0].result.as_mut().expect("measured").error = error;
    };
    set(&mut records, good);
    write("old.jsonl", &records);
    write("same.jsonl", &records);
    let diff = |new: &str| bench(&["diff", name(&file("old.jsonl")), name(&file(new))]);
    assert_eq!(diff("same.jsonl").0, 0);
    for (what, error) in faults {
        set(&mut records, error);
        write("new.jsonl", &records);
        let (code, text) = diff("new.jsonl");
        assert!(code == 1 && text.contains("curve"), "{what}: {code} {text}");
    }
}
