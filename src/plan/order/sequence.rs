//! Cells one after the other, each after all that are behind it.

use std::collections::HashSet;

use glam::DVec3;
use rayon::prelude::*;

use crate::plan::order::face::{Across, Face};
use crate::plan::order::{Vantage, VisibilityOrder};
use crate::tet::{Adjacency, TetId, TetMesh};

/// An order, and where it had to give in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sequenced {
    /// All cells.
    pub order: VisibilityOrder,
    /// How many circles of cells, each of which hides the next, were met: at most one pair each is in the wrong order.
    pub cycles: u64,
}

/// Seen through a gap: the boundary of one cell hides that of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Relation {
    pub front: u32,
    pub back: u32,
    /// In how many pixels.
    pub pixels: u32,
}

/// Which cells are behind which.
pub(super) struct Arrows<'a> {
    mesh: &'a TetMesh,
    adjacency: &'a Adjacency,
    vantage: Vantage,
    /// Of every cell, bit i: the neighbour opposite corner i is behind; bit 4 + i: rays enter or leave there.
    faces: Vec<u8>,
    /// By cell in front, then by the one behind.
    relations: Vec<Relation>,
    /// How much of the view a pixel fills.
    pixel_extent: f64,
}

impl<'a> Arrows<'a> {
    /// Those of all faces. Where the eye is in a face's plane, within rounding, neither cell hides the other.
    pub fn new(mesh: &'a TetMesh, adjacency: &'a Adjacency, vantage: Vantage) -> Self {
        let of_cell = |tet: usize| {
            let bit = |corner: usize| {
                let face = Face::new(mesh.tets[tet], corner);
                match Across::new(mesh, adjacency, tet, corner, &face) {
                    Across::Cell(..) => u8::from(face.side(mesh, &vantage) < 0) << corner,
                    Across::Open | Across::Fold(_) => 16 << corner,
                }
            };
            (0..4).fold(0, |bits, corner| bits | bit(corner))
        };
        let faces = (0..mesh.tets.len()).into_par_iter().map(of_cell).collect();
        Self { mesh, adjacency, vantage, faces, relations: Vec::new(), pixel_extent: 0.0 }
    }

    /// Adds what is seen through gaps; sorted, each pair once.
    pub fn with_relations(self, relations: Vec<Relation>, pixel_extent: f64) -> Self {
        Self { relations, pixel_extent, ..self }
    }

    /// Faces through which rays enter or leave, as cell and opposite corner.
    pub fn open_faces(&self) -> Vec<(u32, usize)> {
        let cells = (0..self.faces.len() as u32).into_par_iter().filter(|&tet| self.faces[tet as usize] >= 16);
        let corners = |tet: u32| (0..4).filter(move |i| self.faces[tet as usize] >> (4 + i) & 1 != 0);
        cells.flat_map_iter(|tet| corners(tet).map(move |corner| (tet, corner))).collect()
    }

    /// Cells one of whose open faces the eye sees: all others are behind some of them, but for circles and what is
    /// around an eye within the mesh. Farthest centroid first, so that what is not joined mostly comes in order.
    fn starts(&self) -> Vec<u32> {
        let is_seen = |&(tet, corner): &(u32, usize)| {
            Face::new(self.mesh.tets[tet as usize], corner).side(self.mesh, &self.vantage) > 0
        };
        let mut seen: Vec<u32> = self.open_faces().into_iter().filter(is_seen).map(|(tet, _)| tet).collect();
        seen.dedup();
        let distance = |&tet: &u32| {
            let centroid = 0.25 * self.mesh.corners(TetId(tet)).iter().sum::<DVec3>();
            match self.vantage.perspective {
                true => self.vantage.point.distance_squared(centroid),
                false => -self.vantage.point.dot(centroid),
            }
        };
        let distances: Vec<f64> = seen.iter().map(distance).collect();
        VisibilityOrder::by_keys(&distances).cells().iter().map(|&i| seen[i as usize]).collect()
    }

    fn relations_of(&self, front: u32) -> &[Relation] {
        let first = self.relations.partition_point(|r| r.front < front);
        let rest = &self.relations[first..];
        &rest[..rest.partition_point(|r| r.front == front)]
    }

    /// How much of the view shows a pair in the wrong order, if `back` is drawn after `front`: at most the whole face
    /// between them, and the pixels where a gap is.
    fn harm(&self, front: u32, back: u32) -> f64 {
        let of_face = |corner: usize| {
            let is_theirs = self.adjacency.neighbors[front as usize][corner] == back;
            let face = Face::new(self.mesh.tets[front as usize], corner);
            if is_theirs { self.vantage.extent(face.corners(self.mesh)) } else { 0.0 }
        };
        let relations = self.relations_of(front);
        let pixels = relations.binary_search_by_key(&back, |r| r.back).map_or(0, |i| relations[i].pixels);
        (0..4).map(of_face).sum::<f64>() + self.pixel_extent * f64::from(pixels)
    }

