//! Comparisons report planted errors, and files give back what was written.

mod common;

use tetralux::error::Error;
use tetralux::image::{Comparison, Image, PngEncoding};

/// 100 x 50 pixels of smooth colours, premultiplied, opacity between 0.1 and 1.
fn picture() -> Image {
    let mut image = Image::new(100, 50);
    for (i, pixel) in image.pixels.iter_mut().enumerate() {
        let (x, y) = ((i % 100) as f32 / 100.0, (i / 100) as f32 / 50.0);
        let alpha = 0.1 + 0.9 * x;
        *pixel = [alpha * x, alpha * y, alpha * (1.0 - x) * y, alpha];
    }
    image
}

#[test]
fn equal_images_have_no_error() {
    let same = Comparison::new(&picture(), &picture()).expect("equal sizes");
    assert_eq!((same.max, same.rmse, same.percentile_99_9, same.above_8_bit), (0.0, 0.0, 0.0, 0.0));
    assert_eq!(same.psnr, f64::INFINITY);
    assert!(same.sweep.iter().all(|s| s.1 == 0));
}

#[test]
fn one_wrong_channel_of_one_pixel_is_found() {
    for channel in 0..4 {
        let mut wrong = picture();
        wrong.pixels[1234][channel] += 0.25;
        let found = Comparison::new(&wrong, &picture()).expect("equal sizes");
        assert!((found.max - 0.25).abs() < 1e-7, "{found}");
        assert_eq!(found.worst.pixel, [34, 12]);
        assert_eq!((found.worst.got, found.worst.want), (wrong.pixels[1234], picture().pixels[1234]));
        assert!((found.rmse - 0.25 / (4.0f64 * 5000.0).sqrt()).abs() < 1e-8, "{found}");
        assert!((found.psnr + 20.0 * found.rmse.log10()).abs() < 1e-12);
        assert_eq!(found.percentile_99_9, 0.0, "one of 5000 is below a thousandth");
        assert_eq!(found.above_8_bit, 1.0 / 5000.0);
        let counts: Vec<u64> = found.sweep.iter().map(|&(limit, _)| u64::from(limit < 0.25)).collect();
        assert_eq!(found.sweep.iter().map(|s| s.1).collect::<Vec<_>>(), counts);
        assert_eq!(found.pixels_above(1e-3).map(|p| p.0).collect::<Vec<_>>(), [[34, 12]]);
        let shown = found.difference_picture(2.0);
        assert_eq!(shown.pixels.iter().filter(|p| p[..3] != [0.0; 3]).count(), 1, "and only there");
    }
}

#[test]
fn the_percentile_counts_pixels() {
    for (wrong_pixels, want) in [(5, 0.0), (6, 0.5)] {
        let mut wrong = picture();
        wrong.pixels[..wrong_pixels].iter_mut().for_each(|p| p[3] += 0.5);
        let found = Comparison::new(&wrong, &picture()).expect("equal sizes");
        assert!((found.percentile_99_9 - want).abs() < 1e-6, "{wrong_pixels} of 5000: {found}");
    }
}

#[test]
fn what_is_not_finite_fails_every_limit() {
    for bad in [f32::NAN, f32::INFINITY] {
        let mut wrong = picture();
        wrong.pixels[7][2] = bad;
        for (got, want) in [(&wrong, &picture()), (&picture(), &wrong), (&wrong, &wrong)] {
            let found = Comparison::new(got, want).expect("equal sizes");
            assert_eq!((found.not_finite, found.worst.pixel), (1, [7, 0]));
            assert_eq!((found.max, found.rmse, found.psnr), (f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY));
            assert_eq!(found.difference_picture(1.0).pixels[7], [1.0, 0.0, 1.0, 1.0]);
        }
    }
}

#[test]
fn sizes_that_differ_are_refused() {
    let Err(Error::Asked(message)) = Comparison::new(&picture(), &Image::new(50, 100)) else { panic!("accepted") };
    assert!(message.contains("100x50 and 50x100"), "{message}");
    assert!(Comparison::new(&Image::new(0, 0), &Image::new(0, 0)).is_err());
}

