//! One picture of one medium, tile by tile.

use glam::Vec4;
use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use crate::cpu::cast::{Ray, Setting};
use crate::cpu::composite::Composite;
use crate::cpu::empty::EmptyCells;
use crate::cpu::listing::{Listing, Lists};
use crate::cpu::segment::{LaneMedium, Medium};
use crate::image::Image;
use crate::plan::entries::{BoundaryView, TileEntries};
use crate::renderer::RayCounts;

/// Pixels along a tile's side.
pub const TILE: u32 = 32;

/// What a picture is made of, but for the medium.
pub struct Picture<'a> {
    /// The instructions to use.
    pub arch: Arch,
    pub setting: Setting<'a>,
    pub view: BoundaryView<'a>,
    pub empty: &'a EmptyCells,
    pub size: [u32; 2],
    pub background: Vec4,
    /// Transmittance where rays end.
    pub least: f32,
}

impl Picture<'_> {
    /// `bivariate`: the medium asks for gradient magnitudes.
    /// `alone`: the same medium, for single segments.
    pub fn cast<M: LaneMedium>(&self, medium: &M, alone: &dyn Medium, bivariate: bool) -> (Image, RayCounts) {
        if bivariate { self.tiles::<M, true>(medium, alone) } else { self.tiles::<M, false>(medium, alone) }
    }

    fn tiles<M: LaneMedium, const BIVARIATE: bool>(&self, medium: &M, alone: &dyn Medium) -> (Image, RayCounts) {
        let tiles: Vec<(Vec<[f32; 4]>, RayCounts)> = (0..self.view.tile_count())
            .into_par_iter()
            .with_max_len(1)
            .map(|number| {
                let entries = self.view.tile_entries(number, self.setting.lens, self.size);
                self.arch.dispatch(Tile::<M, BIVARIATE> { picture: self, medium, alone, number, entries })
            })
            .collect();
        let mut image = Image::new(self.size[0], self.size[1]);
        let mut counts = RayCounts::default();
        for (tile, (pixels, tile_counts)) in (0..).zip(&tiles) {
            let [left, top] = self.view.tile_start(tile);
            let width = (self.size[0] - left).min(TILE) as usize;
            for (y, row) in (top as usize..).zip(pixels.chunks(width)) {
                let at = y * self.size[0] as usize + left as usize;
                image.pixels[at..at + width].copy_from_slice(row);
            }
            counts = counts.plus(*tile_counts);
        }
        (image, counts)
    }
}

struct Tile<'a, M, const BIVARIATE: bool> {
    picture: &'a Picture<'a>,
    medium: &'a M,
    alone: &'a dyn Medium,
    number: u32,
    entries: TileEntries,
}

impl<M: LaneMedium, const BIVARIATE: bool> WithSimd for Tile<'_, M, BIVARIATE> {
    /// The pixels within the picture, row by row.
    type Output = (Vec<[f32; 4]>, RayCounts);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Picture { setting, view, empty, size, background, least, .. } = self.picture;
        let [left, top] = view.tile_start(self.number);
        let [width, height] = [(size[0] - left).min(TILE), (size[1] - top).min(TILE)];
        let mut pixels = vec![background.to_array(); (width * height) as usize];
        let ray = |number: u32| {
            let (x, y) = (number % width, number / width);
            let entries = self.entries.of(x, y);
            let ray = || Ray { number: number as usize, film: setting.lens.film([left + x, top + y]), entries };
            (!entries.is_empty() || !setting.around.is_empty()).then(ray)
        };
        let over = |seen: Vec4| (seen + (1.0 - seen.w) * *background).to_array();
        let sink = Composite::new(simd, self.medium, empty, *least);
        let mut overlapping = Vec::new();
        let rays = (0..width * height).filter_map(ray);
        let counts = setting.cast::<_, _, BIVARIATE>(simd, rays, sink, |number, cast| {
            pixels[number] = over(cast.seen);
            if cast.overlaps {
                overlapping.push(number as u32);
            }
        });
        if !overlapping.is_empty() {
            let lists = Lists::default();
            let sink = Listing { medium: self.alone, empty, lists: &lists };
            let rays = overlapping.into_iter().filter_map(ray);
            // What they meet was counted.
            setting.cast::<_, _, BIVARIATE>(simd, rays, sink, |number, cast| pixels[number] = over(cast.seen));
        }
        (pixels, counts)
    }
}
