//! The window: what is open, what is being done beside it, and where its parts are.

mod documents;
mod keys;
mod menus;
mod status;
#[cfg(all(test, feature = "viewer-test"))]
mod tests;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use eframe::egui::{self, Context, Panel, Ui};

use crate::cli::args::{IntegralChoice, name_of};
use crate::error::Result;
use crate::gpu::Gpu;
use crate::image::{Comparison, Image};
use crate::renderer::SegmentIntegral;
use crate::scene::{self, Camera, Projection, Scene, Widget, WidgetShape};
use crate::tet::Domain as _;
use crate::viewer::canvas::Canvas;
use crate::viewer::curve::CurveEditor;
use crate::viewer::editor::{Editor, Tool};
use crate::viewer::engine::{Engine, How, Shown, Side, Wanted};
use crate::viewer::files::{Answer, Dialog, Export};
use crate::viewer::history::History;
use crate::viewer::look::{Kind, Look};
use crate::viewer::opened::{Loading, Opened};
use crate::viewer::panels;
use crate::viewer::path;
use crate::viewer::screen::{self, Backdrop};

/// Full vertical angle of a new camera, radians.
const FOV_Y: f64 = std::f64::consts::FRAC_PI_6;

/// What is compared with what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compare {
    /// Nothing.
    #[default]
    Off,
    /// The function of the scalar alone with the one of both.
    Kinds,
    /// Two ways to make the picture.
    Methods,
}

/// What the window begins with.
#[derive(Debug, Clone)]
pub struct Start {
    /// A mesh.
    pub mesh: Option<PathBuf>,
    /// Its field; the first where none is named.
    pub field: Option<String>,
    /// A scene to take.
    pub scene: Option<PathBuf>,
    /// How pictures are made.
    pub how: How,
}

/// The mesh and what is done with it.
struct Sitting {
    opened: Opened,
    look: Look,
    history: History<Look>,
    camera: Camera,
    /// The scene's file, once there is one.
    file: Option<PathBuf>,
}

/// The window's state.
pub struct App {
    sitting: Option<Sitting>,
    editor: Editor,
    curve: CurveEditor,
    canvas: Canvas,
    engine: Engine,
    how: [How; 2],
    compare: Compare,
    backdrop: Backdrop,
    pictures: Vec<Image>,
    shown: Option<Shown>,
    /// What is shown is the last that was wanted.
    is_answered: bool,
    compared: Option<Comparison>,
    /// Values along the ray under the pointer.
    path: Vec<[f64; 2]>,
    path_of: Option<([f64; 2], Camera)>,
    following: Option<Receiver<Vec<[f64; 2]>>>,
    loading: Option<Loading>,
    /// What is taken once a mesh is there.
    scene_file: Option<PathBuf>,
    export: Option<Export>,
    dialog: Option<Dialog>,
    messages: Vec<String>,
    has_help: bool,
    shared: Option<Gpu>,
}

impl App {
    /// Begins; `shared`: the window's device, where pictures are made on it, too.
    ///
    /// # Errors
    /// No threads can be made.
    pub fn new(ctx: &Context, start: Start, shared: Option<Gpu>) -> Result<Self> {
        let again = ctx.clone();
        let engine = Engine::new(shared.clone(), move || again.request_repaint())?;
        let mut app = Self {
            sitting: None,
            editor: Editor::default(),
            curve: CurveEditor::default(),
            canvas: Canvas::default(),
            engine,
            how: [start.how; 2],
            compare: Compare::Off,
            backdrop: Backdrop::Plain,
            pictures: Vec::new(),
            shown: None,
            is_answered: false,
            compared: None,
            path: Vec::new(),
            path_of: None,
            following: None,
            loading: None,
            scene_file: start.scene,
            export: None,
            dialog: None,
            messages: Vec::new(),
            has_help: false,
            shared,
        };
        // Something to compare with.
        app.how[1].integral = IntegralChoice::Fixed(SegmentIntegral::VertexLinear);
        if let Some(mesh) = start.mesh {
            app.open(ctx, mesh, start.field);
        }
        Ok(app)
    }

    /// Whether nothing is being done beside the window.
    pub fn is_idle(&self) -> bool {
        self.loading.is_none() && self.export.is_none() && (self.sitting.is_none() || self.is_answered)
    }

