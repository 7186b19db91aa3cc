//! Lighting and silhouettes on the device: what shaders are specialised to, and the numbers they read.

use glam::DVec3;

use crate::error::{Error, Result};
use crate::gpu::layout;
use crate::scene::{Basis, EmissionModel, LightSpace, Optics, SilhouetteMode};

/// The kinds of shading that a scene uses; the rest is compiled away.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shading {
    /// Colours are lit.
    pub lit: bool,
    /// What silhouettes multiply, if there are any.
    pub outline: Option<SilhouetteMode>,
}

impl Shading {
    /// Those of a picture's optics.
    pub fn of(optics: &Optics) -> Self {
        Self { lit: optics.lighting.is_some(), outline: optics.silhouette.map(|s| s.mode) }
    }

    /// Whether gradient vectors are needed.
    pub fn is_on(self) -> bool {
        self.lit || self.outline.is_some()
    }

    /// Whether a segment may be integrated part by part: factors on the opacity of the whole do not allow it.
    pub fn allows_spans(self) -> bool {
        self.outline != Some(SilhouetteMode::Opacity)
    }

    /// `override` constants.
    pub fn constants(self) -> [(&'static str, f64); 3] {
        let flag = |b: bool| f64::from(u8::from(b));
        let outline = match self.outline {
            None => 0.0,
            Some(SilhouetteMode::Opacity) => 1.0,
            Some(SilhouetteMode::Depth) => 2.0,
        };
        [("SHADED", flag(self.is_on())), ("LIT", flag(self.lit)), ("OUTLINE", outline)]
    }
}

/// What cannot be drawn.
///
/// # Errors
/// Lit unweighted emission: the weight of highlights would be the integral of the profiles, which no kernel returns.
pub fn check(optics: &Optics) -> Result<()> {
    if optics.emission == EmissionModel::Unweighted && optics.lighting.is_some() {
        return Err(Error::Asked(
            "lighting of unweighted emission cannot be drawn on a graphics device: use --device oracle, or weighted \
             emission"
                .into(),
        ));
    }
    Ok(())
}

/// What `shared/light.wgsl` reads, for the camera that `basis` belongs to. Zeros for what is off.
pub fn uniform(optics: &Optics, basis: &Basis) -> layout::Light {
    let mut light = layout::Light::default();
    if let Some(l) = optics.lighting {
        let towards = match l.space {
            // The shaders' view axes point away from the viewer.
            LightSpace::View => l.direction * DVec3::new(1.0, 1.0, -1.0),
            LightSpace::World => {
                DVec3::new(l.direction.dot(basis.right), l.direction.dot(basis.up), l.direction.dot(basis.forward))
            }
        };
        light.direction = towards.as_vec3().to_array();
        light.ambient = l.ambient as f32;
        light.diffuse = l.diffuse as f32;
        light.specular = l.specular as f32;
        light.shininess = l.shininess as f32;
    }
    if let Some(s) = optics.silhouette {
        light.exponent = s.exponent as f32;
        light.strength = s.strength as f32;
    }
    light
}
