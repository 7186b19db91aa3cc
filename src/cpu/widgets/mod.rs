//! Sums of widgets along a segment, in f32: hand-written twins of `shaders/shared/widgets.wgsl`, `adaptive.wgsl` and what
//! they import.
//!
//! Uniform and Gaussian widgets without windows have a medium of their own (`plain`): most scenes need no more, and it is the
//! fastest. Any others are [`AnyWidget`]s, which are summed where one colour or evenly mixed colours will do
//! ([`AnyWidgets`]), and bisected where they will not ([`AdaptiveWidgets`]). The integrals to compare with are linear between
//! special points ([`PartialWidgets`]), or know points alone ([`PointMedium`], of 1D functions, too).

mod adaptive;
mod any;
mod compile;
mod gaussian;
mod knots;
mod lane_optics;
mod line;
mod optics;
mod partial;
mod plain;
mod points;
mod profile;
mod special;
mod turns;
mod waves;

pub use adaptive::{AdaptiveWidgets, MOST_WIDGETS};
pub use any::{AnyWidget, AnyWidgets};
pub use compile::{Axes, any_widgets, plain_widgets};
pub use line::{Line, extremes};
pub use optics::{attenuation, phi_one};
pub use partial::PartialWidgets;
pub use plain::PlainWidgets;
pub use points::{Classifier, PointMedium, PointRule};
