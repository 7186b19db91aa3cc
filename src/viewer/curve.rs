//! The function of the scalar alone: control points over the scalar's histogram.

use eframe::egui::{PointerButton, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::editor::color_of;
use super::opened::Opened;
use super::plot;
use crate::image::linear_from_srgb;
use crate::scene::{Curve, CurveNode, Widget, WidgetShape};
use crate::tet::Domain as _;

/// How near a point is taken hold of.
const NEAR: f32 = 9.0;
/// Control points that a colour map is laid over.
const STEPS: u32 = 9;

/// A colour map by name.
pub const MAPS: [(&str, colorous::Gradient); 8] = [
    ("Viridis", colorous::VIRIDIS),
    ("Plasma", colorous::PLASMA),
    ("Inferno", colorous::INFERNO),
    ("Cividis", colorous::CIVIDIS),
    ("Turbo", colorous::TURBO),
    ("Cool", colorous::COOL),
    ("Red-blue", colorous::RED_BLUE),
    ("Spectral", colorous::SPECTRAL),
];

/// State of the plot.
#[derive(Default)]
pub struct CurveEditor {
    /// The point whose numbers are shown.
    pub selected: Option<usize>,
    held: Option<usize>,
    /// Extinction at the plot's top.
    top: f64,
}

impl CurveEditor {
    /// Whether something is being pulled.
    pub fn is_busy(&self) -> bool {
        self.held.is_some()
    }

    /// Removes the selected point; one stays.
    pub fn delete(&mut self, curve: &mut Curve) {
        if let Some(index) = self.selected.take_if(|index| *index < curve.nodes.len() && curve.nodes.len() > 1) {
            curve.nodes.remove(index);
        }
    }

    /// Draws the plot and does what the pointer asks.
    pub fn ui(&mut self, ui: &mut Ui, opened: &Opened, curve: &mut Curve, height: f32) -> Response {
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), height), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Curve"));
        let plot = Rect::from_min_max(rect.min + vec2(52.0, 16.0), rect.max - vec2(8.0, 34.0));
        let range = opened.histogram.scalar;
        let high = if range.length() > 0.0 { range.max } else { range.min + 1.0 };
        if self.held.is_none() {
            let most = curve.nodes.iter().map(|node| node.extinction).fold(0.0, f64::max);
            self.top = if most > 0.0 { 1.15 * most } else { 10.0 / opened.bounds.diagonal() };
        }
        let shown = [[range.min, high], [0.0, self.top]];
        let map = plot::map(plot, shown);
        let at = |node: &CurveNode| plot::to_pos(map.point([node.scalar, node.extinction]));
        let near = |curve: &Curve, pos: Pos2| {
            let found = curve.nodes.iter().enumerate().map(|(i, node)| (i, at(node).distance(pos)));
            found.filter(|(_, away)| *away <= NEAR).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(i, _)| i)
        };
        let data = |pos: Pos2| map.data([pos.x.into(), pos.y.into()]);
        if let Some(pos) = response.interact_pointer_pos() {
            if response.drag_started_by(PointerButton::Primary) {
                let pressed = ui.input(|i| i.pointer.press_origin()).unwrap_or(pos);
                self.held = near(curve, pressed);
                self.selected = self.held.or(self.selected);
            }
            if let Some(index) = self.held.filter(|&index| index < curve.nodes.len()) {
                let [s, extinction] = data(pos);
                // Scalars stay in order.
                let gap = 1e-6 * (high - range.min);
                let low = index.checked_sub(1).map_or(range.min, |i| curve.nodes[i].scalar + gap);
                let end = curve.nodes.get(index + 1).map_or(high, |node| node.scalar - gap);
                let node = &mut curve.nodes[index];
                (node.scalar, node.extinction) = (s.max(low).min(end.max(low)), extinction.clamp(0.0, self.top));
            }
            if response.double_clicked() && plot.contains(pos) && near(curve, pos).is_none() {
                self.selected = add(curve, data(pos));
            } else if response.clicked() {
                self.selected = near(curve, pos);
            }
            if response.secondary_clicked()
                && let Some(index) = near(curve, pos)
            {
                self.selected = Some(index);
                self.delete(curve);
            }
        }
        if response.drag_stopped() || response.interact_pointer_pos().is_none() {
            self.held = None;
        }
        self.draw(ui, opened, curve, plot, shown);
        response
    }

    fn draw(&self, ui: &Ui, opened: &Opened, curve: &Curve, plot: Rect, shown: [[f64; 2]; 2]) {
        let ink = ui.visuals().text_color();
        plot::axes(ui.painter(), plot, shown, [opened.mesh.field(), "extinction (1 / data length)"], ink);
        let painter = ui.painter_at(plot.expand(6.0));
        let (map, histogram) = (plot::map(plot, shown), &opened.histogram);
        let width = histogram.bins[0];
        let volume = |i: usize| (0..histogram.bins[1]).map(|j| histogram.counts[j * width + i]).sum::<f64>();
        let volumes: Vec<f64> = (0..width).map(volume).collect();
        let most = volumes.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let bar = plot.width() / width as f32;
        for (i, volume) in volumes.iter().enumerate() {
            // Six decades.
            let share = (1.0 + (volume / most).log10() / 6.0).clamp(0.0, 1.0) as f32;
            let left = plot.left() + bar * i as f32;
            let top = plot.bottom() - share * plot.height();
            let bin = Rect::from_min_max(pos2(left, top), pos2(left + bar, plot.bottom()));
            painter.rect_filled(bin, 0.0, ink.gamma_multiply(0.18));
        }
        let at = |node: &CurveNode| plot::to_pos(map.point([node.scalar, node.extinction]));
        // It goes on as it ends.
        let mut line: Vec<Pos2> = curve.nodes.iter().map(at).collect();
        if let (Some(first), Some(last)) = (line.first().copied(), line.last().copied()) {
            line.insert(0, pos2(plot.left(), first.y));
            line.push(pos2(plot.right(), last.y));
        }
        painter.add(Shape::line(line, Stroke::new(1.5, ink)));
        for (index, node) in curve.nodes.iter().enumerate() {
            let color = color_of(&Widget::new(WidgetShape::Uniform, node.color, 0.0));
            let is_selected = self.selected == Some(index);
            let stroke = Stroke::new(if is_selected { 2.5 } else { 1.0 }, ink);
            painter.circle(at(node), if is_selected { 6.5 } else { 5.0 }, color, stroke);
        }
    }
}

