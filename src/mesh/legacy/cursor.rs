//! Words, lines and blocks of numbers of a legacy VTK file.

use std::path::Path;
use std::str::FromStr;

use crate::error::{Error, Result};
use crate::mesh::sample_type::{Endian, SampleType};

/// Where a block of numbers lies; made only by [`Cursor::block`], which has checked that they are there.
#[derive(Clone, Debug)]
pub(super) struct Block {
    kind: Stored,
    count: usize,
    start: usize,
}

/// How numbers are stored in binary files.
#[derive(Clone, Copy, Debug)]
enum Stored {
    Number(SampleType),
    /// Eight to a byte, most significant first.
    Bits,
}

/// Steps through the file's bytes.
pub(super) struct Cursor<'a> {
    path: &'a Path,
    bytes: &'a [u8],
    at: usize,
    binary: bool,
}

impl<'a> Cursor<'a> {
    /// Reads version, title and encoding.
    pub(super) fn new(path: &'a Path, bytes: &'a [u8]) -> Result<Self> {
        let mut cursor = Self { path, bytes, at: 0, binary: false };
        if !cursor.line().to_ascii_lowercase().starts_with(b"# vtk datafile version") {
            return Err(Error::malformed(
                path,
                "line 1: not a legacy VTK file: it does not begin with \"# vtk DataFile Version\"",
            ));
        }
        cursor.line();
        cursor.binary = match cursor.need("ASCII or BINARY")?.to_ascii_uppercase().as_str() {
            "ASCII" => false,
            "BINARY" => true,
            other => return Err(cursor.fail(format!("{:?} is neither ASCII nor BINARY", shown(other)))),
        };
        Ok(cursor)
    }

    /// A malformed file, with the place.
    pub(super) fn fail(&self, what: impl AsRef<str>) -> Error {
        let place = if self.binary {
            format!("byte {}", self.at)
        } else {
            format!("line {}", 1 + self.bytes[..self.at].iter().filter(|b| **b == b'\n').count())
        };
        Error::malformed(self.path, format!("{place}: {}", what.as_ref()))
    }

    /// The next word, or `None` at the end. Bytes that are not text are shown as replacement characters.
    pub(super) fn word(&mut self) -> Option<String> {
        self.raw_word().map(|word| String::from_utf8_lossy(word).into_owned())
    }

    fn raw_word(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        let skipped = rest.iter().position(|b| !b.is_ascii_whitespace())?;
        let word = &rest[skipped..];
        let length = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
        self.at += skipped + length;
        Some(&word[..length])
    }

    /// The next word, or an error that tells that `what` is missing.
    pub(super) fn need(&mut self, what: &str) -> Result<String> {
        self.word().ok_or_else(|| self.fail(format!("the file ends where {what} should be")))
    }

    /// The next word as a number.
    pub(super) fn number<T: FromStr>(&mut self, what: &str) -> Result<T> {
        let word = self.need(what)?;
        word.parse().map_err(|_| self.fail(format!("{:?} where {what} should be", shown(&word))))
    }

    /// The rest of this line, without its end.
    pub(super) fn line(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
        self.at += (length + 1).min(rest.len());
        rest[..length].trim_ascii()
    }

    /// The words of the rest of this line.
    pub(super) fn words_of_line(&mut self) -> Vec<String> {
        String::from_utf8_lossy(self.line()).split_whitespace().map(str::to_owned).collect()
    }

    /// Takes the next word if it is `word`, whatever its case.
    pub(super) fn take(&mut self, word: &str) -> bool {
        let before = self.at;
        let taken = self.raw_word().is_some_and(|w| w.eq_ignore_ascii_case(word.as_bytes()));
        if !taken {
            self.at = before;
        }
        taken
    }

    /// Steps over `count` numbers of the type named `kind`, which begin on the next line.
    pub(super) fn block(&mut self, count: usize, kind: &str) -> Result<Block> {
        let kind = self.stored(kind)?;
        if self.binary {
            self.line();
        }
        let start = self.at;
        let left = self.bytes.len() - start;
        if self.binary {
            let size = match kind {
                Stored::Number(number) => count.checked_mul(number.size()),
                Stored::Bits => Some(count.div_ceil(8)),
            };
            let size = size.filter(|size| *size <= left);
            self.at += size.ok_or_else(|| self.fail(format!("{count} numbers promised, and {left} bytes left")))?;
        } else {
            // A number takes at least a digit and, but for the last one, a separator.
            if count > left.div_ceil(2) {
                return Err(self.fail(format!("{count} numbers promised, and {left} bytes left")));
            }
            for i in 0..count {
                if self.raw_word().is_none() {
                    return Err(self.fail(format!("the file ends after {i} of {count} numbers")));
                }
            }
        }
        Ok(Block { kind, count, start })
    }

