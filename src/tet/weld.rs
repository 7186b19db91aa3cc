//! Points at exactly one place: found, counted, and merged where that is asked for.

use glam::DVec3;
use rayon::prelude::*;

use super::cells::Cells;
use super::census::{Finding, Tally};

/// The listed points, those at one place next to each other and in order of their index.
fn by_place(points: &[DVec3], listed: Vec<usize>) -> Vec<([u64; 3], usize)> {
    // Adding 0 makes -0 and 0 the same bits; order among the keys means nothing, equality does.
    let key = |i: usize| (points[i] + DVec3::ZERO).to_array().map(f64::to_bits);
    let mut keyed: Vec<([u64; 3], usize)> = listed.into_par_iter().map(|i| (key(i), i)).collect();
    keyed.par_sort_unstable();
    keyed
}

/// Points at exactly an earlier point's place.
pub(super) fn coincident(kept: &[usize], points: &[DVec3]) -> Finding {
    let keyed = by_place(points, kept.to_vec());
    let twins = || keyed.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    let first = twins().min_by_key(|pair| pair[1].1);
    let first = first.map(|pair| format!("point {}, where point {} is", pair[1].1, pair[0].1));
    Finding::of(twins().count() as u64, first)
}

/// For each point the first one at its place, itself among them; only points that cells name are looked at. And which
/// points are gone thereby.
pub(super) fn first_at_place(points: &[DVec3], cells: &Cells<'_>) -> (Vec<u32>, Tally) {
    let mut named = vec![false; points.len()];
    cells.for_each(|cell| cell.nodes.iter().for_each(|&n| named[n as usize] = true));
    // Indices fit: cells name points by u32.
    let mut first: Vec<u32> = (0..points.len() as u32).collect();
    let mut merged = Tally::default();
    let keyed = by_place(points, (0..points.len()).filter(|&i| named[i]).collect());
    for group in keyed.chunk_by(|a, b| a.0 == b.0) {
        for &(_, i) in &group[1..] {
            first[i] = group[0].1 as u32;
            merged.add(i);
        }
    }
    (first, merged)
}
