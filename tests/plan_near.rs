//! Cells cut near the eye: nothing seen beyond the near plane is lost, nothing nearer is kept, no cell spans too many
//! depths, and the pieces fit together.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::collections::HashMap;

use common::boxes::{box_mesh, tet_mesh};
use glam::DVec3;
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use tetralux::mesh::synth::tet_box;
use tetralux::plan::near::{MOST_DEPTH_RATIO, NearCut, cut};
use tetralux::scene::{Camera, Projection};
use tetralux::space::Ray;
use tetralux::tet::{FieldChoice, HexSplit, TetMesh};

const PERSPECTIVE: Projection = Projection::Perspective { fov_y: 0.6 };
const ORTHOGRAPHIC: Projection = Projection::Orthographic { height: 1.0 };
/// Of the picture.
const ASPECT: f64 = 1.5;

fn camera(eye: DVec3, target: DVec3, projection: Projection, near: Option<f64>) -> Camera {
    Camera { eye, target, up: DVec3::new(0.1, 0.9, 0.3), projection, near }
}

/// An affine field and its negative double as "gradient magnitude": any linear thing stays linear.
fn affine(p: DVec3) -> [f64; 2] {
    let s = 3.0 + p.dot(DVec3::new(2.0, -1.0, 0.5));
    [s, 20.0 - 2.0 * s]
}

/// A random mesh of about `6 n^3` cells, in a box away from the origin, with the affine field.
fn random_box(n: usize, seed: u64) -> TetMesh {
    let mut source = tet_box(n, 0.15, seed);
    source.points.iter_mut().for_each(|p| *p = 3.0 * *p + DVec3::new(7.0, -2.0, 1.0));
    let (mut mesh, _) = TetMesh::new(source, &FieldChoice::default(), HexSplit::Six).expect("a mesh");
    let fields: Vec<[f64; 2]> = mesh.vertices.iter().map(|&v| affine(mesh.data_from_mesh(v))).collect();
    mesh.scalar = fields.iter().map(|f| f[0]).collect();
    mesh.gradient_magnitude = fields.iter().map(|f| f[1]).collect();
    mesh
}

/// The near plane in mesh space: a point of it, and the direction away from the eye.
fn near_plane(mesh: &TetMesh, camera: &Camera) -> Ray {
    let forward = (camera.target - camera.eye).normalize();
    let near = camera.near_depth(mesh.bounds_in_data().diagonal());
    Ray { origin: mesh.mesh_from_data(camera.eye + near * forward), direction: forward }
}

fn position(mesh: &TetMesh, cut: &NearCut, v: u32) -> DVec3 {
    let v = v as usize;
    if v < mesh.vertices.len() { mesh.vertices[v] } else { cut.vertices[v - mesh.vertices.len()].position }
}

fn six_volumes([a, b, c, d]: [DVec3; 4]) -> f64 {
    (b - a).cross(c - a).dot(d - a)
}

/// Six times the volume of a cell's part beyond the plane, by the divergence theorem about a point of the plane: the
/// cell's faces are clipped as polygons, and what closes them, on the plane, adds nothing.
fn six_volumes_beyond(plane: &Ray, corners: [DVec3; 4]) -> f64 {
    let depth = |p: DVec3| (p - plane.origin).dot(plane.direction);
    [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]
        .iter()
        .map(|face| {
            let mut polygon = Vec::new();
            for i in 0..3 {
                let [p, q] = [corners[face[i]], corners[face[(i + 1) % 3]]];
                if depth(p) >= 0.0 {
                    polygon.push(p - plane.origin);
                }
                if (depth(p) >= 0.0) != (depth(q) >= 0.0) {
                    polygon
                        .push((p * depth(q).abs() + q * depth(p).abs()) / (depth(p) - depth(q)).abs() - plane.origin);
                }
            }
            (2..polygon.len()).map(|i| polygon[0].dot(polygon[i - 1].cross(polygon[i]))).sum::<f64>()
        })
        .sum()
}

/// False for NaN.
fn agree(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance
}

