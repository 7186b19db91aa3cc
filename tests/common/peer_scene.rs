//! Scene files of the renderers that tetralux is measured against: camera and 1D function, JSON.

use std::path::{Path, PathBuf};

use glam::DVec3;
use serde::Deserialize;
use tetralux::scene::{Camera, Curve, CurveNode, Projection, TransferFunction};

/// As in the file; `conventions` there says what the numbers mean.
#[derive(Debug, Deserialize)]
pub struct PeerScene {
    pub name: String,
    /// Relative to the folder that holds `scenes/`.
    pub mesh: PathBuf,
    /// The field's name.
    pub array: String,
    /// Width and height.
    pub image: [u32; 2],
    views: Vec<View>,
    tf: Function,
}

#[derive(Debug, Deserialize)]
struct View {
    eye: [f64; 3],
    focal: [f64; 3],
    up: [f64; 3],
    vfov_deg: f64,
}

#[derive(Debug, Deserialize)]
struct Function {
    /// Scalar, red, green, blue, extinction (1 / data length).
    points: Vec<[f64; 5]>,
}

impl PeerScene {
    /// Reads `scenes/NAME.json` of `folder`.
    pub fn read(folder: &Path, name: &str) -> Self {
        let path = folder.join("scenes").join(name).with_extension("json");
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{e}: {}", path.display()));
        serde_json::from_str(&text).unwrap_or_else(|e| panic!("{e}: {}", path.display()))
    }

    /// One of the eight cameras; `near` and `far` of the file served depth buffers, not the picture.
    pub fn camera(&self, view: usize) -> Camera {
        let View { eye, focal, up, vfov_deg } = self.views[view];
        Camera {
            eye: DVec3::from_array(eye),
            target: DVec3::from_array(focal),
            up: DVec3::from_array(up),
            projection: Projection::Perspective { fov_y: vfov_deg.to_radians() },
            near: None,
        }
    }

    /// The function: colour and extinction linear between the points.
    pub fn transfer(&self) -> TransferFunction {
        let node = |&[scalar, r, g, b, extinction]: &[f64; 5]| CurveNode { scalar, color: [r, g, b], extinction };
        TransferFunction::Curve(Curve { nodes: self.tf.points.iter().map(node).collect() })
    }
}
