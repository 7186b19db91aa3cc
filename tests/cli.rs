//! The command line as a user meets it: exit codes, messages, no partial output.
#![cfg(feature = "cli")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

const FIRE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/data/fire_ug.vtu");
const SCENE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/fire.toml");

fn tetralux(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tetralux")).current_dir(folder).args(arguments).output().unwrap()
}

/// Runs and expects exit code 0; returns stdout.
fn succeed(folder: &Path, arguments: &[&str]) -> String {
    let output = tetralux(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Runs and expects `code`, a single line of error that holds every part, nothing on stdout, and no panic.
fn fail(folder: &Path, arguments: &[&str], code: i32, parts: &[&str]) {
    let output = tetralux(folder, arguments);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {stderr}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    assert_eq!(stderr.lines().filter(|l| l.starts_with("error: ")).count(), 1, "{arguments:?}: {stderr}");
    assert!(!stderr.contains("panicked"), "{stderr}");
    for part in parts {
        assert!(stderr.contains(part), "{arguments:?}: {stderr}\nlacks {part}");
    }
}

fn names(folder: &Path) -> Vec<PathBuf> {
    let mut names: Vec<_> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    names.sort();
    names
}

#[test]
fn mistakes_in_the_command_are_two() {
    let folder = tempfile::tempdir().unwrap();
    let render = |more: &[&'static str]| [&["render", FIRE, "-o", "a.png"], more].concat();
    let cases: Vec<(Vec<&str>, &[&str])> = vec![
        (vec!["rendr"], &["rendr"]),
        (vec!["render", FIRE], &["--output"]),
        (render(&["--size", "0x5"]), &["--size", "above 0"]),
        (render(&["--size", "800"]), &["--size", "800x600"]),
        (render(&["--size", "100000x5"]), &["--size", "image.width", "32768"]),
        (render(&["--eye", "1,2"]), &["--eye", "three finite numbers"]),
        (render(&["--fov-y", "0"]), &["--fov-y", "180 degrees"]),
        (render(&["--fov-y", "nan"]), &["--fov-y", "180 degrees"]),
        (render(&["--fov-y", "30", "--ortho-height", "1"]), &["cannot be used with"]),
        (render(&["--near", "0"]), &["--near", "camera.near"]),
        (render(&["--emission", "bright"]), &["bright", "unweighted"]),
        (render(&["--light", "0,0,0"]), &["--light", "lighting.direction", "zero"]),
        (render(&["--silhouette", "-1"]), &["--silhouette", "silhouette.exponent", "above 0"]),
        (render(&["--silhouette", "0"]), &["--silhouette", "silhouette.exponent", "above 0"]),
        (render(&["--set", "camera.fov=30"]), &["--set camera.fov=30", "unknown field"]),
        (render(&["--set", "nonsense"]), &["KEY=VALUE"]),
        (render(&["--device", "abacus"]), &["abacus", "oracle"]),
        (render(&["--device", "cpu", "--method", "project"]), &["--method raycast", "--device gpu"]),
        (render(&["--device", "cpu", "--method", "cellcast"]), &["--method raycast", "--device gpu"]),
        (render(&["--device", "cpu", "--emission", "unweighted"]), &["unweighted", "--device oracle"]),
        (render(&["--least-transmittance", "2"]), &["--least-transmittance", "0 to 1"]),
        (render(&["--repeat", "0"]), &["--repeat"]),
        (render(&["--background", "red"]), &["--background", "#rrggbb"]),
        (render(&["--legend", "--size", "64x64"]), &["--legend", "160"]),
        (render(&["--field", "nothing"]), &["nothing", "t", "mfrac"]),
        (vec!["render", FIRE, "-o", "a.jpg"], &[".png or .exr", "a.jpg"]),
        (vec!["sample", "moebius", "-o", "a.vtu"], &["moebius", "hydrogen"]),
        (vec!["sample", "tangle", "-o", "a.vtk"], &[".vtu"]),
        (vec!["sample", "tangle", "--tets", "0", "-o", "a.vtu"], &["--tets"]),
        (vec!["histogram", FIRE, "-o", "a.png", "--bins", "0x9"], &["--bins"]),
        (vec!["histogram", FIRE, "-o", "a.png", "--csv", "a.txt"], &[".csv"]),
    ];
    for (arguments, parts) in cases {
        fail(folder.path(), &arguments, 2, parts);
    }
    assert!(names(folder.path()).is_empty(), "nothing may be written: {:?}", names(folder.path()));
}

#[test]
fn tables_are_made_whole_and_compared() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    // Nothing is written where one file cannot be.
    std::fs::create_dir_all(path("tables/arch_k.f32")).unwrap();
    fail(folder.path(), &["tables"], 1, &["arch_k.f32"]);
    fail(folder.path(), &["tables", "-o", "nowhere"], 1, &["no such folder", "nowhere"]);
    assert_eq!(names(&path("tables")), [path("tables/arch_k.f32")]);
    std::fs::remove_dir(path("tables/arch_k.f32")).unwrap();
    fail(folder.path(), &["tables", "--check"], 1, &["cannot read", "psi.f32"]);

    succeed(folder.path(), &["tables"]);
    succeed(folder.path(), &["tables", "--check"]);
    assert_eq!(names(&path("tables")).len(), 5);
    let committed = Path::new(env!("CARGO_MANIFEST_DIR")).join("tables/index.json");
    assert_eq!(std::fs::read(path("tables/index.json")).unwrap(), std::fs::read(committed).unwrap());
    // Node (7, 1) of psi, two units in the last place away.
    let file = path("tables/psi.f32");
    let good = std::fs::read(&file).unwrap();
    let mut bad = good.clone();
    bad[4 * (256 + 7)] ^= 2;
    std::fs::write(&file, &bad).unwrap();
    fail(folder.path(), &["tables", "--check"], 1, &["node (7, 1)", "2 units", "psi.f32"]);
    assert_eq!(std::fs::read(&file).unwrap(), bad, "--check writes nothing");
    std::fs::write(&file, &good[1..]).unwrap();
    fail(folder.path(), &["tables", "--check"], 1, &["262143 bytes", "psi.f32"]);
    std::fs::write(&file, &good).unwrap();
    std::fs::write(path("tables/index.json"), "{}").unwrap();
    fail(folder.path(), &["tables", "--check"], 1, &["index.json"]);
}

#[test]
fn what_fails_is_one() {
    let folder = tempfile::tempdir().unwrap();
    let garbage = folder.path().join("garbage.vtu");
    std::fs::write(&garbage, "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>").unwrap();
    let half = folder.path().join("half.vtu");
    let fire = std::fs::read(FIRE).unwrap();
    std::fs::write(&half, &fire[..fire.len() / 2]).unwrap();
    std::fs::create_dir(folder.path().join("folder.png")).unwrap();
    let before = names(folder.path());
    fail(folder.path(), &["render", "missing.vtu", "-o", "a.png"], 1, &["cannot read", "missing.vtu"]);
    fail(folder.path(), &["render", "garbage.vtu", "-o", "a.png"], 1, &["garbage.vtu"]);
    fail(folder.path(), &["render", "half.vtu", "-o", "a.png"], 1, &["half.vtu"]);
    fail(folder.path(), &["info", "half.vtu"], 1, &["half.vtu"]);
    fail(folder.path(), &["render", FIRE, "-s", "missing.toml", "-o", "a.png"], 1, &["missing.toml"]);
    fail(folder.path(), &["render", FIRE, "-o", "nowhere/a.png"], 1, &["folder does not exist", "nowhere/a.png"]);
    fail(folder.path(), &["render", FIRE, "-o", "folder.png"], 1, &["a folder has this name"]);
    fail(folder.path(), &["compare", "garbage.png", "missing.png"], 1, &["garbage.png"]);
    assert_eq!(names(folder.path()), before, "nothing may be written");
}

#[test]
fn a_bad_scene_names_line_and_file() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("bad.toml");
    std::fs::write(&scene, "[image]\nwidth = 10\n\n[[transfer.widget]]\nshape = \"gaussian\"\nsigmas = 3\n").unwrap();
    fail(
        folder.path(),
        &["render", FIRE, "--scene", "bad.toml", "-o", "a.png"],
        2,
        &["scene line 6, transfer.widget.0.sigmas: unknown field", "bad.toml"],
    );
    assert_eq!(names(folder.path()), [scene]);
}

#[test]
fn a_sample_can_be_told_about() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["marschner-lobb", "hydrogen", "sphere-flow", "tangle"] {
        assert_eq!(succeed(folder.path(), &["sample", name, "--tets", "3000", "-o", "a.vtu"]), "");
        let info: Value = serde_json::from_str(&succeed(folder.path(), &["info", "a.vtu", "--json"])).unwrap();
        let tets = info["census"]["tets"].as_u64().unwrap();
        assert!((1000..9000).contains(&tets), "{name}: {tets}");
        assert!(info["scalar_range"][0].as_f64() < info["scalar_range"][1].as_f64(), "{name}");
        let power = &info["power_key"];
        assert!(power["pairs"].as_u64() > Some(1_000) && power["wrong"].as_u64() < power["pairs"].as_u64(), "{power}");
        let text = succeed(folder.path(), &["info", "a.vtu"]);
        assert!(text.contains("of neighbours wrong from 8 eyes"), "{text}");
        assert!(text.contains(info["arrays"][0]["name"].as_str().unwrap()), "{text}");
    }
}

