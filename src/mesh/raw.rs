//! Raw volumes: nothing but samples, x fastest. What the file does not say comes from the options or its name.

use std::path::Path;

use super::sample_type::{Endian, SampleType};
use super::volume::Volume;
use super::{Mesh, ReadNote, ReadOptions};
use crate::error::{Error, Result};

/// Reads the samples at `path`, the first one at the origin.
///
/// Where `options` has no `dims` or `sample_type`, a file name such as `fuel_64x64x64_uint8.raw` gives them (noted);
/// otherwise the type is `u8`. Numbers are little endian unless the type ends in `be`. The array has the name's part
/// before the dimensions.
///
/// # Errors
/// [`Error::Asked`] for dimensions that are missing or absurd and unknown types; a size that is not exactly that of
/// the samples.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Mesh> {
    let bytes = std::fs::read(path).map_err(|e| Error::io(path, e))?;
    let hints = Hints::of(path);
    let Some(dims) = options.dims.or(hints.dims) else {
        return Err(Error::Asked(format!(
            "a raw volume does not tell its dimensions, and neither does the name: give them, as 64x64x64, and the \
             sample type, for the {} bytes of {}",
            bytes.len(),
            path.display()
        )));
    };
    let given = options.sample_type.as_deref().map(parse_type).transpose()?;
    let (kind, endian) = given.or(hints.kind.map(|k| (k, Endian::Little))).unwrap_or((SampleType::U8, Endian::Little));
    let volume = Volume {
        path,
        name: hints.name,
        dims,
        components: 1,
        origin: [0.0; 3],
        axes: Volume::spacing(path, options.spacing.unwrap_or([1.0; 3]))?,
    };
    let count = volume.sample_count()?;
    if count.checked_mul(kind.size()) != Some(bytes.len()) {
        let size = dims.map(|n| n.to_string()).join("x");
        let what = format!(
            "{size} samples of {} bytes each are {} bytes, and the file holds {}: give other dimensions or another type",
            kind.size(),
            count as u128 * kind.size() as u128,
            bytes.len()
        );
        return Err(Error::malformed(path, what));
    }
    let mut mesh = volume.mesh(options, kind.widen(&bytes, endian))?;
    if options.dims.is_none() {
        let text = "Dimensions were taken from the file's name, and the sample type where none was given";
        mesh.notes.push(ReadNote { text: text.into(), count: 0 });
    }
    Ok(mesh)
}

/// A sample type with an optional byte order, as `u8`, `i16be`.
fn parse_type(text: &str) -> Result<(SampleType, Endian)> {
    let (name, endian) = match text.strip_suffix("be") {
        Some(name) => (name, Endian::Big),
        None => (text.strip_suffix("le").unwrap_or(text), Endian::Little),
    };
    let unknown = || {
        Error::Asked(format!(
            "{text:?} is no sample type: there are u8, i8, u16, i16, u32, i32, u64, i64, f32, f64, each with be or le after it"
        ))
    };
    SampleType::named(name).map(|kind| (kind, endian)).ok_or_else(unknown)
}

/// What a file's name tells.
struct Hints {
    name: String,
    dims: Option<[usize; 3]>,
    kind: Option<SampleType>,
}

impl Hints {
    fn of(path: &Path) -> Self {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let parts: Vec<&str> = stem.split(['_', '-', '.', ' ']).collect();
        let found = parts.iter().position(|part| parse_dims(part).is_some());
        let name = match found {
            Some(i) if i > 0 => stem[..parts[..i].iter().map(|p| p.len() + 1).sum::<usize>() - 1].to_owned(),
            _ => stem.to_string(),
        };
        let kind = parts.iter().find_map(|part| SampleType::named(part));
        Self { name, dims: found.and_then(|i| parse_dims(parts[i])), kind }
    }
}

fn parse_dims(text: &str) -> Option<[usize; 3]> {
    let numbers: Option<Vec<usize>> = text.split('x').map(|n| n.parse().ok()).collect();
    numbers?.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_tell_dimensions_and_type() {
        let hints = Hints::of(Path::new("a/my_fuel_64x32x16_uint16.raw"));
        assert_eq!(
            (hints.name.as_str(), hints.dims, hints.kind),
            ("my_fuel", Some([64, 32, 16]), Some(SampleType::U16))
        );
        let hints = Hints::of(Path::new("64x64x64.raw"));
        assert_eq!((hints.name.as_str(), hints.dims, hints.kind), ("64x64x64", Some([64; 3]), None));
        let hints = Hints::of(Path::new("box_64x64.raw"));
        assert_eq!((hints.name.as_str(), hints.dims, hints.kind), ("box_64x64", None, None));
    }

    #[test]
    fn types_have_byte_orders() {
        assert_eq!(parse_type("i16be").unwrap(), (SampleType::I16, Endian::Big));
        assert_eq!(parse_type("f32le").unwrap(), (SampleType::F32, Endian::Little));
        assert_eq!(parse_type("u8").unwrap(), (SampleType::U8, Endian::Little));
        assert!(parse_type("u12").is_err());
    }
}
