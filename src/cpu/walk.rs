//! From cell to cell, along the rays of all lanes at once.
//!
//! Why no walk gets lost: seen along the ray, a cell's faces cover the origin either not at all, or once on the way in
//! and once on the way out. The signs of edges are those of exact arithmetic on the vertices' rounded places, with
//! ties broken as if by an infinitesimal motion, so that this holds whatever rounding has made of the cells, turned
//! over ones included. Then cells around the origin are links of chains, each with one before and one behind: a walk
//! from the boundary ends at the boundary, enters no cell twice, and is joined by no other.
//!
//! A lane's arithmetic is that of [`RayAxes::apply`], operation by operation, so that a vertex has one place along a ray.
//! Edges are evaluated in f32 with a relative error of some ulp, so that their signs are those of exact arithmetic, but for
//! zeros: ties are rare, and broken lane by lane.

use glam::Vec4;
use prefetch_index::prefetch_index;
use pulp::Simd;

use crate::cpu::axes::RayAxes;
use crate::cpu::corner::Corner;
use crate::cpu::face::{EXITS, Face, ORDERS, number_of, turns_left};
use crate::cpu::lanes::{Floats, MOST_LANES, Mask, Words, record_order};
use crate::cpu::segment::Segments;
use crate::cpu::sink::Sink;
use crate::tet::{Crossing, LinkedMesh};

/// The mesh, as rays walk through it.
#[derive(Clone, Copy)]
pub struct Ground<'a> {
    pub crossings: &'a [Crossing],
    pub vertices: &'a [Vec4],
    pub gradients: &'a [f32],
}

impl<'a> Ground<'a> {
    pub fn of(mesh: &'a LinkedMesh) -> Self {
        Self { crossings: mesh.crossings(), vertices: &mesh.vertices, gradients: &mesh.gradients }
    }
}

/// One walk a lane, each on a face through which it enters a cell.
#[derive(Clone, Copy)]
pub struct Walks<S: Simd> {
    simd: S,
    /// Lanes that have a walk.
    pub live: Mask<S>,
    /// Rows of the axes, and offsets.
    axes: [[Floats<S>; 4]; 3],
    corners: [Corner<S>; 3],
    /// Of the triangles of the origin and the edge opposite each corner, twice the area.
    edges: [Floats<S>; 3],
    /// The vertex that is not on the face.
    new: Words<S>,
    /// See [`Face`].
    links: Words<S>,
    /// Twelve times [`Face::order`].
    orders: Words<S>,
    /// Distance along the ray up to which all is done.
    reached: Floats<S>,
    /// Distance of the last face that was not seen edge-on, and the fields there.
    depth: Floats<S>,
    at: [Floats<S>; 2],
    /// Cells entered.
    steps: Words<S>,
    /// Of them, those whose exit lies before their entry.
    repaired: Words<S>,
}

/// A walk that has ended.
#[derive(Clone, Copy, Debug)]
pub struct Ended {
    /// Distance along the ray of the face where it ended.
    pub exit: f32,
    /// Cells entered.
    pub steps: u32,
    /// Of them, those whose exit lies before their entry.
    pub repaired: u32,
    /// It entered as many cells as there are, and was given up.
    pub is_lost: bool,
}

impl<S: Simd> Walks<S> {
    /// None yet.
    #[inline(always)]
    pub fn none(simd: S) -> Self {
        let (zero, word) = (Floats::splat(simd, 0.0), Words::splat(simd, 0));
        let corner = Corner { x: zero, y: zero, z: zero, scalar: zero, gradient: zero };
        Self {
            simd,
            live: Mask::none(simd),
            axes: [[zero; 4]; 3],
            corners: [corner; 3],
            edges: [zero; 3],
            new: word,
            links: word,
            orders: word,
            reached: zero,
            depth: zero,
            at: [zero; 2],
            steps: word,
            repaired: word,
        }
    }

    /// A lane's ray.
    #[inline(always)]
    pub fn set_axes(&mut self, lane: usize, axes: &RayAxes) {
        for (row, values) in self.axes.iter_mut().zip(axes.rows()) {
            for (lanes, value) in row.iter_mut().zip(values) {
                lanes.values_mut()[lane] = value;
            }
        }
    }

    /// A walk through a face, inside which the lane's ray passes. What lies before `start` is not seen.
    #[inline(always)]
    pub fn enter(&mut self, lane: usize, face: &Face, start: f32) {
        for (i, corner) in self.corners.iter_mut().enumerate() {
            let [x, y, z, scalar] = face.corners[i].to_array();
            corner.x.values_mut()[lane] = x;
            corner.y.values_mut()[lane] = y;
            corner.z.values_mut()[lane] = z;
            corner.scalar.values_mut()[lane] = scalar;
            corner.gradient.values_mut()[lane] = face.gradients[i];
            self.edges[i].values_mut()[lane] = face.edges[i];
        }
        self.new.values_mut()[lane] = face.new;
        self.links.values_mut()[lane] = face.link;
        self.orders.values_mut()[lane] = 12 * face.order;
        self.reached.values_mut()[lane] = face.depth.max(start);
        self.depth.values_mut()[lane] = face.depth;
        self.at[0].values_mut()[lane] = face.at[0];
        self.at[1].values_mut()[lane] = face.at[1];
        self.steps.values_mut()[lane] = 0;
        self.repaired.values_mut()[lane] = 0;
        self.live = self.live | Mask::from_bits(self.simd, 1 << lane);
    }