#[test]
fn stats_are_one_line_of_json() {
    let folder = tempfile::tempdir().unwrap();
    let render = ["render", FIRE, "-s", SCENE, "--size", "24x16", "--device", "oracle", "-o", "a.exr"];
    let out = succeed(folder.path(), &[&render[..], &["--stats", "json", "--repeat", "3"]].concat());
    assert_eq!(out.lines().count(), 1, "{out}");
    let stats: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(stats["frames"], 3);
    assert_eq!((&stats["image"]["width"], &stats["image"]["height"]), (&24.into(), &16.into()));
    assert_eq!(stats["mesh"]["tets"], 62_772);
    let [median, min, max] =
        ["frame_seconds", "frame_seconds_min", "frame_seconds_max"].map(|key| stats[key].as_f64().unwrap());
    assert!(0.0 < min && min <= median && median <= max, "{out}");
    assert!(stats["adapter"].as_str().is_some_and(|a| !a.is_empty()), "{out}");
    assert!(stats["passes"].is_array() && stats["cells"].is_object(), "{out}");
    assert_eq!(names(folder.path()), [folder.path().join("a.exr")]);
    assert_eq!(succeed(folder.path(), &render), "", "nothing on stdout unless asked");
}

/// Each of these flags changes the picture; `--weld` has nothing to merge in this mesh.
#[test]
fn optics_flags_change_the_picture() {
    let folder = tempfile::tempdir().unwrap();
    let picture = |more: &[&str]| {
        let render = ["render", FIRE, "-s", SCENE, "--device", "oracle", "--size", "24x16", "-o", "a.exr"];
        succeed(folder.path(), &[&render[..], more].concat());
        std::fs::read(folder.path().join("a.exr")).unwrap()
    };
    let plain = picture(&[]);
    assert_eq!(picture(&["--weld"]), plain);
    let mut others = vec![plain];
    for flags in [
        &["--emission", "unweighted"][..],
        &["--light", "1,-2,3"],
        &["--light", "1,-2,3", "--light-space", "world"],
        &["--silhouette", "3"],
        &["--silhouette", "3", "--silhouette-mode", "depth"],
        &["--silhouette-mode", "opacity"],
    ] {
        let other = picture(flags);
        assert!(!others.contains(&other), "{flags:?} changed nothing");
        others.push(other);
    }
}

