//! What is asked of every engine that casts rays. The binary that includes this says which: `engine`.

mod agreement;
mod integrals;
mod peers;
mod real;
mod watertight;
