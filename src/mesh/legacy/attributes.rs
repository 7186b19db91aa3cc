//! The arrays of a legacy VTK file.

use super::cursor::{Block, Cursor};
use super::note;
use crate::error::Result;
use crate::mesh::{ArrayInfo, Association, ReadNote};

/// VTK's array of marks for cells and points that are copies or hidden.
const GHOSTS: &str = "vtkGhostType";

/// Arrays found, in the file's order.
#[derive(Default)]
pub(super) struct Attributes {
    /// What the arrays that follow belong to, and the tuples promised; `None` before the first such keyword.
    owner: Option<(Association, usize)>,
    /// As promised by the keywords, to be compared with the grid.
    promised: Vec<(Association, usize)>,
    found: Vec<(ArrayInfo, usize, Block)>,
}

impl Attributes {
    /// Reads what belongs to `keyword`, or returns false where it is not about arrays.
    pub(super) fn read(&mut self, keyword: &str, cursor: &mut Cursor) -> Result<bool> {
        match keyword {
            "POINT_DATA" | "CELL_DATA" => {
                let association = if keyword == "POINT_DATA" { Association::Point } else { Association::Cell };
                let tuples = cursor.number("a number of tuples")?;
                self.owner = Some((association, tuples));
                self.promised.push((association, tuples));
            }
            "SCALARS" => self.scalars(cursor)?,
            "VECTORS" | "NORMALS" => self.fixed(3, cursor)?,
            "TENSORS" => self.fixed(9, cursor)?,
            "TENSORS6" => self.fixed(6, cursor)?,
            "GLOBAL_IDS" | "PEDIGREE_IDS" | "EDGE_FLAGS" => self.fixed(1, cursor)?,
            "TEXTURE_COORDINATES" => {
                let name = cursor.need("an array's name")?;
                let components = cursor.number("a number of components")?;
                let kind = cursor.need("a number type")?;
                self.array(&name, components, &kind, cursor)?;
            }
            "COLOR_SCALARS" => {
                let name = cursor.need("an array's name")?;
                let components = cursor.number("a number of components")?;
                self.array(&name, components, color_type(cursor), cursor)?;
            }
            "LOOKUP_TABLE" => {
                cursor.need("a table's name")?;
                let colors: usize = cursor.number("a number of colours")?;
                cursor.block(colors.saturating_mul(4), color_type(cursor))?;
            }
            "FIELD" => self.field(cursor)?,
            "METADATA" => {
                cursor.line();
                while !cursor.line().is_empty() {}
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn scalars(&mut self, cursor: &mut Cursor) -> Result<()> {
        let name = cursor.need("an array's name")?;
        let kind = cursor.need("a number type")?;
        let rest = cursor.words_of_line();
        let components = match rest.first().map(|n| n.parse()) {
            None => 1,
            Some(Ok(n)) => n,
            Some(Err(_)) => return Err(cursor.fail(format!("{rest:?} where a number of components should be"))),
        };
        if !cursor.take("LOOKUP_TABLE") {
            return Err(cursor.fail(format!("the scalars {name:?} are not followed by LOOKUP_TABLE")));
        }
        cursor.need("a table's name")?;
        self.array(&name, components, &kind, cursor)
    }

    fn fixed(&mut self, components: usize, cursor: &mut Cursor) -> Result<()> {
        let name = cursor.need("an array's name")?;
        let kind = cursor.need("a number type")?;
        self.array(&name, components, &kind, cursor)
    }

    /// An array with as many tuples as its owner promised.
    fn array(&mut self, name: &str, components: usize, kind: &str, cursor: &mut Cursor) -> Result<()> {
        let Some((association, tuples)) = self.owner else {
            return Err(cursor.fail(format!("the array {name:?} stands before POINT_DATA and CELL_DATA")));
        };
        let block = sized_block(name, components, tuples, kind, cursor)?;
        self.found.push((ArrayInfo { name: decoded(name), association, components }, tuples, block));
        Ok(())
    }

    fn field(&mut self, cursor: &mut Cursor) -> Result<()> {
        cursor.need("a field's name")?;
        let arrays: usize = cursor.number("a number of arrays")?;
        for _ in 0..arrays {
            let name = cursor.need("an array's name")?;
            if name.eq_ignore_ascii_case("NULL_ARRAY") {
                continue;
            }
            // Metadata of the array before.
            if name.eq_ignore_ascii_case("METADATA") {
                cursor.line();
                while !cursor.line().is_empty() {}
                self.field_array(cursor.need("an array's name")?, cursor)?;
            } else {
                self.field_array(name, cursor)?;
            }
        }
        Ok(())
    }

    fn field_array(&mut self, name: String, cursor: &mut Cursor) -> Result<()> {
        let components: usize = cursor.number("a number of components")?;
        let tuples: usize = cursor.number("a number of tuples")?;
        let kind = cursor.need("a number type")?;
        if matches!(kind.to_ascii_lowercase().as_str(), "string" | "utf8_string") {
            return cursor.skip_strings(components.saturating_mul(tuples));
        }
        let block = sized_block(&name, components, tuples, &kind, cursor)?;
        // Arrays of the whole file (time, cycle) have no owner and are not fields.
        if let Some((association, _)) = self.owner {
            self.found.push((ArrayInfo { name: decoded(&name), association, components }, tuples, block));
        }
        Ok(())
    }

    /// The marks of `vtkGhostType`; empty where there are none.
    pub(super) fn ghosts(&self, association: Association, cursor: &Cursor) -> Result<Vec<u8>> {
        let is_ghosts =
            |info: &ArrayInfo| info.name == GHOSTS && info.association == association && info.components == 1;
        match self.found.iter().find(|(info, ..)| is_ghosts(info)) {
            Some((.., block)) => Ok(cursor.decode(block)?.iter().map(|v| *v as u8).collect()),
            None => Ok(Vec::new()),
        }
    }

    /// Drops what cannot be a field: ghost marks, arrays without components, arrays of another length than the grid's
    /// (noted).
    ///
    /// # Errors
    /// Where POINT_DATA or CELL_DATA promise another number than the grid has.
    pub(super) fn keep(
        &mut self,
        points: usize,
        cells: usize,
        cursor: &Cursor,
        notes: &mut Vec<ReadNote>,
    ) -> Result<()> {
        let have = |association| match association {
            Association::Point => (points, "points"),
            Association::Cell => (cells, "cells"),
        };
        for &(association, promised) in &self.promised {
            let (count, what) = have(association);
            if promised != count {
                return Err(cursor.fail(format!("the arrays are for {promised} {what}, and the grid has {count}")));
            }
        }
        self.found.retain(|(info, tuples, _)| {
            let fits = *tuples == have(info.association).0;
            if !fits {
                notes.push(note(
                    format!("Array {:?} was left out: it has another number of tuples", info.name),
                    *tuples,
                ));
            }
            fits && info.components > 0 && info.name != GHOSTS
        });
        Ok(())
    }

    /// What was found.
    pub(super) fn available(&self) -> Vec<ArrayInfo> {
        self.found.iter().map(|(info, ..)| info.clone()).collect()
    }

    /// The numbers of what was found, in the same order.
    pub(super) fn blocks(&self) -> impl Iterator<Item = &Block> {
        self.found.iter().map(|(.., block)| block)
    }
}

fn sized_block(name: &str, components: usize, tuples: usize, kind: &str, cursor: &mut Cursor) -> Result<Block> {
    let count = components.checked_mul(tuples);
    let count =
        count.ok_or_else(|| cursor.fail(format!("{components} times {tuples} values of {name:?} cannot be")))?;
    cursor.block(count, kind)
}

/// Colours are bytes in binary files and reals in ascii ones.
fn color_type(cursor: &Cursor) -> &'static str {
    if cursor.is_binary() { "unsigned_char" } else { "float" }
}

/// VTK writes blanks and other characters of names as `%20` and the like.
fn decoded(name: &str) -> String {
    let hex = |b: u8| (b as char).to_digit(16).map(|d| d as u8);
    let (bytes, mut out, mut i) = (name.as_bytes(), Vec::new(), 0);
    while i < bytes.len() {
        match bytes[i..] {
            [b'%', a, b, ..] if hex(a).is_some() && hex(b).is_some() => {
                out.push(hex(a).unwrap_or(0) << 4 | hex(b).unwrap_or(0));
                i += 3;
            }
            _ => {
                out.push(bytes[i]);
                i += 1;
            }
        }
    }
    String::from_utf8_lossy(&out).into_owned()
}

#[cfg(test)]
mod tests {
    #[test]
    fn names_are_decoded() {
        for (written, name) in [("a%20b", "a b"), ("100%", "100%"), ("%zz%2", "%zz%2"), ("%C3%A4", "ä"), ("", "")] {
            assert_eq!(super::decoded(written), name);
        }
    }
}
