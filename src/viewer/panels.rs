//! The panel beside the picture: widgets, the curve's points, how it looks and how it is made.

use eframe::egui::{self, Button, ComboBox, DragValue, Ui};

use super::curve::{self, color_button};
use super::editor::Editor;
use super::engine::How;
use super::look::{Item, Look};
use super::opened::Opened;
use super::screen::Backdrop;
use crate::cli::args::{Device, IntegralChoice, Method, Order, name_of};
use crate::renderer::{LEAST_TOLERANCE, SegmentIntegral};
use crate::scene::{
    EmissionModel, LightSpace, Lighting, MAX_WIDGETS, Silhouette, SilhouetteMode, SinusoidVariant, Widget, WidgetShape,
};
use crate::space::{Bounds, Interval};

/// A number of any size, of which a pull changes a hundredth.
fn number(ui: &mut Ui, value: &mut f64, name: &str, step: f64) -> egui::Response {
    let speed = if step > 0.0 { step } else { 0.01 };
    ui.add(DragValue::new(value).speed(speed).max_decimals(9)).on_hover_text(name)
}

/// A number that is not negative, and of any order of magnitude.
fn positive(ui: &mut Ui, value: &mut f64, name: &str) -> egui::Response {
    let digits = if *value > 0.0 { (6 - value.log10().floor() as i32).clamp(3, 40) as usize } else { 9 };
    let speed = (0.01 * *value).max(1e-12);
    let drag = DragValue::new(value).speed(speed).range(0.0..=f64::MAX).max_decimals(digits);
    ui.add(drag).on_hover_text(name)
}

/// The list of widgets, and the numbers of the one that is selected.
pub fn widgets(ui: &mut Ui, editor: &mut Editor, look: &mut Look, opened: &Opened) {
    let mut todo = None;
    for index in 0..look.items.len() {
        let is_selected = editor.selected == Some(index);
        let is_solo = look.solo == Some(index);
        let item = &mut look.items[index];
        ui.horizontal(|ui| {
            color_button(ui, &mut item.widget.color);
            if ui.selectable_label(is_selected, format!("{} {}", index + 1, shape_name(&item.widget))).clicked() {
                editor.selected = if is_selected { None } else { Some(index) };
            }
            let eye = if item.is_hidden { "show" } else { "hide" };
            if ui.small_button(eye).on_hover_text("Leave it out of the picture, or not (H)").clicked() {
                item.is_hidden = !item.is_hidden;
            }
            if ui.selectable_label(is_solo, "solo").on_hover_text("Draw it alone").clicked() {
                todo = Some(Todo::Solo(index));
            }
            if ui.small_button("copy").on_hover_text("Make another one like it (Ctrl+D)").clicked() {
                todo = Some(Todo::Copy(index));
            }
            if ui.add_enabled(index > 0, Button::new("up").small()).clicked() {
                todo = Some(Todo::Up(index));
            }
            if ui.small_button("delete").on_hover_text("Delete").clicked() {
                todo = Some(Todo::Delete(index));
            }
        });
        if is_selected {
            ui.indent(("widget", index), |ui| numbers(ui, &mut look.items[index], opened));
        }
    }
    if look.items.is_empty() {
        ui.weak("No widgets: take a tool above and draw one on the histogram, or let some be suggested.");
    }
    if let Some(todo) = todo {
        apply(todo, editor, look);
    }
}

/// What is done with a widget.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Todo {
    /// Draw it alone, or not any more.
    Solo(usize),
    /// Another one like it.
    Copy(usize),
    /// One place up.
    Up(usize),
    /// Away.
    Delete(usize),
}

/// Does it; what is selected, and what is drawn alone, stays so.
pub fn apply(todo: Todo, editor: &mut Editor, look: &mut Look) {
    match todo {
        Todo::Solo(index) => look.solo = (look.solo != Some(index)).then_some(index),
        Todo::Copy(_) if look.items.len() >= MAX_WIDGETS => {}
        Todo::Copy(index) => {
            let copy = look.items[index].clone();
            look.items.insert(index + 1, copy);
            look.solo = look.solo.map(|solo| if solo > index { solo + 1 } else { solo });
            editor.selected = Some(index + 1);
        }
        Todo::Up(index) => {
            look.items.swap(index, index - 1);
            for number in [&mut look.solo, &mut editor.selected].into_iter().flatten() {
                *number = match *number {
                    n if n == index => index - 1,
                    n if n == index - 1 => index,
                    n => n,
                };
            }
        }
        Todo::Delete(index) => {
            look.items.remove(index);
            for number in [&mut look.solo, &mut editor.selected] {
                *number = number.filter(|&n| n != index).map(|n| if n > index { n - 1 } else { n });
            }
        }
    }
}