    /// What is edited.
    pub fn look(&self) -> Option<&Look> {
        self.sitting.as_ref().map(|sitting| &sitting.look)
    }

    /// What was said to the user and not yet put away.
    pub fn messages(&self) -> &[String] {
        &self.messages
    }

    fn open(&mut self, ctx: &Context, mesh: PathBuf, field: Option<String>) {
        let again = ctx.clone();
        self.loading = Some(Loading::start(mesh, field, move || again.request_repaint()));
    }

    /// Once, however often it is so.
    fn say(&mut self, text: impl Into<String>) {
        let text = text.into();
        if self.messages.last() != Some(&text) {
            self.messages.push(text);
        }
    }

    /// What has come to an end beside the window.
    fn poll(&mut self, ctx: &Context) {
        if let Some(result) = self.loading.as_ref().and_then(Loading::finished) {
            self.loading = None;
            match result {
                Ok(opened) => self.sit_down(opened),
                Err(error) => self.say(error.to_string()),
            }
        }
        let results: Vec<_> = self.engine.results().collect();
        for (is_of_last, result) in results {
            match result {
                Ok(shown) => {
                    self.is_answered = is_of_last && shown.is_last;
                    self.show(ctx, shown);
                }
                // What there was stays; nothing better comes until something changes.
                Err(error) => {
                    self.is_answered = is_of_last;
                    self.say(error.to_string());
                }
            }
        }
        if let Some(result) = self.export.as_ref().and_then(Export::finished) {
            self.export = None;
            self.say(result.unwrap_or_else(|error| error.to_string()));
        }
        let dropped = ctx.input(|i| i.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped {
            match path.extension().and_then(|e| e.to_str()) {
                Some("toml") => self.take_scene(&path),
                _ => self.open(ctx, path, None),
            }
        }
    }

    /// Looks at another mesh; another field of the same file is seen from where the last one was.
    fn sit_down(&mut self, opened: Opened) {
        for note in &opened.notes {
            self.messages.push(note.clone());
        }
        let same = |sitting: &Sitting| sitting.opened.path == opened.path;
        let camera = match self.sitting.as_ref().filter(|sitting| same(sitting)) {
            Some(sitting) => sitting.camera,
            None => fitted(&opened),
        };
        let look = Look::of(&opened.mesh, &opened.histogram);
        let history = History::new(look.clone());
        self.sitting = Some(Sitting { opened, look, history, camera, file: None });
        self.editor.reset();
        self.canvas.clear();
        (self.shown, self.is_answered) = (None, false);
        if let Some(scene) = self.scene_file.take() {
            self.take_scene(&scene);
        }
    }

    fn take_scene(&mut self, path: &Path) {
        let Some(sitting) = &mut self.sitting else {
            self.scene_file = Some(path.to_owned());
            self.say("the scene is taken once a mesh is open");
            return;
        };
        let mesh = &sitting.opened.mesh;
        let taken = Scene::read(Some(path), &[]).and_then(|scene| Ok((scene.resolve(&**mesh)?.0, scene)));
        match taken {
            Ok((camera, scene)) => {
                sitting.look.take(&scene, mesh.scalar_range(), mesh.gradient_range());
                (sitting.camera, sitting.file) = (camera, Some(path.to_owned()));
                self.editor.selected = None;
                let field = mesh.field();
                if let Some(named) = scene.field.filter(|named| named != field) {
                    let text = format!("the scene is of the field {named}, and {field} is looked at");
                    self.messages.push(text);
                }
            }
            Err(error) => self.say(error.to_string()),
        }
    }

    fn show(&mut self, ctx: &Context, mut shown: Shown) {
        self.pictures = std::mem::take(&mut shown.images);
        self.shown = Some(shown);
        self.compared = match &self.pictures[..] {
            [a, b] => Comparison::new(a, b).ok(),
            _ => None,
        };
        self.redraw(ctx);
    }

    /// The last pictures again, before another backdrop.
    fn redraw(&mut self, ctx: &Context) {
        let Some(sitting) = &self.sitting else { return };
        let [r, g, b, a] = sitting.look.background;
        let plain = [r * a, g * a, b * a, a].map(|v| v as f32);
        let mut screens: Vec<_> =
            self.pictures.iter().map(|image| screen::screen(image, self.backdrop, plain)).collect();
        if let [a, b] = &self.pictures[..] {
            screens.push(screen::difference(a, b, DIFFERENCE_TIMES));
        }
        self.canvas.show(ctx, screens);
    }

    /// Asks for what is to be seen.
    fn want(&mut self) {
        let Some(sitting) = &self.sitting else { return };
        let side = |kind: Kind, how: How| Side { transfer: sitting.look.transfer(kind), how };
        let mut sides = match self.compare {
            Compare::Off => vec![side(sitting.look.kind, self.how[0])],
            Compare::Kinds => vec![side(Kind::Univariate, self.how[0]), side(Kind::Bivariate, self.how[0])],
            Compare::Methods => self.how.map(|how| side(sitting.look.kind, how)).into(),
        };
        if let (Some([s, g]), Some(side)) = (self.editor.brush, sides.first_mut()) {
            side.transfer = brushed(&side.transfer, [s, g], sitting.opened.mesh.bounds_in_data().diagonal());
        }
        let wanted = Wanted {
            mesh: Arc::clone(&sitting.opened.mesh),
            sides,
            camera: sitting.camera,
            optics: sitting.look.optics,
            size: self.canvas.size,
            background: [0.0; 4],
            is_moving: self.canvas.is_moving || self.editor.is_busy() || self.curve.is_busy(),
        };
        self.is_answered &= !self.engine.want(wanted);
    }

    fn undo(&mut self, by: fn(&mut History<Look>) -> Option<&Look>) {
        let Some(sitting) = &mut self.sitting else { return };
        if let Some(look) = by(&mut sitting.history) {
            sitting.look = look.clone();
            let count = look.items.len();
            self.editor.selected = self.editor.selected.filter(|&index| index < count);
        }
    }

    fn side_panel(&mut self, ui: &mut Ui) {
        let Some(sitting) = &mut self.sitting else {
            ui.add_space(12.0);
            ui.label("Drop a mesh here, or open one with Ctrl+O.");
            return;
        };
        ui.horizontal(|ui| {
            ui.selectable_value(&mut sitting.look.kind, Kind::Bivariate, "2D: scalar × gradient");
            ui.selectable_value(&mut sitting.look.kind, Kind::Univariate, "1D: scalar");
        });
        match sitting.look.kind {
            Kind::Bivariate => {
                ui.horizontal_wrapped(|ui| {
                    for (tool, name, help) in Tool::ALL {
                        ui.selectable_value(&mut self.editor.tool, tool, name).on_hover_text(help);
                    }
                });
                let height = (0.38 * ui.available_height()).clamp(190.0, 420.0);
                self.editor.ui(ui, &sitting.opened, &mut sitting.look, &self.path, height);
            }
            Kind::Univariate => {
                let height = (0.38 * ui.available_height()).clamp(190.0, 420.0);
                self.curve.ui(ui, &sitting.opened, &mut sitting.look.curve, height);
            }
        }
        let before = (self.backdrop, sitting.look.background);
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            match sitting.look.kind {
                Kind::Bivariate => panels::widgets(ui, &mut self.editor, &mut sitting.look, &sitting.opened),
                Kind::Univariate => panels::curve(ui, &self.curve, &mut sitting.look, &sitting.opened),
            }
            ui.separator();
            panels::optics(ui, &mut sitting.look, &mut self.backdrop);
            ui.separator();
            ui.collapsing("How pictures are made", |ui| {
                let is_pair = self.compare == Compare::Methods;
                if is_pair {
                    ui.label("Left");
                }
                panels::how(ui, &mut self.how[0], "left");
                if is_pair {
                    ui.label("Right");
                    panels::how(ui, &mut self.how[1], "right");
                }
            });
        });
        if before != (self.backdrop, sitting.look.background) {
            self.redraw(ui.ctx());
        }
    }

    fn names(&self) -> Option<[String; 2]> {
        let method = |how: How| format!("{}, {}, {}", name_of(how.device), name_of(how.method), how.integral);
        match self.compare {
            Compare::Off => None,
            Compare::Kinds => Some(["1D".into(), "2D".into()]),
            Compare::Methods => Some(self.how.map(method)),
        }
    }

    /// Marks the ray of a pixel on the histogram, once the pointer rests.
    fn follow(&mut self, ctx: &Context) {
        if let Some(path) = self.following.as_ref().and_then(|path| path.try_recv().ok()) {
            (self.path, self.following) = (path, None);
        }
        let Some(sitting) = &self.sitting else { return };
        let now = self.canvas.hovered.map(|pixel| (pixel, sitting.camera));
        if now == self.path_of {
            return;
        }
        let is_resting = ctx.input(|i| i.pointer.time_since_last_movement() >= REST.as_secs_f32());
        if now.is_some() && !is_resting {
            ctx.request_repaint_after(REST);
            return;
        }
        (self.path_of, self.following) = (now, None);
        self.path.clear();
        let Some((pixel, camera)) = now else { return };
        let (mesh, size) = (Arc::clone(&sitting.opened.mesh), self.canvas.size);
        let (sender, receiver) = channel();
        let again = ctx.clone();
        std::thread::spawn(move || {
            // The pointer may have gone on.
            let _ = sender.send(path::along(&mesh, &camera, size, pixel));
            again.request_repaint();
        });
        self.following = Some(receiver);
    }
}