#[test]
fn flags_win_over_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let render = ["render", FIRE, "-s", SCENE, "--device", "oracle", "--width", "20"];
    succeed(folder.path(), &[&render[..], &["--height", "10", "-o", "a.png"]].concat());
    // The signature and the header chunk come first: width and height stand at byte 16.
    let png = std::fs::read(folder.path().join("a.png")).unwrap();
    assert_eq!(png[16..24], [0, 0, 0, 20, 0, 0, 0, 10]);
    succeed(folder.path(), &[&render[..], &["--height", "200", "--legend", "-o", "b.png"]].concat());
    let png = std::fs::read(folder.path().join("b.png")).unwrap();
    assert_eq!(png[16..24], [0, 0, 1, 4, 0, 0, 0, 200], "20 pixels of picture, 240 of legend");
}

#[test]
fn equal_pictures_compare_equal_and_others_do_not() {
    let folder = tempfile::tempdir().unwrap();
    let render = ["render", FIRE, "-s", SCENE, "--size", "24x16", "--device", "oracle"];
    succeed(folder.path(), &[&render[..], &["-o", "a.exr"]].concat());
    succeed(folder.path(), &[&render[..], &["--azimuth", "10", "-o", "b.exr"]].concat());
    succeed(folder.path(), &["compare", "a.exr", "a.exr", "--max-error", "0"]);
    let text = succeed(folder.path(), &["compare", "a.exr", "b.exr", "-o", "d.png", "--json"]);
    let comparison: Value = serde_json::from_str(&text).unwrap();
    assert!(comparison["max"].as_f64().unwrap() > 0.01, "{text}");
    assert!(folder.path().join("d.png").exists());
    let output = tetralux(folder.path(), &["compare", "a.exr", "b.exr", "--max-error", "0.01"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("more than 1e-2"));
    fail(folder.path(), &["compare", "a.exr", "d.jpg"], 1, &["d.jpg"]);
}

#[test]
fn a_histogram_holds_the_volume() {
    let folder = tempfile::tempdir().unwrap();
    let command = ["histogram", FIRE, "--field", "t", "-o", "h.png", "--csv", "h.csv", "--bins", "16x8"];
    assert_eq!(succeed(folder.path(), &command), "");
    let table = std::fs::read_to_string(folder.path().join("h.csv")).unwrap();
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("scalar,gradient_magnitude,volume"));
    let volumes: Vec<f64> = lines.map(|line| line.rsplit(',').next().unwrap().parse().unwrap()).collect();
    assert_eq!(volumes.len(), 16 * 8);
    // The mesh fills part of its bounding box of 6 x 2.5 x 2.4.
    let total: f64 = volumes.iter().sum();
    assert!(total > 1.0 && total < 36.1, "{total}");
    assert!(folder.path().join("h.png").exists());
}

