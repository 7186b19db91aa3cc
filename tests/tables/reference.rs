//! What the tables should hold: their definitions in f64 by the tanh-sinh rule, with libm's error function. The generator
//! has neither.

use std::f64::consts::PI;
use std::sync::LazyLock;

/// Offsets in (0, 1), from either end without loss, and weights.
struct Rule(Vec<[f64; 2]>);

impl Rule {
    fn new(steps: i32) -> Self {
        let h = 1.0 / f64::from(steps);
        let node = |k: i32| {
            let u = f64::from(k) * h;
            let y = 1.0 / (1.0 + (-PI * u.sinh()).exp());
            let far = 1.0 / (1.0 + (PI * u.sinh()).exp());
            [y, h * PI * u.cosh() * y * far]
        };
        Self((-4 * steps..=4 * steps).map(node).collect())
    }

    fn integral(&self, length: f64, f: impl Fn(f64) -> f64) -> f64 {
        length * self.0.iter().map(|[x, w]| w * f(length * x)).sum::<f64>()
    }
}

static RULE: LazyLock<Rule> = LazyLock::new(|| Rule::new(32));

/// `int_0^length f`, f of the offset. Ends may be steep: nodes crowd there.
pub fn integral(length: f64, f: impl Fn(f64) -> f64) -> f64 {
    RULE.integral(length, f)
}

pub fn psi(a: f64, b: f64) -> f64 {
    if a.is_infinite() || b.is_infinite() {
        return 0.0;
    }
    // Up to a depth of 60 at least; a falling ramp's is above a x / 2.
    let length = if b >= a { (60.0 / a).min((120.0 / (b - a)).sqrt()) } else { 120.0 / a };
    integral(length.min(1.0), |x| (-x * (a + 0.5 * (b - a) * x)).exp())
}

/// `erf t - erf u`, t >= u.
pub fn erf_rise(u: f64, t: f64) -> f64 {
    if u > 0.0 {
        libm::erfc(u) - libm::erfc(t)
    } else if t < 0.0 {
        libm::erfc(-t) - libm::erfc(-u)
    } else {
        libm::erf(t) - libm::erf(u)
    }
}

/// Depth at strength 1 of a profile between two coordinates, the second at least the first.
pub type Rise = fn(f64, f64) -> f64;

/// Of `|sin t|`, period pi.
pub fn arch_rise(u: f64, t: f64) -> f64 {
    let upto = |t: f64| {
        let turns = (t / PI).floor();
        2.0 * turns + 1.0 - (t - PI * turns).cos()
    };
    upto(t) - upto(u)
}

/// Of `(1 - cos t) / 2`.
pub fn cosine_rise(u: f64, t: f64) -> f64 {
    0.5 * ((t - t.sin()) - (u - u.sin()))
}

/// `int_from^to exp(-strength rise(from, t)) dt`, in parts between multiples of `part`.
pub fn visible_length(strength: f64, from: f64, to: f64, part: f64, rise: Rise) -> f64 {
    let (mut sum, mut at) = (0.0, from);
    while at < to && strength * rise(from, at) < 60.0 {
        let next = (((at / part).floor() + 1.0) * part).min(to);
        // A multiple that rounds to `at` itself would stay there for ever.
        let next = if next > at { next } else { (at + part).min(to) };
        sum += integral(next - at, |d| (-strength * rise(from, at + d)).exp());
        at = next;
    }
    sum
}

#[test]
fn the_reference_agrees_with_closed_forms_and_finer_steps() {
    let mut worst = 0.0f64;
    for a in [0.0, 1e-3, 0.5, 3.0, 40.0, 1e3, 1e6] {
        // Equal ends: (1 - exp(-a)) / a. From nothing: an error function.
        let equal = if a == 0.0 { 1.0 } else { -f64::exp_m1(-a) / a };
        worst = worst.max((psi(a, a) - equal).abs());
        if a > 0.0 {
            let rising = (0.5 * PI / a).sqrt() * libm::erf((0.5 * a).sqrt());
            worst = worst.max((psi(0.0, a) - rising).abs());
        }
    }
    let fine = Rule::new(128);
    let rises: [(Rise, f64, f64, f64); 3] =
        [(erf_rise, -4.0, 4.0, 1.0), (arch_rise, 0.0, PI, PI / 4.0), (cosine_rise, 0.0, 2.0 * PI, PI / 4.0)];
    for (rise, low, high, part) in rises {
        for strength in [1e-3, 1.0, 30.0, 1e3] {
            for i in 0..20 {
                let from = low + (high - low) * f64::from(i) / 20.0;
                let depth = |d: f64| strength * rise(from, from + d);
                let whole = (0..8).map(|k| (high - from) * f64::from(k) / 8.0);
                let finer: f64 = whole.map(|at| fine.integral((high - from) / 8.0, |d| (-depth(at + d)).exp())).sum();
                worst = worst.max((visible_length(strength, from, high, part, rise) - finer).abs());
            }
        }
    }
    println!("reference: {worst:.1e}");
    // Measured: 1.5e-14.
    assert!(worst < 1e-13, "{worst:e}");
}
