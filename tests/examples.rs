//! The worked uses of `examples/` run: small, on the CPU, with a file and without. `gpu_` tests cover what needs a device.

#![allow(clippy::duplicate_mod, reason = "each example brings what they share")]

use std::path::Path;

use tetralux::Result;
use tetralux::image::Image;

#[path = "../examples/feature_enhancement.rs"]
#[expect(dead_code, reason = "its main is another program's")]
mod feature_enhancement;
#[path = "../examples/illustrative_silhouettes.rs"]
#[expect(dead_code, reason = "its main is another program's")]
mod illustrative_silhouettes;
#[path = "../examples/one_against_two.rs"]
#[expect(dead_code, reason = "its main is another program's")]
mod one_against_two;

#[path = "../examples/time_steps.rs"]
#[expect(dead_code, reason = "its main is another program's")]
mod time_steps;

const FIRE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/data/fire_ug.vtu");

fn arguments(more: &[&str], output: &Path) -> Vec<String> {
    let fixed = ["--size", "24x18", "--device", "oracle", "-o", output.to_str().expect("text")];
    more.iter().copied().chain(fixed).map(str::to_owned).collect()
}

/// Pixels that differ from the first one, its corner.
fn drawn(image: &Image) -> usize {
    image.pixels.iter().filter(|p| **p != image.pixels[0]).count()
}

fn runs(run: impl Fn(Vec<String>) -> Result<String>, more: &[&str], width: u32, told: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    let output = folder.path().join("picture.png");
    let said = run(arguments(more, &output)).expect("a picture");
    assert!(said.contains(told), "'{said}' lacks '{told}'");
    let image = Image::read(&output).expect("a picture");
    assert_eq!([image.width, image.height], [width, 18]);
    let drawn = drawn(&image);
    assert!(drawn > 40, "only {drawn} pixels show anything");
}

#[test]
fn every_program_has_a_mesh_to_fall_back_on() {
    runs(feature_enhancement::run, &[], 24, "'sphere-flow' stands in");
    runs(illustrative_silhouettes::run, &[], 24, "'tangle' stands in");
    runs(one_against_two::run, &[], 3 * 24 + 16, "'hydrogen' stands in");
}

#[test]
fn time_steps_replace_each_other() {
    let told = time_steps::run(["3000".to_owned()]).expect("pictures that differ");
    assert_eq!(told.len(), 6, "{told:?}");
    for (arguments, part) in [(["--device", "abacus"], "abacus"), (["3", "many"], "'many'")] {
        let error = time_steps::run(arguments.map(str::to_owned)).expect_err(part).to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn a_file_is_read() {
    runs(one_against_two::run, &[FIRE], 3 * 24 + 16, "field t, 62772 tetrahedra");
}

#[test]
fn a_program_says_what_it_does_not_understand() {
    for (more, part) in [
        (["--sise", "3"], "--sise"),
        (["--size", "3"], "640x480"),
        (["--device", "abacus"], "abacus"),
        (["/nowhere.vtu", "b.vtu"], "one too many"),
        (["--scene", "/nowhere.toml"], "/nowhere.toml"),
    ] {
        let error = feature_enhancement::run(more.map(str::to_owned)).expect_err(part).to_string();
        assert!(error.contains(part), "{error}");
    }
}
