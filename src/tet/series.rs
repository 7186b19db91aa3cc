//! The same tetrahedra with another field, or at another time.

use glam::DVec3;
use rayon::prelude::*;

use super::build::Frame;
use super::cells::Cells;
use super::field::{Field, FieldChoice};
use super::{Census, TetMesh, is_positive};
use crate::error::{Error, Result};
use crate::mesh::Mesh;
use crate::space::Bounds;

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
        let scalar: Vec<f64> = kept.iter().map(|&i| field.values[i as usize]).collect();
        if let Some(v) = scalar.iter().position(|s| !s.is_finite()) {
            return Err(Error::Mesh(format!(
                "{:?} is not finite at point {}, where the mesh has tetrahedra: make them anew",
                field.name, kept[v]
            )));
        }
        let mut next = Self {
            vertices: self.vertices.clone(),
            // By far the largest: on all cores.
            tets: self.tets.par_iter().copied().collect(),
            scalar,
            gradient_magnitude: Vec::new(),
            field: field.name,
            ..*self
        };
        next.move_to(kept.par_iter().map(|&i| points[i as usize]).collect(), kept)?;
        next.with_gradients(kept)
    }

    /// Puts the vertices at other places, data space.
    fn move_to(&mut self, places: Vec<DVec3>, points: &[u32]) -> Result<()> {
        if let Some(v) = places.iter().position(|p| !p.is_finite()) {
            return Err(Error::Mesh(format!("point {} lies at {}, which is no place", points[v], places[v])));
        }
        let frame = Frame::of(Bounds::of(places.iter().copied()))?;
        (self.center_in_data, self.data_per_mesh) = (frame.center, frame.data_per_mesh);
        let vertices: Vec<DVec3> = places.par_iter().map(|&p| frame.mesh_from_data(p)).collect();
        if vertices == self.vertices {
            return Ok(());
        }
        self.vertices = vertices;
        let turned = |tet: &[u32; 4]| !is_positive(tet.map(|v| self.vertices[v as usize]));
        match self.tets.par_iter().position_first(turned) {
            Some(tet) => Err(Error::Mesh(format!(
                "the points' motion turned tetrahedron {tet} over, or flattened it: make tetrahedra anew"
            ))),
            None => Ok(()),
        }
    }

    /// Computes the gradient magnitudes. `points`: the file's of each vertex.
    pub(super) fn with_gradients(mut self, points: &[u32]) -> Result<Self> {
        self.gradient_magnitude = self.vertex_gradients().into_par_iter().map(DVec3::length).collect();
        match self.gradient_magnitude.iter().position(|g| !g.is_finite()) {
            Some(v) => Err(Error::Mesh(format!(
                "the gradient of {:?} is beyond f64 at point {}: the field's values are too large; change their unit",
                self.field, points[v]
            ))),
            None => Ok(self),
        }
    }
}