#[test]
fn a_closed_pipe_is_no_failure() {
    let folder = tempfile::tempdir().unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_tetralux"))
        .current_dir(folder.path())
        .args(["info", FIRE])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && !stderr.contains("panicked") && !stderr.contains("error"), "{stderr}");
}

/// Ctrl-C ends it with the shell's code; what it was writing is there whole or not at all, and nothing else.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_in_parts() {
    let render = ["render", FIRE, "--scene", SCENE, "--device", "oracle", "--size", "400x300", "-o", "picture.exr"];
    let sample = ["sample", "tangle", "--tets", "300000", "-o", "mesh.vtu"];
    let mut interrupted = 0;
    for (arguments, file) in [(&render[..], "picture.exr"), (&sample[..], "mesh.vtu")] {
        // Some while it works, some while it writes.
        for milliseconds in [100, 250, 400, 600, 900] {
            let folder = tempfile::tempdir().unwrap();
            let mut command = Command::new(env!("CARGO_BIN_EXE_tetralux"));
            let command = command.current_dir(folder.path()).args(arguments).stderr(Stdio::null());
            let mut child = command.spawn().unwrap();
            std::thread::sleep(std::time::Duration::from_millis(milliseconds));
            Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
            let code = child.wait().unwrap().code();
            assert!(matches!(code, Some(0 | 130)), "{arguments:?} after {milliseconds} ms: {code:?}");
            interrupted += u32::from(code == Some(130));
            let left = names(folder.path());
            let whole = folder.path().join(file);
            assert!(left.is_empty() || left == [whole.clone()], "{arguments:?} after {milliseconds} ms: {left:?}");
            assert!(code == Some(130) || left == [whole], "{arguments:?} after {milliseconds} ms: {left:?}");
        }
    }
    assert!(interrupted > 2, "{interrupted} of 10 runs were interrupted");
}

#[test]
fn stability_is_charted() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["bench", "stability", "--device", "cpu", "-o", "out/s"];
    let table = succeed(folder.path(), &[&arguments[..], &["cycle", "parallel"]].concat());
    assert!(table.contains("| cycle | cpu | pass |") && table.lines().count() == 4, "{table}");
    let out = folder.path().join("out/s");
    assert_eq!(names(&out), ["cycle.svg", "parallel.svg", "stability.jsonl"].map(|name| out.join(name)));
    let rows = std::fs::read_to_string(out.join("stability.jsonl")).unwrap();
    let rows: Vec<Value> = rows.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert!(rows.len() == 11 && rows.iter().all(|row| row["verdict"] == "pass"), "{rows:?}");
    fail(folder.path(), &[&arguments[..], &["circle"]].concat(), 2, &["no case 'circle'", "cycle"]);
}