    /// The numbers of a block. (Integers beyond 2^53 are rounded.)
    pub(super) fn decode(&self, block: &Block) -> Result<Vec<f64>> {
        if !self.binary {
            let mut cursor = Cursor { at: block.start, ..*self };
            return (0..block.count).map(|_| cursor.ascii_number()).collect();
        }
        let data = &self.bytes[block.start..];
        Ok(match block.kind {
            Stored::Number(number) => number.widen(&data[..block.count * number.size()], Endian::Big),
            Stored::Bits => (0..block.count).map(|i| f64::from(data[i / 8] >> (7 - i % 8) & 1)).collect(),
        })
    }

    fn ascii_number(&mut self) -> Result<f64> {
        let word = std::str::from_utf8(self.raw_word().unwrap_or_default()).unwrap_or("bytes that are no text");
        // Microsoft's run time writes -nan(ind).
        let nan = || word.trim_start_matches('-').to_ascii_lowercase().starts_with("nan").then_some(f64::NAN);
        word.parse().ok().or_else(nan).ok_or_else(|| self.fail(format!("{:?} where a number should be", shown(word))))
    }

    fn stored(&self, kind: &str) -> Result<Stored> {
        let number = match kind.to_ascii_lowercase().as_str() {
            "bit" => return Ok(Stored::Bits),
            "unsigned_char" => SampleType::U8,
            "char" | "signed_char" => SampleType::I8,
            "unsigned_short" => SampleType::U16,
            "short" => SampleType::I16,
            "unsigned_int" => SampleType::U32,
            // VTK writes vtkIdType as 32-bit.
            "int" | "vtkidtype" => SampleType::I32,
            "unsigned_long" | "vtktypeuint64" => SampleType::U64,
            "long" | "vtktypeint64" => SampleType::I64,
            "float" => SampleType::F32,
            "double" => SampleType::F64,
            _ => return Err(self.fail(format!("{:?} is no number type of a legacy VTK file", shown(kind)))),
        };
        Ok(Stored::Number(number))
    }

    /// Whether the file has at least `size` bytes.
    pub(super) fn holds(&self, size: usize) -> bool {
        size <= self.bytes.len()
    }

    /// Whether the file is binary.
    pub(super) fn is_binary(&self) -> bool {
        self.binary
    }

    /// Whether the next line begins with `word`.
    pub(super) fn next_line_begins(&self, word: &str) -> bool {
        let mut ahead = Cursor { ..*self };
        ahead.line();
        ahead.bytes[ahead.at..].get(..word.len()).is_some_and(|w| w.eq_ignore_ascii_case(word.as_bytes()))
    }

    /// Steps over `count` strings: a line each in ascii; length-prefixed in binary.
    pub(super) fn skip_strings(&mut self, count: usize) -> Result<()> {
        self.line();
        for i in 0..count {
            let left = self.bytes.len() - self.at;
            if left == 0 {
                return Err(self.fail(format!("the file ends after {i} of {count} strings")));
            }
            if !self.binary {
                self.line();
                continue;
            }
            // The first byte's upper two bits tell how many bytes the length has.
            let size = 8 >> (self.bytes[self.at] >> 6);
            let prefix = self.bytes.get(self.at..self.at + size).unwrap_or_default();
            let length = prefix.iter().fold(0_u64, |n, b| n << 8 | u64::from(*b)) & (u64::MAX >> (64 - 8 * size + 2));
            let end = usize::try_from(length).ok().and_then(|length| size.checked_add(length));
            let end = end.filter(|end| *end <= left && !prefix.is_empty());
            self.at += end.ok_or_else(|| self.fail(format!("string {i} is longer than the {left} bytes left")))?;
        }
        Ok(())
    }
}

/// A word as messages show it: garbled files have words of megabytes.
pub(super) fn shown(word: &str) -> String {
    word.chars().take(40).collect()
}
