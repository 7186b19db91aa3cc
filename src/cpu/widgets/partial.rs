//! Extinction and colour linear between special points (Moreland & Angel 2004). Twin of `partial_segment` in
//! `shaders/shared/special.wgsl`, psi evaluated.

use glam::Vec4;

use crate::cpu::segment::{Medium, Seen};
use crate::cpu::widgets::any::AnyWidget;
use crate::cpu::widgets::line::Line;
use crate::cpu::widgets::optics::{attenuation, color_weights};
use crate::cpu::widgets::points::color_of;
use crate::cpu::widgets::special::next_special;

/// Pieces at most; the rest is one.
const MOST_PIECES: u32 = 1024;

/// Widgets that are linear between their special points.
#[derive(Clone, Debug)]
pub struct PartialWidgets {
    /// In no order.
    pub widgets: Vec<AnyWidget>,
}

impl PartialWidgets {
    /// What is seen, and how many pieces it took.
    pub fn pieces(&self, line: &Line) -> (Seen, u32) {
        let (mut color, mut depth, mut start) = (Vec4::ZERO, 0.0_f32, 0.0);
        let mut pieces = 0;
        loop {
            pieces += 1;
            let end = if pieces == MOST_PIECES { 1.0 } else { next_special(&self.widgets, line, start) };
            let (front, back) = self.ends(line, start, end);
            let [front_share, back_share] = color_weights(front.w, back.w);
            color += attenuation(depth) * (front_share * color_of(front, back) + back_share * color_of(back, front));
            depth += 0.5 * (front.w + back.w);
            start = end;
            if end >= 1.0 || depth > 16.2 {
                return (color.with_w(1.0 - attenuation(depth)), pieces);
            }
        }
    }

    /// Emission and extinction at both ends of a piece, times its length.
    fn ends(&self, line: &Line, start: f32, end: f32) -> (Vec4, Vec4) {
        let (mut front, mut back) = (Vec4::ZERO, Vec4::ZERO);
        for widget in &self.widgets {
            let part = widget.active_part(line, [start, end]);
            // All of the piece, or none of it.
            if part[1] - part[0] > 0.5 * (end - start) {
                let most = (widget.plain.extinction * line.length).min(1e25) * (end - start);
                let color = widget.plain.color.with_w(1.0);
                front += most * widget.at(line.at(start)) * color;
                back += most * widget.at(line.at(end)) * color;
            }
        }
        (front, back)
    }
}

impl Medium for PartialWidgets {
    fn segment(&self, front: [f32; 2], back: [f32; 2], length: f32) -> Seen {
        self.pieces(&Line { front: front.into(), back: back.into(), length }).0
    }
}