/// The pointer rests when it has not moved for so long.
const REST: Duration = Duration::from_millis(120);

/// Differences are shown so many times as bright.
const DIFFERENCE_TIMES: f32 = 16.0;

impl eframe::App for App {
    fn logic(&mut self, ctx: &Context, _: &mut eframe::Frame) {
        self.poll(ctx);
    }

    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        self.keys(&ctx);
        Panel::top("menus").show(ui, |ui| self.menus(ui));
        Panel::bottom("status").show(ui, |ui| self.status(ui));
        Panel::right("function").resizable(true).default_size(430.0).size_range(320.0..=900.0).show(ui, |ui| {
            self.side_panel(ui);
        });
        egui::CentralPanel::no_frame().show(ui, |ui| {
            let names = self.names();
            if let Some(sitting) = &mut self.sitting {
                let bounds = sitting.opened.mesh.bounds_in_data();
                self.canvas.ui(ui, &mut sitting.camera, &bounds, names);
            }
        });
        if !self.messages.is_empty() {
            // Over the picture, whose size stays.
            let area = egui::Area::new(egui::Id::unique("messages")).anchor(egui::Align2::LEFT_BOTTOM, [84.0, -34.0]);
            area.show(&ctx, |ui| egui::Frame::popup(ui.style()).show(ui, |ui| self.said(ui)));
        }
        if let Some(mut dialog) = self.dialog.take() {
            match dialog.ui(&ctx) {
                Some(Answer::Done) => self.answered(&ctx, &dialog),
                Some(Answer::Cancelled) => {}
                None => self.dialog = Some(dialog),
            }
        }
        if self.has_help {
            keys::help(&ctx, &mut self.has_help);
        }
        self.follow(&ctx);
        let is_settled = !ctx.input(|i| i.pointer.any_down()) && !self.editor.is_busy();
        if let Some(sitting) = &mut self.sitting {
            sitting.history.observe(&sitting.look, is_settled);
        }
        self.want();
        if self.canvas.is_moving {
            // When it moves no more, the picture is made in full.
            ctx.request_repaint();
        }
    }
}

/// A camera that sees all of a mesh.
fn fitted(opened: &Opened) -> Camera {
    let bounds = opened.mesh.bounds_in_data();
    let projection = Projection::Perspective { fov_y: FOV_Y };
    Camera::fit(&bounds, 1.0, [30f64.to_radians(), 20f64.to_radians()], 1.0, projection)
}

/// A function and, in white, what lies in a box of its values.
fn brushed(transfer: &scene::TransferFunction, [s, g]: [[f64; 2]; 2], diagonal: f64) -> scene::TransferFunction {
    let mark = Widget {
        scalar_range: Some(s),
        gradient_range: Some(g),
        ..Widget::new(WidgetShape::Uniform, [1.0; 3], 200.0 / diagonal)
    };
    match transfer {
        scene::TransferFunction::Widgets(widgets) if widgets.len() < scene::MAX_WIDGETS => {
            scene::TransferFunction::Widgets(widgets.iter().cloned().chain([mark]).collect())
        }
        _ => scene::TransferFunction::Widgets(vec![mark]),
    }
}
