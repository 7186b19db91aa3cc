//! The reference's pixels of a part of the picture, made beside the window.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use super::background;
use super::engine::Wanted;
use super::watch::{Wake, Watch};
use crate::error::{Error, Result};
use crate::image::{Comparison, Image};
use crate::oracle::{Oracle, Progress};
use crate::renderer::Frame;

/// A part that is being made.
pub struct Refining {
    /// Pixels: left, top, before right, before bottom.
    pub area: [u32; 4],
    side: usize,
    watch: Watch,
    result: Receiver<Result<Image>>,
}

/// A part, and how the picture compares with it.
pub struct Refined {
    /// Pixels: left, top, before right, before bottom.
    pub area: [u32; 4],
    /// Before nothing.
    pub image: Image,
    /// Of which of the pictures that are shown together.
    side: usize,
    /// In linear channels; none before that picture is there in full.
    pub comparison: Option<Comparison>,
}

impl Refined {
    /// Holds the pictures in full, of all sides, against the part.
    pub fn compare(&mut self, pictures: &[Image]) {
        let of = |all: &Image| Comparison::new(&cropped(all, self.area), &self.image).ok();
        self.comparison = pictures.get(self.side).and_then(of);
    }
}

impl Refining {
    /// Begins, with one side of what is wanted; `wake` is called now and then, and at the end.
    pub fn start(wanted: Wanted, side: usize, area: [u32; 4], wake: Wake) -> Self {
        let (sender, result) = channel();
        let watch = Watch::default();
        let followed = watch.clone();
        std::thread::spawn(move || {
            let made = make(&wanted, side, area, followed.progress(Arc::clone(&wake)));
            // The window may have been closed.
            let _ = sender.send(made);
            wake();
        });
        Self { area, side, watch, result }
    }

    /// 0 to 1.
    pub fn progress(&self) -> f64 {
        self.watch.share().unwrap_or(0.0)
    }

    /// What became of it, once.
    pub fn finished(&self) -> Option<Result<Refined>> {
        let refined = |image: Image| Refined { area: self.area, image, side: self.side, comparison: None };
        match self.result.try_recv() {
            Ok(result) => Some(result.map(refined)),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => Some(Err(Error::Device("the reference ended without a result".into()))),
        }
    }
}

impl Drop for Refining {
    fn drop(&mut self) {
        self.watch.give_up();
    }
}

fn make(wanted: &Wanted, side: usize, area: [u32; 4], progress: Progress) -> Result<Image> {
    let Some(side) = wanted.sides.get(side) else { return Err(Error::Asked("there is no picture".into())) };
    let frame = Frame {
        camera: &wanted.camera,
        transfer: &side.transfer,
        optics: &wanted.optics,
        size: wanted.size,
        background: wanted.background,
    };
    let pool = background::pool()?;
    let oracle = Oracle::new(Arc::clone(&wanted.mesh)).with_progress(progress);
    pool.install(|| oracle.part(&frame, area))
}

/// A part of a picture; what lies outside of it is left out.
fn cropped(image: &Image, [left, top, right, bottom]: [u32; 4]) -> Image {
    let [left, right] = [left, right].map(|x| x.min(image.width) as usize);
    let [top, bottom] = [top, bottom].map(|y| y.min(image.height) as usize);
    let rows = (top..bottom).flat_map(|y| &image.pixels[y * image.width as usize..][left..right]);
    Image { pixels: rows.copied().collect(), width: (right - left) as u32, height: (bottom - top) as u32 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crop_keeps_its_pixels() {
        let mut image = Image::new(5, 4);
        (0..20_u8).for_each(|i| image.pixels[usize::from(i)][0] = f32::from(i));
        let part = cropped(&image, [1, 2, 4, 4]);
        let got: Vec<f32> = part.pixels.iter().map(|p| p[0]).collect();
        assert_eq!((got, part.width, part.height), (vec![11.0, 12.0, 13.0, 16.0, 17.0, 18.0], 3, 2));
        assert_eq!(cropped(&image, [3, 3, 9, 9]).pixels.len(), 2, "a picture that has become smaller");
    }
}
