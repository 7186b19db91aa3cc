//! The near plane: cells that it cuts are replaced by the pieces beyond it, so that a camera may stand in the mesh.

use std::collections::HashMap;

use glam::DVec3;
use rayon::prelude::*;

use crate::mesh::CellKind;
use crate::scene::Camera;
use crate::tet::{TetId, TetMesh, is_positive, split_cell};

/// What a view's near plane leaves of the cells that reach in front of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NearCut {
    /// One bit a tetrahedron, 32 a word, lowest first: those with a vertex nearer than the near depth. They are not
    /// drawn; their pieces are.
    pub clipped: Vec<u32>,
    /// Vertices on the near plane, one for each cut edge, whichever cells share it.
    pub vertices: Vec<CutVertex>,
    /// Positively oriented pieces of the clipped cells, beyond the near plane. Ids below the mesh's vertex count are
    /// the mesh's; the others, less that count, index `vertices`.
    pub tets: Vec<[u32; 4]>,
    /// The cell that each piece is of.
    pub parents: Vec<TetId>,
}

/// A vertex on the near plane; everything is linear along the cut edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CutVertex {
    /// Mesh space.
    pub position: DVec3,
    /// Data units.
    pub scalar: f64,
    /// Data units per data length.
    pub gradient_magnitude: f64,
}

/// Cuts the cells that have a vertex nearer than the camera's near depth; `None` where there are none.
///
/// Conforming: an edge is cut once for all its cells, and a face's remainder is cut from its smallest vertex id. A
/// vertex exactly at the near depth is beyond it. Pieces whose volume cannot be told from zero are left out.
pub fn cut(mesh: &TetMesh, camera: &Camera) -> Option<NearCut> {
    let bounds = mesh.bounds();
    let plane = Plane::new(mesh, camera, bounds.diagonal());
    if bounds.corners().iter().all(|&corner| plane.is_beyond(corner)) {
        return None;
    }
    let beyond: Vec<bool> = mesh.vertices.par_iter().map(|&v| plane.is_beyond(v)).collect();
    let is_clipped = |tet: &[u32; 4]| !tet.iter().all(|&v| beyond[v as usize]);
    let clipped: Vec<u32> = mesh
        .tets
        .par_chunks(32)
        .map(|word| (0u32..).zip(word).fold(0, |bits, (i, tet)| bits | u32::from(is_clipped(tet)) << i))
        .collect();
    if clipped.iter().all(|&bits| bits == 0) {
        return None;
    }
    let mut cutter = Cutter { mesh, plane, cut: NearCut::default(), made: HashMap::new() };
    for (first, &word) in (0u32..).step_by(32).zip(&clipped) {
        let mut bits = word;
        while bits != 0 {
            let tet = TetId(first + bits.trailing_zeros());
            cutter.cut_cell(tet, mesh.tets[tet.0 as usize].map(|v| beyond[v as usize]));
            bits &= bits - 1;
        }
    }
    Some(NearCut { clipped, ..cutter.cut })
}

/// The near plane, mesh space.
struct Plane {
    eye: DVec3,
    forward: DVec3,
    depth: f64,
}

impl Plane {
    fn new(mesh: &TetMesh, camera: &Camera, diagonal_in_mesh: f64) -> Self {
        Self {
            eye: mesh.mesh_from_data(camera.eye),
            forward: camera.basis().forward,
            depth: camera.near_depth(diagonal_in_mesh * mesh.data_per_mesh) / mesh.data_per_mesh,
        }
    }

    /// How far `p` lies beyond the plane.
    fn excess(&self, p: DVec3) -> f64 {
        (p - self.eye).dot(self.forward) - self.depth
    }

    fn is_beyond(&self, p: DVec3) -> bool {
        self.excess(p) >= 0.0
    }
}

/// All ways to name a tetrahedron's corners that keep its orientation.
const EVEN: [[usize; 4]; 12] = [
    [0, 1, 2, 3],
    [0, 2, 3, 1],
    [0, 3, 1, 2],
    [1, 0, 3, 2],
    [1, 2, 0, 3],
    [1, 3, 2, 0],
    [2, 0, 1, 3],
    [2, 1, 3, 0],
    [2, 3, 0, 1],
    [3, 0, 2, 1],
    [3, 1, 0, 2],
    [3, 2, 1, 0],
];

struct Cutter<'a> {
    mesh: &'a TetMesh,
    plane: Plane,
    cut: NearCut,
    /// Ids of the vertices made, by the edge's ends in ascending order.
    made: HashMap<[u32; 2], u32>,
}

impl Cutter<'_> {
    fn cut_cell(&mut self, parent: TetId, beyond: [bool; 4]) {
        let kept = beyond.iter().filter(|&&b| b).count();
        // The corners beyond the plane first.
        let is_sorted = |order: &&[usize; 4]| order.iter().enumerate().all(|(at, &i)| beyond[i] == (at < kept));
        let Some(order) = EVEN.iter().find(is_sorted) else { return };
        let [a, b, c, d] = order.map(|i| self.mesh.tets[parent.0 as usize][i]);
        match kept {
            1 => {
                let tet = [a, self.on_edge(a, b), self.on_edge(a, c), self.on_edge(a, d)];
                self.push(parent, tet);
            }
            2 => {
                let [ac, ad] = [self.on_edge(a, c), self.on_edge(a, d)];
                let [bc, bd] = [self.on_edge(b, c), self.on_edge(b, d)];
                self.push_wedge(parent, [a, ac, ad, b, bc, bd]);
            }
            3 => {
                let [ad, bd, cd] = [self.on_edge(a, d), self.on_edge(b, d), self.on_edge(c, d)];
                self.push_wedge(parent, [a, b, c, ad, bd, cd]);
            }
            _ => {}
        }
    }

    /// The vertex where the edge from `kept`, beyond the plane, to `lost` meets the plane.
    fn on_edge(&mut self, kept: u32, lost: u32) -> u32 {
        let mesh = self.mesh;
        if self.plane.excess(mesh.vertices[kept as usize]) == 0.0 {
            return kept;
        }
        let ends = [kept.min(lost), kept.max(lost)];
        let (plane, vertices) = (&self.plane, &mut self.cut.vertices);
        *self.made.entry(ends).or_insert_with(|| {
            let [low, high] = ends.map(|v| v as usize);
            let [from, to] = [low, high].map(|v| plane.excess(mesh.vertices[v]));
            let t = from / (from - to);
            let mix = |values: &[f64]| values[low] + t * (values[high] - values[low]);
            vertices.push(CutVertex {
                position: mesh.vertices[low] + t * (mesh.vertices[high] - mesh.vertices[low]),
                scalar: mix(&mesh.scalar),
                gradient_magnitude: mix(&mesh.gradient_magnitude),
            });
            (mesh.vertices.len() + vertices.len() - 1) as u32
        })
    }

    fn push_wedge(&mut self, parent: TetId, nodes: [u32; 6]) {
        for &tet in split_cell(CellKind::Wedge, &nodes).as_slice() {
            self.push(parent, tet);
        }
    }

    fn push(&mut self, parent: TetId, tet: [u32; 4]) {
        let position = |v: u32| {
            let v = v as usize;
            let count = self.mesh.vertices.len();
            if v < count { self.mesh.vertices[v] } else { self.cut.vertices[v - count].position }
        };
        if is_positive(tet.map(position)) {
            self.cut.tets.push(tet);
            self.cut.parents.push(parent);
        }
    }
}
