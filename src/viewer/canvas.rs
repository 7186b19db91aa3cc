//! The picture: drawn, turned, compared.

use eframe::egui::{
    Align2, Color32, ColorImage, FontId, Key, Modifiers, PointerButton, Pos2, Rect, Response, Role, Sense, Stroke,
    TextureHandle, TextureOptions, Ui, Vec2, WidgetInfo, pos2, vec2,
};
use glam::DVec3;

use super::look;
use crate::scene::{Camera, Projection};
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

/// State of the picture.
pub struct Canvas {
    /// One a side, then the difference.
    textures: Vec<TextureHandle>,
    /// Share of the width where the line is.
    pub split: f32,
    /// See [`Together`].
    pub together: Together,
    /// The mesh's box and axes are drawn.
    pub has_box: bool,
    is_pulling_split: bool,
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
            textures: Vec::new(),
            split: 0.5,
            together: Together::Split,
            has_box: true,
            is_pulling_split: false,
            size: [1, 1],
            hovered: None,
            is_moving: false,
        }
    }
}

impl Canvas {
    /// Takes new pictures: one, or two and their difference.
    pub fn show(&mut self, ctx: &eframe::egui::Context, pictures: Vec<ColorImage>) {
        self.textures.truncate(pictures.len());
        for (index, picture) in pictures.into_iter().enumerate() {
            match self.textures.get_mut(index) {
                Some(texture) => texture.set(picture, TextureOptions::LINEAR),
                None => self.textures.push(ctx.load_texture("picture", picture, TextureOptions::LINEAR)),
            }
        }
    }

    /// Forgets the last pictures.
    pub fn clear(&mut self) {
        self.textures.clear();
    }

    /// Draws, and moves the camera. `names`: of the sides, where there are two.
    pub fn ui(&mut self, ui: &mut Ui, camera: &mut Camera, bounds: &Bounds, names: Option<[String; 2]>) -> Response {
        let (rect, response) = ui.allocate_exact_size(ui.available_size(), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, "Picture"));
        let scale = ui.ctx().pixels_per_point();
        self.size = [rect.width(), rect.height()].map(|v| ((v * scale).round() as u32).max(1));
        let before = *camera;
        self.move_camera(ui, &response, rect, camera, bounds, names.is_some());
        self.is_moving = before != *camera || (response.dragged() && !self.is_pulling_split);
        self.hovered = response.hover_pos().filter(|_| !self.is_moving).map(|pos| {
            let at = (pos - rect.min) * scale;
            [at.x.into(), at.y.into()]
        });
        self.draw(ui, rect, camera, bounds, names);
        response
    }

    fn move_camera(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        camera: &mut Camera,
        bounds: &Bounds,
        has_split: bool,
    ) {
        let line = rect.left() + self.split * rect.width();
        if response.drag_started() {
            let pressed = ui.input(|i| i.pointer.press_origin()).or(response.interact_pointer_pos());
            let is_near = pressed.is_some_and(|pos| (pos.x - line).abs() < 8.0);
            self.is_pulling_split = has_split && self.together == Together::Split && is_near;
        }
        let delta = response.drag_delta();
        if self.is_pulling_split {
            if let Some(pos) = response.interact_pointer_pos() {
                self.split = ((pos.x - rect.left()) / rect.width()).clamp(0.02, 0.98);
            }
            self.is_pulling_split = !response.drag_stopped();
        } else if delta != Vec2::ZERO {
            let modifiers = ui.input(|i| i.modifiers);
            let [x, y] = [delta.x, delta.y].map(|v| f64::from(v / rect.height()));
            let pans = response.dragged_by(PointerButton::Secondary)
                || response.dragged_by(PointerButton::Middle)
                || modifiers.shift;
            if pans {
                look::pan(camera, x, y);
            } else if modifiers.command {
                look::roll(camera, -3.0 * x);
            } else {
                look::orbit(camera, 4.0 * x, -4.0 * y);
            }
        }
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

    fn draw(&self, ui: &Ui, rect: Rect, camera: &Camera, bounds: &Bounds, names: Option<[String; 2]>) {
        let painter = ui.painter_at(rect);
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let is_pair = names.is_some() && self.textures.len() == 3;
        match (&self.textures[..], is_pair, self.together) {
            ([], _, _) => {
                painter.rect_filled(rect, 0.0, Color32::BLACK);
            }
            ([_, _, difference], true, Together::Difference) => {
                painter.image(difference.id(), rect, whole, Color32::WHITE);
            }
            ([left, right, _], true, Together::Split) => {
                let x = rect.left() + self.split * rect.width();
                let halves = [(left, 0.0, self.split), (right, self.split, 1.0)];
                for (texture, from, to) in halves {
                    let [a, b] = [from, to].map(|share| rect.left() + share * rect.width());
                    let part = Rect::from_min_max(pos2(a, rect.top()), pos2(b, rect.bottom()));
                    let uv = Rect::from_min_max(pos2(from, 0.0), pos2(to, 1.0));
                    painter.image(texture.id(), part, uv, Color32::WHITE);
                }
                painter.vline(x, rect.y_range(), Stroke::new(2.0, Color32::WHITE));
                painter.circle(pos2(x, rect.center().y), 6.0, Color32::WHITE, Stroke::new(1.0, Color32::BLACK));
            }
            ([first, ..], _, _) => {
                painter.image(first.id(), rect, whole, Color32::WHITE);
            }
        }
        if self.has_box {
            draw_box(&painter, rect, camera, bounds);
        }
        draw_axes(&painter, rect, camera);
        if let Some([left, right]) = names {
            let place = |at: Pos2, align, text: &str| {
                let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(13.0), Color32::WHITE);
                let area = align_rect(at, align, galley.size());
                painter.rect_filled(area.expand(4.0), 3.0, Color32::from_black_alpha(160));
                painter.galley(area.min, galley, Color32::WHITE);
            };
            if self.together == Together::Difference {
                place(rect.left_top() + vec2(10.0, 10.0), Align2::LEFT_TOP, &format!("{left} − {right}"));
            } else {
                place(rect.left_top() + vec2(10.0, 10.0), Align2::LEFT_TOP, &left);
                place(rect.right_top() + vec2(-10.0, 10.0), Align2::RIGHT_TOP, &right);
            }
        }
    }
}

