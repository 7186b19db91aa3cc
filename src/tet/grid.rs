//! Structured grids whose tetrahedra are implied: five a voxel, as [`super::HexSplit::FiveAlternating`] cuts them.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::build::{Frame, note_text};
use super::cells::Cells;
use super::field::Field;
use super::split::split_in_five;
use super::{Domain, FieldChoice, JointHistogram};
use crate::error::{Error, Result};
use crate::mesh::{Mesh, Topology};
use crate::space::{Bounds, Interval};

/// What else takes a mesh that is no such grid.
const INSTEAD: &str = "render with --order centroid or per-pixel, or --method raycast, which take any mesh";

/// A lattice of samples; nothing is held of a tetrahedron. Mesh space is parallel to it, and turned where it is.
///
/// Places, values and gradients are those of the [`TetMesh`](super::TetMesh) that five tetrahedra a voxel make of the same mesh.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Samples along x, y and z.
    pub points: [usize; 3],
    /// Where they are along each axis, mesh space; rising or falling.
    pub places: [Vec<f64>; 3],
    /// The lattice's middle, in data space.
    pub center_in_data: DVec3,
    /// The lattice's axes, in data space: a rotation.
    pub turn: DMat3,
    /// Length of a mesh-space unit in data units; a power of two.
    pub data_per_mesh: f64,
    /// The scalar at each sample, data units, x fastest. All finite.
    pub scalar: Vec<f64>,
    /// Norm of the volume-weighted mean of the surrounding tetrahedra's gradients.
    pub gradient_magnitude: Vec<f64>,
    /// The field's name.
    pub field: String,
    scalar_range: Interval,
    gradient_range: Interval,
}

/// Voxels from `low` to before `high` along each axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VoxelBox {
    /// First.
    pub low: [usize; 3],
    /// Behind the last.
    pub high: [usize; 3],
}

impl VoxelBox {
    /// How many.
    pub fn count(&self) -> usize {
        (0..3).map(|axis| self.high[axis].saturating_sub(self.low[axis])).product()
    }

    /// The least that holds both.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        let low = std::array::from_fn(|i| self.low[i].min(other.low[i]));
        Self { low, high: std::array::from_fn(|i| self.high[i].max(other.high[i])) }
    }

    /// What both hold.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        let pick =
            |of: fn(usize, usize) -> usize, a: [usize; 3], b: [usize; 3]| std::array::from_fn(|i| of(a[i], b[i]));
        Self { low: pick(Ord::max, self.low, other.low), high: pick(Ord::min, self.high, other.high) }
    }
}

impl Grid {
    /// Whether a mesh can be taken: a structured grid without blanks, whose points are a lattice of right angles (its planes
    /// may lie at uneven distances).
    ///
    /// # Errors
    /// [`Error::Asked`] with what stands against it, and what takes such a mesh.
    pub fn check(mesh: &Mesh) -> Result<()> {
        lattice(mesh).map(|_| ())
    }

    /// Takes a mesh that [`Grid::check`] allows. Returns notes for the user, too.
    ///
    /// # Errors
    /// As [`Grid::check`]; [`Error::Asked`] where there is no such field, or where it is not finite everywhere.
    pub fn new(mesh: Mesh, choice: &FieldChoice) -> Result<(Self, Vec<String>)> {
        let Lattice { points, turn, places } = lattice(&mesh)?;
        let Mesh { points: positions, topology, arrays, available, notes } = mesh;
        let count = positions.len();
        drop(positions);
        let end = |of: fn(&Vec<f64>) -> f64| DVec3::from_array([0, 1, 2].map(|axis| of(&places[axis])));
        let frame = Frame::of(Bounds::of([end(|p| p[0]), end(|p| p[p.len() - 1])]))?;
        let field = Field::select(arrays, &available, choice, &Cells::new(&topology, count)?, count)?;
        let bad = field.values.par_iter().filter(|v| !v.is_finite()).count();
        let unusable = field.unusable.iter().filter(|&&unusable| unusable).count();
        if bad > 0 || unusable > 0 {
            let (bad, all, what) = match unusable {
                0 => (bad, count, "samples"),
                cells => (cells, field.unusable.len(), "cells"),
            };
            return Err(Error::Asked(format!(
                "a structured order takes fields that are finite everywhere, and {:?} is not at {bad} of {all} {what}: \
                 {INSTEAD}",
                field.name
            )));
        }
        let in_mesh = |axis: usize| move |&place: &f64| frame.mesh_from_data(DVec3::splat(place))[axis];
        let mut grid = Self {
            points,
            places: [0, 1, 2].map(|axis| places[axis].iter().map(in_mesh(axis)).collect()),
            center_in_data: turn * frame.center,
            turn,
            data_per_mesh: frame.data_per_mesh,
            scalar_range: Interval::of(field.values.iter().copied()),
            gradient_range: Interval::EMPTY,
            scalar: field.values,
            gradient_magnitude: Vec::new(),
            field: field.name,
        };
        grid.gradient_magnitude = grid.magnitudes();
        grid.gradient_range = Interval::of(grid.gradient_magnitude.iter().copied());
        let notes = notes.into_iter().map(note_text).chain(field.notes).collect();
        Ok((grid, notes))
    }

