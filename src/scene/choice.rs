//! A checked scene: what the user chose, before a mesh is known; and what it means for a mesh.

use std::path::Path;

use glam::DVec3;

use super::camera::{Camera, Projection};
use super::document::{Document, Override, Problem};
use super::file::read_scene;
use super::optics::Optics;
use super::shape::{WidgetShape, Window};
use super::transfer::{Curve, CurveNode, TransferFunction};
use super::widget::Widget;
use crate::error::{Error, Result};
use crate::space::{Bounds, Interval};

/// What a scene file, and the flags over it, ask for. Every value has been checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Where from.
    pub camera: CameraChoice,
    /// Width and height, pixels; each at least 1.
    pub size: [u32; 2],
    /// Behind the volume: linear RGBA, straight (not premultiplied), opacity in 0..1.
    pub background: [f64; 4],
    /// Name of the scalar field; the first one where `None`.
    pub field: Option<String>,
    /// Classification; chosen from the mesh's joint histogram where `None`.
    pub transfer: Option<TransferChoice>,
    /// Emission, lighting, silhouettes.
    pub optics: Optics,
    /// What is outside of it is cut off, data space; the mesh whole where `None`.
    pub clip: Option<Bounds>,
}

/// A camera, possibly to be fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraChoice {
    /// Where it stands.
    pub viewpoint: Viewpoint,
    /// How it opens.
    pub opening: Opening,
    /// As [`Camera::near`].
    pub near: Option<f64>,
}

/// Where a camera stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Viewpoint {
    /// At a place, data space.
    At {
        /// Position.
        eye: DVec3,
        /// Looked-at point; the middle of the mesh's bounding box where `None`.
        target: Option<DVec3>,
        /// Roughly upwards; z where `None`.
        up: Option<DVec3>,
    },
    /// So far away that the mesh's bounding sphere fits the image.
    Fit {
        /// Radians around z from the x axis, counter-clockwise seen from +z.
        azimuth: f64,
        /// Radians above the xy plane.
        elevation: f64,
        /// Above 1: closer.
        zoom: f64,
    },
}

/// How a camera opens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Opening {
    /// Full vertical angle.
    Perspective {
        /// Radians, in (0, pi).
        fov_y: f64,
    },
    /// Parallel rays.
    Orthographic {
        /// Of the image, data units; such that the mesh's bounding sphere fits where `None`.
        height: Option<f64>,
    },
}

/// A transfer function and the units of its two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferChoice {
    /// Of scalars and gradient magnitudes. Extinctions are per data length in either.
    pub units: Units,
    /// The function, in `units`.
    pub function: TransferFunction,
    /// All that the file holds, where that is more than what is drawn.
    pub draft: Option<Draft>,
}

/// A function with what is left out of the picture, to go on with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Draft {
    /// All widgets, and which are hidden.
    pub widgets: Vec<(Widget, bool)>,
    /// The curve, whether it is drawn or the widgets are.
    pub curve: Option<Curve>,
}

/// Units of a transfer function's axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Units {
    /// As in the file.
    #[default]
    Data,
    /// 0..1 over the mesh's scalar range, 0..1 over its gradient magnitude's range.
    Normalized,
}

impl Scene {
    /// Reads a scene file, with `overrides` laid over it in order. Without a file: the defaults and the overrides.
    ///
    /// # Errors
    /// [`Error::Io`] where the file cannot be read; [`Error::Asked`] naming key and line or flag of what is unknown,
    /// impossible or contradictory.
    pub fn read(path: Option<&Path>, overrides: &[Override]) -> Result<Self> {
        let text = match path {
            Some(path) => std::fs::read_to_string(path).map_err(|source| Error::io(path, source))?,
            None => String::new(),
        };
        read_scene(&Document::parse(&text, overrides, path)?)
    }

    /// The same from a string.
    ///
    /// # Errors
    /// [`Error::Asked`], as [`Scene::read`].
    pub fn parse(text: &str, overrides: &[Override]) -> Result<Self> {
        read_scene(&Document::parse(text, overrides, None)?)
    }

    /// The background as a frame wants it: linear, premultiplied.
    pub fn premultiplied_background(&self) -> [f32; 4] {
        let [r, g, b, a] = self.background;
        [r * a, g * a, b * a, a].map(|v| v as f32)
    }
}

