//! Shader files: all are used, all compile, and what they bind does not clash.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use tetralux::gpu::shader::{Module, compose, pass_names};

/// Names of the files in a folder below `shaders/` ("" for the passes), without the ending.
fn files(folder: &str) -> BTreeSet<String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders").join(folder);
    fs::read_dir(path)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.is_file())
        .map(|path| {
            let name = path.file_name().expect("a name").to_string_lossy().into_owned();
            let stem = name.strip_suffix(".wgsl").unwrap_or_else(|| panic!("{name} is no shader"));
            if folder.is_empty() { stem.to_owned() } else { format!("{folder}/{stem}") }
        })
        .collect()
}

fn source(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders").join(format!("{name}.wgsl"));
    fs::read_to_string(path).expect("a shader file")
}

fn imports(source: &str) -> impl Iterator<Item = &str> {
    source.lines().filter_map(|line| line.strip_prefix("#import ")).map(str::trim)
}

/// Bindings that several variables share, whether a pass uses them or not.
fn shared_bindings(module: &naga::Module) -> Vec<String> {
    let mut places = BTreeMap::new();
    for (_, variable) in module.global_variables.iter() {
        if let Some(place) = &variable.binding {
            let name = variable.name.clone().unwrap_or_default();
            places.entry((place.group, place.binding)).or_insert_with(Vec::new).push(name);
        }
    }
    places
        .into_iter()
        .filter(|(_, names)| names.len() > 1)
        .map(|(place, names)| format!("{place:?} {names:?}"))
        .collect()
}

/// Names that end in a digit, which the translation to Rust would change, of functions and what is in them.
fn numbered_names(module: &naga::Module) -> Vec<String> {
    let mut names = Vec::new();
    for (_, function) in module.functions.iter() {
        names.extend(function.name.clone());
        names.extend(function.arguments.iter().filter_map(|a| a.name.clone()));
        names.extend(function.local_variables.iter().filter_map(|(_, v)| v.name.clone()));
        names.extend(function.named_expressions.values().cloned());
    }
    names.retain(|name| name.ends_with(|c: char| c.is_ascii_digit()));
    names
}

fn parse(source: &str) -> naga::Module {
    naga::front::wgsl::parse_str(source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)))
}

#[test]
fn every_pass_compiles() {
    for name in pass_names() {
        let module = Module::new(name).unwrap_or_else(|e| panic!("{e}"));
        assert!(!module.naga.entry_points.is_empty(), "'{name}' is a pass, but has no entry point");
        assert!(!module.bindings.is_empty(), "'{name}' binds nothing");
    }
}

#[test]
fn every_file_is_listed_and_used() {
    let passes: BTreeSet<String> = pass_names().map(str::to_owned).collect();
    assert_eq!(passes, files(""), "src/gpu/shader.rs lists what is in shaders/");
    let mut reached = BTreeSet::new();
    let mut next: Vec<String> = passes.into_iter().collect();
    while let Some(name) = next.pop() {
        for import in imports(&source(&name)) {
            if reached.insert(import.to_owned()) {
                next.push(import.to_owned());
            }
        }
    }
    let shared: BTreeSet<String> = files("math").into_iter().chain(files("shared")).collect();
    // A pass may be another one and more.
    let reached: BTreeSet<String> = reached.into_iter().filter(|name| name.contains('/')).collect();
    assert_eq!(reached, shared, "imported by some pass, and in shaders/math or shaders/shared");
}

#[test]
fn files_are_joined_once_each() {
    let joined = compose("raster").expect("a pass");
    assert_eq!(imports(&joined).count(), 0);
    // `math/optics` is imported twice on the way.
    assert_eq!(joined.matches("fn phi_one(").count(), 1);
    // Importing changes nothing but the joining.
    assert_eq!(compose("math/real").expect("a file"), source("math/real"));
}

#[test]
fn unknown_names_are_errors() {
    for name in ["nonsense", "", "math", "math/real.wgsl", " cull"] {
        let message = compose(name).expect_err("no such file").to_string();
        assert!(message.contains(&format!("'{name}'")), "{message}");
    }
}

#[test]
fn bindings_have_numbers_of_their_own() {
    for name in pass_names() {
        let module = Module::new(name).expect("a pass");
        assert_eq!(shared_bindings(&module.naga), [""; 0], "in '{name}'");
    }
    let planted = "@group(1) @binding(2) var<uniform> a: f32; @group(1) @binding(2) var<uniform> b: f32;";
    assert_eq!(shared_bindings(&parse(planted)).len(), 1);
}

#[test]
fn math_is_functions_of_values() {
    for name in files("math") {
        let module = parse(&compose(&name).expect("a file"));
        assert_eq!(module.global_variables.len(), 0, "'{name}' has variables");
        assert_eq!(module.entry_points.len(), 0, "'{name}' has entry points");
        assert_eq!(module.overrides.len(), 0, "'{name}' has overrides");
        assert_eq!(numbered_names(&module), [""; 0], "'{name}'");
    }
    let planted = "fn f1(a2: f32, b: f32) -> f32 { let c3 = a2; var d4 = b; d4 += c3; let e = d4; return e; }";
    let mut found = numbered_names(&parse(planted));
    found.sort();
    found.dedup();
    assert_eq!(found, ["a2", "c3", "d4", "f1"]);
}
