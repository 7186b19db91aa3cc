//! Pictures as a screen has them: before a backdrop, in 8 bits.

use eframe::egui::{Color32, ColorImage};
use rayon::prelude::*;

use crate::image::{Image, srgb_from_linear};

/// What lies behind the medium in the window; files get the scene's own background.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Backdrop {
    /// The scene's colour.
    #[default]
    Plain,
    /// Lines, which tell what is bright from what is opaque (Shirley & Tuchman 1990).
    Lines,
    /// From dark to light.
    Gradient,
}

impl Backdrop {
    /// All, by name.
    pub const ALL: [(Self, &'static str); 3] =
        [(Self::Plain, "plain"), (Self::Lines, "lines"), (Self::Gradient, "gradient")];

    /// Linear.
    fn at(self, x: f32, y: f32, plain: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Plain => plain,
            Self::Lines => {
                // Twelve pairs over the height.
                let is_light = ((x + y) * 12.0).rem_euclid(1.0) < 0.5;
                [if is_light { 0.35 } else { 0.03 }; 3]
            }
            Self::Gradient => [0.02 + 0.55 * (1.0 - y); 3],
        }
    }
}

/// sRGB of linear channels in 4,096 steps.
fn table() -> Vec<u8> {
    (0..=4096_u16).map(|i| (255.0 * srgb_from_linear(f32::from(i) / 4096.0)).round() as u8).collect()
}

/// `image`: before nothing. `plain`: linear, premultiplied.
pub fn screen(image: &Image, backdrop: Backdrop, plain: [f32; 4]) -> ColorImage {
    let (width, height, table) = (image.width as usize, image.height as usize, table());
    let byte = |v: f32| table[(v.clamp(0.0, 1.0) * 4096.0) as usize];
    let pixel = |(index, &[r, g, b, a]): (usize, &[f32; 4])| {
        let (x, y) = ((index % width) as f32 / height as f32, (index / width) as f32 / height as f32);
        let behind = backdrop.at(x, y, [plain[0], plain[1], plain[2]]);
        let channel = |v: f32, behind: f32| byte(v + (1.0 - a) * behind);
        Color32::from_rgb(channel(r, behind[0]), channel(g, behind[1]), channel(b, behind[2]))
    };
    ColorImage::new([width, height], image.pixels.par_iter().enumerate().map(pixel).collect())
}

/// Absolute differences, so many times as bright.
pub fn difference(a: &Image, b: &Image, times: f32) -> ColorImage {
    let table = table();
    let byte = |v: f32| table[(v.clamp(0.0, 1.0) * 4096.0) as usize];
    let pixel = |(a, b): (&[f32; 4], &[f32; 4])| {
        let [r, g, b] = [0, 1, 2].map(|c| byte(times * (a[c] - b[c]).abs()));
        Color32::from_rgb(r, g, b)
    };
    let pixels = a.pixels.par_iter().zip(&b.pixels).map(pixel).collect();
    ColorImage::new([a.width as usize, a.height as usize], pixels)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_opaque_hides_the_backdrop() {
        let mut image = Image::new(2, 1);
        image.pixels[0] = [1.0, 0.0, 0.5, 1.0];
        for (backdrop, _) in Backdrop::ALL {
            let got = screen(&image, backdrop, [0.0, 1.0, 0.0, 1.0]);
            assert_eq!(got.pixels[0], Color32::from_rgb(255, 0, 188), "{backdrop:?}");
        }
        assert_eq!(screen(&image, Backdrop::Plain, [0.0, 1.0, 0.0, 1.0]).pixels[1], Color32::from_rgb(0, 255, 0));
        let lines = screen(&Image::new(24, 24), Backdrop::Lines, [0.0; 4]);
        assert!(lines.pixels.contains(&Color32::from_gray(48)), "{:?}", lines.pixels[0]);
    }

    #[test]
    fn equal_pictures_differ_nowhere() {
        let image = Image { pixels: vec![[0.25, 0.5, 0.75, 1.0]; 4], ..Image::new(2, 2) };
        assert!(difference(&image, &image, 16.0).pixels.iter().all(|p| *p == Color32::BLACK));
        let mut other = image.clone();
        other.pixels[3][1] += 0.01;
        let got = difference(&image, &other, 16.0);
        assert!(got.pixels[3].g() > 90 && got.pixels[2] == Color32::BLACK, "{:?}", got.pixels[3]);
    }
}
