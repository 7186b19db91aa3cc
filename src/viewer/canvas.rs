//! The picture: drawn, turned, compared.

use eframe::egui::{
    Align2, Color32, ColorImage, Context, CursorIcon, FontId, Key, Modifiers, Painter, PointerButton, Pos2, Rect,
    Response, Role, Sense, Stroke, StrokeKind, TextureHandle, TextureOptions, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use eframe::egui_wgpu::RenderState;
use glam::DVec3;

use super::clip_box::{self, Side};
use super::look;
use super::pane::{Easel, Pane};
use crate::scene::Camera;
use crate::space::Bounds;

/// How two pictures are shown together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Together {
    /// One beside the other at a line that can be pulled.
    #[default]
    Split,
    /// Their difference.
    Difference,
}

/// What is around the picture.
pub struct Scenery<'a> {
    /// Of the mesh.
    pub bounds: Bounds,
    /// The clipping box, where there is one: its sides are pulled.
    pub clip: &'a mut Option<Bounds>,
    /// Of the sides, where there are two.
    pub names: Option<[String; 2]>,
}

/// What is pulled.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Hold {
    Camera,
    Split,
    Clip(Side),
    /// From where on the screen.
    Area(Pos2),
}

/// State of the picture.
pub struct Canvas {
    /// One a side, then the difference.
    panes: Vec<Pane>,
    easel: Easel,
    /// Share of the width where the line is.
    pub split: f32,
    /// See [`Together`].
    pub together: Together,
    /// The mesh's box and axes are drawn.
    pub has_box: bool,
    /// A part of the picture is drawn next.
    pub is_choosing: bool,
    /// The part that was drawn, pixels: left, top, before right, before bottom.
    pub chosen: Option<[u32; 4]>,
    /// Another picture of a part, pixels.
    part: Option<([u32; 4], Pane)>,
    legend: Option<TextureHandle>,
    hold: Option<Hold>,
    /// Pixels of the last drawing.
    pub size: [u32; 2],
    /// The pixel under the pointer, if it rests there.
    pub hovered: Option<[f64; 2]>,
    /// The camera is being moved.
    pub is_moving: bool,
}

impl Default for Canvas {
    fn default() -> Self {
        Self {
            panes: Vec::new(),
            easel: Easel::default(),
            split: 0.5,
            together: Together::Split,
            has_box: true,
            is_choosing: false,
            chosen: None,
            part: None,
            legend: None,
            hold: None,
            size: [1, 1],
            hovered: None,
            is_moving: false,
        }
    }
}

impl Canvas {
    /// For a window that draws by `state`.
    pub fn new(state: Option<&RenderState>) -> Self {
        Self { easel: Easel::new(state), ..Self::default() }
    }

    /// Takes new pictures: one, or two and their difference; `is_coarse`: their pixels are larger than the screen's.
    pub fn show(&mut self, ctx: &Context, pictures: Vec<ColorImage>, is_coarse: bool) {
        self.panes = pictures.into_iter().map(|picture| self.easel.pane(ctx, picture, is_coarse)).collect();
    }

    /// Takes another picture of a part, or none.
    pub fn show_part(&mut self, ctx: &Context, part: Option<([u32; 4], ColorImage)>) {
        self.part = part.map(|(area, picture)| (area, self.easel.pane(ctx, picture, false)));
    }

    /// Takes a legend, or none.
    pub fn show_legend(&mut self, ctx: &Context, legend: Option<ColorImage>) {
        self.legend = legend.map(|picture| ctx.load_texture("legend", picture, TextureOptions::LINEAR));
    }

    /// Forgets the last pictures.
    pub fn clear(&mut self) {
        self.panes.clear();
        (self.part, self.legend) = (None, None);
    }

    /// Whether the middle of some pixels is right of the line between two pictures.
    pub fn is_right_of_split(&self, [left, _, right, _]: [u32; 4]) -> bool {
        let middle = 0.5 * (left + right) as f32;
        self.together == Together::Split && middle > self.split * self.size[0] as f32
    }

    /// Whether a side of the clipping box is being pulled.
    pub fn is_clipping(&self) -> bool {
        matches!(self.hold, Some(Hold::Clip(_)))
    }

    /// Draws, and moves the camera or what is pulled.
    pub fn ui(&mut self, ui: &mut Ui, camera: &mut Camera, mut scenery: Scenery<'_>) -> Response {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Picture"));
        let scale = ui.ctx().pixels_per_point();
        self.size = [rect.width(), rect.height()].map(|v| ((v * scale).round() as u32).max(1));
        let before = *camera;
        self.pull(ui, &response, rect, camera, &mut scenery);
        self.fly(ui, &response, camera, &scenery.bounds);
        self.is_moving = before != *camera || (response.dragged() && self.hold == Some(Hold::Camera));
        self.hovered = response.hover_pos().filter(|_| !self.is_moving).map(|pos| {
            let at = (pos - rect.min) * scale;
            [at.x.into(), at.y.into()]
        });
        self.draw(ui, rect, &response, camera, &scenery);
        response
    }

