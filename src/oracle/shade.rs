//! Lighting and silhouettes of one segment: the factors that [`crate::scene::Lighting`] and
//! [`crate::scene::Silhouette`] define.

use glam::DVec3;

use crate::scene::{
    Basis, GRADIENT_FLOOR, HALF_VECTOR_FLOOR, LightSpace, Lighting, Optics, Silhouette, SilhouetteMode,
};

/// What lighting and silhouettes make of a segment: constants along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shade {
    /// Multiplies extinction and emission.
    pub density: f64,
    /// Multiplies opacity and colour of the whole segment.
    pub opacity: f64,
    /// Multiplies colours.
    pub color: f64,
    /// White added to every colour.
    pub white: f64,
}

impl Shade {
    /// Changes nothing.
    pub const NONE: Self = Self { density: 1.0, opacity: 1.0, color: 1.0, white: 0.0 };
}

/// The optics of a picture as seen by its camera.
#[derive(Clone, Copy, Debug)]
pub struct Illumination {
    /// With the light's direction in view axes.
    lighting: Option<Lighting>,
    silhouette: Option<Silhouette>,
    /// Square of the gradient magnitude at which half has faded.
    floor: f64,
}

impl Illumination {
    /// For the camera that `basis` belongs to. `steepest`: the mesh's largest gradient magnitude.
    pub fn new(optics: &Optics, basis: &Basis, steepest: f64) -> Self {
        let lighting = optics.lighting.map(|light| {
            let direction = match light.space {
                // View axes point away from the viewer.
                LightSpace::View => DVec3 { z: -light.direction.z, ..light.direction },
                LightSpace::World => {
                    let along = |axis: DVec3| axis.dot(light.direction);
                    DVec3::new(along(basis.right), along(basis.up), along(basis.forward))
                }
            };
            Lighting { direction, ..light }
        });
        Self { lighting, silhouette: optics.silhouette, floor: (GRADIENT_FLOOR * steepest).powi(2) }
    }

    /// Of a segment with this gradient in the middle, on a ray of this direction (of any length), both in view axes.
    pub fn shade(&self, gradient: DVec3, direction: DVec3) -> Shade {
        let mut shade = Shade::NONE;
        let squared = gradient.length_squared();
        // So also where the square is lost to underflow, or is no number.
        if !(squared > 0.0 && squared.is_finite()) {
            return shade;
        }
        let weight = squared / (squared + self.floor);
        let (normal, toward_eye) = (gradient.normalize(), -direction.normalize());
        if let Some(light) = &self.lighting {
            let half = light.direction + toward_eye;
            let glance = normal.dot(half).abs() / (half.length_squared() + HALF_VECTOR_FLOOR).sqrt();
            let lit = light.ambient + light.diffuse * normal.dot(light.direction).abs();
            shade.color = 1.0 + weight * (lit - 1.0);
            shade.white = weight * light.specular * glance.powf(light.shininess);
        }
        if let Some(Silhouette { exponent, strength, mode }) = self.silhouette {
            let turned_away = (1.0 - normal.dot(toward_eye).abs()).max(0.0);
            let factor = 1.0 + weight * strength * (turned_away.powf(exponent) - 1.0);
            match mode {
                SilhouetteMode::Opacity => shade.opacity = factor,
                SilhouetteMode::Depth => shade.density = factor,
            }
        }
        shade
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BASIS: Basis = Basis { right: DVec3::Y, up: DVec3::Z, forward: DVec3::X };

    fn illumination(space: LightSpace, direction: DVec3) -> Illumination {
        let lighting = Lighting { ambient: 0.25, diffuse: 0.5, specular: 0.5, shininess: 2.0, direction, space };
        let silhouette = Silhouette { exponent: 2.0, strength: 0.5, mode: SilhouetteMode::Depth };
        let optics = Optics { lighting: Some(lighting), silhouette: Some(silhouette), ..Optics::PLAIN };
        Illumination::new(&optics, &BASIS, 1.0)
    }

    #[test]
    fn a_head_light_is_brightest_on_what_faces_the_eye() {
        let head = illumination(LightSpace::View, DVec3::Z);
        // Seen along z of the view axes: 1e-6 short of 1 by the fading, and as much by the half vector's floor.
        let facing = head.shade(DVec3::Z, 3.0 * DVec3::Z);
        assert!((facing.color - 0.75).abs() < 1e-6 && (facing.white - 0.5).abs() < 1e-6, "{facing:?}");
        assert!((facing.density - 0.5).abs() < 1e-6 && facing.opacity == 1.0, "{facing:?}");
        let edge_on = head.shade(DVec3::Y, 3.0 * DVec3::Z);
        assert!((edge_on.color - 0.25).abs() < 1e-5 && edge_on.white == 0.0 && edge_on.density == 1.0, "{edge_on:?}");
        let behind = head.shade(-DVec3::Z, 3.0 * DVec3::Z);
        assert_eq!(behind, facing, "two-sided");
    }

    #[test]
    fn both_spaces_mean_the_same_light() {
        // Towards the viewer, right and up.
        let view = illumination(LightSpace::View, DVec3::new(1.0, 2.0, 3.0).normalize());
        let world = illumination(LightSpace::World, DVec3::new(-3.0, 1.0, 2.0).normalize());
        let (gradient, ray) = (DVec3::new(0.3, -0.2, 0.9), DVec3::new(0.1, 0.0, 1.0));
        let (a, b) = (view.shade(gradient, ray), world.shade(gradient, ray));
        assert!((a.color - b.color).abs() < 1e-15 && (a.white - b.white).abs() < 1e-15, "{a:?} {b:?}");
    }

    #[test]
    fn vanishing_gradients_fade_to_nothing() {
        let head = illumination(LightSpace::View, DVec3::Z);
        assert_eq!(head.shade(DVec3::ZERO, DVec3::Z), Shade::NONE);
        assert_eq!(head.shade(DVec3::splat(f64::NAN), DVec3::Z), Shade::NONE);
        assert_eq!(head.shade(DVec3::splat(1e-200), DVec3::Z), Shade::NONE);
        let faint = head.shade(DVec3::new(0.0, 1e-6, 0.0), DVec3::Z);
        assert!((faint.color - 1.0).abs() < 1e-5, "{faint:?}");
        let half = head.shade(DVec3::new(0.0, 0.0, 1e-3), DVec3::Z);
        assert!((half.color - 0.875).abs() < 1e-12 && (half.density - 0.75).abs() < 1e-12, "{half:?}");
        // The light stands behind what is seen: there is no half vector.
        let back = illumination(LightSpace::View, -DVec3::Z).shade(DVec3::new(1.0, 0.0, 1.0), DVec3::Z);
        assert!(back.white == 0.0 && back.color.is_finite(), "{back:?}");
    }
}