    /// Walks depth first: a cell follows all that are behind it. Faces take constant time each, relations are searched
    /// for, starts have to be sorted.
    ///
    /// Meeting a cell that the walk is still behind closes a circle. Its least harmful pair is given up: the walk goes
    /// back to the cell in front, and comes again to what it had begun since. Once the circles had as many cells as
    /// [`MOST_REPEATED`] meshes it is the pair just met instead, which costs nothing: time grows no faster than in
    /// a mesh without circles.
    pub fn sequence(&self) -> Sequenced {
        let mut walk = Walk::new(self);
        for start in self.starts() {
            walk.from(start);
        }
        // Those around an eye within the mesh, and in circles that hide one another from every start.
        for tet in 0..self.faces.len() as u32 {
            walk.from(tet);
        }
        Sequenced { cycles: walk.cycles, order: VisibilityOrder::of_permutation(walk.cells) }
    }
}

/// Cells of all circles that are looked at, in cells of the mesh.
const MOST_REPEATED: usize = 8;

/// Of a cell that has not been met.
const NEW: u32 = 0;
/// Of a cell that has been put in order; others hold their height in the stack.
const DONE: u32 = u32::MAX;

struct Walk<'a> {
    arrows: &'a Arrows<'a>,
    has_relations: bool,
    states: Vec<u32>,
    /// A cell, and how many of its arrows have been followed.
    stack: Vec<(u32, u32)>,
    cells: Vec<u32>,
    /// Pairs that were given up.
    given_up: HashSet<(u32, u32)>,
    /// Their cells behind, which no longer come before those in front.
    left: Vec<u32>,
    cycles: u64,
    /// Cells of circles that may still be looked at.
    budget: usize,
}

impl<'a> Walk<'a> {
    fn new(arrows: &'a Arrows<'a>) -> Self {
        let count = arrows.faces.len();
        Self {
            arrows,
            has_relations: !arrows.relations.is_empty(),
            states: vec![NEW; count],
            stack: Vec::new(),
            cells: Vec::with_capacity(count),
            given_up: HashSet::new(),
            left: Vec::new(),
            cycles: 0,
            budget: MOST_REPEATED * count,
        }
    }

    /// Puts a cell and all that is behind it in order, then what had to be left on the way.
    fn from(&mut self, start: u32) {
        let mut next = Some(start);
        while let Some(tet) = next {
            if self.states[tet as usize] == NEW {
                self.enter(tet);
                self.run();
            }
            next = self.left.pop();
        }
    }

    fn enter(&mut self, tet: u32) {
        self.stack.push((tet, 0));
        self.states[tet as usize] = self.stack.len() as u32;
    }

    fn run(&mut self) {
        while let Some(top) = self.stack.last_mut() {
            let tet = top.0;
            let Some(back) = next_behind(self.arrows, self.has_relations, top) else {
                self.states[tet as usize] = DONE;
                self.cells.push(tet);
                self.stack.pop();
                continue;
            };
            match self.states[back as usize] {
                DONE => {}
                _ if !self.given_up.is_empty() && self.given_up.contains(&(tet, back)) => {}
                NEW => self.enter(back),
                height => self.give_up(height as usize - 1),
            }
        }
    }

    /// The stack from here on is a circle.
    fn give_up(&mut self, bottom: usize) {
        self.cycles += 1;
        let (top, from) = (self.stack.len() - 1, self.stack[bottom].0);
        let (place, back) = self.least_harmful(bottom).unwrap_or((top, from));
        self.given_up.insert((self.stack[place].0, back));
        if place == top {
            return;
        }
        for (tet, _) in self.stack.drain(place + 1..) {
            self.states[tet as usize] = NEW;
        }
        self.left.push(back);
    }

    /// Of the pairs of a circle: where in the stack the cell in front is, and which is behind. `None` where the budget
    /// does not reach.
    fn least_harmful(&mut self, bottom: usize) -> Option<(usize, u32)> {
        let circle = &self.stack[bottom..];
        self.budget = self.budget.checked_sub(circle.len())?;
        let backs = circle[1..].iter().chain(&circle[..1]).map(|&(back, _)| back);
        let pairs = (bottom..).zip(circle.iter().zip(backs));
        let harms = pairs.map(|(place, (&(front, _), back))| (self.arrows.harm(front, back), place, back));
        harms.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place, back)| (place, back))
    }
}

