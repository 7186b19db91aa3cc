//! Whether a mesh is manifold, convex, Delaunay: what sorting and walking may rely on.

use std::fmt;

use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;

use super::adjacency::{Adjacency, FACES};
use super::census::{Census, Finding, Tally, write_count, write_finding};
use super::geometry::six_volumes;
use super::{NO_TET, TetId, TetMesh};

/// How a mesh's tetrahedra hang together. Tetrahedra and vertices in the examples are numbered as in [`TetMesh`].
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct TopologyCensus {
    /// Parts that are not joined by faces.
    pub components: u64,
    /// Faces of one tetrahedron only, and those of more than two, once for each.
    pub boundary_faces: u64,
    /// Faces of more than two.
    pub overfull_faces: Finding,
    /// Edges where not exactly two boundary faces meet.
    pub non_manifold_edges: Finding,
    /// Pairs of neighbours that lie on the same side of their face, that is, overlap.
    pub overlapping_pairs: Finding,
    /// Edges of the boundary where the mesh is not convex. None, in one part without non-manifold edges: convex.
    pub reflex_edges: Finding,
    /// Interior faces across which the opposite vertex lies inside the circumsphere. None, in a convex mesh: Delaunay.
    pub not_delaunay: Finding,
}

impl TopologyCensus {
    /// True where every line meets the mesh in one piece.
    pub fn is_convex(&self) -> bool {
        self.components == 1
            && self.overfull_faces.count == 0
            && self.non_manifold_edges.count == 0
            && self.overlapping_pairs.count == 0
            && self.reflex_edges.count == 0
    }

    /// True where every face is locally Delaunay: of a convex mesh, where the mesh is the Delaunay triangulation (up to
    /// points on one sphere).
    pub fn is_delaunay(&self) -> bool {
        self.overfull_faces.count == 0 && self.overlapping_pairs.count == 0 && self.not_delaunay.count == 0
    }
}

impl Census {
    /// Examines how the tetrahedra hang together.
    ///
    /// Convexity and the Delaunay property are judged with the rounding of 32-bit coordinates in mind, which most files
    /// hold: a reflex edge or a vertex inside a circumsphere counts only where moving every point by that rounding
    /// could not mend it.
    pub fn topology(mesh: &TetMesh, adjacency: &Adjacency) -> TopologyCensus {
        let rounding = coordinate_rounding(mesh);
        let (non_manifold_edges, reflex_edges) = examine_boundary(mesh, adjacency, rounding);
        let (overlapping_pairs, not_delaunay) = examine_interior(mesh, adjacency, rounding);
        TopologyCensus {
            components: count_components(adjacency),
            boundary_faces: adjacency.boundary_faces().count() as u64,
            overfull_faces: adjacency.overfull_faces.clone(),
            non_manifold_edges,
            overlapping_pairs,
            reflex_edges,
            not_delaunay,
        }
    }

    /// What [`TopologyCensus::is_convex`] asks but that no neighbours overlap, without looking at interior faces.
    pub(crate) fn has_convex_boundary(mesh: &TetMesh, adjacency: &Adjacency) -> bool {
        let is_clean = || {
            let (non_manifold, reflex) = examine_boundary(mesh, adjacency, coordinate_rounding(mesh));
            non_manifold.count == 0 && reflex.count == 0
        };
        adjacency.overfull_faces.count == 0 && count_components(adjacency) == 1 && is_clean()
    }
}

/// How far off a coordinate stored as f32 may be, mesh space.
fn coordinate_rounding(mesh: &TetMesh) -> f64 {
    let bounds = mesh.bounds_in_data();
    let largest = bounds.min.abs().max(bounds.max.abs()).max_element();
    0.5 * f64::from(f32::EPSILON) * largest / mesh.data_per_mesh
}

fn count_components(adjacency: &Adjacency) -> u64 {
    let mut seen = vec![false; adjacency.neighbors.len()];
    let (mut components, mut waiting) = (0, Vec::new());
    for start in 0..seen.len() {
        if std::mem::replace(&mut seen[start], true) {
            continue;
        }
        components += 1;
        waiting.push(start as u32);
        while let Some(tet) = waiting.pop() {
            for &next in &adjacency.neighbors[tet as usize] {
                if next != NO_TET && !std::mem::replace(&mut seen[next as usize], true) {
                    waiting.push(next);
                }
            }
        }
    }
    components
}

/// Non-manifold and reflex edges of the boundary. A closed surface that is convex at every edge bounds a convex body
/// (Tietze 1928, Nakajima 1928), so edges suffice.
fn examine_boundary(mesh: &TetMesh, adjacency: &Adjacency, rounding: f64) -> (Finding, Finding) {
    // (smaller vertex, larger vertex, face, the face's third vertex)
    let faces: Vec<[u32; 3]> =
        adjacency.boundary_faces().map(|(t, f)| FACES[f].map(|i| mesh.tets[t.0 as usize][i])).collect();
    let mut edges: Vec<[u32; 4]> = Vec::with_capacity(3 * faces.len());
    for (f, face) in faces.iter().enumerate() {
        for i in 0..3 {
            let (a, b) = (face[i], face[(i + 1) % 3]);
            edges.push([a.min(b), a.max(b), f as u32, face[(i + 2) % 3]]);
        }
    }
    edges.par_sort_unstable();
    let (mut non_manifold, mut reflex) = ((0, None), (0, None));
    let note = |finding: &mut (u64, Option<String>), [a, b, ..]: [u32; 4]| {
        finding.0 += 1;
        finding.1.get_or_insert_with(|| format!("edge of vertices {a}, {b}"));
    };
    let at = |v: u32| mesh.vertices[v as usize];
    for same in edges.chunk_by(|a, b| a[..2] == b[..2]) {
        match same {
            [one, other] => {
                if is_beyond(faces[one[2] as usize].map(at), at(other[3]), rounding) {
                    note(&mut reflex, *one);
                }
            }
            _ => note(&mut non_manifold, same[0]),
        }
    }
    (Finding::of(non_manifold.0, non_manifold.1), Finding::of(reflex.0, reflex.1))
}