fn shape_name(widget: &Widget) -> &'static str {
    match widget.shape {
        WidgetShape::Uniform => "uniform",
        WidgetShape::Gaussian { .. } => "Gaussian",
        WidgetShape::Triangle { .. } => "triangle wave",
        WidgetShape::Sinusoid { .. } => "sinusoid",
        WidgetShape::Ramp { .. } => "ramp",
    }
}

fn numbers(ui: &mut Ui, item: &mut Item, opened: &Opened) {
    let (s, g) = (opened.histogram.scalar, opened.histogram.gradient);
    let steps = [s.length() / 500.0, g.length() / 500.0];
    let widget = &mut item.widget;
    egui::Grid::new("numbers").num_columns(2).show(ui, |ui| {
        ui.label("extinction");
        ui.horizontal(|ui| {
            positive(ui, &mut widget.extinction, "Where the profile is 1, 1 / data length");
            if widget.extinction > 0.0 {
                // What people can see of the number.
                let half = std::f64::consts::LN_2 / widget.extinction / opened.bounds.diagonal();
                ui.weak(format!("half opaque after {:.2} % of the diagonal", 100.0 * half));
            }
        });
        ui.end_row();
        match &mut widget.shape {
            WidgetShape::Uniform => {}
            WidgetShape::Gaussian { center, sigma, angle } => {
                row(ui, "centre", |ui| pair(ui, center, steps, "Scalar, gradient magnitude"));
                row(ui, "sigma", |ui| {
                    positive(ui, &mut sigma[0], "Standard deviation along the first axis");
                    positive(ui, &mut sigma[1], "Standard deviation along the second axis");
                    sigma.iter_mut().for_each(|s| *s = s.max(f64::MIN_POSITIVE));
                });
                row(ui, "angle", |ui| {
                    let mut degrees = angle.to_degrees();
                    if ui.add(DragValue::new(&mut degrees).speed(0.1).suffix("°").max_decimals(9)).changed() {
                        *angle = degrees.to_radians();
                    }
                });
            }
            WidgetShape::Triangle { direction, offset, period, duty } => {
                wave(ui, direction, offset, period, steps);
                row(ui, "duty", |ui| {
                    ui.add(DragValue::new(duty).speed(0.005).range(1e-6..=1.0));
                });
            }
            WidgetShape::Sinusoid { direction, offset, period, variant } => {
                wave(ui, direction, offset, period, steps);
                row(ui, "variant", |ui| {
                    for (value, name) in [
                        (SinusoidVariant::Cos, "cos"),
                        (SinusoidVariant::Arch, "arch"),
                        (SinusoidVariant::Half, "half"),
                    ] {
                        ui.selectable_value(variant, value, name);
                    }
                });
            }
            WidgetShape::Ramp { direction, knots } => {
                row(ui, "direction", |ui| way(ui, direction));
                row(ui, "knots", |ui| {
                    ui.vertical(|ui| knotted(ui, knots, steps[0]));
                });
            }
        }
        for (name, range, all, step) in
            [("scalars", &mut widget.scalar_range, s, steps[0]), ("gradients", &mut widget.gradient_range, g, steps[1])]
        {
            row(ui, name, |ui| limits(ui, range, all, step));
        }
    });
}

fn row(ui: &mut Ui, name: &str, content: impl FnOnce(&mut Ui)) {
    ui.label(name);
    ui.horizontal(content);
    ui.end_row();
}

fn pair(ui: &mut Ui, values: &mut [f64; 2], steps: [f64; 2], name: &str) {
    for (value, step) in values.iter_mut().zip(steps) {
        number(ui, value, name, step);
    }
}

fn way(ui: &mut Ui, direction: &mut [f64; 2]) {
    let before = *direction;
    for (value, name) in direction.iter_mut().zip(["Along the scalar", "Along the gradient magnitude"]) {
        let speed = (0.01 * value.abs()).max(1e-4);
        number(ui, value, name, speed);
    }
    if direction[0].hypot(direction[1]) == 0.0 {
        *direction = before;
    }
}

fn wave(ui: &mut Ui, direction: &mut [f64; 2], offset: &mut f64, period: &mut f64, steps: [f64; 2]) {
    row(ui, "direction", |ui| way(ui, direction));
    row(ui, "offset", |ui| {
        number(ui, offset, "Where a period begins, along the direction", steps[0]);
    });
    row(ui, "period", |ui| {
        positive(ui, period, "Along the direction");
        *period = period.max(f64::MIN_POSITIVE);
    });
}

