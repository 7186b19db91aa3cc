//! Files as bytes: mapped into memory, so that only what is looked at is read.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use memmap2::Mmap;

use crate::error::{Error, Result};

/// Maps a file; an empty one and a folder are errors.
pub(super) fn map(path: &Path) -> Result<Mmap> {
    let file = open(path)?;
    #[expect(unsafe_code, reason = "a read-only map; another program cutting the file short meanwhile would end ours")]
    let map = unsafe { Mmap::map(&file) }.map_err(|e| Error::io(path, e))?;
    if map.is_empty() {
        return Err(Error::malformed(path, "the file is empty"));
    }
    Ok(map)
}

/// Whether the first character that is not white space is `<`, as in every XML file and in no other mesh format.
pub(super) fn begins_with_xml(path: &Path) -> Result<bool> {
    let mut start = [0_u8; 64];
    let mut length = 0;
    let mut file = open(path)?;
    while length < start.len() {
        match file.read(&mut start[length..]).map_err(|e| Error::io(path, e))? {
            0 => break,
            n => length += n,
        }
    }
    let text = &start[..length];
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    Ok(text.trim_ascii_start().first() == Some(&b'<'))
}

fn open(path: &Path) -> Result<File> {
    let file = File::open(path).map_err(|e| Error::io(path, e))?;
    if file.metadata().map_err(|e| Error::io(path, e))?.is_dir() {
        return Err(Error::io(path, std::io::ErrorKind::IsADirectory.into()));
    }
    Ok(file)
}