#[test]
fn reports_name_the_numbers() {
    let mut wrong = picture();
    wrong.pixels[1234][0] += 0.25;
    let found = Comparison::new(&wrong, &picture()).expect("equal sizes");
    let table = found.to_string();
    assert!(table.contains("max error        2.500e-1") && table.contains("(34, 12)"), "{table}");
    let json = serde_json::to_value(&found).expect("JSON");
    assert_eq!(json["worst"]["pixel"][0], 34);
    assert_eq!(json["sweep"][0][1], 1);
}

#[test]
fn an_exr_keeps_every_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut image = picture();
    image.pixels[3] = [7.5, 1e-30, 0.0, 0.25];
    let path = folder.path().join("image.exr");
    image.write(&path, PngEncoding::Srgb).expect("written");
    assert_eq!(Image::read(&path).expect("read"), image, "emission beyond opacity too");
}

#[test]
fn a_png_keeps_eight_bits_in_either_encoding() {
    let folder = tempfile::tempdir().expect("a folder");
    for encoding in [PngEncoding::Srgb, PngEncoding::Linear] {
        let path = folder.path().join("image.png");
        picture().write(&path, encoding).expect("written");
        let back = Comparison::new(&Image::read(&path).expect("read"), &picture()).expect("equal sizes");
        // sRGB is steepest at white, 2.3 times a linear step; the rounding of alpha adds another.
        assert!(back.max <= 3.3 * 0.5 / 255.0, "{encoding:?}: {back}");
    }
}

#[test]
fn a_png_is_straight_and_srgb() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("image.png");
    let half = 0.5f32;
    let image = Image { width: 2, height: 1, pixels: vec![[0.25, half, 0.0, half], [1.0, 0.0, 0.0, 0.0]] };
    image.write(&path, PngEncoding::Srgb).expect("written");
    let raw = image::open(&path).expect("a PNG").into_rgba8();
    assert_eq!(raw.get_pixel(0, 0).0, [188, 255, 0, 128], "0.5 linear is 188 in sRGB");
    assert_eq!(raw.get_pixel(1, 0).0, [0, 0, 0, 0], "emission without opacity cannot be held");
}

#[test]
fn failed_writes_leave_nothing_behind() {
    let folder = tempfile::tempdir().expect("a folder");
    assert!(matches!(picture().write(&folder.path().join("image.jpg"), PngEncoding::Srgb), Err(Error::Asked(_))));
    assert!(matches!(
        Image::new(0, 0).write(&folder.path().join("a.png"), PngEncoding::Srgb),
        Err(Error::Write { .. })
    ));
    assert!(matches!(
        Image::new(0, 0).write(&folder.path().join("a.exr"), PngEncoding::Srgb),
        Err(Error::Write { .. })
    ));
    let short = Image { pixels: vec![], ..picture() };
    assert!(matches!(short.write(&folder.path().join("a.exr"), PngEncoding::Srgb), Err(Error::Write { .. })));
    let nowhere = folder.path().join("none").join("image.png");
    assert!(matches!(picture().write(&nowhere, PngEncoding::Srgb), Err(Error::Write { .. })));
    assert_eq!(std::fs::read_dir(folder.path()).expect("listed").count(), 0);
}

#[test]
fn garbled_files_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["image.png", "image.exr"] {
        let path = folder.path().join(name);
        assert!(matches!(Image::read(&path), Err(Error::Io { .. })));
        picture().write(&path, PngEncoding::Srgb).expect("written");
        let whole = std::fs::read(&path).expect("read");
        for length in [0, 4, 40, whole.len() / 2] {
            std::fs::write(&path, &whole[..length]).expect("written");
            assert!(matches!(Image::read(&path), Err(Error::Malformed { .. })), "{name} of {length} bytes");
        }
    }
}

#[test]
fn absurd_sizes_are_refused_before_they_are_allocated() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("image.png");
    picture().write(&path, PngEncoding::Srgb).expect("written");
    let mut bytes = std::fs::read(&path).expect("read");
    bytes[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
    let mut crc = flate2::Crc::new();
    crc.update(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&crc.sum().to_be_bytes());
    std::fs::write(&path, bytes).expect("written");
    assert!(matches!(Image::read(&path), Err(Error::Malformed { .. })));
}

#[test]
fn a_background_shows_through() {
    let over = Image { width: 1, height: 1, pixels: vec![[0.25, 0.0, 0.0, 0.75]] }.over([1.0, 1.0, 0.0, 1.0]);
    assert_eq!(over.pixels, [[0.5, 0.25, 0.0, 1.0]]);
}