    /// What a lane's walk has done.
    #[inline(always)]
    pub fn ended(&self, ground: &Ground<'_>, lane: usize) -> Ended {
        let steps = self.steps.values()[lane];
        let is_lost = steps as usize >= ground.crossings.len() && self.links.values()[lane] != LinkedMesh::NO_LINK;
        let repaired = self.repaired.values()[lane];
        Ended { exit: self.depth.values()[lane], steps, repaired, is_lost }
    }

    /// Walks on until some reach the boundary, or the sink has enough of them: these end.
    #[inline(always)]
    pub fn run<K: Sink<S>, const BIVARIATE: bool>(&mut self, ground: &Ground<'_>, sink: &mut K) -> Mask<S> {
        // Copies, whose addresses nobody has, can be in registers.
        let (mut walks, mut to) = (*self, *sink);
        let ended = loop {
            let ended = walks.step::<K, BIVARIATE>(ground, &mut to);
            if ended.any() {
                break ended;
            }
        };
        walks.live = walks.live & !ended;
        (*self, *sink) = (walks, to);
        ended
    }

    /// Through one cell. The lanes whose walks end.
    #[inline(always)]
    pub fn step<K: Sink<S>, const BIVARIATE: bool>(&mut self, ground: &Ground<'_>, sink: &mut K) -> Mask<S> {
        // Lanes without a walk follow any cells.
        self.links = self.live.words(self.links, self.word(0));
        let entered = self.links;
        let corner = self.new_corner::<BIVARIATE>(ground);
        let (replaced, beside) = self.turn(&corner);
        self.exchange::<BIVARIATE>(corner, replaced, beside);
        let number = replaced[0].words(self.word(0), replaced[1].words(self.word(1), self.word(2)));
        self.follow::<BIVARIATE>(ground, number);
        self.steps = self.steps + self.word(1);
        let most = self.word(ground.crossings.len() as u32);
        let done = self.links.equals(self.word(LinkedMesh::NO_LINK)) | self.steps.equals(most);
        let wanted = self.segments::<K, BIVARIATE>(sink, entered);
        self.live & (done | !wanted)
    }

    #[inline(always)]
    fn word(&self, value: u32) -> Words<S> {
        Words::splat(self.simd, value)
    }

    /// The corner that is not on the face, as seen along the ray.
    #[inline(always)]
    fn new_corner<const BIVARIATE: bool>(&self, ground: &Ground<'_>) -> Corner<S> {
        let record = record_order(self.simd);
        let mut vertices = [[0.0; 4]; MOST_LANES];
        let mut gradient = self.reached;
        for lane in 0..S::F32_LANES {
            let vertex = self.new.values()[lane] as usize;
            vertices[record[lane]] = ground.vertices[vertex].to_array();
            if BIVARIATE {
                gradient.values_mut()[lane] = ground.gradients[vertex];
            }
        }
        let [a, b, c, scalar] = Floats::records(self.simd, &vertices);
        let place = |[x, y, z, offset]: [Floats<S>; 4]| (x * a + y * b) + (z * c + offset);
        let [x, y, z] = self.axes;
        Corner { x: place(x), y: place(y), z: place(z), scalar, gradient }
    }

    /// Which corner the new one replaces in the face of exit; and twice the area of the triangles of the origin, the new
    /// corner, and each old one.
    #[inline(always)]
    fn turn(&self, corner: &Corner<S>) -> ([Mask<S>; 3], [Floats<S>; 3]) {
        let (a, doubt_a) = corner.cross(&self.corners[0]);
        let (b, doubt_b) = corner.cross(&self.corners[1]);
        let (c, doubt_c) = corner.cross(&self.corners[2]);
        let zero = a.all(0.0);
        let mut left = [a.above(zero), b.above(zero), c.above(zero)];
        if (self.live & (doubt_a | doubt_b | doubt_c)).any() {
            left = self.turns(corner);
        }
        // Exactly one of the three triangles that the new corner cuts the face into holds the ray.
        let (first, second) = (left[1] & !left[2], left[2] & !left[0]);
        ([first, second, !(first | second)], [a.abs(), b.abs(), c.abs()])
    }

