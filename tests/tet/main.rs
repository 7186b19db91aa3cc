//! What a `TetMesh` promises, and what its census tells.

mod census;
mod clip;
mod data;
mod field;
mod histogram;
mod laws;
mod series;
mod suggest;
mod support;
mod topology;
