//! Which array becomes the scalar field.

use super::cells::Cells;
use crate::error::{Error, Result};
use crate::mesh::{ArrayInfo, Association, DataArray};

/// The user's choice of a field.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FieldChoice {
    text: Option<String>,
}

/// What is taken of a tuple.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Part {
    Magnitude,
    Component(usize),
}

impl FieldChoice {
    /// A choice as typed: an array's name, or a name with `:mag` (Euclidean norm of the tuple), `:x`, `:y`, `:z`, or
    /// `:0`, `:1`, ... (a component). An array whose whole name is `text` comes first, so names may hold colons.
    ///
    /// [`FieldChoice::default`] is the first point array of one component, else the magnitude of the first point
    /// array, else the same of the cell arrays.
    pub fn parse(text: &str) -> Self {
        Self { text: Some(text.to_owned()) }
    }

    /// The text of the choice, for [`crate::mesh::ArrayChoice::One`].
    pub fn text(&self) -> Option<&str> {
        self.text.as_deref()
    }
}

/// A scalar at every point.
pub(super) struct Field {
    /// Name, with the part that was taken (`U:mag`).
    pub name: String,
    /// Per point; what is not finite makes its cells unusable.
    pub values: Vec<f64>,
    /// Per cell, true where a cell array has no finite value; empty where there is none such.
    pub unusable: Vec<bool>,
    /// What was guessed or computed.
    pub notes: Vec<String>,
}

impl Field {
    pub(super) fn select(
        arrays: Vec<DataArray>,
        available: &[ArrayInfo],
        choice: &FieldChoice,
        cells: &Cells<'_>,
        point_count: usize,
    ) -> Result<Self> {
        let (index, asked) = find(&arrays, available, choice)?;
        let Some(array) = arrays.into_iter().nth(index) else {
            return Err(Error::Mesh("the mesh has no arrays".into()));
        };
        let tuples = if array.association == Association::Point { point_count } else { cells.len() };
        if array.components == 0 || array.components.checked_mul(tuples) != Some(array.values.len()) {
            return Err(Error::Mesh(format!(
                "array {:?} holds {} values, and {tuples} tuples of {} were expected",
                array.name,
                array.values.len(),
                array.components
            )));
        }
        let mut notes = Vec::new();
        let (name, association) = (array.name.clone(), array.association);
        let (name, tuples) = match asked {
            None if array.components == 1 => (name, array.values),
            None => {
                notes.push(format!("{name:?} has {} components: its magnitude is taken", array.components));
                (format!("{name}:mag"), magnitudes(&array))
            }
            Some(Part::Magnitude) => (format!("{name}:mag"), magnitudes(&array)),
            Some(Part::Component(c)) => {
                let suffix = ["x", "y", "z"].get(c).map_or_else(|| c.to_string(), |&s| s.to_owned());
                let values = array.values.iter().copied().skip(c).step_by(array.components).collect();
                (format!("{name}:{suffix}"), values)
            }
        };
        let (values, unusable) = match association {
            Association::Point => (tuples, Vec::new()),
            Association::Cell => {
                notes.push(format!("{name:?} belongs to cells: each point takes the mean of the cells around it"));
                (point_means(&tuples, cells, point_count), unusable_cells(&tuples))
            }
        };
        Ok(Self { name, values, unusable, notes })
    }
}

/// The array's index and the part that was asked for.
fn find(arrays: &[DataArray], available: &[ArrayInfo], choice: &FieldChoice) -> Result<(usize, Option<Part>)> {
    let by = |test: &dyn Fn(&DataArray) -> bool| {
        let of = |association| arrays.iter().position(|a| a.association == association && test(a));
        of(Association::Point).or_else(|| of(Association::Cell))
    };
    let Some(text) = choice.text() else {
        let of = |association| {
            let one = arrays.iter().position(|a| a.association == association && a.components == 1);
            one.or_else(|| arrays.iter().position(|a| a.association == association))
        };
        let first = of(Association::Point).or_else(|| of(Association::Cell));
        return first.map(|i| (i, None)).ok_or_else(|| {
            Error::Mesh(format!("the mesh has no array that could be shown; {}", offered(arrays, available)))
        });
    };
    if let Some(i) = by(&|a| a.name == text) {
        return Ok((i, None));
    }
    if let Some((name, suffix)) = text.rsplit_once(':')
        && let Some(i) = by(&|a| a.name == name)
    {
        let part = match suffix {
            "mag" => Some(Part::Magnitude),
            "x" => Some(Part::Component(0)),
            "y" => Some(Part::Component(1)),
            "z" => Some(Part::Component(2)),
            _ => suffix.parse().ok().map(Part::Component),
        };
        let count = arrays[i].components;
        return match part {
            Some(part @ Part::Magnitude) => Ok((i, Some(part))),
            Some(part @ Part::Component(c)) if c < count => Ok((i, Some(part))),
            _ => Err(Error::Asked(format!(
                "field {text:?}: array {name:?} has {count} component{}; ask for {name}:mag, or for {name}:0 to {name}:{}",
                if count == 1 { "" } else { "s" },
                count.saturating_sub(1)
            ))),
        };
    }
    Err(Error::Asked(format!("there is no field {text:?}; {}", offered(arrays, available))))
}

/// What could be asked for instead.
fn offered(arrays: &[DataArray], available: &[ArrayInfo]) -> String {
    let read = arrays.iter().map(|a| (a.name.as_str(), a.association, a.components));
    let listed = available.iter().map(|a| (a.name.as_str(), a.association, a.components));
    let mut all: Vec<_> = listed.collect();
    for array in read {
        if !all.contains(&array) {
            all.push(array);
        }
    }
    if all.is_empty() {
        return "it offers no point or cell arrays at all".into();
    }
    let describe = |&(name, association, components): &(&str, Association, usize)| {
        let of = if association == Association::Point { "points" } else { "cells" };
        format!("{name:?} ({of}, {components} component{})", if components == 1 { "" } else { "s" })
    };
    format!("there is {}", all.iter().map(describe).collect::<Vec<_>>().join(", "))
}

/// Euclidean norms, scaled so that no square overflows.
fn magnitudes(array: &DataArray) -> Vec<f64> {
    let norm = |tuple: &[f64]| {
        let largest = tuple.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        match tuple.iter().any(|v| !v.is_finite()) {
            true => f64::NAN,
            false if largest == 0.0 => 0.0,
            false => largest * tuple.iter().map(|v| (v / largest).powi(2)).sum::<f64>().sqrt(),
        }
    };
    array.values.chunks_exact(array.components).map(norm).collect()
}

/// The plain mean of the finite values of the cells around each point (VTK's CellDataToPointData); NaN without any.
fn point_means(per_cell: &[f64], cells: &Cells<'_>, point_count: usize) -> Vec<f64> {
    let mut sums = vec![0.0; point_count];
    let mut counts = vec![0_u32; point_count];
    cells.for_each(|cell| {
        let value = per_cell[cell.index];
        if value.is_finite() {
            for &node in cell.nodes {
                sums[node as usize] += value;
                counts[node as usize] += 1;
            }
        }
    });
    sums.iter_mut().zip(&counts).for_each(|(sum, &count)| *sum /= f64::from(count));
    sums
}

fn unusable_cells(per_cell: &[f64]) -> Vec<bool> {
    if per_cell.iter().all(|v| v.is_finite()) { Vec::new() } else { per_cell.iter().map(|v| !v.is_finite()).collect() }
}
