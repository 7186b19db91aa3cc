//! What the picture shows: what is asked for, what has come, and what is drawn over it.

use std::sync::Arc;
use std::sync::mpsc::channel;
use std::time::Duration;

use eframe::egui::Context;

use super::{App, Compare};
use crate::cli::legend;
use crate::image::Comparison;
use crate::scene::{self, TransferFunction, Widget, WidgetShape};
use crate::viewer::engine::{How, Shown, Side, Wanted};
use crate::viewer::look::Kind;
use crate::viewer::opened::Opened;
use crate::viewer::path;
use crate::viewer::refine::Refining;
use crate::viewer::screen::{self, Backdrop};

/// The pointer rests when it has not moved for so long.
const REST: Duration = Duration::from_millis(120);

/// Differences are shown so many times as bright.
const DIFFERENCE_TIMES: f32 = 16.0;

/// A legend's height, pixels: its axes fill it.
const LEGEND: u32 = 240;

impl App {
    pub(super) fn show(&mut self, ctx: &Context, mut shown: Shown) {
        self.pictures = std::mem::take(&mut shown.images);
        self.shown = Some(shown);
        self.compare_refined();
        self.compared = match &self.pictures[..] {
            [a, b] => Comparison::new(a, b).ok(),
            _ => None,
        };
        self.redraw(ctx);
    }

    /// The last pictures again, before another backdrop.
    pub(super) fn redraw_if_needed(&mut self, ctx: &Context) {
        if self.drawn_before != (self.backdrop, self.plain()) && !self.pictures.is_empty() {
            self.redraw(ctx);
            self.draw_refined(ctx);
        }
    }

    fn redraw(&mut self, ctx: &Context) {
        let plain = self.plain();
        self.drawn_before = (self.backdrop, plain);
        let screens = self.threads.install(|| {
            let one = |image| screen::screen(image, self.backdrop, plain);
            let mut screens: Vec<_> = self.pictures.iter().map(one).collect();
            if let [a, b] = &self.pictures[..] {
                screens.push(screen::difference(a, b, DIFFERENCE_TIMES));
            }
            screens
        });
        let is_coarse = self.shown.as_ref().is_some_and(|shown| shown.step > 1);
        self.canvas.show(ctx, screens, is_coarse);
    }

    /// Asks for what is to be seen.
    pub(super) fn want(&mut self, ctx: &Context) {
        let Some(sitting) = &self.sitting else { return };
        let again = ctx.clone();
        let Opened { mesh, bounds, .. } = &sitting.opened;
        let part = match self.clipper.part(mesh, bounds, sitting.look.clip, move || again.request_repaint()) {
            Ok(part) => part,
            Err(error) => {
                // Messages are drawn before this.
                ctx.request_repaint();
                return self.say(error.to_string());
            }
        };
        let side = |kind: Kind, how: How| Side { transfer: sitting.look.transfer(kind), how };
        let mut sides = match self.compare {
            Compare::Off => vec![side(sitting.look.kind, self.how[0])],
            Compare::Kinds => vec![side(Kind::Univariate, self.how[0]), side(Kind::Bivariate, self.how[0])],
            Compare::Methods => self.how.map(|how| side(sitting.look.kind, how)).into(),
        };
        let bivariate = sides.iter_mut().find(|side| matches!(side.transfer, TransferFunction::Widgets(_)));
        if let (Some(ranges), Some(side)) = (self.editor.brush, bivariate) {
            side.transfer = brushed(&side.transfer, ranges, bounds.diagonal());
        }
        let wanted = Wanted {
            mesh: part.mesh,
            sides,
            camera: sitting.camera,
            optics: sitting.look.optics,
            size: self.canvas.size,
            background: [0.0; 4],
            is_moving: self.canvas.is_moving
                || self.canvas.is_clipping()
                || self.editor.is_busy()
                || self.curve.is_busy(),
        };
        if self.engine.want(wanted) {
            (self.is_answered, self.is_given_up) = (false, false);
            (self.refining, self.refined) = (None, None);
            self.canvas.show_part(ctx, None);
        }
        self.is_cut = part.is_last;
    }

