//! The joint histogram, and widgets drawn on it.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

use eframe::egui::{
    Color32, Context, CursorIcon, Key, PointerButton, Pos2, Rect, Response, Role, Sense, Shape, Stroke, StrokeKind,
    TextureHandle, TextureOptions, Ui, WidgetInfo, pos2, vec2,
};

use super::handles::{self, Grip, Map};
use super::look::{Item, Look};
use super::opened::{BINS, Opened};
use super::plot;
use crate::image::srgb_from_linear;
use crate::scene::{MAX_WIDGETS, SinusoidVariant, Widget, WidgetShape};
use crate::space::Interval;
use crate::tet::{Domain as _, JointHistogram, TetMesh};

/// How near a handle is taken hold of, points.
const NEAR: f64 = 10.0;
/// Left of the plot and below it are numbers.
const MARGINS: [f32; 4] = [52.0, 16.0, 8.0, 34.0];
/// What a new widget's width is, of what is shown.
const SHARE: f64 = 0.06;

/// What is drawn with the pointer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Takes hold of widgets.
    #[default]
    Move,
    /// Puts a new one where a drag begins.
    Gaussian,
    /// See [`Tool::Gaussian`].
    Triangle,
    /// See [`Tool::Gaussian`].
    Sinusoid,
    /// See [`Tool::Gaussian`].
    Uniform,
    /// See [`Tool::Gaussian`].
    Ramp,
    /// Shows the cells of a box.
    Brush,
}

impl Tool {
    /// All, with their names and what they do.
    pub const ALL: [(Self, &'static str, &'static str); 7] = [
        (Self::Move, "Move", "Take hold of widgets and their handles (V)"),
        (Self::Gaussian, "Gaussian", "Draw a Gaussian: press at its middle and pull (G)"),
        (Self::Triangle, "Triangle", "Draw a triangle wave: press at a peak and pull to the next (T)"),
        (Self::Sinusoid, "Sinusoid", "Draw a sinusoid: press at a peak and pull to the next (S)"),
        (Self::Uniform, "Uniform", "Draw a box of one extinction (U)"),
        (Self::Ramp, "Ramp", "Draw a ramp: press where it begins and pull to its end (R)"),
        (Self::Brush, "Brush", "Drag a box: the picture shows where its values lie (B)"),
    ];

    /// The key that takes it.
    pub fn key(self) -> Key {
        match self {
            Self::Move => Key::V,
            Self::Gaussian => Key::G,
            Self::Triangle => Key::T,
            Self::Sinusoid => Key::S,
            Self::Uniform => Key::U,
            Self::Ramp => Key::R,
            Self::Brush => Key::B,
        }
    }

    /// What is drawn at a place: `width`, of a new one, data units.
    fn shape(self, at: [f64; 2], width: [f64; 2]) -> Option<WidgetShape> {
        let direction = [1.0, 0.0];
        let (offset, period) = (at[0] - width[0], 2.0 * width[0]);
        Some(match self {
            Self::Gaussian => WidgetShape::Gaussian { center: at, sigma: width.map(|w| 0.5 * w), angle: 0.0 },
            Self::Triangle => WidgetShape::Triangle { direction, offset, period, duty: 1.0 },
            Self::Sinusoid => WidgetShape::Sinusoid { direction, offset, period, variant: SinusoidVariant::default() },
            Self::Uniform => WidgetShape::Uniform,
            Self::Ramp => WidgetShape::Ramp { direction, knots: vec![[at[0], 0.0], [at[0] + 2.0 * width[0], 1.0]] },
            Self::Move | Self::Brush => return None,
        })
    }
}

/// What is being done with the pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Hold {
    Widget(usize, Grip),
    /// A new Gaussian's or box's far corner.
    New(usize, [f64; 2]),
    Brush([f64; 2]),
    Pan,
}

/// Where the histogram is on the screen.
#[derive(Clone, Copy)]
struct Plot {
    rect: Rect,
    /// Along both axes, data units.
    shown: [[f64; 2]; 2],
    map: Map,
}

impl Plot {
    fn new(rect: Rect, shown: [[f64; 2]; 2]) -> Self {
        Self { rect, shown, map: plot::map(rect, shown) }
    }
}

/// State of the plot.
#[derive(Default)]
pub struct Editor {
    /// Along both axes, data units; `None`: where the volume is.
    pub shown: Option<[[f64; 2]; 2]>,
    /// The widget whose handles are drawn.
    pub selected: Option<usize>,
    /// See [`Tool`].
    pub tool: Tool,
    /// What is pulled goes from tick to tick.
    pub snaps: bool,
    /// A box whose values the picture shows.
    pub brush: Option<[[f64; 2]; 2]>,
    hold: Option<Hold>,
    /// Where what is held was last, points.
    last: [f64; 2],
    /// Where the volume is.
    most: Option<[[f64; 2]; 2]>,
    texture: Option<(bool, TextureHandle)>,
    close: Option<Close>,
}

