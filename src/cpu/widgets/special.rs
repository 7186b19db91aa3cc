//! Special points along a line: where ranges, knots and corners lie, a Gaussian's centre and standard deviations, eighths of
//! a wave's period. Twin of `shaders/shared/special.wgsl`.

use crate::cpu::widgets::any::AnyWidget;
use crate::cpu::widgets::knots::Knots;
use crate::cpu::widgets::line::{Line, blend};
use crate::cpu::widgets::profile::{Phase, Profile, Wave};

/// Nearer points are one.
const LEAST: f32 = 1e-6;

/// The next special point of the widgets after `at`; 1 where there is none.
pub fn next_special(widgets: &[AnyWidget], line: &Line, at: f32) -> f32 {
    let mut next = Next { at, best: 1.0 };
    for widget in widgets {
        for value in widget.plain.scalar.into_iter().flatten() {
            next.passes(line.front.x, line.back.x, value);
        }
        for value in widget.plain.gradient.into_iter().flatten() {
            next.passes(line.front.y, line.back.y, value);
        }
        if let Some(window) = &widget.window {
            next.knots(window, line);
        }
        match &widget.profile {
            Profile::Uniform => {}
            Profile::Gaussian(gaussian) => {
                let front = gaussian.whitened(line.front);
                let step = gaussian.whitened(line.back) - front;
                let square = step.length_squared().max(1e-30);
                let center = -front.dot(step) / square;
                // One standard deviation is 1 / sqrt(2) in whitened length.
                let sigma = std::f32::consts::FRAC_1_SQRT_2 / square.sqrt();
                for i in -3_i8..=3 {
                    next.passes(0.0, 1.0, center + f32::from(i) * sigma);
                }
            }
            Profile::Wave(phase, wave) => next.wave(phase, *wave, line),
            Profile::Ramp(knots) => next.knots(knots, line),
        }
    }
    next.best
}

struct Next {
    at: f32,
    best: f32,
}

impl Next {
    /// Where u, linear from `front` to `back`, is `value`.
    fn passes(&mut self, front: f32, back: f32, value: f32) {
        let change = back - front;
        let x = (value - front) / change;
        if change.abs() >= 1e-30 && x > self.at + LEAST && x < self.best {
            self.best = x;
        }
    }

    fn knots(&mut self, knots: &Knots, line: &Line) {
        let (front, back) = (knots.along(line.front), knots.along(line.back));
        self.passes(front, back, knots.support[0]);
        for piece in &knots.pieces {
            self.passes(front, back, piece.ends[1]);
        }
    }

    /// Halves of a triangle's period, eighths of the others', and the feet of narrow tents.
    fn wave(&mut self, phase: &Phase, wave: Wave, line: &Line) {
        let (front, back) = (phase.at(line.front), phase.at(line.back));
        // Phases count arches, two of which are a period of the halved wave.
        let parts = match wave {
            Wave::Triangle { .. } => 2.0,
            Wave::Half => 4.0,
            Wave::Cosine | Wave::Arch => 8.0,
        };
        let here = blend(front, back, self.at) * parts;
        let step = if back > front { 1.0 } else { -1.0 };
        // Where `here` is a multiple but for rounding, the next may be on either side of it.
        let multiple = (here + 0.5).floor();
        for i in -1_i8..=2 {
            self.passes(front, back, (multiple + f32::from(i) * step) / parts);
        }
        if let Wave::Triangle { duty } = wave
            && duty < 1.0
        {
            let whole = (here / parts).floor();
            for i in -1_i8..=1 {
                for foot in [-0.5 * duty, 0.5 * duty] {
                    self.passes(front, back, whole + f32::from(i) + 0.5 + foot);
                }
            }
        }
    }
}
