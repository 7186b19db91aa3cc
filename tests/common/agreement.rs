//! Is a picture the one it should be, and what explains the pixels that are not?

use std::fmt;
use std::sync::Arc;

use glam::DVec3;
use tetralux::image::{Comparison, Image};
use tetralux::oracle::{Oracle, View};
use tetralux::renderer::Frame;
use tetralux::scene::Projection;
use tetralux::tet::TetMesh;

/// What is asked of a picture.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// At least, decibels.
    pub psnr: f64,
    /// At most, the pixel error that 99.9 % of the pixels keep below.
    pub percentile_99_9: f64,
    /// Every larger pixel error has to be explained.
    pub explained_above: f64,
}

/// Why a pixel errs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cause {
    /// The true picture changes as much nearby.
    Surroundings,
    /// The shares of the cells at one edge do.
    FewCells,
    /// The opacity errs as much, which no order of cells changes: where orders are tested, another thing is at fault.
    Opacity,
    Unknown,
}

/// How a picture compares.
#[derive(Clone, Debug)]
pub struct Verdict {
    pub comparison: Comparison,
    /// Column and row of the pixels above the limit, their errors and causes.
    pub large: Vec<([u32; 2], f64, Cause)>,
    limits: Limits,
}

impl Verdict {
    /// Compares; `cause` explains a pixel's error.
    pub fn new(got: &Image, want: &Image, limits: Limits, cause: impl Fn([u32; 2], f64) -> Cause) -> Self {
        let comparison = Comparison::new(got, want).expect("equal sizes");
        let above = comparison.pixels_above(limits.explained_above);
        // Whoever has that many has no excuse.
        let asked = |i, pixel, error| if i < 300 { cause(pixel, error) } else { Cause::Unknown };
        let large = above.enumerate().map(|(i, (pixel, error))| (pixel, error, asked(i, pixel, error))).collect();
        Self { comparison, large, limits }
    }

    /// Pixels above the limit of this cause.
    pub fn count(&self, cause: Cause) -> usize {
        self.large.iter().filter(|(_, _, c)| *c == cause).count()
    }

    /// What the picture fails; empty for a good one.
    pub fn failures(&self) -> Vec<String> {
        let (c, l) = (&self.comparison, self.limits);
        let mut failures = Vec::new();
        let (unknown, above) = (self.count(Cause::Unknown), l.explained_above);
        for (good, text) in [
            // Phrased so that NaN fails.
            (c.psnr >= l.psnr, format!("PSNR {:.2} dB, below {}", c.psnr, l.psnr)),
            (
                c.percentile_99_9 <= l.percentile_99_9,
                format!("99.9th percentile {:.3e}, above {:.1e}", c.percentile_99_9, l.percentile_99_9),
            ),
            (unknown == 0, format!("{unknown} pixels above {above:.1e} have no cause: {:?} ...", self.first_unknown())),
        ] {
            if !good {
                failures.push(text);
            }
        }
        failures
    }

    fn first_unknown(&self) -> Vec<([u32; 2], f64)> {
        let unknown = self.large.iter().filter(|(_, _, cause)| *cause == Cause::Unknown);
        unknown.map(|&(pixel, error, _)| (pixel, error)).take(5).collect()
    }

    /// Fails with all that is known of the comparison.
    pub fn assert_good(&self, what: &str) {
        let failures = self.failures();
        assert!(failures.is_empty(), "{what}: {}\n{}", failures.join("; "), self.comparison);
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let c = &self.comparison;
        write!(f, "{:6.2} dB  99.9% {:.1e}  max {:.1e}", c.psnr, c.percentile_99_9, c.max)?;
        if self.limits.explained_above.is_finite() {
            let causes = [Cause::Surroundings, Cause::FewCells, Cause::Opacity, Cause::Unknown];
            let (counts, above) = (causes.map(|cause| self.count(cause)), self.limits.explained_above);
            write!(f, "  above {above:.0e}: {counts:?} (surroundings, few cells, opacity, unknown)")?;
        }
        Ok(())
    }
}

/// Rasterisers snap vertices to 1/256 pixel, so edges move by up to 1/512 along each axis; the interpolated values do
/// not. A pixel that the edge between two triangles of a cell has passed takes the other triangle's values, twice as far
/// off as the edge is.
pub const SNAP: f64 = 1.0 / 256.0;

