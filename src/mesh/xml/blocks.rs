//! Decompression of the blocks into which VTK cuts a compressed array.
//!
//! Nothing is allocated on the word of a header alone: a block's declared size is held against what its compressed
//! bytes could yield at best, and memory grows as blocks are done.

use std::io::Read;

use rayon::prelude::*;

/// Blocks decompressed at a time: enough for all cores, and little memory beyond the result.
const BATCH: usize = 256;

/// How blocks are compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compressor {
    Zlib,
    Lz4,
    Lzma,
}

impl Compressor {
    /// From VTK's class name in the attribute `compressor`.
    pub(super) fn from_name(name: &str) -> Option<Self> {
        match name {
            "vtkZLibDataCompressor" => Some(Self::Zlib),
            "vtkLZ4DataCompressor" => Some(Self::Lz4),
            "vtkLZMADataCompressor" => Some(Self::Lzma),
            _ => None,
        }
    }

    /// No compressed byte can yield more than this: 258 bytes from 2 bits (deflate), 255 from a length byte (LZ4);
    /// for LZMA twice the 7089 that `xz` reaches on zeros.
    const fn greatest_ratio(self) -> usize {
        match self {
            Self::Zlib => 1040,
            Self::Lz4 => 256,
            Self::Lzma => 16384,
        }
    }
}

/// The head of a compressed array: sizes of the whole blocks, of the last one and of each compressed block.
pub(super) struct BlockTable {
    pub(super) block_size: usize,
    /// 0 where the last block is a whole one.
    pub(super) last_size: usize,
    pub(super) compressed_sizes: Vec<usize>,
}

impl BlockTable {
    /// Bytes of all compressed blocks; `None` beyond what can be counted.
    pub(super) fn compressed_total(&self) -> Option<usize> {
        self.compressed_sizes.iter().try_fold(0_usize, |sum, &n| sum.checked_add(n))
    }

    /// Bytes of the array; `None` beyond what can be counted.
    pub(super) fn total(&self) -> Option<usize> {
        let Some(whole) = self.compressed_sizes.len().checked_sub(1) else { return Some(0) };
        self.block_size.checked_mul(whole)?.checked_add(self.size_of(whole))
    }

    /// Bytes of block `i`, decompressed.
    fn size_of(&self, i: usize) -> usize {
        if i + 1 == self.compressed_sizes.len() && self.last_size > 0 { self.last_size } else { self.block_size }
    }

    /// The array's bytes from its compressed blocks, which lie one after another in `bytes`.
    pub(super) fn decompress(&self, bytes: &[u8], compressor: Compressor) -> Result<Vec<u8>, String> {
        let mut out = Vec::new();
        let mut rest = bytes;
        let mut tasks = Vec::with_capacity(BATCH.min(self.compressed_sizes.len()));
        for (i, &compressed) in self.compressed_sizes.iter().enumerate() {
            let Some((block, after)) = rest.split_at_checked(compressed) else {
                return Err(format!("compressed block {i} is cut off: {compressed} bytes, {} left", rest.len()));
            };
            rest = after;
            tasks.push((i, block));
            if tasks.len() == BATCH || i + 1 == self.compressed_sizes.len() {
                let tried: Vec<Result<Vec<u8>, String>> =
                    tasks.par_drain(..).map(|(i, block)| self.block(i, block, compressor)).collect();
                // In order: of several bad blocks the first is named.
                let done = tried.into_iter().collect::<Result<Vec<_>, _>>()?;
                let more = done.iter().map(Vec::len).sum();
                out.try_reserve(more).map_err(|_| format!("no memory for {more} more bytes"))?;
                done.iter().for_each(|block| out.extend_from_slice(block));
            }
        }
        Ok(out)
    }

    fn block(&self, i: usize, compressed: &[u8], compressor: Compressor) -> Result<Vec<u8>, String> {
        let size = self.size_of(i);
        if size / compressor.greatest_ratio() > compressed.len() {
            return Err(format!(
                "compressed block {i} claims {size} bytes, which its {} bytes cannot yield",
                compressed.len()
            ));
        }
        let block = match compressor {
            Compressor::Zlib => zlib(compressed, size),
            Compressor::Lz4 => lz4(compressed, size),
            Compressor::Lzma => lzma(compressed, size),
        };
        let block = block.map_err(|e| format!("compressed block {i} cannot be decompressed ({e})"))?;
        if block.len() != size {
            return Err(format!("compressed block {i} yields {} bytes instead of {size}", block.len()));
        }
        Ok(block)
    }
}

