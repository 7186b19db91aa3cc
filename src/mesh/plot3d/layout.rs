//! Where things lie in a PLOT3D binary, found by trying every variant of the format against the file's size.

use std::ops::Range;

use crate::mesh::sample_type::{Endian, SampleType};

/// Bytes after the data that are still taken for padding (`bluntfinq.bin` is padded to a multiple of 512).
const PADDING: usize = 4096;

/// What the file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// x, y, z and perhaps IBLANK.
    Grid,
    /// Four reference numbers, then density, momentum (3) and stagnation energy.
    Solution,
}

impl Content {
    const fn variables(self) -> usize {
        match self {
            Self::Grid => 3,
            Self::Solution => 5,
        }
    }
}

/// A block's size and place.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// Points along each axis, each at least 1.
    pub(super) dims: [usize; 3],
    /// Of the first variable.
    start: usize,
}

impl Block {
    /// Number of points.
    pub(super) fn count(&self) -> usize {
        self.dims.iter().product()
    }

    /// As `40x32x32`.
    pub(super) fn size(&self) -> String {
        self.dims.map(|n| n.to_string()).join("x")
    }
}

/// A variant of the format and the blocks' places in it.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    variant: Variant,
    /// At least one.
    pub(super) blocks: Vec<Block>,
    /// Bytes after the data.
    pub(super) padding: usize,
}

#[derive(Clone, Copy, Debug)]
struct Variant {
    content: Content,
    endian: Endian,
    /// Fortran's unformatted records: each begins and ends with its length in 4 bytes.
    records: bool,
    /// The file begins with the number of blocks.
    counted: bool,
    real: SampleType,
    iblank: bool,
}

impl Layout {
    /// The variant that fits `bytes` best.
    pub(super) fn find(bytes: &[u8], content: Content) -> Option<Self> {
        Variant::all(content).filter_map(|variant| variant.fit(bytes)).min_by_key(|layout| layout.doubt(bytes))
    }

    /// The solution that belongs to `grid`: of its size, fitting best.
    pub(super) fn find_like(bytes: &[u8], grid: &Self) -> Option<Self> {
        Variant::all(Content::Solution)
            .filter_map(|variant| variant.fit(bytes))
            .filter(|layout| layout.blocks.iter().map(|b| b.dims).eq(grid.blocks.iter().map(|b| b.dims)))
            .min_by_key(|layout| layout.doubt(bytes))
    }

    /// Orders variants that fit: record marks are never there by chance; padding is zeros; the less of it the better.
    pub(super) fn doubt(&self, bytes: &[u8]) -> (bool, bool, usize) {
        let padding = &bytes[bytes.len() - self.padding..];
        (!self.variant.records, padding.iter().any(|b| *b != 0), self.padding)
    }

    /// Values of the block's variable `index`.
    pub(super) fn variable(&self, block: &Block, index: usize, bytes: &[u8]) -> Vec<f64> {
        let size = block.count() * self.variant.real.size();
        let start = block.start + index * size;
        self.variant.real.widen(&bytes[start..start + size], self.variant.endian)
    }

    /// The block's IBLANK; empty where the file has none.
    pub(super) fn iblank(&self, block: &Block, bytes: &[u8]) -> Vec<f64> {
        if !self.variant.iblank {
            return Vec::new();
        }
        let start = block.start + 3 * block.count() * self.variant.real.size();
        SampleType::I32.widen(&bytes[start..start + 4 * block.count()], self.variant.endian)
    }
}

impl Variant {
    fn all(content: Content) -> impl Iterator<Item = Self> {
        (0..32_u8).map(move |bits| bits_of(bits, content)).filter(move |v| content == Content::Grid || !v.iblank)
    }

    /// The layout of `bytes` in this variant, or `None` where they cannot be it.
    fn fit(self, bytes: &[u8]) -> Option<Layout> {
        let mut cursor = Cursor { variant: self, bytes, at: 0 };
        let count = if self.counted { cursor.header(1)?[0] } else { 1 };
        let dims = cursor.header(count.checked_mul(3)?)?;
        let mut blocks = Vec::with_capacity(count);
        for dims in dims.as_chunks::<3>().0 {
            let points = dims.iter().try_fold(1_usize, |n, d| n.checked_mul(*d))?;
            // Node numbers are u32.
            u32::try_from(points).ok()?;
            if self.content == Content::Solution {
                cursor.record(4 * self.real.size())?;
            }
            let reals = points.checked_mul(self.content.variables() * self.real.size())?;
            let blanks = if self.iblank { points.checked_mul(4)? } else { 0 };
            let data = cursor.record(reals.checked_add(blanks)?)?;
            blocks.push(Block { dims: *dims, start: data.start });
        }
        let padding = bytes.len() - cursor.at;
        (!blocks.is_empty() && padding < PADDING).then_some(Layout { variant: self, blocks, padding })
    }
}

fn bits_of(bits: u8, content: Content) -> Variant {
    let bit = |i: u8| bits >> i & 1 == 1;
    Variant {
        content,
        endian: if bit(0) { Endian::Little } else { Endian::Big },
        records: bit(1),
        counted: bit(2),
        real: if bit(3) { SampleType::F64 } else { SampleType::F32 },
        iblank: bit(4),
    }
}

/// Steps through records.
struct Cursor<'a> {
    variant: Variant,
    bytes: &'a [u8],
    at: usize,
}

impl Cursor<'_> {
    /// A record of `size` bytes: its place, or `None` past the end or where the record marks differ from `size`.
    fn record(&mut self, size: usize) -> Option<Range<usize>> {
        self.mark(size)?;
        let start = self.at;
        let end = start.checked_add(size).filter(|end| *end <= self.bytes.len())?;
        self.at = end;
        self.mark(size)?;
        Some(start..end)
    }

    fn mark(&mut self, size: usize) -> Option<()> {
        if self.variant.records {
            let mark = self.bytes.get(self.at..self.at.checked_add(4)?)?;
            let value = SampleType::U32.widen(mark, self.variant.endian)[0];
            // Records beyond 4 GiB are split by Fortran: not read.
            if value != size as f64 {
                return None;
            }
            self.at += 4;
        }
        Some(())
    }

    /// A record of `count` positive integers.
    fn header(&mut self, count: usize) -> Option<Vec<usize>> {
        let place = self.record(count.checked_mul(4)?)?;
        let numbers = SampleType::I32.widen(&self.bytes[place], self.variant.endian);
        numbers.iter().all(|n| *n >= 1.0).then(|| numbers.iter().map(|n| *n as usize).collect())
    }
}
