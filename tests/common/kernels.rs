//! What the formulas of `shaders/math` should give: their definitions in f64, by quadrature or by other algebra, over
//! sweeps that hold the hard corners. The tests compare translations and devices with them.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use statrs::function::erf::erfc;

#[path = "kernels/emission.rs"]
pub mod emission;
#[path = "kernels/pieces.rs"]
mod pieces;
#[path = "kernels/waves.rs"]
pub mod waves;

/// Numbers that one call takes, at most.
pub const ARGUMENTS: usize = 6;

/// A formula with inputs to try.
pub struct Kernel {
    pub name: &'static str,
    /// The call in WGSL, of `x: array<f32, 6>`; one or two results.
    pub call: &'static str,
    pub inputs: Vec<[f32; ARGUMENTS]>,
    /// The definition.
    pub truth: fn([f64; ARGUMENTS]) -> [f64; 2],
}

/// How an error is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    Absolute,
    /// Of results above 1e-30.
    Relative,
}

/// The largest error allowed of one of a kernel's results.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    pub kernel: &'static str,
    pub result: usize,
    pub measure: Measure,
    pub most: f64,
}

pub const fn budget(kernel: &'static str, result: usize, measure: Measure, most: f64) -> Budget {
    Budget { kernel, result, measure, most }
}

/// Budgets, but for those that `others` replace.
pub fn replaced(budgets: &[Budget], others: &[Budget]) -> Vec<Budget> {
    let same = |a: &Budget, b: &Budget| (a.kernel, a.result, a.measure) == (b.kernel, b.result, b.measure);
    let one = |budget: &Budget| *others.iter().find(|other| same(budget, other)).unwrap_or(budget);
    budgets.iter().map(one).collect()
}

/// What the definition gives at every input; computed once a process.
pub fn truths(kernel: &Kernel) -> Arc<Vec<[f64; 2]>> {
    static KNOWN: Mutex<BTreeMap<&str, Arc<Vec<[f64; 2]>>>> = Mutex::new(BTreeMap::new());
    let mut known = KNOWN.lock().expect("no test panics here");
    let compute = || Arc::new(kernel.inputs.iter().map(|x| (kernel.truth)(x.map(f64::from))).collect());
    Arc::clone(known.entry(kernel.name).or_insert_with(compute))
}

/// The largest error and where it is; infinite for NaN.
pub fn worst(kernel: &Kernel, got: &[[f64; 2]], result: usize, measure: Measure) -> (f64, String) {
    assert_eq!(got.len(), kernel.inputs.len());
    let mut worst = (0.0, String::new());
    for ((input, got), want) in kernel.inputs.iter().zip(got).zip(truths(kernel).iter()) {
        let want = want[result];
        let error = match measure {
            Measure::Absolute => (got[result] - want).abs(),
            Measure::Relative if want.abs() > 1e-30 => ((got[result] - want) / want).abs(),
            Measure::Relative => 0.0,
        };
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if error > worst.0 {
            worst = (error, format!("{input:?}: {} instead of {want}", got[result]));
        }
    }
    worst
}

/// A line for each of the kernel's budgets; the error is the lines if one is exceeded.
pub fn check(kernel: &Kernel, got: &[[f64; 2]], budgets: &[Budget]) -> Result<String, String> {
    let (mut text, mut good) = (String::new(), false);
    for (i, budget) in budgets.iter().filter(|b| b.kernel == kernel.name).enumerate() {
        let (error, place) = worst(kernel, got, budget.result, budget.measure);
        good = (good || i == 0) && error <= budget.most;
        let (name, result, measure, most) = (budget.kernel, budget.result, budget.measure, budget.most);
        text += &format!("{name} result {result} {measure:?}: {error:.2e} of {most:.2e} at {place}\n");
    }
    if good { Ok(text) } else { Err(format!("too far from the truth, or without a budget:\n{text}")) }
}

