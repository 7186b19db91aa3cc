//! Which tetrahedra share a face.

use std::sync::atomic::{AtomicU32, Ordering};

use rayon::prelude::*;

use super::census::Finding;
use super::{NO_TET, TetId, TetMesh};

/// The face opposite each corner of a tetrahedron, as corners, counter-clockwise seen from outside.
pub const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Neighbours across faces. Not part of a [`TetMesh`], since projection does without.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Adjacency {
    /// The tetrahedron across the face opposite each corner; [`NO_TET`] on the boundary.
    pub neighbors: Vec<[u32; 4]>,
    /// Faces that more than two tetrahedra share. There is no telling who meets whom, so they count as boundary for
    /// all of them.
    pub overfull_faces: Finding,
}

/// A face beyond its smallest vertex: the middle and the largest vertex, and four times the tetrahedron plus the
/// opposite corner.
type FaceEntry = [u32; 3];

impl Adjacency {
    /// Finds all neighbours. Needs about 60 bytes a tetrahedron while at work, and leaves 16.
    pub fn new(mesh: &TetMesh) -> Self {
        let (starts, mut entries) = faces_by_smallest_vertex(mesh);
        let neighbors: Vec<[AtomicU32; 4]> =
            mesh.tets.iter().map(|_| std::array::from_fn(|_| AtomicU32::new(NO_TET))).collect();
        let link = |a: u32, b: u32| neighbors[(a / 4) as usize][(a % 4) as usize].store(b / 4, Ordering::Relaxed);
        let overfull = bucket_groups(&starts, &mut entries)
            .into_par_iter()
            .map(|group| {
                let mut overfull = Overfull::default();
                for vertex in group.vertices.clone() {
                    let from = starts[group.vertices.start];
                    let bucket = &mut group.entries[starts[vertex] - from..starts[vertex + 1] - from];
                    bucket.sort_unstable();
                    for same in bucket.chunk_by(|a, b| a[..2] == b[..2]) {
                        match same {
                            [a, b] => {
                                link(a[2], b[2]);
                                link(b[2], a[2]);
                            }
                            [_] => {}
                            _ => overfull.add([vertex as u32, same[0][0], same[0][1]]),
                        }
                    }
                }
                overfull
            })
            .reduce(Overfull::default, Overfull::merge);
        Self {
            neighbors: neighbors.into_iter().map(|n| n.map(AtomicU32::into_inner)).collect(),
            overfull_faces: overfull.finding(),
        }
    }

    /// The tetrahedron across the face opposite corner `face` (0 to 3); `None` on the boundary.
    pub fn across(&self, tet: TetId, face: usize) -> Option<TetId> {
        let neighbor = self.neighbors[tet.0 as usize][face];
        (neighbor != NO_TET).then_some(TetId(neighbor))
    }

    /// All boundary faces, as (tetrahedron, opposite corner), in order.
    pub fn boundary_faces(&self) -> impl Iterator<Item = (TetId, usize)> + '_ {
        self.neighbors.iter().enumerate().flat_map(|(t, neighbors)| {
            (0..4).filter(move |&f| neighbors[f] == NO_TET).map(move |f| (TetId(t as u32), f))
        })
    }
}

/// A face's vertices, ascending.
fn sorted_face(tet: [u32; 4], face: usize) -> [u32; 3] {
    let [a, b, c] = FACES[face].map(|i| tet[i]);
    let (low, high) = (a.min(b), a.max(b));
    [low.min(c), low.max(c.min(high)), high.max(c)]
}

/// All faces, in buckets by their smallest vertex; bucket `v` is `starts[v]..starts[v + 1]`.
fn faces_by_smallest_vertex(mesh: &TetMesh) -> (Vec<usize>, Vec<FaceEntry>) {
    let mut starts = vec![0_usize; mesh.vertices.len() + 2];
    for &tet in mesh.tets.iter() {
        for face in 0..4 {
            starts[sorted_face(tet, face)[0] as usize + 2] += 1;
        }
    }
    for v in 2..starts.len() {
        starts[v] += starts[v - 1];
    }
    // `starts[v + 1]` is where bucket v begins; filling the bucket moves it to where the bucket ends.
    let mut entries = vec![[0; 3]; 4 * mesh.tets.len()];
    for (t, &tet) in mesh.tets.iter().enumerate() {
        for face in 0..4 {
            let [low, middle, high] = sorted_face(tet, face);
            let at = &mut starts[low as usize + 1];
            entries[*at] = [middle, high, 4 * t as u32 + face as u32];
            *at += 1;
        }
    }
    starts.pop();
    (starts, entries)
}

/// Consecutive buckets that one task works through.
struct BucketGroup<'a> {
    vertices: std::ops::Range<usize>,
    entries: &'a mut [FaceEntry],
}

fn bucket_groups<'a>(starts: &[usize], mut entries: &'a mut [FaceEntry]) -> Vec<BucketGroup<'a>> {
    const VERTICES: usize = 4096;
    let vertex_count = starts.len() - 1;
    (0..vertex_count)
        .step_by(VERTICES)
        .map(|first| {
            let vertices = first..(first + VERTICES).min(vertex_count);
            let (group, rest) =
                std::mem::take(&mut entries).split_at_mut(starts[vertices.end] - starts[vertices.start]);
            entries = rest;
            BucketGroup { vertices, entries: group }
        })
        .collect()
}

/// Faces shared by more than two, while counting.
#[derive(Clone, Copy, Default)]
struct Overfull {
    count: u64,
    first: Option<[u32; 3]>,
}

impl Overfull {
    fn add(&mut self, face: [u32; 3]) {
        *self = self.merge(Self { count: 1, first: Some(face) });
    }

    fn merge(self, other: Self) -> Self {
        let first = self.first.into_iter().chain(other.first).min();
        Self { count: self.count + other.count, first }
    }

    fn finding(self) -> Finding {
        Finding::of(self.count, self.first.map(|[a, b, c]| format!("face of vertices {a}, {b}, {c}")))
    }
}
