//! What rays see through the gaps of a mesh.

use glam::DVec3;
use rayon::prelude::*;

use crate::plan::entries::pixel_box;
use crate::plan::lens::Lens;
use crate::plan::order::sequence::Relation;
use crate::tet::{FACES, TetMesh};

/// Rows of pixels that are worked on at once: few enough to sort within a cache, many enough that few faces lie in
/// several.
const ROWS: u32 = 16;

/// Depths that differ by less, relative to the larger of them and 1 (the mesh's radius), are the same: a ray that
/// leaves one part where it enters another that touches it does so in this order.
const SAME: f64 = 1e-12;

/// Where a ray goes through the boundary.
#[derive(Clone, Copy)]
struct Crossing {
    pixel: u32,
    /// View depth, mesh units.
    depth: f64,
    cell: u32,
    enters: bool,
}

/// All pairs of cells that a ray through a pixel's centre leaves and then enters, with the mesh's open faces (cell and
/// opposite corner), but for those that follow from others. Sorted, each once.
pub(super) fn relations(mesh: &TetMesh, open_faces: &[(u32, usize)], lens: &Lens, size: [u32; 2]) -> Vec<Relation> {
    let corners = |&(tet, corner): &(u32, usize)| {
        FACES[corner].map(|i| lens.view(mesh.vertices[mesh.tets[tet as usize][i] as usize]))
    };
    let bands = size[1].div_ceil(ROWS);
    let spans: Vec<Option<[u32; 2]>> = open_faces.par_iter().map(|face| span(corners(face), lens, size)).collect();
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); bands as usize];
    for (face, span) in (0_u32..).zip(spans) {
        let Some([first, last]) = span else { continue };
        (first..=last).for_each(|band| members[band as usize].push(face));
    }
    let of_band = |(band, faces): (u32, Vec<u32>)| {
        let mut crossings = Vec::new();
        for face in faces {
            let face = &open_faces[face as usize];
            cross(corners(face), face.0, lens, size, band, &mut crossings);
        }
        gaps(&mut crossings)
    };
    let found: Vec<Relation> = (0..bands).into_par_iter().zip(members).flat_map_iter(of_band).collect();
    merged(found)
}

/// First and last band that a face may touch.
fn span(corners: [DVec3; 3], lens: &Lens, size: [u32; 2]) -> Option<[u32; 2]> {
    let [x0, x1, y0, y1] = pixel_box(corners, lens)?;
    let [width, height] = size.map(f64::from);
    let band = |y: f64| (y.max(0.0) as u32).min(size[1] - 1) / ROWS;
    (x1 >= 0.0 && x0 <= width && y1 >= 0.0 && y0 <= height).then(|| [band(y0), band(y1)])
}

/// Adds the crossings of a face with the rays of a band.
fn cross(corners: [DVec3; 3], cell: u32, lens: &Lens, size: [u32; 2], band: u32, crossings: &mut Vec<Crossing>) {
    let Some([x0, x1, y0, y1]) = pixel_box(corners, lens) else { return };
    // Normals of the planes through the eye and each edge; shared edges give the same bits.
    let [a, b, c] = corners.map(|p| if lens.perspective { p } else { DVec3 { z: 1.0, ..p } });
    let edges = [b.cross(c), c.cross(a), a.cross(b)];
    // Pixels whose centre the box holds; `as` saturates.
    let range = |low: f64, high: f64, first: u32, end: u32| {
        ((low - 0.5).ceil().max(0.0) as u32).max(first)..((high + 0.5).max(0.0) as u32).min(end)
    };
    for y in range(y0, y1, band * ROWS, (band * ROWS + ROWS).min(size[1])) {
        for x in range(x0, x1, 0, size[0]) {
            let film = lens.film([x, y]);
            let weights = edges.map(|n| n.x * film.x + n.y * film.y + n.z);
            let (enters, leaves) = (weights.iter().all(|w| *w >= 0.0), weights.iter().all(|w| *w <= 0.0));
            if !enters && !leaves {
                continue;
            }
            let sum: f64 = weights.iter().sum();
            let depth = (0..3).map(|i| weights[i] * corners[i].z).sum::<f64>() / sum;
            // An edge-on face is no crossing, nor is one behind the eye.
            if depth.is_finite() && (!lens.perspective || depth > 0.0) {
                crossings.push(Crossing { pixel: y * size[0] + x, depth, cell, enters });
            }
        }
    }
}

/// Pairs on the rays of a band.
fn gaps(crossings: &mut [Crossing]) -> Vec<Relation> {
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    // Leaving counts as a little earlier.
    let place = |c: &Crossing| if c.enters { c.depth } else { c.depth - SAME * c.depth.abs().max(1.0) };
    let key = |c: &Crossing| (c.pixel, c.enters, c.cell);
    crossings
        .sort_unstable_by(|a, b| a.pixel.cmp(&b.pixel).then(place(a).total_cmp(&place(b))).then(key(a).cmp(&key(b))));
    for ray in crossings.chunk_by(|a, b| a.pixel == b.pixel) {
        add_pairs(ray, &mut pairs);
    }
    pairs.sort_unstable();
    let run = |run: &[(u32, u32)]| Relation { front: run[0].0, back: run[0].1, pixels: run.len() as u32 };
    pairs.chunk_by(|a, b| a == b).map(run).collect()
}

/// Pairs on one ray: what is left with all that is entered behind it, until something is left that was entered there:
/// that is behind the one and before the rest. Whether it was is known from how many parts the ray is in: the first so
/// many to be left may be those. It is in one only where parts do not overlap, and what is entered next is all.
fn add_pairs(ray: &[Crossing], pairs: &mut Vec<(u32, u32)>) {
    let mut inside = 0_usize;
    for (i, left) in ray.iter().enumerate().rev() {
        if left.enters {
            inside = inside.saturating_sub(1);
            continue;
        }
        let mut others = inside;
        for behind in &ray[i + 1..] {
            if behind.enters {
                if behind.cell != left.cell {
                    pairs.push((left.cell, behind.cell));
                }
                continue;
            }
            if others == 0 {
                break;
            }
            others -= 1;
        }
        inside += 1;
    }
}

/// Each pair once, from all bands.
fn merged(mut found: Vec<Relation>) -> Vec<Relation> {
    found.par_sort_unstable();
    found.dedup_by(|later, first| {
        let same = (later.front, later.back) == (first.front, first.back);
        first.pixels += if same { later.pixels } else { 0 };
        same
    });
    found
}
