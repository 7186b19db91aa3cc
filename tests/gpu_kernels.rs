//! The formulas of `shaders/math` on a device: each is run over a buffer of inputs and compared with its definition in
//! f64. The software adapter by default; `TETRALUX_GPU=hardware` asks for another.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

#[path = "common/kernels.rs"]
mod cases;
#[path = "common/kernel_device.rs"]
mod device;

use cases::Measure::{Absolute, Relative};
use cases::{Budget, Kernel, all, budget, check, planted, planted_nan, replaced};
use device::open;
use tetralux::gpu::Gpu;

/// Errors on lavapipe (Mesa 22.3); measured values beside. Its `exp` loses digits in proportion to the exponent, as WGSL
/// allows: 3 + 2 |x| units in the last place.
const DEVICE: &[Budget] = &[
    budget("attenuation", 0, Relative, 4.2e-6),            // 3.64e-6
    budget("phi_one", 0, Relative, 2.3e-7),                // 1.92e-7
    budget("phi_one_unit", 0, Relative, 2.3e-7),           // 2.06e-7
    budget("erfcx", 0, Relative, 2.6e-7),                  // 2.23e-7
    budget("thin_weights", 0, Relative, 2.5e-7),           // 2.23e-7
    budget("thin_weights", 1, Absolute, 3.9e-6),           // 3.75e-6, as in f64
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
    budget("triangle_mean_weighted", 0, Relative, 2.5e-7), // 2.16e-7
    budget("triangle_mean_narrow", 0, Absolute, 1.8e-7),   // 1.58e-7
    budget("triangle_mean_narrow", 0, Relative, 2e-7),     // 1.71e-7
    budget("waves_at", 0, Absolute, 4.6e-7),               // 4.03e-7
    budget("waves_at", 1, Absolute, 3.7e-7),               // 3.25e-7
    budget("dawson", 0, Relative, 4.5e-7),                 // 3.93e-7
    budget("psi", 0, Absolute, 8.1e-7),                    // 7.21e-7
    budget("psi", 0, Relative, 1.6e-6),                    // 1.39e-6
    budget("color_weights", 0, Absolute, 7.9e-7),          // 6.97e-7
    budget("color_weights", 0, Relative, 1.2e-6),          // 1.02e-6
    budget("color_weights", 1, Absolute, 5.7e-7),          // 5.08e-7
    budget("color_weights", 1, Relative, 2e-6),            // 1.77e-6
    budget("emission_weights", 0, Absolute, 1.1e-6),       // 9.01e-7
    budget("emission_weights", 1, Absolute, 1.1e-6),       // 9.44e-7
    budget("emission_shares", 0, Absolute, 8.2e-6),        // 7.32e-6
    budget("emission_shares", 1, Absolute, 8.2e-6),        // 7.26e-6
    budget("linear_product_mean", 0, Relative, 1.7e-7),    // 1.47e-7
    budget("line_at", 0, Absolute, 6.1e-8),                // 5.42e-8
    budget("gaussian_product_mean", 0, Absolute, 2.7e-7),  // 2.35e-7
];

/// Those that are larger on an NVIDIA H100 (driver 580.159); measured values beside. It divides by reciprocals, and joins
/// products and sums: of the last one, values are 3e-5 where that shows.
const HARDWARE: &[Budget] = &[
    budget("erfcx", 0, Relative, 3.3e-7),                  // 2.90e-7
    budget("gaussian_mean", 0, Absolute, 4e-7),            // 3.50e-7
    budget("clip_to_range", 0, Absolute, 1.5e-7),          // 1.33e-7
    budget("clip_to_range", 1, Absolute, 1.1e-7),          // 9.49e-8
    budget("sinc_complement", 0, Relative, 4.6e-7),        // 3.96e-7
    budget("cosine_mean_weighted", 0, Relative, 6e-7),     // 5.24e-7
    budget("half_mean", 0, Relative, 5.1e-7),              // 4.47e-7
    budget("half_mean_weighted", 0, Relative, 5.4e-7),     // 4.68e-7
    budget("triangle_mean", 0, Absolute, 2.5e-7),          // 2.16e-7
    budget("triangle_mean", 0, Relative, 2.8e-7),          // 2.41e-7
    budget("triangle_mean_weighted", 0, Absolute, 1.7e-7), // 1.49e-7
    budget("triangle_mean_narrow", 0, Absolute, 2.7e-7),   // 2.38e-7
    budget("triangle_mean_narrow", 0, Relative, 3e-7),     // 2.57e-7
    budget("emission_shares", 0, Absolute, 9.9e-6),        // 9.06e-6
    budget("emission_shares", 1, Absolute, 9.9e-6),        // 9.01e-6
    budget("line_at", 0, Absolute, 8.4e-8),                // 7.30e-8
    budget("triangle_mean_weighted", 0, Relative, 2.9e-6), // 2.49e-6
];

fn budgets(gpu: &Gpu) -> Vec<Budget> {
    replaced(DEVICE, if gpu.is_software() { &[] } else { HARDWARE })
}

fn run(gpu: &Gpu, kernel: &Kernel) -> Vec<[f64; 2]> {
    device::run(gpu, kernel)
}

#[test]
fn devices_compute_the_formulas() {
    let gpu = open();
    println!("{}", gpu.describe());
    let budgets = budgets(&gpu);
    let reports: Vec<_> = all().iter().map(|kernel| check(kernel, &run(&gpu, kernel), &budgets)).collect();
    for report in &reports {
        println!("{}", report.as_ref().unwrap_or_else(|e| e));
    }
    assert!(reports.iter().all(Result::is_ok), "{reports:#?}");
}

#[test]
fn planted_errors_are_rejected() {
    for kernel in all() {
        for budgets in [DEVICE.to_vec(), replaced(DEVICE, HARDWARE)] {
            for budget in budgets.iter().filter(|b| b.kernel == kernel.name) {
                check(&kernel, &planted(&kernel, budget), &budgets).expect_err("an error above the budget");
                // None lets an error pass that could be seen.
                assert!(budget.most <= 1e-5, "{budget:?}");
            }
        }
        check(&kernel, &planted_nan(&kernel), DEVICE).expect_err("a NaN");
    }
}

/// A call that is wrong by 1e-5 on the device itself is noticed.
#[test]
fn a_wrong_kernel_is_rejected() {
    let gpu = open();
    let mut kernels = all();
    let erfcx = kernels.iter_mut().find(|k| k.name == "erfcx").expect("listed");
    erfcx.call = "erfcx(x[0]) * 1.00001";
    check(erfcx, &run(&gpu, erfcx), DEVICE).expect_err("a relative error of 1e-5");
}
