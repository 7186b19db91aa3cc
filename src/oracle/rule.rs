//! Gauss-Legendre collocation on [0, 1]: definite integrals and the running integral up to every node.

use std::sync::LazyLock;

/// Four nodes: exact for polynomials up to degree 7.
pub static FOUR: LazyLock<Rule<4>> = LazyLock::new(Rule::new);
/// Eight nodes: exact for polynomials up to degree 15.
pub static EIGHT: LazyLock<Rule<8>> = LazyLock::new(Rule::new);

/// `N` nodes inside (0, 1) and what to multiply values at them by.
#[derive(Clone, Debug)]
pub struct Rule<const N: usize> {
    /// Increasing.
    pub nodes: [f64; N],
    /// For the integral over [0, 1]; they sum to 1.
    pub weights: [f64; N],
    /// Row `i` integrates the interpolating polynomial from 0 to node `i`.
    pub running: [[f64; N]; N],
}

impl<const N: usize> Rule<N> {
    /// Roots of the Legendre polynomial by Newton's method; the running weights by projecting on Legendre polynomials,
    /// whose own integrals are `(P[m+1] - P[m-1]) / (2m + 1)`.
    fn new() -> Self {
        // On [-1, 1] first.
        let roots: [f64; N] = std::array::from_fn(|i| {
            let guess = -(std::f64::consts::PI * (i as f64 + 0.75) / (N as f64 + 0.5)).cos();
            (0..20).fold(guess, |x, _| x - legendre(N, x) / derivative(N, x))
        });
        let weights = roots.map(|x| 2.0 / ((1.0 - x * x) * derivative(N, x).powi(2)));
        let running = roots.map(|x| {
            let integrals: [f64; N] = std::array::from_fn(|m| match m {
                0 => x + 1.0,
                _ => (legendre(m + 1, x) - legendre(m - 1, x)) / (2 * m + 1) as f64,
            });
            std::array::from_fn(|j| {
                let projected = |m: usize| (m as f64 + 0.5) * weights[j] * legendre(m, roots[j]) * integrals[m];
                0.5 * (0..N).map(projected).sum::<f64>()
            })
        });
        Self { nodes: roots.map(|x| 0.5 * (x + 1.0)), weights: weights.map(|w| 0.5 * w), running }
    }
}

/// The Legendre polynomial of degree `n`, by its three-term recurrence.
fn legendre(n: usize, x: f64) -> f64 {
    let (mut previous, mut current) = (1.0, x);
    if n == 0 {
        return previous;
    }
    for k in 2..=n {
        let k = k as f64;
        (previous, current) = (current, ((2.0 * k - 1.0) * x * current - (k - 1.0) * previous) / k);
    }
    current
}

/// Its derivative, inside (-1, 1).
fn derivative(n: usize, x: f64) -> f64 {
    n as f64 * (x * legendre(n, x) - legendre(n - 1, x)) / (x * x - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worst_error<const N: usize>(rule: &Rule<N>, degree: i32) -> f64 {
        let integral: f64 = (0..N).map(|i| rule.weights[i] * rule.nodes[i].powi(degree)).sum();
        (integral - 1.0 / f64::from(degree + 1)).abs()
    }

    #[test]
    fn polynomials_are_exact_up_to_the_rules_degree_and_no_further() {
        for degree in 0..8 {
            assert!(worst_error(&FOUR, degree) < 1e-15, "degree {degree}");
        }
        assert!(worst_error(&FOUR, 8) > 1e-6);
        for degree in 0..16 {
            assert!(worst_error(&EIGHT, degree) < 1e-15, "degree {degree}");
        }
        assert!(worst_error(&EIGHT, 16) > 1e-12);
    }

    #[test]
    fn running_integrals_of_the_interpolating_polynomial_are_exact() {
        for degree in 0..8 {
            for i in 0..8 {
                let running: f64 = (0..8).map(|j| EIGHT.running[i][j] * EIGHT.nodes[j].powi(degree)).sum();
                let want = EIGHT.nodes[i].powi(degree + 1) / f64::from(degree + 1);
                assert!((running - want).abs() < 1e-15, "degree {degree}, node {i}: {running} {want}");
            }
        }
    }
}
