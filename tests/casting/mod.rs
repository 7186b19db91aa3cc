//! What is asked of every engine that casts rays. The binary that includes this says which: `engine`,
//! and whether that compiles shaders for each function, which takes seconds: `COMPILES`.

mod agreement;
mod integrals;
pub mod overlap;
mod peers;
mod real;
mod watertight;