/// The histogram of what is shown alone: as fine as the plot is.
struct Close {
    shown: [[f64; 2]; 2],
    result: Receiver<JointHistogram>,
    histogram: Option<JointHistogram>,
    texture: Option<(bool, TextureHandle)>,
}

impl Close {
    /// Begins, beside the window.
    fn start(mesh: Arc<TetMesh>, shown: [[f64; 2]; 2], ctx: Context) -> Self {
        let (sender, result) = channel();
        std::thread::spawn(move || {
            let ranges = shown.map(|[min, max]| Interval { min, max });
            // The plot may show something else by now.
            let _ = sender.send(JointHistogram::within(&mesh, BINS, ranges));
            ctx.request_repaint();
        });
        Self { shown, result, histogram: None, texture: None }
    }
}

impl Editor {
    /// Forgets what belongs to another mesh.
    pub fn reset(&mut self) {
        *self = Self { tool: self.tool, snaps: self.snaps, ..Self::default() };
    }

    /// Whether something is being pulled.
    pub fn is_busy(&self) -> bool {
        matches!(self.hold, Some(Hold::Widget(..) | Hold::New(..) | Hold::Brush(_)))
    }

    /// Whether the histogram of what is shown is still being made.
    pub fn is_looking(&self) -> bool {
        self.close.as_ref().is_some_and(|close| close.histogram.is_none())
    }

    /// All that the histogram spans.
    fn all(opened: &Opened) -> [[f64; 2]; 2] {
        let widened = |low: f64, high: f64| if high > low { [low, high] } else { [low - 0.5, high + 0.5] };
        let (s, g) = (opened.histogram.scalar, opened.histogram.gradient);
        [widened(s.min, s.max), widened(g.min, g.max)]
    }

    /// Draws the plot and does what the pointer asks. `path`: values along the ray under the pointer in the picture.
    pub fn ui(&mut self, ui: &mut Ui, opened: &Opened, look: &mut Look, path: &[[f64; 2]], height: f32) -> Response {
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Joint histogram"));
        let [left, top, right, bottom] = MARGINS;
        let inner = Rect::from_min_max(rect.min + vec2(left, top), rect.max - vec2(right, bottom));
        let all = Self::all(opened);
        let most = *self.most.get_or_insert_with(|| plot::where_volume_is(&opened.histogram, all));
        let plot = Plot::new(inner, self.shown.unwrap_or(most));
        self.point(ui, &response, &plot, look, opened);
        self.scroll(ui, &response, &plot, all);
        self.draw(ui, opened, look, path, &Plot::new(inner, self.shown.unwrap_or(most)));
        response
    }

    fn point(&mut self, ui: &Ui, response: &Response, plot: &Plot, look: &mut Look, opened: &Opened) {
        let Plot { rect, shown, map } = plot;
        let at = |pos: Pos2| [f64::from(pos.x), f64::from(pos.y)];
        let Some(pointer) = response.interact_pointer_pos() else {
            self.hold = None;
            if let Some(pos) = response.hover_pos()
                && self.tool == Tool::Move
                && self.handle_at(look, plot, at(pos)).is_some()
            {
                ui.ctx().set_cursor_icon(CursorIcon::Grab);
            }
            return;
        };
        let snaps = self.snaps;
        let snapped = |point| if snaps { plot::snapped(point, *rect, *shown) } else { point };
        if response.drag_started() {
            let pressed = ui.input(|i| i.pointer.press_origin()).unwrap_or(pointer);
            let from = map.data(snapped(at(pressed)));
            let middle = response.dragged_by(PointerButton::Middle) || response.dragged_by(PointerButton::Secondary);
            self.hold = if middle || ui.input(|i| i.modifiers.shift) {
                Some(Hold::Pan)
            } else if rect.contains(pressed) {
                self.grab(look, plot, at(pressed), from, opened)
            } else {
                None
            };
            // From where the handle is, what snaps goes to a tick; else the pointer keeps its distance.
            self.last = match self.hold {
                Some(Hold::Widget(index, Grip::Body)) if snaps => {
                    let all = handles::handles(&look.items[index].widget, map, *shown);
                    all.iter().find(|handle| handle.grip == Grip::Body).map_or(at(pressed), |handle| handle.at)
                }
                _ => at(pressed),
            };
        }
        let to = if self.hold == Some(Hold::Pan) { at(pointer) } else { snapped(at(pointer)) };
        let by = [to[0] - self.last[0], to[1] - self.last[1]];
        self.last = to;
        match self.hold {
            Some(Hold::Widget(index, grip)) if index < look.items.len() => {
                handles::pull(&mut look.items[index].widget, grip, to, by, map, *shown);
            }
            Some(Hold::New(index, from)) if index < look.items.len() => {
                stretch_new(&mut look.items[index].widget, from, map.data(to), map);
            }
            Some(Hold::Brush(from)) => self.brush = Some(between(from, map.data(to))),
            Some(Hold::Pan) => {
                let by = [by[0] / map.scale[0], -by[1] / map.scale[1]];
                self.shown = Some([0, 1].map(|axis| shown[axis].map(|v| v - by[axis])));
            }
            _ => {}
        }
        if response.clicked() {
            let pressed = map.data(to);
            match self.tool {
                Tool::Move => self.selected = self.handle_at(look, plot, at(pointer)).map(|(index, _)| index),
                Tool::Brush => self.brush = None,
                _ => _ = self.grab(look, plot, to, pressed, opened),
            }
            self.hold = None;
        }
        if response.drag_stopped() {
            self.hold = None;
        }
    }

