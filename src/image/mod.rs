//! Images: linear, premultiplied RGBA in f32, and what is done with them.

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
}
