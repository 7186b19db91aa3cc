//! The boundary faces, and where rays enter through them.

use std::collections::HashMap;

use glam::{DVec2, DVec3, Vec4};
use rayon::prelude::*;

use crate::cpu::lens::Lens;
use crate::cpu::mesh::Cell;
use crate::tet::{FACES, NO_TET};

/// Pixels along a tile's side.
pub const TILE: u32 = 32;

/// All boundary faces.
#[derive(Debug)]
pub struct Surface {
    /// As rounded to f32 for the walk, so that both mean one geometry.
    points: Vec<DVec3>,
    faces: Vec<Face>,
}

#[derive(Clone, Copy, Debug)]
struct Face {
    /// Counter-clockwise seen from outside.
    points: [u32; 3],
    cell: u32,
    /// The opposite corner of the cell.
    opposite: u8,
}

/// Where a ray may enter the mesh.
#[derive(Clone, Copy, Debug)]
pub struct Entry {
    pub cell: u32,
    /// The corner opposite the face.
    pub opposite: u8,
    /// View depth, mesh units.
    pub depth: f64,
}

/// The boundary as a lens sees it.
pub struct SurfaceView<'a> {
    surface: &'a Surface,
    /// View axes.
    points: Vec<DVec3>,
    perspective: bool,
    tiles: [u32; 2],
    /// Faces of tile `i`: `members[starts[i]..starts[i + 1]]`.
    starts: Vec<u32>,
    members: Vec<u32>,
}

impl Surface {
    pub fn new(cells: &[Cell], vertices: &[Vec4]) -> Self {
        let (mut points, mut faces) = (Vec::new(), Vec::new());
        let mut numbers = HashMap::new();
        for (cell, Cell { vertices: ids, neighbors }) in (0_u32..).zip(cells) {
            for opposite in (0_u8..4).filter(|&i| neighbors[usize::from(i)] == NO_TET) {
                let points = FACES[usize::from(opposite)].map(|corner| {
                    *numbers.entry(ids[corner]).or_insert_with(|| {
                        points.push(vertices[ids[corner] as usize].truncate().as_dvec3());
                        points.len() as u32 - 1
                    })
                });
                faces.push(Face { points, cell, opposite });
            }
        }
        Self { points, faces }
    }

    pub fn bytes(&self) -> usize {
        size_of_val(&self.points[..]) + size_of_val(&self.faces[..])
    }

    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    fn view_points(&self, lens: &Lens) -> Vec<DVec3> {
        self.points.par_iter().with_min_len(1024).map(|&p| lens.view(p)).collect()
    }

    /// All that may be entries of one ray by trying every face, nearest first.
    pub fn entries(&self, lens: &Lens, film: DVec2) -> Vec<Entry> {
        let points: Vec<DVec3> = self.points.iter().map(|&p| lens.view(p)).collect();
        let entry = |face: &Face| {
            let triangle = Triangle::new(face.points.map(|p| points[p as usize]), lens.perspective);
            let depth = triangle.entry_depth(film)?;
            Some(Entry { cell: face.cell, opposite: face.opposite, depth })
        };
        let mut entries: Vec<Entry> = self.faces.iter().filter_map(entry).collect();
        entries.sort_by(|a, b| a.depth.total_cmp(&b.depth));
        entries
    }
}

impl<'a> SurfaceView<'a> {
    /// Sorts the faces into the tiles of a picture.
    pub fn new(surface: &'a Surface, lens: &Lens, size: [u32; 2]) -> Self {
        let points = surface.view_points(lens);
        let tiles = size.map(|n| n.div_ceil(TILE));
        let boxes: Vec<Option<[u32; 4]>> = surface
            .faces
            .par_iter()
            .with_min_len(256)
            .map(|face| {
                let corners = face.points.map(|p| points[p as usize]);
                if Triangle::new(corners, lens.perspective).surely_leaves() {
                    return None;
                }
                tiles_of(corners, lens, size)
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
        Self { surface, points, perspective: lens.perspective, tiles, starts, members }
    }

    pub fn tile_count(&self) -> u32 {
        self.tiles[0] * self.tiles[1]
    }

    /// The first pixel of a tile.
    pub fn tile_start(&self, tile: u32) -> [u32; 2] {
        [tile % self.tiles[0] * TILE, tile / self.tiles[0] * TILE]
    }

    /// Where the rays of a tile's pixels may enter.
    pub fn tile_entries(&self, tile: u32, lens: &Lens, size: [u32; 2]) -> TileEntries {
        let [left, top] = self.tile_start(tile);
        let [width, height] = [(size[0] - left).min(TILE), (size[1] - top).min(TILE)];
        let mut found: Vec<(u32, Entry)> = Vec::new();
        for &member in &self.members[self.starts[tile as usize] as usize..self.starts[tile as usize + 1] as usize] {
            let face = &self.surface.faces[member as usize];
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
                        found.push((y * TILE + x, Entry { cell: face.cell, opposite: face.opposite, depth }));
                    }
                }
            }
        }
        TileEntries::new(&found)
    }
}

/// Entries of a tile's pixels, nearest first.
pub struct TileEntries {
    starts: Vec<u32>,
    entries: Vec<Entry>,
}

impl TileEntries {
    fn new(found: &[(u32, Entry)]) -> Self {
        let mut starts = vec![0_u32; (TILE * TILE) as usize + 1];
        for (pixel, _) in found {
            starts[*pixel as usize + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut entries = vec![Entry { cell: 0, opposite: 0, depth: 0.0 }; found.len()];
        for (pixel, entry) in found {
            let at = &mut next[*pixel as usize];
            entries[*at as usize] = *entry;
            *at += 1;
        }
        for pixel in starts.windows(2) {
            entries[pixel[0] as usize..pixel[1] as usize].sort_unstable_by(|a, b| a.depth.total_cmp(&b.depth));
        }
        Self { starts, entries }
    }

    /// Those of one pixel.
    pub fn of(&self, x: u32, y: u32) -> &[Entry] {
        let pixel = (y * TILE + x) as usize;
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

    /// The depth where a ray enters, if it passes inside of all edges or not certainly outside: which one it is, the walk
    /// decides with the signs that it has for edges.
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
fn pixel_box(corners: [DVec3; 3], lens: &Lens) -> Option<[f64; 4]> {
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
fn tiles_of(corners: [DVec3; 3], lens: &Lens, size: [u32; 2]) -> Option<[u32; 4]> {
    let [x0, x1, y0, y1] = pixel_box(corners, lens)?;
    let range = |low: f64, high: f64, pixels: u32| {
        let tile = |v: f64| (v.max(0.0) as u32 / TILE).min((pixels - 1) / TILE);
        (high >= 0.0 && low <= f64::from(pixels)).then(|| [tile(low), tile(high)])
    };
    let ([x0, x1], [y0, y1]) = (range(x0, x1, size[0])?, range(y0, y1, size[1])?);
    Some([x0, x1, y0, y1])
}
