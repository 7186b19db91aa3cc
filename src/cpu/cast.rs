//! Rays through all of the mesh, walk after walk, front to back. A lane that has done with a ray takes the next one.

use std::cell::Cell;

use glam::DVec2;
use pulp::{Scalar, Simd};

use crate::cpu::axes::RayAxes;
use crate::cpu::face::Face;
use crate::cpu::lanes::{MOST_LANES, Mask};
use crate::cpu::segment::Segments;
use crate::cpu::sink::{RaySink, Sink};
use crate::cpu::walk::{Ended, Ground, Walks};
use crate::plan::entries::Entry;
use crate::plan::eye::HAIR;
use crate::plan::lens::Lens;
use crate::renderer::RayCounts;
use crate::tet::{LinkedMesh, Side};

/// A ray to be cast.
pub struct Ray<'a> {
    pub number: usize,
    /// Its position on the film.
    pub film: DVec2,
    /// Where it may enter, nearest first.
    pub entries: &'a [Entry],
}

/// What rays are cast through, and from where.
#[derive(Clone, Copy)]
pub struct Setting<'a> {
    pub mesh: &'a LinkedMesh,
    pub lens: &'a Lens,
    /// See [`sides_around`](crate::plan::eye::sides_around).
    pub around: &'a [Side],
}

impl Setting<'_> {
    /// Casts rays, and hands over what each that met the mesh has seen.
    #[inline(always)]
    pub fn cast<'r, S: Simd, K: RaySink<S>, const BIVARIATE: bool>(
        &self,
        simd: S,
        mut rays: impl Iterator<Item = Ray<'r>>,
        mut sink: K,
        mut done: impl FnMut(usize, Cast<K::Seen>),
    ) -> RayCounts {
        let ground = Ground::of(self.mesh);
        let mut counts = RayCounts::default();
        let mut courses = [const { None::<Course<'r>> }; MOST_LANES];
        let mut walks = Walks::none(simd);
        let mut idle = (1_u32 << S::F32_LANES) - 1;
        loop {
            while idle != 0 {
                let lane = idle.trailing_zeros() as usize;
                idle &= idle - 1;
                if let Some(course) = &mut courses[lane] {
                    let ended = walks.ended(&ground, lane);
                    let wants_more = sink.wants_more(lane);
                    counts.steps += u64::from(ended.steps);
                    counts.repaired += u64::from(ended.repaired);
                    counts.lost += u64::from(wants_more && ended.is_lost);
                    course.pass::<BIVARIATE>(self.mesh, &ended);
                    if wants_more && let Some(face) = course.next::<BIVARIATE>(self.mesh) {
                        walks.enter(lane, &face, course.axes.near);
                        continue;
                    }
                    done(course.number, Cast { seen: sink.take(lane), overlaps: course.overlaps });
                }
                courses[lane] = None;
                for ray in rays.by_ref() {
                    let mut course = Course::new::<BIVARIATE>(self, &ray);
                    if let Some(face) = course.next::<BIVARIATE>(self.mesh) {
                        walks.set_axes(lane, &course.axes);
                        walks.enter(lane, &face, course.axes.near);
                        courses[lane] = Some(course);
                        break;
                    }
                }
            }
            if !walks.live.any() {
                return counts;
            }
            idle = walks.run::<K, BIVARIATE>(&ground, &mut sink).bits();
        }
    }
}

/// What became of a ray.
pub struct Cast<T> {
    pub seen: T,
    /// It passes two cells at once, of a mesh that is folded or lies in itself: what is seen of them lies in the order of
    /// walks.
    pub overlaps: bool,
}

/// A ray, and the walks that it has still to make.
struct Course<'a> {
    number: usize,
    axes: RayAxes,
    /// On faces through which the ray's line enters cells around the eye, behind that: one for each walk through some of
    /// these cells, the farthest last.
    near_eye: Vec<Face>,
    entries: std::slice::Iter<'a, Entry>,
    /// Where the farthest walk has ended.
    exit: f32,
    overlaps: bool,
}

impl<'a> Course<'a> {
    #[inline(never)]
    fn new<const BIVARIATE: bool>(setting: &Setting<'_>, ray: &Ray<'a>) -> Self {
        let axes = RayAxes::new(setting.lens, ray.film);
        let near_eye = setting.around.iter().map(|&side| Face::new::<BIVARIATE>(setting.mesh, &axes, side));
        let mut near_eye: Vec<Face> = near_eye.filter(|face| face.is_inside).collect();
        if near_eye.len() > 1 {
            near_eye.sort_by(|a, b| a.depth.total_cmp(&b.depth));
            let mut firsts: Vec<Face> = Vec::new();
            for face in near_eye {
                if !firsts.iter().any(|first| passes(setting.mesh, &axes, first, &face)) {
                    firsts.push(face);
                }
            }
            firsts.reverse();
            near_eye = firsts;
        }
        let overlaps = near_eye.len() > 1;
        let entries = ray.entries.iter();
        Self { number: ray.number, axes, near_eye, entries, exit: f32::NEG_INFINITY, overlaps }
    }

    /// The face on which the next walk begins.
    #[inline(never)]
    fn next<const BIVARIATE: bool>(&mut self, mesh: &LinkedMesh) -> Option<Face> {
        if let Some(face) = self.near_eye.pop() {
            return Some(face);
        }
        let axes = &self.axes;
        let mut faces = self.entries.by_ref().map(|entry| Face::new::<BIVARIATE>(mesh, axes, entry.side));
        faces.find(|face| face.is_inside)
    }

    /// A walk has ended: does another one begin before that?
    #[inline(never)]
    fn pass<const BIVARIATE: bool>(&mut self, mesh: &LinkedMesh, ended: &Ended) {
        self.exit = self.exit.max(ended.exit);
        let axes = &self.axes;
        let before = f64::from(self.exit - LinkedMesh::TOUCH);
        let mut met = self.entries.clone().take_while(|entry| axes.at_depth(entry.depth) < before);
        let enters = |entry: &Entry| Face::new::<BIVARIATE>(mesh, axes, entry.side).is_inside;
        self.overlaps = self.overlaps || met.any(enters);
    }
}

/// Whether the walk from one face comes through another one, which is farther.
#[cold]
fn passes(mesh: &LinkedMesh, axes: &RayAxes, first: &Face, other: &Face) -> bool {
    let found = Cell::new(false);
    let mut walk = Walks::none(Scalar);
    walk.set_axes(0, axes);
    walk.enter(0, first, f32::NEG_INFINITY);
    let mut sink = Passes { cell: other.link >> 2, found: &found, end: other.depth + HAIR };
    let ground = Ground::of(mesh);
    while !walk.step::<_, false>(&ground, &mut sink).any() {}
    found.get()
}

/// Looks for a cell.
#[derive(Clone, Copy)]
struct Passes<'a> {
    cell: u32,
    found: &'a Cell<bool>,
    /// Distance along the ray behind which it would have been entered.
    end: f32,
}

impl Sink<Scalar> for Passes<'_> {
    fn is_choosy(&self) -> bool {
        true
    }

    fn wants(&self, cell: u32) -> bool {
        self.found.set(self.found.get() || cell == self.cell);
        !self.found.get()
    }

    fn segments(&mut self, segments: &Segments<Scalar>) -> Mask<Scalar> {
        let (middle, end) = (segments.middle, segments.middle.all(self.end));
        if self.found.get() { Mask::none(Scalar) } else { end.above(middle) }
    }
}
