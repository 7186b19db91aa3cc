//! The scene file: which keys there are, what they may hold, and what a scene is once they have been checked.
//!
//! Nothing here knows a mesh: what depends on one (a fitted camera, normalised units) is kept as a choice and resolved by
//! [`Scene::resolve`]. The format is described in `docs/scene.md`.

use serde::Deserialize;

use super::choice::{CameraChoice, Draft, Opening, Scene, TransferChoice, Units, Viewpoint};
use super::document::{Document, Problem};
use super::optics_keys::{EmissionKey, LightingKeys, SilhouetteKeys, check_optics};
use super::transfer::{Curve, CurveNode, TransferFunction};
use super::widget_keys::{WidgetKeys, check_widget};
use crate::error::Result;
use crate::space::Bounds;

/// At most this many widgets: what the shaders hold.
pub const MAX_WIDGETS: usize = 64;
/// Longest side of an image, pixels.
const MAX_SIDE: u32 = 32_768;
/// Most pixels of an image: 4 GiB at 16 bytes each.
const MAX_PIXELS: u64 = 1 << 28;

pub(super) type Checked<T> = Result<T, Problem>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
struct SceneKeys {
    units: Option<UnitsKey>,
    #[serde(default)]
    camera: CameraKeys,
    #[serde(default)]
    image: ImageKeys,
    #[serde(default)]
    field: FieldKeys,
    transfer: Option<TransferKeys>,
    lighting: Option<LightingKeys>,
    silhouette: Option<SilhouetteKeys>,
    clip: Option<ClipKeys>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct CameraKeys {
    eye: Option<Numbers<3>>,
    target: Option<Numbers<3>>,
    up: Option<Numbers<3>>,
    azimuth: Option<f64>,
    elevation: Option<f64>,
    zoom: Option<f64>,
    projection: Option<ProjectionKey>,
    fov_y: Option<f64>,
    height: Option<f64>,
    near: Option<f64>,
}

#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum ProjectionKey {
    Perspective,
    Orthographic,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct ImageKeys {
    width: Option<i64>,
    height: Option<i64>,
    background: Option<Color>,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields)]
struct FieldKeys {
    scalar: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ClipKeys {
    min: Numbers<3>,
    max: Numbers<3>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TransferKeys {
    units: Option<UnitsKey>,
    emission: Option<EmissionKey>,
    draw: Option<DrawKey>,
    widget: Option<Vec<WidgetKeys>>,
    curve: Option<CurveKeys>,
}

#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum DrawKey {
    Widgets,
    Curve,
}

#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum UnitsKey {
    Data,
    Normalized,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CurveKeys {
    points: Vec<Vec<f64>>,
}

/// Exactly `N` numbers; serde's arrays would ignore further ones.
#[derive(Deserialize, Clone, Copy)]
#[serde(try_from = "Vec<f64>")]
pub(super) struct Numbers<const N: usize>(pub [f64; N]);

impl<const N: usize> TryFrom<Vec<f64>> for Numbers<N> {
    type Error = String;
    fn try_from(values: Vec<f64>) -> Result<Self, String> {
        let count = values.len();
        values.try_into().map(Self).map_err(|_| format!("{N} numbers are needed, not {count}"))
    }
}

/// Linear numbers, or sRGB as `#rrggbb` or `#rrggbbaa`.
#[derive(Deserialize, Clone)]
#[serde(untagged, expecting = "a colour is [r, g, b], linear, or \"#rrggbb\", sRGB")]
pub(super) enum Color {
    Linear(Vec<f64>),
    Srgb(String),
}

impl Color {
    /// Linear channels, three or four of them.
    fn linear(&self, key: &str) -> Checked<Vec<f64>> {
        match self {
            Self::Linear(values) => match values.iter().find(|v| !(v.is_finite() && **v >= 0.0)) {
                Some(bad) => Err(Problem::new(key, format!("channels must be finite and not negative, not {bad}"))),
                None => Ok(values.clone()),
            },
            Self::Srgb(text) => hex_color(text)
                .ok_or_else(|| Problem::new(key, format!("'{text}' is no colour: write \"#rrggbb\" or [r, g, b]"))),
        }
    }

