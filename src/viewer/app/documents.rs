//! Files that are asked for, and what is written.

use std::path::Path;
use std::sync::Arc;

use eframe::egui::Context;

use super::App;
use crate::cli::args::{ChoiceArgs, Device, IntegralChoice, Method, Order, name_of};
use crate::cli::output;
use crate::tet::Domain as _;
use crate::viewer::files::{Dialog, Export, Purpose, Task};

impl App {
    pub(super) fn ask(&mut self, purpose: Purpose) {
        let beside = |name: &str| match &self.sitting {
            Some(sitting) => {
                let folder = std::env::current_dir().unwrap_or_default();
                let stem = sitting.opened.path.file_stem().unwrap_or_default().to_string_lossy();
                folder.join(format!("{stem}{name}")).display().to_string()
            }
            None => String::new(),
        };
        let name = match purpose {
            Purpose::OpenMesh | Purpose::OpenScene => String::new(),
            Purpose::SaveScene => match self.sitting.as_ref().and_then(|sitting| sitting.file.clone()) {
                Some(file) => file.display().to_string(),
                None => beside(".toml"),
            },
            Purpose::Export => beside(".png"),
        };
        if self.sitting.is_none() && purpose != Purpose::OpenMesh {
            self.say("open a mesh first");
            return;
        }
        let mut dialog = Dialog::new(purpose, name, self.canvas.size);
        dialog.has_legend = self.has_legend;
        self.dialog = Some(dialog);
    }

    pub(super) fn answered(&mut self, ctx: &Context, dialog: &Dialog) {
        let path = dialog.path();
        match (dialog.purpose, &mut self.sitting) {
            (Purpose::OpenMesh, _) => self.open(ctx, path, None),
            (Purpose::OpenScene, _) => self.take_scene(ctx, &path),
            (Purpose::SaveScene, Some(sitting)) => {
                let field = sitting.opened.mesh.field().to_owned();
                let text = sitting.look.scene(&sitting.camera, self.canvas.size, &field, &sitting.first).to_toml();
                let saved = output::check_file(&path, &["toml"]).and_then(|()| output::write_whole(&path, &text));
                if saved.is_ok() {
                    sitting.file = Some(path.clone());
                }
                let said = saved.map_or_else(|error| error.to_string(), |()| format!("saved {}", path.display()));
                self.say(said);
            }
            (Purpose::Export, Some(_)) if self.export.is_some() => self.say("a picture is being written already"),
            (Purpose::Export, Some(sitting)) => {
                let field = sitting.opened.mesh.field().to_owned();
                let task = Task {
                    mesh: Arc::clone(&sitting.opened.mesh),
                    scene: sitting.look.scene(&sitting.camera, dialog.size, &field, &sitting.first).to_toml(),
                    how: self.how[0],
                    path,
                    frames: dialog.frames,
                    has_legend: dialog.has_legend,
                    shared: self.shared.clone(),
                };
                let again = ctx.clone();
                self.export = Some(Export::start(task, Arc::new(move || again.request_repaint())));
            }
            (_, None) => self.say("open a mesh first"),
        }
    }

    /// The command line that makes the same picture.
    pub(super) fn command(&self) -> Option<String> {
        let sitting = self.sitting.as_ref()?;
        let scene = sitting.file.clone().unwrap_or_else(|| "scene.toml".into());
        let how = self.how[0];
        let mut text =
            format!("tetralux render {} --scene {} -o picture.png", quoted(&sitting.opened.path), quoted(&scene));
        let (choices, default) = (how.choices, ChoiceArgs::of(Method::Auto, Order::Auto, IntegralChoice::default()));
        let flags = [
            ("device", name_of(how.device), name_of(Device::Auto)),
            ("method", name_of(choices.method), name_of(default.method)),
            ("order", name_of(choices.order), name_of(default.order)),
            ("integral", choices.integral.to_string(), default.integral.to_string()),
            ("tolerance", choices.tolerance.to_string(), default.tolerance.to_string()),
            ("sort", name_of(choices.sort), name_of(default.sort)),
            ("blend", name_of(choices.blend), name_of(default.blend)),
            ("layout", name_of(choices.layout), name_of(default.layout)),
            ("least-transmittance", choices.least_transmittance.to_string(), default.least_transmittance.to_string()),
        ];
        for (flag, value, _) in flags.into_iter().filter(|(_, value, default)| value != default) {
            text.push_str(&format!(" --{flag} {value}"));
        }
        if choices.no_cull {
            text.push_str(" --no-cull");
        }
        if self.has_legend {
            text.push_str(" --legend");
        }
        Some(text)
    }
}

/// For a shell.
fn quoted(path: &Path) -> String {
    let text = path.display().to_string();
    let is_plain = !text.is_empty() && text.chars().all(|c| c.is_ascii_alphanumeric() || "/._-+=:@%,".contains(c));
    if is_plain { text } else { format!("'{}'", text.replace('\'', r"'\''")) }
}
