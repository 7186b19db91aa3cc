//! From cell to cell along one ray.
//!
//! Why no walk gets lost: seen along the ray, a cell's faces cover the origin either not at all, or once on the way in
//! and once on the way out. The signs of edges are those of exact arithmetic on the vertices' rounded places, with
//! ties broken as if by an infinitesimal motion, so that this holds whatever rounding has made of the cells, turned
//! over ones included. Then cells around the origin are links of chains, each with one before and one behind: a walk
//! from the boundary ends at the boundary, enters no cell twice, and is joined by no other.

use glam::{DVec2, Vec4};

use crate::cpu::axes::RayAxes;
use crate::tet::{LinkedMesh, Side};

/// What happened to rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Cells entered.
    pub steps: u64,
    /// Steps whose exit lies before their entry.
    pub repaired: u64,
    /// Walks that were given up, since they entered more cells than there are: what lies behind is missing.
    pub lost: u64,
}

impl Counts {
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { steps: self.steps + other.steps, repaired: self.repaired + other.repaired, lost: self.lost + other.lost }
    }
}

/// What is done with the segments of a ray.
pub trait Sink {
    /// Whether fields are wanted for a cell.
    fn wants(&self, cell: u32) -> bool;

    /// The segment of a cell, (scalar, gradient magnitude) at its ends, and its length in mesh units (above 0). Returns
    /// whether the rest of the ray is wanted.
    fn segment(&mut self, front: [f32; 2], back: [f32; 2], length: f32) -> bool;
}

/// A ray on a face through which it enters a cell.
#[derive(Clone, Copy, Debug)]
pub struct Walk {
    cell: u32,
    /// The cell's corner that is not on the face.
    new: u32,
    triangle: Triangle,
    /// Distance along the ray up to which all is done.
    reached: f32,
    /// Distance of the last face that was not seen edge-on, and the fields there.
    depth: f32,
    at: [f32; 2],
}

/// A face seen along the ray, counter-clockwise around the origin.
#[derive(Clone, Copy, Debug)]
struct Triangle {
    corners: [Corner; 3],
    /// Which of the face's corners each is, in ascending order.
    ranks: [u32; 3],
    gradients: [f32; 3],
    /// Twice the area of the triangle of the origin and the edge opposite each corner. Exact but for one rounding: the
    /// products of f32 numbers are f64 numbers.
    edges: [f64; 3],
}

#[derive(Clone, Copy, Debug)]
struct Corner {
    /// Across the ray.
    place: DVec2,
    /// In its last two components the distance along the ray, and the scalar.
    values: Vec4,
}

impl Corner {
    #[inline(always)]
    fn new(mesh: &LinkedMesh, axes: &RayAxes, vertex: u32) -> Self {
        let values = axes.apply(mesh.vertices[vertex as usize]);
        Self { place: DVec2::new(f64::from(values.x), f64::from(values.y)), values }
    }

    /// `self x other`: exactly the negative of `other x self`, and of the sign that exact arithmetic gives.
    #[inline(always)]
    fn cross(&self, other: &Self) -> f64 {
        self.place.x * other.place.y - self.place.y * other.place.x
    }

    /// Whether `self x other`, which is `value`, counts as positive. `before`: this one's vertex is the one of smaller id.
    fn turns_left_to(&self, value: f64, other: &Self, before: bool) -> bool {
        value > 0.0 || (value == 0.0 && self.tie(other, before))
    }

    /// Where the edge meets the ray: as if the ray were moved along the first axis by an infinitesimal, and along the second
    /// by one of that; of corners at one place, as if that of the larger id lay to the left by less still. Exactly one
    /// of (a, b) and (b, a) turns left.
    #[cold]
    fn tie(&self, other: &Self, before: bool) -> bool {
        let (a, b) = (self.place, other.place);
        a.y > b.y || (a.y == b.y && (b.x > a.x || (a.x == b.x && before)))
    }
}

impl Triangle {
    /// Depth and fields where the ray is on the face; none where that is seen edge-on.
    #[inline(always)]
    fn at<const BIVARIATE: bool>(&self) -> Option<(f32, [f32; 2])> {
        let [u, v, w] = self.edges;
        let sum = u + v + w;
        if sum <= 1e-200 {
            return None;
        }
        let scale = 1.0 / sum;
        let [u, v, w] = [u * scale, v * scale, w * scale].map(|x| x as f32);
        let [a, b, c] = &self.corners;
        let mean = a.values * u + b.values * v + c.values * w;
        let gradient = match BIVARIATE {
            true => self.gradients[0] * u + self.gradients[1] * v + self.gradients[2] * w,
            false => 0.0,
        };
        Some((mean.z, [mean.w, gradient]))
    }
}

/// The corner that the fourth vertex replaces, by which of its edges (to corner 0, 1, 2 in bits 0, 1, 2) turn left. All or
/// none never do.
const REPLACED: [usize; 8] = [2, 2, 0, 0, 1, 2, 1, 2];
/// The corners after each, counter-clockwise.
const OTHERS: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];