impl CameraChoice {
    /// The camera for a mesh within `bounds` (data space) and an image of `aspect` = width / height.
    ///
    /// # Errors
    /// [`Error::Asked`] where eye and target coincide or `up` is parallel to the view.
    pub fn resolve(&self, bounds: &Bounds, aspect: f64) -> Result<Camera> {
        match self.viewpoint {
            Viewpoint::At { eye, target, up } => {
                let target = target.unwrap_or_else(|| bounds.center());
                let up = up.unwrap_or(DVec3::Z);
                check_axes(eye, target, up).map_err(|p| Error::Asked(format!("{}: {}", p.key, p.why)))?;
                let projection = self.opening.resolve(bounds, aspect, 1.0);
                Ok(Camera { eye, target, up, projection, near: self.near })
            }
            Viewpoint::Fit { azimuth, elevation, zoom } => {
                let projection = self.opening.resolve(bounds, aspect, zoom);
                let fitted = Camera::fit(bounds, aspect, [azimuth, elevation], zoom, projection);
                Ok(Camera { near: self.near, ..fitted })
            }
        }
    }
}

impl Opening {
    fn resolve(self, bounds: &Bounds, aspect: f64, zoom: f64) -> Projection {
        match self {
            Self::Perspective { fov_y } => Projection::Perspective { fov_y },
            Self::Orthographic { height: Some(height) } => Projection::Orthographic { height },
            Self::Orthographic { height: None } => {
                Projection::Orthographic { height: bounds.diagonal() / (zoom * aspect.min(1.0)) }
            }
        }
    }
}

/// Refuses cameras without a view direction or without a way up.
pub(super) fn check_axes(eye: DVec3, target: DVec3, up: DVec3) -> Result<(), Problem> {
    let forward = (target - eye).normalize_or_zero();
    if forward == DVec3::ZERO {
        return Err(Problem::new("camera.target", "is where the eye is: the camera looks nowhere"));
    }
    // Below 1e-9 the image's rotation is rounding noise.
    if forward.cross(up.normalize_or_zero()).length() < 1e-9 {
        return Err(Problem::new("camera.up", "is zero or parallel to the view direction: choose another axis"));
    }
    Ok(())
}

impl TransferChoice {
    /// The function in data units, for a mesh of these ranges.
    pub fn resolve(&self, scalar: Interval, gradient: Interval) -> TransferFunction {
        if self.units == Units::Data {
            return self.function.clone();
        }
        let axes = [Axis::of(scalar), Axis::of(gradient)];
        match &self.function {
            TransferFunction::Widgets(widgets) => {
                TransferFunction::Widgets(widgets.iter().map(|w| widget_in_data(w, axes)).collect())
            }
            TransferFunction::Curve(curve) => TransferFunction::Curve(curve_in_data(curve, axes)),
        }
    }

    /// The draft in data units, as [`Self::resolve`] has the function.
    pub fn resolve_draft(&self, scalar: Interval, gradient: Interval) -> Option<Draft> {
        let draft = self.draft.as_ref()?;
        if self.units == Units::Data {
            return Some(draft.clone());
        }
        let axes = [Axis::of(scalar), Axis::of(gradient)];
        Some(Draft {
            widgets: draft.widgets.iter().map(|(w, is_hidden)| (widget_in_data(w, axes), *is_hidden)).collect(),
            curve: draft.curve.as_ref().map(|curve| curve_in_data(curve, axes)),
        })
    }
}

fn curve_in_data(curve: &Curve, axes: [Axis; 2]) -> Curve {
    Curve { nodes: curve.nodes.iter().map(|node| CurveNode { scalar: axes[0].data(node.scalar), ..*node }).collect() }
}

/// From 0..1 to data units along one axis.
#[derive(Clone, Copy)]
struct Axis {
    origin: f64,
    scale: f64,
}

impl Axis {
    /// A constant field keeps a scale of 1, so that widgets keep a width.
    fn of(range: Interval) -> Self {
        let length = range.length();
        if length > 0.0 && length.is_finite() {
            Self { origin: range.min, scale: length }
        } else {
            Self { origin: if range.min.is_finite() { range.min } else { 0.0 }, scale: 1.0 }
        }
    }

