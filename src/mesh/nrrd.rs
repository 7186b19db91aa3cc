//! NRRD volumes, attached (`.nrrd`) and detached (`.nhdr`), encodings raw, gzip and text.
//!
//! The format: <https://teem.sourceforge.net/nrrd/format.html>.

use std::borrow::Cow;
use std::collections::HashMap;
use std::io::Read;
use std::path::Path;

use flate2::read::MultiGzDecoder;
use glam::DVec3;

use super::sample_type::{Endian, SampleType};
use super::volume::Volume;
use super::{Mesh, ReadOptions};
use crate::error::{Error, Result};

/// Reads the volume whose header is at `path`. Three axes, or four of which the first holds components.
///
/// Positions are the header's (space directions and origin, else spacings), in the header's own space. The array has
/// the file's name.
///
/// # Errors
/// Malformed headers, unsupported encodings, types and axis orders, data of another size than the header says.
pub fn read(path: &Path, options: &ReadOptions) -> Result<Mesh> {
    let bytes = std::fs::read(path).map_err(|e| Error::io(path, e))?;
    let header = Header::parse(&bytes, path)?;
    let volume = header.volume()?;
    let count = volume.sample_count()?;
    let kind = header.sample_type()?;
    let endian = header.endian(kind)?;
    let encoding = header.encoding()?;
    let data = header.data(&bytes)?;
    let values = match encoding {
        Encoding::Text => header.text(&data, count)?,
        Encoding::Raw => kind.widen(header.whole(&data, count, kind)?, endian),
        Encoding::Gzip => {
            let unpacked = header.gunzip(&data, count, kind)?;
            kind.widen(header.whole(&unpacked, count, kind)?, endian)
        }
    };
    volume.mesh(options, values)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Encoding {
    Raw,
    Gzip,
    Text,
}

/// The fields as text; field names are lower case, alternative spellings unified.
struct Header<'a> {
    path: &'a Path,
    fields: HashMap<String, String>,
    /// Where attached data begin.
    end: usize,
}

impl<'a> Header<'a> {
    fn parse(bytes: &[u8], path: &'a Path) -> Result<Self> {
        if !bytes.starts_with(b"NRRD000") {
            return Err(Error::malformed(path, "not a NRRD file: its first line does not begin with NRRD000"));
        }
        let mut header = Self { path, fields: HashMap::new(), end: bytes.len() };
        let mut at = 0;
        for (number, line) in bytes.split_inclusive(|b| *b == b'\n').enumerate() {
            at += line.len();
            let text = std::str::from_utf8(line)
                .map_err(|_| Error::malformed(path, format!("line {} of the NRRD header is no text", number + 1)))?
                .trim();
            if text.is_empty() {
                header.end = at;
                break;
            }
            // Comments, and key/value pairs, which say nothing about the samples.
            if number == 0 || text.starts_with('#') || text.contains(":=") {
                continue;
            }
            let (key, value) = text.split_once(':').ok_or_else(|| {
                Error::malformed(path, format!("line {} of the NRRD header has no colon: {text:?}", number + 1))
            })?;
            let key = match key.trim().to_ascii_lowercase().as_str() {
                "datafile" => "data file".to_owned(),
                "lineskip" => "line skip".to_owned(),
                "byteskip" => "byte skip".to_owned(),
                other => other.to_owned(),
            };
            header.fields.insert(key, value.trim().to_owned());
        }
        Ok(header)
    }

    fn fail(&self, what: impl Into<String>) -> Error {
        Error::malformed(self.path, what)
    }

    fn get(&self, key: &str) -> Option<&str> {
        self.fields.get(key).map(String::as_str)
    }

    fn need(&self, key: &str) -> Result<&str> {
        self.get(key).ok_or_else(|| self.fail(format!("the NRRD header has no field {key:?}")))
    }