    /// What a press at a place takes hold of.
    fn grab(&self, rect: Rect, camera: &Camera, scenery: &Scenery<'_>, pressed: Pos2) -> Hold {
        let line = rect.left() + self.split * rect.width();
        let has_split = scenery.names.is_some() && self.together == Together::Split;
        let side = scenery.clip.as_ref().and_then(|clip| clip_box::side_at(camera, rect, clip, pressed));
        match side {
            _ if self.is_choosing => Hold::Area(pressed),
            Some(side) => Hold::Clip(side),
            None if has_split && (pressed.x - line).abs() < 8.0 => Hold::Split,
            None => Hold::Camera,
        }
    }

    fn pull(&mut self, ui: &Ui, response: &Response, rect: Rect, camera: &mut Camera, scenery: &mut Scenery<'_>) {
        if response.drag_started() {
            let pressed = ui.input(|i| i.pointer.press_origin()).or(response.interact_pointer_pos());
            let is_primary = response.dragged_by(PointerButton::Primary);
            let grabbed = pressed.filter(|_| is_primary).map(|pos| self.grab(rect, camera, scenery, pos));
            self.hold = Some(grabbed.unwrap_or(Hold::Camera));
        }
        match (self.hold, response.interact_pointer_pos()) {
            (Some(Hold::Split), Some(pos)) => {
                self.split = ((pos.x - rect.left()) / rect.width()).clamp(0.02, 0.98);
            }
            (Some(Hold::Clip(side)), Some(pos)) => {
                if let Some(clip) = &mut *scenery.clip {
                    clip_box::pull(clip, side, camera, rect, pos, &scenery.bounds);
                }
            }
            (Some(Hold::Area(from)), Some(pos)) if response.drag_stopped() => {
                self.chosen = self.area(rect, from, pos, ui.ctx().pixels_per_point());
                self.is_choosing = false;
            }
            (Some(Hold::Camera), _) => turn(ui, response, rect, camera),
            _ => {}
        }
        if !response.dragged() {
            self.hold = None;
        }
    }

    /// Pixels between two places on the screen; none where that is too small to be meant.
    fn area(&self, rect: Rect, from: Pos2, to: Pos2, scale: f32) -> Option<[u32; 4]> {
        let between = Rect::from_two_pos(from, to).intersect(rect);
        let [left, top] =
            [between.left() - rect.left(), between.top() - rect.top()].map(|v| (v * scale).max(0.0) as u32);
        let [right, bottom] =
            [between.right() - rect.left(), between.bottom() - rect.top()].map(|v| (v * scale) as u32);
        let [right, bottom] = [right.min(self.size[0]), bottom.min(self.size[1])];
        (right > left + 1 && bottom > top + 1).then_some([left, top, right, bottom])
    }

    fn fly(&self, ui: &Ui, response: &Response, camera: &mut Camera, bounds: &Bounds) {
        if response.hovered() {
            let by = ui.input(|i| f64::from(i.smooth_scroll_delta().y) / 250.0 + f64::from(i.zoom_delta()).ln());
            if by != 0.0 {
                look::zoom(camera, by.exp());
            }
            let step = 0.02 * bounds.diagonal();
            let keys = [
                (Key::ArrowLeft, [-step, 0.0, 0.0]),
                (Key::ArrowRight, [step, 0.0, 0.0]),
                (Key::ArrowUp, [0.0, 0.0, step]),
                (Key::ArrowDown, [0.0, 0.0, -step]),
                (Key::PageUp, [0.0, step, 0.0]),
                (Key::PageDown, [0.0, -step, 0.0]),
            ];
            for (key, by) in keys {
                if ui.input_mut(|i| i.consume_key(Modifiers::NONE, key)) {
                    look::fly(camera, by);
                }
            }
        }
    }