/// The next cell behind the one on top of the stack.
fn next_behind(arrows: &Arrows<'_>, has_relations: bool, (tet, next): &mut (u32, u32)) -> Option<u32> {
    let behind = arrows.faces[*tet as usize];
    while *next < 4 {
        let corner = *next as usize;
        *next += 1;
        if behind >> corner & 1 != 0 {
            return Some(arrows.adjacency.neighbors[*tet as usize][corner]);
        }
    }
    // Only cells with open faces have relations.
    if !has_relations || behind < 16 {
        return None;
    }
    let relation = arrows.relations_of(*tet).get(*next as usize - 4)?;
    *next += 1;
    Some(relation.back)
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use super::*;
    use crate::tet::NO_TET;

    /// In so many pixels a cell is said to hide another.
    fn pixels(front: u32, back: u32) -> u32 {
        1 + (front ^ back) % 7
    }

    /// Cells that share nothing, and what they are said to hide.
    fn sequence_of(count: u32, hides: &[(u32, u32)], pixels: impl Fn(u32, u32) -> u32) -> (Vec<u32>, u64) {
        let mesh = TetMesh {
            vertices: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            center_in_data: DVec3::ZERO,
            data_per_mesh: 1.0,
            tets: vec![[0, 1, 2, 3]; count as usize].into(),
            scalar: vec![0.0; 4],
            gradient_magnitude: vec![0.0; 4],
            field: String::new(),
        };
        let neighbors = vec![[NO_TET; 4]; count as usize];
        let adjacency = Adjacency { neighbors, overfull_faces: Default::default() };
        let vantage = Vantage { point: DVec3::new(3.0, 2.0, 1.0), perspective: true };
        let mut relations: Vec<Relation> =
            hides.iter().map(|&(front, back)| Relation { front, back, pixels: pixels(front, back) }).collect();
        relations.sort_unstable();
        relations.dedup();
        let sequenced = Arrows::new(&mesh, &adjacency, vantage).with_relations(relations, 1.0).sequence();
        (sequenced.order.ranks(), sequenced.cycles)
    }

    /// Pairs out of a linear congruence (Knuth's MMIX).
    fn pairs(count: u32, many: usize, seed: u64) -> Vec<(u32, u32)> {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) % u64::from(count)) as u32
        };
        (0..many).map(|_| (next(), next())).filter(|(a, b)| a != b).collect()
    }

    fn wrong(ranks: &[u32], hides: &[(u32, u32)]) -> u64 {
        let mut hides = hides.to_vec();
        hides.sort_unstable();
        hides.dedup();
        hides.iter().filter(|&&(front, back)| ranks[front as usize] < ranks[back as usize]).count() as u64
    }

    #[test]
    fn every_circle_costs_at_most_one_pair_however_many_there_are() {
        for (count, many, seed) in [(10, 40, 1), (100, 250, 2), (1000, 8000, 3), (20_000, 60_000, 4)] {
            let hides = pairs(count, many, seed);
            let (ranks, cycles) = sequence_of(count, &hides, pixels);
            assert!(VisibilityOrder::new(ranks.clone()).is_ok(), "{count}");
            assert!(cycles > 0 && wrong(&ranks, &hides) <= cycles, "{count}: {cycles}");
            // Without circles all is right.
            let forward: Vec<_> = hides.iter().map(|&(a, b)| (a.min(b), a.max(b))).collect();
            let (ranks, cycles) = sequence_of(count, &forward, pixels);
            assert_eq!((wrong(&ranks, &forward), cycles), (0, 0), "{count}");
        }
    }

    #[test]
    fn the_least_harmful_pair_of_a_circle_is_given_up() {
        let circle: Vec<(u32, u32)> = (0..8).map(|i| (i, (i + 1) % 8)).collect();
        let (ranks, cycles) = sequence_of(8, &circle, pixels);
        let given_up: Vec<_> = circle.iter().filter(|&&(a, b)| ranks[a as usize] < ranks[b as usize]).collect();
        assert_eq!((cycles, given_up.len()), (1, 1));
        let pixels = |&(a, b): &(u32, u32)| pixels(a, b);
        assert_eq!(Some(pixels(given_up[0])), circle.iter().map(pixels).min());
    }

    /// A chain whose last cell hides all others: to look at each circle in full would take minutes.
    #[test]
    fn many_long_circles_take_no_longer_than_a_mesh() {
        const COUNT: u32 = 50_000;
        let last = COUNT - 1;
        let hides: Vec<_> = (0..last).flat_map(|i| [(i, i + 1), (last, i)]).collect();
        let start = Instant::now();
        let (ranks, cycles) = sequence_of(COUNT, &hides, |front, _| if front == last { 1 } else { 9 });
        assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
        assert_eq!((cycles, wrong(&ranks, &hides)), (last.into(), last.into()));
    }
}
