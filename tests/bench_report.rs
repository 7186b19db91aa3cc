//! `tetralux bench report` and `diff` as a user meets them: a page that asks nobody for anything, charts that are SVG,
//! exit codes, messages.
#![cfg(feature = "cli")]

use std::path::Path;
use std::process::{Command, Output};

use roxmltree::Document;
use tetralux::image::{Image, PngEncoding};
use tetralux::report::record::{Contender, Deviation, Machine, Measured, Pass, Record, Spread, Subject};

const MESHES: [(&str, u64); 3] = [("fire", 62_772), ("cube & co", 300_000), ("jet<1>", 1_500_000)];
const SCENES: [&str; 2] = ["bands", "\"fog\""];
const SIZES: [[u32; 2]; 2] = [[640, 480], [1280, 960]];
const VIEWS: [&str; 2] = ["front", "side"];
/// Device, method, integral, order; a factor of time and a RMSE.
const CONTENDERS: [([&str; 4], f64, f64); 5] = [
    (["oracle", "raycast", "adaptive:1e-12", "exact"], 500.0, 0.0),
    (["cpu", "raycast", "adaptive:0.001", "per-pixel"], 60.0, 2e-5),
    (["gpu", "project", "segmented:8", "power"], 1.0, 3e-3),
    (["gpu", "raycast", "adaptive:0.001", "per-pixel"], 3.0, 2e-5),
    // Beaten by the one before it.
    (["gpu", "cellcast", "mean-scalar", "centroid"], 4.0, 4e-2),
];

fn records() -> Vec<Record> {
    let mut records = Vec::new();
    for (mesh, tetrahedra) in MESHES {
        for (scene, size, view) in SCENES
            .iter()
            .flat_map(|scene| SIZES.iter().flat_map(move |size| VIEWS.iter().map(move |view| (*scene, *size, *view))))
        {
            let hash = format!("{:016x}", records.len());
            let subject = Subject { mesh: mesh.into(), scene: scene.into(), view: view.into(), size, tetrahedra, hash };
            let work = tetrahedra as f64 * 1e-8 * f64::from(size[0]) / 640.0;
            for (by, factor, rmse) in CONTENDERS {
                records.push(record(&subject, by, factor * work, rmse));
            }
        }
    }
    records
}

fn record(subject: &Subject, by: [&str; 4], seconds: f64, rmse: f64) -> Record {
    let [device, method, integral, order] = by.map(String::from);
    let pass = |(name, share): (&str, f64)| Pass { name: name.into(), seconds: share * seconds };
    let measured = Measured {
        frame_seconds: Spread { median: seconds, min: 0.9 * seconds, max: 1.2 * seconds, frames: 9 },
        cpu_seconds: None,
        passes: if device == "gpu" { [("cull", 0.2), ("raster", 0.7)].map(pass).to_vec() } else { Vec::new() },
        drawn: None,
        prepare_seconds: None,
        device_bytes: Some(100 * subject.tetrahedra),
        peak_bytes: None,
        chosen: None,
        error: Deviation {
            max: 9.0 * rmse,
            rmse,
            psnr: (rmse > 0.0).then(|| -20.0 * rmse.log10()),
            percentile_99_9: 5.0 * rmse,
            above_8_bit: 0.0,
        },
    };
    let machine = Machine {
        processor: "Processor of 2 cores".into(),
        threads: 2,
        memory_bytes: 8 << 30,
        system: "Linux".into(),
        adapter: "Adapter, driver 1".into(),
        commit: "0123abc".into(),
    };
    let by = Contender { program: "tetralux".into(), device, method, integral, order };
    Record { subject: subject.clone(), by, machine, result: Some(measured), refused: None }
}

fn write(path: &Path, records: &[Record]) {
    let lines: Vec<String> = records.iter().map(|r| serde_json::to_string(r).unwrap()).collect();
    std::fs::write(path, lines.join("\n") + "\n").unwrap();
}

fn tetralux(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tetralux")).current_dir(folder).args(arguments).output().unwrap()
}

fn fail(folder: &Path, arguments: &[&str], code: i32, parts: &[&str]) -> String {
    let output = tetralux(folder, arguments);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {stderr}");
    assert!(!stderr.contains("panicked"), "{stderr}");
    for part in parts {
        assert!(stderr.contains(part), "{arguments:?}: {stderr}\nlacks {part}");
    }
    String::from_utf8(output.stdout).unwrap()
}

