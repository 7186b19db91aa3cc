//! Pictures beside records: the reference, what a contender drew, and by how much they differ.

use std::path::{Path, PathBuf};

use super::points::rank;
use super::report::Run;
use super::words;
use crate::error::{Error, Result};
use crate::image::{Comparison, Image, PngEncoding};
use crate::report::record::Contender;

/// What differences are multiplied by.
pub(super) const GAIN: f32 = 16.0;
/// Wider pictures are made smaller for the page, pixels.
const WIDEST: u32 = 480;

/// Three pictures, as the bytes of PNG files.
pub(super) struct Strip {
    pub title: String,
    pub caption: String,
    pub reference: Vec<u8>,
    pub drawn: Vec<u8>,
    pub difference: Vec<u8>,
}

/// The file's name, without its ending, of what a contender drew of a subject: in `pictures/HASH/` beside the records.
pub(super) fn picture_name(by: &Contender) -> String {
    let Contender { program, device, method, integral, order } = by;
    words::file_name(&[program, device, method, integral, order].map(String::as_str).join("-"))
}

/// Of each method, its run with the largest error of which both pictures are there.
pub(super) fn strips(runs: &[Run]) -> Result<Vec<Strip>> {
    let mut drawn: Vec<(&Run, f64)> =
        runs.iter().filter_map(|run| Some((run, run.record.result.as_ref()?.error.rmse))).collect();
    drawn.sort_by(|(a, x), (b, y)| rank(&a.record.by).0.cmp(&rank(&b.record.by).0).then(y.total_cmp(x)));
    let mut methods: Vec<String> = Vec::new();
    let mut strips = Vec::new();
    for (run, _) in drawn {
        let method = words::method(&run.record.by);
        let [drawn, reference] = pictures(run);
        if methods.contains(&method) || !drawn.is_file() || !reference.is_file() {
            continue;
        }
        strips.push(strip(run, &drawn, &reference)?);
        methods.push(method);
    }
    Ok(strips)
}

fn pictures(run: &Run) -> [PathBuf; 2] {
    let hash = words::file_name(&run.record.subject.hash);
    let drawn = run.folder.join("pictures").join(&hash).join(picture_name(&run.record.by) + ".exr");
    [drawn, run.folder.join("truth").join(hash + ".exr")]
}

fn strip(run: &Run, drawn_path: &Path, reference_path: &Path) -> Result<Strip> {
    let (drawn, reference) = (Image::read(drawn_path)?, Image::read(reference_path)?);
    let comparison = Comparison::new(&drawn, &reference).map_err(|e| Error::malformed(drawn_path, e.to_string()))?;
    let (subject, by) = (&run.record.subject, &run.record.by);
    let psnr = if comparison.rmse > 0.0 { format!("{:.1} dB", comparison.psnr) } else { "equal".into() };
    let caption = format!(
        "{} {}; {} · {}, {}, {}: RMSE {}, {psnr}, maximum {}",
        by.integral,
        by.order,
        subject.mesh,
        subject.scene,
        subject.view,
        words::size(subject),
        words::short(comparison.rmse),
        words::short(comparison.max)
    );
    let shown = |image: &Image| png(&smaller(&image.over([0.0, 0.0, 0.0, 1.0]), mean));
    Ok(Strip {
        title: words::method(by),
        caption,
        reference: shown(&reference)?,
        drawn: shown(&drawn)?,
        // Single wrong pixels are to be seen.
        difference: png(&smaller(&comparison.difference_picture(GAIN), largest))?,
    })
}

fn mean(pixels: &[[f32; 4]]) -> [f32; 4] {
    std::array::from_fn(|c| pixels.iter().map(|p| p[c]).sum::<f32>() / pixels.len() as f32)
}

fn largest(pixels: &[[f32; 4]]) -> [f32; 4] {
    std::array::from_fn(|c| pixels.iter().map(|p| p[c]).fold(0.0, f32::max))
}

/// Blocks of pixels become one by `join`, so that no picture is wider than the page shows.
fn smaller(image: &Image, join: fn(&[[f32; 4]]) -> [f32; 4]) -> Image {
    let block = image.width.div_ceil(WIDEST).max(1);
    let [width, height] = [image.width, image.height].map(|n| n.div_ceil(block));
    let pixel = |i: u32| {
        let [x, y] = [i % width, i / width].map(|v| v * block);
        let rows = y..(y + block).min(image.height);
        let columns = x as usize..(x + block).min(image.width) as usize;
        let row = |y: u32| &image.pixels[y as usize * image.width as usize..][columns.clone()];
        join(&rows.flat_map(row).copied().collect::<Vec<_>>())
    };
    Image { width, height, pixels: (0..width * height).map(pixel).collect() }
}

fn png(image: &Image) -> Result<Vec<u8>> {
    let failed = |e: std::io::Error| Error::write(Path::new("a temporary picture"), e);
    let folder = tempfile::tempdir().map_err(failed)?;
    let path = folder.path().join("picture.png");
    image.write(&path, PngEncoding::Srgb)?;
    std::fs::read(&path).map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_fit_for_files() {
        let [program, device, method, integral, order] =
            ["VTK 9.5", "gpu", "Project/../Tets", "adaptive:0.001", "per-pixel"].map(String::from);
        let by = Contender { program, device, method, integral, order };
        assert_eq!(picture_name(&by), "VTK_9.5-gpu-Project_.._Tets-adaptive_0.001-per-pixel");
    }

    #[test]
    fn wide_pictures_become_smaller() {
        let mut image = Image::new(2 * WIDEST + 1, 4);
        image.pixels[1] = [1.0; 4];
        let small = smaller(&image, mean);
        assert_eq!((small.width, small.height), (image.width.div_ceil(3), 2));
        assert_eq!((small.pixels[0][0], small.pixels[1][0]), (1.0 / 9.0, 0.0));
        assert_eq!(smaller(&image, largest).pixels[0][0], 1.0);
        let image = Image::new(WIDEST, 3);
        assert_eq!(smaller(&image, mean), image);
    }
}
