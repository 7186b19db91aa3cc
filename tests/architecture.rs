//! What a crate boundary would be: which module of the library may use which, and a few habits that text can show.

use std::fs;
use std::path::{Path, PathBuf};

/// Top-level modules, lowest first: a module uses only those of lower layers. One layer's modules never see each other.
const LAYERS: &[&[&str]] = &[
    &["error"],
    &["space"],
    &["tables"],
    &["mesh"],
    &["tet"],
    &["scene"],
    &["plan"],
    &["image"],
    &["renderer"],
    &["oracle", "cpu", "gpu"],
    &["report"],
    &["cli"],
    &["viewer"],
];

/// What the user chose knows no mesh; only where it is applied to one, and the suggestion of a first transfer function, do.
const SCENE_USES: [&str; 3] = ["error", "space", "tables"];
const SCENE_MEETS_MESH: [&str; 2] = ["src/scene/resolve.rs", "src/scene/suggest.rs"];

/// Longest file, lines.
const LONGEST: usize = 600;

fn layer(module: &str) -> Option<usize> {
    LAYERS.iter().position(|layer| layer.contains(&module))
}

/// The file's code alone: comments are left out, and strings and characters emptied.
fn code_of(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let skip = literal_or_comment(rest);
        if skip == 0 {
            code.push(c);
            rest = &rest[c.len_utf8()..];
        } else {
            // Lines keep their numbers.
            code.extend(rest[..skip].chars().filter(|&c| c == '\n'));
            code.push(' ');
            rest = &rest[skip..];
        }
    }
    code
}

/// Bytes of the comment, string or character that `rest` begins with; 0 if it is none.
fn literal_or_comment(rest: &str) -> usize {
    let until = |from: usize, end: &str| rest[from..].find(end).map_or(rest.len(), |at| from + at + end.len());
    if rest.starts_with("//") {
        return rest.find('\n').unwrap_or(rest.len());
    }
    if rest.starts_with("/*") {
        return until(2, "*/");
    }
    if rest.starts_with("r\"") {
        return until(2, "\"");
    }
    if rest.starts_with("r#\"") {
        return until(3, "\"#");
    }
    if rest.starts_with("'\\") {
        return until(3, "'");
    }
    let mut chars = rest.char_indices();
    if rest.starts_with('\'') {
        // A character, or a lifetime.
        return match chars.nth(2) {
            Some((at, '\'')) => at + 1,
            _ => 0,
        };
    }
    if !rest.starts_with('"') {
        return 0;
    }
    chars.next();
    while let Some((at, c)) = chars.next() {
        match c {
            '\\' => drop(chars.next()),
            '"' => return at + 1,
            _ => {}
        }
    }
    rest.len()
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Where `word` stands as a word of its own.
fn finds<'a>(code: &'a str, word: &'a str) -> impl Iterator<Item = usize> + 'a {
    code.match_indices(word).map(|(at, _)| at).filter(move |&at| {
        !code[..at].chars().next_back().is_some_and(is_word) && !code[at + word.len()..].starts_with(is_word)
    })
}

/// The first names of all paths from the library's root, with the lines they stand on.
fn roots_used(file: &str, code: &str) -> Vec<(usize, String)> {
    let mut used = Vec::new();
    let mut take = |at: usize, path: &str, must_be_module: bool| {
        let line = code[..at].matches('\n').count() + 1;
        for name in first_names(path) {
            if !must_be_module || layer(&name).is_some() {
                used.push((line, name));
            }
        }
    };
    for at in finds(code, "crate") {
        if let Some(path) = code[at..].strip_prefix("crate::") {
            take(at, path, false);
        }
    }
    // `super` as often as the file is deep names the root too.
    let below = file.trim_end_matches("/mod.rs").matches('/').count();
    for at in finds(code, "super").filter(|&at| !code[..at].ends_with("super::")) {
        let path = code[at..].trim_start_matches("super::");
        if (code[at..].len() - path.len()) / "super::".len() >= below {
            take(at, path, true);
        }
    }
    used
}

/// `a` of `a::b`; `a` and `c` of `{a::b, c}`.
fn first_names(path: &str) -> Vec<String> {
    let name = |s: &str| s.trim_start().chars().take_while(|&c| is_word(c)).collect::<String>();
    let Some(group) = path.strip_prefix('{') else { return vec![name(path)] };
    let mut names = Vec::new();
    let (mut depth, mut start) = (0, 0);
    for (at, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                names.push(name(&group[start..at]));
                start = at + 1;
                if c == '}' {
                    break;
                }
            }
            _ => {}
        }
    }
    names.retain(|n| !n.is_empty());
    names
}

/// Everything wrong with a file of the library. `file` is its path from the package's root, with slashes.
fn violations(file: &str, text: &str) -> Vec<String> {
    let code = code_of(text);
    let mut wrong = Vec::new();
    if text.lines().count() > LONGEST {
        wrong.push(format!("{file}: {} lines are more than {LONGEST}", text.lines().count()));
    }
    let module = file.trim_start_matches("src/").split(['/', '.']).next().unwrap_or_default();
    let is_root = file == "src/lib.rs" || module == "bin";
    if !is_root {
        match layer(module) {
            None => wrong.push(format!("{file}: the order of modules does not name '{module}'")),
            Some(here) => wrong.extend(
                roots_used(file, &code)
                    .into_iter()
                    .filter(|(_, used)| !may_use(file, module, here, used))
                    .map(|(line, used)| format!("{file}:{line}: '{module}' uses '{used}', which is not below it")),
            ),
        }
    }
    let mut forbid = |word: &str, except: &[&str], why: &str| {
        if !except.contains(&module) && finds(&code, word).next().is_some() {
            wrong.push(format!("{file}: '{word}' {why}"));
        }
    };
    forbid("wgpu", &["gpu", "viewer"], "belongs to src/gpu, and to the window, which is drawn with it");
    for word in ["print", "println", "eprint", "eprintln"].map(|w| format!("{w}!")) {
        forbid(&word, &["cli", "viewer", "bin"], "is not the library's business");
    }
    wrong
}

