//! Arrays as XML elements: what they are called, where their values lie, and how they are read.

use std::borrow::Cow;
use std::collections::HashSet;

use roxmltree::Node;

use super::document::{Document, child};
use super::number::{Number, Numbers};
use crate::error::{Error, Result};
use crate::mesh::notes::Notes;
use crate::mesh::{ArrayInfo, Association};

/// An array of numbers, not yet read.
#[derive(Clone)]
pub(super) struct Array<'a> {
    pub(super) name: String,
    pub(super) components: usize,
    number: Number,
    place: Place<'a>,
    /// Of the element in the XML text.
    byte: usize,
}

#[derive(Clone)]
enum Place<'a> {
    Ascii(&'a str),
    Base64(&'a str),
    Appended(usize),
}

impl<'a> Array<'a> {
    /// From a `DataArray` element; `None` where it does not hold numbers.
    fn new(document: &Document<'_>, node: Node<'a, '_>, unnamed: &str) -> Result<Option<Self>> {
        let kind = document.attribute(node, "type")?;
        let number = match (Number::from_name(kind), kind) {
            (Some(number), _) => number,
            (None, "String" | "Bit") => return Ok(None),
            (None, _) => {
                let line = document.line(node.range().start);
                return Err(document.malformed(format!("line {line}: unknown type `{kind}` of values")));
            }
        };
        let text = || {
            let texts = node.children().filter(Node::is_text).filter_map(|n| n.text());
            texts.map(str::trim_ascii).find(|t| !t.is_empty()).unwrap_or_default()
        };
        let place = match node.attribute("format").unwrap_or("ascii") {
            "ascii" => Place::Ascii(text()),
            "binary" => Place::Base64(text()),
            "appended" => Place::Appended(document.count(node, "offset")?),
            other => {
                let line = document.line(node.range().start);
                let known = "known are ascii, binary and appended";
                return Err(document.malformed(format!("line {line}: array format `{other}`: {known}")));
            }
        };
        let components = match node.attribute("NumberOfComponents") {
            None => 1,
            // VTK writes 0 for an array without tuples.
            Some(_) => document.count(node, "NumberOfComponents")?.max(1),
        };
        let name = node.attribute("Name").unwrap_or(unnamed).to_owned();
        Ok(Some(Self { name, components, number, place, byte: node.range().start }))
    }

    /// Reads `tuples` tuples.
    pub(super) fn read(&self, document: &Document<'a>, tuples: usize) -> Result<Numbers<'a>> {
        let numbers = self.read_any(document)?;
        let wanted = tuples.checked_mul(self.components);
        if wanted != Some(numbers.len()) {
            let what = format!(
                "it holds {} values where {tuples} tuples of {} component(s) are expected",
                numbers.len(),
                self.components
            );
            return Err(self.error(document, &what));
        }
        Ok(numbers)
    }

    /// Reads as many values as there are.
    pub(super) fn read_any(&self, document: &Document<'a>) -> Result<Numbers<'a>> {
        let bytes = match self.place {
            Place::Ascii(text) => {
                let bytes = ascii(text).map_err(|what| self.error(document, &what))?;
                return Ok(Numbers::new(Cow::Owned(bytes), Number::F64, false));
            }
            Place::Base64("") => Ok(Cow::Borrowed(&[][..])),
            Place::Base64(text) => document.layout.base64(text.as_bytes()).map(Cow::Owned),
            Place::Appended(offset) => match document.appended.get(offset..) {
                None => Err(format!("its offset {offset} lies beyond the end of the file")),
                Some(text) if document.appended_is_text => document.layout.base64_tight(text).map(Cow::Owned),
                Some(data) => document.layout.raw(data),
            },
        };
        let bytes = bytes.map_err(|what| self.error(document, &what))?;
        if bytes.len() % self.number.size() != 0 {
            let what = format!("its {} bytes are no whole number of values", bytes.len());
            return Err(self.error(document, &what));
        }
        Ok(Numbers::new(bytes, self.number, document.layout.big_endian))
    }

    /// An error about this array.
    pub(super) fn error(&self, document: &Document<'_>, what: &str) -> Error {
        document.malformed(format!("array `{}` (line {}): {what}", self.name, document.line(self.byte)))
    }

    /// How it is offered to the user.
    pub(super) fn info(&self, association: Association) -> ArrayInfo {
        ArrayInfo { name: self.name.clone(), association, components: self.components }
    }
}

/// Numbers of any type from text, as the bytes of little-endian f64.
fn ascii(text: &str) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    for (i, word) in text.split_ascii_whitespace().enumerate() {
        // Some writers decorate: "-nan(ind)".
        let plain = if word.trim_start_matches('-').starts_with("nan") { "nan" } else { word };
        let value: f64 = plain.parse().map_err(|_| format!("value {i} is `{}`, not a number", shorten(word)))?;
        bytes.extend_from_slice(&value.to_le_bytes());
    }
    Ok(bytes)
}

fn shorten(word: &str) -> String {
    word.chars().take(40).collect()
}

/// The arrays of numbers in the child element `section` (`PointData`, `Points`, ...) of a piece. What holds no numbers
/// is noted.
pub(super) fn section<'a>(
    document: &'a Document<'a>,
    piece: Node<'a, '_>,
    section: &str,
    notes: &mut Notes,
) -> Result<Vec<Array<'a>>> {
    let mut arrays: Vec<Array<'a>> = Vec::new();
    let mut names = HashSet::new();
    let Some(parent) = child(piece, section) else { return Ok(arrays) };
    let (mut other, mut repeated) = (0, 0);
    for node in parent.children().filter(Node::is_element) {
        match node.tag_name().name() {
            "DataArray" | "PDataArray" => {}
            "Array" | "PArray" => {
                other += 1;
                continue;
            }
            _ => continue,
        }
        let unnamed = format!("{section} {}", arrays.len());
        match Array::new(document, node, &unnamed)? {
            None => other += 1,
            Some(array) if !names.insert(array.name.clone()) => repeated += 1,
            Some(array) => arrays.push(array),
        }
    }
    notes.count("arrays of strings or bits skipped", other);
    notes.count("arrays whose name another array of the same kind has skipped", repeated);
    Ok(arrays)
}
