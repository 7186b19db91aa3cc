//! What a box leaves of a mesh.

use std::collections::HashMap;
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::build::Frame;
use super::{MAX_TETS, TetMesh, is_positive, part};
use crate::error::{Error, Result};
use crate::space::Bounds;

/// Not among the kept vertices.
const NOWHERE: u32 = u32::MAX;

/// A side of the box: what lies at `sign * (position[axis] - at) >= 0` is kept.
#[derive(Clone, Copy)]
struct Side {
    axis: usize,
    sign: f64,
    /// Mesh space.
    at: f64,
}

impl Side {
    fn excess(self, p: DVec3) -> f64 {
        self.sign * (p[self.axis] - self.at)
    }
}

impl TetMesh {
    /// The part in a box (data space), cut at its sides. Scalars and gradient magnitudes are linear in each cell, so what
    /// is left has the values that it had; gradients for lighting and silhouettes are those of what is left.
    ///
    /// Conforming, as the mesh is: an edge is cut once for all its cells, and a face's parts are cut from their smallest
    /// vertex ids. A vertex exactly on a side is used itself. Pieces whose volume cannot be told from zero are left out.
    ///
    /// # Errors
    /// [`Error::Asked`] where nothing of the mesh is in the box, [`Error::Mesh`] where what is left fills no space that
    /// could be computed with.
    pub fn clipped_to(&self, bounds_in_data: &Bounds) -> Result<Self> {
        let [min, max] = [bounds_in_data.min, bounds_in_data.max].map(|p| self.mesh_from_data(p));
        let sides: Vec<Side> = (0..3)
            .flat_map(|axis| [Side { axis, sign: 1.0, at: min[axis] }, Side { axis, sign: -1.0, at: max[axis] }])
            .collect();
        // A bit for each side that a vertex lies beyond.
        let beyond = |&p: &DVec3| sides.iter().enumerate().fold(0, |b, (i, s)| b | u8::from(s.excess(p) < 0.0) << i);
        let outside: Vec<u8> = self.vertices.par_iter().map(beyond).collect();
        if outside.iter().all(|&bits| bits == 0) {
            return Ok(self.clone());
        }
        let mut cut = Cutter { mesh: self, sides: &sides, made: HashMap::new(), vertices: Vec::new() };
        let mut tets = Vec::new();
        for &tet in self.tets.iter() {
            let of = tet.map(|v| outside[v as usize]);
            if of == [0; 4] {
                tets.push(tet);
            } else if of.into_iter().fold(u8::MAX, |all, bits| all & bits) == 0 {
                cut.cut(tet, &mut tets);
            }
        }
        if tets.is_empty() {
            let (low, high) = (bounds_in_data.min, bounds_in_data.max);
            let all = self.bounds_in_data();
            return Err(Error::Asked(format!(
                "nothing of the mesh lies in the box from {low} to {high}: the mesh reaches from {} to {}",
                all.min, all.max
            )));
        }
        if tets.len() as u64 > MAX_TETS {
            let count = tets.len();
            return Err(Error::Mesh(format!("the box cuts the mesh into {count} tetrahedra, more than {MAX_TETS}")));
        }
        let made = cut.vertices;
        self.part_of(tets, &made)
    }

