//! Files that are asked for, and what is written.

use std::path::Path;
use std::sync::Arc;

use eframe::egui::Context;

use super::App;
use crate::cli::args::{Device, IntegralChoice, Method, Order, name_of};
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
        self.dialog = Some(Dialog::new(purpose, name, self.canvas.size));
    }

    pub(super) fn answered(&mut self, ctx: &Context, dialog: &Dialog) {
        let path = dialog.path();
        match (dialog.purpose, &mut self.sitting) {
            (Purpose::OpenMesh, _) => self.open(ctx, path, None),
            (Purpose::OpenScene, _) => self.take_scene(&path),
            (Purpose::SaveScene, Some(sitting)) => {
                let field = sitting.opened.mesh.field().to_owned();
                let text = sitting.look.scene(&sitting.camera, self.canvas.size, &field).to_toml();
                let saved = output::check_file(&path, &["toml"]).and_then(|()| output::write_whole(&path, &text));
                if saved.is_ok() {
                    sitting.file = Some(path.clone());
                }
                let said = saved.map_or_else(|error| error.to_string(), |()| format!("saved {}", path.display()));
                self.say(said);
            }
            (Purpose::Export, Some(sitting)) => {
                let field = sitting.opened.mesh.field().to_owned();
                let task = Task {
                    mesh: Arc::clone(&sitting.opened.mesh),
                    scene: sitting.look.scene(&sitting.camera, dialog.size, &field).to_toml(),
                    how: self.how[0],
                    path,
                    frames: dialog.frames,
                    shared: self.shared.clone(),
                };
                let again = ctx.clone();
                self.export = Some(Export::start(task, move || again.request_repaint()));
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
        let flags = [
            ("device", name_of(how.device), name_of(Device::Auto)),
            ("method", name_of(how.method), name_of(Method::Auto)),
            ("order", name_of(how.order), name_of(Order::Auto)),
            ("integral", how.integral.to_string(), IntegralChoice::default().to_string()),
            ("tolerance", how.tolerance.to_string(), crate::renderer::TOLERANCE.to_string()),
        ];
        for (flag, value, _) in flags.into_iter().filter(|(_, value, default)| value != default) {
            text.push_str(&format!(" --{flag} {value}"));
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
