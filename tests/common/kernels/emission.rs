//! Pieces of linear extinction: psi and the weights made of it, by quadrature of the integrals that define them.

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::{ARGUMENTS, Kernel, integral};

pub fn kernels() -> Vec<Kernel> {
    vec![
        Kernel { name: "dawson", call: "dawson(x[0])", inputs: super::depths(1e6), truth: |x| [dawson(x[0]), 0.0] },
        Kernel { name: "psi", call: "psi(x[0], x[1])", inputs: pieces(), truth: |x| [psi(x[0], x[1]), 0.0] },
        Kernel {
            name: "color_weights",
            call: "color_weights(x[0], x[1])",
            inputs: pieces(),
            truth: |x| color_weights(x[0], x[1]),
        },
        Kernel {
            name: "emission_weights",
            call: "emission_weights(x[0], x[1])",
            inputs: pieces(),
            truth: |x| emission_weights(x[0], x[1]),
        },
        Kernel {
            name: "emission_shares",
            call: "emission_weights(x[0], x[1]) * real2(x[0], x[1])",
            inputs: pieces(),
            truth: |x| {
                let [front, back] = emission_weights(x[0], x[1]);
                [x[0] * front, x[1] * back]
            },
        },
    ]
}

/// Extinctions at both ends: thin, thick, equal, nearly equal, zero at one end, about the switches at sums of 3 and 4.
fn pieces() -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(21);
    let mut list = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.5], [2.0, 2.0], [3.0, 0.0], [0.0, 1e4], [1e4, 0.0]];
    for turn in 0..9000 {
        let mut random = || rng.random_range(0.0..1.0f32);
        let a = 10.0f32.powf(10.0 * random() - 6.0);
        let b = match turn % 5 {
            0 => a * (1.0 + 10.0f32.powf(-7.0 * random())),
            1 => a / (1.0 + 0.04 * random()),
            2 => 0.0,
            _ => 10.0f32.powf(10.0 * random() - 6.0),
        };
        let sum = match turn % 4 {
            0 => 3.0 + 0.01 * (random() - 0.5),
            1 => 4.0 + 0.01 * (random() - 0.5),
            _ => a + b,
        };
        let scale = sum / (a + b);
        list.push(if turn % 3 == 0 { [b * scale, a * scale] } else { [a * scale, b * scale] });
    }
    list.into_iter().map(|[a, b]| [a, b, 0.0, 0.0, 0.0, 0.0]).collect()
}

/// int_0^1 f(x) exp(-tau(x)) dx, over panels that halve towards the front: tau changes by a bounded part in each.
fn seen(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    let depth = |x: f64| a * x + 0.5 * (b - a) * x * x;
    // The front that holds all but 1e-30.
    let mut far = 1.0;
    while depth(0.5 * far) > 80.0 {
        far *= 0.5;
    }
    let mut sum = 0.0;
    for _ in 0..8 {
        sum += integral(0.5 * far, far, 12, |x| f(x) * (-depth(x)).exp());
        far *= 0.5;
    }
    sum + integral(0.0, far, 4, |x| f(x) * (-depth(x)).exp())
}

fn psi(a: f64, b: f64) -> f64 {
    seen(a, b, |_| 1.0)
}

fn color_weights(a: f64, b: f64) -> [f64; 2] {
    let extinction = |x: f64| a + (b - a) * x;
    [seen(a, b, |x| (1.0 - x) * extinction(x)), seen(a, b, |x| x * extinction(x))]
}

fn emission_weights(a: f64, b: f64) -> [f64; 2] {
    [seen(a, b, |x| 1.0 - x), seen(a, b, |x| x)]
}

/// exp(-x^2) int_0^x exp(t^2) dt = int_0^x exp(-s (2 x - s)) ds; beyond 50 its asymptotic series.
pub fn dawson(x: f64) -> f64 {
    if x > 50.0 {
        let r = 0.5 / (x * x);
        return 0.5 / x * (1.0 + r * (1.0 + 3.0 * r * (1.0 + 5.0 * r)));
    }
    let far = if x > 5.0 { 40.0 / x } else { x };
    integral(0.0, far.min(x), 24, |s| (-s * (2.0 * x - s)).exp())
}