fn zlib(compressed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let mut out = Vec::with_capacity(size + 1);
    // One byte more than wanted, so that the stream's end and checksum are reached, and an excess is seen.
    let limit = size as u64 + 1;
    flate2::read::ZlibDecoder::new(compressed).take(limit).read_to_end(&mut out).map_err(|e| e.to_string())?;
    Ok(out)
}

fn lz4(compressed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let mut out = vec![0; size];
    let done = lz4_flex::block::decompress_into(compressed, &mut out).map_err(|e| e.to_string())?;
    out.truncate(done);
    Ok(out)
}

fn lzma(compressed: &[u8], size: usize) -> Result<Vec<u8>, String> {
    // The decoder holds all output until the end and knows no limit: what the chunks announce is checked first.
    match xz_size(compressed) {
        Some(announced) if announced <= size => {}
        Some(announced) => return Err(format!("{announced} bytes in a block of {size}")),
        None => return Err("not an xz stream of one block".into()),
    }
    let mut out = Vec::with_capacity(size);
    lzma_rs::xz_decompress(&mut &compressed[..], &mut out).map_err(|e| format!("{e:?}"))?;
    Ok(out)
}

/// What the LZMA2 chunks of an xz stream of one block say they hold, decompressed (the .xz file format, 1.2.1, and
/// the chunk headers of LZMA2).
fn xz_size(stream: &[u8]) -> Option<usize> {
    const STREAM_HEADER: usize = 12;
    let mut rest = stream.strip_prefix(b"\xfd7zXZ\0").and(stream.get(STREAM_HEADER..))?;
    let header_size = match *rest.first()? {
        0 => return Some(0),
        n => (usize::from(n) + 1) * 4,
    };
    rest = rest.get(header_size..)?;
    let mut total = 0_usize;
    let start = rest.len();
    loop {
        let control = *rest.first()?;
        let number = |at: usize| Some(usize::from(u16::from_be_bytes(*rest.get(at..)?.first_chunk()?)) + 1);
        let chunk = match control {
            0 => break,
            1 | 2 => {
                total = total.checked_add(number(1)?)?;
                3 + number(1)?
            }
            0x80.. => {
                total = total.checked_add((usize::from(control & 0x1f) << 16) + number(1)?)?;
                (if control >= 0xc0 { 6 } else { 5 }) + number(3)?
            }
            _ => return None,
        };
        rest = rest.get(chunk..)?;
    }
    rest = rest.get(1..)?;
    // Padding to four bytes, the check (its size by its kind), then the index, which begins with 0.
    let padding = (4 - (start - rest.len()) % 4) % 4;
    let check = match stream.get(7)? & 0x0f {
        0 => 0,
        1..=3 => 4,
        4..=6 => 8,
        7..=9 => 16,
        10..=12 => 32,
        _ => 64,
    };
    (*rest.get(padding + check)? == 0).then_some(total)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn announced_sizes_of_xz_streams_are_found_and_held_to() {
        let data: Vec<u8> = (0..200_000_u32).map(|i| (i % 251) as u8).collect();
        let mut stream = Vec::new();
        lzma_rs::xz_compress(&mut &data[..], &mut stream).unwrap();
        assert_eq!(xz_size(&stream), Some(data.len()));
        assert_eq!(lzma(&stream, data.len()).unwrap(), data);
        assert!(lzma(&stream, data.len() - 1).unwrap_err().contains("200000 bytes"));
        assert_eq!(xz_size(&stream[..stream.len() / 2]), None);
        let twice = [&stream[..], &stream[..]].concat();
        assert!(lzma(&twice, data.len()).is_err());
    }

    #[test]
    fn a_block_yields_what_it_claims_or_nothing() {
        let table = |size| BlockTable { block_size: size, last_size: 0, compressed_sizes: vec![5] };
        // LZ4: a token of four literals.
        let block = [0x40, 1, 2, 3, 4];
        assert_eq!(table(4).decompress(&block, Compressor::Lz4).unwrap(), [1, 2, 3, 4]);
        assert!(table(3).decompress(&block, Compressor::Lz4).is_err());
        assert!(table(5).decompress(&block, Compressor::Lz4).unwrap_err().contains("instead of 5"));
        assert!(table(4).decompress(&block[..4], Compressor::Lz4).unwrap_err().contains("cut off"));
        assert!(table(1 << 40).decompress(&block, Compressor::Lz4).unwrap_err().contains("cannot yield"));
    }
}
