//! Files by name or by the system's dialog, and pictures written beside the window.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use super::background;
use super::engine::How;
use super::watch::{Wake, Watch};
use crate::cli::args::IntegralChoice;
use crate::cli::device::{self, Wish};
use crate::cli::{legend, output};
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::image::PngEncoding;
use crate::oracle::Progress;
use crate::renderer::{Frame, choose_integral};
use crate::scene::{Camera, Scene};
use crate::tet::TetMesh;
use eframe::egui::{self, Key};

/// What a file is wanted for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// A mesh to look at.
    OpenMesh,
    /// A scene to take.
    OpenScene,
    /// The scene that is looked at.
    SaveScene,
    /// A picture, or the frames of a turntable.
    Export,
}

impl Purpose {
    fn title(self) -> &'static str {
        match self {
            Self::OpenMesh => "Open a mesh",
            Self::OpenScene => "Open a scene",
            Self::SaveScene => "Save the scene",
            Self::Export => "Export a picture",
        }
    }

    fn writes(self) -> bool {
        matches!(self, Self::SaveScene | Self::Export)
    }
}

/// A name that is being asked for.
pub struct Dialog {
    /// What for.
    pub purpose: Purpose,
    /// As typed.
    pub name: String,
    /// Of a picture, pixels.
    pub size: [u32; 2],
    /// Of a turntable; 1: one picture.
    pub frames: u32,
    /// The function beside the picture.
    pub has_legend: bool,
    /// It was drawn before.
    is_open: bool,
    browsing: Option<Receiver<Option<PathBuf>>>,
}

/// What was answered.
#[derive(Debug, PartialEq, Eq)]
pub enum Answer {
    /// Go on with this file.
    Done,
    /// Nothing is to be done.
    Cancelled,
}

impl Dialog {
    /// Asks for a file; `name`: what is proposed.
    pub fn new(purpose: Purpose, name: String, size: [u32; 2]) -> Self {
        Self { purpose, name, size, frames: 1, has_legend: false, is_open: false, browsing: None }
    }

    /// Where to.
    pub fn path(&self) -> PathBuf {
        PathBuf::from(self.name.trim())
    }

    /// Draws; an answer closes it.
    pub fn ui(&mut self, ctx: &egui::Context) -> Option<Answer> {
        let mut answer = None;
        if let Some(browsing) = &self.browsing {
            match browsing.try_recv() {
                Ok(picked) => {
                    self.browsing = None;
                    if let Some(path) = picked {
                        self.name = path.display().to_string();
                    }
                }
                Err(TryRecvError::Disconnected) => self.browsing = None,
                Err(TryRecvError::Empty) => {}
            }
        }
        let shown = egui::Modal::new(egui::Id::unique("file")).show(ctx, |ui| {
            ui.set_width(460.0);
            ui.heading(self.purpose.title());
            let field = ui.horizontal(|ui| {
                let edit = egui::TextEdit::singleline(&mut self.name).desired_width(360.0).hint_text("file");
                let field = ui.add(edit).accessible_name("File name");
                if ui.add_enabled(self.browsing.is_none(), egui::Button::new("Browse…")).clicked() {
                    self.browsing = Some(browse(self.purpose, self.path(), ui.ctx().clone()));
                }
                field
            });
            let field = field.inner;
            if !std::mem::replace(&mut self.is_open, true) {
                field.request_focus();
            }
            let is_named = !self.name.trim().is_empty();
            if self.purpose == Purpose::Export {
                ui.horizontal(|ui| {
                    ui.label("Size");
                    ui.add(egui::DragValue::new(&mut self.size[0]).range(1..=16_384)).on_hover_text("width, pixels");
                    ui.label("×");
                    ui.add(egui::DragValue::new(&mut self.size[1]).range(1..=16_384)).on_hover_text("height, pixels");
                    ui.separator();
                    ui.label("Turntable");
                    ui.add(egui::DragValue::new(&mut self.frames).range(1..=3_600).suffix(" frames"));
                    ui.separator();
                    ui.checkbox(&mut self.has_legend, "Legend");
                });
                ui.weak(".png: 8 bit, sRGB; .exr: 32-bit float, linear. Frames are numbered before the ending.");
            }
            if is_named && field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter)) {
                answer = Some(Answer::Done);
            }
            ui.horizontal(|ui| {
                let verb = match self.purpose.writes() {
                    true if self.path().is_file() => "Replace",
                    true => "Write",
                    false => "Open",
                };
                if ui.add_enabled(is_named, egui::Button::new(verb)).clicked() {
                    answer = Some(Answer::Done);
                }
                if ui.button("Cancel").clicked() {
                    answer = Some(Answer::Cancelled);
                }
            });
        });
        if shown.should_close() && answer.is_none() {
            answer = Some(Answer::Cancelled);
        }
        answer
    }
}

/// The system's dialog, which blocks a thread of its own.
fn browse(purpose: Purpose, proposed: PathBuf, ctx: egui::Context) -> Receiver<Option<PathBuf>> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        let mut dialog = rfd::FileDialog::new().set_title(purpose.title());
        if let Some(folder) = proposed.parent().filter(|folder| folder.is_dir()) {
            dialog = dialog.set_directory(folder);
        }
        if let Some(name) = proposed.file_name() {
            dialog = dialog.set_file_name(name.to_string_lossy());
        }
        let picked = if purpose.writes() { dialog.save_file() } else { dialog.pick_file() };
        // The window may have been closed.
        let _ = sender.send(picked);
        ctx.request_repaint();
    });
    receiver
}

