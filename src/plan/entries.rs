//! Where rays may enter a mesh: its boundary faces, in the tiles of a picture.

use std::collections::HashSet;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::plan::lens::Lens;
use crate::tet::{Boundary, Side};

/// Where a ray may enter the mesh.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    /// The face.
    pub side: Side,
    /// View depth, mesh units.
    pub depth: f64,
}

/// The boundary as a lens sees it, in square tiles.
pub struct BoundaryView<'a> {
    boundary: &'a Boundary,
    /// View axes.
    points: Vec<DVec3>,
    perspective: bool,
    /// Pixels along a tile's side.
    side: u32,
    tiles: [u32; 2],
    /// Faces of tile `i`: `members[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    members: Vec<u32>,
}

/// All that may be entries of one ray by trying every face, nearest first.
pub fn of_ray(boundary: &Boundary, lens: &Lens, film: DVec2) -> Vec<Entry> {
    let points: Vec<DVec3> = boundary.points.iter().map(|&p| lens.view(p)).collect();
    let mut entries: Vec<Entry> = boundary
        .faces
        .iter()
        .filter_map(|face| {
            let triangle = Triangle::new(face.points.map(|p| points[p as usize]), lens.perspective);
            triangle.entry_depth(film).map(|depth| Entry { side: face.side, depth })
        })
        .collect();
    entries.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    entries
}

