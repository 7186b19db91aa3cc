//! A mesh seen by a camera: which cells each ray crosses, and what it sees of them.

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use glam::DVec3;
use rayon::prelude::*;

use crate::image::Image;
use crate::oracle::cell::{Cell, Crossing};
use crate::oracle::lens::Lens;
use crate::oracle::segment::{Medium, Segment};
use crate::oracle::shade::{Illumination, Shade};
use crate::scene::{Camera, EmissionModel, Optics, Projection, TransferFunction};
use crate::space::Ray;
use crate::tet::TetMesh;

/// Pixels along a tile's side: small enough that the segments of a tile fit in memory on every core, large enough that
/// few cells lie in several.
const TILE: u32 = 32;
/// Boxes in pixels are this much too large, against rounding.
const MARGIN: f64 = 1e-6;
/// Agreement asked of each segment's quadrature, as seen at the eye; a ray crosses at most some thousands, and the
/// finer rule's error lies far below the difference of the two.
const SEGMENT_TOLERANCE: f64 = 1e-11;
/// Below this transmittance an f64 sum of order one does not change.
const OPAQUE: f64 = 1e-14;

/// How the segments of a ray are composed.
#[derive(Clone, Copy, Debug)]
pub enum Composition<'a> {
    /// As they lie along the ray.
    AlongRay,
    /// By one key a cell, the largest key behind; of equal keys the smaller id behind.
    ByKey(&'a [f64]),
}

/// What one camera sees of one mesh by some optics; answers for any transfer function.
#[derive(Debug)]
pub struct View<'a> {
    mesh: &'a TetMesh,
    lens: Lens,
    size: [u32; 2],
    near: f64,
    /// Vertices in view axes, data units. Rotated once each, so that cells share their corners to the bit.
    vertices: Vec<DVec3>,
    emission: EmissionModel,
    illumination: Illumination,
    /// Gradient vectors at the vertices, view axes; empty where the optics need none.
    gradients: Vec<DVec3>,
    /// Cells of tile `i`: `members[starts[i]..starts[i + 1]]`, by id.
    starts: Vec<usize>,
    members: Vec<u32>,
}

/// One cell on one pixel's ray.
struct Hit {
    pixel: u32,
    /// Index into the tile's cells.
    cell: u32,
    crossing: Crossing,
}

impl<'a> View<'a> {
    /// Sorts the cells into tiles of the image.
    pub fn new(mesh: &'a TetMesh, camera: &Camera, optics: &Optics, size: [u32; 2]) -> Self {
        let basis = camera.basis();
        let in_view = |p: DVec3| DVec3::new(p.dot(basis.right), p.dot(basis.up), p.dot(basis.forward));
        let eye_in_mesh = mesh.mesh_from_data(camera.eye);
        let vertices = mesh.vertices.par_iter().map(|&vertex| in_view((vertex - eye_in_mesh) * mesh.data_per_mesh));
        let gradients = match optics.uses_gradients() {
            true => mesh.vertex_gradients().into_par_iter().map(in_view).collect(),
            false => Vec::new(),
        };
        let near = camera.near_depth(mesh.bounds_in_data().diagonal());
        let near = match camera.projection {
            // Nothing is seen behind the eye, whatever was asked.
            Projection::Perspective { .. } => near.max(0.0),
            Projection::Orthographic { .. } => near,
        };
        let mut view = Self {
            mesh,
            lens: Lens::new(camera, size),
            size,
            near,
            vertices: vertices.collect(),
            emission: optics.emission,
            illumination: Illumination::new(optics, &basis, mesh.gradient_range().max),
            gradients,
            starts: Vec::new(),
            members: Vec::new(),
        };
        view.bin();
        view
    }

    /// Number of cells that touch the image.
    pub fn cells_in_view(&self) -> usize {
        (0..self.mesh.tets.len() as u32).into_par_iter().filter(|&tet| self.tiles_of(tet).is_some()).count()
    }

    /// Number of tiles along x and y.
    fn tiles(&self) -> [u32; 2] {
        self.size.map(|n| n.div_ceil(TILE))
    }

