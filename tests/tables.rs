//! Constants: the shaders' literals are those of `tables/coefficients.json`, and these keep what they promise. So do the
//! sampled tables, by the files of `tests/tables/`.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

#[path = "tables/errors.rs"]
mod errors;
#[path = "tables/published.rs"]
mod published;
#[path = "tables/reference.rs"]
mod reference;
#[path = "tables/sampled.rs"]
mod sampled;
#[path = "tables/unweighted.rs"]
mod unweighted;

#[path = "kernels/root.rs"]
mod root;

#[path = "common/kernels.rs"]
#[expect(dead_code, reason = "the sweeps are for the tests of the shaders")]
mod kernels;

use std::collections::BTreeMap;

use kernels::emission::dawson;
use kernels::{erfcx, gauss_legendre, phi_one};
use serde::Deserialize;
use tetralux::gpu::shader::compose;

#[derive(Deserialize)]
#[serde(untagged, deny_unknown_fields)]
enum Table {
    Polynomial {
        /// Shader file and function.
        function: String,
        meaning: String,
        source: String,
        range: [f64; 2],
        relative_error_f32: f64,
        coefficients: Vec<f64>,
    },
    Surface {
        /// Shader file and function.
        function: String,
        meaning: String,
        source: String,
        /// Of t - d and t + d.
        largest: f64,
        absolute_error_f32: f64,
        /// Coefficients of powers of t, for each power of d.
        rows: Vec<Vec<f64>>,
    },
    Quadrature {
        function: String,
        meaning: String,
        source: String,
        nodes: Vec<f64>,
        weights: Vec<f64>,
    },
}

fn tables() -> BTreeMap<String, Table> {
    serde_json::from_str(include_str!("../tables/coefficients.json")).expect("tables")
}

/// The numbers in a shader function's body as the device sees them, without signs.
fn literals(file: &str, function: &str) -> Vec<f32> {
    let source = compose(file).expect("a shader file");
    let start = source.find(&format!("fn {function}(")).unwrap_or_else(|| panic!("{file} has no {function}"));
    let body = source[start..].split("\n}").next().unwrap_or_default();
    let is_number = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
    body.lines()
        .filter_map(|line| line.split("//").next())
        .flat_map(|line| line.split(|c: char| !(c.is_alphanumeric() || c == '.' || c == '_')))
        .filter(|word| is_number(word))
        .map(|word| word.parse().unwrap_or_else(|e| panic!("{function}: {word}: {e}")))
        .collect()
}

/// True where the polynomial's coefficients follow each other among the literals.
fn holds_polynomial(literals: &[f32], coefficients: &[f64]) -> bool {
    let wanted: Vec<f32> = coefficients.iter().map(|c| c.abs() as f32).collect();
    literals.windows(wanted.len()).any(|window| window == wanted)
}

/// True where all the numbers occur among the literals.
fn holds_all(literals: &[f32], numbers: &[f64]) -> bool {
    numbers.iter().all(|&n| literals.contains(&(n as f32)))
}

/// Horner's rule in f32.
fn horner(coefficients: &[f64], x: f32) -> f32 {
    coefficients.iter().rev().fold(0.0, |sum, &c| sum * x + c as f32)
}