/// Results of a kernel that is right but for an error in one of them, half as large again as its budget.
pub fn planted(kernel: &Kernel, budget: &Budget) -> Vec<[f64; 2]> {
    let mut results = truths(kernel).to_vec();
    // Where the result is not tiny: its own digits hold the error.
    let at = results.iter().position(|r| r[budget.result].abs() > 0.1).expect("a result that is not tiny");
    let scale = if budget.measure == Measure::Relative { results[at][budget.result] } else { 1.0 };
    results[at][budget.result] += 1.5 * budget.most * scale;
    results
}

/// Results of a kernel that is right but for a NaN.
pub fn planted_nan(kernel: &Kernel) -> Vec<[f64; 2]> {
    let mut results = truths(kernel).to_vec();
    results[3] = [f64::NAN; 2];
    results
}

/// All of `shaders/math`, each file once; `real.wgsl`, which says what a number is, first.
pub fn all_math() -> String {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders/math");
    let mut files: Vec<_> =
        std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect();
    files.sort_by_key(|path| (!path.ends_with("real.wgsl"), path.clone()));
    let text = |path: &std::path::PathBuf| std::fs::read_to_string(path).expect("a shader file");
    let mut source = String::new();
    for line in files.iter().map(text).collect::<String>().lines().filter(|line| !line.starts_with("#import ")) {
        source += line;
        source.push('\n');
    }
    source
}

pub fn all() -> Vec<Kernel> {
    let mut kernels = basic();
    kernels.extend(waves::kernels());
    kernels.extend(emission::kernels());
    kernels.extend(pieces::kernels());
    kernels
}

fn basic() -> Vec<Kernel> {
    vec![
        Kernel {
            name: "attenuation",
            call: "attenuation(x[0])",
            inputs: depths(80.0),
            truth: |x| [(-x[0]).exp(), 0.0],
        },
        Kernel { name: "phi_one", call: "phi_one(x[0])", inputs: depths(1e6), truth: |x| [phi_one(x[0]), 0.0] },
        Kernel {
            name: "phi_one_unit",
            call: "phi_one_unit(x[0])",
            inputs: depths(1.0),
            truth: |x| [phi_one(x[0]), 0.0],
        },
        Kernel { name: "erfcx", call: "erfcx(x[0])", inputs: depths(1e6), truth: |x| [erfcx(x[0]), 0.0] },
        Kernel {
            name: "thin_weights",
            call: "thin_weights(x[0], x[1])",
            inputs: thin_pieces(),
            truth: |x| thin_weights(x[0], x[1]),
        },
        Kernel {
            name: "gaussian_mean",
            call: "gaussian_mean(real2(x[0], x[1]), real2(x[2], x[3]))",
            inputs: gaussian_segments(),
            truth: |x| [gaussian_mean([x[0], x[1]], [x[2], x[3]], [1.0; 2]), 0.0],
        },
        // An empty part may be given in many ways: the share, and the share times the start, are what counts.
        Kernel {
            name: "clip_to_range",
            call: "share_and_start(clip_to_range(real2(x[0], x[1]), x[2], x[3], x[4], x[5]))",
            inputs: clips(),
            truth: clip_to_range,
        },
    ]
}

/// 0, both sides of all switches, and values of all magnitudes, up to `most`.
fn depths(most: f32) -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(1);
    let mut values = vec![0.0, 1e-38, 1e-30, f32::EPSILON, 0.5, 1.0, 1.0f32.next_down(), 1.0f32.next_up(), 2.0, most];
    values.extend((0..4000).map(|_| most * rng.random_range(0.0..1.0f32)));
    values.extend((0..4000).map(|_| most * 10.0f32.powf(rng.random_range(-12.0..0.0))));
    values.extend((0..4000).map(|_| rng.random_range(0.0..10.0f32)));
    values.retain(|&t| t <= most);
    values.into_iter().map(|t| [t, 0.0, 0.0, 0.0, 0.0, 0.0]).collect()
}

