//! What runs are worth, in numbers for people: how far an integral is from the truth, case by case; what a picture took
//! and how far it is from the truth; where renderers stop being right.

pub mod record;
pub mod segments;
pub mod stability;