/// Which edges from `new`, the corner of that number, to those of `numbers` turn left, where some meet the ray.
#[cold]
fn ties(new: &Corner, number: u32, to: [f64; 3], corners: &[Corner; 3], numbers: [u32; 3]) -> [usize; 3] {
    [0, 1, 2].map(|i| usize::from(new.turns_left_to(to[i], &corners[i], number < numbers[i])))
}

/// The number of a cell's corner, of all but `without`, from its rank among them; and back.
#[inline(always)]
fn number_of(rank: u32, without: u32) -> u32 {
    rank + u32::from(rank >= without)
}

#[inline(always)]
fn rank_of(number: u32, without: u32) -> u32 {
    number - u32::from(number > without)
}

impl Walk {
    /// On a cell's side, ready to enter. What lies before `start` is not seen.
    pub fn enter<const BIVARIATE: bool>(mesh: &LinkedMesh, axes: &RayAxes, side: Side, start: f32) -> Self {
        let (vertices, new) = (mesh.cells[side.cell as usize].vertices, side.opposite);
        let ranks = side.ranks();
        let ids = ranks.map(|rank| vertices[number_of(rank, new) as usize]);
        let corners = ids.map(|id| Corner::new(mesh, axes, id));
        let gradients = if BIVARIATE { ids.map(|id| mesh.gradients[id as usize]) } else { [0.0; 3] };
        let [a, b, c] = &corners;
        let triangle = Triangle { edges: [b.cross(c), c.cross(a), a.cross(b)], corners, ranks, gradients };
        let first = (a.values.z, [a.values.w, gradients[0]]);
        let (depth, at) = triangle.at::<BIVARIATE>().unwrap_or(first);
        Self { cell: side.cell, new, triangle, reached: depth.max(start), depth, at }
    }

    /// Whether the ray passes inside the face, in the direction into the cell, by the signs that edges have in the walk.
    pub fn is_inside(&self) -> bool {
        let Triangle { corners, edges, ranks, .. } = &self.triangle;
        [(1, 2), (2, 0), (0, 1)]
            .into_iter()
            .zip(edges)
            .all(|((a, b), &value)| corners[a].turns_left_to(value, &corners[b], ranks[a] < ranks[b]))
    }

    /// Distance along the ray up to which all is done.
    pub fn reached(&self) -> f32 {
        self.reached
    }

    /// Where the ray is on the face.
    pub fn depth(&self) -> f32 {
        self.depth
    }

    /// Walks on until the boundary is reached, true, or the sink has enough, false. The walk must be inside its face.
    #[inline]
    pub fn run<S: Sink, const BIVARIATE: bool>(
        &mut self,
        mesh: &LinkedMesh,
        axes: &RayAxes,
        sink: &mut S,
        counts: &mut Counts,
    ) -> bool {
        let Self { mut cell, mut new, mut triangle, mut reached, mut depth, mut at } = *self;
        // A walk enters no cell twice: this bound guards against a mesh that is none.
        let (mut steps, most) = (0, mesh.cells.len());
        let passed = loop {
            if steps == most {
                counts.lost += 1;
                break true;
            }
            steps += 1;
            let here = &mesh.cells[cell as usize];
            let vertex = here.vertices[new as usize];
            let corner = Corner::new(mesh, axes, vertex);
            let corners = &triangle.corners;
            let to = [corner.cross(&corners[0]), corner.cross(&corners[1]), corner.cross(&corners[2])];
            let numbers = triangle.ranks.map(|rank| number_of(rank, new));
            // No branches here: which way a ray goes cannot be predicted.
            let mut turns = to.map(|value| usize::from(value > 0.0));
            if (to[0] == 0.0) | (to[1] == 0.0) | (to[2] == 0.0) {
                turns = ties(&corner, new, to, corners, numbers);
            }
            let replaced = REPLACED[turns[0] | turns[1] << 1 | turns[2] << 2];
            let [second, third] = OTHERS[replaced];
            let left = numbers[replaced];
            triangle.ranks = numbers.map(|number| rank_of(number, left));
            triangle.ranks[replaced] = rank_of(new, left);
            let wanted = sink.wants(cell);
            if BIVARIATE {
                triangle.gradients[replaced] = mesh.gradients[vertex as usize];
            }
            triangle.corners[replaced] = corner;
            triangle.edges[second] = -to[third];
            triangle.edges[third] = to[second];
            let link = here.links[left as usize];
            if let Some((new_depth, new_at)) = triangle.at::<BIVARIATE>() {
                if new_depth > reached {
                    if wanted {
                        let mut front = at;
                        if depth < reached {
                            // Some of the segment is done, or not seen.
                            let x = (reached - depth) / (new_depth - depth);
                            front = [0, 1].map(|i| at[i] + x * (new_at[i] - at[i]));
                        }
                        if !sink.segment(front, new_at, new_depth - reached) {
                            break false;
                        }
                    }
                    reached = new_depth;
                }
                counts.repaired += u64::from(new_depth < depth);
                (depth, at) = (new_depth, new_at);
            }
            if link == LinkedMesh::NO_LINK {
                break true;
            }
            (cell, new) = (link >> 2, link & 3);
        };
        counts.steps += steps as u64;
        *self = Self { cell, new, triangle, reached, depth, at };
        passed
    }
}
