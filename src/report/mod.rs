//! What runs are worth, in numbers for people: how far an integral is from the truth, case by case; what a picture took
//! and how far it is from the truth; which runs no other beats; what became worse between two lists of runs; where
//! renderers stop being right.

pub mod diff;
pub mod front;
pub mod record;
pub mod segments;
pub mod stability;
