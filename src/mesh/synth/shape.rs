//! The procedural meshes' points and cells.

use std::array::from_fn;
use std::f64::consts::FRAC_PI_4;

use glam::DVec3;

use super::add_point_array;
use crate::mesh::{CellKind, Mesh, Topology};

/// The six ways from a cube's corner 0 to its corner 7, one axis at a time: Kuhn's subdivision.
const KUHN: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];

/// Cells along an axis of a cube so that `per_cube` tetrahedra each give about `tets`; 1 to 800, within u32 indices.
pub(super) fn per_axis(tets: usize, per_cube: usize) -> usize {
    ((tets as f64 / per_cube as f64).cbrt().round() as usize).clamp(1, 800)
}

/// The box [-1, 1]^3 of `n^3` cubes, six tetrahedra each, with point arrays `one` (1 everywhere) and `x`.
///
/// Interior points are moved by up to `jitter` cell widths along each axis (0.15 keeps every tetrahedron positive),
/// from a hash of `seed`. `n` is clamped to at least 1.
pub fn tet_box(n: usize, jitter: f64, seed: u64) -> Mesh {
    let n = n.max(1);
    let mut points = lattice([n; 3]);
    for (i, p) in points.iter_mut().enumerate() {
        if p.abs().max_element() < 1.0 - 1e-9 {
            let noise = from_fn(|axis| signed_unit(seed, 3 * i as u64 + axis as u64));
            *p += DVec3::from_array(noise) * (jitter * 2.0 / n as f64);
        }
    }
    let mut nodes = Vec::with_capacity(24 * n * n * n);
    for corners in cubes([n; 3]) {
        for path in KUHN {
            let steps = [0, 1 << path[0], (1 << path[0]) | (1 << path[1]), 7];
            let mut tet = steps.map(|corner| corners[corner]);
            let [a, b, c, d] = tet.map(|node| points[node as usize]);
            if (b - a).cross(c - a).dot(d - a) < 0.0 {
                tet.swap(2, 3);
            }
            nodes.extend(tet);
        }
    }
    finish(points, CellKind::Tetrahedron, nodes)
}

/// The box [-1, 1]^3 of `n[0] * n[1] * n[2]` hexahedra, with point arrays `one` (1 everywhere) and `x`.
///
/// Each of `n` is clamped to at least 1.
pub fn box_grid(n: [usize; 3]) -> Mesh {
    let n = n.map(|k| k.max(1));
    let nodes = cubes(n).flat_map(|c| [c[0], c[1], c[3], c[2], c[4], c[5], c[7], c[6]]).collect();
    finish(lattice(n), CellKind::Hexahedron, nodes)
}

/// Hexahedra between the unit sphere and `outer`: six patches of a cubed sphere (equal angles), `n` cells along each
/// edge and `n` outward, without seam or pole. No arrays.
pub(super) fn sphere_shell(n: usize, outer: f64) -> Mesh {
    /// How much finer the grid is at the sphere: the outermost layer is about e^4 times as thick as the innermost.
    const STRETCH: f64 = 4.0;
    let side = n + 1;
    // Lattice nodes of the cube's surface, numbered; the inside keeps the sentinel.
    let mut number = vec![u32::MAX; side * side * side];
    let mut directions = Vec::new();
    for (i, slot) in number.iter_mut().enumerate() {
        let lattice = [i % side, i / side % side, i / side / side];
        if lattice.iter().any(|&k| k == 0 || k == n) {
            *slot = directions.len() as u32;
            let angle = |k: usize| (FRAC_PI_4 * (2.0 * k as f64 / n as f64 - 1.0)).tan();
            directions.push(DVec3::from_array(lattice.map(angle)).normalize());
        }
    }
    let layers = (0..=n).map(|j| {
        let t = j as f64 / n as f64;
        1.0 + (outer - 1.0) * (STRETCH * t).exp_m1() / STRETCH.exp_m1()
    });
    let points = layers.flat_map(|radius| directions.iter().map(move |d| *d * radius)).collect();

    let mut nodes = Vec::with_capacity(48 * n * n * n);
    for (axis, far) in (0..3).flat_map(|axis| [(axis, 0), (axis, n)]) {
        // u x v points outward, which puts the outer layer on the hexahedron's upper side.
        let (u, v) = if far > 0 { ((axis + 1) % 3, (axis + 2) % 3) } else { ((axis + 2) % 3, (axis + 1) % 3) };
        let corner = |a: usize, b: usize| {
            let mut lattice = [far; 3];
            (lattice[u], lattice[v]) = (a, b);
            number[lattice[0] + side * (lattice[1] + side * lattice[2])]
        };
        for (a, b) in (0..n).flat_map(|b| (0..n).map(move |a| (a, b))) {
            let quad = [corner(a, b), corner(a + 1, b), corner(a + 1, b + 1), corner(a, b + 1)];
            for layer in 0..n {
                let shift = |j: usize| quad.map(|q| q + (j * directions.len()) as u32);
                nodes.extend(shift(layer));
                nodes.extend(shift(layer + 1));
            }
        }
    }
    mesh_of(points, CellKind::Hexahedron, nodes)
}

fn finish(points: Vec<DVec3>, kind: CellKind, nodes: Vec<u32>) -> Mesh {
    let mut mesh = mesh_of(points, kind, nodes);
    let x = mesh.points.iter().map(|p| p.x).collect();
    let one = vec![1.0; mesh.points.len()];
    add_point_array(&mut mesh, "one", 1, one);
    add_point_array(&mut mesh, "x", 1, x);
    mesh
}

