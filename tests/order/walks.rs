//! Orders by walking from cell to cell, and circles of cells that hide one another.

use glam::DVec3;
use tetralux::plan::order::{Sequenced, VisibilityOrder, exact, mpvonc};
use tetralux::scene::{Camera, Projection};
use tetralux::tet::{Adjacency, TetMesh};

use crate::common::boxes::{box_mesh, tet_mesh};
use crate::support::{camera, count, delaunay, fields, mapped, moved, without};

const SIZE: [u32; 2] = [60, 40];

fn assert_permutation(sequenced: &Sequenced, mesh: &TetMesh) {
    assert_eq!(sequenced.order.cells().len(), mesh.tets.len());
    VisibilityOrder::new(sequenced.order.cells().to_vec()).expect("a permutation");
}

#[test]
fn neighbors_are_in_order_where_there_are_no_circles() {
    let hole = |p: DVec3| (p - 0.5).length() < 0.3;
    let meshes = [
        delaunay(0),
        without(delaunay(1), hole),
        mapped(&delaunay(2), |p| p * DVec3::new(1.0, 1.0, 0.05)),
        box_mesh(5, DVec3::ZERO, DVec3::ONE, fields),
        without(box_mesh(6, DVec3::ZERO, DVec3::ONE, fields), hole),
        moved(&box_mesh(8, DVec3::ZERO, DVec3::ONE, fields), 0.015, 3),
    ];
    for mesh in &meshes {
        let adjacency = Adjacency::new(mesh);
        let by_faces = |camera: &Camera| mpvonc(mesh, &adjacency, camera);
        let by_rays = |camera: &Camera| exact(mesh, &adjacency, camera, SIZE);
        for order in [&by_faces as &dyn Fn(&Camera) -> Sequenced, &by_rays] {
            let sum = count(mesh, 12, |camera| {
                let sequenced = order(camera);
                assert_permutation(&sequenced, mesh);
                assert_eq!(sequenced.cycles, 0);
                sequenced.order
            });
            assert_eq!(sum.wrong, 0);
        }
    }
}

/// Rings of six cells around an axis with a common corner, twisted as the blades of a shutter, and one in the middle:
/// from the axis, each cell of a ring hides the next.
fn shutter(rings: u32) -> TetMesh {
    let mut points = vec![DVec3::ZERO];
    for ring in 0..=rings {
        points.extend((0..3).map(|i| {
            let angle = (20.0 * f64::from(ring) + 120.0 * f64::from(i)).to_radians();
            DVec3::new(angle.cos(), angle.sin(), 0.0) * 6_f64.powi(ring as i32) + DVec3::Z
        }));
    }
    let mut tets = vec![[0, 1, 2, 3]];
    for ring in 0..rings {
        for i in 0..3 {
            let (here, next) = (3 * ring + 1 + i, 3 * ring + 1 + (i + 1) % 3);
            tets.push([0, here, here + 3, next + 3]);
            tets.push([0, here, next + 3, next]);
        }
    }
    tet_mesh(&points, tets, fields)
}

#[test]
fn a_circle_of_neighbors_is_counted_and_costs_one_pair() {
    for rings in [1, 2, 4] {
        let mesh = shutter(rings);
        let volume = |t: &[u32; 4]| {
            let [a, b, c, d] = t.map(|v| mesh.vertices[v as usize]);
            (b - a).cross(c - a).dot(d - a)
        };
        assert!(mesh.tets.iter().all(|t| volume(t) > 0.0));
        let adjacency = Adjacency::new(&mesh);
        let down = DVec3::new(0.0, 0.0, 0.5);
        for (eye, projection) in [
            (DVec3::new(0.0, 0.0, 25.0), Projection::Perspective { fov_y: 1.0 }),
            (DVec3::new(0.01, 0.02, 8.0), Projection::Perspective { fov_y: 2.0 }),
            (DVec3::new(0.0, 0.0, 25.0), Projection::Orthographic { height: 21.0 }),
        ] {
            let camera = camera(eye, down, projection);
            for sequenced in [mpvonc(&mesh, &adjacency, &camera), exact(&mesh, &adjacency, &camera, SIZE)] {
                assert_permutation(&sequenced, &mesh);
                assert_eq!(sequenced.cycles, u64::from(rings));
                let sum = sequenced.order.inversions(&mesh, &adjacency, &camera);
                assert_eq!(sum.wrong, u64::from(rings), "{sum:?}");
                // Around each ring all but one go one way, and that one is over one of the faces that look smaller.
                let ranks = sequenced.order.ranks();
                for ring in 0..rings as usize {
                    let cells: Vec<usize> = (0..6).map(|i| 6 * ring + 1 + i).collect();
                    let ups = (0..6).filter(|&i| ranks[cells[i]] < ranks[cells[(i + 1) % 6]]).collect::<Vec<_>>();
                    let downs = (0..6).filter(|i| !ups.contains(i)).collect::<Vec<_>>();
                    let odd = if ups.len() == 1 { ups } else { downs };
                    assert!(odd.len() == 1 && odd[0] % 2 == 1, "{odd:?}");
                }
            }
        }
        // From beside, there is none.
        let beside = camera(DVec3::new(3e3, 400.0, 1.0), down, Projection::Perspective { fov_y: 1.0 });
        let sequenced = mpvonc(&mesh, &adjacency, &beside);
        let sum = sequenced.order.inversions(&mesh, &adjacency, &beside);
        assert_eq!((sequenced.cycles, sum.wrong), (0, 0));
    }
}

/// Three beams around a triangle, each over the last one's end.
#[test]
fn three_interlocked_slivers_are_a_circle() {
    let (mut points, mut tets) = (Vec::new(), Vec::new());
    for i in 0..3 {
        let angle = (120.0 * f64::from(i)).to_radians();
        let along = DVec3::new(-angle.sin(), angle.cos(), 0.0);
        let out = DVec3::new(angle.cos(), angle.sin(), 0.0);
        // Beyond both corners, which are 1.73 from the middle.
        let [high, low] = [-2.2, 2.2].map(|t| out + t * along - 0.1 * t * DVec3::Z);
        let first = points.len() as u32;
        points.extend([high + 0.1 * out, high - 0.1 * out, low + 0.1 * DVec3::Z, low - 0.1 * DVec3::Z]);
        tets.push([first, first + 1, first + 2, first + 3]);
    }
    for tet in &mut tets {
        let [a, b, c, d] = tet.map(|v: u32| points[v as usize]);
        if (b - a).cross(c - a).dot(d - a) < 0.0 {
            tet.swap(2, 3);
        }
    }
    let mesh = tet_mesh(&points, tets, fields);
    let adjacency = Adjacency::new(&mesh);
    let cameras = [
        camera(DVec3::new(0.0, 0.0, 9.0), DVec3::ZERO, Projection::Perspective { fov_y: 0.7 }),
        camera(DVec3::new(0.3, -0.2, 9.0), DVec3::ZERO, Projection::Orthographic { height: 6.0 }),
        camera(DVec3::new(0.1, 0.0, -9.0), DVec3::ZERO, Projection::Perspective { fov_y: 0.7 }),
    ];
    for camera in &cameras {
        let sequenced = exact(&mesh, &adjacency, camera, [200, 200]);
        assert_permutation(&sequenced, &mesh);
        assert_eq!(sequenced.cycles, 1, "{camera:?}");
    }
    let beside = camera(DVec3::new(9.0, 1.0, 0.2), DVec3::ZERO, Projection::Perspective { fov_y: 0.7 });
    assert_eq!(exact(&mesh, &adjacency, &beside, [200, 200]).cycles, 0);
}