    fn data(self, normalized: f64) -> f64 {
        self.origin + self.scale * normalized
    }
}

fn widget_in_data(widget: &Widget, axes: [Axis; 2]) -> Widget {
    let shape = match &widget.shape {
        WidgetShape::Uniform => WidgetShape::Uniform,
        &WidgetShape::Gaussian { center, sigma, angle } => {
            let (sigma, angle) = stretch_gaussian(sigma, angle, [axes[0].scale, axes[1].scale]);
            WidgetShape::Gaussian { center: [axes[0].data(center[0]), axes[1].data(center[1])], sigma, angle }
        }
        &WidgetShape::Triangle { direction, offset, period, duty } => {
            let (direction, shift) = direction_in_data(direction, axes);
            WidgetShape::Triangle { direction, offset: offset + shift, period, duty }
        }
        &WidgetShape::Sinusoid { direction, offset, period, variant } => {
            let (direction, shift) = direction_in_data(direction, axes);
            WidgetShape::Sinusoid { direction, offset: offset + shift, period, variant }
        }
        WidgetShape::Ramp { direction, knots } => {
            let (direction, knots) = knots_in_data(*direction, knots, axes);
            WidgetShape::Ramp { direction, knots }
        }
    };
    let window = widget.window.as_ref().map(|window| {
        let (direction, knots) = knots_in_data(window.direction, &window.knots, axes);
        Window { direction, knots }
    });
    Widget {
        shape,
        color: widget.color,
        extinction: widget.extinction,
        scalar_range: widget.scalar_range.map(|r| r.map(|v| axes[0].data(v))),
        gradient_range: widget.gradient_range.map(|r| r.map(|v| axes[1].data(v))),
        window,
    }
}

/// Directions change inversely to positions: `direction . normalized = direction' . data - shift`.
fn direction_in_data(direction: [f64; 2], axes: [Axis; 2]) -> ([f64; 2], f64) {
    let direction = [direction[0] / axes[0].scale, direction[1] / axes[1].scale];
    (direction, direction[0] * axes[0].origin + direction[1] * axes[1].origin)
}

fn knots_in_data(direction: [f64; 2], knots: &[[f64; 2]], axes: [Axis; 2]) -> ([f64; 2], Vec<[f64; 2]>) {
    let (direction, shift) = direction_in_data(direction, axes);
    (direction, knots.iter().map(|&[u, weight]| [u + shift, weight]).collect())
}

