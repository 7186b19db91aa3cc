//! Periodic profiles and their means, times a linear weight, over an interval of phases: f32 twins of
//! `shaders/math/waves.wgsl`.
//!
//! Phases are in periods, any number of them, and may ascend or descend; weights are those at their ends. Phases are taken
//! from the nearest zero, where a profile's relative accuracy is decided; lengths are differences of what was rounded.

use std::f32::consts::FRAC_2_PI;

use crate::cpu::widgets::turns::{bessel_one, cosine_of_turns, sinc_complement, sine_of_turns};

/// `(1 - cos 2 pi p) / 2`.
pub fn cosine_at(phase: f32) -> f32 {
    let sine = sine_of_turns(0.5 * (phase - (phase + 0.5).floor()));
    sine * sine
}

/// Mean of [`cosine_at`].
pub fn cosine_mean(phases: [f32; 2], weights: [f32; 2]) -> f32 {
    let width = phases[1] - phases[0];
    let base = (0.5 * (phases[0] + phases[1]) + 0.5).floor();
    let middle = 0.5 * ((phases[0] - base) + (phases[1] - base));
    let swing = cosine_of_turns(middle);
    let complement = sinc_complement(width);
    // Two forms of (1 - cos(2 pi middle) sinc(pi width)) / 2: sums of positive terms.
    let mean = if swing > 0.0 {
        let sine = sine_of_turns(0.5 * middle);
        sine * sine + 0.5 * swing * complement
    } else {
        0.5 * (1.0 - swing * (1.0 - complement))
    };
    let tilt = weights[1] - weights[0];
    let level = 0.5 * (weights[0] + weights[1]) * mean;
    if tilt == 0.0 {
        return level;
    }
    level + 0.25 * tilt * sine_of_turns(middle) * bessel_one(width)
}

/// Whether a whole number is odd.
fn is_odd(index: f32) -> bool {
    index - 2.0 * (0.5 * index).floor() > 0.5
}

/// `|sin pi p|`; `alternate`: only the arches that begin at an even phase, 0 on the others.
pub fn arch_at(phase: f32, alternate: bool) -> f32 {
    if alternate && is_odd(phase.floor()) {
        return 0.0;
    }
    sine_of_turns(0.5 * (phase - (phase + 0.5).floor())).abs()
}

/// Phases that ascend, and the weights there.
struct Span {
    low: f32,
    high: f32,
    at_low: f32,
    at_high: f32,
}

impl Span {
    fn of(phases: [f32; 2], weights: [f32; 2]) -> Self {
        let ([from, to], [at_from, at_to]) = (phases, weights);
        if to >= from {
            return Self { low: from, high: to, at_low: at_from, at_high: at_to };
        }
        Self { low: to, high: from, at_low: at_to, at_high: at_from }
    }
}

/// Mean of `sin(pi t)`, t the distance from a zero, over [near, far] within [0, 1].
fn arch_part(near: f32, far: f32, near_weight: f32, far_weight: f32) -> f32 {
    let middle = 0.5 * (near + far);
    let half_width = 0.5 * (far - near);
    let tilt = far_weight - near_weight;
    let level = 0.5 * (near_weight + far_weight) * sine_of_turns(0.5 * middle) * (1.0 - sinc_complement(half_width));
    if tilt == 0.0 {
        return level;
    }
    level + 0.5 * tilt * cosine_of_turns(0.5 * middle) * bessel_one(half_width)
}

