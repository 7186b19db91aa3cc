//! The cells that a camera stands in.

use std::collections::HashMap;

use glam::{DVec3, Vec4Swizzles as _};
use rayon::prelude::*;

use crate::plan::lens::Lens;
use crate::tet::{FACES, LinkedMesh, Side};

/// Mesh units: what lies nearer behind a place than this is at that place.
pub const HAIR: f32 = 1e-6;

/// Sides of cells in groups whose cells are linked, one by one: cells around one eye that are not fill one place.
pub fn groups(mesh: &LinkedMesh, sides: &[Side]) -> Vec<Vec<Side>> {
    let mut rest: HashMap<u32, Vec<Side>> = HashMap::new();
    sides.iter().for_each(|&side| rest.entry(side.cell).or_default().push(side));
    let mut groups: Vec<Vec<Side>> = Vec::new();
    for first in sides {
        let Some(mut group) = rest.remove(&first.cell) else { continue };
        let mut next = 0;
        while next < group.len() {
            let links = mesh.cells[group[next].cell as usize].links;
            let linked = links.into_iter().filter(|&link| link != LinkedMesh::NO_LINK);
            group.extend(linked.filter_map(|link| rest.remove(&(link >> 2))).flatten());
            next += 1;
        }
        groups.push(group);
    }
    groups
}

/// All sides of the cells that hold a perspective lens's eye, within what rays are moved by rounding: a ray begins
/// where its line enters the cell, behind the eye.
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::tet::TetMesh;

    /// Balls as fans of cells around their centres, each an octahedron whose faces were cut into four so many times.
    fn fans(centers: &[DVec3], cuts: u32) -> LinkedMesh {
        let (mut vertices, mut tets) = (Vec::new(), Vec::new());
        for &center in centers {
            let middle = vertices.len() as u32;
            vertices.extend([center, center + DVec3::X, center - DVec3::X, center + DVec3::Y, center - DVec3::Y]);
            vertices.extend([center + DVec3::Z, center - DVec3::Z]);
            let eighth = |[x, y, z]: [u32; 3]| if (x + y + z) % 2 == 1 { [x, y, z] } else { [x, z, y] };
            let octants = (0..8_u32).map(|i| eighth([1 + i % 2, 3 + i / 2 % 2, 5 + i / 4]));
            let mut faces: Vec<[u32; 3]> = octants.map(|face| face.map(|v| middle + v)).collect();
            let mut made: HashMap<[u32; 2], u32> = HashMap::new();
            for _ in 0..cuts {
                let mut between = |a: u32, b: u32| {
                    *made.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                        let half = 0.5 * (vertices[a as usize] + vertices[b as usize]) - center;
                        vertices.push(center + half.normalize());
                        vertices.len() as u32 - 1
                    })
                };
                let cut = |[a, b, c]: [u32; 3]| {
                    let [ab, bc, ca] = [between(a, b), between(b, c), between(c, a)];
                    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
                };
                faces = faces.into_iter().flat_map(cut).collect();
            }
            tets.extend(faces.into_iter().map(|[a, b, c]| [middle, a, b, c]));
        }
        let count = vertices.len();
        LinkedMesh::new(&TetMesh {
            vertices,
            center_in_data: DVec3::ZERO,
            data_per_mesh: 1.0,
            tets: tets.into(),
            scalar: vec![0.0; count],
            gradient_magnitude: vec![0.0; count],
            field: String::new(),
        })
    }

    fn as_sets(groups: &[Vec<Side>]) -> BTreeSet<BTreeSet<u32>> {
        groups.iter().map(|group| group.iter().map(|side| side.packed()).collect()).collect()
    }

    /// Two groups become one where any of their cells are linked, until none are: as the definition says.
    fn joined(mesh: &LinkedMesh, sides: &[Side]) -> BTreeSet<BTreeSet<u32>> {
        let mut groups: Vec<Vec<Side>> = sides.iter().map(|&side| vec![side]).collect();
        let are_linked = |a: &[Side], b: &[Side]| {
            let is_link = |a: &Side, b: &Side| {
                let links = mesh.cells[a.cell as usize].links;
                a.cell == b.cell || links.iter().any(|&l| l != LinkedMesh::NO_LINK && l >> 2 == b.cell)
            };
            a.iter().any(|a| b.iter().any(|b| is_link(a, b)))
        };
        let pair = |groups: &[Vec<Side>]| {
            let pairs = (0..groups.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
            pairs.into_iter().find(|&(i, j)| are_linked(&groups[i], &groups[j]))
        };
        while let Some((i, j)) = pair(&groups) {
            let moved = groups.swap_remove(i);
            groups[j].extend(moved);
        }
        as_sets(&groups)
    }

    fn around(mesh: &LinkedMesh, centers: &[DVec3], cuts: u32) -> Vec<Side> {
        let sides: Vec<Side> = (0..mesh.cells.len() as u32)
            .flat_map(|cell| (0..4).map(move |opposite| Side::new(cell, opposite, mesh.is_odd(cell))))
            .collect();
        assert_eq!(sides.len(), centers.len() * 4 * 8 * 4_usize.pow(cuts));
        sides
    }

    #[test]
    fn groups_are_those_of_linked_cells() {
        let centers = [DVec3::ZERO, DVec3::new(0.1, 0.0, 0.0), DVec3::new(0.0, 3.0, 0.0)];
        let mesh = fans(&centers, 0);
        let all = around(&mesh, &centers, 0);
        // All, and without those around one, which is alone then.
        let around_one = mesh.cells[5].links.map(|link| link >> 2);
        for (left_out, count) in [(&[][..], 3), (&around_one, 4)] {
            let sides: Vec<Side> = all.iter().filter(|side| !left_out.contains(&side.cell)).copied().collect();
            let found = groups(&mesh, &sides);
            assert_eq!(as_sets(&found), joined(&mesh, &sides));
            assert_eq!((found.len(), found.iter().map(Vec::len).sum::<usize>()), (count, sides.len()));
        }
        // One side in another group is seen.
        let mut wrong = groups(&mesh, &all);
        let moved = wrong[0].pop().expect("a side");
        wrong[1].push(moved);
        assert_ne!(as_sets(&wrong), joined(&mesh, &all));
    }

    /// In the middle of a fan, the eye is in all cells: here of two, whose sides are 10^10 pairs.
    #[test]
    fn the_cells_of_a_fan_are_one_group() {
        let centers = [DVec3::ZERO, DVec3::ZERO];
        let mesh = fans(&centers, 6);
        let all = around(&mesh, &centers, 6);
        let found = groups(&mesh, &all);
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [all.len() / 2; 2]);
        assert!(found.iter().all(|group| group.iter().map(|side| side.cell).collect::<BTreeSet<_>>().len() == 32_768));
    }
}