/// The depth of a point of mesh space, in mesh space.
fn depth(mesh: &TetMesh, camera: &Camera, p: DVec3) -> f64 {
    (p - mesh.mesh_from_data(camera.eye)).dot(camera.basis().forward)
}

/// The depths of the planes that may cut, mesh space.
fn depths_of_planes(mesh: &TetMesh, camera: &Camera) -> Vec<f64> {
    let near = camera.near_depth(mesh.bounds_in_data().diagonal()) / mesh.data_per_mesh;
    let count = if camera.projection == ORTHOGRAPHIC { 1 } else { 20 };
    (0..count).map(|k| near * MOST_DEPTH_RATIO.powi(k)).collect()
}

/// False where all corners lie beyond one side of the picture, made wider by `margin`.
fn may_be_seen(mesh: &TetMesh, camera: &Camera, corners: &[DVec3], margin: f64) -> bool {
    let (eye, basis) = (mesh.mesh_from_data(camera.eye), camera.basis());
    let excess = |p: &DVec3, axis: DVec3, aspect: f64| {
        let half = match camera.projection {
            Projection::Perspective { fov_y } => depth(mesh, camera, *p) * (aspect * (0.5 * fov_y).tan() + margin),
            Projection::Orthographic { height } => aspect * (0.5 * height / mesh.data_per_mesh + margin),
        };
        (*p - eye).dot(axis) - half
    };
    [(basis.right, ASPECT), (-basis.right, ASPECT), (basis.up, 1.0), (-basis.up, 1.0)]
        .into_iter()
        .all(|(axis, aspect)| corners.iter().any(|p| excess(p, axis, aspect) <= 0.0))
}

/// The cell that each piece is of, among those marked; found by the piece's middle.
fn parents(mesh: &TetMesh, cut: &NearCut) -> Vec<usize> {
    let cells: Vec<(usize, [DVec3; 4])> = (0..mesh.tets.len())
        .filter(|&i| is_clipped(cut, i))
        .map(|i| (i, mesh.tets[i].map(|v| mesh.vertices[v as usize])))
        .collect();
    let parent = |tet: &[u32; 4]| {
        let middle = tet.map(|v| position(mesh, cut, v)).iter().sum::<DVec3>() / 4.0;
        // The smallest of the barycentric coordinates, times the volume.
        let inside = |[a, b, c, d]: [DVec3; 4]| {
            let parts = [[middle, b, c, d], [a, middle, c, d], [a, b, middle, d], [a, b, c, middle]];
            parts.map(six_volumes).into_iter().fold(f64::MAX, f64::min) / six_volumes([a, b, c, d])
        };
        cells.iter().map(|&(i, corners)| (i, inside(corners))).max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(i, _)| i)
    };
    cut.tets.iter().map(parent).collect()
}

fn is_clipped(cut: &NearCut, tet: usize) -> bool {
    cut.clipped[tet / 32] >> (tet % 32) & 1 == 1
}

/// Everything that a cut promises. Positions are of order 1.
fn check(mesh: &TetMesh, camera: &Camera, cut: &NearCut) -> Result<(), String> {
    check_cells(mesh, camera, cut)?;
    check_vertices(mesh, camera, cut)?;
    let unmatched = unmatched_faces(mesh, camera, cut);
    if unmatched > 0 { Err(format!("{unmatched} faces have no partner")) } else { Ok(()) }
}

