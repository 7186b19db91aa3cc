//! What a plane leaves of a tetrahedron.

use super::split::{Pieces, split};
use crate::mesh::CellKind;

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

/// The part of a tetrahedron on that side of a plane where the `kept` corners are, in pieces of its orientation; some may
/// have no volume. `on` names the vertex where an edge meets the plane.
///
/// Quadrilaterals are cut from their smallest ids, so that pieces of neighbours agree where `on` does.
pub(crate) fn part(tet: [u32; 4], kept: [bool; 4], mut on: impl FnMut(u32, u32) -> u32) -> Option<Pieces> {
    let count = kept.iter().filter(|&&b| b).count();
    let is_sorted = |order: &&[usize; 4]| order.iter().enumerate().all(|(at, &i)| kept[i] == (at < count));
    let [a, b, c, d] = EVEN.iter().find(is_sorted)?.map(|i| tet[i]);
    match count {
        1 => Some(split(CellKind::Tetrahedron, &[a, on(a, b), on(a, c), on(a, d)])),
        2 => Some(split(CellKind::Wedge, &[a, on(a, c), on(a, d), b, on(b, c), on(b, d)])),
        3 => Some(split(CellKind::Wedge, &[a, b, c, on(a, d), on(b, d), on(c, d)])),
        4 => Some(split(CellKind::Tetrahedron, &tet)),
        _ => None,
    }
}
