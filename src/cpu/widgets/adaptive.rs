//! Sums of widgets of several colours, integrated to a tolerance of the colour: exact depths, dyadic bisection front to
//! back where a proven bound of the colour's error says so. Twin of `shaders/shared/adaptive.wgsl`, which tells the whys;
//! the opacity is exact whatever is done.

use glam::Vec4;

use crate::cpu::segment::{Medium, Seen};
use crate::cpu::widgets::any::AnyWidget;
use crate::cpu::widgets::line::Line;
use crate::cpu::widgets::optics::{attenuation, emission_weights, phi_one};

/// Widgets at most: what is kept of each lies on the stack.
pub const MOST_WIDGETS: usize = 64;

/// The bound over-estimates: with this factor the worst of 3,000 cases errs by 0.63 of the tolerance.
const SLACK: f32 = 1.4;
/// Pieces are no shorter than 1 / FINEST.
const FINEST: u32 = 65_536;
/// Pieces tried, after which the rest is one piece.
const MOST_TRIES: u32 = 2_048;

/// A sum of at most [`MOST_WIDGETS`] widgets whose colours differ.
#[derive(Clone, Debug, Default)]
pub struct AdaptiveWidgets {
    /// In no order.
    pub widgets: Vec<AnyWidget>,
    /// Largest error of a channel in one segment, for colours up to 1.
    pub tolerance: f32,
}

impl Medium for AdaptiveWidgets {
    #[inline]
    fn segment(&self, front: [f32; 2], back: [f32; 2], length: f32) -> Seen {
        self.pieces(&Line { front: front.into(), back: back.into(), length }).0
    }
}

impl AdaptiveWidgets {
    /// What is seen of a segment, and the pieces that it was cut into.
    pub fn pieces(&self, line: &Line) -> (Seen, u32) {
        let mut pieces = Pieces { widgets: &self.widgets, line, shares: [Share::default(); MOST_WIDGETS] };
        let mut color = Vec4::ZERO;
        let mut opacity_of_all = 0.0;
        // Of what lies before `at`, which is in units of 1 / FINEST.
        let mut seen = 1.0;
        let (mut at, mut step) = (0, FINEST);
        // Sum of the bounds of the pieces taken, in units of the tolerance.
        let mut spent = 0.0;
        let mut taken = 0;
        for tries in 0..=MOST_TRIES {
            let is_last = tries == MOST_TRIES;
            if is_last {
                step = FINEST - at;
            }
            let [start, end] = [at, at + step].map(|x| x as f32 / FINEST as f32);
            let depths = pieces.measure([start, end]);
            let opacity = depths.total * phi_one(depths.total);
            if tries == 0 {
                opacity_of_all = opacity;
            }
            // What pieces in front left over may be spent, too.
            let allowed = SLACK * self.tolerance * (end - start).sqrt().max(end.sqrt() - spent);
            let visible = seen * opacity;
            let mut bound = visible * (0.5 * depths.total * depths.spread).min(depths.reach).max_element();
            let is_divisible = step > 1 && !is_last;
            if bound > allowed && is_divisible {
                let range = pieces.color_range([start, end]);
                bound = bound.min(visible * 0.25 * depths.total * range.max_element());
                if bound > allowed {
                    step >>= 1;
                    continue;
                }
            }
            color += seen * pieces.emission([start, end], &depths);
            seen *= attenuation(depths.total);
            spent += bound / self.tolerance;
            taken += 1;
            at += step;
            if at >= FINEST || seen < 1e-7 {
                break;
            }
            // As long as alignment allows.
            step = at & at.wrapping_neg();
        }
        (color.with_w(opacity_of_all), taken)
    }
}

/// A piece of a segment, of which the widgets' exact depths are known.
struct Pieces<'a> {
    widgets: &'a [AnyWidget],
    line: &'a Line,
    /// Of the widgets, in their order.
    shares: [Share; MOST_WIDGETS],
}

/// A widget in a piece.
#[derive(Clone, Copy, Debug, Default)]
struct Share {
    /// Its optical depth.
    depth: f32,
    /// Where in the segment it is.
    part: [f32; 2],
}

/// A piece as its widgets' depths show it.
struct Depths {
    total: f32,
    /// Mean colour, weighted by depth.
    color: Vec4,
    /// `sum_k f_k |c_k - color|`, f_k the widget's share of the depth.
    spread: Vec4,
    /// `max_k |c_k - color|` over widgets that have depth.
    reach: Vec4,
}