/// Pictures that are being written.
pub struct Export {
    result: Receiver<Result<String>>,
    done: Arc<AtomicU32>,
    total: u32,
    is_cancelled: Arc<AtomicBool>,
    /// Of the picture that is being made.
    watch: Watch,
}

/// What is exported.
#[derive(Clone)]
pub struct Task {
    /// Of what.
    pub mesh: Arc<TetMesh>,
    /// A scene file: what is written is what it says.
    pub scene: String,
    /// See [`How`].
    pub how: How,
    /// `.png` or `.exr`.
    pub path: PathBuf,
    /// Of a turntable; 1: one picture.
    pub frames: u32,
    /// The function beside the picture.
    pub has_legend: bool,
    /// The window's device, where pictures are made on it, too.
    pub shared: Option<Gpu>,
}

impl Export {
    /// Begins; `wake` is called now and then, and at the end.
    pub fn start(task: Task, wake: Wake) -> Self {
        let (sender, result) = channel();
        let (done, is_cancelled) = (Arc::<AtomicU32>::default(), Arc::<AtomicBool>::default());
        let (counted, cancelled, total) = (Arc::clone(&done), Arc::clone(&is_cancelled), task.frames);
        let watch = Watch::default();
        let followed = watch.clone();
        std::thread::spawn(move || {
            let step = || {
                counted.fetch_add(1, Ordering::Relaxed);
                wake();
                !cancelled.load(Ordering::Relaxed)
            };
            let progress = followed.progress(Arc::clone(&wake));
            let result = background::pool().and_then(|pool| pool.install(|| write(&task, &progress, &step)));
            // The window may have been closed.
            let _ = sender.send(result);
            wake();
        });
        Self { result, done, total, is_cancelled, watch }
    }

    /// Stops after the picture that is being made, or during it if that can be.
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
        self.watch.give_up();
    }

    /// Pictures written, and all.
    pub fn progress(&self) -> [u32; 2] {
        [self.done.load(Ordering::Relaxed), self.total]
    }

    /// What became of it, once.
    pub fn finished(&self) -> Option<Result<String>> {
        match self.result.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(Error::Device("writing ended without a result".into()))),
        }
    }
}

/// Writes all pictures; `step` counts them, and says whether to go on.
fn write(task: &Task, progress: &Progress, step: &dyn Fn() -> bool) -> Result<String> {
    output::check_picture(&task.path)?;
    let scene = Scene::parse(&task.scene, &[])?;
    if task.has_legend && scene.size[1] < legend::MIN_HEIGHT {
        let least = legend::MIN_HEIGHT;
        return Err(Error::Asked(format!(
            "a legend needs a picture at least {least} pixels high, not {}",
            scene.size[1]
        )));
    }
    let (camera, transfer) = scene.resolve(&*task.mesh)?;
    let first = Frame {
        camera: &camera,
        transfer: &transfer,
        optics: &scene.optics,
        size: scene.size,
        background: scene.premultiplied_background(),
    };
    let part = match &scene.clip {
        Some(bounds) => Arc::new(task.mesh.clipped_to(bounds)?),
        None => Arc::clone(&task.mesh),
    };
    let settings = task.how.choices.settings();
    let wish = Wish { device: task.how.device, settings, frame: &first, shared: task.shared.as_ref() };
    let mut chosen = device::renderer(&part, &wish, progress)?;
    if task.how.choices.integral == IntegralChoice::Auto && !chosen.is_reference {
        choose_integral(&mut *chosen.renderer, &first, task.how.choices.tolerance)?;
    }
    for number in 0..task.frames {
        let camera = turned(&camera, f64::from(number) / f64::from(task.frames));
        let image = chosen.renderer.render(&Frame { camera: &camera, ..first }, false)?.image;
        let image = if task.has_legend { legend::beside(&image, &*task.mesh, &transfer)? } else { image };
        let path = if task.frames == 1 { task.path.clone() } else { numbered(&task.path, number) };
        output::whole(|| image.write(&path, PngEncoding::Srgb))?;
        if !step() && number + 1 < task.frames {
            return Err(Error::Asked(format!("cancelled after {} of {} pictures", number + 1, task.frames)));
        }
    }
    Ok(match task.frames {
        1 => format!("wrote {}", task.path.display()),
        n => format!("wrote {n} pictures, {} and on", numbered(&task.path, 0).display()),
    })
}

/// Around what is looked at, by a share of a whole turn.
fn turned(camera: &Camera, share: f64) -> Camera {
    let turn = glam::DQuat::from_axis_angle(camera.basis().up, share * std::f64::consts::TAU);
    let up = camera.basis().up;
    Camera { eye: camera.target + turn * (camera.eye - camera.target), up, ..*camera }
}

/// `name-0007.png`.
fn numbered(path: &Path, number: u32) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-{number:04}.{extension}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_numbered_before_the_ending() {
        assert_eq!(numbered(Path::new("a/turn.v2.png"), 7), Path::new("a/turn.v2-0007.png"));
    }
}