/// Depths at both ends of 1 at most.
fn thin_pieces() -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(2);
    let mut pieces =
        vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.5, 0.5], [1e-30, 0.0], [0.0, 1e-20], [1e-7, 1e-7]];
    for turn in 0..12_000 {
        let mean =
            if turn % 2 == 0 { rng.random_range(0.0..1.0f32) } else { 10.0f32.powf(rng.random_range(-9.0..0.0)) };
        let share = match turn % 5 {
            0 => 0.0,
            1 => 1.0,
            _ => rng.random_range(0.0..1.0f32),
        };
        pieces.push([2.0 * mean * share, 2.0 * mean * (1.0 - share)]);
    }
    pieces.retain(|[a, b]| a.max(*b) <= 1.0);
    pieces.into_iter().map(|[a, b]| [a, b, 0.0, 0.0, 0.0, 0.0]).collect()
}

/// Segments in whitened coordinates: short and long, through the centre and far from it, about both switches.
fn gaussian_segments() -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(3);
    let mut segments =
        vec![[0.0; 4], [1.0, 0.0, 1.0, 0.0], [0.0, 0.0, 1.0, 0.0], [-1e4, 0.0, 1e4, 0.0], [-0.5, 0.0, 0.5, 0.0]];
    for turn in 0..16_000 {
        let mut random = |most: f32| rng.random_range(-most..most);
        let size = 10.0f32.powf(2.0 + random(2.0));
        let [px, py] = match turn % 4 {
            0 => [random(3.0), random(3.0)],
            1 => [random(0.1), random(0.1)],
            2 => [random(size), random(2.0)],
            _ => [random(size), random(size)],
        };
        let length = match (turn / 4) % 5 {
            0 => 10.0f32.powf(random(3.0) - 4.0),
            1 => 1.0 + random(1e-3),
            2 => 2.0 + random(2.0),
            3 => 10.0f32.powf(random(4.0)),
            _ => 2.0 * px.hypot(py),
        };
        let angle = random(3.2);
        let [dx, dy] = match (turn / 20) % 3 {
            // Along an axis; through the centre; any way.
            0 => [length, 0.0],
            1 => [-px / px.hypot(py) * length, -py / px.hypot(py) * length],
            _ => [length * angle.cos(), length * angle.sin()],
        };
        segments.push([px, py, px + dx, py + dy]);
    }
    segments.into_iter().map(|[a, b, c, d]| [a, b, c, d, 0.0, 0.0]).collect()
}

/// Values along segments, and ranges that hold, touch, miss or lie within them.
fn clips() -> Vec<[f32; ARGUMENTS]> {
    let mut rng = StdRng::seed_from_u64(4);
    let mut clips = vec![
        [0.0, 1.0, 0.5, 0.5, 0.0, 1.0],
        [0.0, 1.0, 0.5, 0.5, 0.5, 0.5],
        [0.0, 1.0, 0.5, 0.5, 0.6, 1.0],
        [0.0, 1.0, 0.25, 0.75, 0.75, 1.0],
        [0.0, 1.0, 0.25, 0.75, -1.0, 2.0],
        [0.0, 1.0, 0.75, 0.25, 0.25, 0.75],
        [0.0, 1.0, 0.0, 1e-20, 0.0, 1e-21],
        [1.0, 0.0, 0.2, 0.8, 0.3, 0.4],
    ];
    for turn in 0..12_000 {
        let mut random = || rng.random_range(0.0..1.0f32);
        let within = if turn % 3 == 0 { [0.0, 1.0] } else { [0.5 * random(), 0.5 + 0.5 * random()] };
        let front = random();
        let back = if turn % 2 == 0 { random() } else { front + (random() - 0.5) * 10.0f32.powf(-6.0 * random()) };
        let middle = front + (back - front) * (2.0 * random() - 0.5);
        let reach = (back - front).abs() * random() + 1e-3 * random() * (turn % 7 == 0) as u8 as f32;
        let [low, high] = if turn % 5 == 0 { [middle, 2.0] } else { [middle - reach, middle + reach] };
        clips.push([within[0], within[1], front, back, low, high]);
    }
    clips
}

