//! Periodic profiles: definitions by quadrature between their kinks, and sweeps over phases.

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::{ARGUMENTS, Kernel, integral};

pub fn kernels() -> Vec<Kernel> {
    let mut kernels = vec![
        Kernel {
            name: "sine_of_turns",
            call: "vec2f(sine_of_turns(x[0]), cosine_of_turns(x[0]))",
            inputs: turns(),
            truth: |x| [sine_of_turns(x[0]), sine_of_turns(0.25 - (x[0] - x[0].round()))],
        },
        Kernel {
            name: "sinc_complement",
            call: "vec2f(sinc_complement(x[0]), bessel_one(x[0]))",
            inputs: turns(),
            truth: |x| [sinc_complement(x[0]), bessel_one(x[0])],
        },
    ];
    // Weights of one are a case of their own: it is the common one, and its relative error the smaller.
    for (name, weighted, call, truth) in [
        ("cosine_mean", false, COSINE, cosine_mean as fn([f64; ARGUMENTS]) -> [f64; 2]),
        ("cosine_mean_weighted", true, COSINE, cosine_mean),
        ("arch_mean", false, ARCH, arch_mean),
        ("arch_mean_weighted", true, ARCH, arch_mean),
        ("half_mean", false, HALF, half_mean),
        ("half_mean_weighted", true, HALF, half_mean),
        ("triangle_mean", false, TRIANGLE, triangle_mean),
        ("triangle_mean_weighted", true, TRIANGLE, triangle_mean),
    ] {
        kernels.push(Kernel { name, call, inputs: intervals(weighted, 1.0), truth });
    }
    kernels.push(Kernel {
        name: "triangle_mean_narrow",
        call: TRIANGLE,
        inputs: intervals(false, 0.01),
        truth: triangle_mean,
    });
    kernels.push(Kernel {
        name: "waves_at",
        call: "vec2f(cosine_at(x[0]) + triangle_at(x[0], x[4]), arch_at(x[0], false) + arch_at(x[0], true))",
        inputs: intervals(false, 0.2),
        truth: |[p, _, _, _, duty, _]| {
            let arch = arch(p);
            let odd = p.floor().rem_euclid(2.0) == 1.0;
            [cosine(p) + triangle(p, duty), arch + if odd { 0.0 } else { arch }]
        },
    });
    kernels
}

const COSINE: &str = "cosine_mean(real2(x[0], x[1]), real2(x[2], x[3]))";
const ARCH: &str = "arch_mean(real2(x[0], x[1]), real2(x[2], x[3]), false)";
const HALF: &str = "arch_mean(real2(x[0], x[1]), real2(x[2], x[3]), true)";
const TRIANGLE: &str = "triangle_mean(real2(x[0], x[1]), real2(x[2], x[3]), x[4])";

/// All magnitudes, both signs, about the quarters and about the switch at pi x = 1.5.
fn turns() -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(11);
    let mut values = vec![0.0, 0.25, 0.5, 0.75, 1.0, -0.25, -0.5, 1e-30, -1e-20, 0.477_464_8, 0.477_464_83];
    values.extend((0..4000).map(|_| rng.random_range(-2.0..2.0f32)));
    values.extend((0..2000).map(|_| rng.random_range(-1e3..1e3f32)));
    values.extend((0..4000).map(|_| 10.0f32.powf(rng.random_range(-12.0..0.0))));
    values.extend((0..2000).map(|i| (i % 9) as f32 * 0.25 + 10.0f32.powf(rng.random_range(-7.0..-2.0))));
    values.into_iter().map(|t| [t, 0.0, 0.0, 0.0, 0.0, 0.0]).collect()
}