fn check_cells(mesh: &TetMesh, camera: &Camera, cut: &NearCut) -> Result<(), String> {
    let plane = near_plane(mesh, camera);
    if cut.clipped.len() != mesh.tets.len().div_ceil(32) {
        return Err("lengths differ".into());
    }
    let mut pieces = vec![0.0; mesh.tets.len()];
    for (tet, parent) in cut.tets.iter().zip(parents(mesh, cut)) {
        let corners = tet.map(|v| position(mesh, cut, v));
        let volume = six_volumes(corners);
        if volume.is_nan() || volume <= 0.0 {
            return Err(format!("the piece {tet:?} has the volume {volume}"));
        }
        check_ratio(mesh, camera, corners)?;
        pieces[parent] += volume;
    }
    for (i, tet) in mesh.tets.iter().enumerate() {
        let corners = tet.map(|v| mesh.vertices[v as usize]);
        let nearest = corners.map(|p| (p - plane.origin).dot(plane.direction)).into_iter().fold(f64::MAX, f64::min);
        let seen = may_be_seen(mesh, camera, &corners, 0.0);
        // Vertices at the plane may fall on either side of it: the test's own plane is rounded differently.
        if (nearest < -1e-14 && !is_clipped(cut, i))
            || (nearest > 1e-14 && !seen && pieces[i] == 0.0 && is_clipped(cut, i))
        {
            return Err(format!("cell {i} is marked wrongly: its nearest vertex is {nearest} beyond the plane"));
        }
        if seen && !is_clipped(cut, i) {
            check_ratio(mesh, camera, corners)?;
        }
        let is_lost = nearest < 0.0 && is_clipped(cut, i) && pieces[i] == 0.0;
        if is_lost && !seen {
            continue;
        }
        if pieces[i] > 0.0 && !may_be_seen(mesh, camera, &corners, 3e-3) {
            return Err(format!("cell {i} is out of sight and has pieces"));
        }
        let beyond = six_volumes_beyond(&plane, corners);
        let got = if is_clipped(cut, i) { pieces[i] } else { six_volumes(corners) };
        // Measured: 5.3e-17 at most.
        if !agree(got, beyond, 1e-15) {
            return Err(format!("cell {i}: volume {got} instead of {beyond}, {:e}", got - beyond));
        }
    }
    Ok(())
}

/// Depths of a whole cell or a piece; nearer than the near plane, where vertices are rounded, does not count.
fn check_ratio(mesh: &TetMesh, camera: &Camera, corners: [DVec3; 4]) -> Result<(), String> {
    let depths = corners.map(|p| depth(mesh, camera, p));
    let near = depths_of_planes(mesh, camera)[0];
    let (min, max) = (depths.into_iter().fold(f64::MAX, f64::min), depths.into_iter().fold(f64::MIN, f64::max));
    let is_long = max > MOST_DEPTH_RATIO * (1.0 + 1e-9) * min.max(near);
    if camera.projection != ORTHOGRAPHIC && is_long {
        Err(format!("depths from {min} to {max} in one"))
    } else {
        Ok(())
    }
}

fn check_vertices(mesh: &TetMesh, camera: &Camera, cut: &NearCut) -> Result<(), String> {
    let planes = depths_of_planes(mesh, camera);
    for vertex in &cut.vertices {
        let [scalar, gradient_magnitude] = affine(mesh.data_from_mesh(vertex.position));
        // Measured: 1.5e-14 at most, of values of about 20.
        if !agree(vertex.scalar, scalar, 1e-13) || !agree(vertex.gradient_magnitude, gradient_magnitude, 1e-13) {
            return Err(format!("{vertex:?} instead of {scalar}, {gradient_magnitude}"));
        }
        let at = depth(mesh, camera, vertex.position);
        let off = planes.iter().map(|d| (at - d).abs()).fold(f64::MAX, f64::min);
        // Measured: 5.9e-17 at most.
        if !agree(off, 0.0, 1e-15) {
            return Err(format!("{vertex:?} lies {off:e} off the nearest plane"));
        }
    }
    for &v in cut.tets.iter().flatten() {
        let nearer = planes[0] - depth(mesh, camera, position(mesh, cut, v));
        if nearer > 1e-15 {
            return Err(format!("vertex {v} lies {nearer:e} before the near plane"));
        }
    }
    Ok(())
}

