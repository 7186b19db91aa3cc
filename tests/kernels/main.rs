//! The formulas of `shaders/math` without a GPU: translated from WGSL to Rust, they are compared with their definitions
//! in f64, which shows the formulas' own errors, and in f32, which adds rounding.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

#[path = "../common/kernels.rs"]
#[expect(dead_code, reason = "the WGSL calls are for the tests on a device")]
mod cases;
mod root;
mod translate;
#[allow(warnings, clippy::all, clippy::allow_attributes_without_reason, reason = "translated by a tool")]
mod translated {
    include!("translated.rs");
}

use cases::Measure::{Absolute, Relative};
use cases::{ARGUMENTS, Budget, Kernel, all, budget, check, planted, planted_nan};
use naga_rust_rt::{Vec2, Vec4};

/// Errors of the formulas, in f64; measured values beside.
const FORMULA: &[Budget] = &[
    budget("attenuation", 0, Relative, 1e-15),              // 0
    budget("phi_one", 0, Relative, 2e-8),                   // 1.86e-8
    budget("phi_one_unit", 0, Relative, 1.25e-7),           // 1.19e-7
    budget("erfcx", 0, Relative, 8.5e-8),                   // 8.32e-8
    budget("thin_weights", 0, Relative, 1.25e-7),           // 1.19e-7
    budget("thin_weights", 1, Absolute, 3.8e-6),            // 3.74e-6: of degree 4
    budget("gaussian_mean", 0, Absolute, 7.2e-8),           // 6.93e-8
    budget("clip_to_range", 0, Absolute, 1e-15),            // 4.4e-16
    budget("clip_to_range", 1, Absolute, 1e-15),            // 3.3e-16
    budget("sine_of_turns", 0, Absolute, 4.8e-8),           // 4.23e-8
    budget("sine_of_turns", 1, Absolute, 4.8e-8),           // 4.23e-8
    budget("sinc_complement", 0, Relative, 8.3e-8),         // 7.41e-8
    budget("sinc_complement", 1, Absolute, 2e-8),           // 1.71e-8
    budget("cosine_mean", 0, Absolute, 3.8e-8),             // 3.36e-8
    budget("cosine_mean", 0, Relative, 8.7e-8),             // 7.74e-8
    budget("cosine_mean_weighted", 0, Absolute, 3.6e-8),    // 3.13e-8
    budget("cosine_mean_weighted", 0, Relative, 1.5e-7),    // 1.25e-7
    budget("arch_mean", 0, Absolute, 6.1e-8),               // 5.37e-8
    budget("arch_mean", 0, Relative, 9.5e-8),               // 8.45e-8
    budget("arch_mean_weighted", 0, Absolute, 4.9e-8),      // 4.32e-8
    budget("arch_mean_weighted", 0, Relative, 9.5e-8),      // 8.45e-8
    budget("half_mean", 0, Absolute, 6.1e-8),               // 5.37e-8
    budget("half_mean", 0, Relative, 9.5e-8),               // 8.46e-8
    budget("half_mean_weighted", 0, Absolute, 4.8e-8),      // 4.26e-8
    budget("half_mean_weighted", 0, Relative, 9.5e-8),      // 8.46e-8
    budget("triangle_mean", 0, Absolute, 1.4e-15),          // 1.17e-15
    budget("triangle_mean", 0, Relative, 1.1e-14),          // 9.21e-15
    budget("triangle_mean_weighted", 0, Absolute, 9.4e-15), // 8.35e-15
    budget("triangle_mean_weighted", 0, Relative, 6e-11),   // 5.34e-11
    budget("triangle_mean_narrow", 0, Absolute, 5.8e-15),   // 5.11e-15
    budget("triangle_mean_narrow", 0, Relative, 1.8e-14),   // 1.60e-14
    budget("waves_at", 0, Absolute, 9.5e-8),                // 8.46e-8
    budget("waves_at", 1, Absolute, 9.5e-8),                // 8.46e-8
    budget("dawson", 0, Relative, 2.5e-7),                  // 2.18e-7
    budget("psi", 0, Absolute, 7.9e-7),                     // 6.97e-7
    budget("psi", 0, Relative, 1.6e-6),                     // 1.35e-6
    budget("color_weights", 0, Absolute, 6.2e-7),           // 5.48e-7
    budget("color_weights", 0, Relative, 9.1e-7),           // 8.06e-7
    budget("color_weights", 1, Absolute, 5.2e-7),           // 4.58e-7
    budget("color_weights", 1, Relative, 1.8e-6),           // 1.54e-6
    budget("emission_weights", 0, Absolute, 7.5e-7),        // 6.65e-7
    budget("emission_weights", 1, Absolute, 8.2e-7),        // 7.25e-7
    budget("emission_shares", 0, Absolute, 4.7e-6),         // 4.14e-6
    budget("emission_shares", 1, Absolute, 4.7e-6),         // 4.14e-6
    budget("linear_product_mean", 0, Relative, 8e-16),      // 7.06e-16
    budget("line_at", 0, Absolute, 1e-15),                  // 0.00e+00
    budget("gaussian_product_mean", 0, Absolute, 7.6e-8),   // 6.75e-8
    budget("gaussian_product_mean", 0, Relative, 4.4e-6),   // 3.86e-6
];

