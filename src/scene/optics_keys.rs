//! `emission`, `[lighting]` and `[silhouette]` of a scene file: their keys, and what is wrong with them.

use glam::DVec3;
use serde::Deserialize;

use super::document::Problem;
use super::file::{Checked, Numbers, finite};
use super::optics::{EmissionModel, LightSpace, Lighting, Optics, Silhouette, SilhouetteMode};

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
pub(super) enum EmissionKey {
    Weighted,
    Unweighted,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LightingKeys {
    ambient: Option<f64>,
    diffuse: Option<f64>,
    specular: Option<f64>,
    shininess: Option<f64>,
    direction: Option<Numbers<3>>,
    space: Option<SpaceKey>,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum SpaceKey {
    View,
    World,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SilhouetteKeys {
    exponent: Option<f64>,
    strength: Option<f64>,
    mode: Option<ModeKey>,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum ModeKey {
    Opacity,
    Depth,
}

pub(super) fn check_optics(
    emission: Option<EmissionKey>,
    lighting: Option<&LightingKeys>,
    silhouette: Option<&SilhouetteKeys>,
) -> Checked<Optics> {
    Ok(Optics {
        emission: match emission {
            Some(EmissionKey::Weighted) | None => EmissionModel::Weighted,
            Some(EmissionKey::Unweighted) => EmissionModel::Unweighted,
        },
        lighting: lighting.map(check_lighting).transpose()?,
        silhouette: silhouette.map(check_silhouette).transpose()?,
    })
}

fn check_lighting(keys: &LightingKeys) -> Checked<Lighting> {
    let share = |name: &str, value: Option<f64>, default: f64| {
        let (key, value) = (format!("lighting.{name}"), value.unwrap_or(default));
        finite(&key, &[value])?;
        if value < 0.0 {
            return Err(Problem::new(key, format!("must not be negative: {value}")));
        }
        Ok(value)
    };
    let given = keys.direction.map_or([0.0, 0.0, 1.0], |v| v.0);
    finite("lighting.direction", &given)?;
    // By the largest one first, so that no square leaves f64's range.
    let most = given.iter().fold(0.0f64, |most, v| most.max(v.abs()));
    if most == 0.0 {
        return Err(Problem::new("lighting.direction", "is zero: give a vector that points towards the light"));
    }
    Ok(Lighting {
        ambient: share("ambient", keys.ambient, 0.3)?,
        diffuse: share("diffuse", keys.diffuse, 0.7)?,
        specular: share("specular", keys.specular, 0.2)?,
        shininess: above_zero("lighting.shininess", keys.shininess.unwrap_or(32.0))?,
        direction: DVec3::from_array(given.map(|v| v / most)).normalize(),
        space: match keys.space {
            Some(SpaceKey::View) | None => LightSpace::View,
            Some(SpaceKey::World) => LightSpace::World,
        },
    })
}

fn check_silhouette(keys: &SilhouetteKeys) -> Checked<Silhouette> {
    let strength = keys.strength.unwrap_or(1.0);
    if !(0.0..=1.0).contains(&strength) {
        return Err(Problem::new("silhouette.strength", format!("must lie in 0..1, not {strength}")));
    }
    Ok(Silhouette {
        exponent: above_zero("silhouette.exponent", keys.exponent.unwrap_or(2.0))?,
        strength,
        mode: match keys.mode {
            Some(ModeKey::Opacity) | None => SilhouetteMode::Opacity,
            Some(ModeKey::Depth) => SilhouetteMode::Depth,
        },
    })
}

fn above_zero(key: &str, value: f64) -> Checked<f64> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(Problem::new(key, format!("must be above 0 and finite, not {value}")))
}