fn align_rect(at: Pos2, align: Align2, size: Vec2) -> Rect {
    align.anchor_size(at, size)
}

/// Where a place in data space is on the screen; `None` behind the eye.
fn project(camera: &Camera, rect: Rect, p: DVec3) -> Option<Pos2> {
    let (basis, away) = (camera.basis(), p - camera.eye);
    let [x, y, depth] = [basis.right, basis.up, basis.forward].map(|axis| away.dot(axis));
    let half = match camera.projection {
        Projection::Perspective { fov_y } if depth > 0.0 => (0.5 * fov_y).tan() * depth,
        Projection::Perspective { .. } => return None,
        Projection::Orthographic { height } => 0.5 * height,
    };
    let to_points = 0.5 * f64::from(rect.height()) / half;
    Some(rect.center() + vec2((x * to_points) as f32, (-y * to_points) as f32))
}

fn draw_box(painter: &eframe::egui::Painter, rect: Rect, camera: &Camera, bounds: &Bounds) {
    let corners = bounds.corners().map(|corner| project(camera, rect, corner));
    let stroke = Stroke::new(1.0, Color32::from_rgba_unmultiplied(160, 160, 160, 120));
    for a in 0..8 {
        for bit in [1, 2, 4] {
            if let (0, Some(from), Some(to)) = (a & bit, corners[a], corners[a | bit]) {
                painter.line_segment([from, to], stroke);
            }
        }
    }
}

fn draw_axes(painter: &eframe::egui::Painter, rect: Rect, camera: &Camera) {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A place on a pixel's ray is drawn at that pixel.
    #[test]
    fn places_are_drawn_where_rays_meet_them() {
        let rect = Rect::from_min_size(pos2(40.0, 30.0), vec2(320.0, 200.0));
        for projection in [Projection::Perspective { fov_y: 0.8 }, Projection::Orthographic { height: 7.0 }] {
            let (eye, target) = (DVec3::new(9.0, -3.0, 4.0), DVec3::new(0.5, 1.0, 0.0));
            let camera = Camera { eye, target, up: DVec3::Z, projection, near: None };
            for pixel in [[10.0, 20.0], [160.0, 100.0], [300.0, 150.0]] {
                let ray = camera.ray([320, 200], pixel);
                let at = project(&camera, rect, ray.origin + 6.5 * ray.direction).expect("before the eye");
                let want = rect.min + vec2(pixel[0] as f32, pixel[1] as f32);
                assert!(at.distance(want) < 1e-2, "{at:?}, not {want:?}");
            }
        }
    }
}