/// Errors in f32.
const SINGLE: &[Budget] = &[
    budget("attenuation", 0, Relative, 7e-8),              // 5.87e-8
    budget("phi_one", 0, Relative, 1.3e-7),                // 1.08e-7
    budget("phi_one_unit", 0, Relative, 2.3e-7),           // 2.06e-7
    budget("erfcx", 0, Relative, 2.6e-7),                  // 2.23e-7
    budget("thin_weights", 0, Relative, 2.5e-7),           // 2.23e-7
    budget("thin_weights", 1, Absolute, 3.9e-6),           // 3.75e-6
    budget("gaussian_mean", 0, Absolute, 2.9e-7),          // 2.59e-7
    budget("clip_to_range", 0, Absolute, 1.2e-7),          // 9.82e-8
    budget("clip_to_range", 1, Absolute, 9e-8),            // 6.94e-8
    budget("sine_of_turns", 0, Absolute, 2e-7),            // 1.77e-7
    budget("sine_of_turns", 1, Absolute, 2.1e-7),          // 1.87e-7
    budget("sinc_complement", 0, Relative, 3.6e-7),        // 3.14e-7
    budget("sinc_complement", 1, Absolute, 1.1e-7),        // 9.20e-8
    budget("cosine_mean", 0, Absolute, 1.3e-7),            // 1.16e-7
    budget("cosine_mean", 0, Relative, 3.4e-7),            // 2.99e-7
    budget("cosine_mean_weighted", 0, Absolute, 1.3e-7),   // 1.08e-7
    budget("cosine_mean_weighted", 0, Relative, 5.2e-7),   // 4.58e-7
    budget("arch_mean", 0, Absolute, 2e-7),                // 1.70e-7
    budget("arch_mean", 0, Relative, 3.3e-7),              // 2.86e-7
    budget("arch_mean_weighted", 0, Absolute, 1.6e-7),     // 1.41e-7
    budget("arch_mean_weighted", 0, Relative, 4e-7),       // 3.51e-7
    budget("half_mean", 0, Absolute, 2e-7),                // 1.70e-7
    budget("half_mean", 0, Relative, 3.4e-7),              // 2.98e-7
    budget("half_mean_weighted", 0, Absolute, 1.6e-7),     // 1.40e-7
    budget("half_mean_weighted", 0, Relative, 3.7e-7),     // 3.23e-7
    budget("triangle_mean", 0, Absolute, 1.8e-7),          // 1.54e-7
    budget("triangle_mean", 0, Relative, 2.1e-7),          // 1.85e-7
    budget("triangle_mean_weighted", 0, Absolute, 9.9e-8), // 8.77e-8
    budget("triangle_mean_weighted", 0, Relative, 2.4e-7), // 2.12e-7
    budget("triangle_mean_narrow", 0, Absolute, 1.8e-7),   // 1.58e-7
    budget("triangle_mean_narrow", 0, Relative, 2e-7),     // 1.71e-7
    budget("waves_at", 0, Absolute, 4.6e-7),               // 4.03e-7
    budget("waves_at", 1, Absolute, 3.7e-7),               // 3.25e-7
    budget("dawson", 0, Relative, 4.5e-7),                 // 3.93e-7
    budget("psi", 0, Absolute, 8.1e-7),                    // 7.21e-7
    budget("psi", 0, Relative, 1.6e-6),                    // 1.39e-6
    budget("color_weights", 0, Absolute, 8e-7),            // 7.08e-7
    budget("color_weights", 0, Relative, 1.2e-6),          // 1.04e-6
    budget("color_weights", 1, Absolute, 5.4e-7),          // 4.80e-7
    budget("color_weights", 1, Relative, 1.9e-6),          // 1.69e-6
    budget("emission_weights", 0, Absolute, 1.2e-6),       // 9.83e-7
    budget("emission_weights", 1, Absolute, 1.3e-6),       // 1.08e-6
    budget("emission_shares", 0, Absolute, 8.2e-6),        // 7.32e-6
    budget("emission_shares", 1, Absolute, 8.2e-6),        // 7.26e-6
    budget("linear_product_mean", 0, Relative, 1.7e-7),    // 1.47e-7
    budget("line_at", 0, Absolute, 6.1e-8),                // 5.42e-8
    budget("gaussian_product_mean", 0, Absolute, 2.1e-7),  // 1.79e-7
    budget("gaussian_product_mean", 0, Relative, 2.3e-5),  // 2.03e-5
];