    /// What a press at a place takes hold of; a tool that draws makes something there.
    fn grab(&mut self, look: &mut Look, plot: &Plot, at: [f64; 2], from: [f64; 2], opened: &Opened) -> Option<Hold> {
        let shown = plot.shown;
        match self.tool {
            Tool::Move => {
                let (index, grip) = self.handle_at(look, plot, at)?;
                self.selected = Some(index);
                Some(Hold::Widget(index, grip))
            }
            Tool::Brush => Some(Hold::Brush(from)),
            // A scene holds no more.
            _ if look.items.len() >= MAX_WIDGETS => None,
            tool => {
                let width = [0, 1].map(|axis| SHARE * (shown[axis][1] - shown[axis][0]));
                let index = look.add(tool.shape(from, width)?, opened.bounds.diagonal());
                if tool == Tool::Uniform {
                    let widget = &mut look.items[index].widget;
                    widget.scalar_range = Some([from[0] - width[0], from[0] + width[0]]);
                    widget.gradient_range = Some([from[1] - width[1], from[1] + width[1]]);
                }
                self.selected = Some(index);
                self.tool = Tool::Move;
                Some(Hold::New(index, from))
            }
        }
    }

    /// The nearest handle: of the selected widget first, then the middles of all.
    fn handle_at(&self, look: &Look, plot: &Plot, at: [f64; 2]) -> Option<(usize, Grip)> {
        let Plot { shown, map, .. } = plot;
        let away = |p: [f64; 2]| (p[0] - at[0]).hypot(p[1] - at[1]);
        let near = |index: usize, all: bool| {
            let handles = handles::handles(&look.items[index].widget, map, *shown);
            let found = handles.into_iter().filter(|h| (all || h.grip == Grip::Body) && away(h.at) <= NEAR);
            found.min_by(|a, b| away(a.at).total_cmp(&away(b.at))).map(|h| (index, h.grip, away(h.at)))
        };
        let selected = self.selected.filter(|&index| index < look.items.len());
        if let Some((index, grip, _)) = selected.and_then(|index| near(index, true)) {
            return Some((index, grip));
        }
        let found = (0..look.items.len()).filter_map(|index| near(index, false));
        if let Some((index, grip, _)) = found.min_by(|a, b| a.2.total_cmp(&b.2)) {
            return Some((index, grip));
        }
        // Inside a Gaussian, its body; of several, the smallest.
        let inside = |(index, item): (usize, &Item)| {
            let WidgetShape::Gaussian { sigma, .. } = item.widget.shape else { return None };
            let [s, g] = map.data(at);
            let is_in = item.widget.shape.profile(s, g) > (-0.5 * handles::REACH * handles::REACH).exp();
            is_in.then_some((index, sigma[0] * sigma[1]))
        };
        let found = look.items.iter().enumerate().filter_map(inside).min_by(|a, b| a.1.total_cmp(&b.1));
        found.map(|(index, _)| (index, Grip::Body))
    }