/// The largest relative error of a polynomial, evaluated in f32, over its range.
fn worst_error(name: &str, coefficients: &[f64], range: [f64; 2]) -> f64 {
    // A rational function is checked as a whole.
    let partner = |name: &str| match &tables()[name] {
        Table::Polynomial { coefficients, .. } => coefficients.clone(),
        _ => panic!("'{name}' is no polynomial"),
    };
    let (numerator, denominator) = match name {
        "dawson_numerator" => (coefficients.to_vec(), partner("dawson_denominator")),
        "dawson_denominator" => (partner("dawson_numerator"), coefficients.to_vec()),
        _ => (coefficients.to_vec(), vec![1.0]),
    };
    // Even steps, and steps of the logarithm: the range of erfcx is long.
    let [low, high] = range;
    let steps = 20_000;
    (0..=2 * steps)
        .map(|i| {
            let t = f64::from(i / 2) / f64::from(steps);
            let x =
                if i % 2 == 0 { low + (high - low) * t } else { low + (high - low) * (1e-8f64).powf(1.0 - t) } as f32;
            let (got, want) = match name {
                "erfcx" => (horner(coefficients, (x - 2.0) / (x + 2.0)) / (1.0 + 2.0 * x), erfcx(f64::from(x))),
                "phi_one" | "phi_one_unit" => (horner(coefficients, x), phi_one(f64::from(x))),
                "quarter_sine" => (x * horner(coefficients, x * x), (std::f64::consts::FRAC_PI_2 * f64::from(x)).sin()),
                "sinc_complement" => (
                    x * x * horner(coefficients, x * x),
                    kernels::waves::sinc_complement(f64::from(x) / std::f64::consts::PI),
                ),
                "dawson_numerator" | "dawson_denominator" => {
                    (x * horner(&numerator, x * x) / horner(&denominator, x * x), dawson(f64::from(x)))
                }
                "dawson_tail" => (0.5 * horner(coefficients, 1.0 / (x * x)) / x, dawson(f64::from(x))),
                _ => panic!("'{name}' has no definition here"),
            };
            if want.abs() < 1e-30 {
                return 0.0;
            }
            let error = ((f64::from(got) - want) / want).abs();
            if error.is_nan() { f64::INFINITY } else { error }
        })
        .fold(0.0, f64::max)
}

/// The largest error of the front's share, evaluated in f32, over end depths up to `largest`.
fn worst_share(rows: &[Vec<f64>], largest: f64) -> f64 {
    let steps = 200u16;
    let depth = |i: u16| (largest * f64::from(i) / f64::from(steps)) as f32;
    (0..=steps)
        .flat_map(|i| (0..=steps).map(move |j| (depth(i), depth(j))))
        .map(|(a, b)| {
            let (t, d) = (0.5 * (a + b), 0.5 * (b - a));
            let got = rows.iter().rev().fold(0.0, |sum, row| sum * d + horner(row, t));
            let error = (f64::from(got) - kernels::thin_weights(a.into(), b.into())[1]).abs();
            if error.is_nan() { f64::INFINITY } else { error }
        })
        .fold(0.0, f64::max)
}

/// A row's coefficients as the shader writes them: it leaves out a leading zero.
fn written(row: &[f64]) -> &[f64] {
    row.strip_prefix(&[0.0]).unwrap_or(row)
}

/// The largest error of the rule over the powers that it should integrate exactly.
fn quadrature_error(nodes: &[f64], weights: &[f64]) -> f64 {
    (0..2 * nodes.len() as i32)
        .map(|k| {
            let sum: f64 = nodes.iter().zip(weights).map(|(x, w)| w * x.powi(k)).sum();
            (sum - 1.0 / f64::from(k + 1)).abs()
        })
        .fold(0.0, f64::max)
}

fn place(function: &str) -> (&str, &str) {
    function.split_once(' ').expect("a file and a function")
}

#[test]
fn shaders_hold_the_tables_numbers() {
    for (name, table) in tables() {
        match table {
            Table::Polynomial { function, coefficients, .. } => {
                let (file, function) = place(&function);
                assert!(holds_polynomial(&literals(file, function), &coefficients), "{name} in {file}");
            }
            Table::Surface { function, rows, .. } => {
                let (file, function) = place(&function);
                let literals = literals(file, function);
                assert!(rows.iter().all(|row| holds_polynomial(&literals, written(row))), "{name} in {file}");
            }
            Table::Quadrature { function, nodes, weights, .. } => {
                let (file, function) = place(&function);
                let literals = literals(file, function);
                assert!(holds_all(&literals, &nodes) && holds_all(&literals, &weights), "{name} in {file}");
            }
        }
    }
}