impl<'a> BoundaryView<'a> {
    /// Sorts the faces into the tiles, of so many pixels a side, of a picture. `around`: sides of the cells in which
    /// rays begin anyway, which are left out.
    pub fn new(boundary: &'a Boundary, lens: &Lens, size: [u32; 2], side: u32, around: &[Side]) -> Self {
        let points: Vec<DVec3> = boundary.points.par_iter().with_min_len(1024).map(|&p| lens.view(p)).collect();
        let tiles = size.map(|n| n.div_ceil(side));
        let around: HashSet<u32> = around.iter().map(|side| side.cell).collect();
        let boxes: Vec<Option<[u32; 4]>> = boundary
            .faces
            .par_iter()
            .with_min_len(256)
            .map(|face| {
                let corners = face.points.map(|p| points[p as usize]);
                if around.contains(&face.side.cell) || Triangle::new(corners, lens.perspective).surely_leaves() {
                    return None;
                }
                tiles_of(corners, lens, size, side)
            })
            .collect();
        let tiles_in = |[x0, x1, y0, y1]: [u32; 4]| {
            (y0..=y1).flat_map(move |y| (x0..=x1).map(move |x| (y * tiles[0] + x) as usize))
        };
        let mut starts = vec![0_u32; (tiles[0] * tiles[1]) as usize + 1];
        for tile in boxes.iter().flatten().flat_map(|&b| tiles_in(b)) {
            starts[tile + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut members = vec![0; starts.last().map_or(0, |&n| n as usize)];
        for (face, tiles) in (0_u32..).zip(&boxes) {
            for tile in tiles.iter().flat_map(|&b| tiles_in(b)) {
                members[next[tile] as usize] = face;
                next[tile] += 1;
            }
        }
        Self { boundary, points, perspective: lens.perspective, side, tiles, starts, members }
    }

    /// Tiles, row by row.
    pub fn tile_count(&self) -> u32 {
        self.tiles[0] * self.tiles[1]
    }

    /// The first pixel of a tile.
    pub fn tile_start(&self, tile: u32) -> [u32; 2] {
        [tile % self.tiles[0] * self.side, tile / self.tiles[0] * self.side]
    }

    /// The sides that are seen in each tile, packed for shaders, behind where each tile's begin (and the last's end).
    pub fn packed_tiles(&self) -> (&[u32], impl ExactSizeIterator<Item = u32>) {
        (&self.starts, self.members.iter().map(|&member| self.boundary.faces[member as usize].side.packed()))
    }

    /// Where the rays of a tile's pixels may enter.
    pub fn tile_entries(&self, tile: u32, lens: &Lens, size: [u32; 2]) -> TileEntries {
        let [left, top] = self.tile_start(tile);
        let [width, height] = [(size[0] - left).min(self.side), (size[1] - top).min(self.side)];
        let mut found: Vec<(u32, Entry)> = Vec::new();
        for &member in &self.members[self.starts[tile as usize] as usize..self.starts[tile as usize + 1] as usize] {
            let face = &self.boundary.faces[member as usize];
            let corners = face.points.map(|p| self.points[p as usize]);
            let triangle = Triangle::new(corners, self.perspective);
            let [x0, x1, y0, y1] = pixel_box(corners, lens).unwrap_or([f64::NEG_INFINITY; 4]);
            // Pixels whose centre the box holds; `as` saturates.
            let range = |low: f64, high: f64, start: u32, count: u32| {
                let first = (low - f64::from(start) - 0.5).ceil().max(0.0) as u32;
                first..((high - f64::from(start) + 0.5).max(0.0) as u32).min(count)
            };
            for y in range(y0, y1, top, height) {
                for x in range(x0, x1, left, width) {
                    if let Some(depth) = triangle.entry_depth(lens.film([left + x, top + y])) {
                        found.push((y * self.side + x, Entry { side: face.side, depth }));
                    }
                }
            }
        }
        TileEntries::new(&found, self.side)
    }
}

/// Entries of a tile's pixels, nearest first.
pub struct TileEntries {
    /// Pixels along the tile's side.
    side: u32,
    starts: Vec<u32>,
    entries: Vec<Entry>,
}

impl TileEntries {
    fn new(found: &[(u32, Entry)], side: u32) -> Self {
        let mut starts = vec![0_u32; (side * side) as usize + 1];
        for (pixel, _) in found {
            starts[*pixel as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut entries: Vec<Entry> = found.iter().map(|&(_, entry)| entry).collect();
        for (pixel, entry) in found {
            let at = &mut next[*pixel as usize];
            entries[*at as usize] = *entry;
            *at += 1;
        }
        for pixel in starts.windows(2) {
            entries[pixel[0] as usize..pixel[1] as usize].sort_unstable_by(|a, b| a.depth.total_cmp(&b.depth));
        }
        Self { side, starts, entries }
    }

    /// Those of one pixel.
    pub fn of(&self, x: u32, y: u32) -> &[Entry] {
        let pixel = (y * self.side + x) as usize;
        &self.entries[self.starts[pixel] as usize..self.starts[pixel + 1] as usize]
    }
}

/// How far rays and vertices in f32 lie from those in f64, mesh units, and more: seven times the worst of 200,000 rays.
const ROUNDING: f64 = 1e-6;

/// A face in view axes: whether, and where, rays may enter through it.
///
/// `edges[i]` is the normal of the plane through the eye and the edge opposite corner i (of the plane along z for
/// parallel rays).
struct Triangle {
    edges: [DVec3; 3],
    /// How far outside of each edge the walk, in f32, might still be inside.
    margins: [f64; 3],
    depths: [f64; 3],
    perspective: bool,
    leaves: bool,
}

impl Triangle {
    fn new(corners: [DVec3; 3], perspective: bool) -> Self {
        let depths = corners.map(|p| p.z);
        let [a, b, c] = corners.map(|p| if perspective { p } else { DVec3 { z: 1.0, ..p } });
        let edges = [b.cross(c), c.cross(a), a.cross(b)];
        let (nearest, farthest) = match perspective {
            true => (depths.into_iter().fold(f64::INFINITY, f64::min), depths.into_iter().fold(0.0, f64::max)),
            false => (1.0, 1.0),
        };
        // An edge's normal is as long as the edge, times its depth.
        let margins = edges.map(|n| ROUNDING * n.length() / nearest.max(ROUNDING));
        let volume = edges[0].dot(a);
        let leaves = nearest > 0.0 && volume < -2.0 * farthest * margins.iter().sum::<f64>();
        Self { edges, margins, depths, perspective, leaves: leaves || farthest <= 0.0 }
    }

    /// True where rays can only leave through it, whatever rounding does, or where it lies behind the eye.
    fn surely_leaves(&self) -> bool {
        self.leaves
    }

    /// The depth where a ray enters, if it passes inside of all edges or not certainly outside: which one it is, the
    /// walk decides with the signs that it has for edges.
    fn entry_depth(&self, film: DVec2) -> Option<f64> {
        let weights = self.edges.map(|n| n.x * film.x + n.y * film.y + n.z);
        if (0..3).any(|i| weights[i] < -self.margins[i]) {
            return None;
        }
        let weights = weights.map(|w| w.max(0.0));
        let sum: f64 = weights.iter().sum();
        let depth = (0..3).map(|i| weights[i] * self.depths[i]).sum::<f64>() / sum;
        // Seen edge-on, whatever depth.
        let depth = if depth.is_finite() { depth } else { self.depths[0] };
        (!self.perspective || depth > 0.0).then_some(depth)
    }
}

/// Bounding box in pixels (x from, to, y from, to) of what lies before the eye.
pub(super) fn pixel_box(corners: [DVec3; 3], lens: &Lens) -> Option<[f64; 4]> {
    // Nearer to the eye than any number of f32 tells apart.
    const LEAST: f64 = 1e-12;
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let mut add = |p: DVec3| {
        let film = if lens.perspective { p.truncate() / p.z } else { p.truncate() };
        let pixel = lens.pixel(film);
        // Nearer than the mesh's centre, rounding is larger in the picture.
        let depth = if lens.perspective { p.z.max(LEAST) } else { 1.0 };
        let margin = ROUNDING / depth / lens.pixel_size() + 1e-9 * pixel.abs();
        (low, high) = (low.min(pixel - margin), high.max(pixel + margin));
    };
    for i in 0..3 {
        let (a, b) = (corners[i], corners[(i + 1) % 3]);
        if !lens.perspective || a.z > LEAST {
            add(a);
        }
        if lens.perspective && (a.z > LEAST) != (b.z > LEAST) {
            add(DVec3 { z: LEAST, ..a.lerp(b, (LEAST - a.z) / (b.z - a.z)) });
        }
    }
    (low.x <= high.x).then_some([low.x, high.x, low.y, high.y])
}

/// First and last tile along x, then y, that the face may touch.
fn tiles_of(corners: [DVec3; 3], lens: &Lens, size: [u32; 2], side: u32) -> Option<[u32; 4]> {
    let [x0, x1, y0, y1] = pixel_box(corners, lens)?;
    let range = |low: f64, high: f64, pixels: u32| {
        let tile = |v: f64| (v.max(0.0) as u32 / side).min((pixels - 1) / side);
        (high >= 0.0 && low <= f64::from(pixels)).then(|| [tile(low), tile(high)])
    };
    let ([x0, x1], [y0, y1]) = (range(x0, x1, size[0])?, range(y0, y1, size[1])?);
    Some([x0, x1, y0, y1])
}
