//! The native engine: ray casting from cell to cell (HARC; Weiler et al. 2003) in f32, on all cores.
//!
//! # Lanes
//!
//! As many rays as the processor has lanes (16 with AVX-512, 8 with AVX2, 4 with Neon, found out when the program runs) walk
//! in step, each through cells of its own; a lane that has done with a ray takes the tile's next one (`cast.rs`). What differs
//! from lane to lane is chosen, not branched to. What a step needs from memory is asked for as soon as the ray's way is
//! known, one step ahead: while it comes, the segment is integrated.
//!
//! # A step
//!
//! Each ray has its own axes: two across it, and the distance along it. Seen along the ray, the face of entry is a triangle
//! around the origin; the cell's fourth vertex cuts it into three, and the one around the origin is the face of exit.
//! Which one is said by the signs of three edges that end at that vertex. A vertex is at one place for all of its cells,
//! in f32; edges are evaluated to 1.5 ulp, so each has the one sign that exact arithmetic gives it. Edges that the ray
//! meets count as if it were moved sideways by an infinitesimal. So exactly one of the three triangles holds the
//! origin, always: `walk.rs` tells why no ray gets lost. Depth and fields of the exit are means of the face's corners
//! weighted by the edges: between their extremes even in slivers, and equal for both cells of a face.
//!
//! Only the fourth vertex is new in a step, so a step reads 32 bytes of its cell (links across the four faces, and the
//! vertices there) and one vertex of 16.
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
//! each segment is its closed form: of 1D functions in `curve.rs`, of widgets in `widgets/`. Functions and plain widgets
//! are integrated in all lanes at once, any others lane by lane. Widgets of several colours are bisected to the
//! tolerance asked for.

mod axes;
mod cast;
mod composite;
mod corner;
mod curve;
mod empty;
mod face;
mod lanes;
mod listing;
mod path;
mod picture;
mod preintegrated;
mod renderer;
mod segment;
mod sink;
mod transfer;
mod walk;
mod widgets;

pub use path::{Path, path};
pub use renderer::{CpuRenderer, describe, supports};
pub use transfer::{Integrated, integrate};
