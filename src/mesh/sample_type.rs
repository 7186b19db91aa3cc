//! Numbers as files store them, widened to f64.

/// Order of a number's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Endian {
    /// Least significant byte first.
    Little,
    /// Most significant byte first.
    Big,
}

/// A stored number's type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SampleType {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F32,
    F64,
}

impl SampleType {
    /// Bytes of a number.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }

    /// A name as `u8`, `int16`, `float32`.
    pub(super) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "u8" | "uint8" => Self::U8,
            "i8" | "int8" => Self::I8,
            "u16" | "uint16" => Self::U16,
            "i16" | "int16" => Self::I16,
            "u32" | "uint32" => Self::U32,
            "i32" | "int32" => Self::I32,
            "u64" | "uint64" => Self::U64,
            "i64" | "int64" => Self::I64,
            "f32" | "float32" => Self::F32,
            "f64" | "float64" => Self::F64,
            _ => return None,
        })
    }

    /// All whole numbers in `bytes`, as f64 (64-bit integers beyond 2^53 are rounded).
    pub(super) fn widen(self, bytes: &[u8], endian: Endian) -> Vec<f64> {
        match self {
            Self::U8 => bytes.iter().map(|b| f64::from(*b)).collect(),
            Self::I8 => bytes.iter().map(|b| f64::from(*b as i8)).collect(),
            Self::U16 => numbers(bytes, endian, |b| f64::from(u16::from_le_bytes(b))),
            Self::I16 => numbers(bytes, endian, |b| f64::from(i16::from_le_bytes(b))),
            Self::U32 => numbers(bytes, endian, |b| f64::from(u32::from_le_bytes(b))),
            Self::I32 => numbers(bytes, endian, |b| f64::from(i32::from_le_bytes(b))),
            Self::U64 => numbers(bytes, endian, |b| u64::from_le_bytes(b) as f64),
            Self::I64 => numbers(bytes, endian, |b| i64::from_le_bytes(b) as f64),
            Self::F32 => numbers(bytes, endian, |b| f64::from(f32::from_le_bytes(b))),
            Self::F64 => numbers(bytes, endian, f64::from_le_bytes),
        }
    }
}

fn numbers<const N: usize>(bytes: &[u8], endian: Endian, from_le: impl Fn([u8; N]) -> f64) -> Vec<f64> {
    let (groups, _) = bytes.as_chunks::<N>();
    match endian {
        Endian::Little => groups.iter().map(|b| from_le(*b)).collect(),
        Endian::Big => groups
            .iter()
            .map(|b| {
                let mut b = *b;
                b.reverse();
                from_le(b)
            })
            .collect(),
    }
}
