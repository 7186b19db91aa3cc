//! NumPy's array files, as far as the references use them: little-endian f32, C order, alone or zipped.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;

use tetralux::image::Image;

/// The array `rgba` (height x width x 4, f32) of an `.npz` file.
pub fn rgba(path: &Path) -> Image {
    let file = File::open(path).unwrap_or_else(|e| panic!("{e}: {}", path.display()));
    let mut archive = zip::ZipArchive::new(file).expect("a zip archive");
    let mut bytes = Vec::new();
    archive.by_name("rgba.npy").expect("an array named rgba").read_to_end(&mut bytes).expect("whole data");
    let (shape, data) = parse(&bytes);
    let [height, width, 4] = shape[..] else { panic!("not height x width x 4: {shape:?}") };
    let pixels: Vec<[f32; 4]> = data.chunks_exact(4).map(|p| [p[0], p[1], p[2], p[3]]).collect();
    assert_eq!(pixels.len(), width * height);
    Image { width: width as u32, height: height as u32, pixels }
}

/// Shape and values of an `.npy` file of version 1.
fn parse(bytes: &[u8]) -> (Vec<usize>, Vec<f32>) {
    assert_eq!(&bytes[..7], b"\x93NUMPY\x01", "an npy file of version 1");
    let start = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = std::str::from_utf8(&bytes[10..start]).expect("a readable header");
    assert!(header.contains("'<f4'") && header.contains("'fortran_order': False"), "{header}");
    let shape = header.split_once("'shape': (").and_then(|(_, rest)| rest.split_once(')')).expect("a shape").0;
    let shape = shape.split(',').filter_map(|n| n.trim().parse().ok()).collect();
    (shape, bytes[start..].chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect())
}
