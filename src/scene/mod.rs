//! What the user chose, independent of the mesh: camera, transfer function, image; and the scene file.

mod camera;
mod choice;
mod document;
mod file;
mod resolve;
mod suggest;
mod transfer;

pub use camera::{Basis, Camera, Projection};
pub use choice::{CameraChoice, Opening, Scene, TransferChoice, Units, Viewpoint};
pub use document::Override;
pub use file::MAX_WIDGETS;
pub use suggest::suggest;
pub use transfer::{Curve, CurveNode, TransferFunction, Widget, WidgetShape};
