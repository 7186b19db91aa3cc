//! Images: linear, premultiplied RGBA in f32, and what is done with them.

mod color;
mod compare;
mod file;

pub use color::{linear_from_srgb, srgb_from_linear};
pub use compare::{Comparison, WorstPixel};
pub use file::PngEncoding;

/// Linear, premultiplied RGBA; row 0 is the top. Emission may exceed opacity.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels along x.
    pub width: u32,
    /// Pixels along y.
    pub height: u32,
    /// `width * height` pixels, row by row.
    pub pixels: Vec<[f32; 4]>,
}

impl Image {
    /// Transparent black.
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, pixels: vec![[0.0; 4]; width as usize * height as usize] }
    }

    /// This image before a uniform background (linear, premultiplied).
    #[must_use]
    pub fn over(&self, background: [f32; 4]) -> Self {
        let over = |p: &[f32; 4]| std::array::from_fn(|c| p[c] + (1.0 - p[3]) * background[c]);
        Self { pixels: self.pixels.iter().map(over).collect(), ..*self }
    }
}
