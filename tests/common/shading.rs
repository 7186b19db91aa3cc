//! Formulas of `shaders/math/shade.wgsl` with inputs to try, and what they should give: the words of
//! `src/scene/optics.rs` in f64.

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

use super::cases::{ARGUMENTS, Kernel};

/// Lights of the calls: at the eye; from the side; from behind, where the half vector has no length.
pub const HEAD: [f32; 3] = [0.0, 0.0, -1.0];
pub const SIDE: [f32; 3] = [0.75, 0.4375, -0.49607837];
pub const BEHIND: [f32; 3] = [0.0, 0.0, 1.0];

pub fn kernels() -> Vec<Kernel> {
    vec![
        Kernel {
            name: "power",
            call: "vec2f(power(x[0], x[1]), 0.0)",
            inputs: powers(),
            truth: |x| [power(x[0], x[1]), 0.0],
        },
        Kernel {
            name: "lit from the head",
            call: "lit(real3(x[0], x[1], x[2]), real2(x[3], x[4]), real4(0.0, 0.0, -1.0, 0.25), real3(0.5, 1.0, x[5]))",
            inputs: views(3, 200.0),
            truth: |x| lit(x, HEAD),
        },
        Kernel {
            name: "lit from the side",
            call: "lit(real3(x[0], x[1], x[2]), real2(x[3], x[4]), real4(0.75, 0.4375, -0.49607837, 0.25), real3(0.5, 1.0, x[5]))",
            inputs: views(4, 200.0),
            truth: |x| lit(x, SIDE),
        },
        Kernel {
            name: "lit from behind",
            call: "lit(real3(x[0], x[1], x[2]), real2(x[3], x[4]), real4(0.0, 0.0, 1.0, 0.25), real3(0.5, 1.0, x[5]))",
            inputs: views(5, 200.0),
            truth: |x| lit(x, BEHIND),
        },
        Kernel {
            name: "outlined",
            call: "vec2f(outlined(real3(x[0], x[1], x[2]), real2(x[3], x[4]), x[5], 1.0), fade(real3(x[0], x[1], x[2])))",
            inputs: views(6, 20.0),
            truth: |x| [outlined(x), fade(x)],
        },
    ]
}

/// `x` in [0, 1], with both ends and the switch, and exponents of all sizes.
fn powers() -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(11);
    let mut pairs = vec![[0.0, 0.5], [1.0, 1e3], [0.7, 1.0], [0.7f32.next_up(), 1.0], [1e-38, 2.0], [0.0, 1e3]];
    for turn in 0..12_000 {
        let p = 10.0f32.powf(rng.random_range(-1.0..3.0));
        let x = match turn % 3 {
            0 => rng.random_range(0.0..1.0f32),
            // Where powers are neither 0 nor 1.
            1 => (-rng.random_range(0.0..10.0f32) / p).exp(),
            _ => 10.0f32.powf(rng.random_range(-20.0..0.0)),
        };
        pairs.push([x.min(1.0), p]);
    }
    // Below 1e-30 all powers count as 0.
    pairs.retain(|&[x, p]| x > 1e-30 || f64::from(x).powf(f64::from(p)) < 1e-15);
    pairs.into_iter().map(|[x, p]| [x, p, 0.0, 0.0, 0.0, 0.0]).collect()
}

/// Gradients of all lengths and directions, rays within 60 degrees of the axis, exponents from 1/2 to `most`; some gradients
/// along the ray, some across it, some half between ray and light.
fn views(seed: u64, most: f32) -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(seed);
    let mut views = vec![
        [0.0, 0.0, 0.0, 0.0, 0.0, 2.0],
        [0.0, 0.0, 1e-38, 0.0, 0.0, 2.0],
        [1e-25, 1e-25, 0.0, 0.5, 0.5, 2.0],
        [0.0, 0.0, 1e-3, 0.0, 0.0, 2.0],
        [0.0, 0.0, 1.0, 0.0, 0.0, 0.5],
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.5],
    ];
    for turn in 0..12_000 {
        let mut random = |most: f32| rng.random_range(-most..most);
        let ray = if turn % 5 == 0 { [0.0; 2] } else { [random(1.2), random(1.2)] };
        let size = if turn % 3 == 0 { 10.0f32.powf(3.0 * random(1.0) - 3.0) } else { 0.5 + 0.5 * random(1.0) };
        let away = 10.0f32.powf(random(4.0) - 4.0);
        let mut g = match turn % 4 {
            0 => [ray[0] + away * random(1.0), ray[1] + away * random(1.0), 1.0],
            1 => [1.0 + away * random(1.0), random(1.0), -ray[0]],
            _ => [random(1.0), random(1.0), random(1.0)],
        };
        let length = g.iter().map(|v| v * v).sum::<f32>().sqrt();
        g = g.map(|v| v / length * size);
        let exponent = 0.5 * (2.0 * most).powf(random(0.5) + 0.5);
        views.push([g[0], g[1], g[2], ray[0], ray[1], exponent]);
    }
    views
}

fn power(x: f64, p: f64) -> f64 {
    x.powf(p)
}

fn fade(x: [f64; ARGUMENTS]) -> f64 {
    let squared = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    squared / (squared + tetralux::scene::GRADIENT_FLOOR.powi(2))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|v| v / length) } else { a }
}

/// Ambient 0.25, diffuse 0.5, specular 1.
fn lit(x: [f64; ARGUMENTS], towards: [f32; 3]) -> [f64; 2] {
    let towards = towards.map(f64::from);
    let n = unit([x[0], x[1], x[2]]);
    let e = unit([-x[3], -x[4], -1.0]);
    let sum = [0, 1, 2].map(|i| towards[i] + e[i]);
    let h = sum.map(|v| v / (dot(sum, sum) + tetralux::scene::HALF_VECTOR_FLOOR).sqrt());
    let w = fade(x);
    [1.0 + w * (0.25 + 0.5 * dot(n, towards).abs() - 1.0), w * dot(n, h).abs().powf(x[5])]
}

/// Strength 1.
fn outlined(x: [f64; ARGUMENTS]) -> f64 {
    let facing = dot(unit([x[0], x[1], x[2]]), unit([x[3], x[4], 1.0])).abs().min(1.0);
    1.0 + fade(x) * ((1.0 - facing).powf(x[5]) - 1.0)
}
