//! Meshes of boxes, made here so that the tests do not depend on the readers.

use glam::DVec3;
use tetralux::tet::TetMesh;

/// A box of `n` x `n` x `n` cubes with corners at `min` and `max` (data space), six tetrahedra a cube, all with the
/// same diagonal; the fields are given at the vertices.
pub fn box_mesh(n: usize, min: DVec3, max: DVec3, fields: impl Fn(DVec3) -> [f64; 2]) -> TetMesh {
    let side = n + 1;
    let points: Vec<DVec3> = (0..side * side * side)
        .map(|i| {
            let at = DVec3::new((i % side) as f64, (i / side % side) as f64, (i / side / side) as f64);
            min + (max - min) * at / n as f64
        })
        .collect();
    let mut tets = Vec::new();
    for cube in 0..n * n * n {
        let [x, y, z] = [cube % n, cube / n % n, cube / n / n];
        // One tetrahedron for each order of the three axes along which one walks from corner 000 to 111.
        for (order, odd) in [
            ([0, 1, 2], false),
            ([1, 2, 0], false),
            ([2, 0, 1], false),
            ([0, 2, 1], true),
            ([1, 0, 2], true),
            ([2, 1, 0], true),
        ] {
            let mut at = [x, y, z];
            let mut tet = [0u32; 4];
            for (step, id) in tet.iter_mut().enumerate() {
                *id = (at[0] + side * (at[1] + side * at[2])) as u32;
                if step < 3 {
                    at[order[step]] += 1;
                }
            }
            if odd {
                tet.swap(2, 3);
            }
            tets.push(tet);
        }
    }
    tet_mesh(&points, tets, fields)
}

/// Puts points (data space) and positively oriented tetrahedra together.
pub fn tet_mesh(points: &[DVec3], tets: Vec<[u32; 4]>, fields: impl Fn(DVec3) -> [f64; 2]) -> TetMesh {
    let bounds = tetralux::space::Bounds::of(points.iter().copied());
    let center_in_data = bounds.center();
    let data_per_mesh = bounds.diagonal().log2().ceil().exp2();
    let fields: Vec<[f64; 2]> = points.iter().map(|&p| fields(p)).collect();
    TetMesh {
        vertices: points.iter().map(|&p| (p - center_in_data) / data_per_mesh).collect(),
        center_in_data,
        data_per_mesh,
        tets: tets.into(),
        scalar: fields.iter().map(|f| f[0]).collect(),
        gradient_magnitude: fields.iter().map(|f| f[1]).collect(),
        field: "test".into(),
    }
}

/// Length of the part of a ray (`t >= near`, in units of `direction`) inside the box. A ray
/// in the plane of a side belongs to the box at its lower side, as if moved up all axes by an infinitesimal.
pub fn chord(origin: DVec3, direction: DVec3, near: f64, min: DVec3, max: DVec3) -> f64 {
    let (a, b) = ((min - origin) / direction, (max - origin) / direction);
    let (mut enter, mut exit) = (near, f64::INFINITY);
    for axis in 0..3 {
        if direction[axis] != 0.0 {
            enter = enter.max(a[axis].min(b[axis]));
            exit = exit.min(a[axis].max(b[axis]));
        } else if origin[axis] < min[axis] || origin[axis] >= max[axis] {
            return 0.0;
        }
    }
    (exit - enter).max(0.0) * direction.length()
}
