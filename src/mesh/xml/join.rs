//! Pieces become one mesh.

use glam::DVec3;

use super::array::Array;
use super::weld::weld;
use crate::error::{Error, Result};
use crate::mesh::notes::Notes;
use crate::mesh::{ArrayInfo, Association, CellKind, DataArray, Mesh, Topology};

/// Arrays that mark cells and points as copies of other pieces' or as hidden.
const GHOST_ARRAYS: [&str; 2] = ["vtkGhostType", "vtkGhostLevels"];

/// The array of ghost marks among `arrays`.
pub(super) fn ghosts<'s, 'a>(arrays: &'s [Array<'a>]) -> Option<&'s Array<'a>> {
    GHOST_ARRAYS.iter().find_map(|name| arrays.iter().find(|a| a.name == *name))
}

/// The arrays that all pieces offer alike, in the first one's order, ghost marks excepted.
pub(super) fn common(offers: &[Vec<ArrayInfo>], notes: &mut Notes) -> Vec<ArrayInfo> {
    let Some((first, others)) = offers.split_first() else { return Vec::new() };
    let mut partial = 0;
    let mut available = Vec::new();
    for info in first.iter().filter(|info| !GHOST_ARRAYS.contains(&info.name.as_str())) {
        if others.iter().all(|other| other.contains(info)) {
            available.push(info.clone());
        } else {
            partial += 1;
        }
    }
    notes.count("arrays skipped that are not in every piece alike", partial);
    available
}

/// What a piece holds; nodes count from its own first point.
pub(super) struct Part {
    pub(super) points: Vec<DVec3>,
    pub(super) kinds: Vec<CellKind>,
    pub(super) nodes: Vec<u32>,
    /// The chosen ones, in the order of the choice.
    pub(super) arrays: Vec<DataArray>,
    /// The points' numbers across pieces.
    pub(super) ids: Option<Vec<f64>>,
}

/// Pieces joined so far.
pub(super) struct Joined {
    part: Part,
    /// First point of each piece.
    starts: Vec<u32>,
}

impl Joined {
    pub(super) fn new(chosen: &[ArrayInfo]) -> Self {
        let empty = |i: &ArrayInfo| DataArray {
            name: i.name.clone(),
            association: i.association,
            components: i.components,
            values: Vec::new(),
        };
        let arrays = chosen.iter().map(empty).collect();
        let part = Part { points: Vec::new(), kinds: Vec::new(), nodes: Vec::new(), arrays, ids: None };
        Self { part, starts: Vec::new() }
    }

    /// Adds a piece behind those that are there.
    pub(super) fn append(&mut self, part: Part) -> Result<()> {
        if self.starts.is_empty() {
            self.starts.push(0);
            self.part = part;
            return check_count(self.part.points.len());
        }
        let start = self.part.points.len();
        check_count(start + part.points.len())?;
        self.starts.push(start as u32);
        self.part.points.extend(part.points);
        self.part.kinds.extend(part.kinds);
        self.part.nodes.extend(part.nodes.iter().map(|n| n + start as u32));
        for (whole, more) in self.part.arrays.iter_mut().zip(part.arrays) {
            whole.values.extend(more.values);
        }
        if let (Some(whole), Some(more)) = (&mut self.part.ids, part.ids) {
            whole.extend(more);
        }
        Ok(())
    }

    /// Merges points that pieces share, and drops those that no cell uses (they belonged to ghost cells).
    pub(super) fn weld(&mut self, notes: &mut Notes) {
        let part = &mut self.part;
        let mut used = vec![false; part.points.len()];
        part.nodes.iter().for_each(|&n| used[n as usize] = true);
        let welded = weld(&part.points, &used, &self.starts, part.ids.as_deref());
        notes.count(
            "points merged across pieces: equal coordinates, bit by bit, and equal global ids where the file has them",
            welded.merged,
        );
        notes.count("points that no kept cell uses left out", used.iter().filter(|u| !**u).count() as u64);
        part.nodes.iter_mut().for_each(|n| *n = welded.new_index[*n as usize]);
        part.points = welded.kept.iter().map(|&i| part.points[i as usize]).collect();
        for array in part.arrays.iter_mut().filter(|a| a.association == Association::Point) {
            let tuple = |&i: &u32| {
                let at = i as usize * array.components;
                array.values[at..at + array.components].iter().copied()
            };
            array.values = welded.kept.iter().flat_map(tuple).collect();
        }
    }

    /// The mesh; an error where it has no volume cells.
    pub(super) fn into_mesh(self, available: Vec<ArrayInfo>, notes: Notes) -> Result<Mesh> {
        let notes = notes.into_vec();
        let Part { points, kinds, nodes, arrays, .. } = self.part;
        if kinds.is_empty() {
            let there: Vec<String> =
                notes.iter().filter(|n| n.count > 0).map(|n| format!("{} {}", n.count, n.text)).collect();
            let there = if there.is_empty() { "no cells".to_owned() } else { there.join("; ") };
            return Err(Error::Mesh(format!("no volume cells: {} points, {there}", points.len())));
        }
        Ok(Mesh { points, topology: Topology::Cells { kinds, nodes }, arrays, available, notes })
    }
}

fn check_count(points: usize) -> Result<()> {
    if points > u32::MAX as usize {
        return Err(Error::Mesh(format!("{points} points are more than the {} that can be numbered", u32::MAX)));
    }
    Ok(())
}