    /// Has the reference's pixels made where a part of the picture was drawn.
    pub(super) fn refine(&mut self, ctx: &Context) {
        let Some(area) = self.canvas.chosen.take() else { return };
        let Some(wanted) = self.engine.last() else { return };
        let again = ctx.clone();
        self.refined = None;
        self.canvas.show_part(ctx, None);
        let is_right = wanted.sides.len() > 1 && self.canvas.is_right_of_split(area);
        let side = usize::from(is_right);
        self.refining = Some(Refining::start(wanted.clone(), side, area, Arc::new(move || again.request_repaint())));
    }

    pub(super) fn poll_refining(&mut self, ctx: &Context) {
        let Some(result) = self.refining.as_ref().and_then(Refining::finished) else { return };
        self.refining = None;
        match result {
            Ok(refined) => {
                self.refined = Some(refined);
                self.compare_refined();
                self.draw_refined(ctx);
            }
            Err(error) => self.say(error.to_string()),
        }
    }

    /// Once both are there: the part, and the picture in full.
    fn compare_refined(&mut self) {
        if let (Some(refined), Some(Shown { step: 1, .. })) = (&mut self.refined, &self.shown) {
            refined.compare(&self.pictures);
        }
    }

    fn draw_refined(&mut self, ctx: &Context) {
        let plain = self.plain();
        let Some(refined) = &self.refined else { return };
        let picture = self.threads.install(|| screen::screen(&refined.image, Backdrop::Plain, plain));
        self.canvas.show_part(ctx, Some((refined.area, picture)));
    }

    /// The background, linear, premultiplied.
    fn plain(&self) -> [f32; 4] {
        let [r, g, b, a] = self.sitting.as_ref().map_or([0.0; 4], |sitting| sitting.look.background);
        [r * a, g * a, b * a, a].map(|v| v as f32)
    }

    /// Draws the function beside the picture, once it is not being changed any more.
    pub(super) fn draw_legend(&mut self, ctx: &Context, is_settled: bool) {
        let Some(sitting) = self.sitting.as_ref().filter(|_| self.has_legend) else {
            if self.legend_of.take().is_some() {
                self.canvas.show_legend(ctx, None);
            }
            return;
        };
        let transfer = sitting.look.transfer(sitting.look.kind);
        if !is_settled || self.legend_of.as_ref() == Some(&transfer) {
            return;
        }
        match legend::panel(LEGEND, &*sitting.opened.mesh, &transfer) {
            Ok(image) => {
                let picture = self.threads.install(|| screen::screen(&image, Backdrop::Plain, [0.0; 4]));
                self.canvas.show_legend(ctx, Some(picture));
            }
            Err(error) => self.say(error.to_string()),
        }
        self.legend_of = Some(transfer);
    }

    /// Marks the ray of a pixel on the histogram, once the pointer rests.
    pub(super) fn follow(&mut self, ctx: &Context) {
        if let Some(path) = self.following.as_ref().and_then(|path| path.try_recv().ok()) {
            (self.path, self.following) = (path, None);
        }
        let Some(sitting) = &self.sitting else { return };
        let now = self.canvas.hovered.map(|pixel| (pixel, sitting.camera));
        if now == self.path_of || self.following.is_some() {
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
        // Of what is drawn: the clipping box leaves less.
        let mesh = self.engine.last().map_or_else(|| Arc::clone(&sitting.opened.mesh), |last| Arc::clone(&last.mesh));
        let size = self.canvas.size;
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

/// A function and, in white, what lies in a box of its values.
fn brushed(transfer: &TransferFunction, [s, g]: [[f64; 2]; 2], diagonal: f64) -> TransferFunction {
    let mark = Widget {
        scalar_range: Some(s),
        gradient_range: Some(g),
        ..Widget::new(WidgetShape::Uniform, [1.0; 3], 200.0 / diagonal)
    };
    match transfer {
        TransferFunction::Widgets(widgets) if widgets.len() < scene::MAX_WIDGETS => {
            TransferFunction::Widgets(widgets.iter().cloned().chain([mark]).collect())
        }
        _ => TransferFunction::Widgets(vec![mark]),
    }
}
