//! The formulas of lighting and silhouettes on a device, against their definitions in f64.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

#[path = "common/kernels.rs"]
#[expect(dead_code, reason = "other formulas' sweeps are for other tests")]
mod cases;
#[path = "common/kernel_device.rs"]
mod device;
#[path = "common/shading.rs"]
#[allow(dead_code, reason = "the lights are named for the translation")]
mod shading;

use cases::Measure::Absolute;
use cases::{Budget, budget, check, planted, planted_nan, replaced};
use device::{open, run};
use shading::kernels;

/// Errors on lavapipe (Mesa 22.3); measured values beside.
const DEVICE: &[Budget] = &[
    budget("power", 0, Absolute, 2.1e-7),             // 1.85e-7
    budget("lit from the head", 0, Absolute, 1.2e-7), // 9.93e-8
    budget("lit from the head", 1, Absolute, 2e-5),   // 1.76e-5
    budget("lit from the side", 0, Absolute, 1.4e-7), // 1.21e-7
    budget("lit from the side", 1, Absolute, 1.6e-5), // 1.39e-5
    budget("lit from behind", 0, Absolute, 1.2e-7),   // 1.07e-7
    budget("lit from behind", 1, Absolute, 1.4e-5),   // 1.23e-5
    budget("outlined", 0, Absolute, 3.4e-6),          // 2.98e-6
    budget("outlined", 1, Absolute, 9.5e-8),          // 8.50e-8
];

/// Those that are larger on an NVIDIA H100 (driver 580.159); measured values beside.
const HARDWARE: &[Budget] = &[
    budget("lit from the head", 0, Absolute, 1.6e-7), // 1.35e-7
    budget("outlined", 0, Absolute, 5.5e-6),          // 4.79e-6
    budget("outlined", 1, Absolute, 1.6e-7),          // 1.37e-7
];

#[test]
fn devices_compute_the_formulas() {
    let gpu = open();
    println!("{}", gpu.describe());
    let budgets = replaced(DEVICE, if gpu.is_software() { &[] } else { HARDWARE });
    let reports: Vec<_> = kernels().iter().map(|kernel| check(kernel, &run(&gpu, kernel), &budgets)).collect();
    for report in &reports {
        println!("{}", report.as_ref().unwrap_or_else(|e| e));
    }
    assert!(reports.iter().all(Result::is_ok), "{reports:#?}");
}

#[test]
fn planted_errors_are_rejected() {
    for kernel in kernels() {
        for budgets in [DEVICE.to_vec(), replaced(DEVICE, HARDWARE)] {
            for budget in budgets.iter().filter(|b| b.kernel == kernel.name) {
                check(&kernel, &planted(&kernel, budget), &budgets).expect_err("an error above the budget");
            }
        }
        check(&kernel, &planted_nan(&kernel), DEVICE).expect_err("a NaN");
    }
}

/// A call that is wrong on the device itself is noticed: the eye on the wrong side.
#[test]
fn a_wrong_kernel_is_rejected() {
    let gpu = open();
    let mut kernels = kernels();
    let lit = kernels.iter_mut().find(|k| k.name == "lit from the side").expect("listed");
    lit.call = "lit(real3(x[0], x[1], x[2]), -real2(x[3], x[4]), real4(0.75, 0.4375, -0.49607837, 0.25), \
                real3(0.5, 1.0, x[5]))";
    check(lit, &run(&gpu, lit), DEVICE).expect_err("another ray");
}