    /// Voxels along each axis.
    pub fn voxels(&self) -> [usize; 3] {
        self.points.map(|n| n - 1)
    }

    /// All voxels.
    pub fn all(&self) -> VoxelBox {
        VoxelBox { low: [0; 3], high: self.voxels() }
    }

    /// What voxels fill, mesh space.
    pub fn bounds_of(&self, part: &VoxelBox) -> Bounds {
        Bounds::of([self.place(part.low), self.place(part.high)])
    }

    /// The voxels that reach into a box of mesh space.
    pub fn voxels_in(&self, bounds: &Bounds) -> VoxelBox {
        let mut found = self.all();
        for axis in 0..3 {
            let (low, high) = (bounds.min[axis], bounds.max[axis]);
            let is_within = |i: &usize| {
                let ends = [self.places[axis][*i], self.places[axis][i + 1]];
                ends[0].min(ends[1]) < high && ends[0].max(ends[1]) > low
            };
            found.low[axis] = (0..self.voxels()[axis]).find(is_within).unwrap_or(0);
            found.high[axis] = (0..self.voxels()[axis]).rfind(is_within).map_or(0, |last| last + 1);
        }
        found
    }

    fn place(&self, [i, j, k]: [usize; 3]) -> DVec3 {
        DVec3::new(self.places[0][i], self.places[1][j], self.places[2][k])
    }

    fn sample(&self, [i, j, k]: [usize; 3]) -> usize {
        i + self.points[0] * (j + self.points[1] * k)
    }

    /// Of all samples.
    fn magnitudes(&self) -> Vec<f64> {
        let row = self.points[0];
        let mut magnitudes = vec![0.0; self.scalar.len()];
        magnitudes.par_chunks_mut(row).enumerate().for_each(|(index, magnitudes)| {
            let (j, k) = (index % self.points[1], index / self.points[1]);
            for (i, magnitude) in magnitudes.iter_mut().enumerate() {
                *magnitude = self.gradient([i, j, k]).length();
            }
        });
        magnitudes
    }

    /// The mean of the gradients of the tetrahedra around a sample, weighted by their volumes, data units per data
    /// length. Each of the octants around it adds what the tetrahedra of its voxel do: one where the sample's i + j + k
    /// is odd, a corner that is cut off; else four, of which the one in the middle has twice the volume of the others.
    fn gradient(&self, at: [usize; 3]) -> DVec3 {
        let is_even = at.iter().sum::<usize>().is_multiple_of(2);
        let center = self.sample(at);
        let strides = [1, self.points[0], self.points[0] * self.points[1]];
        let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
        for octant in 0..8 {
            let mut steps = [0.0; 3];
            let mut neighbours = [center; 3];
            let is_inside = (0..3).all(|axis| {
                let up = octant >> axis & 1 == 1;
                let exists = if up { at[axis] + 1 < self.points[axis] } else { at[axis] > 0 };
                if exists {
                    let next = if up { at[axis] + 1 } else { at[axis] - 1 };
                    steps[axis] = self.places[axis][next] - self.places[axis][at[axis]];
                    neighbours[axis] = if up { center + strides[axis] } else { center - strides[axis] };
                }
                exists
            });
            if !is_inside {
                continue;
            }
            let s = |i: usize| self.scalar[i];
            let (a, [x, y, z]) = (s(center), neighbours.map(s));
            let volume = (steps[0] * steps[1] * steps[2]).abs();
            let (change, share) = if is_even {
                // The voxel's other samples of this one's parity: opposite to it on its three faces.
                let [ix, iy, iz] = neighbours;
                let (xy, yz, zx) = (s(ix + iy - center), s(iy + iz - center), s(iz + ix - center));
                let change = DVec3::new(
                    (x - a) + (xy - y) + (zx - z) + (xy + zx - a - yz),
                    (xy - x) + (y - a) + (yz - z) + (xy + yz - a - zx),
                    (zx - x) + (yz - y) + (z - a) + (yz + zx - a - xy),
                );
                (change, 5.0)
            } else {
                (DVec3::new(x - a, y - a, z - a), 1.0)
            };
            sum += volume * change / DVec3::from_array(steps);
            weight += share * volume;
        }
        sum / weight / self.data_per_mesh
    }