/// Explains the errors of a frame of one colour: a pixel whose ray, moved by `shift` pixels, sees as different a thing,
/// or some of whose cells' depths change as much within [`SNAP`]. Conforming cells make up for each other when the ray
/// moves, but not when the rasteriser moves their edges: cells thinner than that appear or swell alone.
pub struct Explainer<'a> {
    pub mesh: &'a TetMesh,
    pub frame: Frame<'a>,
    pub view: View<'a>,
    pub shift: f64,
}

impl Explainer<'_> {
    pub fn cause(&self, pixel: [u32; 2], error: f64) -> Cause {
        let position = pixel.map(|i| f64::from(i) + 0.5);
        if self.view.sensitivity(self.frame.transfer, position, self.shift) >= error {
            return Cause::Surroundings;
        }
        if self.few_cells(position) >= error { Cause::FewCells } else { Cause::Unknown }
    }

    /// Largest change of the pixel's opacity as the depths of a few cells alone take their values within [`SNAP`]: of as
    /// many as an edge that moves may take along.
    fn few_cells(&self, position: [f64; 2]) -> f64 {
        let mesh = self.mesh;
        let transmittance = 1.0 - self.view.pixel(self.frame.transfer, [0.0; 4], position)[3];
        let near_pixel = |tet: &&[u32; 4]| {
            let corners = tet.map(|v| self.pixel_of(mesh.vertices[v as usize]));
            (0..2).all(|axis| {
                let offsets = corners.map(|c| c[axis] - position[axis]);
                offsets.iter().any(|o| *o < 2.0 * SNAP) && offsets.iter().any(|o| *o > -2.0 * SNAP)
            })
        };
        let of_cell = |tet: &[u32; 4]| {
            let pick = |values: &[f64]| tet.map(|v| values[v as usize]).to_vec();
            let alone = TetMesh {
                vertices: tet.map(|v| mesh.vertices[v as usize]).to_vec(),
                tets: Arc::new(vec![[0, 1, 2, 3]]),
                scalar: pick(&mesh.scalar),
                gradient_magnitude: pick(&mesh.gradient_magnitude),
                field: String::new(),
                ..*mesh
            };
            let oracle = Oracle::new(Arc::new(alone));
            let view = oracle.view(&self.frame).expect("a view");
            // A thin cell's depth may rise and fall again within SNAP.
            let shifts = [0.125, 0.25, 0.5, 1.0].map(|part| part * SNAP);
            let change = shifts.map(|shift| view.sensitivity(self.frame.transfer, position, shift));
            let change = change.into_iter().fold(0.0, f64::max);
            let opacity = view.pixel(self.frame.transfer, [0.0; 4], position)[3];
            change * transmittance / (1.0 - opacity)
        };
        let mut changes: Vec<f64> = mesh.tets.iter().filter(near_pixel).map(of_cell).collect();
        changes.sort_by(|a, b| b.total_cmp(a));
        changes.iter().take(3).sum()
    }

    /// Where a point of mesh space appears.
    fn pixel_of(&self, point: DVec3) -> [f64; 2] {
        let (camera, basis) = (self.frame.camera, self.frame.camera.basis());
        let [width, height] = self.frame.size.map(f64::from);
        let v = self.mesh.data_from_mesh(point) - camera.eye;
        let half = match camera.projection {
            Projection::Perspective { fov_y } => (0.5 * fov_y).tan() * v.dot(basis.forward),
            Projection::Orthographic { height } => 0.5 * height,
        };
        [0.5 * (width + height * v.dot(basis.right) / half), 0.5 * height * (1.0 - v.dot(basis.up) / half)]
    }
}

/// Fails unless `limits` reject pictures whose errors lie just above them: noise everywhere, in 2 pixels of a thousand,
/// and a single wrong pixel; and accept the same just below.
pub fn assert_limits_bite(want: &Image, limits: Limits) {
    let count = want.pixels.len();
    let with = |error: f64, every: usize, first: usize| {
        let mut image = want.clone();
        image.pixels.iter_mut().skip(first).step_by(every).for_each(|p| p.iter_mut().for_each(|v| *v += error as f32));
        Verdict::new(&image, want, limits, |_, _| Cause::Unknown)
    };
    let noise = 10f64.powf(-limits.psnr / 20.0);
    for (error, every, first, what) in [
        (noise, 1, 0, "PSNR"),
        (limits.percentile_99_9, 500, 250, "percentile"),
        (limits.explained_above, count, count / 2, "pixels above"),
    ] {
        let (above, below) = (with(1.02 * error, every, first), with(0.98 * error, every, first));
        assert!(above.failures().iter().any(|f| f.contains(what)), "planted {what} not seen: {above}");
        assert!(below.failures().iter().all(|f| !f.contains(what)), "{what} seen where there is none: {below}");
    }
}
