//! The same tetrahedra with another field, or at another time.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::build::Frame;
use super::cells::Cells;
use super::field::{Field, FieldChoice};
use super::{Census, TetMesh, is_positive};
use crate::error::{Error, Result};
use crate::mesh::Mesh;
use crate::space::Bounds;

/// Tetrahedra looked at between two looks at whether another core has found one.
const AT_ONCE: usize = 1 << 12;

impl TetMesh {
    /// These tetrahedra with the field and the points of another mesh: of the same file with another array, or of another
    /// time step. `census` is this one's. Cells are neither cut nor judged anew, so `mesh` has to have the same ones in
    /// the same order; that their numbers are the same is checked, no more.
    ///
    /// # Errors
    /// [`Error::Asked`] where there is no such field; [`Error::Mesh`] for a mesh of other cells, for values or places that
    /// are not finite where tetrahedra were kept, and for points whose motion turned a tetrahedron over: make it anew.
    pub fn with_field(&self, census: &Census, mesh: Mesh, choice: &FieldChoice) -> Result<Self> {
        let Mesh { points, topology, arrays, available, .. } = mesh;
        let mut cells = Cells::new(&topology, points.len())?;
        let (known, counted) = (census.cell_count, cells.len() as u64);
        let kept = &census.points_of_vertices;
        if points.len() as u64 != census.points || counted != known || kept.len() != self.vertices.len() {
            return Err(Error::Mesh(format!(
                "the mesh has {} points and {counted} cells, and the one whose tetrahedra are to be kept has {} and \
                 {known}: make tetrahedra anew",
                points.len(),
                census.points
            )));
        }
        if census.merged_points.count > 0 && cells.weld(&points).finding("point") != census.merged_points {
            return Err(Error::Mesh("other points lie at one place than those that were merged: weld anew".into()));
        }
        let field = Field::select(arrays, &available, choice, &cells, points.len())?;
        if let Some(cell) = field.unusable.iter().position(|&unusable| unusable) {
            return Err(Error::Mesh(format!(
                "{:?} is not finite in cell {cell}: make tetrahedra anew, which leaves such cells out",
                field.name
            )));
        }
        let scalar: Vec<f64> = kept.par_iter().map(|&i| field.values[i as usize]).collect();
        if let Some(v) = scalar.iter().position(|s| !s.is_finite()) {
            return Err(Error::Mesh(format!(
                "{:?} is not finite at point {}, where the mesh has tetrahedra: make them anew",
                field.name, kept[v]
            )));
        }
        let (frame, vertices) = placed(&points, kept)?;
        let next = Self {
            center_in_data: frame.center,
            data_per_mesh: frame.data_per_mesh,
            vertices,
            tets: Arc::clone(&self.tets),
            scalar,
            gradient_magnitude: Vec::new(),
            field: field.name,
        };
        if next.vertices != self.vertices {
            next.check_orientation()?;
        }
        next.with_gradients(kept)
    }

    /// That no tetrahedron was turned over.
    fn check_orientation(&self) -> Result<()> {
        let place = |v: u32| self.vertices[v as usize];
        let turned = |&[a, b, c, d]: &[u32; 4]| !is_positive([place(a), place(b), place(c), place(d)]);
        let among = |(run, tets): (usize, &[[u32; 4]])| Some(run * AT_ONCE + tets.iter().position(turned)?);
        match self.tets.par_chunks(AT_ONCE).enumerate().find_map_first(among) {
            Some(tet) => Err(Error::Mesh(format!(
                "the points' motion turned tetrahedron {tet} over, or flattened it: make tetrahedra anew"
            ))),
            None => Ok(()),
        }
    }

    /// Computes the gradient magnitudes. `points`: the file's of each vertex.
    pub(super) fn with_gradients(mut self, points: &[u32]) -> Result<Self> {
        self.gradient_magnitude = self.of_vertex_gradients(DVec3::length);
        match self.gradient_magnitude.iter().position(|g| !g.is_finite()) {
            Some(v) => Err(Error::Mesh(format!(
                "the gradient of {:?} is beyond f64 at point {}: the field's values are too large; change their unit",
                self.field, points[v]
            ))),
            None => Ok(self),
        }
    }
}

/// The vertices at the file's points, and the frame that this gives.
fn placed(points: &[DVec3], kept: &[u32]) -> Result<(Frame, Vec<DVec3>)> {
    let place = |&i: &u32| points[i as usize];
    if let Some(i) = kept.iter().find(|&i| !place(i).is_finite()) {
        return Err(Error::Mesh(format!("point {i} lies at {}, which is no place", place(i))));
    }
    let frame = Frame::of(Bounds::of(kept.iter().map(place)))?;
    Ok((frame, kept.par_iter().map(|i| frame.mesh_from_data(place(i))).collect()))
}
