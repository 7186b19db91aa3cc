//! A VTK XML file: the XML itself, and the block of binary data that may be appended to it.
//!
//! Only the text before the appended block is parsed, closed artificially, so that the block is never copied.

use std::borrow::Cow;
use std::path::Path;

use memmap2::Mmap;
use roxmltree::Node;

use super::blocks::Compressor;
use super::payload::Layout;
use crate::error::{Error, Result};
use crate::mesh::file;

const APPENDED: &[u8] = b"<AppendedData";

/// A mapped file.
pub(super) struct Source<'p> {
    pub(super) path: &'p Path,
    map: Mmap,
}

impl<'p> Source<'p> {
    pub(super) fn open(path: &'p Path) -> Result<Self> {
        Ok(Self { path, map: file::map(path)? })
    }

    /// Parts the text from the appended block.
    pub(super) fn head(&self) -> Result<Head<'_>> {
        let bytes: &[u8] = &self.map;
        let utf8 = |bytes| {
            std::str::from_utf8(bytes).map_err(|e| {
                let what = format!("byte {} of the XML text is not UTF-8", e.valid_up_to());
                Error::malformed(self.path, what)
            })
        };
        let Some(start) = find(bytes, APPENDED) else {
            return Ok(Head { path: self.path, text: Cow::Borrowed(utf8(bytes)?), appended: &[] });
        };
        let Some(length) = bytes[start..].iter().position(|&b| b == b'>') else {
            return Err(Error::malformed(self.path, "the tag <AppendedData> is cut off"));
        };
        let (head, rest) = bytes.split_at(start + length);
        let mut text = utf8(head)?.trim_end_matches('/').to_owned();
        text.push_str("/></VTKFile>");
        let blob = rest[1..].trim_ascii_start();
        let appended = blob.strip_prefix(b"_").unwrap_or(&[]);
        Ok(Head { path: self.path, text: Cow::Owned(text), appended })
    }
}

/// Position of `word` in `bytes`.
fn find(bytes: &[u8], word: &[u8]) -> Option<usize> {
    let mut from = 0;
    loop {
        from += bytes[from..].iter().position(|b| *b == word[0])?;
        if bytes[from..].starts_with(word) {
            return Some(from);
        }
        from += 1;
    }
}

/// The text of a file, and its appended block from behind the underscore.
pub(super) struct Head<'a> {
    path: &'a Path,
    text: Cow<'a, str>,
    appended: &'a [u8],
}

/// A parsed file.
pub(super) struct Document<'a> {
    pub(super) path: &'a Path,
    xml: roxmltree::Document<'a>,
    /// How binary arrays are laid out.
    pub(super) layout: Layout,
    /// The appended block; empty where there is none.
    pub(super) appended: &'a [u8],
    /// Whether the appended block is base64 text.
    pub(super) appended_is_text: bool,
}

impl<'a> Document<'a> {
    pub(super) fn parse(head: &'a Head<'a>) -> Result<Self> {
        let path = head.path;
        let xml = roxmltree::Document::parse(&head.text)
            .map_err(|e| Error::malformed(path, format!("not valid XML: {e}")))?;
        let root = xml.root_element();
        if root.tag_name().name() != "VTKFile" {
            let what = format!("the XML element <{}> is not <VTKFile>: not a VTK file", root.tag_name().name());
            return Err(Error::malformed(path, what));
        }
        let layout = layout(root).map_err(|what| Error::malformed(path, what))?;
        let encoding = child(root, "AppendedData").and_then(|n| n.attribute("encoding")).unwrap_or("raw");
        let appended_is_text = match encoding {
            "raw" => false,
            "base64" => true,
            other => {
                let what = format!("appended data in encoding `{other}`: known are raw and base64");
                return Err(Error::malformed(path, what));
            }
        };
        Ok(Self { path, layout, appended: head.appended, appended_is_text, xml })
    }

    /// What kind of data the file says it holds (`UnstructuredGrid`, `ImageData`, ...).
    pub(super) fn kind(&self) -> &str {
        self.xml.root_element().attribute("type").unwrap_or_default()
    }

    /// The element that is named as the file's kind.
    pub(super) fn grid(&self) -> Result<Node<'_, 'a>> {
        child(self.xml.root_element(), self.kind())
            .ok_or_else(|| self.malformed(format!("the element <{}> is missing", self.kind())))
    }

    /// An error in this file.
    pub(super) fn malformed(&self, what: impl Into<String>) -> Error {
        Error::malformed(self.path, what)
    }

    /// The line on which an element begins, from 1. Counts from the file's start: for error messages.
    pub(super) fn line(&self, byte: usize) -> u32 {
        self.xml.text_pos_at(byte).row
    }

    /// An attribute that must be there.
    pub(super) fn attribute<'n>(&self, node: Node<'n, '_>, name: &str) -> Result<&'n str> {
        node.attribute(name).ok_or_else(|| {
            let line = self.line(node.range().start);
            self.malformed(format!("line {line}: <{}> has no attribute `{name}`", node.tag_name().name()))
        })
    }

    /// An attribute that holds a count.
    pub(super) fn count(&self, node: Node<'_, '_>, name: &str) -> Result<usize> {
        let text = self.attribute(node, name)?;
        text.trim().parse().map_err(|_| {
            let line = self.line(node.range().start);
            self.malformed(format!("line {line}: {name}=\"{text}\" is not a count"))
        })
    }

    /// An attribute that holds `N` numbers; `None` where it is missing.
    pub(super) fn numbers<T: std::str::FromStr, const N: usize>(
        &self,
        node: Node<'_, '_>,
        name: &str,
    ) -> Result<Option<[T; N]>> {
        let Some(text) = node.attribute(name) else { return Ok(None) };
        let values: Option<Vec<T>> = text.split_ascii_whitespace().map(|word| word.parse().ok()).collect();
        values.and_then(|v| v.try_into().ok()).map(Some).ok_or_else(|| {
            let line = self.line(node.range().start);
            self.malformed(format!("line {line}: {name}=\"{text}\" is not a list of {N} numbers"))
        })
    }
}

/// The first child element of this name.
pub(super) fn child<'n, 'a>(node: Node<'n, 'a>, name: &str) -> Option<Node<'n, 'a>> {
    children(node, name).next()
}

/// All child elements of this name.
pub(super) fn children<'n, 'a: 'n>(node: Node<'n, 'a>, name: &str) -> impl Iterator<Item = Node<'n, 'a>> {
    node.children().filter(move |n| n.is_element() && n.tag_name().name() == name)
}

fn layout(root: Node<'_, '_>) -> Result<Layout, String> {
    let big_endian = match root.attribute("byte_order") {
        None | Some("LittleEndian") => false,
        Some("BigEndian") => true,
        Some(other) => return Err(format!("byte_order `{other}`: known are LittleEndian and BigEndian")),
    };
    let header = match root.attribute("header_type") {
        None | Some("UInt32") => 4,
        Some("UInt64") => 8,
        Some(other) => return Err(format!("header_type `{other}`: known are UInt32 and UInt64")),
    };
    let compressor = match root.attribute("compressor") {
        None | Some("") => None,
        Some(name) => Some(Compressor::from_name(name).ok_or_else(|| {
            format!("compressor `{name}`: known are vtkZLibDataCompressor, vtkLZ4DataCompressor, vtkLZMADataCompressor")
        })?),
    };
    Ok(Layout { big_endian, header, compressor })
}
