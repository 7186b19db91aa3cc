//! `shaders/math` in Rust, in f32 and in f64.

use std::fmt::Write;

use tetralux::gpu::shader::compose;

/// The translated text as it should stand in `translated.rs`.
pub fn translate() -> String {
    let mut text = String::from("// Made from shaders/math by `translate.rs`; not to be edited.\n");
    for (module, number) in [("single", "f32"), ("double", "f64")] {
        let source = source(number);
        let parsed = naga::front::wgsl::parse_str(&source).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)));
        let info = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga_rust_back::CAPABILITIES)
            .validate(&parsed)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&source)));
        let config = naga_rust_back::Config::new().public_items(true);
        let rust = naga_rust_back::write_string(&parsed, &info, config).expect("what naga-rust-back can translate");
        // The runtime has no square root of its own.
        writeln!(text, "pub mod {module} {{\nuse crate::root::SquareRoot;\n{rust}}}")
            .expect("a string takes everything");
    }
    text
}

/// All of `shaders/math` over one type of number.
fn source(number: &str) -> String {
    let numbers = compose("math/real").expect("a file");
    crate::cases::all_math().replace(&numbers, &numbers.replace("f32", number))
}