/// Texts of all elements `name`.
fn texts<'a>(document: &'a Document<'_>, name: &str) -> Vec<&'a str> {
    document.descendants().filter(|n| n.has_tag_name(name)).filter_map(|n| n.text()).map(str::trim).collect()
}

fn svg<'a>(files: &'a [(String, String)], name: &str) -> Document<'a> {
    let (_, text) = files.iter().find(|(file, _)| file == name).unwrap_or_else(|| panic!("no {name}"));
    Document::parse(text).unwrap()
}

#[test]
fn a_report_is_one_page_and_charts() {
    let folder = tempfile::tempdir().unwrap();
    let mut all = records();
    // Another program, in a folder of its own, refuses one and repeats another.
    let mut refused = all[0].clone();
    refused.by.program = "Other 1.0".into();
    (refused.result, refused.refused) = (None, Some("no <such> cells".into()));
    let mut peer = all[2].clone();
    peer.by.program = "Other 1.0".into();
    let peers = folder.path().join("peers");
    std::fs::create_dir(&peers).unwrap();
    write(&peers.join("other.jsonl"), &[refused, peer]);
    // Measured again: the last counts.
    all.push(all[2].clone());
    write(&folder.path().join("records.jsonl"), &all);
    let output = tetralux(folder.path(), &["bench", "report", "records.jsonl", "--peers", "peers", "-o", "new/page"]);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success() && output.stdout.is_empty(), "{stderr}");

    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder.path().join("new/page")).unwrap().map(|e| e.unwrap()) {
        files.push((entry.file_name().into_string().unwrap(), std::fs::read_to_string(entry.path()).unwrap()));
    }
    let page = &files.iter().find(|(name, _)| name == "report.html").unwrap().1;
    assert!(!page.contains("http://") && !page.contains("https://") && !page.contains("url("), "it asks nobody");
    for part in ["jet&lt;1&gt;", "cube &amp; co", "&quot;fog&quot;", "no &lt;such&gt; cells", "aria-sort", "0123abc"] {
        assert!(page.contains(part), "the page lacks {part}");
    }
    assert!(!page.contains("jet<1>"), "text is escaped");
    assert_eq!(page.matches("<tr><td>").count(), 3 * 2 * 2 * 2 * 5 + 1 + 1, "runs, one of a peer's, its refusal");
    // 12 of error, 4 against tetrahedra, 12 of passes; two sizes are no growth.
    assert_eq!(page.matches("<figure class=\"chart\"").count(), 12 + 4 + 12);
    assert_eq!(files.len(), 1 + 2 * (12 + 4 + 12));
    assert!(page.contains("fire · bands: 2 of the three sizes"), "what is left out is told");

    for (name, text) in files.iter().filter(|(name, _)| name != "report.html") {
        let document = Document::parse(text).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(document.root_element().tag_name().namespace(), Some("http://www.w3.org/2000/svg"), "{name}");
        assert!(name.ends_with("-light.svg") || name.ends_with("-dark.svg"), "{name}");
    }
    let speed = svg(&files, "speed-fire-bands-640x480-light.svg");
    assert_eq!(texts(&speed, "title").len(), 6, "a title a point: five contenders and a peer");
    let told = texts(&speed, "title").into_iter().find(|t| t.contains("gpu raycast")).unwrap();
    for part in ["views: 2", "time: 1.88 ms (1.69 to 2.26)", "RMSE: 2.00e-5", "PSNR: 94.0 dB", "order: per-pixel"] {
        assert!(told.contains(part), "{told}\nlacks {part}");
    }
    assert!(texts(&speed, "text").contains(&"0, equal"), "the oracle's line");
    let growth = svg(&files, "tetrahedra-bands-640x480-dark.svg");
    let fits: Vec<_> = texts(&growth, "text").into_iter().filter(|t| t.contains("exponent 1.00 ± 0.00")).collect();
    assert_eq!(fits.len(), 5, "times are proportional to tetrahedra: {:?}", texts(&growth, "text"));
}