/// Faces of whole cells and pieces that are not shared by two, and lie neither on the near plane nor on the box, nor out
/// of sight.
fn unmatched_faces(mesh: &TetMesh, camera: &Camera, cut: &NearCut) -> usize {
    let (plane, bounds) = (near_plane(mesh, camera), mesh.bounds());
    let mut owners: HashMap<[u32; 3], usize> = HashMap::new();
    let whole = mesh.tets.iter().enumerate().filter(|(i, _)| !is_clipped(cut, *i)).map(|(_, tet)| tet);
    for tet in whole.chain(&cut.tets) {
        for skip in 0..4 {
            let mut face: Vec<u32> = (0..4).filter(|&i| i != skip).map(|i| tet[i]).collect();
            face.sort_unstable();
            *owners.entry([face[0], face[1], face[2]]).or_default() += 1;
        }
    }
    let is_open = |face: &[u32; 3]| {
        let p = face.map(|v| position(mesh, cut, v));
        let on_plane = p.iter().all(|p| (p - plane.origin).dot(plane.direction).abs() < 1e-14);
        let unseen = !may_be_seen(mesh, camera, &p, 0.0);
        let on_side = |axis: usize, side: DVec3| p.iter().all(|p| (p[axis] - side[axis]).abs() < 1e-14);
        on_plane || unseen || (0..3).any(|axis| on_side(axis, bounds.min) || on_side(axis, bounds.max))
    };
    owners.iter().filter(|(face, count)| **count > 2 || (**count == 1 && !is_open(face))).count()
}

#[track_caller]
fn good(mesh: &TetMesh, camera: &Camera) -> NearCut {
    let cut = cut(mesh, camera, ASPECT).expect("a cut");
    if let Err(message) = check(mesh, camera, &cut) {
        panic!("{message}, seen from {camera:?}");
    }
    cut
}

#[test]
fn from_inside_nothing_beyond_the_plane_is_lost() {
    let mut rng = StdRng::seed_from_u64(3);
    let mesh = random_box(6, 1);
    let b = mesh.bounds_in_data();
    for turn in 0..60 {
        let mut random = || DVec3::from_array(std::array::from_fn(|_| rng.random_range(0.1..0.9)));
        let (eye, target) = (b.min + random() * (b.max - b.min), b.min + random() * (b.max - b.min));
        let projection = [PERSPECTIVE, ORTHOGRAPHIC][turn % 2];
        let near = [None, Some(0.05), Some(1.0)][turn % 3];
        let cut = good(&mesh, &camera(eye, target, projection, near));
        assert!(!cut.tets.is_empty());
    }
}

#[test]
fn few_cells_of_a_large_mesh_are_cut() {
    let mesh = random_box(32, 6);
    let b = mesh.bounds_in_data();
    let mut rng = StdRng::seed_from_u64(4);
    for _ in 0..10 {
        let mut random = || DVec3::from_array(std::array::from_fn(|_| rng.random_range(0.1..0.9)));
        let (eye, target) = (b.min + random() * (b.max - b.min), b.min + random() * (b.max - b.min));
        let camera = camera(eye, target, Projection::Perspective { fov_y: 1.0 }, None);
        let start = std::time::Instant::now();
        let cut = cut(&mesh, &camera, ASPECT).expect("a cut");
        let took = start.elapsed();
        println!(
            "{} pieces and {} vertices of {} cells, {took:?}",
            cut.tets.len(),
            cut.vertices.len(),
            mesh.tets.len()
        );
        // Measured: 337 to 2,086.
        assert!((50..5_000).contains(&cut.tets.len()), "{}", cut.tets.len());
        check_vertices(&mesh, &camera, &cut).expect("sound");
        assert_eq!(unmatched_faces(&mesh, &camera, &cut), 0);
    }
}

#[test]
fn long_cells_before_the_eye_are_cut_at_several_depths() {
    // The mesh begins beyond the near plane: only the ratio of the depths cuts.
    let mesh = box_mesh(2, DVec3::ZERO, DVec3::ONE, affine);
    for (distance, count) in [(1e-2, 3), (0.1, 1), (0.4, 0)] {
        let eye = DVec3::new(0.45, 0.55, -distance);
        let camera = camera(eye, eye + DVec3::Z, Projection::Perspective { fov_y: 1.2 }, Some(1e-3));
        let Some(cut) = cut(&mesh, &camera, ASPECT) else {
            assert_eq!(count, 0, "from {distance}");
            continue;
        };
        check(&mesh, &camera, &cut).unwrap_or_else(|message| panic!("{message}, from {distance}"));
        let depths: std::collections::BTreeSet<i64> =
            cut.vertices.iter().map(|v| (depth(&mesh, &camera, v.position) * 1e9).round() as i64).collect();
        assert_eq!(depths.len(), count, "from {distance}: {depths:?}");
    }
}