/// Knots stay in order.
fn knotted(ui: &mut Ui, knots: &mut Vec<[f64; 2]>, step: f64) {
    let before = knots.clone();
    for knot in knots.iter_mut() {
        ui.horizontal(|ui| {
            number(ui, &mut knot[0], "Where, along the direction", step);
            ui.add(DragValue::new(&mut knot[1]).speed(0.01).range(0.0..=1e3).clamp_existing_to_range(false))
                .on_hover_text("Weight");
        });
    }
    if ui.small_button("add a knot").clicked()
        && let [.., before_last, last] = knots[..]
    {
        knots.push([2.0 * last[0] - before_last[0], last[1]]);
    }
    if !knots.windows(2).all(|pair| pair[0][0] < pair[1][0]) {
        *knots = before;
    }
}

fn limits(ui: &mut Ui, range: &mut Option<[f64; 2]>, all: Interval, step: f64) {
    let mut is_limited = range.is_some();
    if ui.checkbox(&mut is_limited, "").on_hover_text("Nothing outside of it").changed() {
        *range = is_limited.then_some([all.min, all.max]);
    }
    if let Some([low, high]) = range {
        number(ui, low, "Lowest", step);
        number(ui, high, "Highest", step);
        *high = high.max(*low);
    } else {
        ui.weak("all");
    }
}

/// The curve's colour maps and the numbers of its selected point.
pub fn curve(ui: &mut Ui, editor: &curve::CurveEditor, look: &mut Look, opened: &Opened) {
    let range = opened.histogram.scalar;
    ui.horizontal(|ui| {
        ui.menu_button("Colour map", |ui| {
            for (name, map) in &curve::MAPS {
                if ui.button(*name).clicked() {
                    curve::recolor(&mut look.curve, map, [range.min, range.max]);
                    ui.close();
                }
            }
        });
        ui.weak("Double-click adds a point, the right button removes one.");
    });
    let Some(node) = editor.selected.and_then(|index| look.curve.nodes.get_mut(index)) else { return };
    ui.horizontal(|ui| {
        color_button(ui, &mut node.color);
        ui.label(format!("at {}", super::plot::short(node.scalar)));
        positive(ui, &mut node.extinction, "Extinction, 1 / data length");
    });
}

/// Brightness, emission, lighting, silhouettes, background.
pub fn optics(ui: &mut Ui, look: &mut Look, backdrop: &mut Backdrop) {
    ui.horizontal(|ui| {
        ui.label("Opacity ×");
        let slider = egui::Slider::new(&mut look.brightness, 0.01..=100.0).logarithmic(true);
        ui.add(slider).on_hover_text("All extinctions are multiplied by it");
    });
    ui.horizontal(|ui| {
        ui.label("Emission");
        ui.selectable_value(&mut look.optics.emission, EmissionModel::Weighted, "weighted")
            .on_hover_text("Colours times extinction");
        ui.selectable_value(&mut look.optics.emission, EmissionModel::Unweighted, "unweighted")
            .on_hover_text("Colours alone (Song et al. 2009)");
    });
    let mut is_lit = look.optics.lighting.is_some();
    if ui.checkbox(&mut is_lit, "Lighting").changed() {
        let direction = glam::DVec3::new(0.3, 0.4, 1.0).normalize();
        let (ambient, diffuse, specular, shininess) = (0.3, 0.7, 0.2, 32.0);
        let light = Lighting { ambient, diffuse, specular, shininess, direction, space: LightSpace::View };
        look.optics.lighting = is_lit.then_some(light);
    }
    if let Some(light) = &mut look.optics.lighting {
        ui.horizontal(|ui| {
            for (value, name) in [
                (&mut light.ambient, "ambient"),
                (&mut light.diffuse, "diffuse"),
                (&mut light.specular, "specular"),
                (&mut light.shininess, "shininess"),
            ] {
                let drag = DragValue::new(value).speed(0.02).range(0.0..=500.0).clamp_existing_to_range(false);
                ui.add(drag).on_hover_text(name);
            }
        });
    }
    let mut is_outlined = look.optics.silhouette.is_some();
    if ui.checkbox(&mut is_outlined, "Silhouettes").changed() {
        let silhouette = Silhouette { exponent: 2.0, strength: 1.0, mode: SilhouetteMode::Opacity };
        look.optics.silhouette = is_outlined.then_some(silhouette);
    }
    if let Some(silhouette) = &mut look.optics.silhouette {
        ui.horizontal(|ui| {
            ui.add(
                DragValue::new(&mut silhouette.exponent).speed(0.05).range(0.01..=100.0).clamp_existing_to_range(false),
            )
            .on_hover_text("exponent");
            ui.add(DragValue::new(&mut silhouette.strength).speed(0.01).range(0.0..=1.0)).on_hover_text("strength");
            ui.selectable_value(&mut silhouette.mode, SilhouetteMode::Opacity, "opacity");
            ui.selectable_value(&mut silhouette.mode, SilhouetteMode::Depth, "depth");
        });
    }
    ui.horizontal(|ui| {
        ui.label("Background");
        let [r, g, b, _] = look.background;
        let mut color = [r, g, b];
        if color_button(ui, &mut color).changed() {
            look.background = [color[0], color[1], color[2], 1.0];
        }
        for (value, name) in Backdrop::ALL {
            ui.selectable_value(backdrop, value, name).on_hover_text("In the window; files get the colour");
        }
    });
}