    /// Fills `starts` and `members` by counting.
    fn bin(&mut self) {
        let [across, down] = self.tiles();
        let boxes: Vec<_> = (0..self.mesh.tets.len() as u32).into_par_iter().map(|tet| self.tiles_of(tet)).collect();
        let tiles_in =
            |[x0, x1, y0, y1]: [u32; 4]| (y0..=y1).flat_map(move |y| (x0..=x1).map(move |x| (y * across + x) as usize));
        let mut starts = vec![0; (across * down) as usize + 1];
        for tile in boxes.iter().flatten().flat_map(|&b| tiles_in(b)) {
            starts[tile + 1] += 1;
        }
        for i in 1..starts.len() {
            starts[i] += starts[i - 1];
        }
        let mut next = starts.clone();
        let mut members = vec![0; *starts.last().unwrap_or(&0)];
        for (tet, tiles) in (0u32..).zip(&boxes) {
            for tile in tiles.iter().flat_map(|&b| tiles_in(b)) {
                members[next[tile]] = tet;
                next[tile] += 1;
            }
        }
        (self.starts, self.members) = (starts, members);
    }

    /// First and last tile along x, then y, that the cell may touch; `None` where it cannot be seen.
    fn tiles_of(&self, tet: u32) -> Option<[u32; 4]> {
        let [x0, x1, y0, y1] = self.pixel_box(tet)?;
        let range = |low: f64, high: f64, pixels: u32| {
            // `as` saturates, also infinities.
            let tile = |v: f64| (v.max(0.0) as u32 / TILE).min((pixels - 1) / TILE);
            (high >= 0.0 && low <= f64::from(pixels)).then(|| [tile(low), tile(high)])
        };
        let ([x0, x1], [y0, y1]) = (range(x0, x1, self.size[0])?, range(y0, y1, self.size[1])?);
        Some([x0, x1, y0, y1])
    }

    /// Bounding box in pixels (x from, to, y from, to) of the part of the cell beyond the near depth.
    fn pixel_box(&self, tet: u32) -> Option<[f64; 4]> {
        let corners = self.mesh.tets[tet as usize].map(|v| self.vertices[v as usize]);
        let mut pixels = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        let mut add = |point: DVec3| {
            let [x, y] = self.lens.pixel(point);
            // At the eye's own depth a point is anywhere.
            let ([x0, x1], [y0, y1]) = (widened(x), widened(y));
            pixels = [pixels[0].min(x0), pixels[1].max(x1), pixels[2].min(y0), pixels[3].max(y1)];
        };
        for (i, &a) in corners.iter().enumerate() {
            if a.z > self.near {
                add(a);
            }
            for &b in &corners[i + 1..] {
                if (a.z > self.near) != (b.z > self.near) {
                    add(DVec3 { z: self.near, ..a.lerp(b, (self.near - a.z) / (b.z - a.z)) });
                }
            }
        }
        (pixels[0] <= pixels[1]).then_some(pixels)
    }

    /// The cell in view axes.
    fn cell(&self, tet: u32) -> Cell {
        let ids = self.mesh.tets[tet as usize];
        let fields = ids.map(|v| [self.mesh.scalar[v as usize], self.mesh.gradient_magnitude[v as usize]]);
        let gradients = (!self.gradients.is_empty()).then(|| ids.map(|v| self.gradients[v as usize]));
        Cell::new(tet, ids, ids.map(|v| self.vertices[v as usize]), fields, gradients)
    }