/// A rotated Gaussian under a stretch of the axes is another one: its standard deviations are the singular values of
/// `diag(scale) R(angle) diag(sigma)`. The larger comes from one Jacobi rotation of the columns, the smaller from the
/// determinant, which keeps its digits where the scales differ by many orders of magnitude.
///
/// Standard deviations and angle (radians) before and after; `scale`: of both axes, positive.
pub fn stretch_gaussian(sigma: [f64; 2], angle: f64, scale: [f64; 2]) -> ([f64; 2], f64) {
    if angle == 0.0 {
        return ([sigma[0] * scale[0], sigma[1] * scale[1]], 0.0);
    }
    let (sin, cos) = angle.sin_cos();
    let a = [scale[0] * cos * sigma[0], scale[1] * sin * sigma[0]];
    let b = [-scale[0] * sin * sigma[1], scale[1] * cos * sigma[1]];
    let dot = a[0] * b[0] + a[1] * b[1];
    let turn = 0.5 * (2.0 * dot).atan2(a[0] * a[0] + a[1] * a[1] - b[0] * b[0] - b[1] * b[1]);
    let (sin, cos) = turn.sin_cos();
    let long = [cos * a[0] + sin * b[0], cos * a[1] + sin * b[1]];
    let length = long[0].hypot(long[1]);
    ([length, scale[0] * sigma[0] * (scale[1] * sigma[1] / length)], long[1].atan2(long[0]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn profile(sigma: [f64; 2], angle: f64, d: [f64; 2]) -> f64 {
        let (sin, cos) = angle.sin_cos();
        let (xi, eta) = (cos * d[0] + sin * d[1], cos * d[1] - sin * d[0]);
        0.5 * ((xi / sigma[0]).powi(2) + (eta / sigma[1]).powi(2))
    }

    #[test]
    fn stretched_gaussians_keep_their_values() {
        for (sigma, angle, scale) in [([0.1, 0.02], 0.7, [3.0, 50.0]), ([0.02, 0.1], -2.0, [100.0, 1.0])] {
            let (data_sigma, data_angle) = stretch_gaussian(sigma, angle, scale);
            for d in [[0.1, 0.0], [0.0, 0.1], [0.05, -0.07]] {
                let want = profile(sigma, angle, d);
                let got = profile(data_sigma, data_angle, [d[0] * scale[0], d[1] * scale[1]]);
                assert!((got - want).abs() <= 1e-11 * want, "{got} {want}");
                let planted = profile(data_sigma, data_angle + 1e-6, [d[0] * scale[0], d[1] * scale[1]]);
                assert!((planted - want).abs() > 1e-11 * want, "a wrong angle must show");
            }
        }
        let (sigma, _) = stretch_gaussian([0.3, 0.2], 1.0, [1e-20, 1e20]);
        assert!((sigma[0] * sigma[1] / 0.06 - 1.0).abs() < 1e-14 && sigma[1] > 0.0, "{sigma:?}");
    }

    #[test]
    fn a_fitted_camera_just_holds_the_sphere() {
        let bounds = Bounds { min: DVec3::new(-1.0, 0.0, 2.0), max: DVec3::new(5.0, 3.0, 4.0) };
        let radius = 0.5 * bounds.diagonal();
        for (text, size) in
            [("", [800.0, 600.0]), ("[camera]\nazimuth = 200\nelevation = 90\nfov_y = 70\n", [300.0, 900.0])]
        {
            let camera = Scene::parse(text, &[]).unwrap().camera.resolve(&bounds, size[0] / size[1]).unwrap();
            let Projection::Perspective { fov_y } = camera.projection else { panic!("perspective is the default") };
            let half = (0.5 * fov_y).tan() * (size[0] / size[1]).min(1.0);
            let reach = (camera.eye - bounds.center()).length() * half.atan().sin();
            assert!((reach / radius - 1.0).abs() < 1e-12, "{reach} {radius}");
            assert!(camera.basis().up.is_finite());
            check_axes(camera.eye, camera.target, camera.up).unwrap();
        }
    }

    #[test]
    fn azimuth_turns_from_x_to_y_and_elevation_rises() {
        let bounds = Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE };
        let toward = |azimuth: f64, elevation: f64| {
            let text = format!("[camera]\nazimuth = {azimuth}\nelevation = {elevation}\n");
            Scene::parse(&text, &[]).unwrap().camera.resolve(&bounds, 1.0).unwrap().eye.normalize()
        };
        assert!(toward(0.0, 0.0).distance(DVec3::X) < 1e-12);
        assert!(toward(90.0, 0.0).distance(DVec3::Y) < 1e-12);
        assert!(toward(12.0, 90.0).distance(DVec3::Z) < 1e-12);
    }

    #[test]
    fn normalized_units_span_the_ranges() {
        let text =
            "[transfer]\nunits = \"normalized\"\n[transfer.curve]\npoints = [[0, 1, 0, 0, 1], [1, 0, 1, 0, 2]]\n";
        let choice = Scene::parse(text, &[]).unwrap().transfer.unwrap();
        let resolved = choice.resolve(Interval { min: -3.0, max: 5.0 }, Interval { min: 0.0, max: 1.0 });
        let TransferFunction::Curve(curve) = resolved else { panic!("a curve stays one") };
        assert_eq!([curve.nodes[0].scalar, curve.nodes[1].scalar], [-3.0, 5.0]);
    }

    #[test]
    fn a_camera_without_a_direction_is_refused() {
        let bounds = Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE };
        let camera = Scene::parse("[camera]\neye = [0, 0, 0]\n", &[]).unwrap().camera;
        assert!(camera.resolve(&bounds, 1.0).unwrap_err().to_string().contains("camera.target"));
        let camera = Scene::parse("[camera]\neye = [0, 0, 5]\n", &[]).unwrap().camera;
        assert!(camera.resolve(&bounds, 1.0).unwrap_err().to_string().contains("camera.up"));
    }
}
