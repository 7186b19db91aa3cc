//! Rays through all of the mesh, walk after walk, front to back. A lane that has done with a ray takes the next one.

use glam::DVec2;
use pulp::Simd;

use crate::cpu::axes::RayAxes;
use crate::cpu::face::Face;
use crate::cpu::lanes::MOST_LANES;
use crate::cpu::sink::RaySink;
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
        mut done: impl FnMut(usize, K::Seen),
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
                    course.pass(&ended);
                    if wants_more && let Some(face) = course.next::<BIVARIATE>(self.mesh) {
                        walks.enter(lane, &face, course.axes.near);
                        continue;
                    }
                    done(course.number, sink.take(lane));
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

/// A ray, and the walks that it has still to make.
struct Course<'a> {
    number: usize,
    axes: RayAxes,
    /// On the faces through which the ray's line enters the cells around the eye, behind that, the farthest last.
    near_eye: Vec<Face>,
    entries: std::slice::Iter<'a, Entry>,
    /// How far the ray is done by walks from cells around the eye: others of these cells were passed on the way.
    covered: f32,
    is_from_eye: bool,
}

impl<'a> Course<'a> {
    #[inline(never)]
    fn new<const BIVARIATE: bool>(setting: &Setting<'_>, ray: &Ray<'a>) -> Self {
        let axes = RayAxes::new(setting.lens, ray.film);
        let near_eye = setting.around.iter().map(|&side| Face::new::<BIVARIATE>(setting.mesh, &axes, side));
        let mut near_eye: Vec<Face> = near_eye.filter(|face| face.is_inside).collect();
        near_eye.sort_by(|a, b| b.depth.total_cmp(&a.depth));
        let entries = ray.entries.iter();
        Self { number: ray.number, axes, near_eye, entries, covered: f32::NEG_INFINITY, is_from_eye: false }
    }

    /// The face on which the next walk begins.
    #[inline(never)]
    fn next<const BIVARIATE: bool>(&mut self, mesh: &LinkedMesh) -> Option<Face> {
        let is_new = |face: &Face, covered: f32| face.depth >= covered - HAIR;
        while let Some(face) = self.near_eye.pop() {
            if is_new(&face, self.covered) {
                self.is_from_eye = true;
                return Some(face);
            }
        }
        self.is_from_eye = false;
        let axes = &self.axes;
        let mut faces = self.entries.by_ref().map(|entry| Face::new::<BIVARIATE>(mesh, axes, entry.side));
        faces.find(|face| face.is_inside)
    }

    /// A walk has ended.
    fn pass(&mut self, ended: &Ended) {
        if self.is_from_eye {
            self.covered = self.covered.max(ended.exit);
        }
    }
}