/// Nodes in 0..1 and weights of Gauss-Legendre quadrature, by Newton's method on the Legendre polynomial.
pub fn gauss_legendre(n: usize) -> Vec<[f64; 2]> {
    (0..n)
        .map(|i| {
            let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..100 {
                let (mut before, mut value) = (1.0, x);
                for k in 2..=n {
                    let k = k as f64;
                    (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
                }
                slope = n as f64 * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            [0.5 - 0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope)]
        })
        .collect()
}

/// The integral of `f` over [from, to], in `panels` parts of 12 points each.
fn integral(from: f64, to: f64, panels: usize, f: impl Fn(f64) -> f64) -> f64 {
    thread_local!(static RULE: Vec<[f64; 2]> = gauss_legendre(12));
    let width = (to - from) / panels as f64;
    let panel = |i: usize| {
        let start = from + i as f64 * width;
        RULE.with(|rule| rule.iter().map(|[x, w]| w * f(start + x * width)).sum::<f64>())
    };
    (0..panels).map(panel).sum::<f64>() * width
}

/// `int_0^1 exp(-t x) dx`.
pub fn phi_one(t: f64) -> f64 {
    if t == 0.0 { 1.0 } else { -(-t).exp_m1() / t }
}

/// `exp(x^2) erfc(x)`; beyond 25 its asymptotic series, right to 1e-13 there.
pub fn erfcx(x: f64) -> f64 {
    if x < 25.0 {
        return (x * x).exp() * erfc(x);
    }
    let r = 0.5 / (x * x);
    (1.0 - r * (1.0 - 3.0 * r * (1.0 - 5.0 * r * (1.0 - 7.0 * r)))) / (x * std::f64::consts::PI.sqrt())
}

pub fn thin_weights(a: f64, b: f64) -> [f64; 2] {
    let depth = |x: f64| a * x + 0.5 * (b - a) * x * x;
    let front = integral(0.0, 1.0, 2, |x| (1.0 - x) * (a + (b - a) * x) * (-depth(x)).exp());
    [-(-depth(1.0)).exp_m1(), front]
}

/// The mean of `exp(-|p|^2)` times a linear weight along the segment, where it is not below 1e-27 of its largest value.
fn gaussian_mean(front: [f64; 2], back: [f64; 2], weights: [f64; 2]) -> f64 {
    let step = [back[0] - front[0], back[1] - front[1]];
    let extent = step[0].hypot(step[1]);
    let height = |x: f64| (-(front[0] + x * step[0]).powi(2) - (front[1] + x * step[1]).powi(2)).exp();
    if extent < 1e-12 {
        return height(0.0) * 0.5 * (weights[0] + weights[1]);
    }
    let nearest = (-(front[0] * step[0] + front[1] * step[1]) / (extent * extent)).clamp(0.0, 1.0);
    let (from, to) = ((nearest - 8.0 / extent).max(0.0), (nearest + 8.0 / extent).min(1.0));
    if from >= to {
        return 0.0;
    }
    integral(from, to, 16, |x| height(x) * (weights[0] + x * (weights[1] - weights[0])))
}

/// The share of the part of `within` where the value lies in the range, and that times its start: ends by bisection.
fn clip_to_range([from, to, front, back, low, high]: [f64; ARGUMENTS]) -> [f64; 2] {
    // Differences of f32 are exact in f64; sums with them would not be.
    let (above, below) = (|x: f64| (front - low) + x * (back - front), |x: f64| (high - front) - x * (back - front));
    // Where `is_past`, false then true along the segment, changes.
    let change = |is_past: &dyn Fn(f64) -> bool| {
        let (mut before, mut after) = (from, to);
        if is_past(from) {
            return from;
        }
        if !is_past(to) {
            return to;
        }
        for _ in 0..60 {
            let middle = 0.5 * (before + after);
            if is_past(middle) { after = middle } else { before = middle }
        }
        0.5 * (before + after)
    };
    if front == back || from >= to {
        let share = if low <= front && front <= high { (to - from).max(0.0) } else { 0.0 };
        return [share, share * from];
    }
    let (enter, leave) = if front < back {
        (change(&|x| above(x) >= 0.0), change(&|x| below(x) < 0.0))
    } else {
        (change(&|x| below(x) >= 0.0), change(&|x| above(x) < 0.0))
    };
    let share = (leave - enter).max(0.0);
    [share, share * enter]
}
