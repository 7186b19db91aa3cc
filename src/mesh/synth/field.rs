//! The analytic fields: value and gradient at a point.

use std::f64::consts::PI;

use glam::DVec3;

/// Outer radius of the flow's mesh, in sphere radii.
pub(super) const FLOW_RADIUS: f64 = 8.0;

/// Marschner and Lobb, "An evaluation of reconstruction filters for volume rendering", 1994, eq. 1.
pub(super) fn marschner_lobb(p: DVec3) -> (f64, DVec3) {
    const FREQUENCY: f64 = 6.0;
    const ALPHA: f64 = 0.25;
    let scale = 1.0 / (2.0 * (1.0 + ALPHA));
    let r = p.x.hypot(p.y);
    let phase = 2.0 * PI * FREQUENCY * (0.5 * PI * r).cos();
    let value = (1.0 - (0.5 * PI * p.z).sin() + ALPHA * (1.0 + phase.cos())) * scale;
    let radial = ALPHA * phase.sin() * PI * PI * FREQUENCY * (0.5 * PI * r).sin();
    // The radial derivative vanishes on the axis, where its direction is undefined.
    let (x, y) = if r > 0.0 { (radial * p.x / r, radial * p.y / r) } else { (0.0, 0.0) };
    (value, DVec3::new(x, y, -0.5 * PI * (0.5 * PI * p.z).cos()) * scale)
}

/// Squared 3d (m = 0) wave function of hydrogen, `((2 z^2 - x^2 - y^2) exp(-r / 3))^2`, over its maximum at z = 6.
pub(super) fn hydrogen(p: DVec3) -> (f64, DVec3) {
    let peak = 72.0 * (-2.0_f64).exp();
    let r = p.length();
    let decay = (-r / 3.0).exp() / peak;
    let quadric = 2.0 * p.z * p.z - p.x * p.x - p.y * p.y;
    let wave = quadric * decay;
    let outward = if r > 0.0 { p / r } else { DVec3::ZERO };
    let wave_gradient = (DVec3::new(-2.0 * p.x, -2.0 * p.y, 4.0 * p.z) - quadric / 3.0 * outward) * decay;
    (wave * wave, 2.0 * wave * wave_gradient)
}

/// Velocity of the potential flow `grad(x (1 + 1 / (2 r^3)))` past the unit sphere, over the free stream's.
pub(super) fn flow_velocity(p: DVec3) -> DVec3 {
    let r2 = p.length_squared();
    let dipole = 0.5 / (r2 * r2.sqrt());
    DVec3::X * (1.0 + dipole) - p * (3.0 * dipole * p.x / r2)
}

/// Pressure coefficient `1 - |u|^2` of that flow.
pub(super) fn flow_pressure(p: DVec3) -> (f64, DVec3) {
    let r2 = p.length_squared();
    let u = flow_velocity(p);
    // The velocity's Jacobian is the potential's Hessian,
    // -(3 / (2 r^5)) (e_x p^T + p e_x^T + x I - 5 x p p^T / r^2), applied to u.
    let along = p.dot(u);
    let applied = DVec3::X * along + p * u.x + p.x * u - p * (5.0 * p.x * along / r2);
    let jacobian_u = applied * (-1.5 / (r2 * r2 * r2.sqrt()));
    (1.0 - u.length_squared(), -2.0 * jacobian_u)
}

/// The tangle quartic.
pub(super) fn tangle(p: DVec3) -> (f64, DVec3) {
    let square = p * p;
    ((square * square - 5.0 * square).element_sum() + 11.8, 4.0 * square * p - 10.0 * p)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::Sample;

    /// Largest difference of the gradient from central differences, over points of the sample's mesh.
    fn worst_gradient_error(field: impl Fn(DVec3) -> (f64, DVec3), points: &[DVec3]) -> f64 {
        const STEP: f64 = 1e-5;
        points
            .iter()
            .flat_map(|&p| {
                let gradient = field(p).1;
                let scale = 1.0 + gradient.length();
                let f = &field;
                [DVec3::X, DVec3::Y, DVec3::Z].map(move |axis| {
                    let difference = (f(p + STEP * axis).0 - f(p - STEP * axis).0) / (2.0 * STEP);
                    (difference - gradient.dot(axis)).abs() / scale
                })
            })
            .fold(0.0, f64::max)
    }

    #[test]
    fn gradients_agree_with_differences() {
        for sample in Sample::ALL {
            let points = sample.mesh(4000).points;
            let error = worst_gradient_error(|p| sample.field(p), &points);
            // Truncation and rounding of a 1e-5 step; the largest seen is 4.5e-8 (marschner-lobb, phase 12 pi).
            assert!(error < 2e-7, "{sample:?}: {error:e}");
            // The helper must be able to fail.
            let planted = worst_gradient_error(|p| (sample.field(p).0, sample.field(p).1 * 1.001), &points);
            assert!(planted > 1e-4, "{sample:?}: a gradient 0.1 % off gives {planted:e}");
        }
    }

    #[test]
    fn known_values() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "{a} is not {b}");
        near(Sample::MarschnerLobb.field(DVec3::ZERO).0, (1.0 + 0.5) / 2.5);
        near(Sample::Hydrogen.field(DVec3::Z * 6.0).0, 1.0);
        near(Sample::Hydrogen.field(DVec3::ZERO).1.length(), 0.0);
        // Stagnation points, and 3/2 of the free stream at the equator.
        near(Sample::SphereFlow.field(DVec3::X).0, 1.0);
        near(Sample::SphereFlow.field(DVec3::Y).0, 1.0 - 2.25);
        near(Sample::Tangle.field(DVec3::ONE).0, -0.2);
    }
}