/// Calls the translation `$module` over the numbers `$number`.
macro_rules! call {
    ($module:ident, $number:ty, $kernel:expr, $x:expr) => {{
        use translated::$module as t;
        let x: [$number; ARGUMENTS] = $x;
        let pair = |i: usize| Vec2::<$number>::new(x[i], x[i + 1]);
        match $kernel.name {
            "attenuation" => [t::attenuation(x[0]), 0.0],
            "phi_one" => [t::phi_one(x[0]), 0.0],
            "phi_one_unit" => [t::phi_one_unit(x[0]), 0.0],
            "erfcx" => [t::erfcx(x[0]), 0.0],
            "thin_weights" => t::thin_weights(x[0], x[1]).into(),
            "gaussian_mean" => [t::gaussian_mean(pair(0), pair(2)), 0.0],
            "clip_to_range" => {
                let [start, end]: [$number; 2] = t::clip_to_range(pair(0), x[2], x[3], x[4], x[5]).into();
                let share = (end - start).max(0.0);
                [share, share * start]
            }
            "sine_of_turns" => [t::sine_of_turns(x[0]), t::cosine_of_turns(x[0])],
            "sinc_complement" => [t::sinc_complement(x[0]), t::bessel_one(x[0])],
            "cosine_mean" | "cosine_mean_weighted" => [t::cosine_mean(pair(0), pair(2)), 0.0],
            "arch_mean" | "arch_mean_weighted" => [t::arch_mean(pair(0), pair(2), false), 0.0],
            "half_mean" | "half_mean_weighted" => [t::arch_mean(pair(0), pair(2), true), 0.0],
            "triangle_mean" | "triangle_mean_weighted" | "triangle_mean_narrow" => {
                [t::triangle_mean(pair(0), pair(2), x[4]), 0.0]
            }
            "waves_at" => {
                [t::cosine_at(x[0]) + t::triangle_at(x[0], x[4]), t::arch_at(x[0], false) + t::arch_at(x[0], true)]
            }
            "dawson" => [t::dawson(x[0]), 0.0],
            "psi" => [t::psi(x[0], x[1]), 0.0],
            "color_weights" => t::color_weights(x[0], x[1]).into(),
            "emission_weights" => t::emission_weights(x[0], x[1]).into(),
            "emission_shares" => {
                let [front, back]: [$number; 2] = t::emission_weights(x[0], x[1]).into();
                [x[0] * front, x[1] * back]
            }
            "linear_product_mean" => [t::linear_product_mean(pair(0), pair(2)), 0.0],
            "line_at" => [t::line_at(Vec4::<$number>::new(x[0], x[1], x[2], x[3]), x[4]), 0.0],
            "gaussian_product_mean" => [t::gaussian_product_mean(pair(0), pair(2), pair(4)), 0.0],
            name => panic!("'{name}' is not translated"),
        }
    }};
}

fn single(kernel: &Kernel) -> Vec<[f64; 2]> {
    kernel.inputs.iter().map(|&x| call!(single, f32, kernel, x).map(f64::from)).collect()
}

fn double(kernel: &Kernel) -> Vec<[f64; 2]> {
    kernel.inputs.iter().map(|&x| call!(double, f64, kernel, x.map(f64::from))).collect()
}

fn check_all(results: fn(&Kernel) -> Vec<[f64; 2]>, budgets: &[Budget]) {
    let reports: Vec<_> = all().iter().map(|kernel| check(kernel, &results(kernel), budgets)).collect();
    for report in &reports {
        println!("{}", report.as_ref().unwrap_or_else(|e| e));
    }
    assert!(reports.iter().all(Result::is_ok), "{reports:#?}");
}

#[test]
fn formulas_are_right() {
    check_all(double, FORMULA);
}

#[test]
fn rounding_stays_small() {
    check_all(single, SINGLE);
}

#[test]
fn planted_errors_are_rejected() {
    for kernel in all() {
        for budgets in [FORMULA, SINGLE] {
            for budget in budgets.iter().filter(|b| b.kernel == kernel.name) {
                check(&kernel, &planted(&kernel, budget), budgets).expect_err("an error above the budget");
            }
            check(&kernel, &planted_nan(&kernel), budgets).expect_err("a NaN");
        }
        check(&kernel, &double(&kernel), &[]).expect_err("no budget");
    }
}

#[test]
fn extreme_segments_give_finite_means() {
    for far in [1e6f32, 1e10, 1e15] {
        for (front, back) in [([-far, 0.0], [far, 0.0]), ([far, far], [0.0, 0.0]), ([far, 1.0], [far, -1.0])] {
            let mean = translated::single::gaussian_mean(Vec2::from(front), Vec2::from(back));
            assert!((0.0..=1.0).contains(&mean), "{front:?} {back:?} {mean}");
        }
    }
}

/// Beyond their range the kernels stay within bounds: exponentials do not reach denormal numbers.
#[test]
fn depths_beyond_all_bounds_are_opaque() {
    for t in [87.0f32, 88.0, 1e3, 1e30, f32::MAX] {
        let rest = translated::single::attenuation(t);
        assert!((f32::MIN_POSITIVE..2e-38).contains(&rest), "{t} {rest}");
        assert!((0.0..=1.0 / t).contains(&translated::single::phi_one(t)), "{t}");
    }
}

#[test]
fn the_translation_is_fresh() {
    let fresh = translate::translate();
    if fresh != include_str!("translated.rs") {
        let file = concat!(env!("CARGO_TARGET_TMPDIR"), "/translated.rs");
        std::fs::write(file, fresh).expect("a place to write to");
        panic!("shaders/math changed since it was translated: cp {file} tests/kernels/translated.rs");
    }
}