    /// The pixels from `left, top` to before `right, bottom`, over `background` (linear, premultiplied). `done` hears the
    /// finished fraction, from any thread, and says whether to go on; `None` where it did not.
    pub fn image(
        &self,
        transfer: &TransferFunction,
        composition: Composition<'_>,
        background: [f32; 4],
        [left, top, right, bottom]: [u32; 4],
        done: &(dyn Fn(f64) -> bool + Sync),
    ) -> Option<Image> {
        let across = self.tiles()[0];
        let wanted: Vec<u32> = (top / TILE..bottom.div_ceil(TILE))
            .flat_map(|row| (left / TILE..right.div_ceil(TILE)).map(move |column| row * across + column))
            .collect();
        let (finished, is_given_up) = (AtomicU32::new(0), AtomicBool::new(false));
        let tiles: Vec<Vec<[f64; 4]>> = wanted
            .par_iter()
            .map(|&tile| {
                if is_given_up.load(Ordering::Relaxed) {
                    return Vec::new();
                }
                let pixels = self.tile(tile, transfer, composition);
                let count = 1 + finished.fetch_add(1, Ordering::Relaxed);
                if !done(f64::from(count) / wanted.len() as f64) {
                    is_given_up.store(true, Ordering::Relaxed);
                }
                pixels
            })
            .collect();
        if is_given_up.into_inner() {
            return None;
        }
        let mut image = Image::new(right - left, bottom - top);
        for (&tile, pixels) in wanted.iter().zip(&tiles) {
            let corner = [tile % across * TILE, tile / across * TILE];
            for (i, &pixel) in (0..).zip(pixels) {
                let [x, y] = [corner[0] + i % TILE, corner[1] + i / TILE];
                if (left..right).contains(&x) && (top..bottom).contains(&y) {
                    let at = (y - top) as usize * image.width as usize + (x - left) as usize;
                    image.pixels[at] = over(pixel, background).map(|v| v as f32);
                }
            }
        }
        Some(image)
    }

    /// The tile's pixels, row by row, without background.
    fn tile(&self, tile: u32, transfer: &TransferFunction, composition: Composition<'_>) -> Vec<[f64; 4]> {
        let (left, top) = (tile % self.tiles()[0] * TILE, tile / self.tiles()[0] * TILE);
        let rays: Vec<Ray> = (0..TILE * TILE)
            .map(|i| self.lens.ray([f64::from(left + i % TILE) + 0.5, f64::from(top + i / TILE) + 0.5]))
            .collect();
        let members = &self.members[self.starts[tile as usize]..self.starts[tile as usize + 1]];
        let cells: Vec<Cell> = members.iter().map(|&tet| self.cell(tet)).collect();
        let mut hits = Vec::new();
        for (index, cell) in (0u32..).zip(&cells) {
            let Some([x0, x1, y0, y1]) = self.pixel_box(cell.id) else { continue };
            // Pixels whose centre the box holds; `as` saturates.
            let range = |low: f64, high: f64, start: u32| {
                let first = (low - f64::from(start) - 0.5).ceil().max(0.0) as u32;
                first..((high - f64::from(start) + 0.5).max(0.0) as u32).min(TILE)
            };
            for y in range(y0, y1, top) {
                for x in range(x0, x1, left) {
                    let pixel = y * TILE + x;
                    if let Some(crossing) = cell.clip(&rays[pixel as usize], self.near) {
                        hits.push(Hit { pixel, cell: index, crossing });
                    }
                }
            }
        }
        let mut pixels = vec![[0.0; 4]; rays.len()];
        sort(&mut hits, &cells, composition);
        for run in hits.chunk_by(|a, b| a.pixel == b.pixel) {
            let pixel = run[0].pixel as usize;
            pixels[pixel] = self.compose(&rays[pixel], run, &cells, transfer);
        }
        pixels
    }

    /// What is seen at any position of the image (the first pixel's centre is (0.5, 0.5)), over `background`; outside
    /// the image, the background.
    pub fn pixel(&self, transfer: &TransferFunction, background: [f32; 4], position: [f64; 2]) -> [f64; 4] {
        let [x, y] = position;
        if !(x >= 0.0 && y >= 0.0 && x < f64::from(self.size[0]) && y < f64::from(self.size[1])) {
            return background.map(f64::from);
        }
        let ray = self.lens.ray(position);
        let tile = y as u32 / TILE * self.tiles()[0] + x as u32 / TILE;
        let members = &self.members[self.starts[tile as usize]..self.starts[tile as usize + 1]];
        let (mut cells, mut hits) = (Vec::new(), Vec::new());
        for &tet in members {
            let Some([x0, x1, y0, y1]) = self.pixel_box(tet) else { continue };
            if x0 <= x && x <= x1 && y0 <= y && y <= y1 {
                let cell = self.cell(tet);
                if let Some(crossing) = cell.clip(&ray, self.near) {
                    hits.push(Hit { pixel: 0, cell: cells.len() as u32, crossing });
                    cells.push(cell);
                }
            }
        }
        sort(&mut hits, &cells, Composition::AlongRay);
        over(self.compose(&ray, &hits, &cells, transfer), background)
    }

