//! Arrays of numbers as bytes of a file, and their conversion.

use std::borrow::Cow;

use rayon::prelude::*;

/// The type of an array's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl Number {
    /// From VTK's name in the attribute `type`.
    pub(super) fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "Int8" => Self::I8,
            "UInt8" => Self::U8,
            "Int16" => Self::I16,
            "UInt16" => Self::U16,
            "Int32" => Self::I32,
            "UInt32" => Self::U32,
            "Int64" => Self::I64,
            "UInt64" => Self::U64,
            "Float32" => Self::F32,
            "Float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes of one value.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }
}

/// Values as they lie in the file.
pub(super) struct Numbers<'a> {
    bytes: Cow<'a, [u8]>,
    number: Number,
    big_endian: bool,
}

impl<'a> Numbers<'a> {
    /// `bytes` holds a whole number of values.
    pub(super) fn new(bytes: Cow<'a, [u8]>, number: Number, big_endian: bool) -> Self {
        Self { bytes, number, big_endian }
    }

    /// No values.
    pub(super) fn none() -> Self {
        Self { bytes: Cow::Borrowed(&[]), number: Number::U8, big_endian: false }
    }

    /// Number of values.
    pub(super) fn len(&self) -> usize {
        self.bytes.len() / self.number.size()
    }

    /// The value at `i` as an index; `None` beyond the end and where it is negative or not a whole number.
    pub(super) fn index(&self, i: usize) -> Option<u64> {
        let big = self.big_endian;
        let at = i.checked_mul(self.number.size())?;
        let bytes = self.bytes.get(at..)?;
        macro_rules! integer {
            ($type:ty) => {{
                let value = *bytes.first_chunk()?;
                u64::try_from(if big { <$type>::from_be_bytes(value) } else { <$type>::from_le_bytes(value) }).ok()
            }};
        }
        match self.number {
            Number::I8 => integer!(i8),
            Number::U8 => integer!(u8),
            Number::I16 => integer!(i16),
            Number::U16 => integer!(u16),
            Number::I32 => integer!(i32),
            Number::U32 => integer!(u32),
            Number::I64 => integer!(i64),
            Number::U64 => integer!(u64),
            Number::F32 | Number::F64 => {
                let value = self.float(bytes)?;
                // Exact below 2^53; beyond that no file has so many points.
                ((0.0..=9.0e15).contains(&value) && value.fract() == 0.0).then_some(value as u64)
            }
        }
    }

    fn float(&self, bytes: &[u8]) -> Option<f64> {
        Some(match (self.number, self.big_endian) {
            (Number::F32, false) => f32::from_le_bytes(*bytes.first_chunk()?).into(),
            (Number::F32, true) => f32::from_be_bytes(*bytes.first_chunk()?).into(),
            (_, false) => f64::from_le_bytes(*bytes.first_chunk()?),
            (_, true) => f64::from_be_bytes(*bytes.first_chunk()?),
        })
    }

    /// All values, widened (64-bit integers beyond 2^53 are rounded).
    pub(super) fn to_f64(&self) -> Vec<f64> {
        macro_rules! widen {
            ($type:ty) => {
                if self.big_endian {
                    widen(&self.bytes, |b| <$type>::from_be_bytes(b) as f64)
                } else {
                    widen(&self.bytes, |b| <$type>::from_le_bytes(b) as f64)
                }
            };
        }
        match self.number {
            Number::I8 => widen!(i8),
            Number::U8 => widen!(u8),
            Number::I16 => widen!(i16),
            Number::U16 => widen!(u16),
            Number::I32 => widen!(i32),
            Number::U32 => widen!(u32),
            Number::I64 => widen!(i64),
            Number::U64 => widen!(u64),
            Number::F32 => widen!(f32),
            Number::F64 => widen!(f64),
        }
    }
}

fn widen<const N: usize>(bytes: &[u8], from_bytes: impl Fn([u8; N]) -> f64 + Sync) -> Vec<f64> {
    bytes.as_chunks::<N>().0.par_iter().map(|b| from_bytes(*b)).collect()
}
