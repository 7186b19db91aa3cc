//! A face through which a ray enters a cell, and which way the ray goes from there.

use glam::{Vec4, Vec4Swizzles as _};

use crate::cpu::axes::RayAxes;
use crate::tet::{LinkedMesh, Side};

/// A face seen along the ray, counter-clockwise around it.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// Four times the cell, plus its corner that is not on the face.
    pub link: u32,
    /// The vertex there.
    pub new: u32,
    /// Which of the face's corners each is: one of [`ORDERS`].
    pub order: u32,
    /// Two coordinates across the ray, the distance along it, and the scalar.
    pub corners: [Vec4; 3],
    /// Gradient magnitudes; 0 where these do not matter.
    pub gradients: [f32; 3],
    /// Twice the area of the triangle of the ray and the edge opposite each corner.
    pub edges: [f32; 3],
    /// Distance along the ray where it meets the face, and the fields there.
    pub depth: f32,
    pub at: [f32; 2],
    /// Whether the ray passes inside the face, in the direction into the cell, by the signs that edges have in the walk.
    pub is_inside: bool,
}

impl Face {
    /// A cell's side.
    pub fn new<const BIVARIATE: bool>(mesh: &LinkedMesh, axes: &RayAxes, side: Side) -> Self {
        let (vertices, new) = (mesh.cells[side.cell as usize].vertices, side.opposite);
        let ranks = side.ranks();
        let ids = ranks.map(|rank| vertices[number_of(rank, new) as usize]);
        let corners = ids.map(|id| axes.apply(mesh.vertices[id as usize]));
        let gradients = if BIVARIATE { ids.map(|id| mesh.gradients[id as usize]) } else { [0.0; 3] };
        let pairs = [(1, 2), (2, 0), (0, 1)];
        let places = corners.map(|corner| corner.xy().to_array());
        let edges = pairs.map(|(a, b)| cross(places[a], places[b]));
        let is_inside = pairs.into_iter().all(|(a, b)| turns_left(places[a], places[b], ranks[a] < ranks[b]));
        let sum: f64 = edges.iter().sum();
        // Seen edge-on, it is met anywhere.
        let weights = if sum > 0.0 { edges.map(|edge| (edge / sum) as f32) } else { [1.0, 0.0, 0.0] };
        let mean = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
        let gradient = gradients[0] * weights[0] + gradients[1] * weights[1] + gradients[2] * weights[2];
        Self {
            link: side.cell << 2 | new,
            new: vertices[new as usize],
            order: if side.flipped { 1 } else { 0 },
            corners,
            gradients,
            edges: edges.map(|edge| edge as f32),
            depth: mean.z,
            at: [mean.w, gradient],
            is_inside,
        }
    }
}

/// `a x b` of two places across a ray. Of the sign of exact arithmetic: products of f32 numbers are f64 numbers.
#[inline(always)]
fn cross(a: [f32; 2], b: [f32; 2]) -> f64 {
    let [a, b] = [a, b].map(|place| place.map(f64::from));
    a[0] * b[1] - a[1] * b[0]
}

/// Whether `a x b` counts as positive: where the edge meets the ray, as if that were moved along the first axis by an
/// infinitesimal, and along the second by one of that; of corners at one place, as if that of the larger id lay to the
/// left by less still. Exactly one of (a, b) and (b, a) turns left. `before`: the vertex of `a` is the one of smaller id.
pub fn turns_left(a: [f32; 2], b: [f32; 2], before: bool) -> bool {
    let value = cross(a, b);
    value > 0.0 || (value == 0.0 && (a[1] > b[1] || (a[1] == b[1] && (b[0] > a[0] || (a[0] == b[0] && before)))))
}

/// The ranks that a face's corners may have among its corners in ascending order. [`Side::ranks`] are the first two.
pub const ORDERS: [[u32; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// The number of a cell's corner, of all but `without`, from its rank among them; and back.
#[inline(always)]
pub const fn number_of(rank: u32, without: u32) -> u32 {
    rank + (rank >= without) as u32
}

const fn rank_of(number: u32, without: u32) -> u32 {
    number - (number > without) as u32
}

/// Leaving a cell: by 12 times the order of its face of entry, plus 3 times the corner `new` that is not on that, plus the
/// face's corner that is not on the face of exit. In the lowest two bits the number of that corner in the cell, above
/// them 12 times the order of the face of exit. As many as any seven bits are, so that no index is beyond.
pub const EXITS: [u8; 128] = exits();

const fn exits() -> [u8; 128] {
    let mut exits = [0; 128];
    let mut index = 0;
    while index < 72 {
        let (order, new, replaced) = (index / 12, (index / 3 % 4) as u32, index % 3);
        let ranks = ORDERS[order];
        let left = number_of(ranks[replaced], new);
        let mut after = [0; 3];
        let mut i = 0;
        while i < 3 {
            let number = if i == replaced { new } else { number_of(ranks[i], new) };
            after[i] = rank_of(number, left);
            i += 1;
        }
        exits[index] = (left | (12 * order_of(after)) << 2) as u8;
        index += 1;
    }
    exits
}

const fn order_of(ranks: [u32; 3]) -> u32 {
    let mut order = 0;
    while ORDERS[order as usize][0] != ranks[0] || ORDERS[order as usize][1] != ranks[1] {
        order += 1;
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the table says, told from the corners' numbers.
    #[test]
    fn exits_tell_which_corner_each_is() {
        for (order, ranks) in (0..).zip(ORDERS) {
            assert_eq!(order_of(ranks), order);
            for new in 0..4 {
                for replaced in 0..3_usize {
                    let on_face: Vec<u32> = (0..4).filter(|&number| number != new).collect();
                    let mut corners = ranks.map(|rank| on_face[rank as usize]);
                    let left = std::mem::replace(&mut corners[replaced], new);
                    let mut ascending = corners;
                    ascending.sort_unstable();
                    let exit = u32::from(EXITS[(12 * order + 3 * new) as usize + replaced]);
                    assert_eq!(exit & 3, left);
                    let after = ORDERS[(exit >> 2) as usize / 12];
                    assert_eq!(after.map(|rank| ascending[rank as usize]), corners);
                }
            }
        }
    }

    #[test]
    fn orders_begin_with_those_of_sides() {
        for (flipped, order) in [(false, 0), (true, 1)] {
            assert_eq!(Side { cell: 0, opposite: 0, flipped }.ranks(), ORDERS[order]);
        }
    }

    /// Ties included, an edge turns left seen from exactly one of its ends; and where it does, a hair decides.
    #[test]
    fn edges_turn_one_way() {
        let places =
            [[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 2.0], [0.0, -2.0], [1.0, 1.0], [0.1, 0.1], [-3.0, -3.0]];
        for a in places {
            for b in places {
                assert_ne!(turns_left(a, b, true), turns_left(b, a, false), "{a:?}, {b:?}");
            }
        }
        assert!(turns_left([1.0, 0.0], [1.0, 1e-30], true) && !turns_left([1.0, 0.0], [1.0, -1e-30], true));
    }
}