    /// Volume (data units cubed), scalars and gradient magnitudes of a tetrahedron, numbered as the explicit mesh's.
    fn tet(&self, index: usize) -> (f64, [f64; 4], [f64; 4]) {
        let (voxel, [nx, ny, _]) = (index / 5, self.voxels());
        let [i, j, k] = [voxel % nx, voxel / nx % ny, voxel / nx / ny];
        let tet =
            split_in_five(&hexahedron(self.sample([i, j, k]), self.points), (i + j + k) % 2 == 1).as_slice()[index % 5];
        let sides = self.place([i + 1, j + 1, k + 1]) - self.place([i, j, k]);
        let sixths = if index % 5 == 4 { 2.0 } else { 1.0 };
        let volume = (sides.x * sides.y * sides.z).abs() * sixths / 6.0 * self.data_per_mesh.powi(3);
        (volume, tet.map(|v| self.scalar[v as usize]), tet.map(|v| self.gradient_magnitude[v as usize]))
    }
}

impl Domain for Grid {
    fn center_in_data(&self) -> DVec3 {
        self.center_in_data
    }

    fn data_per_mesh(&self) -> f64 {
        self.data_per_mesh
    }

    fn turn(&self) -> DMat3 {
        self.turn
    }

    fn bounds(&self) -> Bounds {
        Bounds::of([self.place([0; 3]), self.place(self.voxels())])
    }

    fn scalar_range(&self) -> Interval {
        self.scalar_range
    }

    fn gradient_range(&self) -> Interval {
        self.gradient_range
    }

    fn histogram(&self, bins: [usize; 2]) -> JointHistogram {
        let count = self.tet_count() as usize;
        JointHistogram::of(bins, [self.scalar_range, self.gradient_range], count, |tet| self.tet(tet))
    }

    fn field(&self) -> &str {
        &self.field
    }

    fn vertex_count(&self) -> usize {
        self.scalar.len()
    }

    fn tet_count(&self) -> u64 {
        5 * self.all().count() as u64
    }
}

/// A voxel's nodes in the hexahedron's order.
fn hexahedron(base: usize, points: [usize; 3]) -> [u32; 8] {
    let (row, layer) = (points[0], points[0] * points[1]);
    [0, 1, 1 + row, row, layer, layer + 1, layer + 1 + row, layer + row].map(|step| (base + step) as u32)
}

/// What a mesh's points are.
struct Lattice {
    /// Samples along each axis.
    points: [usize; 3],
    /// Its axes, in data space: a rotation.
    turn: DMat3,
    /// Along these.
    places: [Vec<f64>; 3],
}

/// Points may lie so far from where the lattice has them, of its size: what f32 moves a coordinate by.
const STRAY: f64 = 1e-7;

/// Of a mesh that is one.
fn lattice(mesh: &Mesh) -> Result<Lattice> {
    let no = |why: String| {
        Err(Error::Asked(format!("a structured order takes grids of right angles, and {why}: {INSTEAD}")))
    };
    let Topology::Structured { points, blank } = &mesh.topology else {
        return no("this mesh has explicit cells".into());
    };
    // Checks the sizes.
    Cells::new(&mesh.topology, mesh.points.len())?;
    if blank.contains(&true) {
        return no("this one has blanked points".into());
    }
    let [nx, ny, _] = *points;
    let strides = [1, nx, nx * ny];
    let ends = [0, 1, 2].map(|axis| mesh.points[strides[axis] * (points[axis] - 1)] - mesh.points[0]);
    let turn = turn_of(ends);
    let straight = |axis: usize| {
        let step = move |i: usize| mesh.points[strides[axis] * i];
        (0..points[axis]).map(|i| turn.col(axis).dot(step(i))).collect::<Vec<f64>>()
    };
    let places = [0, 1, 2].map(straight);
    let most = if turn == DMat3::IDENTITY { 0.0 } else { STRAY * ends.iter().map(|end| end.length()).sum::<f64>() };
    let is_off = |(i, p): (usize, &DVec3)| {
        let place = DVec3::new(places[0][i % nx], places[1][i / nx % ny], places[2][i / nx / ny]);
        let stray = turn * place - *p;
        !stray.is_finite() || stray.abs().max_element() > most
    };
    if mesh.points.par_iter().enumerate().any(is_off) {
        return no("this one is sheared or curved".into());
    }
    for (axis, places) in ["first", "second", "third"].iter().zip(&places) {
        let rises = places[1] > places[0];
        if !places.windows(2).all(|pair| pair[0] != pair[1] && (pair[1] > pair[0]) == rises) {
            return no(format!("the points of this one neither only rise nor only fall along the {axis} axis"));
        }
    }
    Ok(Lattice { points: *points, turn, places })
}

/// The rotation to axes along three vectors, or against them; the identity, exactly, where they lie along x, y and z.
fn turn_of(ends: [DVec3; 3]) -> DMat3 {
    if ends
        .iter()
        .zip(DMat3::IDENTITY.to_cols_array_2d())
        .all(|(end, axis)| end.cross(DVec3::from_array(axis)) == DVec3::ZERO)
    {
        return DMat3::IDENTITY;
    }
    let first = ends[0].normalize_or_zero();
    let second = (ends[1] - ends[1].dot(first) * first).normalize_or_zero();
    DMat3::from_cols(first, second, first.cross(second))
}