    fn scroll(&mut self, ui: &Ui, response: &Response, plot: &Plot, all: [[f64; 2]; 2]) {
        if response.double_clicked() && self.tool == Tool::Move {
            // Where the volume is, then all, and back.
            self.shown = if self.shown.is_none() { Some(all) } else { None };
        }
        let Plot { map, shown, .. } = plot;
        let Some(pos) = response.hover_pos() else { return };
        let by = ui.input(|i| f64::from(i.smooth_scroll_delta().y) / 200.0 + f64::from(i.zoom_delta()).ln());
        if by != 0.0 {
            let at = map.data([pos.x.into(), pos.y.into()]);
            let factor = (-by).exp();
            let zoomed = [0, 1].map(|axis| shown[axis].map(|v| at[axis] + factor * (v - at[axis])));
            let is_far = (0..2).all(|axis| zoomed[axis][1] - zoomed[axis][0] >= 1.5 * (all[axis][1] - all[axis][0]));
            self.shown = Some(if is_far { all } else { zoomed });
        }
    }

    /// The histogram of what is shown, once it is there: bins of all of it are coarse where that is a small part.
    fn look_closer(
        &mut self,
        ctx: &Context,
        opened: &Opened,
        shown: [[f64; 2]; 2],
        is_dark: bool,
    ) -> Option<TextureHandle> {
        let is_at_rest = self.hold != Some(Hold::Pan);
        let is_running = self.is_looking();
        if let Some(close) = &mut self.close
            && let Ok(histogram) = close.result.try_recv()
        {
            close.histogram = Some(histogram);
        } else if is_at_rest && !is_running && self.close.as_ref().is_none_or(|close| close.shown != shown) {
            self.close = Some(Close::start(Arc::clone(&opened.mesh), shown, ctx.clone()));
        }
        let close = self.close.as_mut().filter(|close| close.shown == shown)?;
        let histogram = close.histogram.as_ref()?;
        if close.texture.as_ref().is_none_or(|(dark, _)| *dark != is_dark) {
            // Finer bins hold less.
            let area = |all: [[f64; 2]; 2]| (all[0][1] - all[0][0]) * (all[1][1] - all[1][0]);
            let most = plot::most(&opened.histogram) * area(shown) / area(Self::all(opened));
            let image = plot::image(histogram, most, is_dark);
            close.texture = Some((is_dark, ctx.load_texture("close", image, TextureOptions::NEAREST)));
        }
        close.texture.as_ref().map(|(_, texture)| texture.clone())
    }

    fn draw(&mut self, ui: &Ui, opened: &Opened, look: &Look, path: &[[f64; 2]], plot: &Plot) {
        let Plot { rect, shown, map } = *plot;
        let is_dark = ui.visuals().dark_mode;
        if self.texture.as_ref().is_none_or(|(dark, _)| *dark != is_dark) {
            let image = plot::image(&opened.histogram, plot::most(&opened.histogram), is_dark);
            let texture = ui.ctx().load_texture("histogram", image, TextureOptions::NEAREST);
            self.texture = Some((is_dark, texture));
        }
        let ink = ui.visuals().text_color();
        let names = [opened.mesh.field(), "gradient magnitude (per data length)"];
        plot::axes(ui.painter(), rect, shown, names, ink);
        let painter = ui.painter_at(rect);
        painter.rect_filled(rect, 0.0, if is_dark { Color32::from_gray(24) } else { Color32::from_gray(250) });
        let place = |texture: &TextureHandle, [s, g]: [[f64; 2]; 2]| {
            let corners = [[s[0], g[0]], [s[1], g[1]]].map(|p| plot::to_pos(map.point(p)));
            let uv = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(texture.id(), Rect::from_two_pos(corners[0], corners[1]), uv, Color32::WHITE);
        };
        let close = self.look_closer(ui.ctx(), opened, shown, is_dark);
        if let Some((_, texture)) = self.texture.as_ref().filter(|_| close.is_none()) {
            place(texture, Self::all(opened));
        }
        if let Some(texture) = close {
            place(&texture, shown);
        }
        for (index, item) in look.items.iter().enumerate() {
            let is_selected = self.selected == Some(index);
            let is_drawn = look.solo.map_or(!item.is_hidden, |solo| solo == index);
            draw_widget(&painter, &item.widget, &map, shown, is_selected, is_drawn);
            if is_selected {
                draw_handles(&painter, &item.widget, &map, shown, is_dark);
            }
        }
        if let Some([s, g]) = self.brush {
            let corners = [[s[0], g[0]], [s[1], g[1]]].map(|p| plot::to_pos(map.point(p)));
            let stroke = Stroke::new(1.5, Color32::from_rgb(255, 120, 200));
            painter.rect_stroke(Rect::from_two_pos(corners[0], corners[1]), 0.0, stroke, StrokeKind::Middle);
        }
        if path.len() > 1 {
            let points = path.iter().map(|&p| plot::to_pos(map.point(p))).collect();
            painter.add(Shape::line(points, Stroke::new(1.5, Color32::from_rgb(255, 120, 200))));
        }
    }
}