#[test]
fn from_outside_there_is_nothing_to_cut() {
    let mesh = random_box(3, 2);
    let center = mesh.bounds_in_data().center();
    for direction in [DVec3::X, DVec3::NEG_Y, DVec3::new(0.3, -0.5, 0.8)] {
        for projection in [PERSPECTIVE, ORTHOGRAPHIC] {
            assert_eq!(cut(&mesh, &camera(center + 20.0 * direction, center, projection, None), ASPECT), None);
        }
    }
    // The box's corner is nearer than the plane, but no cell is: this mesh fills a corner of its box only.
    let points = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let mesh = tet_mesh(&points, vec![[0, 1, 2, 3]], affine);
    let from_corner = camera(DVec3::splat(1.0), DVec3::ZERO, ORTHOGRAPHIC, Some(0.5));
    assert_eq!(cut(&mesh, &from_corner, ASPECT), None);
    assert!(cut(&mesh, &Camera { near: Some(1.2), ..from_corner }, ASPECT).is_some());
}

#[test]
fn a_plane_on_a_side_of_the_box_leaves_it_whole() {
    let mesh = box_mesh(4, DVec3::ZERO, DVec3::ONE, affine);
    let at = |near| camera(DVec3::new(0.5, 0.5, -1.0), DVec3::new(0.5, 0.5, 0.0), PERSPECTIVE, Some(near));
    assert_eq!(cut(&mesh, &at(1.0), ASPECT), None);
    // A hair further: a slice is gone from each cell that touches the side.
    let cut = good(&mesh, &at(1.0 + 1e-9));
    let clipped = (0..mesh.tets.len()).filter(|&i| is_clipped(&cut, i)).count();
    assert_eq!(clipped, 6 * 16);
    // The other side: a slice is left, of each cell that touches it, and no cell is whole.
    let cut = good(&mesh, &at(2.0 - 1e-9));
    assert_eq!((0..mesh.tets.len()).filter(|&i| is_clipped(&cut, i)).count(), mesh.tets.len());
    assert!(!cut.tets.is_empty());
    // Exactly there, the vertices stay but no volume.
    let cut = good(&mesh, &at(2.0));
    assert_eq!((cut.tets.len(), cut.vertices.len()), (0, 0));
}

#[test]
fn vertices_exactly_on_the_plane_are_used_themselves() {
    let at = |eye: DVec3| camera(eye, eye + DVec3::Z, ORTHOGRAPHIC, Some(0.25));
    let eye = DVec3::new(0.5, 0.5, 0.25);
    let mesh = box_mesh(4, DVec3::ZERO, DVec3::ONE, affine);
    let cut = good(&mesh, &at(eye));
    assert_eq!((cut.tets.len(), cut.vertices.len()), (0, 0), "whole layers of cells on each side");
    assert_eq!((0..mesh.tets.len()).filter(|&i| is_clipped(&cut, i)).count(), mesh.tets.len() / 2);
    // Some vertices leave the plane: cells are cut through vertices, edges and faces of theirs.
    let mut rng = StdRng::seed_from_u64(8);
    for _ in 0..20 {
        let mut mesh = mesh.clone();
        for v in 0..mesh.vertices.len() {
            if mesh.vertices[v].abs().max_element() < 0.2 && rng.random_bool(0.5) {
                mesh.vertices[v].z += rng.random_range(-0.02..0.02);
            }
            let [s, g] = affine(mesh.data_from_mesh(mesh.vertices[v]));
            (mesh.scalar[v], mesh.gradient_magnitude[v]) = (s, g);
        }
        let cut = good(&mesh, &at(eye));
        let on_plane = |v: u32| (v as usize) < mesh.vertices.len() && mesh.vertices[v as usize].z == 0.0;
        assert!(cut.tets.iter().flatten().any(|&v| on_plane(v)), "vertices on the plane take part");
        assert!(!cut.vertices.is_empty());
        let places: std::collections::HashSet<_> =
            cut.vertices.iter().map(|v| v.position.to_array().map(f64::to_bits)).collect();
        assert_eq!(places.len(), cut.vertices.len(), "a vertex was made twice");
    }
}