    pub(super) fn rgb(&self, key: &str) -> Checked<[f64; 3]> {
        let channels = self.linear(key)?;
        let count = channels.len();
        channels.try_into().map_err(|_| Problem::new(key, format!("3 channels are needed, not {count}")))
    }

    fn rgba(&self, key: &str) -> Checked<[f64; 4]> {
        match self.linear(key)?[..] {
            [r, g, b] => Ok([r, g, b, 1.0]),
            [r, g, b, a] if a <= 1.0 => Ok([r, g, b, a]),
            [_, _, _, a] => Err(Problem::new(key, format!("opacity must lie in 0..1, not {a}"))),
            ref other => Err(Problem::new(key, format!("4 channels are needed, not {}", other.len()))),
        }
    }
}

/// `#rrggbb` or `#rrggbbaa` to linear channels.
fn hex_color(text: &str) -> Option<Vec<f64>> {
    let digits = text.strip_prefix('#').filter(|d| d.is_ascii() && matches!(d.len(), 6 | 8))?;
    (0..digits.len() / 2)
        .map(|i| {
            let value = f64::from(u8::from_str_radix(digits.get(2 * i..2 * i + 2)?, 16).ok()?) / 255.0;
            Some(if i == 3 { value } else { linear_from_srgb(value) })
        })
        .collect()
}

/// IEC 61966-2-1.
fn linear_from_srgb(v: f64) -> f64 {
    if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

/// Reads and checks a scene.
pub(super) fn read_scene(document: &Document<'_>) -> Result<Scene> {
    let keys: SceneKeys = document.read()?;
    check_scene(keys).map_err(|problem| document.refuse(&problem))
}

fn check_scene(keys: SceneKeys) -> Checked<Scene> {
    let size = [
        check_side("image.width", keys.image.width.unwrap_or(800))?,
        check_side("image.height", keys.image.height.unwrap_or(600))?,
    ];
    if u64::from(size[0]) * u64::from(size[1]) > MAX_PIXELS {
        return Err(Problem::new("image.width", format!("{} x {} is above {MAX_PIXELS} pixels", size[0], size[1])));
    }
    let background = match &keys.image.background {
        Some(color) => color.rgba("image.background")?,
        None => [0.0; 4],
    };
    if keys.field.scalar.as_deref() == Some("") {
        return Err(Problem::new("field.scalar", "the name is empty: leave the key out for the first field"));
    }
    let emission = keys.transfer.as_ref().and_then(|transfer| transfer.emission);
    let optics = check_optics(emission, keys.lighting.as_ref(), keys.silhouette.as_ref())?;
    let transfer = match (keys.transfer, keys.units) {
        // How the default function emits.
        (Some(TransferKeys { units: None, emission: Some(_), draw: None, widget: None, curve: None }), None) => None,
        (Some(transfer), units) => Some(check_transfer(transfer, units)?),
        (None, Some(_)) => return Err(Problem::new("units", "there is no transfer function that they could apply to")),
        (None, None) => None,
    };
    let clip = keys.clip.as_ref().map(check_clip).transpose()?;
    let camera = check_camera(&keys.camera)?;
    Ok(Scene { camera, size, background, field: keys.field.scalar, transfer, optics, clip })
}

fn check_side(key: &str, value: i64) -> Checked<u32> {
    u32::try_from(value)
        .ok()
        .filter(|v| (1..=MAX_SIDE).contains(v))
        .ok_or_else(|| Problem::new(key, format!("must lie in 1..{MAX_SIDE} pixels, not {value}")))
}

fn check_clip(keys: &ClipKeys) -> Checked<Bounds> {
    let (min, max) = (keys.min.0, keys.max.0);
    finite("clip.min", &min)?;
    finite("clip.max", &max)?;
    match (0..3).find(|&axis| min[axis] >= max[axis]) {
        Some(axis) => {
            let (name, low, high) = (["x", "y", "z"][axis], min[axis], max[axis]);
            Err(Problem::new("clip.max", format!("the box is empty: its {name} reaches from {low} to {high}")))
        }
        None => Ok(Bounds { min: min.into(), max: max.into() }),
    }
}

fn check_camera(keys: &CameraKeys) -> Checked<CameraChoice> {
    let fits = [("azimuth", keys.azimuth), ("elevation", keys.elevation), ("zoom", keys.zoom)];
    let viewpoint = match &keys.eye {
        Some(eye) => {
            if let Some((name, _)) = fits.iter().find(|(_, value)| value.is_some()) {
                return Err(Problem::new(format!("camera.{name}"), "excludes camera.eye: give one or the other"));
            }
            let vector = |name: &str, value: &Option<Numbers<3>>| match value {
                Some(v) => finite(&format!("camera.{name}"), &v.0).map(|()| Some(v.0.into())),
                None => Ok(None),
            };
            finite("camera.eye", &eye.0)?;
            let (target, up) = (vector("target", &keys.target)?, vector("up", &keys.up)?);
            Viewpoint::At { eye: eye.0.into(), target, up }
        }
        None => {
            for (name, value) in [("target", keys.target), ("up", keys.up)] {
                if value.is_some() {
                    return Err(Problem::new(format!("camera.{name}"), "needs camera.eye beside it"));
                }
            }
            for (name, value) in fits {
                finite(&format!("camera.{name}"), value.as_slice())?;
            }
            let zoom = keys.zoom.unwrap_or(1.0);
            if zoom <= 0.0 {
                return Err(Problem::new("camera.zoom", format!("must be above 0, not {zoom}")));
            }
            Viewpoint::Fit {
                azimuth: keys.azimuth.unwrap_or(30.0).to_radians(),
                elevation: keys.elevation.unwrap_or(20.0).to_radians(),
                zoom,
            }
        }
    };
    if let Viewpoint::At { eye, target: Some(target), up: Some(up) } = viewpoint {
        super::choice::check_axes(eye, target, up)?;
    }
    let opening = check_opening(keys)?;
    if let Some(near) = keys.near {
        let perspective = matches!(opening, Opening::Perspective { .. });
        if !near.is_finite() || near < 0.0 || (perspective && near == 0.0) {
            let least = if perspective { "above 0" } else { "at least 0" };
            return Err(Problem::new("camera.near", format!("must be {least} and finite, not {near}")));
        }
    }
    Ok(CameraChoice { viewpoint, opening, near: keys.near })
}

fn check_opening(keys: &CameraKeys) -> Checked<Opening> {
    if let Some(height) = keys.height {
        if keys.fov_y.is_some() {
            return Err(Problem::new("camera.height", "excludes camera.fov_y: an image is orthographic or it is not"));
        }
        if keys.projection == Some(ProjectionKey::Perspective) {
            return Err(Problem::new(
                "camera.height",
                "belongs to an orthographic camera: give fov_y, or drop projection",
            ));
        }
        if !(height.is_finite() && height > 0.0) {
            return Err(Problem::new("camera.height", format!("must be above 0 and finite, not {height}")));
        }
        return Ok(Opening::Orthographic { height: Some(height) });
    }
    if keys.projection == Some(ProjectionKey::Orthographic) {
        return match keys.fov_y {
            Some(_) => Err(Problem::new("camera.fov_y", "belongs to a perspective camera: give height, or nothing")),
            None => Ok(Opening::Orthographic { height: None }),
        };
    }
    let fov_y = keys.fov_y.unwrap_or(30.0);
    if !(fov_y > 0.0 && fov_y < 180.0) {
        return Err(Problem::new("camera.fov_y", format!("must lie between 0 and 180 degrees, not {fov_y}")));
    }
    Ok(Opening::Perspective { fov_y: fov_y.to_radians() })
}

fn check_transfer(keys: TransferKeys, outer: Option<UnitsKey>) -> Checked<TransferChoice> {
    if outer.is_some() && keys.units.is_some() {
        return Err(Problem::new("units", "stands at the top and in [transfer]: keep one"));
    }
    let units = match keys.units.or(outer) {
        Some(UnitsKey::Normalized) => Units::Normalized,
        Some(UnitsKey::Data) | None => Units::Data,
    };
    let widgets = match keys.widget {
        Some(widgets) if widgets.len() > MAX_WIDGETS => {
            let key = format!("transfer.widget.{MAX_WIDGETS}");
            return Err(Problem::new(key, format!("at most {MAX_WIDGETS} widgets, not {}", widgets.len())));
        }
        Some(widgets) => {
            let check = |(index, widget): (usize, &WidgetKeys)| Ok((check_widget(index, widget)?, widget.hidden));
            widgets.iter().enumerate().map(check).collect::<Checked<Vec<_>>>()?
        }
        None => Vec::new(),
    };
    let curve = keys.curve.as_ref().map(check_curve).transpose()?;
    let draws_curve = match (keys.draw, widgets.is_empty(), &curve) {
        (None, false, Some(_)) => {
            let text = "excludes transfer.widget: say with transfer.draw which of them is drawn, or drop one";
            return Err(Problem::new("transfer.curve", text));
        }
        (_, true, None) => {
            let text = "has neither a widget nor a curve: leave it out for a default one";
            return Err(Problem::new("transfer", text));
        }
        (Some(DrawKey::Widgets), true, _) => return Err(Problem::new("transfer.draw", "there are no widgets")),
        (Some(DrawKey::Curve), _, None) => return Err(Problem::new("transfer.draw", "there is no curve")),
        (draw, _, _) => draw.map_or(widgets.is_empty(), |draw| draw == DrawKey::Curve),
    };
    let drawn = || widgets.iter().filter(|(_, is_hidden)| !is_hidden).map(|(widget, _)| widget.clone());
    let function = match &curve {
        Some(curve) if draws_curve => TransferFunction::Curve(curve.clone()),
        _ if drawn().next().is_none() => TransferFunction::nothing(),
        _ => TransferFunction::Widgets(drawn().collect()),
    };
    let is_all = (widgets.is_empty() || curve.is_none()) && widgets.iter().all(|(_, is_hidden)| !is_hidden);
    Ok(TransferChoice { units, function, draft: (!is_all).then_some(Draft { widgets, curve }) })
}

fn check_curve(keys: &CurveKeys) -> Checked<Curve> {
    if keys.points.is_empty() {
        return Err(Problem::new("transfer.curve.points", "at least one point [s, r, g, b, extinction] is needed"));
    }
    let mut nodes: Vec<CurveNode> = Vec::with_capacity(keys.points.len());
    for (index, point) in keys.points.iter().enumerate() {
        let key = format!("transfer.curve.points.{index}");
        let [scalar, r, g, b, extinction] = point[..] else {
            return Err(Problem::new(
                key,
                format!("5 numbers are needed, [s, r, g, b, extinction], not {}", point.len()),
            ));
        };
        finite(&key, &[scalar])?;
        if let Some(before) = nodes.last().filter(|before| before.scalar >= scalar) {
            return Err(Problem::new(key, format!("scalars must increase: {scalar} follows {}", before.scalar)));
        }
        let color = Color::Linear(vec![r, g, b]).rgb(&key)?;
        nodes.push(CurveNode { scalar, color, extinction: check_extinction(&key, extinction)? });
    }
    Ok(Curve { nodes })
}

pub(super) fn check_extinction(key: &str, value: f64) -> Checked<f64> {
    if value.is_finite() && value >= 0.0 {
        return Ok(value);
    }
    Err(Problem::new(key, format!("an extinction must be finite and not negative, not {value}")))
}

pub(super) fn finite(key: &str, values: &[f64]) -> Checked<()> {
    match values.iter().find(|v| !v.is_finite()) {
        Some(bad) => Err(Problem::new(key, format!("must be finite, not {bad}"))),
        None => Ok(()),
    }
}
