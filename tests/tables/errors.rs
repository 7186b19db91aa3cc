//! The errors that `tables/README.md` states are those measured, row by row.

use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use tetralux::tables::unweighted::Wave;
use tetralux::tables::{Axis, Interpolation, Kind};

use crate::reference::{arch_rise, cosine_rise, erf_rise, psi, visible_length};
use crate::unweighted::{Profile, sweep, worst};
use crate::{published, reference};

use Interpolation::{Bilinear, Cubic};

/// The largest error of psi over end depths log-uniform in 1e-3..1e4, and zeros, with `(a + b) / 2` up to `most`.
pub fn psi_error(most: f64, approximation: impl Fn(f64, f64) -> f64) -> f64 {
    let mut rng = StdRng::seed_from_u64(9);
    let mut worst = 0.0f64;
    for turn in 0..20_000 {
        let mut depth = || 1e-3 * 1e7f64.powf(rng.random_range(0.0..1.0));
        let (mut a, mut b) = (depth(), depth());
        match turn % 8 {
            0 => a = 0.0,
            1 => b = 0.0,
            _ => {}
        }
        if 0.5 * (a + b) <= most {
            worst = worst.max((approximation(a, b) - psi(a, b)).abs());
        }
    }
    worst
}

fn psi_table(interpolation: Interpolation) -> f64 {
    psi_error(f64::INFINITY, |a, b| Kind::Psi.table().lookup([a, b], interpolation))
}

/// The largest error of a visible length, in its own unit, off the nodes.
fn visible_table(kind: Kind, interpolation: Interpolation) -> f64 {
    let (rise, part): (reference::Rise, f64) = match kind {
        Kind::GaussianJ => (erf_rise, 1.0),
        Kind::ArchK => (arch_rise, std::f64::consts::FRAC_PI_4),
        Kind::CosineK | Kind::Psi => (cosine_rise, std::f64::consts::FRAC_PI_4),
    };
    let Axis::Linear { from, to } = kind.axes()[1] else { panic!("{kind:?} is no visible length") };
    let mut rng = StdRng::seed_from_u64(10);
    let mut worst = 0.0f64;
    for _ in 0..10_000 {
        let strength = kind.axes()[0].argument(rng.random_range(0.0..1.0));
        let u = rng.random_range(from..to);
        let truth = visible_length(strength, u, to, part, rise);
        worst = worst.max((kind.table().lookup([strength, u], interpolation) - truth).abs());
    }
    worst
}

/// The largest relative error of a table's samples themselves, of every 61st node, against the definition: half a unit in
/// the last place of an f32, 6.0e-8, if the generator is right. Samples below 1e-30 are not looked at.
fn node_error(kind: Kind, values: &[f32]) -> f64 {
    let [first, second] = kind.axes();
    let at = |axis: Axis, i: usize| axis.argument(i as f64 / 255.0);
    let mut worst = 0.0f64;
    for node in (0..values.len()).step_by(61) {
        let (x, y) = (at(first, node % 256), at(second, node / 256));
        let truth = match (kind, second) {
            (Kind::GaussianJ, Axis::Linear { to, .. }) => visible_length(x, y, to, 1.0, erf_rise),
            (Kind::ArchK, Axis::Linear { to, .. }) => visible_length(x, y, to, to / 4.0, arch_rise),
            (Kind::CosineK, Axis::Linear { to, .. }) => visible_length(x, y, to, to / 8.0, cosine_rise),
            _ => psi(x, y),
        };
        if truth > 1e-30 {
            worst = worst.max((f64::from(values[node]) / truth - 1.0).abs());
        }
    }
    worst
}

#[test]
fn samples_are_the_definitions() {
    for kind in Kind::ALL {
        let error = node_error(kind, &kind.table().values);
        println!("node {}: {error:.2e}", kind.name());
        // Measured: 5.9e-8.
        assert!(error <= 6.2e-8, "{}: {error:e}", kind.name());
        let mut damaged = kind.table().values.clone();
        damaged[61 * 40] *= 1.0 + 2e-7;
        assert!(node_error(kind, &damaged) > 6.2e-8, "{}", kind.name());
    }
}

fn mean(profile: Profile, most: f32, interpolation: Interpolation) -> f64 {
    let (error, piece) = worst(&sweep(profile, most, 10_000), |p| profile.mean_transmittance(p, interpolation));
    println!("    worst at {piece:?}");
    error
}