/// Whether `d` lies outside the plane of an outward face, so far that moving all four points by `rounding` along each
/// axis could not bring it back.
fn is_beyond([a, b, c]: [DVec3; 3], d: DVec3, rounding: f64) -> bool {
    let area = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).length();
    // The volume's derivative by a vertex is the opposite face's area (twice: six times the volume).
    let areas = area(a, b, c) + area(a, b, d) + area(a, c, d) + area(b, c, d);
    six_volumes([a, b, c, d]) > 3_f64.sqrt() * rounding * areas
}

/// Overlapping neighbours, and faces that are not locally Delaunay.
fn examine_interior(mesh: &TetMesh, adjacency: &Adjacency, rounding: f64) -> (Finding, Finding) {
    let (overlapping, not_delaunay) = (0..mesh.tets.len())
        .into_par_iter()
        .fold(
            || (Tally::default(), Tally::default()),
            |mut tallies, t| {
                for (face, &neighbor) in adjacency.neighbors[t].iter().enumerate() {
                    // Each pair once.
                    if neighbor == NO_TET || neighbor as usize <= t {
                        continue;
                    }
                    let across = opposite_vertex(mesh, t, face, neighbor);
                    match examine_pair(mesh.corners(TetId(t as u32)), face, across, rounding) {
                        Pair::Overlapping => tallies.0.add(t),
                        Pair::NotDelaunay => tallies.1.add(t),
                        Pair::Delaunay => {}
                    }
                }
                tallies
            },
        )
        .reduce(|| (Tally::default(), Tally::default()), |a, b| (a.0.merge(b.0), a.1.merge(b.1)));
    (overlapping.finding("tetrahedron"), not_delaunay.finding("tetrahedron"))
}

/// The neighbour's vertex that is not on the shared face.
fn opposite_vertex(mesh: &TetMesh, tet: usize, face: usize, neighbor: u32) -> DVec3 {
    let shared = FACES[face].map(|i| mesh.tets[tet][i]);
    let other = mesh.tets[neighbor as usize];
    let v = other.into_iter().find(|v| !shared.contains(v)).unwrap_or(mesh.tets[tet][face]);
    mesh.vertices[v as usize]
}

#[derive(Debug, PartialEq)]
enum Pair {
    Overlapping,
    Delaunay,
    NotDelaunay,
}

/// How `p`, beyond `face`, lies to the tetrahedron's circumsphere.
///
/// With p's barycentric coordinates w, its power is `|p - c|^2 - R^2 = -sum w |v - p|^2`. Moving p by e changes it by
/// at most 2 R e near the sphere, moving vertex v by 2 R e |w|.
fn examine_pair(corners: [DVec3; 4], face: usize, p: DVec3, rounding: f64) -> Pair {
    let volume = six_volumes(corners);
    let weights: [f64; 4] = std::array::from_fn(|i| {
        let mut moved = corners;
        moved[i] = p;
        six_volumes(moved) / volume
    });
    if weights[face] >= 0.0 {
        return Pair::Overlapping;
    }
    let power = -weights.iter().zip(corners).map(|(w, v)| w * (v - p).length_squared()).sum::<f64>();
    let [a, b, c, d] = corners;
    let (u, v, w) = (b - a, c - a, d - a);
    let center_from_a =
        (u.length_squared() * v.cross(w) + v.length_squared() * w.cross(u) + w.length_squared() * u.cross(v))
            / (2.0 * volume);
    let reach: f64 = 1.0 + weights.iter().map(|w| w.abs()).sum::<f64>();
    let tolerance = 2.0 * center_from_a.length() * 3_f64.sqrt() * rounding * reach;
    if power < -tolerance { Pair::NotDelaunay } else { Pair::Delaunay }
}

impl fmt::Display for TopologyCensus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_count(f, "parts not joined by faces", self.components)?;
        write_count(f, "boundary faces", self.boundary_faces)?;
        write_finding(f, "faces of more than two tetrahedra", &self.overfull_faces)?;
        write_finding(f, "boundary edges not of two faces", &self.non_manifold_edges)?;
        write_finding(f, "overlapping neighbours", &self.overlapping_pairs)?;
        write_finding(f, "reflex boundary edges", &self.reflex_edges)?;
        write_finding(f, "faces not locally Delaunay", &self.not_delaunay)?;
        let answer = |yes| if yes { "yes" } else { "no" };
        writeln!(f, "{:<38}{:>14}", "convex", answer(self.is_convex()))?;
        writeln!(f, "{:<38}{:>14}", "Delaunay", answer(self.is_delaunay()))
    }
}