    /// Which edges, from the new corner to each old one, turn left: exactly.
    #[cold]
    #[inline(never)]
    fn turns(&self, corner: &Corner<S>) -> [Mask<S>; 3] {
        let mut left = [0; 3];
        for lane in 0..S::F32_LANES {
            let place = |corner: &Corner<S>| [corner.x.values()[lane], corner.y.values()[lane]];
            let new = self.links.values()[lane] & 3;
            let ranks = ORDERS[self.orders.values()[lane] as usize / 12];
            for i in 0..3 {
                let before = new < number_of(ranks[i], new);
                left[i] |= u32::from(turns_left(place(corner), place(&self.corners[i]), before)) << lane;
            }
        }
        left.map(|bits| Mask::from_bits(self.simd, bits))
    }

    /// Puts the new corner in place of one.
    #[inline(always)]
    fn exchange<const BIVARIATE: bool>(&mut self, corner: Corner<S>, replaced: [Mask<S>; 3], beside: [Floats<S>; 3]) {
        for (old, which) in self.corners.iter_mut().zip(replaced) {
            old.x = which.floats(corner.x, old.x);
            old.y = which.floats(corner.y, old.y);
            old.z = which.floats(corner.z, old.z);
            old.scalar = which.floats(corner.scalar, old.scalar);
            if BIVARIATE {
                old.gradient = which.floats(corner.gradient, old.gradient);
            }
        }
        let ([first, second, third], [a, b, c]) = (replaced, beside);
        self.edges[0] = first.floats(self.edges[0], second.floats(c, b));
        self.edges[1] = second.floats(self.edges[1], third.floats(a, c));
        self.edges[2] = third.floats(self.edges[2], first.floats(b, a));
    }

    /// Goes across the faces of exit, and asks the memory for what the next step will need.
    #[inline(always)]
    fn follow<const BIVARIATE: bool>(&mut self, ground: &Ground<'_>, replaced: Words<S>) {
        let new = self.links & self.word(3);
        let cells = self.links.shifted_right(2);
        let turns = self.orders + (new + new + new) + replaced;
        let mut exits = turns;
        for lane in 0..S::F32_LANES {
            let exit = EXITS[(turns.values()[lane] & 127) as usize];
            let (cell, left) = (&ground.crossings[cells.values()[lane] as usize], usize::from(exit & 3));
            let (link, vertex) = (cell.links[left], cell.vertices[left]);
            prefetch_index(ground.crossings, (link >> 2) as usize);
            prefetch_index(ground.vertices, vertex as usize);
            if BIVARIATE {
                prefetch_index(ground.gradients, vertex as usize);
            }
            exits.values_mut()[lane] = u32::from(exit);
            self.links.values_mut()[lane] = link;
            self.new.values_mut()[lane] = vertex;
        }
        self.orders = exits.shifted_right(2);
    }

    /// What lies between the faces of entry and exit. The lanes whose rest of the ray is wanted.
    #[inline(always)]
    fn segments<K: Sink<S>, const BIVARIATE: bool>(&mut self, sink: &mut K, entered: Words<S>) -> Mask<S> {
        let Self { edges: [u, v, w], corners: [a, b, c], reached, depth, at, .. } = *self;
        let sum = u + v + w;
        // Not seen edge-on. Phrased so that NaN is not.
        let met = sum.above(sum.all(1e-36));
        let scale = sum.all(1.0).over(sum);
        let (u, v, w) = (u * scale, v * scale, w * scale);
        let mean = |a: Floats<S>, b: Floats<S>, c: Floats<S>| a.mul_add(u, b.mul_add(v, c * w));
        let new_depth = met.floats(mean(a.z, b.z, c.z), depth);
        let scalar = met.floats(mean(a.scalar, b.scalar, c.scalar), at[0]);
        let gradient = if BIVARIATE { met.floats(mean(a.gradient, b.gradient, c.gradient), at[1]) } else { at[1] };
        let ahead = self.live & new_depth.above(reached);
        let mut front = at;
        let partly = ahead & reached.above(depth);
        if partly.any() {
            // Some of the segment is done, or not seen.
            let part = partly.floats((reached - depth).over(new_depth - depth), sum.all(0.0));
            front = [(scalar - at[0]).mul_add(part, at[0]), (gradient - at[1]).mul_add(part, at[1])];
        }
        let back = self.live & depth.above(new_depth);
        self.repaired = self.repaired + back.words(self.word(1), self.word(0));
        self.reached = ahead.floats(new_depth, reached);
        (self.depth, self.at) = (new_depth, [scalar, gradient]);
        let which = if sink.is_choosy() { ahead & self.wanted(sink, entered) } else { ahead };
        let length = which.floats(new_depth - reached, sum.all(0.0));
        let middle = (new_depth + reached) * sum.all(0.5);
        sink.segments(&Segments { which, front, back: self.at, length, middle })
    }

    /// The lanes whose cells the sink wants.
    #[inline(always)]
    fn wanted<K: Sink<S>>(&self, sink: &K, entered: Words<S>) -> Mask<S> {
        let mut wanted = entered;
        for (lane, &link) in entered.values().iter().enumerate() {
            wanted.values_mut()[lane] = u32::from(sink.wants(link >> 2));
        }
        wanted.equals(self.word(1))
    }
}