/// Mean of [`arch_at`].
pub fn arch_mean(phases: [f32; 2], weights: [f32; 2], alternate: bool) -> f32 {
    let Span { low, high, at_low, at_high } = Span::of(phases, weights);
    let (first, last) = (low.ceil(), high.floor());
    // Then the arch that begins at `first` does not count, and the one before it does.
    let first_is_odd = is_odd(first);
    if first > last {
        if alternate && !first_is_odd {
            return 0.0;
        }
        let (from_last, to_first) = (low - last, first - high);
        if from_last <= to_first {
            return arch_part(from_last, high - last, at_low, at_high);
        }
        return arch_part(to_first, first - low, at_high, at_low);
    }
    let (left, right) = (first - low, high - last);
    let width = (high - low).max(1e-30);
    let tilt = at_high - at_low;
    let mut sum = 0.0;
    if !alternate || first_is_odd {
        sum += left * arch_part(0.0, left, at_low + tilt * (left / width), at_low);
    }
    if !alternate || !is_odd(last) {
        sum += right * arch_part(0.0, right, at_high - tilt * (right / width), at_high);
    }
    // Whole arches, by the weight at the middle of their centres.
    let (mut count, mut center) = (last - first, 0.5 * (first + last));
    if alternate {
        let start = if first_is_odd { first + 1.0 } else { first };
        count = (0.5 * (last - start)).ceil();
        center = start + count - 0.5;
    }
    sum += FRAC_2_PI * count * (at_low + tilt * ((center - low) / width));
    sum / width
}

/// `max(0, 1 - |2 frac p - 1| / duty)`, duty in (0, 1].
pub fn triangle_at(phase: f32, duty: f32) -> f32 {
    let t = (phase - (phase + 0.5).floor()).abs();
    from_foot(t, duty).max(0.0) / (0.5 * duty)
}

/// Distance from where a slope begins, at a distance t from the valley: exact in f32 on either side.
fn from_foot(t: f32, duty: f32) -> f32 {
    if t > 0.25 { 0.5 * duty - (0.5 - t) } else { t - 0.5 * (1.0 - duty) }
}

/// The integral of `max(0, 1 - (1 - 2 t) / duty)`, t the distance from a valley, over [near, far] within [0, 1/2].
fn triangle_slope([near, far]: [f32; 2], [at_near, at_far]: [f32; 2], duty: f32) -> f32 {
    let (e_near, e_far) = (from_foot(near, duty), from_foot(far, duty));
    let width = far - near;
    if !(e_far > 0.0 && width > 0.0) {
        return 0.0;
    }
    let start = e_near.max(0.0);
    let (part, at_start) = if e_near < 0.0 {
        let part = e_far.min(width);
        (part, at_far - (at_far - at_near) * (part / width))
    } else {
        (width, at_near)
    };
    let sum = (at_start * start + at_far * e_far) / 3.0 + (at_start * e_far + at_far * start) / 6.0;
    part * sum / (0.5 * duty)
}

/// The integral over a span within the period that begins at `valley`.
fn triangle_period(span: &Span, valley: f32, duty: f32) -> f32 {
    let Span { low, high, at_low, at_high } = *span;
    let next = valley + 1.0;
    let width = (high - low).max(1e-30);
    let tilt = at_high - at_low;
    // Up to the peak and from it.
    let up = [(low - valley).min(0.5), (high - valley).min(0.5)];
    let down = [(next - high).min(0.5), (next - low).min(0.5)];
    let to_peak = ((up[1] - up[0]) / width).min(1.0);
    let from_peak = ((down[1] - down[0]) / width).min(1.0);
    triangle_slope(up, [at_low, at_low + tilt * to_peak], duty)
        + triangle_slope(down, [at_high, at_high - tilt * from_peak], duty)
}

/// Mean of [`triangle_at`].
pub fn triangle_mean(phases: [f32; 2], weights: [f32; 2], duty: f32) -> f32 {
    let span = Span::of(phases, weights);
    let Span { low, high, at_low, at_high } = span;
    let width = high - low;
    let has_width = width > 1e-30;
    if !has_width {
        return 0.5 * (at_low + at_high) * triangle_at(low, duty);
    }
    let (first, last) = (low.ceil(), high.floor());
    if first > last {
        return triangle_period(&span, last, duty) / width;
    }
    let tilt = at_high - at_low;
    let at_first = at_low + tilt * ((first - low) / width);
    let at_last = at_high - tilt * ((high - last) / width);
    let whole = 0.25 * duty * (last - first) * (at_first + at_last);
    let before = triangle_period(&Span { low, high: first, at_low, at_high: at_first }, first - 1.0, duty);
    let after = triangle_period(&Span { low: last, high, at_low: at_last, at_high }, last, duty);
    (before + whole + after) / width
}