#[test]
fn pictures_beside_the_records_are_shown() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let all = records();
    write(&path("records.jsonl"), &all);
    let shown = &all[2];
    let hash = &shown.subject.hash;
    for folder in ["truth".to_owned(), format!("pictures/{hash}")] {
        std::fs::create_dir_all(path(&folder)).unwrap();
    }
    let mut picture = Image::new(16, 12);
    picture.write(&path(&format!("truth/{hash}.exr")), PngEncoding::Srgb).unwrap();
    picture.pixels[5] = [0.01, 0.0, 0.0, 0.02];
    let drawn = path(&format!("pictures/{hash}/tetralux-gpu-project-segmented_8-power.exr"));
    picture.write(&drawn, PngEncoding::Srgb).unwrap();
    assert!(tetralux(folder.path(), &["bench", "report", "records.jsonl"]).status.success());
    let page = std::fs::read_to_string(path("report.html")).unwrap();
    assert_eq!(page.matches("data:image/png;base64,").count(), 3, "a reference, a picture, a difference");
    // Of another size than the reference: nothing is written.
    std::fs::remove_file(path("report.html")).unwrap();
    Image::new(3, 3).write(&drawn, PngEncoding::Srgb).unwrap();
    fail(folder.path(), &["bench", "report", "records.jsonl"], 1, &["16x12", "segmented_8-power.exr"]);
    assert!(!path("report.html").exists());
}

#[test]
fn a_diff_fails_where_something_is_worse() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let all = records();
    write(&path("old.jsonl"), &all);
    let diff = ["bench", "diff", "old.jsonl", "new.jsonl"];
    // Noise and a better error.
    let mut new = all.clone();
    new[1].result.as_mut().unwrap().frame_seconds.median *= 1.1;
    new[2].result.as_mut().unwrap().error.rmse *= 0.5;
    write(&path("new.jsonl"), &new);
    let output = tetralux(folder.path(), &diff);
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("nothing became worse") && text.contains("errors shrank: 1"), "{text}");
    // One per cent more, planted.
    new[7].result.as_mut().unwrap().error.rmse *= 1.01;
    write(&path("new.jsonl"), &new);
    let text = fail(folder.path(), &diff, 1, &["worse", "old.jsonl", "new.jsonl"]);
    assert!(text.contains("errors grew: 1") && text.contains("segmented:8") && text.contains("+1.00 %"), "{text}");
    let json = fail(folder.path(), &[&diff[..], &["--json"]].concat(), 1, &["worse"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!((&json["errors_grew"][0]["what"], &json["compared"]), (&"rmse".into(), &all.len().into()));
    write(&path("new.jsonl"), &all[1..]);
    assert!(fail(folder.path(), &diff, 1, &["worse"]).contains("missing: 1"));
    new.iter_mut().for_each(|r| r.subject.hash = "0".into());
    write(&path("new.jsonl"), &new);
    assert!(fail(folder.path(), &diff, 1, &["nothing could be compared"]).contains("hash changed: "));
}

#[test]
fn mistakes_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    for arguments in [
        &["bench"][..],
        &["bench", "report"],
        &["bench", "diff", "a.jsonl"],
        &["bench", "quicker"],
        &["bench", "report", "--sorted", "a.jsonl"],
    ] {
        fail(folder.path(), arguments, 2, &[]);
    }
    let good = serde_json::to_string(&records()[0]).unwrap();
    std::fs::write(path("bad.jsonl"), format!("{good}\n{good}\nnonsense\n")).unwrap();
    write(&path("good.jsonl"), &records());
    write(&path("empty.jsonl"), &[]);
    std::fs::create_dir(path("peers")).unwrap();
    std::fs::create_dir(path("taken")).unwrap();
    std::fs::create_dir(path("taken/report.html")).unwrap();
    fail(folder.path(), &["bench", "report", "bad.jsonl"], 1, &["line 3", "bad.jsonl"]);
    fail(folder.path(), &["bench", "diff", "good.jsonl", "bad.jsonl"], 1, &["line 3", "bad.jsonl"]);
    fail(folder.path(), &["bench", "report", "missing.jsonl"], 1, &["cannot read", "missing.jsonl"]);
    fail(folder.path(), &["bench", "report", "empty.jsonl"], 1, &["no records", "empty.jsonl"]);
    fail(folder.path(), &["bench", "report", "good.jsonl", "--peers", "nowhere"], 1, &["cannot read", "nowhere"]);
    fail(folder.path(), &["bench", "report", "--peers", "peers"], 1, &["no .jsonl", "peers"]);
    fail(folder.path(), &["bench", "report", "good.jsonl", "-o", "taken"], 1, &["a folder has this name"]);
    let left: Vec<_> = std::fs::read_dir(path("taken")).unwrap().collect();
    assert_eq!(left.len(), 1, "nothing is written in parts");
}
