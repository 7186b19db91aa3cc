//! Functions whose colour varies so much that any exchange of two cells on a ray is seen.

use tetralux::scene::{Curve, CurveNode, TransferFunction};
use tetralux::tet::TetMesh;

const COLORS: [[f64; 3]; 6] =
    [[1.0, 0.1, 0.1], [0.9, 0.9, 0.1], [0.1, 1.0, 0.2], [0.1, 0.9, 0.9], [0.2, 0.2, 1.0], [0.9, 0.1, 0.9]];

/// Thin bands over the scalar's range, a fifth of what lies between two of them; neighbours differ in colour. `depth`: what
/// the mesh's diagonal would have if its scalars were spread evenly.
pub fn rainbow(mesh: &TetMesh, bands: u32, depth: f64) -> TransferFunction {
    let (range, diagonal) = (mesh.scalar_range(), mesh.bounds_in_data().diagonal());
    let (half_width, peak) = (0.1 / f64::from(bands), 10.0 * depth / diagonal);
    let band = |i: u32| {
        let middle = (f64::from(i) + 0.5) / f64::from(bands);
        [(-half_width, 0.0), (0.0, peak), (half_width, 0.0)].map(|(off, extinction)| CurveNode {
            scalar: range.min + (middle + off) * range.length(),
            color: COLORS[i as usize % COLORS.len()],
            extinction,
        })
    };
    TransferFunction::Curve(Curve { nodes: (0..bands).flat_map(band).collect() })
}