    /// The largest change of any channel when `position` moves by `shift` pixels in eight directions: near silhouettes
    /// and thin bands no arithmetic can do better than the geometry it is given.
    pub fn sensitivity(&self, transfer: &TransferFunction, position: [f64; 2], shift: f64) -> f64 {
        let here = self.pixel(transfer, [0.0; 4], position);
        let mut worst = 0.0f64;
        for (dx, dy) in [(-1, -1), (0, -1), (1, -1), (-1, 0), (1, 0), (-1, 1), (0, 1), (1, 1)] {
            let moved = [position[0] + shift * f64::from(dx), position[1] + shift * f64::from(dy)];
            let there = self.pixel(transfer, [0.0; 4], moved);
            worst = (0..4).fold(worst, |m, c| m.max((there[c] - here[c]).abs()));
        }
        worst
    }

    /// Colour and opacity of a ray's segments, front to back.
    fn compose(&self, ray: &Ray, hits: &[Hit], cells: &[Cell], transfer: &TransferFunction) -> [f64; 4] {
        let per_depth = ray.direction.length();
        let (mut color, mut transmittance) = ([0.0; 3], 1.0);
        for hit in hits {
            let cell = &cells[hit.cell as usize];
            let [front, back] = cell.fields_at_ends(ray, &hit.crossing);
            let length = (hit.crossing.exit - hit.crossing.enter) * per_depth;
            let shade = match cell.gradient_midway(ray, &hit.crossing) {
                Some(gradient) => self.illumination.shade(gradient, ray.direction),
                None => Shade::NONE,
            };
            let medium = Medium { transfer, emission: self.emission, shade };
            let Segment { tau, color: emitted } =
                medium.integrate(front, back, length, SEGMENT_TOLERANCE / transmittance);
            color = std::array::from_fn(|c| color[c] + transmittance * emitted[c]);
            transmittance *= (-tau).exp();
            if transmittance < OPAQUE {
                break;
            }
        }
        [color[0], color[1], color[2], 1.0 - transmittance]
    }
}

/// A coordinate and its margin; everything where it is not finite.
fn widened(v: f64) -> [f64; 2] {
    let margin = MARGIN * (1.0 + 1e-6 * v.abs());
    if v.is_finite() { [v - margin, v + margin] } else { [f64::NEG_INFINITY, f64::INFINITY] }
}

/// By pixel, then front to back.
fn sort(hits: &mut [Hit], cells: &[Cell], composition: Composition<'_>) {
    let id = |hit: &Hit| cells[hit.cell as usize].id;
    match composition {
        Composition::AlongRay => hits.sort_unstable_by(|a, b| {
            // Twice the middle: cells of a conforming mesh do not overlap, so any point between would do.
            let middle = |hit: &Hit| hit.crossing.enter + hit.crossing.exit;
            a.pixel.cmp(&b.pixel).then(middle(a).total_cmp(&middle(b))).then(id(a).cmp(&id(b)))
        }),
        Composition::ByKey(keys) => hits.sort_unstable_by(|a, b| {
            let key = |hit: &Hit| keys[id(hit) as usize];
            a.pixel.cmp(&b.pixel).then(key(a).total_cmp(&key(b))).then(id(b).cmp(&id(a)))
        }),
    }
}

/// `front` (premultiplied) before `background`.
fn over(front: [f64; 4], background: [f32; 4]) -> [f64; 4] {
    std::array::from_fn(|c| front[c] + (1.0 - front[3]) * f64::from(background[c]))
}
