//! Index boxes of structured grids, and grids put together from blocks.

use crate::error::{Error, Result};
use crate::mesh::Association;

/// First and last index along each axis, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Extent {
    first: [i64; 3],
    last: [i64; 3],
}

impl Extent {
    /// From VTK's `x0 x1 y0 y1 z0 z1`; `None` where it is empty.
    pub(super) fn new(ends: [i32; 6]) -> Option<Self> {
        let [x0, x1, y0, y1, z0, z1] = ends.map(i64::from);
        let (first, last) = ([x0, y0, z0], [x1, y1, z1]);
        first.iter().zip(&last).all(|(a, b)| a <= b).then_some(Self { first, last })
    }

    pub(super) fn union(self, other: Self) -> Self {
        Self {
            first: std::array::from_fn(|a| self.first[a].min(other.first[a])),
            last: std::array::from_fn(|a| self.last[a].max(other.last[a])),
        }
    }

    /// The first index along each axis.
    pub(super) fn start(&self) -> [i64; 3] {
        self.first
    }

    /// Number of indices along each axis.
    pub(super) fn points(&self) -> [usize; 3] {
        std::array::from_fn(|a| (self.last[a] - self.first[a] + 1) as usize)
    }

    /// The box of points itself, or that of the cells between them.
    pub(super) fn of(self, association: Association) -> Self {
        match association {
            Association::Point => self,
            // A box one point thick has one layer of (flat) cells there.
            Association::Cell => Self { last: std::array::from_fn(|a| (self.last[a] - 1).max(self.first[a])), ..self },
        }
    }

    /// Number of indices in the box.
    pub(super) fn checked_volume(&self) -> Result<usize> {
        let [x, y, z] = self.points();
        let volume = x.checked_mul(y).and_then(|n| n.checked_mul(z)).filter(|&n| n <= u32::MAX as usize);
        volume.ok_or_else(|| {
            Error::Mesh(format!("a grid of {x} x {y} x {z} points has more than the {} that can be numbered", u32::MAX))
        })
    }

    /// Whether no volume cells lie between the points.
    pub(super) fn is_flat(&self) -> bool {
        self.points().contains(&1)
    }

    /// An error where no volume cells lie between the points, or too many points are there.
    pub(super) fn check(&self) -> Result<()> {
        self.checked_volume()?;
        if self.is_flat() {
            let [x, y, z] = self.points();
            return Err(Error::Mesh(format!("no volume cells: a grid of {x} x {y} x {z} points")));
        }
        Ok(())
    }

    /// All indices, x fastest.
    pub(super) fn indices(&self) -> impl Iterator<Item = [i64; 3]> {
        let Self { first, last } = *self;
        (first[2]..=last[2])
            .flat_map(move |z| (first[1]..=last[1]).flat_map(move |y| (first[0]..=last[0]).map(move |x| [x, y, z])))
    }

    /// Puts blocks of values together. Where blocks overlap, the later one counts.
    pub(super) fn assemble(&self, parts: &[(Self, Vec<f64>)], components: usize) -> Result<Vec<f64>, String> {
        let volume = self.checked_volume().map_err(|e| e.to_string())?;
        let given: usize = parts.iter().map(|(_, values)| values.len() / components).sum();
        if given < volume {
            return Err(format!("the pieces hold {given} of {volume} points or cells of the whole grid"));
        }
        let mut whole = vec![0.0; volume * components];
        let mut covered = vec![false; volume];
        let [nx, ny, _] = self.points();
        for (part, values) in parts {
            let row = part.points()[0];
            let rows = Self { last: [part.first[0], part.last[1], part.last[2]], ..*part };
            for (source, at) in values.chunks_exact(row * components).zip(rows.indices()) {
                let [x, y, z]: [usize; 3] = std::array::from_fn(|a| (at[a] - self.first[a]) as usize);
                let start = (z * ny + y) * nx + x;
                covered[start..start + row].fill(true);
                whole[start * components..(start + row) * components].copy_from_slice(source);
            }
        }
        match covered.iter().filter(|c| !**c).count() {
            0 => Ok(whole),
            holes => Err(format!("the pieces leave {holes} of {volume} points or cells of the whole grid open")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_put_where_they_belong() {
        let whole = Extent::new([-1, 2, 0, 1, 5, 6]).unwrap();
        let value = |[x, y, z]: [i64; 3]| (x + 10 * y + 100 * z) as f64;
        let cut = |ends| {
            let part = Extent::new(ends).unwrap();
            (part, part.indices().map(value).collect::<Vec<f64>>())
        };
        let parts = [cut([-1, 0, 0, 1, 5, 6]), cut([0, 2, 0, 1, 5, 6])];
        assert_eq!(whole.assemble(&parts, 1).unwrap(), cut([-1, 2, 0, 1, 5, 6]).1);
        let holes = [cut([-1, 1, 0, 1, 5, 6]), cut([-1, 1, 0, 1, 5, 6])];
        assert!(whole.assemble(&holes, 1).unwrap_err().contains("open"));
        assert!(whole.assemble(&parts[..1], 1).unwrap_err().contains("hold"));
    }
}
