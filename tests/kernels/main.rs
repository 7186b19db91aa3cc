//! The formulas of `shaders/math` without a GPU: translated from WGSL to Rust, they are compared with their definitions
//! in f64, which shows the formulas' own errors, and in f32, which adds rounding.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

#[path = "../common/kernels.rs"]
#[expect(dead_code, reason = "the WGSL calls are for the tests on a device")]
mod cases;
mod translate;
#[allow(warnings, clippy::all, clippy::allow_attributes_without_reason, reason = "translated by a tool")]
mod translated {
    include!("translated.rs");
}

use cases::Measure::{Absolute, Relative};
use cases::{ARGUMENTS, Budget, Kernel, all, budget, check, planted, planted_nan};
use naga_rust_rt::Vec2;

/// Errors of the formulas, in f64; measured values beside.
const FORMULA: &[Budget] = &[
    budget("attenuation", 0, Relative, 1e-15),    // 0
    budget("phi_one", 0, Relative, 2e-8),         // 1.86e-8
    budget("phi_one_half", 0, Relative, 1.1e-7),  // 1.09e-7
    budget("erfcx", 0, Relative, 8.5e-8),         // 8.32e-8
    budget("thin_weights", 0, Relative, 1.1e-7),  // 1.09e-7
    budget("thin_weights", 1, Absolute, 9.95e-6), // 9.90e-6: three points, where the slope is steepest
    budget("gaussian_mean", 0, Absolute, 7.2e-8), // 6.93e-8
    budget("clip_to_range", 0, Absolute, 1e-15),  // 4.4e-16
    budget("clip_to_range", 1, Absolute, 1e-15),  // 3.3e-16
];

/// Errors in f32.
const SINGLE: &[Budget] = &[
    budget("attenuation", 0, Relative, 7e-8),     // 5.87e-8
    budget("phi_one", 0, Relative, 1.3e-7),       // 1.08e-7
    budget("phi_one_half", 0, Relative, 1.7e-7),  // 1.56e-7
    budget("erfcx", 0, Relative, 2.6e-7),         // 2.23e-7
    budget("thin_weights", 0, Relative, 2.3e-7),  // 2.09e-7
    budget("thin_weights", 1, Absolute, 1e-5),    // 9.91e-6
    budget("gaussian_mean", 0, Absolute, 2.9e-7), // 2.59e-7
    budget("clip_to_range", 0, Absolute, 1.2e-7), // 9.82e-8
    budget("clip_to_range", 1, Absolute, 9e-8),   // 6.94e-8
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
            "phi_one_half" => [t::phi_one_half(x[0]), 0.0],
            "erfcx" => [t::erfcx(x[0]), 0.0],
            "thin_weights" => t::thin_weights(x[0], x[1]).into(),
            "gaussian_mean" => [t::gaussian_mean(pair(0), pair(2)), 0.0],
            "clip_to_range" => {
                let [start, end]: [$number; 2] = t::clip_to_range(pair(0), x[2], x[3], x[4], x[5]).into();
                let share = (end - start).max(0.0);
                [share, share * start]
            }
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
    let fresh = translate::translate("math/widget");
    if fresh != include_str!("translated.rs") {
        let file = concat!(env!("CARGO_TARGET_TMPDIR"), "/translated.rs");
        std::fs::write(file, fresh).expect("a place to write to");
        panic!("shaders/math changed since it was translated: cp {file} tests/kernels/translated.rs");
    }
}
