//! VTK's cell type codes: which are volume cells, by which nodes they are read, and what the others are called.

use super::CellKind;

/// What becomes of a cell of some type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CellClass {
    /// A volume cell: its first `kind.node_count()` nodes are its corners, of at least `nodes` nodes.
    Volume {
        /// The linear shape.
        kind: CellKind,
        /// Nodes that the cell has.
        nodes: NodeCount,
    },
    /// Left out, with the word under which it is counted.
    LeftOut(&'static str),
}

/// How many nodes a cell of some type has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NodeCount {
    /// Always so many.
    Exactly(usize),
    /// Of arbitrary order: at least the corners.
    AtLeast(usize),
}

impl NodeCount {
    /// Whether a cell may have `count` nodes.
    pub(super) fn allows(self, count: usize) -> bool {
        match self {
            Self::Exactly(n) => count == n,
            Self::AtLeast(n) => count >= n,
        }
    }
}

impl std::fmt::Display for NodeCount {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Exactly(n) => write!(f, "{n}"),
            Self::AtLeast(n) => write!(f, "at least {n}"),
        }
    }
}

/// What to do with a cell of VTK type `code` (vtkCellType.h). In all its volume cells the corners come first, in the
/// order of the linear cell.
pub(super) fn classify(code: u64) -> CellClass {
    use CellKind::{Hexahedron, Pyramid, Tetrahedron, Voxel, Wedge};
    use NodeCount::{AtLeast, Exactly};
    let volume = |kind, nodes| CellClass::Volume { kind, nodes };
    match code {
        10 => volume(Tetrahedron, Exactly(4)),
        11 => volume(Voxel, Exactly(8)),
        12 => volume(Hexahedron, Exactly(8)),
        13 => volume(Wedge, Exactly(6)),
        14 => volume(Pyramid, Exactly(5)),
        // Quadratic and its relatives.
        24 => volume(Tetrahedron, Exactly(10)),
        25 => volume(Hexahedron, Exactly(20)),
        26 => volume(Wedge, Exactly(15)),
        27 => volume(Pyramid, Exactly(13)),
        29 => volume(Hexahedron, Exactly(27)),
        31 => volume(Wedge, Exactly(12)),
        32 => volume(Wedge, Exactly(18)),
        33 => volume(Hexahedron, Exactly(24)),
        37 => volume(Pyramid, Exactly(19)),
        // Of arbitrary order: "higher order", Lagrange, Bezier.
        64 | 71 | 78 => volume(Tetrahedron, AtLeast(4)),
        67 | 72 | 79 => volume(Hexahedron, AtLeast(8)),
        65 | 73 | 80 => volume(Wedge, AtLeast(6)),
        66 | 74 | 81 => volume(Pyramid, AtLeast(5)),
        other => CellClass::LeftOut(left_out(other)),
    }
}

/// Whether the corners alone are read of a cell of this type.
pub(super) fn is_higher_order(code: u64) -> bool {
    code > 14 && matches!(classify(code), CellClass::Volume { .. })
}

fn left_out(code: u64) -> &'static str {
    match code {
        0 => "empty cells left out",
        1 | 2 => "0D cells (vertices) left out",
        3 | 4 | 21 | 35 | 60 | 68 | 75 => "1D cells (lines) left out",
        5..=9 | 22 | 23 | 28 | 30 | 34 | 36 | 61..=63 | 69 | 70 | 76 | 77 => "2D cells left out",
        15 => "pentagonal prisms left out: split them into tetrahedra to render them",
        16 => "hexagonal prisms left out: split them into tetrahedra to render them",
        41 => "convex point sets left out: split them into tetrahedra to render them",
        42 => "polyhedra left out: split them into tetrahedra to render them",
        51..=56 => "parametric cells left out",
        _ => "cells of unknown type left out",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_never_outnumber_nodes() {
        for code in 0..=255 {
            if let CellClass::Volume { kind, nodes } = classify(code) {
                let fewest = match nodes {
                    NodeCount::Exactly(n) | NodeCount::AtLeast(n) => n,
                };
                assert_eq!(fewest > kind.node_count(), is_higher_order(code) && code < 60, "{code}");
                assert!(fewest >= kind.node_count() && !nodes.allows(fewest - 1), "{code}");
            }
        }
        assert!(!NodeCount::Exactly(4).allows(5));
    }
}