/// Every row of the README, by its first column.
fn measurements() -> Vec<(&'static str, f64)> {
    let (arch, cosine) = (Profile::Wave(Wave::Arch), Profile::Wave(Wave::Cosine));
    vec![
        ("psi, bilinear", psi_table(Bilinear)),
        ("psi, cubic", psi_table(Cubic)),
        ("gaussian_j, bilinear", visible_table(Kind::GaussianJ, Bilinear)),
        ("gaussian_j, cubic", visible_table(Kind::GaussianJ, Cubic)),
        ("arch_k, bilinear", visible_table(Kind::ArchK, Bilinear)),
        ("arch_k, cubic", visible_table(Kind::ArchK, Cubic)),
        ("cosine_k, bilinear", visible_table(Kind::CosineK, Bilinear)),
        ("cosine_k, cubic", visible_table(Kind::CosineK, Cubic)),
        ("Gaussian, P < 50, bilinear", mean(Profile::Gaussian, 50.0, Bilinear)),
        ("Gaussian, P < 50, cubic", mean(Profile::Gaussian, 50.0, Cubic)),
        ("Gaussian, P < 1e3, bilinear", mean(Profile::Gaussian, 999.9, Bilinear)),
        ("Gaussian, P < 1e3, cubic", mean(Profile::Gaussian, 999.9, Cubic)),
        ("arch, a < 50, bilinear", mean(arch, 50.0, Bilinear)),
        ("arch, a < 50, cubic", mean(arch, 50.0, Cubic)),
        ("arch, a < 1e3, bilinear", mean(arch, 999.9, Bilinear)),
        ("arch, a < 1e3, cubic", mean(arch, 999.9, Cubic)),
        ("cosine, a < 50, bilinear", mean(cosine, 50.0, Bilinear)),
        ("cosine, a < 50, cubic", mean(cosine, 50.0, Cubic)),
        ("cosine, a < 1e3, bilinear", mean(cosine, 999.9, Bilinear)),
        ("cosine, a < 1e3, cubic", mean(cosine, 999.9, Cubic)),
        ("psi on t / (1 + t)", published::psi_gamma(f64::INFINITY)),
        ("psi on t / (1 + t), depth <= 10", published::psi_gamma(10.0)),
        ("T(P, t), P < 20", published::gaussian_linear()),
        ("T(v, w), w < 20", published::falling_ramp(20.0)),
        ("T(v, w), w < 100", published::falling_ramp(100.0)),
        ("the same ramps by psi, w < 100", published::falling_ramp_by_psi(100.0)),
    ]
}

/// Bound and measured error of the row whose first cell is the name in backticks. Rows without a bound have a dash.
fn row(readme: &str, name: &str) -> Result<[f64; 2], String> {
    let first = format!("`{name}`");
    let cells: Vec<_> = readme
        .lines()
        .map(|line| line.split('|').map(str::trim).collect::<Vec<_>>())
        .filter(|cells| cells.get(1) == Some(&first.as_str()))
        .collect();
    let [cells] = &cells[..] else { return Err(format!("{} rows are of {name}", cells.len())) };
    let number = |text: &str| match text {
        "-" => Ok(f64::INFINITY),
        _ => text.parse::<f64>().map_err(|e| format!("{name}: {text}: {e}")),
    };
    let [.., bound, measured, _] = &cells[..] else { return Err(format!("{name}: too few cells")) };
    Ok([number(bound)?, number(measured)?])
}

/// The row agrees with what is measured: within its bound, and stated to a twentieth (rounding of `exp` on another
/// machine changes far less; two digits are stated).
fn check(readme: &str, name: &str, measured: f64) -> Result<(), String> {
    let [bound, stated] = row(readme, name)?;
    if !(measured <= bound && stated <= bound) {
        return Err(format!("{name}: {measured:.2e} and {stated:.2e} are not both within {bound:.1e}"));
    }
    // NaN does not come this far.
    if (measured - stated).abs() > 0.05 * stated {
        return Err(format!("{name}: {measured:.2e} is measured, {stated:.2e} stated"));
    }
    Ok(())
}

const README: &str = include_str!("../../tables/README.md");

#[test]
fn the_readme_states_what_is_measured() {
    let mut wrong = Vec::new();
    for (name, measured) in measurements() {
        println!("{name}: {measured:.2e}");
        wrong.extend(check(README, name, measured).err());
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The budget: C / (c D) within 1e-3 where the tables reach, by the look-up that is meant.
#[test]
fn bounds_keep_the_budget() {
    for name in ["Gaussian, P < 1e3, cubic", "arch, a < 1e3, cubic", "cosine, a < 1e3, cubic"] {
        let [bound, _] = row(README, name).expect("a row");
        assert!(bound <= 1e-3, "{name}: {bound:e}");
    }
}

#[test]
fn every_table_has_a_row() {
    for kind in Kind::ALL {
        let [name, file] = [format!("| `{}` |", kind.name()), format!("{}.f32", kind.name())];
        assert!(README.contains(&name) && README.contains(&file), "{name}");
    }
}

#[test]
fn planted_errors_are_rejected() {
    let readme = "| of | bound | measured |\n| `x` | 2e-3 | 1.5e-3 |\n| `y` | - | 5.0 |\n| `z` | 1e-3 | 1.5e-3 |\n";
    check(readme, "x", 1.51e-3).expect("as stated");
    check(readme, "y", 5.1).expect("without a bound");
    for (name, measured) in
        [("x", 2.1e-3), ("x", 1.7e-3), ("x", 1.3e-3), ("x", f64::NAN), ("y", f64::INFINITY), ("z", 1e-3), ("w", 1e-3)]
    {
        check(readme, name, measured).expect_err(name);
    }
    check(&readme.replace("1.5e-3", "unknown"), "x", 1.5e-3).expect_err("no number");
    check(&readme.replace("| `y`", "| `x` | 1 | 1 |\n| `y`"), "x", 1.5e-3).expect_err("two rows");
    check("| `x` | |\n", "x", 1.5e-3).expect_err("too few cells");
}
