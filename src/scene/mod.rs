//! What the user chose, independent of the mesh: camera, transfer function, image; and the scene file.

mod camera;
mod suggest;
mod transfer;

pub use camera::{Basis, Camera, Projection};
pub use suggest::suggest;
pub use transfer::{Curve, CurveNode, TransferFunction, Widget, WidgetShape};
