//! The window: what is open, what is being done beside it, and where its parts are.

mod documents;
mod keys;
mod menus;
mod pictures;
mod status;
#[cfg(all(test, feature = "viewer-test"))]
mod tests;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::time::Instant;

use eframe::egui::{self, Color32, Context, Event, Panel, Ui, UiBuilder, UiKind, UiStackInfo};

use crate::cli::args::{IntegralChoice, name_of};
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::image::{Comparison, Image};
use crate::renderer::SegmentIntegral;
use crate::scene::{Camera, Projection, Scene, TransferFunction};
use crate::tet::Domain as _;
use crate::viewer::background::Steward;
use crate::viewer::canvas::{Canvas, Scenery};
use crate::viewer::clipping::Clipper;
use crate::viewer::clock::Clock;
use crate::viewer::curve::CurveEditor;
use crate::viewer::editor::{Editor, Tool};
use crate::viewer::engine::{Engine, How, Shown};
use crate::viewer::files::{Answer, Dialog, Export};
use crate::viewer::history::History;
use crate::viewer::look::{Kind, Look};
use crate::viewer::opened::{Loading, Opened};
use crate::viewer::panels;
use crate::viewer::refine::{Refined, Refining};
use crate::viewer::screen::Backdrop;

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
    /// What the window began with.
    first: Look,
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
    /// What the pictures were last drawn before.
    drawn_before: (Backdrop, [f32; 4]),
    /// Makes pictures of the screen: the common threads may be busy for long.
    threads: rayon::ThreadPool,
    /// Hears of whoever uses the window.
    steward: Steward,
    pictures: Vec<Image>,
    shown: Option<Shown>,
    /// What is shown is the last that was wanted.
    is_answered: bool,
    /// It is not to be made any more.
    is_given_up: bool,
    compared: Option<Comparison>,
    /// Values along the ray under the pointer.
    path: Vec<[f64; 2]>,
    path_of: Option<([f64; 2], Camera)>,
    following: Option<Receiver<Vec<[f64; 2]>>>,
    clipper: Clipper,
    /// What is drawn is what the clipping box leaves.
    is_cut: bool,
    /// The reference's part of the picture that is being made.
    refining: Option<Refining>,
    /// How the picture compared with it.
    refined: Option<Refined>,
    /// The function's axes and colours are shown beside the picture.
    has_legend: bool,
    /// Of what.
    legend_of: Option<TransferFunction>,
    clock: Clock,
    title: String,
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
    pub fn new(context: &eframe::CreationContext<'_>, start: Start, shared: Option<Gpu>) -> Result<Self> {
        let ctx = &context.egui_ctx;
        let again = ctx.clone();
        let engine = Engine::new(shared.clone(), Arc::new(move || again.request_repaint()))?;
        let threads = rayon::ThreadPoolBuilder::new().build();
        let threads = threads.map_err(|e| Error::Device(format!("no threads can be made to draw on: {e}")))?;
        let mut app = Self {
            sitting: None,
            editor: Editor::default(),
            curve: CurveEditor::default(),
            canvas: Canvas::new(context.wgpu_render_state.as_ref()),
            engine,
            how: [start.how; 2],
            compare: Compare::Off,
            backdrop: Backdrop::Plain,
            drawn_before: (Backdrop::Plain, [0.0; 4]),
            threads,
            steward: Steward::new()?,
            pictures: Vec::new(),
            shown: None,
            is_answered: false,
            is_given_up: false,
            compared: None,
            path: Vec::new(),
            path_of: None,
            following: None,
            clipper: Clipper::default(),
            is_cut: true,
            refining: None,
            refined: None,
            has_legend: false,
            legend_of: None,
            clock: Clock::default(),
            title: String::new(),
            loading: None,
            scene_file: start.scene,
            export: None,
            dialog: None,
            messages: Vec::new(),
            has_help: false,
            shared,
        };
        // Something to compare with.
        app.how[1].choices.integral = IntegralChoice::Fixed(SegmentIntegral::VertexLinear);
        if let Some(mesh) = start.mesh {
            // The scene's own, where nothing else is said; what is wrong with the scene is said when it is taken.
            let scene = app.scene_file.as_deref().and_then(|path| Scene::read(Some(path), &[]).ok());
            let field = start.field.or(scene.and_then(|scene| scene.field));
            app.open(ctx, mesh, field);
        }
        Ok(app)
    }

    /// Whether nothing is being done beside the window.
    pub fn is_idle(&self) -> bool {
        let is_busy = self.loading.is_some() || self.export.is_some() || self.refining.is_some();
        // The plot of the other kind is not drawn.
        let is_looking = self.look().is_some_and(|look| look.kind == Kind::Bivariate) && self.editor.is_looking();
        !is_busy && !is_looking && (self.sitting.is_none() || (self.is_answered && self.is_cut))
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
                Ok(opened) => self.sit_down(ctx, opened),
                Err(error) => self.say(error.to_string()),
            }
        }
        for (is_of_last, result) in self.engine.results() {
            match result {
                Ok(shown) => {
                    self.is_given_up &= !(is_of_last && shown.is_last);
                    self.is_answered = is_of_last && (shown.is_last || self.is_given_up);
                    self.show(ctx, shown);
                }
                // What there was stays; nothing better comes until something changes.
                Err(error) => {
                    self.is_answered = is_of_last;
                    self.say(error.to_string());
                }
            }
        }
        self.poll_refining(ctx);
        if let Some(result) = self.export.as_ref().and_then(Export::finished) {
            self.export = None;
            self.say(result.unwrap_or_else(|error| error.to_string()));
        }
        let dropped = ctx.input(|i| i.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped {
            match path.extension().and_then(|e| e.to_str()) {
                Some("toml") => self.take_scene(ctx, &path),
                _ => self.open(ctx, path, None),
            }
        }
    }

    /// Looks at another mesh; another field of the same file is seen from where the last one was.
    fn sit_down(&mut self, ctx: &Context, opened: Opened) {
        for note in &opened.notes {
            self.messages.push(note.clone());
        }
        let same = |sitting: &Sitting| sitting.opened.path == opened.path;
        let mut look = Look::of(&opened.mesh, &opened.histogram);
        let camera = match self.sitting.as_ref().filter(|sitting| same(sitting)) {
            // What does not depend on the field stays.
            Some(sitting) => {
                let last = &sitting.look;
                (look.optics, look.background, look.clip, look.kind) =
                    (last.optics, last.background, last.clip, last.kind);
                sitting.camera
            }
            None => fitted(&opened),
        };
        let (first, history) = (look.clone(), History::new(look.clone()));
        self.sitting = Some(Sitting { opened, look, first, history, camera, file: None });
        self.editor.reset();
        self.canvas.clear();
        (self.shown, self.is_answered, self.legend_of) = (None, false, None);
        (self.refining, self.refined) = (None, None);
        (self.path_of, self.following) = (None, None);
        self.path.clear();
        if let Some(scene) = self.scene_file.take() {
            self.take_scene(ctx, &scene);
        }
    }

    fn take_scene(&mut self, ctx: &Context, path: &Path) {
        let Some(sitting) = &mut self.sitting else {
            self.scene_file = Some(path.to_owned());
            self.say("the scene is taken once a mesh is open");
            return;
        };
        let mesh = &sitting.opened.mesh;
        let taken = Scene::read(Some(path), &[]).and_then(|scene| Ok((scene.resolve(&**mesh)?.0, scene)));
        match taken {
            Ok((_, scene))
                if scene
                    .field
                    .as_ref()
                    .is_some_and(|named| named != mesh.field() && sitting.opened.fields.contains(named)) =>
            {
                // Another field first, and then the scene.
                self.scene_file = Some(path.to_owned());
                let mesh = sitting.opened.path.clone();
                self.open(ctx, mesh, scene.field);
            }
            Ok((camera, scene)) => {
                sitting.look.take(&scene, sitting.opened.histogram.scalar, sitting.opened.histogram.gradient);
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
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            match sitting.look.kind {
                Kind::Bivariate => panels::widgets(ui, &mut self.editor, &mut sitting.look, &sitting.opened),
                Kind::Univariate => panels::curve(ui, &self.curve, &mut sitting.look, &sitting.opened),
            }
            ui.separator();
            panels::optics(ui, &mut sitting.look, &mut self.backdrop);
            panels::clipping(ui, &mut sitting.look, &sitting.opened.bounds);
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
    }

    /// The window's title names what is open.
    fn name_window(&mut self, ctx: &Context) {
        let title = match &self.sitting {
            Some(Sitting { opened, .. }) => {
                let file = opened.path.file_name().unwrap_or_default().to_string_lossy();
                format!("{file}, {} - tetralux", opened.mesh.field())
            }
            None => "tetralux".into(),
        };
        if self.title != title {
            ctx.send_viewport_cmd(egui::ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    fn names(&self) -> Option<[String; 2]> {
        let method =
            |how: How| format!("{}, {}, {}", name_of(how.device), name_of(how.choices.method), how.choices.integral);
        match self.compare {
            Compare::Off => None,
            Compare::Kinds => Some(["1D".into(), "2D".into()]),
            Compare::Methods => Some(self.how.map(method)),
        }
    }
}

impl eframe::App for App {
    /// What panels are filled with, which costs nothing this way: software rasterisers took a third of a frame to fill them.
    fn clear_color(&self, visuals: &egui::Visuals) -> [f32; 4] {
        visuals.panel_fill.to_normalized_gamma_f32()
    }

    fn logic(&mut self, ctx: &Context, _: &mut eframe::Frame) {
        self.poll(ctx);
    }

    fn ui(&mut self, ui: &mut Ui, _: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        let moves = ctx.input(|i| i.events.iter().filter(|event| matches!(event, Event::PointerMoved(_))).count());
        self.clock.hear(Instant::now(), moves > 1);
        // While something is pulled, pictures are awaited as much as the window.
        if moves > 0 && !ctx.input(|i| i.pointer.any_down()) {
            self.steward.hear();
        }
        self.keys(&ctx);
        self.name_window(&ctx);
        // What they would be filled with is there.
        let frame = egui::Frame::side_top_panel(ui.style()).fill(Color32::TRANSPARENT);
        Panel::top("menus").frame(frame).show(ui, |ui| self.menus(ui));
        Panel::bottom("status").frame(frame).show(ui, |ui| self.status(ui));
        let side = Panel::right("function").frame(frame).resizable(true).default_size(430.0).size_range(320.0..=900.0);
        // What fades out at the panel's end fades to this.
        let below = UiStackInfo::new(UiKind::Frame).with_frame(egui::Frame::new().fill(ui.visuals().panel_fill));
        side.show(ui, |ui| ui.scope_builder(UiBuilder::new().ui_stack_info(below), |ui| self.side_panel(ui)));
        egui::CentralPanel::no_frame().show(ui, |ui| {
            let names = self.names();
            if let Some(sitting) = &mut self.sitting {
                let bounds = sitting.opened.bounds;
                let scenery = Scenery { bounds, clip: &mut sitting.look.clip, names };
                self.canvas.ui(ui, &mut sitting.camera, scenery);
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
        // A drag is one step, and so is a number that is typed.
        let is_in_hand = ctx.input(|i| i.pointer.any_down()) || ctx.egui_wants_keyboard_input();
        let is_settled = !is_in_hand && !self.editor.is_busy();
        if let Some(sitting) = &mut self.sitting {
            sitting.history.observe(&sitting.look, is_settled);
        }
        self.redraw_if_needed(&ctx);
        self.want(&ctx);
        self.refine(&ctx);
        self.draw_legend(&ctx, is_settled);
        if self.canvas.is_moving {
            // When it moves no more, the picture is made in full.
            ctx.request_repaint();
        }
    }
}

/// A camera that sees all of a mesh.
fn fitted(opened: &Opened) -> Camera {
    let bounds = opened.bounds;
    let projection = Projection::Perspective { fov_y: FOV_Y };
    Camera::fit(&bounds, 1.0, [30f64.to_radians(), 20f64.to_radians()], 1.0, projection)
}
