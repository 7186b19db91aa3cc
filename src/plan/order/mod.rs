//! In which order cells are blended: back to front, as far as that can be had.
//!
//! | order | is right | costs |
//! | --- | --- | --- |
//! | [`centroid_depth`] | for nothing but fog: a fifth of all neighbours come out wrong | a sort |
//! | [`PowerOrder`] | for Delaunay meshes and affine images of them; a [`PowerCensus`] tells | a sort |
//! | [`mpvonc`] | between neighbours, where no cells hide one another in a circle | a walk over all cells |
//! | [`exact`] | along one picture's rays, gaps and holes too, up to circles and overlapping parts | the same, and the boundary's rays |
//!
//! [`VisibilityOrder::inversions`] tests any of them for one camera, [`sampled_inversions`] for many.

mod centroid;
mod exact;
mod face;
mod gaps;
mod inversions;
mod lifting;
mod metric;
mod mpvonc;
mod nearest;
mod pieces;
mod power;
mod power_census;
mod sequence;
mod vantage;
mod visibility;

pub use self::centroid::centroid_depth;
pub use self::exact::exact;
pub use self::inversions::{Inversions, sample_cameras, sampled_inversions};
pub use self::metric::Metric;
pub use self::mpvonc::mpvonc;
pub use self::pieces::ranks_with_pieces;
pub use self::power::PowerOrder;
pub use self::power_census::{PowerCensus, Proof};
pub use self::sequence::Sequenced;
pub use self::vantage::Vantage;
pub use self::visibility::VisibilityOrder;