/// The clipping box, by numbers; in the picture its sides are pulled.
pub fn clipping(ui: &mut Ui, look: &mut Look, bounds: &Bounds) {
    let mut is_clipped = look.clip.is_some();
    if ui.checkbox(&mut is_clipped, "Clipping box (I)").on_hover_text("Pull the dots on its sides").changed() {
        look.clip = is_clipped.then_some(*bounds);
    }
    let Some(clip) = &mut look.clip else { return };
    egui::Grid::new("clip").num_columns(3).show(ui, |ui| {
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let step = (bounds.max[axis] - bounds.min[axis]) / 500.0;
            ui.label(name);
            let [mut low, mut high] = [clip.min[axis], clip.max[axis]];
            number(ui, &mut low, "From, data units", step);
            number(ui, &mut high, "To, data units", step);
            [low, high] = [low, high].map(|v| v.clamp(bounds.min[axis], bounds.max[axis]));
            if low < high {
                (clip.min[axis], clip.max[axis]) = (low, high);
            }
            ui.end_row();
        }
    });
}

/// Device, method, integral, order, tolerance. `name`: which of two.
pub fn how(ui: &mut Ui, how: &mut How, name: &str) {
    egui::Grid::new(("how", name)).num_columns(2).show(ui, |ui| {
        choice(
            ui,
            name,
            "device",
            &mut how.device,
            &[Device::Auto, Device::Gpu, Device::Software, Device::Cpu, Device::Oracle],
        );
        choice(
            ui,
            name,
            "method",
            &mut how.choices.method,
            &[Method::Auto, Method::Project, Method::Cellcast, Method::Raycast],
        );
        choice(
            ui,
            name,
            "order",
            &mut how.choices.order,
            &[Order::Auto, Order::Centroid, Order::Power, Order::Mpvonc, Order::Exact, Order::PerPixel],
        );
        ui.label("integral");
        let text = how.choices.integral.to_string();
        ComboBox::from_id_salt(("integral", name)).selected_text(text).show_ui(ui, |ui| {
            for integral in INTEGRALS {
                ui.selectable_value(&mut how.choices.integral, integral, integral.to_string());
            }
        });
        ui.end_row();
        ui.label("tolerance");
        ui.add(DragValue::new(&mut how.choices.tolerance).speed(1e-4).range(LEAST_TOLERANCE..=1.0).max_decimals(6))
            .on_hover_text("What a channel may err by, where something is chosen");
        ui.end_row();
    });
}

const INTEGRALS: [IntegralChoice; 9] = [
    IntegralChoice::Auto,
    IntegralChoice::Fixed(SegmentIntegral::Adaptive { tolerance: 1e-3 }),
    IntegralChoice::Fixed(SegmentIntegral::Adaptive { tolerance: 1e-2 }),
    IntegralChoice::Fixed(SegmentIntegral::Analytic),
    IntegralChoice::Fixed(SegmentIntegral::MeanScalar),
    IntegralChoice::Fixed(SegmentIntegral::VertexLinear),
    IntegralChoice::Fixed(SegmentIntegral::PreIntegrated { size: SegmentIntegral::PREINTEGRATED_SIZE }),
    IntegralChoice::Fixed(SegmentIntegral::PartialDirect),
    IntegralChoice::Fixed(SegmentIntegral::Segmented { pieces: 4 }),
];

fn choice<T: clap::ValueEnum + Copy + PartialEq>(ui: &mut Ui, of: &str, name: &str, value: &mut T, all: &[T]) {
    ui.label(name);
    ComboBox::from_id_salt((name, of)).selected_text(name_of(*value)).show_ui(ui, |ui| {
        for &each in all {
            ui.selectable_value(value, each, name_of(each));
        }
    });
    ui.end_row();
}
