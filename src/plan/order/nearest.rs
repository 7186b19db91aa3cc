//! The point of a convex hull nearest to the origin.

/// Vectors of a linear inequality in the six entries of a symmetric matrix.
pub(super) type Form = [f64; 6];

/// Where the hull's nearest point is nearer than this, of points at distance 1, it may be the origin itself.
const ZERO: f64 = 1e-13;
/// The least of all products with the answer is at least this share of what it would be with the nearest point.
const ENOUGH: f64 = 0.9;
/// Measured: 2 to 20 for up to 40,000 points, whether there is an answer or none.
const MOST_STEPS: usize = 1000;

/// A vector whose product with every one of the `points` (of length 1) is positive, and nearly as large as can be for
/// the least of them; `None` where there is none, that is, where the hull of the points holds the origin.
///
/// Wolfe 1976 (*Finding the nearest point in a polytope*): the separating direction of the widest margin is the hull's
/// nearest point. Each step looks through all points once, and keeps at most seven.
pub(super) fn nearest_to_origin(points: &[Form]) -> Option<Form> {
    let mut corral: Vec<(Form, f64)> = vec![(*points.first()?, 1.0)];
    let mut x = points[0];
    for _ in 0..MOST_STEPS {
        let square = dot(&x, &x);
        if square < ZERO * ZERO {
            return None;
        }
        let least = points.iter().min_by(|a, b| dot(a, &x).total_cmp(&dot(b, &x)))?;
        let product = dot(least, &x);
        if product >= ENOUGH * square {
            return Some(x);
        }
        if corral.iter().any(|(p, _)| p == least) {
            // Rounding ends the search.
            return (product > 0.0).then_some(x);
        }
        corral.push((*least, 0.0));
        x = shrink(&mut corral);
    }
    let least = points.iter().map(|p| dot(p, &x)).fold(f64::INFINITY, f64::min);
    (least > 0.0).then_some(x)
}

/// Moves to the nearest point of the corral's hull, and drops the points that it does without.
fn shrink(corral: &mut Vec<(Form, f64)>) -> Form {
    loop {
        let (x, weights) = nearest_of_plane(corral);
        // How far towards that one may go without leaving the hull.
        let mut step = 1.0_f64;
        for ((_, old), new) in corral.iter().zip(&weights) {
            if *new <= 0.0 && old > new {
                step = step.min(old / (old - new));
            }
        }
        corral.iter_mut().zip(&weights).for_each(|((_, w), new)| *w += step * (new - *w));
        if weights.iter().all(|w| *w > 0.0) || corral.len() == 1 {
            return x;
        }
        let least = corral.iter().map(|(_, w)| *w).fold(f64::INFINITY, f64::min);
        let mut dropped = false;
        // At least one goes, whatever rounding left of it.
        corral.retain(|&(_, w)| {
            let goes = w <= 0.0 || (!dropped && w == least);
            dropped |= goes;
            !goes
        });
    }
}

/// The point nearest to the origin of the plane through all points, and its weights, which sum to 1. By orthogonal
/// columns and not by normal equations, whose error would be squared: margins of 1e-9 do occur.
fn nearest_of_plane(corral: &[(Form, f64)]) -> (Form, Vec<f64>) {
    let first = corral[0].0;
    let count = corral.len() - 1;
    let (mut basis, mut upper) = (Vec::<Form>::new(), vec![vec![0.0; count]; count]);
    for (j, (point, _)) in corral[1..].iter().enumerate() {
        let mut column: Form = std::array::from_fn(|k| point[k] - first[k]);
        let before = dot(&column, &column).sqrt();
        // Twice is enough (Kahan, after Parlett 1980).
        for _ in 0..2 {
            for (i, q) in basis.iter().enumerate() {
                let part = dot(q, &column);
                upper[i][j] += part;
                column = minus(&column, part, q);
            }
        }
        let length = dot(&column, &column).sqrt();
        // A point in the plane of the others takes no part.
        let is_new = length > 1e-14 * before && basis.len() < 6;
        upper[j][j] = if is_new { length } else { f64::INFINITY };
        basis.push(if is_new { column.map(|v| v / length) } else { [0.0; 6] });
    }
    let mut x = first;
    let mut along = vec![0.0; count];
    for (q, part) in basis.iter().zip(&mut along) {
        let p = dot(q, &x);
        *part = -p;
        x = minus(&x, p, q);
    }
    let mut weights = vec![0.0; count + 1];
    for i in (0..count).rev() {
        let rest: f64 = (i + 1..count).map(|j| upper[i][j] * weights[j + 1]).sum();
        weights[i + 1] = (along[i] - rest) / upper[i][i];
    }
    weights[0] = 1.0 - weights[1..].iter().sum::<f64>();
    (x, weights)
}

pub(super) fn dot(a: &Form, b: &Form) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn minus(a: &Form, t: f64, b: &Form) -> Form {
    std::array::from_fn(|k| a[k] - t * b[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(v: Form) -> Form {
        let length = dot(&v, &v).sqrt();
        v.map(|x| x / length)
    }

    /// Numbers in [-1, 1) from a linear congruence (Knuth's MMIX).
    fn noise(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    #[test]
    fn half_spaces_are_told_from_all_round() {
        let mut state = 1;
        let axis = unit([1.0, -2.0, 0.5, 3.0, 0.1, -1.0]);
        for margin in [1e-1, 1e-3, 1e-6, 1e-9] {
            let mut points: Vec<Form> = Vec::new();
            while points.len() < 5000 {
                let v = unit(std::array::from_fn(|_| noise(&mut state)));
                let height = dot(&v, &axis);
                // Everything is lifted to the margin at least.
                points.push(unit(minus(&v, height - height.abs().max(margin), &axis)));
            }
            let x = nearest_to_origin(&points).expect("a half-space");
            assert!(points.iter().all(|p| dot(p, &x) > 0.0), "margin {margin}");
            points.extend(points.clone().iter().map(|p| p.map(|v| -v)));
            assert_eq!(nearest_to_origin(&points), None);
        }
        assert_eq!(nearest_to_origin(&[]), None);
    }
}