fn between(a: [f64; 2], b: [f64; 2]) -> [[f64; 2]; 2] {
    [0, 1].map(|axis| [a[axis].min(b[axis]), a[axis].max(b[axis])])
}

/// A new widget from where the drag began to where it is.
fn stretch_new(widget: &mut Widget, from: [f64; 2], to: [f64; 2], map: &Map) {
    let least = map.scale.map(|scale| 2.0 / scale);
    let away = [0, 1].map(|axis| (to[axis] - from[axis]).abs().max(least[axis]));
    match &mut widget.shape {
        WidgetShape::Gaussian { sigma, .. } => *sigma = away.map(|a| a / handles::REACH),
        WidgetShape::Uniform => {
            let [s, g] = between(from, to);
            (widget.scalar_range, widget.gradient_range) = (Some(s), Some(g));
        }
        _ => {
            let [from, to] = [from, to].map(|p| map.point(p));
            // The handle of the next peak, pulled here from wherever it is; the held one stays below the press.
            handles::pull(widget, Grip::Period, to, [to[0] - from[0], to[1] - from[1]], map, around(from, map));
        }
    }
}

/// What lies around a point, as if it were all that is shown: the held line goes through its middle.
fn around(point: [f64; 2], map: &Map) -> [[f64; 2]; 2] {
    let at = map.data(point);
    [0, 1].map(|axis| [at[axis] - 1.0 / map.scale[axis], at[axis] + 1.0 / map.scale[axis]])
}

/// A widget's colour on the screen.
pub fn color_of(widget: &Widget) -> Color32 {
    let [r, g, b] = widget.color.map(|v| (255.0 * srgb_from_linear(v.clamp(0.0, 1.0) as f32)).round() as u8);
    Color32::from_rgb(r, g, b)
}

fn draw_widget(
    painter: &eframe::egui::Painter,
    widget: &Widget,
    map: &Map,
    shown: [[f64; 2]; 2],
    is_selected: bool,
    is_drawn: bool,
) {
    let color = color_of(widget);
    let fill = color.gamma_multiply(if is_drawn { 0.35 } else { 0.08 });
    let stroke =
        Stroke::new(if is_selected { 2.5 } else { 1.5 }, color.gamma_multiply(if is_drawn { 1.0 } else { 0.4 }));
    let [s, g] = handles::box_of(widget, shown);
    let corners = [[s[0], g[0]], [s[1], g[1]]].map(|p| plot::to_pos(map.point(p)));
    let bounds = Rect::from_two_pos(corners[0], corners[1]);
    match &widget.shape {
        &WidgetShape::Gaussian { center, sigma, angle } => {
            let points = handles::ellipse(center, sigma, angle, map).into_iter().map(plot::to_pos).collect();
            painter.add(Shape::convex_polygon(points, fill, stroke));
        }
        WidgetShape::Uniform => {
            painter.rect(bounds, 0.0, fill, stroke, StrokeKind::Inside);
        }
        shape => {
            let clipped = painter.with_clip_rect(bounds.intersect(painter.clip_rect()));
            for line in handles::crests(shape, map, shown) {
                clipped.line_segment(line.map(plot::to_pos), stroke);
            }
        }
    }
    if widget.scalar_range.is_some() || widget.gradient_range.is_some() {
        painter.rect_stroke(bounds, 0.0, Stroke::new(1.0, stroke.color), StrokeKind::Inside);
    }
}

fn draw_handles(painter: &eframe::egui::Painter, widget: &Widget, map: &Map, shown: [[f64; 2]; 2], is_dark: bool) {
    let all = handles::handles(widget, map, shown);
    let ink = if is_dark { Color32::WHITE } else { Color32::BLACK };
    let stroke = Stroke::new(1.5, ink);
    let at = |grip: Grip| all.iter().find(|h| h.grip == grip).map(|h| plot::to_pos(h.at));
    for grip in [Grip::Turn, Grip::Period] {
        if let (Some(body), Some(end)) = (at(Grip::Body), at(grip)) {
            painter.line_segment([body, end], Stroke::new(1.0, ink));
        }
    }
    for handle in &all {
        let radius = if handle.grip == Grip::Turn { 5.0 } else { 4.0 };
        let fill = if handle.grip == Grip::Turn { ink } else { color_of(widget) };
        painter.circle(plot::to_pos(handle.at), radius, fill, stroke);
    }
}
