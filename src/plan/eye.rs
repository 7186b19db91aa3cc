//! The cells that a camera stands in.

use glam::{DVec3, Vec4Swizzles as _};
use rayon::prelude::*;

use crate::plan::lens::Lens;
use crate::tet::{FACES, LinkedMesh, Side};

/// Mesh units: what lies nearer behind a place than this is at that place.
pub const HAIR: f32 = 1e-6;

/// Sides of cells in groups whose cells are linked, one by one: cells around one eye that are not fill one place.
pub fn groups(mesh: &LinkedMesh, sides: &[Side]) -> Vec<Vec<Side>> {
    let mut groups: Vec<Vec<Side>> = Vec::new();
    let mut rest = sides.to_vec();
    while let Some(first) = rest.pop() {
        let mut group = vec![first];
        let mut next = 0;
        while next < group.len() {
            let links = mesh.cells[group[next].cell as usize].links;
            let cell = group[next].cell;
            let is_linked = |side: &Side| {
                side.cell == cell || links.iter().any(|&l| l != LinkedMesh::NO_LINK && l >> 2 == side.cell)
            };
            let (linked, others): (Vec<Side>, Vec<Side>) = rest.into_iter().partition(is_linked);
            rest = others;
            group.extend(linked);
            next += 1;
        }
        groups.push(group);
    }
    groups
}

/// All sides of the cells that hold a perspective lens's eye, within what rays are moved by rounding: a ray begins where
/// its line enters the cell, behind the eye.
pub fn sides_around(mesh: &LinkedMesh, lens: &Lens) -> Vec<Side> {
    if !lens.perspective {
        return Vec::new();
    }
    let eye = lens.eye;
    let hair = f64::from(HAIR);
    // Cells do not reach beyond the boundary.
    let points = mesh.boundary.points.iter();
    let (low, high) = points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), &p| (low.min(p), high.max(p)));
    if (low - hair).cmpgt(eye).any() || eye.cmpgt(high + hair).any() {
        return Vec::new();
    }
    let holds = |cell: &u32| {
        let corners = mesh.cells[*cell as usize].vertices.map(|v| mesh.vertices[v as usize].xyz().as_dvec3() - eye);
        let low = corners.into_iter().fold(DVec3::INFINITY, DVec3::min);
        let high = corners.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max);
        let turn = if mesh.is_odd(*cell) { -1.0 } else { 1.0 };
        low.max_element() <= hair
            && high.min_element() >= -hair
            && FACES.iter().all(|face| {
                let [a, b, c] = face.map(|i| corners[i]);
                let outward = turn * (b - a).cross(c - a);
                outward.dot(a) >= -hair * outward.length()
            })
    };
    let around: Vec<u32> = (0..mesh.cells.len() as u32).into_par_iter().filter(holds).collect();
    let sides = |cell: u32| (0..4).map(move |opposite| Side::new(cell, opposite, mesh.is_odd(cell)));
    around.into_iter().flat_map(sides).collect()
}
