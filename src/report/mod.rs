//! What runs are worth, in numbers for people: how far an integral is from the truth, case by case.

pub mod segments;
