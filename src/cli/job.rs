//! What a `render` command amounts to: its flags laid over the scene file, its output checked.

use super::args::{RenderArgs, SceneArgs};
use super::{legend, output};
use crate::error::{Error, Result};
use crate::image::PngEncoding;
use crate::scene::{Override, Scene};

/// A picture to make, before any mesh is read.
pub(super) struct RenderJob {
    /// Checked.
    pub scene: Scene,
    /// Of a PNG.
    pub encoding: PngEncoding,
}

impl RenderJob {
    /// Finds everything wrong that can be found without the mesh.
    pub fn new(args: &RenderArgs) -> Result<Self> {
        output::check_picture(&args.output)?;
        let scene = Scene::read(args.scene.scene.as_deref(), &overrides(&args.scene))?;
        if args.legend && scene.size[1] < legend::MIN_HEIGHT {
            return Err(Error::Asked(format!(
                "--legend needs a picture at least {} pixels high, not {}",
                legend::MIN_HEIGHT,
                scene.size[1]
            )));
        }
        let encoding = if args.png_linear { PngEncoding::Linear } else { PngEncoding::Srgb };
        Ok(Self { scene, encoding })
    }
}

/// The scene keys that flags set; `--set` comes last and wins.
fn overrides(args: &SceneArgs) -> Vec<Override> {
    let mut list = Vec::new();
    let mut add = |flag: &str, key: &str, value: Option<String>| {
        if let Some(value) = value {
            list.push(Override { key: key.into(), origin: format!("--{flag}"), value });
        }
    };
    // Rust's debug form of a finite number or of a list of them is TOML.
    let vector = |v: Option<[f64; 3]>| v.map(|v| format!("{v:?}"));
    let number = |v: Option<f64>| v.map(|v| if v.is_nan() { "nan".into() } else { format!("{v:?}") });
    let whole = |v: Option<u32>| v.map(|v| v.to_string());
    add("field", "field.scalar", args.field.as_deref().map(|name| toml::Value::from(name).to_string()));
    add("size", "image.width", whole(args.size.map(|s| s[0])));
    add("size", "image.height", whole(args.size.map(|s| s[1])));
    add("width", "image.width", whole(args.width));
    add("height", "image.height", whole(args.height));
    add("background", "image.background", args.background.clone());
    add("eye", "camera.eye", vector(args.eye));
    add("target", "camera.target", vector(args.target));
    add("up", "camera.up", vector(args.up));
    add("fov-y", "camera.fov_y", number(args.fov_y));
    add("ortho-height", "camera.height", number(args.ortho_height));
    add("azimuth", "camera.azimuth", number(args.azimuth));
    add("elevation", "camera.elevation", number(args.elevation));
    add("near", "camera.near", number(args.near));
    // The names on the command line are the scene file's.
    fn name<T: clap::ValueEnum>(choice: Option<T>) -> Option<String> {
        choice?.to_possible_value().map(|value| toml::Value::from(value.get_name()).to_string())
    }
    add("emission", "transfer.emission", name(args.emission));
    add("light", "lighting.direction", vector(args.light));
    add("light-space", "lighting.space", name(args.light_space));
    add("silhouette", "silhouette.exponent", number(args.silhouette));
    add("silhouette-mode", "silhouette.mode", name(args.silhouette_mode));
    add("clip", "clip.min", vector(args.clip.map(|[x, y, z, ..]| [x, y, z])));
    add("clip", "clip.max", vector(args.clip.map(|[.., x, y, z]| [x, y, z])));
    for (key, value) in &args.set {
        list.push(Override { key: key.clone(), value: value.clone(), origin: format!("--set {key}={value}") });
    }
    list
}