    /// A mesh of these tetrahedra; ids from this mesh's vertex count on are of `made`.
    fn part_of(&self, mut tets: Vec<[u32; 4]>, made: &[Made]) -> Result<Self> {
        let count = self.vertices.len();
        let mut ids = vec![NOWHERE; count + made.len()];
        for &v in tets.iter().flatten() {
            ids[v as usize] = 0;
        }
        let used: Vec<usize> = (0..ids.len()).filter(|&v| ids[v] == 0).collect();
        for (new, &old) in (0..).zip(&used) {
            ids[old] = new;
        }
        tets.par_iter_mut().for_each(|tet| *tet = tet.map(|v| ids[v as usize]));
        let vertex = |&v: &usize| match v.checked_sub(count) {
            Some(i) => made[i],
            None => Made {
                position: self.vertices[v],
                scalar: self.scalar[v],
                gradient_magnitude: self.gradient_magnitude[v],
            },
        };
        let left: Vec<Made> = used.iter().map(vertex).collect();
        // Within mesh space, where differences lose least.
        let frame = Frame::of(Bounds::of(left.iter().map(|v| v.position)))?;
        let vertices: Vec<DVec3> = left.iter().map(|v| frame.mesh_from_data(v.position)).collect();
        tets.retain(|tet| is_positive(tet.map(|v| vertices[v as usize])));
        Ok(Self {
            vertices,
            center_in_data: self.data_from_mesh(frame.center),
            data_per_mesh: self.data_per_mesh * frame.data_per_mesh,
            tets: Arc::new(tets),
            scalar: left.iter().map(|v| v.scalar).collect(),
            gradient_magnitude: left.iter().map(|v| v.gradient_magnitude).collect(),
            field: self.field.clone(),
        })
    }
}

/// A vertex on a side of the box, or one of the mesh.
#[derive(Clone, Copy)]
struct Made {
    position: DVec3,
    scalar: f64,
    gradient_magnitude: f64,
}

struct Cutter<'a> {
    mesh: &'a TetMesh,
    sides: &'a [Side],
    /// Ids of the vertices made, by the edge's ends in ascending order and the side.
    made: HashMap<([u32; 2], usize), u32>,
    vertices: Vec<Made>,
}

impl Cutter<'_> {
    fn cut(&mut self, tet: [u32; 4], tets: &mut Vec<[u32; 4]>) {
        let mut pieces = vec![tet];
        for number in 0..self.sides.len() {
            let mut left = Vec::with_capacity(pieces.len());
            for piece in pieces {
                let excess = piece.map(|v| self.sides[number].excess(self.vertex(v).position));
                if excess.iter().all(|&e| e >= 0.0) {
                    left.push(piece);
                } else if excess.iter().any(|&e| e > 0.0)
                    && let Some(parts) = part(piece, excess.map(|e| e >= 0.0), |a, b| self.on_edge(a, b, number))
                {
                    let solid = |tet: &&[u32; 4]| is_positive(tet.map(|v| self.vertex(v).position));
                    left.extend(parts.as_slice().iter().filter(solid));
                }
            }
            pieces = left;
        }
        tets.extend(pieces);
    }

    /// The vertex where an edge meets a side that its ends do not lie beyond both.
    fn on_edge(&mut self, from: u32, to: u32, number: usize) -> u32 {
        let side = self.sides[number];
        if let Some(end) = [from, to].into_iter().find(|&v| side.excess(self.vertex(v).position) == 0.0) {
            return end;
        }
        let ends = [from.min(to), from.max(to)];
        if let Some(&id) = self.made.get(&(ends, number)) {
            return id;
        }
        let [low, high] = ends.map(|v| self.vertex(v));
        let [at_low, at_high] = [low, high].map(|v| side.excess(v.position));
        let t = at_low / (at_low - at_high);
        let between = |a: f64, b: f64| a + t * (b - a);
        let mut position = low.position + t * (high.position - low.position);
        // Exactly, so that no further cut sees it beside the side.
        position[side.axis] = side.at;
        self.vertices.push(Made {
            position,
            scalar: between(low.scalar, high.scalar),
            gradient_magnitude: between(low.gradient_magnitude, high.gradient_magnitude),
        });
        let id = (self.mesh.vertices.len() + self.vertices.len() - 1) as u32;
        self.made.insert((ends, number), id);
        id
    }

    fn vertex(&self, v: u32) -> Made {
        let (v, mesh) = (v as usize, self.mesh);
        match v.checked_sub(mesh.vertices.len()) {
            Some(i) => self.vertices[i],
            None => Made {
                position: mesh.vertices[v],
                scalar: mesh.scalar[v],
                gradient_magnitude: mesh.gradient_magnitude[v],
            },
        }
    }
}
