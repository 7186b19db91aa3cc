//! The way of any one ray through the mesh.

use glam::DVec2;
use pulp::{Arch, Simd, WithSimd};

use crate::cpu::cast::{Ray as CastRay, Setting};
use crate::cpu::lanes::{Floats, Mask};
use crate::cpu::segment::Segments;
use crate::cpu::sink::{RaySink, Sink};
use crate::plan::entries;
use crate::plan::lens::Lens;
use crate::renderer::RayCounts;
use crate::space::Ray;
use crate::tet::{LinkedMesh, TetMesh};

/// What one ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Length inside the mesh, data units.
    pub length: f64,
    /// Cells entered.
    pub steps: u64,
    /// Walks that were given up; 0, but for a mesh whose neighbours are wrong.
    pub lost: u64,
}

/// The part of `ray` (data space) with `t >= 0` inside the mesh, as pictures see it; `linked` is of `mesh`. Tries every
/// boundary face, so it is for single rays.
pub fn path(mesh: &TetMesh, linked: &LinkedMesh, ray: &Ray) -> Path {
    let lens = Lens::along(mesh.mesh_from_data(ray.origin), ray.direction, 0.0);
    let entries = entries::of_ray(&linked.boundary, &lens, DVec2::ZERO);
    let setting = Setting { mesh: linked, lens: &lens, around: &[] };
    let ray = CastRay { number: 0, film: DVec2::ZERO, entries: &entries };
    let (length, counts) = Arch::new().dispatch(Measured { setting, ray });
    Path { length: f64::from(length) * mesh.data_per_mesh, steps: counts.steps, lost: counts.lost }
}

/// A ray whose length inside the mesh is wanted.
struct Measured<'a> {
    setting: Setting<'a>,
    ray: CastRay<'a>,
}

impl WithSimd for Measured<'_> {
    type Output = (f32, RayCounts);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let mut length = 0.0;
        let sink = Lengths(Floats::splat(simd, 0.0));
        let rays = std::iter::once(self.ray);
        let counts = self.setting.cast::<_, _, false>(simd, rays, sink, |_, cast| length = cast.seen);
        (length, counts)
    }
}

/// Of each lane's ray, inside the mesh.
#[derive(Clone, Copy)]
struct Lengths<S: Simd>(Floats<S>);

impl<S: Simd> Sink<S> for Lengths<S> {
    fn is_choosy(&self) -> bool {
        false
    }

    fn wants(&self, _: u32) -> bool {
        true
    }

    #[inline(always)]
    fn segments(&mut self, segments: &Segments<S>) -> Mask<S> {
        self.0 = self.0 + segments.length;
        segments.length.above(segments.length.all(-1.0))
    }
}

impl<S: Simd> RaySink<S> for Lengths<S> {
    type Seen = f32;

    fn wants_more(&self, _: usize) -> bool {
        true
    }

    fn take(&mut self, lane: usize) -> f32 {
        std::mem::take(&mut self.0.values_mut()[lane])
    }
}
