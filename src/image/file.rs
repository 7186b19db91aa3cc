//! Images as files: PNG (8 bit, straight alpha) and OpenEXR (32-bit float, linear, premultiplied).

use std::fs::File;
use std::io::{BufReader, BufWriter, Write as _};
use std::path::Path;

use image::codecs::openexr::OpenExrEncoder;
use image::{ColorType, ImageDecoder as _, ImageEncoder as _, ImageFormat, ImageReader};

use super::{Image, color};
use crate::error::{Error, Result};

/// How colours stand in a PNG; alpha is always linear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PngEncoding {
    /// The sRGB transfer curve: what viewers expect.
    #[default]
    Srgb,
    /// Linear, said so in the file (`gAMA` = 1).
    Linear,
}

/// Larger images are taken for garbled headers: 16384 x 16384 fill 4 GiB.
const MOST_PIXELS: u64 = 1 << 28;

impl Image {
    /// Writes a `.png` or `.exr` file, whole or not at all. A PNG cannot hold emission beyond opacity: there colours
    /// are clamped to 1 and fully transparent pixels are black.
    pub fn write(&self, path: &Path, encoding: PngEncoding) -> Result<()> {
        let format = Format::of(path)?;
        if self.pixels.len() as u64 != u64::from(self.width) * u64::from(self.height) {
            let [pixels, width, height] = [self.pixels.len() as u64, self.width.into(), self.height.into()];
            return Err(Error::write(path, format!("{pixels} pixels are no image of {width}x{height}")));
        }
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            // The user's umask decides, as for any other file; temporary files are private by default.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        let mut file = builder.tempfile_in(folder).map_err(|e| Error::write(path, e))?;
        match format {
            Format::Png => self.encode_png(file.as_file_mut(), encoding).map_err(|e| Error::write(path, e))?,
            Format::Exr => self.encode_exr(file.as_file_mut()).map_err(|e| Error::write(path, e))?,
        }
        file.persist(path).map_err(|e| Error::write(path, e.error))?;
        Ok(())
    }

    /// Reads a `.png` (8 or 16 bit; sRGB unless it says that it is linear) or `.exr` file (its first layer with RGB or
    /// RGBA, taken as linear and premultiplied). Images without alpha are opaque.
    pub fn read(path: &Path) -> Result<Self> {
        let file = BufReader::new(File::open(path).map_err(|e| Error::io(path, e))?);
        match Format::of(path)? {
            Format::Png => read_png(path, file),
            Format::Exr => read_exr(path, file),
        }
    }

    fn encode_png(&self, file: &mut File, encoding: PngEncoding) -> Result<(), png::EncodingError> {
        let encode = match encoding {
            PngEncoding::Srgb => color::srgb_from_linear,
            PngEncoding::Linear => |v| v,
        };
        // `as` saturates and takes NaN to 0.
        let eight_bits = |v: f32| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
        let bytes: Vec<u8> = self
            .pixels
            .iter()
            .flat_map(|&[r, g, b, a]| {
                let straight = |v: f32| if a > 0.0 { encode((v / a).clamp(0.0, 1.0)) } else { 0.0 };
                [straight(r), straight(g), straight(b), a].map(eight_bits)
            })
            .collect();
        let mut encoder = png::Encoder::new(BufWriter::new(file), self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        encoder.set_depth(png::BitDepth::Eight);
        match encoding {
            PngEncoding::Srgb => encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric),
            PngEncoding::Linear => encoder.set_source_gamma(png::ScaledFloat::new(1.0)),
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(&bytes)?;
        writer.finish()
    }

    fn encode_exr(&self, file: &mut File) -> Result<(), image::ImageError> {
        let bytes: &[u8] = bytemuck::cast_slice(&self.pixels);
        let mut writer = BufWriter::new(file);
        OpenExrEncoder::new(&mut writer).write_image(bytes, self.width, self.height, ColorType::Rgba32F.into())?;
        writer.flush()?;
        Ok(())
    }
}

/// By the file's extension.
#[derive(Clone, Copy, Debug)]
enum Format {
    Png,
    Exr,
}

impl Format {
    fn of(path: &Path) -> Result<Self> {
        match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            _ => Err(Error::Asked(format!("not an image's name: end it in .png or .exr: {}", path.display()))),
        }
    }
}

/// Refuses what could not be held, before it is allocated.
fn check_size(path: &Path, width: u32, height: u32) -> Result<()> {
    match u64::from(width) * u64::from(height) {
        0..=MOST_PIXELS => Ok(()),
        _ => Err(Error::malformed(path, format!("an image of {width}x{height} pixels is beyond what can be read"))),
    }
}

fn read_png(path: &Path, file: BufReader<File>) -> Result<Image> {
    let malformed = |e: png::DecodingError| Error::malformed(path, format!("not a readable PNG ({e})"));
    let mut decoder = png::Decoder::new(file);
    decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
    let mut reader = decoder.read_info().map_err(malformed)?;
    let linear = reader.info().srgb.is_none() && reader.info().gama_chunk.is_some_and(|g| g.into_value() == 1.0);
    check_size(path, reader.info().width, reader.info().height)?;
    let size = reader.output_buffer_size().ok_or_else(|| Error::malformed(path, "too large for this machine"))?;
    let mut bytes = vec![0; size];
    let frame = reader.next_frame(&mut bytes).map_err(malformed)?;
    let samples: Vec<f32> = match frame.bit_depth {
        png::BitDepth::Sixteen => {
            bytes.chunks_exact(2).map(|b| f32::from(u16::from_be_bytes([b[0], b[1]])) / 65535.0).collect()
        }
        _ => bytes.iter().map(|&b| f32::from(b) / 255.0).collect(),
    };
    let decode = |v: f32| if linear { v } else { color::linear_from_srgb(v) };
    let premultiplied = |[r, g, b, a]: [f32; 4]| [decode(r) * a, decode(g) * a, decode(b) * a, a];
    let pixels = match frame.color_type {
        png::ColorType::Rgba => samples.chunks_exact(4).map(|p| premultiplied([p[0], p[1], p[2], p[3]])).collect(),
        png::ColorType::GrayscaleAlpha => {
            samples.chunks_exact(2).map(|p| premultiplied([p[0], p[0], p[0], p[1]])).collect()
        }
        other => return Err(Error::malformed(path, format!("unexpected colour type {other:?}"))),
    };
    Ok(Image { width: frame.width, height: frame.height, pixels })
}

fn read_exr(path: &Path, file: BufReader<File>) -> Result<Image> {
    let malformed = |e: image::ImageError| Error::malformed(path, format!("not a readable RGB or RGBA OpenEXR ({e})"));
    let decoder = ImageReader::with_format(file, ImageFormat::OpenExr).into_decoder().map_err(malformed)?;
    let (width, height) = decoder.dimensions();
    check_size(path, width, height)?;
    let pixels = image::DynamicImage::from_decoder(decoder).map_err(malformed)?.into_rgba32f();
    Ok(Image { width, height, pixels: pixels.pixels().map(|p| p.0).collect() })
}