    fn volume(&self) -> Result<Volume<'a>> {
        let parsed: Option<Vec<usize>> = self.need("sizes")?.split_whitespace().map(|n| n.parse().ok()).collect();
        let sizes = parsed.ok_or_else(|| self.fail("the NRRD field \"sizes\" does not hold whole numbers"))?;
        let dimension = self.need("dimension")?;
        if dimension.parse() != Ok(sizes.len()) {
            return Err(self.fail(format!("NRRD dimension is {dimension:?} and there are {} sizes", sizes.len())));
        }
        let (components, dims) = match sizes[..] {
            [x, y, z] => (1, [x, y, z]),
            [n, x, y, z] if n > 0 => (n, [x, y, z]),
            _ => return Err(self.fail(format!("{} axes: three are read, or components and three", sizes.len()))),
        };
        if sizes.len() == 4 {
            self.check_components()?;
        }
        let (origin, axes) = self.placement(sizes.len())?;
        let stem = self.path.file_stem().unwrap_or_default().to_string_lossy();
        let name = stem.strip_suffix(".nrrd").unwrap_or(&stem).to_owned();
        Ok(Volume { path: self.path, name, dims, components, origin, axes })
    }

    /// Of four axes the first must be the one outside space.
    fn check_components(&self) -> Result<()> {
        let spatial = |kind: &str| matches!(kind.to_ascii_lowercase().as_str(), "domain" | "space" | "time");
        let kinds: Vec<&str> = self.get("kinds").unwrap_or_default().split_whitespace().collect();
        let outside_first = match (&kinds[..], self.get("space directions")) {
            ([first, rest @ ..], _) if rest.len() == 3 => {
                !spatial(first) && rest.iter().all(|k| spatial(k) || matches!(*k, "???" | "none"))
            }
            (_, Some(directions)) => directions.trim_start().starts_with("none"),
            _ => true,
        };
        if outside_first {
            return Ok(());
        }
        Err(self
            .fail("of four NRRD axes the first must hold the components (kinds as \"vector domain domain domain\")"))
    }

    /// Origin and steps, from the space directions, or the spacings and axis mins.
    fn placement(&self, dimension: usize) -> Result<([f64; 3], [DVec3; 3])> {
        let skip = dimension - 3;
        if let Some(text) = self.get("space directions") {
            let vectors = vectors(text).ok_or_else(|| self.fail("NRRD \"space directions\" are no vectors"))?;
            let axes = match vectors[..] {
                [Some(x), Some(y), Some(z)] if skip == 0 => [x, y, z],
                [_, Some(x), Some(y), Some(z)] if skip == 1 => [x, y, z],
                _ => return Err(self.fail("NRRD \"space directions\" must give three numbers for each of three axes")),
            };
            // Written so that NaN is refused too.
            let volume = axes[0].cross(axes[1]).dot(axes[2]);
            if !(volume.is_finite() && volume != 0.0) {
                return Err(self.fail("NRRD \"space directions\" span no volume"));
            }
            let origin = match self.get("space origin").map(vectors_of_origin) {
                None => DVec3::ZERO,
                Some(Some(origin)) => origin,
                Some(None) => return Err(self.fail("NRRD \"space origin\" is no vector of three numbers")),
            };
            return Ok((origin.to_array(), axes));
        }
        let per_axis = |key: &str, default: f64| -> Result<[f64; 3]> {
            let Some(text) = self.get(key) else { return Ok([default; 3]) };
            let numbers: Option<Vec<f64>> = text.split_whitespace().map(|n| n.parse().ok()).collect();
            let numbers = numbers.filter(|n| n.len() == dimension);
            let numbers = numbers.ok_or_else(|| self.fail(format!("NRRD {key:?} must be {dimension} numbers")))?;
            Ok([0, 1, 2].map(|i| numbers[skip + i]).map(|v| if v.is_nan() { default } else { v }))
        };
        Ok((per_axis("axis mins", 0.0)?, Volume::spacing(self.path, per_axis("spacings", 1.0)?)?))
    }

    fn sample_type(&self) -> Result<SampleType> {
        let text = self.need("type")?;
        let bare = text.strip_suffix("_t").unwrap_or(text);
        SampleType::named(bare)
            .or(match bare {
                "signed char" => Some(SampleType::I8),
                "uchar" | "unsigned char" => Some(SampleType::U8),
                "short" | "short int" | "signed short" | "signed short int" => Some(SampleType::I16),
                "ushort" | "unsigned short" | "unsigned short int" => Some(SampleType::U16),
                "int" | "signed int" => Some(SampleType::I32),
                "uint" | "unsigned int" => Some(SampleType::U32),
                "longlong" | "long long" | "long long int" | "signed long long" | "signed long long int" => {
                    Some(SampleType::I64)
                }
                "ulonglong" | "unsigned long long" | "unsigned long long int" => Some(SampleType::U64),
                "float" => Some(SampleType::F32),
                "double" => Some(SampleType::F64),
                _ => None,
            })
            .ok_or_else(|| self.fail(format!("NRRD type {text:?} is not read: convert to a number type")))
    }

    fn endian(&self, kind: SampleType) -> Result<Endian> {
        match self.get("endian") {
            Some("little") => Ok(Endian::Little),
            Some("big") => Ok(Endian::Big),
            Some(other) => Err(self.fail(format!("NRRD endian {other:?} is neither little nor big"))),
            None if kind.size() == 1 || self.encoding()? == Encoding::Text => Ok(Endian::Little),
            None => Err(self.fail("the NRRD header has no field \"endian\", and its samples have several bytes")),
        }
    }

    fn encoding(&self) -> Result<Encoding> {
        match self.need("encoding")? {
            "raw" => Ok(Encoding::Raw),
            "gzip" | "gz" => Ok(Encoding::Gzip),
            "text" | "txt" | "ascii" => Ok(Encoding::Text),
            other => Err(self.fail(format!("NRRD encoding {other:?} is not read: save as raw, gzip or text"))),
        }
    }

    /// The encoded data: after the header or in the data file, skipped lines and bytes taken off.
    fn data<'b>(&self, bytes: &'b [u8]) -> Result<Cow<'b, [u8]>> {
        let mut data = match self.get("data file") {
            None => Cow::Borrowed(&bytes[self.end..]),
            Some(name) if name.starts_with("LIST") || name.contains('%') => {
                return Err(self.fail("NRRD data in several files are not read: join them"));
            }
            Some(name) => {
                let file = self.path.parent().unwrap_or(Path::new("")).join(name);
                Cow::Owned(std::fs::read(&file).map_err(|e| Error::io(&file, e))?)
            }
        };
        let number = |key: &str| -> Result<i64> {
            let text = self.get(key).unwrap_or("0");
            text.parse().map_err(|_| self.fail(format!("NRRD {key:?} is no whole number: {text:?}")))
        };
        let (lines, skip) = (number("line skip")?, number("byte skip")?);
        let mut start = 0;
        for _ in 0..lines {
            let Some(line) = data[start..].iter().position(|b| *b == b'\n') else {
                return Err(self.fail(format!("the NRRD data have fewer than the {lines} lines to be skipped")));
            };
            start += line + 1;
        }
        if skip == -1 && self.encoding()? == Encoding::Raw {
            // The samples are the file's last bytes.
            let size = self.volume()?.sample_count()?.checked_mul(self.sample_type()?.size());
            start = size.and_then(|size| data.len().checked_sub(size)).unwrap_or(0);
        } else if skip != 0 && self.encoding()? != Encoding::Gzip {
            let skipped = usize::try_from(skip).ok().and_then(|skip| start.checked_add(skip));
            start = skipped.filter(|start| *start <= data.len()).ok_or_else(|| {
                self.fail(format!("NRRD \"byte skip\" {skip} is beyond the {} bytes of data", data.len()))
            })?;
        }
        match &mut data {
            Cow::Borrowed(data) => *data = &data[start..],
            Cow::Owned(data) => drop(data.drain(..start)),
        }
        Ok(data)
    }

    /// `data` if they are exactly the samples.
    fn whole<'b>(&self, data: &'b [u8], count: usize, kind: SampleType) -> Result<&'b [u8]> {
        match count.checked_mul(kind.size()) {
            Some(size) if size == data.len() => Ok(data),
            _ => {
                let size = count as u128 * kind.size() as u128;
                Err(self
                    .fail(format!("the NRRD header promises {size} bytes of samples, and there are {}", data.len())))
            }
        }
    }

    /// The unpacked samples; skipped bytes are counted in the unpacked data, as the format says.
    fn gunzip(&self, data: &[u8], count: usize, kind: SampleType) -> Result<Vec<u8>> {
        let skip = self.get("byte skip").unwrap_or("0").parse::<usize>();
        let skip = skip.map_err(|_| self.fail("NRRD \"byte skip\" must not be negative in packed data"))?;
        let size = count.checked_mul(kind.size()).and_then(|size| size.checked_add(skip));
        let size = size.ok_or_else(|| self.fail("the NRRD sizes are beyond the address space"))?;
        let mut unpacked = Vec::new();
        // One byte more than wanted shows that there is too much, without unpacking all of it.
        let mut limited = MultiGzDecoder::new(data).take(size as u64 + 1);
        limited.read_to_end(&mut unpacked).map_err(|e| self.fail(format!("the NRRD data cannot be unpacked ({e})")))?;
        unpacked.drain(..skip.min(unpacked.len()));
        Ok(unpacked)
    }

    fn text(&self, data: &[u8], count: usize) -> Result<Vec<f64>> {
        let mut values = Vec::new();
        for word in data.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()) {
            let value = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
            values.push(value.ok_or_else(|| {
                let word = String::from_utf8_lossy(word);
                self.fail(format!(
                    "NRRD sample {} is no number: {:?}",
                    values.len(),
                    word.chars().take(20).collect::<String>()
                ))
            })?);
        }
        if values.len() == count {
            return Ok(values);
        }
        Err(self.fail(format!("the NRRD header promises {count} numbers, and there are {}", values.len())))
    }
}

fn vectors_of_origin(text: &str) -> Option<DVec3> {
    match vectors(text)?[..] {
        [Some(origin)] => Some(origin),
        _ => None,
    }
}

/// `(1,0,0) none (0, 1, 0)`; `None` inside for `none`, outside for anything else.
fn vectors(text: &str) -> Option<Vec<Option<DVec3>>> {
    let mut rest = text.trim();
    let mut found = Vec::new();
    while !rest.is_empty() {
        if let Some(after) = rest.strip_prefix("none") {
            found.push(None);
            rest = after.trim_start();
            continue;
        }
        let (inside, after) = rest.strip_prefix('(')?.split_once(')')?;
        let numbers: Option<Vec<f64>> = inside.split(',').map(|n| n.trim().parse().ok()).collect();
        found.push(Some(DVec3::from_array(numbers?.try_into().ok()?)));
        rest = after.trim_start();
    }
    Some(found)
}