/// Phases at both ends, weights there, duty: short and long intervals, about zeros and peaks, rising and falling.
fn intervals(weighted: bool, least_duty: f32) -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(12);
    let mut list =
        vec![[0.0, 0.0], [0.5, 0.5], [0.0, 1.0], [1.0, 0.0], [0.0, 7.0], [0.25, 0.75], [-0.5, 0.5], [1.0, 1.5]];
    for turn in 0..6000 {
        let mut random = |most: f32| rng.random_range(-most..most);
        let start = match turn % 4 {
            0 => random(3.0),
            // About a zero, or about zero itself, where phases have all their digits.
            1 => random(3.0).round() + 0.5 * (turn % 8 / 4) as f32 + 10.0f32.powf(random(3.0) - 4.0),
            2 => 10.0f32.powf(random(4.0) - 5.0),
            _ => random(100.0),
        };
        let width = match (turn / 4) % 5 {
            0 => random(0.5),
            1 => random(3.0),
            2 => 10.0f32.powf(random(3.0) - 4.0),
            3 => -10.0f32.powf(random(3.5) - 3.5),
            _ => random(20.0),
        };
        list.push([start, start + width]);
    }
    let mut result = Vec::new();
    for (turn, [from, to]) in list.into_iter().enumerate() {
        let mut random = || rng.random_range(0.0..1.0f32);
        let weights = match (weighted, turn % 4) {
            (false, _) => [1.0, 1.0],
            (true, 0) => [0.0, random()],
            (true, 1) => [random(), 0.0],
            _ => [random(), random()],
        };
        let duty = match (least_duty < 1.0, turn % 3) {
            (false, 0) | (true, 0) => least_duty,
            (false, _) => 0.1 + 0.9 * random(),
            (true, _) => least_duty + (1.0 - least_duty) * random(),
        };
        result.push([from, to, weights[0], weights[1], duty, 0.0]);
    }
    result
}

/// sin(2 pi t), reduced to the nearest half turn first.
fn sine_of_turns(t: f64) -> f64 {
    let half = (2.0 * t).round();
    let rest = t - 0.5 * half;
    (std::f64::consts::TAU * rest).sin() * if half.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 }
}

/// 1 - sin(h) / h, h = pi x, as an integral: int_0^1 (1 - cos(h t)) dt.
pub fn sinc_complement(x: f64) -> f64 {
    let panels = 4 + (2.0 * x.abs()) as usize;
    integral(0.0, 1.0, panels, |t| 2.0 * sine_of_turns(0.25 * x * t).powi(2))
}

/// (sin h - h cos h) / h^2, h = pi x, as an integral: int_0^1 t sin(h t) h dt = j1(h) h, with h taken out.
fn bessel_one(x: f64) -> f64 {
    let panels = 4 + (2.0 * x.abs()) as usize;
    integral(0.0, 1.0, panels, |t| t * sine_of_turns(0.5 * x * t))
}

fn cosine(p: f64) -> f64 {
    sine_of_turns(0.5 * (p - p.round())).powi(2)
}

fn arch(p: f64) -> f64 {
    sine_of_turns(0.5 * (p - p.round())).abs()
}

fn triangle(p: f64, duty: f64) -> f64 {
    let t = (p - p.round()).abs();
    (1.0 - (1.0 - 2.0 * t) / duty).max(0.0)
}

/// The mean of a profile times the linear weight, cut at quarter phases and at `offsets` from every whole one.
fn mean(x: [f64; ARGUMENTS], offsets: &[f64], profile: impl Fn(f64) -> f64) -> [f64; 2] {
    let [from, to, w_from, w_to, ..] = x;
    if from == to {
        return [profile(from) * 0.5 * (w_from + w_to), 0.0];
    }
    let (low, high) = (from.min(to), from.max(to));
    let mut cuts = vec![low, high];
    for whole in (low.floor() as i64 - 1)..=(high.ceil() as i64 + 1) {
        let inside = |p: &f64| *p > low && *p < high;
        cuts.extend([0.0, 0.25, 0.5, 0.75].iter().chain(offsets).map(|o| whole as f64 + o).filter(inside));
    }
    cuts.sort_by(f64::total_cmp);
    let weight = |p: f64| w_from + (w_to - w_from) * ((p - from) / (to - from));
    let sum: f64 = cuts.windows(2).map(|c| integral(c[0], c[1], 1, |p| weight(p) * profile(p))).sum();
    [sum / (high - low), 0.0]
}

fn cosine_mean(x: [f64; ARGUMENTS]) -> [f64; 2] {
    mean(x, &[], cosine)
}

fn arch_mean(x: [f64; ARGUMENTS]) -> [f64; 2] {
    mean(x, &[], arch)
}

fn half_mean(x: [f64; ARGUMENTS]) -> [f64; 2] {
    mean(x, &[], |p| if p.floor().rem_euclid(2.0) == 1.0 { 0.0 } else { arch(p) })
}

fn triangle_mean(x: [f64; ARGUMENTS]) -> [f64; 2] {
    let duty = x[4];
    mean(x, &[0.5 - 0.5 * duty, 0.5 + 0.5 * duty], |p| triangle(p, duty))
}
