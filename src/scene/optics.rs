//! How the classified medium emits, is lit and shows its outlines: what applies to the whole picture.
//!
//! Lighting and silhouettes are factors that are constant over a cell's segment. With `G` the gradient vector at the
//! segment's middle (the mean of the adjacent cells' gradients at each vertex, weighted by volume, interpolated linearly),
//! `G_max` the largest gradient magnitude of the mesh's vertices, `n = G / |G|` and `v` the unit vector along the ray,
//!
//! ```text
//! w = |G|^2 / (|G|^2 + (1e-3 G_max)^2)        0 in a mesh of constant field
//! ```
//!
//! fades both out where the gradient vanishes and `n` means nothing: a factor `f` acts as `1 + w (f - 1)`. So neither
//! divides by zero nor flickers with a direction that is rounding noise.

use glam::DVec3;

/// Share of the mesh's largest gradient magnitude at which half of lighting and silhouettes has faded: the `1e-3` of
/// `w` above.
pub const GRADIENT_FLOOR: f64 = 1e-3;

/// Added to `|l + e|^2` before the root is taken, so that a half vector has a length where light and eye lie on
/// opposite sides.
pub const HALF_VECTOR_FLOOR: f64 = 1e-6;

/// Emission, lighting, silhouettes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Optics {
    /// What colours are multiplied by.
    pub emission: EmissionModel,
    /// Unlit where `None`.
    pub lighting: Option<Lighting>,
    /// Nothing is emphasised where `None`.
    pub silhouette: Option<Silhouette>,
}

/// What a widget's colour is multiplied by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EmissionModel {
    /// Its extinction: emission and absorption by the same particles, `int c a exp(-tau) dl`. Colours are bounded by
    /// opacity.
    #[default]
    Weighted,
    /// One over its support: `sum_k c_k int over support_k of exp(-tau) dl` (Song et al. 2009, equation 4). What is
    /// transparent glows; colours are not bounded and depend on the unit of length.
    Unweighted,
}

/// Gradient-based shading (Blinn-Phong), two-sided. With `l` the unit vector towards the light, `e = -v` the unit vector
/// towards the eye and `h = (l + e) / sqrt(|l + e|^2 + 1e-6)`, every colour `c` becomes
///
/// ```text
/// c (1 + w (ambient + diffuse |n . l| - 1)) + w specular |n . h|^shininess
/// ```
///
/// in all three channels: the highlight is white and emitted with the same weight as the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lighting {
    /// Not negative.
    pub ambient: f64,
    /// Not negative.
    pub diffuse: f64,
    /// Not negative.
    pub specular: f64,
    /// Above 0.
    pub shininess: f64,
    /// Towards the light, unit length, in `space`.
    pub direction: DVec3,
    /// What `direction` is relative to.
    pub space: LightSpace,
}

/// What a light is fixed to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightSpace {
    /// The camera: x to the picture's right, y to its top, z towards the viewer.
    #[default]
    View,
    /// The mesh: data space.
    World,
}

/// Emphasis on surfaces seen edge-on (Song et al. 2009, section 6.2): a factor
/// `m = 1 + w strength ((1 - |n . v|)^exponent - 1)`, 1 at outlines and down to `1 - strength` on what faces the eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Silhouette {
    /// Above 0; larger ones leave thinner outlines.
    pub exponent: f64,
    /// In 0..1.
    pub strength: f64,
    /// What is multiplied.
    pub mode: SilhouetteMode,
}

/// What a silhouette's factor multiplies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SilhouetteMode {
    /// The segment's opacity and colour after integration, as published. The picture changes a little when a cell is
    /// split, since opacities do not add: two halves of depth `tau / 2` let `(1 - m + m exp(-tau / 2))^2` through
    /// and not `1 - m + m exp(-tau)`.
    #[default]
    Opacity,
    /// The medium's density, so both extinction and emission: the optical depth becomes `m tau`, whether or not a cell
    /// is split.
    Depth,
}

impl Optics {
    /// Weighted emission, no lighting, no silhouettes: the default.
    pub const PLAIN: Self = Self { emission: EmissionModel::Weighted, lighting: None, silhouette: None };

    /// Whether gradient vectors are needed, and not their magnitudes alone.
    pub fn uses_gradients(&self) -> bool {
        self.lighting.is_some() || self.silhouette.is_some()
    }
}