fn may_use(file: &str, module: &str, here: usize, used: &str) -> bool {
    // What the root re-exports.
    let used = if used == "Error" || used == "Result" { "error" } else { used };
    if used == module {
        return true;
    }
    if module == "scene" {
        return SCENE_USES.contains(&used) || (used == "tet" && SCENE_MEETS_MESH.contains(&file));
    }
    layer(used).is_some_and(|there| there < here)
}

fn files_below(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").path()) {
        if entry.is_dir() {
            files.extend(files_below(&entry, ending));
        } else if entry.extension().is_some_and(|e| e == ending) {
            files.push(entry);
        }
    }
    files.sort();
    files
}

fn package() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Paths from the package's root, and texts.
fn texts(folder: &str, ending: &str) -> Vec<(String, String)> {
    files_below(&package().join(folder), ending)
        .into_iter()
        .map(|path| {
            let name = path.strip_prefix(package()).expect("below").to_string_lossy().replace('\\', "/");
            (name, fs::read_to_string(&path).expect("text"))
        })
        .collect()
}

#[test]
fn modules_use_only_what_is_below_them() {
    let files = texts("src", "rs");
    assert!(files.len() > 50, "only {} files were found", files.len());
    let wrong: Vec<_> = files.iter().flat_map(|(file, text)| violations(file, text)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    // The checker does see uses: the pipeline cannot do without these.
    let uses = |file: &str| {
        let (_, text) = files.iter().find(|(name, _)| name == file).expect(file);
        roots_used(file, &code_of(text)).into_iter().map(|(_, used)| used).collect::<Vec<_>>()
    };
    assert!(uses("src/gpu/renderer.rs").contains(&"tet".into()));
    assert!(uses("src/scene/suggest.rs").contains(&"tet".into()));
}

#[test]
fn other_files_are_short_too() {
    let is_generated = |text: &str| text.starts_with("// Made from ");
    let written = texts("tests", "rs").into_iter().filter(|(_, text)| !is_generated(text));
    for (file, text) in written.chain(texts("shaders", "wgsl")) {
        assert!(text.lines().count() <= LONGEST, "{file} has {} lines", text.lines().count());
    }
}

#[test]
fn planted_violations_are_found() {
    for (file, text) in [
        ("src/tet/split.rs", "use crate::scene::Camera;"),
        ("src/mesh/xml/vtu.rs", "fn f() -> crate::tet::TetId { loop {} }"),
        ("src/oracle/cell.rs", "use crate::gpu::Gpu;"),
        ("src/gpu/mod.rs", "use crate::oracle::Oracle;"),
        ("src/scene/camera.rs", "use crate::tet::TetMesh;"),
        ("src/scene/camera.rs", "use crate::mesh::Mesh;"),
        ("src/plan/near.rs", "use crate::{error::{Error, Result}, image::Image};"),
        ("src/image/file.rs", "use crate::{\n    error::Error,\n    renderer::Frame,\n};"),
        ("src/mesh/xml/vtu.rs", "use super::super::super::tet::TetMesh;"),
        ("src/space.rs", "use super::mesh::Mesh;"),
        ("src/tet/mod.rs", "use super::scene::Camera;"),
        ("src/tet/mod.rs", "fn f<'a>(c: char) { if c == '\"' { crate::plan::near::f::<'a>() } }"),
        ("src/surprise/mod.rs", ""),
        ("src/plan/near.rs", "use crate::Renderer;"),
        ("src/renderer.rs", "fn f(device: &wgpu::Device) {}"),
        ("src/tet/mod.rs", "fn f() { println!(\"\"); }"),
        ("src/lib.rs", "fn f() { eprintln!(\"\"); }"),
        ("src/tet/mod.rs", &"\n".repeat(LONGEST + 1)),
    ] {
        assert_eq!(violations(file, text).len(), 1, "{file}: {text} gives {:?}", violations(file, text));
    }
}

#[test]
fn what_is_allowed_is_not_found() {
    for (file, text) in [
        ("src/gpu/mesh.rs", "use crate::gpu::device::Gpu;\nuse crate::{space, tet::TetMesh};\nuse wgpu::Buffer;"),
        ("src/scene/suggest.rs", "use crate::tet::TetMesh;"),
        ("src/mesh/mod.rs", "use crate::Error;\nmod tests { use super::*; }"),
        (
            "src/tet/split.rs",
            "// crate::scene, wgpu\n/// [`crate::scene::Camera`]\n/* crate::gpu */ const A: &str = \"crate::gpu\";",
        ),
        ("src/tet/split.rs", "const A: &str = \"\\\"wgpu\"; const B: &str = r#\"\"wgpu\"#; const C: char = '\\'';"),
        ("src/tet/split.rs", "use super::scene::Thing;"),
        ("src/cli/run.rs", "use crate::gpu::Gpu; fn f() { println!(); }"),
        ("src/bin/tetralux.rs", "fn main() { eprintln!(); }"),
        ("src/tet/mod.rs", &"\n".repeat(LONGEST)),
    ] {
        assert!(violations(file, text).is_empty(), "{file}: {text} gives {:?}", violations(file, text));
    }
}
