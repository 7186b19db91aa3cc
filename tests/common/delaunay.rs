//! A Delaunay tetrahedralisation of a cube, with the slivers that random points have (Bowyer 1981, Watson 1981).

use std::collections::HashMap;

use glam::DVec3;
use tetralux::tet::TetMesh;

use super::boxes::tet_mesh;
use super::random::Random;

/// The unit cube with random points inside, on its faces and on its edges: `inside`, 6 x `on_face`, 12 x `on_edge` and
/// the 8 corners. Fields as for [`tet_mesh`].
pub fn cube(inside: usize, on_face: usize, on_edge: usize, seed: u64, fields: impl Fn(DVec3) -> [f64; 2]) -> TetMesh {
    let mut points: Vec<DVec3> =
        (0..8).map(|i| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64)).collect();
    // Five tetrahedra: four corners cut off, one regular in the middle.
    let mut tets = vec![[0, 1, 2, 4], [3, 2, 1, 7], [5, 1, 4, 7], [6, 4, 2, 7], [1, 2, 4, 7]];
    tets.iter_mut().for_each(|tet| orient(&points, tet));
    for point in scattered(inside, on_face, on_edge, seed) {
        insert(&mut points, &mut tets, point);
    }
    let volume: f64 = tets.iter().map(|&tet| six_volumes(&points, tet) / 6.0).sum();
    let least = tets.iter().map(|&tet| six_volumes(&points, tet)).fold(f64::INFINITY, f64::min);
    assert!(least > 0.0 && (volume - 1.0).abs() < 1e-12, "not a tiling of the cube: volume {volume}, least {least}");
    tet_mesh(&points, tets, fields)
}

fn scattered(inside: usize, on_face: usize, on_edge: usize, seed: u64) -> Vec<DVec3> {
    let mut random = Random(seed);
    let mut points: Vec<DVec3> = (0..inside).map(|_| random.in_cube()).collect();
    for face in 0..6 {
        points.extend((0..on_face).map(|_| {
            let mut point = random.in_cube();
            point[face / 2] = (face % 2) as f64;
            point
        }));
    }
    for edge in 0..12 {
        points.extend((0..on_edge).map(|_| {
            let mut point = random.in_cube();
            point[(edge / 4 + 1) % 3] = (edge & 1) as f64;
            point[(edge / 4 + 2) % 3] = (edge >> 1 & 1) as f64;
            point
        }));
    }
    points
}

/// Replaces the tetrahedra whose circumsphere holds the point by those between their common hull and the point.
fn insert(points: &mut Vec<DVec3>, tets: &mut Vec<[u32; 4]>, point: DVec3) {
    let id = points.len() as u32;
    points.push(point);
    let mut faces: HashMap<[u32; 3], Option<[u32; 3]>> = HashMap::new();
    tets.retain(|&tet| {
        let hit = sphere_holds(points, tet, point);
        if hit {
            let [a, b, c, d] = tet;
            for face in [[b, d, c], [a, c, d], [a, d, b], [a, b, c]] {
                let mut key = face;
                key.sort_unstable();
                // A face that comes twice lies inside the hull.
                faces.entry(key).and_modify(|f| *f = None).or_insert(Some(face));
            }
        }
        !hit
    });
    let mut hull: Vec<[u32; 3]> = faces.into_values().flatten().collect();
    hull.sort_unstable();
    for [a, b, c] in hull {
        let tet = [a, b, c, id];
        // A face of the cube in whose plane the point lies: zero to the bit, as all four share a coordinate.
        if six_volumes(points, tet) != 0.0 {
            tets.push(tet);
        }
    }
}

fn six_volumes(points: &[DVec3], tet: [u32; 4]) -> f64 {
    let [a, b, c, d] = tet.map(|v| points[v as usize]);
    (b - a).cross(c - a).dot(d - a)
}

fn orient(points: &[DVec3], tet: &mut [u32; 4]) {
    if six_volumes(points, *tet) < 0.0 {
        tet.swap(2, 3);
    }
}

/// Whether the circumsphere holds the point in its inside.
fn sphere_holds(points: &[DVec3], tet: [u32; 4], point: DVec3) -> bool {
    let [a, b, c, d] = tet.map(|v| points[v as usize]);
    let (u, v, w) = (b - a, c - a, d - a);
    // Of a to the centre: ((u.u) v x w + (v.v) w x u + (w.w) u x v) / (2 u . v x w).
    let numerator = u.length_squared() * v.cross(w) + v.length_squared() * w.cross(u) + w.length_squared() * u.cross(v);
    let p = point - a;
    // |p - centre|^2 < |centre|^2, times the (positive) denominator.
    p.length_squared() * u.dot(v.cross(w)) < p.dot(numerator)
}