impl Pieces<'_> {
    /// Widgets that have depth.
    fn visible(&self) -> impl Iterator<Item = (&AnyWidget, &Share)> {
        self.widgets.iter().zip(&self.shares).filter(|(_, share)| share.depth > 0.0)
    }

    /// The depths of all widgets, and sums of them.
    fn measure(&mut self, piece: [f32; 2]) -> Depths {
        let (mut total, mut emission) = (0.0, Vec4::ZERO);
        for (widget, share) in self.widgets.iter().zip(&mut self.shares) {
            let part = widget.active_part(self.line, piece);
            let depth = if part[1] > part[0] { widget.part_depth(self.line, part) } else { 0.0 };
            *share = Share { depth, part };
            total += depth;
            emission += depth * widget.plain.color;
        }
        let mut depths = Depths { total: 0.0, color: Vec4::ZERO, spread: Vec4::ZERO, reach: Vec4::ZERO };
        // So that NaN is nothing, too.
        let is_seen = total > 0.0;
        if !is_seen {
            return depths;
        }
        depths.total = total;
        depths.color = emission / total;
        for (widget, share) in self.visible() {
            let off = (widget.plain.color - depths.color).abs();
            depths.spread += share.depth * off;
            depths.reach = depths.reach.max(off);
        }
        depths.spread /= total;
        depths
    }

    /// Bounds of the local colour: each widget's extinction lies between what it is at least and at most on the piece; the
    /// extremes of the weighted mean put every colour beyond a threshold at one end and the others at the other. Fixed-point
    /// steps find the threshold; were they too few, the widgets' own extremes bound it.
    fn color_range(&self, piece: [f32; 2]) -> Vec4 {
        let mut ranges = [[0.0; 2]; MOST_WIDGETS];
        let (mut low, mut high) = (Vec4::splat(1e30), Vec4::splat(-1e30));
        for ((widget, share), range) in self.visible().zip(&mut ranges) {
            let part = share.part;
            let [mut least, most] = widget.range(self.line.at(part[0]), self.line.at(part[1]));
            if part[0] > piece[0] || part[1] < piece[1] {
                least = 0.0;
            }
            // A hair wider than computed.
            let extinction = widget.plain.extinction.min(1e25);
            *range = [extinction * least * 0.999_999, extinction * most * 1.000_001];
            low = low.min(widget.plain.color);
            high = high.max(widget.plain.color);
        }
        // From the widgets' extremes of the other side: every step moves outwards.
        let (mut most, mut least) = (low, high);
        for _ in 0..8 {
            let (mut most_emission, mut most_extinction) = (Vec4::ZERO, Vec4::splat(1e-30));
            let (mut least_emission, mut least_extinction) = (Vec4::ZERO, Vec4::splat(1e-30));
            for ((widget, _), range) in self.visible().zip(&ranges) {
                let color = widget.plain.color;
                let [thin, thick] = range.map(Vec4::splat);
                let for_most = Vec4::select(color.cmpgt(most), thick, thin);
                let for_least = Vec4::select(color.cmplt(least), thick, thin);
                most_emission += for_most * color;
                most_extinction += for_most;
                least_emission += for_least * color;
                least_extinction += for_least;
            }
            let next_most = most.max(most_emission / most_extinction);
            let next_least = least.min(least_emission / least_extinction);
            let moved = (next_most - most).max(least - next_least).max_element();
            (most, least) = (next_most, next_least);
            if moved < 1e-4 {
                return most - least;
            }
        }
        high - low
    }

    /// Emission that leaves the front of a piece: exact depths, and every widget linear between its extinctions at the ends,
    /// scaled to its depth.
    fn emission(&self, piece: [f32; 2], depths: &Depths) -> Vec4 {
        // One colour, or little that is seen.
        if depths.spread.max_element() * depths.total.min(1.0) < 1e-6 {
            return depths.color * (depths.total * phi_one(depths.total));
        }
        let (mut front, mut back) = (0.0, 0.0);
        let (mut front_emission, mut back_emission) = (Vec4::ZERO, Vec4::ZERO);
        for (widget, &Share { depth, part }) in self.visible() {
            let at_front = if part[0] <= piece[0] { widget.at(self.line.at(piece[0])) } else { 0.0 };
            let at_back = if part[1] >= piece[1] { widget.at(self.line.at(piece[1])) } else { 0.0 };
            let sum = at_front + at_back;
            // Where the ends say nothing of the depth, it is spread evenly.
            let [a, b] = if sum > 1e-20 { [at_front, at_back].map(|end| 2.0 * end / sum * depth) } else { [depth; 2] };
            front += a;
            back += b;
            front_emission += a * widget.plain.color;
            back_emission += b * widget.plain.color;
        }
        let [of_front, of_back] = emission_weights(front, back);
        of_front * front_emission + of_back * back_emission
    }
}
