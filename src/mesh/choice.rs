//! Which of the arrays that a file offers are read.

use super::{ArrayChoice, ArrayInfo, Association};
use crate::error::{Error, Result};

/// Arrays that number points or cells: offered, and not taken for a field by default.
const NUMBERINGS: [&str; 5] =
    ["GlobalNodeIds", "GlobalElementIds", "GlobalPointIds", "GlobalCellIds", "vtkOriginalPointIds"];

impl ArrayChoice {
    /// Indices into `available` of the arrays to read.
    ///
    /// # Errors
    ///
    /// [`Error::Asked`] where the named array is not offered (the message lists those that are), [`Error::Mesh`] where
    /// any would do and there is none.
    pub fn select(&self, available: &[ArrayInfo]) -> Result<Vec<usize>> {
        match self {
            Self::All => Ok((0..available.len()).collect()),
            Self::One(Some(name)) => {
                let base = name.rsplit_once(':').map(|(base, _)| base);
                let found = position(available, name).or_else(|| base.and_then(|base| position(available, base)));
                found.map(|i| vec![i]).ok_or_else(|| absent(name, available))
            }
            Self::One(None) => {
                let first = |association| {
                    available
                        .iter()
                        .position(|a| a.association == association && !NUMBERINGS.contains(&a.name.as_str()))
                };
                let index = first(Association::Point).or_else(|| first(Association::Cell));
                index
                    .map(|i| vec![i])
                    .ok_or_else(|| Error::Mesh("the file has no numeric point or cell array to render".into()))
            }
        }
    }
}

/// The array of this name; a point array where both kinds have one.
fn position(available: &[ArrayInfo], name: &str) -> Option<usize> {
    let of = |association| available.iter().position(|a| a.name == name && a.association == association);
    of(Association::Point).or_else(|| of(Association::Cell))
}

fn absent(name: &str, available: &[ArrayInfo]) -> Error {
    if available.is_empty() {
        return Error::Asked(format!("there is no array `{name}`: the file has no numeric arrays"));
    }
    let describe = |a: &ArrayInfo| {
        let place = match a.association {
            Association::Point => "point",
            Association::Cell => "cell",
        };
        match a.components {
            1 => format!("`{}` ({place})", a.name),
            n => format!("`{}` ({place}, {n} components)", a.name),
        }
    };
    let list: Vec<String> = available.iter().map(describe).collect();
    Error::Asked(format!("there is no array `{name}`; the file has {}", list.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_field_is_a_point_array_that_numbers_nothing() {
        let info = |name: &str, association| ArrayInfo { name: name.into(), association, components: 1 };
        let cell = info("pressure", Association::Cell);
        let ids = info("GlobalNodeIds", Association::Point);
        let point = info("a:b", Association::Point);
        let select = |choice: ArrayChoice, available: &[ArrayInfo]| choice.select(available).ok();
        let all = [cell, ids, point];
        assert_eq!(select(ArrayChoice::One(None), &all), Some(vec![2]));
        assert_eq!(select(ArrayChoice::One(None), &all[..2]), Some(vec![0]));
        assert_eq!(select(ArrayChoice::One(None), &all[1..2]), None);
        assert_eq!(select(ArrayChoice::All, &all), Some(vec![0, 1, 2]));
        for (name, found) in [("a:b", Some(2)), ("a:b:mag", Some(2)), ("a", None), ("pressure:0", Some(0))] {
            assert_eq!(select(ArrayChoice::One(Some(name.into())), &all), found.map(|i| vec![i]), "{name}");
        }
    }
}
