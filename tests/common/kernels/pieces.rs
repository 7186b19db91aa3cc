//! Piecewise-linear factors, and Gaussians times one.

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::{ARGUMENTS, Kernel, gaussian_mean, gaussian_segments, integral};

pub fn kernels() -> Vec<Kernel> {
    vec![
        Kernel {
            name: "linear_product_mean",
            call: "linear_product_mean(real2(x[0], x[1]), real2(x[2], x[3]))",
            inputs: sweep(),
            truth: |x| [integral(0.0, 1.0, 1, |t| (x[0] + t * (x[1] - x[0])) * (x[2] + t * (x[3] - x[2]))), 0.0],
        },
        Kernel {
            name: "line_at",
            call: "line_at(real4(x[0], x[1], x[2], x[3]), x[4])",
            inputs: lines(),
            truth: |x| {
                let part = ((x[4] - x[0]) / (x[2] - x[0])).clamp(0.0, 1.0);
                [if x[2] > x[0] { x[1] + part * (x[3] - x[1]) } else { x[1] }, 0.0]
            },
        },
        Kernel {
            name: "gaussian_product_mean",
            call: "gaussian_product_mean(real2(x[0], x[1]), real2(x[2], x[3]), real2(x[4], x[5]))",
            inputs: weighted_segments(),
            truth: |x| [gaussian_mean([x[0], x[1]], [x[2], x[3]], [x[4], x[5]]), 0.0],
        },
    ]
}

fn sweep() -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(31);
    (0..4000).map(|_| std::array::from_fn(|_| rng.random_range(0.0..1.0f32))).collect()
}

/// Lines from (x, y) to (z, w), and places on them and beyond their ends.
fn lines() -> Vec<[f32; ARGUMENTS]> {
    let mut list = sweep();
    for (turn, line) in list.iter_mut().enumerate() {
        line[2] = if turn % 50 == 0 { line[0] } else { line[0] + line[2] };
        line[4] = line[0] + (1.4 * line[4] - 0.2) * (line[2] - line[0]);
    }
    list
}

fn weighted_segments() -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(32);
    let mut segments = gaussian_segments();
    for (turn, segment) in segments.iter_mut().enumerate() {
        let mut random = || rng.random_range(0.0..1.0f32);
        [segment[4], segment[5]] = match turn % 4 {
            0 => [0.0, random()],
            1 => [random(), 0.0],
            _ => [random(), random()],
        };
    }
    segments
}
