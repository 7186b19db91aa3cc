//! An array's bytes: appended raw, appended base64 or inline base64, compressed or not.

use std::borrow::Cow;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::blocks::{BlockTable, Compressor};

/// How binary arrays are laid out in a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub(super) big_endian: bool,
    /// Bytes of a number in the headers of arrays: 4 or 8.
    pub(super) header: usize,
    pub(super) compressor: Option<Compressor>,
}

impl Layout {
    /// The bytes of an array whose header is at the start of `data`, which goes on to the end of the file.
    pub(super) fn raw<'a>(&self, data: &'a [u8]) -> Result<Cow<'a, [u8]>, String> {
        let Some(compressor) = self.compressor else {
            let size = self.number(data, 0)?;
            let rest = &data[self.header..];
            return rest.get(..size).map(Cow::Borrowed).ok_or_else(|| beyond(size, rest.len()));
        };
        let count = self.number(data, 0)?;
        let table_size = self.table_size(count, data.len())?;
        let table = self.table(&data[..table_size], count)?;
        let rest = &data[table_size..];
        let size = table.compressed_total().unwrap_or(usize::MAX);
        let blocks = rest.get(..size).ok_or_else(|| beyond(size, rest.len()))?;
        table.decompress(blocks, compressor).map(Cow::Owned)
    }

    /// The same from base64 text. VTK encodes header and data of an uncompressed array as one, other writers apart;
    /// a compressed array's header is always apart.
    pub(super) fn base64(&self, text: &[u8]) -> Result<Vec<u8>, String> {
        let text = text.trim_ascii();
        let tight: Vec<u8>;
        let text = if text.iter().any(u8::is_ascii_whitespace) {
            tight = text.iter().copied().filter(|c| !c.is_ascii_whitespace()).collect();
            &tight
        } else {
            text
        };
        self.base64_tight(text)
    }

    /// The same from text without white space, which may go on behind the array.
    pub(super) fn base64_tight(&self, text: &[u8]) -> Result<Vec<u8>, String> {
        match self.compressor {
            None => self.base64_plain(text),
            Some(compressor) => self.base64_compressed(text, compressor),
        }
    }

    fn base64_plain(&self, text: &[u8]) -> Result<Vec<u8>, String> {
        let head = decode(text, self.header)?;
        let size = self.number(&head, 0)?;
        let head_chars = chars(self.header);
        let apart = text.get(head_chars - 1) == Some(&b'=') && text.len() > head_chars;
        if apart {
            return decode(&text[head_chars..], size);
        }
        let total = size.checked_add(self.header).ok_or_else(|| beyond(size, text.len() / 4 * 3))?;
        let mut bytes = decode(text, total)?;
        bytes.drain(..self.header);
        Ok(bytes)
    }

    fn base64_compressed(&self, text: &[u8], compressor: Compressor) -> Result<Vec<u8>, String> {
        let count = self.number(&decode(text, self.header)?, 0)?;
        let table_size = self.table_size(count, text.len())?;
        let table = self.table(&decode(text, table_size)?, count)?;
        let size = table.compressed_total().unwrap_or(usize::MAX);
        let rest = text.get(chars(table_size)..).unwrap_or_default();
        let blocks = if size == 0 { Vec::new() } else { decode(rest, size)? };
        table.decompress(&blocks, compressor)
    }

    /// Bytes of the table of `count` blocks, which must fit in `available` bytes.
    fn table_size(&self, count: usize, available: usize) -> Result<usize, String> {
        if count == 0 {
            return Ok(self.header);
        }
        let size = count.checked_add(3).and_then(|n| n.checked_mul(self.header)).unwrap_or(usize::MAX);
        if size > available {
            return Err(format!(
                "its header announces {count} compressed blocks where {available} bytes are left: the file is cut \
                 off, or its byte_order or header_type is wrong"
            ));
        }
        Ok(size)
    }

    fn table(&self, bytes: &[u8], count: usize) -> Result<BlockTable, String> {
        if count == 0 {
            return Ok(BlockTable { block_size: 0, last_size: 0, compressed_sizes: Vec::new() });
        }
        let compressed_sizes: Result<_, String> = (0..count).map(|i| self.number(bytes, 3 + i)).collect();
        let table = BlockTable {
            block_size: self.number(bytes, 1)?,
            last_size: self.number(bytes, 2)?,
            compressed_sizes: compressed_sizes?,
        };
        if table.last_size > table.block_size || table.total().is_none() {
            return Err(format!(
                "its header announces {count} blocks of {} bytes, the last of {}: the file is damaged, or its \
                 byte_order or header_type is wrong",
                table.block_size, table.last_size
            ));
        }
        Ok(table)
    }

    /// Number `i` of a header.
    fn number(&self, bytes: &[u8], i: usize) -> Result<usize, String> {
        let cut = || "the file ends before its header".to_owned();
        let bytes = bytes.get(i * self.header..(i + 1) * self.header).ok_or_else(cut)?;
        let add = |sum: u64, b: &u8| (sum << 8) | u64::from(*b);
        let value = if self.big_endian { bytes.iter().fold(0, add) } else { bytes.iter().rev().fold(0, add) };
        usize::try_from(value).map_err(|_| format!("its header says {value}"))
    }
}

fn beyond(size: usize, left: usize) -> String {
    format!(
        "its header announces {size} bytes where {left} are left: the file is cut off, or its byte_order or \
         header_type is wrong"
    )
}

/// Base64 characters of `bytes` bytes, padding included.
const fn chars(bytes: usize) -> usize {
    bytes.div_ceil(3).saturating_mul(4)
}

/// Decodes the first `size` bytes of base64 text that has no white space.
fn decode(text: &[u8], size: usize) -> Result<Vec<u8>, String> {
    let needed = chars(size);
    let text = text.get(..needed).ok_or_else(|| beyond(size, text.len() / 4 * 3))?;
    let mut bytes = STANDARD.decode(text).map_err(|e| format!("bad base64: {e}"))?;
    if bytes.len() < size {
        return Err(beyond(size, bytes.len()));
    }
    bytes.truncate(size);
    Ok(bytes)
}
