//! Speed against accuracy: which points no other beats, and how a time grows with what it is a time of.

/// Places of the points that no other beats: none is as small in both numbers and smaller in one. By the first number,
/// the smallest first. Points that are not finite are beaten by all.
pub fn front(points: &[[f64; 2]]) -> Vec<usize> {
    let finite = |i: &usize| points[*i].iter().all(|v| v.is_finite());
    let mut order: Vec<usize> = (0..points.len()).filter(finite).collect();
    order.sort_by(|&a, &b| {
        let [a, b] = [points[a], points[b]];
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
    });
    let mut front: Vec<usize> = Vec::new();
    for i in order {
        match front.last() {
            Some(&last) if points[i][1] >= points[last][1] && points[i] != points[last] => {}
            _ => front.push(i),
        }
    }
    front
}

/// A power law `y ~ x^exponent`, fitted by least squares of the logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// See the type.
    pub exponent: f64,
    /// Its standard error.
    pub standard_error: f64,
}

impl Growth {
    /// Of points `[x, y]`, those above 0 in both; `None` where fewer than three different `x` are left: two always fit.
    pub fn new(points: &[[f64; 2]]) -> Option<Self> {
        let usable = |p: &&[f64; 2]| p.iter().all(|v| v.is_finite() && *v > 0.0);
        let logs: Vec<[f64; 2]> = points.iter().filter(usable).map(|p| p.map(f64::ln)).collect();
        if different(logs.iter().map(|p| p[0])) < 3 {
            return None;
        }
        let count = logs.len() as f64;
        let [x, y] = [0, 1].map(|k| logs.iter().map(|p| p[k]).sum::<f64>() / count);
        let spread: f64 = logs.iter().map(|p| (p[0] - x).powi(2)).sum();
        let exponent = logs.iter().map(|p| (p[0] - x) * (p[1] - y)).sum::<f64>() / spread;
        let rest: f64 = logs.iter().map(|p| (p[1] - y - exponent * (p[0] - x)).powi(2)).sum();
        let standard_error = (rest / (count - 2.0) / spread).sqrt();
        Some(Self { exponent, standard_error })
    }
}

/// How many different numbers there are.
pub fn different(numbers: impl Iterator<Item = f64>) -> usize {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    numbers.dedup();
    numbers.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_beaten_point_is_not_on_the_front() {
        let points = [[3.0, 1.0], [1.0, 5.0], [2.0, 2.0], [2.5, 2.0], [2.0, 4.0], [f64::NAN, 0.0], [4.0, 0.0]];
        assert_eq!(front(&points), [1, 2, 0, 6]);
        // The planted one is on it once it is made faster than all.
        let mut faster = points;
        faster[4][0] = 0.5;
        assert_eq!(front(&faster), [4, 2, 0, 6]);
        assert_eq!(front(&[[1.0, 1.0], [1.0, 1.0]]), [0, 1], "equal points do not beat each other");
        assert!(front(&[]).is_empty());
    }

    /// Six sizes, a factor of two each, with deviations of a few per cent.
    fn planted(exponent: f64) -> Vec<[f64; 2]> {
        let noise = [1.02, 0.97, 1.03, 0.99, 1.01, 0.98];
        (0..).zip(noise).map(|(i, n)| (1000.0 * 2_f64.powi(i), n)).map(|(x, n)| [x, n * x.powf(exponent)]).collect()
    }

    #[test]
    fn an_exponent_is_recovered_and_another_is_rejected() {
        for exponent in [0.33, 1.0, 1.5] {
            let growth = Growth::new(&planted(exponent)).expect("enough sizes");
            assert!((growth.exponent - exponent).abs() < 3.0 * growth.standard_error, "{growth:?} is not {exponent}");
            for wrong in [exponent - 0.1, exponent + 0.1] {
                assert!((growth.exponent - wrong).abs() > 3.0 * growth.standard_error, "{growth:?} may be {wrong}");
            }
        }
        let exact: Vec<[f64; 2]> = [1.0, 2.0, 4.0].map(|x: f64| [x, 7.0 * x.powi(2)]).to_vec();
        let growth = Growth::new(&exact).expect("enough sizes");
        assert!((growth.exponent - 2.0).abs() < 1e-12 && growth.standard_error < 1e-12, "{growth:?}");
    }

    #[test]
    fn two_sizes_are_no_growth() {
        assert_eq!(Growth::new(&[[1.0, 1.0], [2.0, 2.0], [2.0, 2.5], [1.0, 1.1]]), None);
        assert_eq!(Growth::new(&[[1.0, 1.0], [2.0, 2.0], [0.0, 1.0], [4.0, f64::NAN]]), None);
    }
}
