//! The native engine: ray casting from cell to cell (HARC; Weiler et al. 2003) in f32, on all cores.
//!
//! # A step
//!
//! Each ray has its own axes: two across it, and the distance along it. Seen along the ray, the face of entry is a triangle
//! around the origin; the cell's fourth vertex cuts it into three, and the one around the origin is the face of exit.
//! Which one is said by the signs of three edges that end at that vertex. A vertex is at one place for all of its cells,
//! in f32; edges are evaluated in f64, where products of f32 numbers are exact, so each has the one sign that exact
//! arithmetic gives it. Edges that the ray meets count as if it were moved sideways by an infinitesimal. So exactly one
//! of the three triangles holds the origin, always: `walk.rs` tells why no ray gets lost. Depth and fields of the exit
//! are means of the face's corners weighted by the edges: between their extremes even in slivers, and equal for both
//! cells of a face.
//!
//! Only the fourth vertex is new in a step, so a cell is 32 bytes (four vertices, four links) and its step reads
//! these and one vertex of 16.
//!
//! # Visibility
//!
//! Where rays may enter is found by rasterising the boundary faces, a little enlarged, into one list a pixel, of any length,
//! sorted by depth (`plan/entries.rs`). Whether they do is decided by the signs that the faces' edges have in the walk, so that
//! a ray enters a closed surface exactly as often as it leaves. Each entry starts one walk, and a walk ends at the
//! boundary: holes, slits and concave parts need no special case.
//!
//! # Segments
//!
//! Between two faces a transfer function is one of several media, chosen once a scene (`transfer.rs`), and what is seen of
//! each segment is its closed form: of 1D functions in `segment.rs`, of widgets in `widgets/`. Widgets of several colours
//! are bisected to the tolerance asked for.

mod axes;
mod cast;
mod empty;
mod path;
mod preintegrated;
mod renderer;
mod segment;
mod transfer;
mod walk;
mod widgets;

pub use path::{Path, path};
pub use renderer::{CpuRenderer, supports};
pub use transfer::{Integrated, integrate};