    fn draw(&self, ui: &Ui, rect: Rect, response: &Response, camera: &Camera, scenery: &Scenery<'_>) {
        let painter = ui.painter_at(rect);
        let names = scenery.names.as_ref();
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let is_pair = names.is_some() && self.panes.len() == 3;
        match (&self.panes[..], is_pair, self.together) {
            ([], _, _) => {
                painter.rect_filled(rect, 0.0, Color32::BLACK);
            }
            ([_, _, difference], true, Together::Difference) => difference.draw(&painter, rect),
            ([left, right, _], true, Together::Split) => {
                let x = rect.left() + self.split * rect.width();
                let [before, behind] = [rect.with_max_x(x), rect.with_min_x(x)];
                left.draw(&painter.with_clip_rect(before), rect);
                right.draw(&painter.with_clip_rect(behind), rect);
                painter.vline(x, rect.y_range(), Stroke::new(2.0, Color32::WHITE));
                painter.circle(pos2(x, rect.center().y), 6.0, Color32::WHITE, Stroke::new(1.0, Color32::BLACK));
            }
            ([first, ..], _, _) => first.draw(&painter, rect),
        }
        let to_screen = |[left, top, right, bottom]: [u32; 4]| {
            let at = |x: u32, y: u32| rect.min + vec2(x as f32, y as f32) / ui.ctx().pixels_per_point();
            Rect::from_min_max(at(left, top), at(right, bottom))
        };
        let frame = Stroke::new(1.5, clip_box::COLOR);
        if let Some((area, pane)) = &self.part {
            pane.draw(&painter, to_screen(*area));
            painter.rect_stroke(to_screen(*area), 0.0, frame, StrokeKind::Outside);
        }
        if self.has_box {
            let faint = Stroke::new(1.0, Color32::from_rgba_unmultiplied(160, 160, 160, 120));
            clip_box::draw(&painter, rect, camera, &scenery.bounds, faint);
        }
        let pointer = response.hover_pos();
        if let Some(clip) = scenery.clip.as_ref() {
            clip_box::draw(&painter, rect, camera, clip, Stroke::new(1.0, clip_box::COLOR));
            let under = pointer.and_then(|pos| clip_box::side_at(camera, rect, clip, pos));
            let held = if let Some(Hold::Clip(side)) = self.hold { Some(side) } else { under };
            if held.is_some() {
                ui.ctx().set_cursor_icon(CursorIcon::Grab);
            }
            clip_box::draw_handles(&painter, rect, camera, clip, held);
        }
        if self.is_choosing {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
        if let (Some(Hold::Area(from)), Some(to)) = (self.hold, response.interact_pointer_pos()) {
            painter.rect_stroke(Rect::from_two_pos(from, to), 0.0, frame, StrokeKind::Middle);
        }
        draw_axes(&painter, rect, camera);
        if let Some(legend) = &self.legend {
            let size = legend.size_vec2() / ui.ctx().pixels_per_point();
            let at = Rect::from_min_size(rect.max - size - vec2(10.0, 10.0), size);
            painter.image(legend.id(), at, whole, Color32::WHITE);
        }
        if let Some([left, right]) = names {
            let place = |at: Pos2, align: Align2, text: &str| {
                let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(13.0), Color32::WHITE);
                let area = align.anchor_size(at, galley.size());
                painter.rect_filled(area.expand(4.0), 3.0, Color32::from_black_alpha(160));
                painter.galley(area.min, galley, Color32::WHITE);
            };
            if self.together == Together::Difference {
                place(rect.left_top() + vec2(10.0, 10.0), Align2::LEFT_TOP, &format!("{left} − {right}"));
            } else {
                place(rect.left_top() + vec2(10.0, 10.0), Align2::LEFT_TOP, left);
                place(rect.right_top() + vec2(-10.0, 10.0), Align2::RIGHT_TOP, right);
            }
        }
    }
}

/// Turns, moves or rolls the camera by a drag.
fn turn(ui: &Ui, response: &Response, rect: Rect, camera: &mut Camera) {
    let delta = response.drag_delta();
    if delta == Vec2::ZERO {
        return;
    }
    let modifiers = ui.input(|i| i.modifiers);
    let [x, y] = [delta.x, delta.y].map(|v| f64::from(v / rect.height()));
    let pans =
        response.dragged_by(PointerButton::Secondary) || response.dragged_by(PointerButton::Middle) || modifiers.shift;
    if pans {
        look::pan(camera, x, y);
    } else if modifiers.command {
        look::roll(camera, -3.0 * x);
    } else {
        look::orbit(camera, 4.0 * x, -4.0 * y);
    }
}

fn draw_axes(painter: &Painter, rect: Rect, camera: &Camera) {
    let basis = camera.basis();
    let middle = rect.left_bottom() + vec2(38.0, -38.0);
    let axes = [
        (DVec3::X, "x", Color32::from_rgb(235, 90, 80)),
        (DVec3::Y, "y", Color32::from_rgb(90, 200, 90)),
        (DVec3::Z, "z", Color32::from_rgb(90, 150, 255)),
    ];
    for (axis, name, color) in axes {
        let toward = vec2(axis.dot(basis.right) as f32, -axis.dot(basis.up) as f32);
        painter.line_segment([middle, middle + 26.0 * toward], Stroke::new(2.0, color));
        painter.text(middle + 33.0 * toward, Align2::CENTER_CENTER, name, FontId::proportional(12.0), color);
    }
}
