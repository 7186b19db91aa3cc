//! What an order is, and that wrong ones are seen.

use glam::DVec3;
use tetralux::plan::order::{Metric, PowerOrder, VisibilityOrder, sample_cameras};
use tetralux::tet::Adjacency;

use crate::common::boxes::tet_mesh;
use crate::support::{delaunay, fields};

#[test]
fn the_largest_key_comes_first_and_of_equal_ones_the_smaller_id() {
    let order = VisibilityOrder::by_keys(&[1.0, 3.0, -2.0, 3.0, f64::INFINITY, -0.0, 0.0, 3.0]);
    assert_eq!(order.cells(), [4, 1, 3, 7, 0, 6, 5, 2]);
    assert_eq!(order.ranks(), [4, 1, 7, 2, 0, 6, 5, 3]);
    let keys: Vec<f64> = (0..100_000_u32).map(|i| f64::from(i.wrapping_mul(2_654_435_761) % 1000) - 500.0).collect();
    let order = VisibilityOrder::by_keys(&keys);
    for pair in order.cells().windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|i| keys[i as usize]);
        assert!(a > b || (a == b && pair[0] < pair[1]));
    }
    assert_eq!(VisibilityOrder::new(order.cells().to_vec()).expect("a permutation"), order);
}

#[test]
fn lists_that_are_no_permutation_are_refused() {
    assert_eq!(VisibilityOrder::new(vec![2, 0, 1]).expect("a permutation").ranks(), [1, 2, 0]);
    assert!(VisibilityOrder::new(Vec::new()).is_ok());
    for (cells, what) in [(vec![0, 2, 2], "cell 2, at place 2, comes twice"), (vec![0, 3, 1], "cell 3, at place 1")] {
        let error = VisibilityOrder::new(cells).expect_err("no permutation").to_string();
        assert!(error.contains(what), "{error}");
    }
}

#[test]
fn one_reversed_pair_is_one_inversion() {
    let mesh = delaunay(1);
    let adjacency = Adjacency::new(&mesh);
    let power = PowerOrder::new(&mesh, &Metric::IDENTITY);
    for camera in sample_cameras(&mesh, 6) {
        let order = power.order(&mesh, &camera);
        let right = order.inversions(&mesh, &adjacency, &camera);
        assert_eq!((right.wrong, right.share()), (0, 0.0));
        let are_neighbors = |pair: &[u32]| adjacency.neighbors[pair[0] as usize].contains(&pair[1]);
        let mut tried = 0;
        for place in (0..order.cells().len() - 1).filter(|&i| are_neighbors(&order.cells()[i..i + 2])).take(20) {
            let mut cells = order.cells().to_vec();
            cells.swap(place, place + 1);
            let wrong = VisibilityOrder::new(cells).expect("a permutation").inversions(&mesh, &adjacency, &camera);
            assert_eq!((wrong.pairs, wrong.wrong), (right.pairs, 1));
            tried += 1;
        }
        assert!(tried > 5, "{tried} neighbours follow one another");
        let reversed: Vec<u32> = order.cells().iter().rev().copied().collect();
        let all = VisibilityOrder::new(reversed).expect("a permutation").inversions(&mesh, &adjacency, &camera);
        assert_eq!((all.wrong, all.share()), (all.pairs, 1.0));
    }
}

#[test]
fn overlapping_neighbors_have_no_order() {
    let points = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, 2.0 * DVec3::Z, -DVec3::Z];
    let beyond = tet_mesh(&points, vec![[0, 1, 2, 3], [0, 2, 1, 5]], fields);
    let folded = tet_mesh(&points, vec![[0, 1, 2, 3], [0, 1, 2, 4]], fields);
    for (mesh, pairs) in [(beyond, 1), (folded, 0)] {
        let adjacency = Adjacency::new(&mesh);
        for camera in sample_cameras(&mesh, 12) {
            let sum = VisibilityOrder::by_keys(&[0.0, 1.0]).inversions(&mesh, &adjacency, &camera);
            assert_eq!(sum.pairs, pairs, "{camera:?}");
        }
    }
}
