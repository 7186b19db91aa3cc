//! A lattice of samples in memory, as raw and NRRD files hold it, made a mesh.

use std::path::Path;

use glam::DVec3;

use super::{ArrayInfo, Association, DataArray, Mesh, ReadOptions, Topology};
use crate::error::{Error, Result};

/// What a volume's header says, x fastest.
pub(super) struct Volume<'a> {
    pub(super) path: &'a Path,
    /// Of the array.
    pub(super) name: String,
    pub(super) dims: [usize; 3],
    /// Values per sample, at least 1, side by side.
    pub(super) components: usize,
    /// Position of the first sample.
    pub(super) origin: [f64; 3],
    /// Steps along the three axes.
    pub(super) axes: [DVec3; 3],
}

impl Volume<'_> {
    /// Axis-parallel steps.
    pub(super) fn spacing(path: &Path, spacing: [f64; 3]) -> Result<[DVec3; 3]> {
        if spacing.iter().any(|s| !s.is_finite() || *s == 0.0) {
            return Err(Error::malformed(path, format!("a spacing is zero or not finite: {spacing:?}")));
        }
        Ok([DVec3::X * spacing[0], DVec3::Y * spacing[1], DVec3::Z * spacing[2]])
    }

    /// Number of values, all components counted; to be compared with what the file holds before anything is allocated.
    pub(super) fn sample_count(&self) -> Result<usize> {
        let size = self.dims.map(|n| n.to_string()).join("x");
        if self.dims.iter().any(|n| *n < 2) {
            return Err(Error::malformed(
                self.path,
                format!("{size} samples are no volume: at least 2 along each axis"),
            ));
        }
        let points = self.dims.iter().try_fold(1_usize, |n, d| n.checked_mul(*d)).filter(|n| u32::try_from(*n).is_ok());
        points
            .and_then(|n| n.checked_mul(self.components))
            .ok_or_else(|| Error::malformed(self.path, format!("{size} samples are beyond 2^32")))
    }

    /// The mesh. `values` were read already: their number is what proves that the dimensions are not absurd.
    pub(super) fn mesh(self, options: &ReadOptions, values: Vec<f64>) -> Result<Mesh> {
        let (association, components) = (Association::Point, self.components);
        let available = vec![ArrayInfo { name: self.name.clone(), association, components }];
        options.arrays.select(&available)?;
        let arrays = vec![DataArray { name: self.name.clone(), association, components, values }];
        let [n, m, l] = self.dims;
        let mut points = Vec::with_capacity(n * m * l);
        let at = |i: usize, j: usize, k: usize| {
            DVec3::from_array(self.origin) + self.axes[0] * i as f64 + self.axes[1] * j as f64 + self.axes[2] * k as f64
        };
        for k in 0..l {
            for j in 0..m {
                points.extend((0..n).map(|i| at(i, j, k)));
            }
        }
        if let Some(i) = points.iter().position(|p| !p.is_finite()) {
            return Err(Error::malformed(self.path, format!("sample {i} has a position that is not finite")));
        }
        let topology = Topology::Structured { points: self.dims, blank: Vec::new() };
        Ok(Mesh { points, topology, arrays, available, notes: Vec::new() })
    }
}
