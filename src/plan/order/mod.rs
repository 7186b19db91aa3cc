//! In which order cells are blended: back to front, as far as that can be had.
//!
//! | order | is right | costs |
//! | --- | --- | --- |
//! | [`centroid_depth`] | for nothing but fog: a fifth of all neighbours come out wrong | a sort |
//!
//! [`VisibilityOrder::inversions`] tests any of them for one camera, [`sampled_inversions`] for many.

mod centroid;
mod face;
mod inversions;
mod vantage;
mod visibility;

pub use self::centroid::centroid_depth;
pub use self::inversions::{Inversions, sample_cameras, sampled_inversions};
pub use self::vantage::Vantage;
pub use self::visibility::VisibilityOrder;