#[test]
fn polynomials_hold_their_errors() {
    let mut seen = 0;
    for (name, table) in tables() {
        // Measured: erfcx 2.66e-7, phi_one 1.27e-7, phi_one_unit 2.20e-7, front_share 3.75e-6.
        let (error, stated) = match table {
            Table::Polynomial { coefficients, range, relative_error_f32, .. } => {
                (worst_error(&name, &coefficients, range), relative_error_f32)
            }
            Table::Surface { rows, largest, absolute_error_f32, .. } => {
                (worst_share(&rows, largest), absolute_error_f32)
            }
            Table::Quadrature { .. } => continue,
        };
        assert!(error <= stated, "{name}: {error:e}");
        // The stated error is no guess either.
        assert!(error >= 0.5 * stated, "{name}: {error:e} is far below what is stated");
        println!("{name}: {error:.2e}");
        seen += 1;
    }
    assert_eq!(seen, 9);
}

#[test]
fn rules_are_exact() {
    for (name, table) in tables() {
        if let Table::Quadrature { nodes, weights, .. } = table {
            let error = quadrature_error(&nodes, &weights);
            // Measured: 3.3e-16 at most.
            assert!(error <= 5e-16, "{name}: {error:e}");
            let rule = gauss_legendre(nodes.len());
            assert!(rule.iter().zip(&nodes).all(|(r, x)| (r[0] - x).abs() <= 2e-16), "{name}: {rule:?}");
        }
    }
}

#[test]
fn everything_is_explained() {
    let readme = include_str!("../tables/README.md");
    for (name, table) in tables() {
        assert!(readme.contains(&format!("`{name}`")), "tables/README.md lacks {name}");
        let (Table::Polynomial { meaning, source, .. }
        | Table::Surface { meaning, source, .. }
        | Table::Quadrature { meaning, source, .. }) = table;
        assert!(!meaning.is_empty() && !source.is_empty(), "{name}");
    }
}

#[test]
fn damaged_tables_are_rejected() {
    for (name, table) in tables() {
        match table {
            Table::Polynomial { function, range, relative_error_f32, coefficients, .. } => {
                let (file, function) = place(&function);
                for i in 0..coefficients.len() {
                    let mut damaged = coefficients.clone();
                    damaged[i] = f64::from((damaged[i] as f32).next_up());
                    assert!(!holds_polynomial(&literals(file, function), &damaged), "{name} {i}");
                }
                let mut damaged = coefficients.clone();
                damaged[1] *= 1.0 + 2e-5;
                assert!(worst_error(&name, &damaged, range) > relative_error_f32, "{name}");
                damaged[1] = f64::NAN;
                assert!(worst_error(&name, &damaged, range) > relative_error_f32, "{name}: NaN");
            }
            Table::Surface { function, largest, absolute_error_f32, mut rows, .. } => {
                let (file, function) = place(&function);
                let literals = literals(file, function);
                for row in &rows {
                    let mut damaged = written(row).to_vec();
                    damaged[0] = f64::from((damaged[0] as f32).next_up());
                    assert!(!holds_polynomial(&literals, &damaged), "{name} {row:?}");
                }
                rows[2][0] *= 1.01;
                assert!(worst_share(&rows, largest) > absolute_error_f32, "{name}");
                rows[2][0] = f64::NAN;
                assert!(worst_share(&rows, largest) > absolute_error_f32, "{name}: NaN");
            }
            Table::Quadrature { function, nodes, mut weights, .. } => {
                weights[1] += 2e-15;
                assert!(quadrature_error(&nodes, &weights) > 5e-16, "{name}");
                weights[1] += 1e-7;
                let (file, function) = place(&function);
                assert!(!holds_all(&literals(file, function), &weights), "{name}");
            }
        }
    }
}
