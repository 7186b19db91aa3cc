//! Finds points that several pieces of a parallel file hold alike, so that the joined mesh is conforming.

use glam::DVec3;
use rayon::prelude::*;

/// What became of the points.
pub(super) struct Welded {
    /// For each old point its new index; meaningless for points that are not used.
    pub(super) new_index: Vec<u32>,
    /// The old index of each new point.
    pub(super) kept: Vec<u32>,
    /// How many used points are gone.
    pub(super) merged: u64,
}

/// Merges used points of different pieces with equal coordinates (bit by bit, but 0 = -0), and equal `ids` where given.
///
/// Points that coincide within one piece stay apart (they are the two sides of a slit): the n-th of them is merged with
/// the n-th of other pieces. `starts` holds the first point of each piece, ascending from 0.
pub(super) fn weld(points: &[DVec3], used: &[bool], starts: &[u32], ids: Option<&[f64]>) -> Welded {
    let key = |i: u32| {
        let p = points[i as usize];
        let id = ids.and_then(|ids| ids.get(i as usize)).map_or(0, |id| id.to_bits());
        ([p.x, p.y, p.z].map(|x| (x + 0.0).to_bits()), id)
    };
    let mut order: Vec<u32> = (0..points.len() as u32).filter(|&i| used[i as usize]).collect();
    order.par_sort_unstable_by_key(|&i| (key(i), i));
    let piece = |i: u32| starts.partition_point(|&start| start <= i);
    let mut first: Vec<u32> = (0..points.len() as u32).collect();
    for group in order.chunk_by(|&a, &b| key(a) == key(b)).filter(|g| g.len() > 1) {
        let mut distinct: Vec<u32> = Vec::new();
        let (mut current, mut rank) = (0, 0);
        for &i in group {
            if piece(i) != current {
                (current, rank) = (piece(i), 0);
            }
            match distinct.get(rank) {
                Some(&other) => first[i as usize] = other,
                None => distinct.push(i),
            }
            rank += 1;
        }
    }
    let mut new_index = vec![0; points.len()];
    let mut kept = Vec::new();
    for i in (0..points.len()).filter(|&i| used[i]) {
        // The first of a group has the lowest index: it is numbered already.
        if first[i] as usize == i {
            new_index[i] = kept.len() as u32;
            kept.push(i as u32);
        } else {
            new_index[i] = new_index[first[i] as usize];
        }
    }
    let merged = (order.len() - kept.len()) as u64;
    Welded { new_index, kept, merged }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slits_stay_open_and_pieces_are_joined() {
        let p = DVec3::new(1.0, 0.0, 2.0);
        let q = DVec3::new(1.0, -0.0, 2.0);
        let far = DVec3::splat(9.0);
        // Two pieces of three points: a slit at p in each, and one point of its own.
        let points = [p, p, far, q, far + 1.0, q];
        let welded = weld(&points, &[true; 6], &[0, 3], None);
        assert_eq!(welded.new_index, [0, 1, 2, 0, 3, 1]);
        assert_eq!((welded.kept.as_slice(), welded.merged), (&[0, 1, 2, 4][..], 2));
        // Ids tell apart what lies at one place; an unused point is dropped.
        let ids = [1.0, 2.0, 3.0, 2.0, 5.0, 6.0];
        let used = [true, true, true, true, false, true];
        let welded = weld(&points, &used, &[0, 3], Some(&ids));
        assert_eq!((welded.kept.as_slice(), welded.merged), (&[0, 1, 2, 5][..], 1));
        assert_eq!(welded.new_index[3], 1);
    }
}