#[test]
fn a_plane_beyond_the_mesh_leaves_nothing() {
    let mesh = random_box(3, 4);
    let b = mesh.bounds_in_data();
    let cut = good(&mesh, &camera(b.min - 1.0, b.center(), PERSPECTIVE, Some(3.0 * b.diagonal())));
    assert_eq!((cut.tets.len(), cut.vertices.len()), (0, 0));
    assert_eq!(cut.clipped.iter().map(|w| w.count_ones() as usize).sum::<usize>(), mesh.tets.len());
    // The same where the camera looks away.
    good(&mesh, &camera(b.max + 1.0, b.max + 2.0, ORTHOGRAPHIC, None));
}

#[test]
fn the_checks_reject_damaged_cuts() {
    let mesh = random_box(4, 5);
    let b = mesh.bounds_in_data();
    let camera = camera(b.center(), b.max, Projection::Perspective { fov_y: 2.0 }, None);
    let sound = good(&mesh, &camera);
    let rejected = |what: &str, damage: &dyn Fn(&mut NearCut)| {
        let mut damaged = sound.clone();
        damage(&mut damaged);
        let message = check(&mesh, &camera, &damaged).expect_err(what);
        assert!(message.contains(what), "{what}: {message}");
    };
    let middle = sound.tets.len() / 2;
    rejected("volume", &|cut| {
        cut.tets.remove(middle);
    });
    rejected("has the volume", &|cut| cut.tets[middle].swap(0, 1));
    rejected("marked wrongly", &|cut| cut.clipped[1] ^= 16);
    rejected("instead of", &|cut| cut.vertices[7].scalar += 1e-12);
    rejected("instead of", &|cut| cut.vertices[7].gradient_magnitude += 1e-12);
    rejected("off the nearest plane", &|cut| {
        // Along the field's contour, so that only the plane tells.
        let along = DVec3::new(2.0, -1.0, 0.5).cross(camera.basis().right).normalize();
        cut.vertices.push(cut.vertices[0]);
        cut.vertices[0].position += 1e-14 * along;
    });
    // Whole cells among the pieces: the eye's, and one behind the eye.
    let depths = |tet: &[u32; 4]| tet.map(|v| depth(&mesh, &camera, mesh.vertices[v as usize]));
    let long =
        mesh.tets.iter().find(|tet| depths(tet).iter().any(|&z| z < 0.0) && depths(tet).iter().any(|&z| z > 0.1));
    rejected("in one", &|cut| cut.tets.push(*long.expect("a long cell")));
    let behind = mesh.tets.iter().find(|tet| depths(tet).iter().all(|&z| z < -0.1));
    rejected("out of sight", &|cut| cut.tets.push(*behind.expect("a cell behind the eye")));
    // An edge that two cells cut each for itself.
    rejected("no partner", &|cut| {
        let id = (mesh.vertices.len() + cut.vertices.len()) as u32;
        let in_sight =
            |tet: &[u32; 4]| tet.iter().all(|&v| may_be_seen(&mesh, &camera, &[position(&mesh, &sound, v)], 0.0));
        let made = |tet: &[u32; 4]| tet.iter().position(|&v| v as usize >= mesh.vertices.len());
        let piece = (0..cut.tets.len()).rfind(|&i| in_sight(&cut.tets[i]) && made(&cut.tets[i]).is_some());
        let tet = &mut cut.tets[piece.expect("a piece in sight")];
        let v = &mut tet[made(tet).expect("a vertex made")];
        cut.vertices.push(cut.vertices[*v as usize - mesh.vertices.len()]);
        *v = id;
    });
}