/// A new point, coloured as the curve is there.
fn add(curve: &mut Curve, [scalar, extinction]: [f64; 2]) -> Option<usize> {
    let index = curve.nodes.partition_point(|node| node.scalar < scalar);
    if curve.nodes.get(index).is_some_and(|node| node.scalar == scalar) {
        return Some(index);
    }
    let color = curve.at(scalar).color;
    curve.nodes.insert(index, CurveNode { scalar, color, extinction: extinction.max(0.0) });
    Some(index)
}

/// Lays a colour map over the scalars; extinctions stay, points are added between few.
pub fn recolor(curve: &mut Curve, map: &colorous::Gradient, range: [f64; 2]) {
    if curve.nodes.len() < STEPS as usize {
        for i in 0..STEPS {
            let scalar = range[0] + (range[1] - range[0]) * f64::from(i) / f64::from(STEPS - 1);
            let extinction = curve.at(scalar).extinction;
            add(curve, [scalar, extinction]);
        }
    }
    for node in &mut curve.nodes {
        let share = ((node.scalar - range[0]) / (range[1] - range[0]).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        node.color = map.eval_continuous(share).as_array().map(|v| linear_from_srgb(f32::from(v) / 255.0).into());
    }
}

/// A colour as egui's buttons edit it, and back.
pub fn color_button(ui: &mut Ui, color: &mut [f64; 3]) -> Response {
    let mut linear = color.map(|v| v as f32);
    let response = ui.color_edit_button_rgb(&mut linear);
    if response.changed() {
        *color = linear.map(f64::from);
    }
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve() -> Curve {
        let node = |scalar, extinction| CurveNode { scalar, color: [0.2, 0.4, 0.6], extinction };
        Curve { nodes: vec![node(0.0, 0.0), node(1.0, 4.0)] }
    }

    #[test]
    fn a_new_point_lies_on_its_place_in_order() {
        let mut curve = curve();
        assert_eq!(add(&mut curve, [0.25, 3.0]), Some(1));
        assert_eq!(curve.nodes[1], CurveNode { scalar: 0.25, color: [0.2, 0.4, 0.6], extinction: 3.0 });
        assert_eq!(add(&mut curve, [0.25, 9.0]), Some(1), "two points are never at one scalar");
        assert_eq!(curve.nodes.len(), 3);
    }

    #[test]
    fn a_colour_map_keeps_extinctions() {
        let (before, mut after) = (curve(), curve());
        recolor(&mut after, &colorous::VIRIDIS, [0.0, 1.0]);
        for share in [0.0, 0.1, 0.33, 0.5, 0.9, 1.0] {
            assert!((after.at(share).extinction - before.at(share).extinction).abs() < 1e-12, "{share}");
        }
        assert_ne!(after.nodes[0].color, after.nodes[STEPS as usize - 1].color);
    }
}