fn mesh_of(points: Vec<DVec3>, kind: CellKind, nodes: Vec<u32>) -> Mesh {
    let kinds = vec![kind; nodes.len() / kind.node_count()];
    let topology = Topology::Cells { kinds, nodes };
    Mesh { points, topology, arrays: Vec::new(), available: Vec::new(), notes: Vec::new() }
}

/// Points of the box [-1, 1]^3 of `n` cells, x fastest.
fn lattice(n: [usize; 3]) -> Vec<DVec3> {
    let at = |axis: usize, k: usize| 2.0 * k as f64 / n[axis] as f64 - 1.0;
    let mut points = Vec::with_capacity(n.iter().map(|k| k + 1).product());
    for k in 0..=n[2] {
        for j in 0..=n[1] {
            points.extend((0..=n[0]).map(|i| DVec3::new(at(0, i), at(1, j), at(2, k))));
        }
    }
    points
}

/// The eight lattice nodes of each cell, x fastest.
fn cubes(n: [usize; 3]) -> impl Iterator<Item = [u32; 8]> {
    let stride = [1, n[0] + 1, (n[0] + 1) * (n[1] + 1)];
    let corner = move |c: usize| (c & 1) * stride[0] + (c >> 1 & 1) * stride[1] + (c >> 2) * stride[2];
    (0..n[0] * n[1] * n[2]).map(move |cell| {
        let (i, j, k) = (cell % n[0], cell / n[0] % n[1], cell / n[0] / n[1]);
        let base = i * stride[0] + j * stride[1] + k * stride[2];
        from_fn(|c| (base + corner(c)) as u32)
    })
}

/// A uniform number in [-1, 1) from a seed and an index: SplitMix64's finaliser (Steele, Lea, Flood 2014).
fn signed_unit(seed: u64, index: u64) -> f64 {
    let mut z = seed
        .wrapping_mul(0xD1B5_4A32_D192_ED03)
        .wrapping_add(index.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^= z >> 31;
    (z >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::super::Sample;
    use super::*;

    fn cells(mesh: &Mesh) -> (&[CellKind], &[u32]) {
        match &mesh.topology {
            Topology::Cells { kinds, nodes } => (kinds, nodes),
            Topology::Structured { .. } => panic!("procedural meshes have explicit cells"),
        }
    }

    /// Six-fold volumes of a tetrahedral mesh.
    fn volumes(mesh: &Mesh) -> Vec<f64> {
        let (_, nodes) = cells(mesh);
        let corner = |t: &[u32], i: usize| mesh.points[t[i] as usize];
        nodes
            .chunks(4)
            .map(|t| (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).dot(corner(t, 3) - corner(t, 0)))
            .collect()
    }

    #[test]
    fn tetrahedra_are_positive_and_fill_the_box() {
        let mut mesh = tet_box(9, 0.15, 7);
        let six_volumes = volumes(&mesh);
        assert_eq!(six_volumes.len(), 6 * 729);
        assert!(six_volumes.iter().all(|v| *v > 0.0));
        assert!((six_volumes.iter().sum::<f64>() / 6.0 - 8.0).abs() < 1e-12);
        let interior = mesh.points.iter().position(|p| p.abs().max_element() < 0.5).unwrap();
        mesh.points[interior] += DVec3::splat(0.5);
        assert!(volumes(&mesh).iter().any(|v| *v <= 0.0), "a moved point must show");
        assert_ne!(tet_box(9, 0.15, 8).points, tet_box(9, 0.15, 7).points);
    }

    #[test]
    fn hexahedra_share_every_inner_face() {
        const FACES: [[usize; 4]; 6] =
            [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];
        let once = |mesh: &Mesh| {
            let mut seen = HashMap::new();
            let (kinds, nodes) = cells(mesh);
            assert!(kinds.iter().all(|k| *k == CellKind::Hexahedron));
            for hex in nodes.chunks(8) {
                // Outward faces: positive divergence volume per cell shows the orientation is VTK's.
                let centre = hex.iter().map(|n| mesh.points[*n as usize]).sum::<DVec3>() / 8.0;
                for face in FACES {
                    let p = face.map(|f| mesh.points[hex[f] as usize]);
                    assert!((p[2] - p[0]).cross(p[3] - p[1]).dot(p[0] - centre) > 0.0);
                    let mut key = face.map(|f| hex[f]);
                    key.sort_unstable();
                    *seen.entry(key).or_insert(0) += 1;
                }
            }
            seen.values().filter(|n| **n == 1).count()
        };
        assert_eq!(once(&box_grid([2, 3, 4])), 2 * (2 * 3 + 3 * 4 + 4 * 2));
        // Inner and outer sphere, six patches of 5 x 5 each: no seam.
        assert_eq!(once(&sphere_shell(5, 8.0)), 2 * 6 * 25);
    }

    #[test]
    fn about_the_asked_number() {
        for sample in Sample::ALL {
            let mesh = sample.mesh(20_000);
            let (kinds, _) = cells(&mesh);
            let tets: usize = kinds.iter().map(|k| if *k == CellKind::Hexahedron { 6 } else { 1 }).sum();
            assert!((15_000..26_000).contains(&tets), "{sample:?}: {tets}");
            assert!(mesh.points.iter().all(|p| p.is_finite()));
            assert!(mesh.arrays.iter().all(|a| a.values.len() == a.components * mesh.points.len()));
            assert_eq!(sample.name().parse::<Sample>().unwrap(), sample);
            assert_eq!(sample.mesh(0).topology.cell_count(), 6);
        }
        assert!("torus".parse::<Sample>().unwrap_err().to_string().contains("marschner-lobb"));
    }
}
