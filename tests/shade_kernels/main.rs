//! The formulas of lighting and silhouettes (`shaders/math/shade.wgsl`) without a GPU: translated from WGSL to Rust, in f64
//! and in f32, against their definitions.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

#[path = "../common/kernels.rs"]
#[expect(dead_code, reason = "other formulas' sweeps are for other tests")]
mod cases;
#[path = "../kernels/root.rs"]
mod root;
#[path = "../common/shading.rs"]
mod shading;
#[allow(warnings, clippy::all, clippy::allow_attributes_without_reason, reason = "translated by a tool")]
mod translated {
    include!("../kernels/translated.rs");
}

use cases::Measure::Absolute;
use cases::{ARGUMENTS, Budget, Kernel, budget, check, planted, planted_nan};
use naga_rust_rt::{Vec2, Vec3, Vec4};
use shading::kernels;

/// Errors of the formulas, in f64; measured values beside.
const FORMULA: &[Budget] = &[
    budget("power", 0, Absolute, 1e-9),               // 9.0e-10: the series' end
    budget("lit from the head", 0, Absolute, 1e-15),  // 0
    budget("lit from the head", 1, Absolute, 1.1e-9), // 9.5e-10
    budget("lit from the side", 0, Absolute, 1e-15),  // 0
    budget("lit from the side", 1, Absolute, 1.1e-9), // 9.5e-10
    budget("lit from behind", 0, Absolute, 1e-15),    // 0
    budget("lit from behind", 1, Absolute, 1.1e-9),   // 9.1e-10
    budget("outlined", 0, Absolute, 8e-9),            // 7.3e-9: the definition's own digits
    budget("outlined", 1, Absolute, 1e-15),           // 0
];

/// Errors in f32.
const SINGLE: &[Budget] = &[
    budget("power", 0, Absolute, 1e-7),               // 8.96e-8
    budget("lit from the head", 0, Absolute, 1.3e-7), // 1.15e-7
    budget("lit from the head", 1, Absolute, 2e-5),   // 1.77e-5 by a shininess of 188: the normal's rounding, so often
    budget("lit from the side", 0, Absolute, 1.5e-7), // 1.34e-7
    budget("lit from the side", 1, Absolute, 1.6e-5), // 1.38e-5
    budget("lit from behind", 0, Absolute, 1.3e-7),   // 1.18e-7
    budget("lit from behind", 1, Absolute, 1.4e-5),   // 1.23e-5
    budget("outlined", 0, Absolute, 3.4e-6),          // 3.06e-6 by an exponent of 12
    budget("outlined", 1, Absolute, 9.5e-8),          // 8.50e-8
];

/// Calls the translation `$module` over the numbers `$number`.
macro_rules! call {
    ($module:ident, $number:ty, $kernel:expr, $x:expr) => {{
        use translated::$module as t;
        let x: [$number; ARGUMENTS] = $x;
        let gradient = Vec3::<$number>::new(x[0], x[1], x[2]);
        let ray = Vec2::<$number>::new(x[3], x[4]);
        let lit = |[lx, ly, lz]: [f32; 3]| -> [$number; 2] {
            let light = Vec4::<$number>::new(lx.into(), ly.into(), lz.into(), 0.25);
            t::lit(gradient, ray, light, Vec3::<$number>::new(0.5, 1.0, x[5])).into()
        };
        match $kernel.name {
            "power" => [t::power(x[0], x[1]), 0.0],
            "lit from the head" => lit(shading::HEAD),
            "lit from the side" => lit(shading::SIDE),
            "lit from behind" => lit(shading::BEHIND),
            "outlined" => [t::outlined(gradient, ray, x[5], 1.0), t::fade(gradient)],
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
    let reports: Vec<_> = kernels().iter().map(|kernel| check(kernel, &results(kernel), budgets)).collect();
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
    for kernel in kernels() {
        for budgets in [FORMULA, SINGLE] {
            for budget in budgets.iter().filter(|b| b.kernel == kernel.name) {
                check(&kernel, &planted(&kernel, budget), budgets).expect_err("an error above the budget");
            }
            check(&kernel, &planted_nan(&kernel), budgets).expect_err("a NaN");
        }
        check(&kernel, &double(&kernel), &[]).expect_err("no budget");
    }
}

/// Gradients that f32 cannot square count for nothing, whatever their direction.
#[test]
fn vanishing_gradients_change_nothing() {
    for size in [0.0f32, f32::from_bits(1), 1e-38, 1e-30, 1e-20] {
        let gradient = Vec3::new(size, -size, size);
        let ray = Vec2::new(0.5f32, 0.25);
        let light = Vec4::new(0.0, 0.0, -1.0f32, 0.25);
        let factors: [f32; 2] = translated::single::lit(gradient, ray, light, Vec3::new(0.5, 1.0, 7.0)).into();
        assert_eq!(factors, [1.0, 0.0], "{size}");
        assert_eq!(translated::single::outlined(gradient, ray, 2.0, 1.0), 1.0, "{size}");
    }
}
