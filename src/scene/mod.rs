//! What the user chose, independent of the mesh: camera, transfer function, image; and the scene file.

mod camera;
mod choice;
mod document;
mod file;
mod optics;
mod optics_keys;
mod resolve;
mod shape;
mod suggest;
mod transfer;
mod widget;
mod widget_keys;
mod write;

pub use camera::{Basis, Camera, Projection};
pub use choice::{CameraChoice, Draft, Opening, Scene, TransferChoice, Units, Viewpoint, stretch_gaussian};
pub use document::Override;
pub use file::MAX_WIDGETS;
pub use optics::{
    EmissionModel, GRADIENT_FLOOR, HALF_VECTOR_FLOOR, LightSpace, Lighting, Optics, Silhouette, SilhouetteMode,
};
pub use shape::{SinusoidVariant, WidgetShape, Window};
pub use suggest::{boundaries, homogeneous_regions, suggest};
pub use transfer::{Curve, CurveNode, Terms, TransferFunction};
pub use widget::Widget;
