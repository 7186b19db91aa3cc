//! How good each order is for real meshes, and what it costs.

use std::time::Instant;

use tetralux::mesh::synth::Sample;
use tetralux::plan::order::{
    Inversions, PowerCensus, PowerOrder, Sequenced, VisibilityOrder, centroid_depth, exact, mpvonc, sample_cameras,
};
use tetralux::scene::Camera;
use tetralux::tet::{Adjacency, TetMesh};

use crate::common::{folder, meshes};

const SIZE: [u32; 2] = [1024, 1024];

type Maker<'a> = Box<dyn Fn(&Camera) -> Sequenced + 'a>;

/// Prints all numbers, and asks for what orders by walking promise.
fn measure(name: &str, mesh: &TetMesh, cameras: usize) {
    let start = Instant::now();
    let adjacency = Adjacency::new(mesh);
    println!("{name}: {} cells, adjacency {:.0?}", mesh.tets.len(), start.elapsed());
    let start = Instant::now();
    let census = PowerCensus::new(mesh, &adjacency);
    let power = PowerOrder::new(mesh, &census.metric);
    println!("census and power rows {:.0?}\n{census}", start.elapsed());
    let keyed = |order| Sequenced { order, cycles: 0 };
    let orders: [(&str, Maker<'_>); 4] = [
        ("centroid", Box::new(|camera| keyed(VisibilityOrder::by_keys(&centroid_depth(mesh, camera))))),
        ("power", Box::new(|camera| keyed(power.order(mesh, camera)))),
        ("mpvonc", Box::new(|camera| mpvonc(mesh, &adjacency, camera))),
        ("exact", Box::new(|camera| exact(mesh, &adjacency, camera, SIZE))),
    ];
    for (order_name, order) in &orders {
        let (mut sum, mut cycles, mut times) = (Inversions::default(), 0, Vec::new());
        for camera in sample_cameras(mesh, cameras) {
            let start = Instant::now();
            let sequenced = order(&camera);
            times.push(start.elapsed());
            let one = sequenced.order.inversions(mesh, &adjacency, &camera);
            (sum, cycles) = (sum + one, cycles + sequenced.cycles);
            if ["mpvonc", "exact"].contains(order_name) {
                assert!(one.wrong <= sequenced.cycles, "{one:?} {}", sequenced.cycles);
            }
        }
        times.sort();
        let median = times[times.len() / 2];
        println!(
            "  {order_name:<9} wrong {:.3e} ({} of {}), cycles {cycles} in {cameras} views, median {median:.0?}",
            sum.share(),
            sum.wrong,
            sum.pairs
        );
    }
}

fn measure_file(file: &str, array: &str) {
    let mesh = meshes::read(&folder("TETRALUX_DATA").join("tet").join(file), array);
    measure(file, &mesh, 12);
}

#[test]
#[ignore = "needs TETRALUX_DATA"]
fn blunt_fin() {
    measure_file("bluntfin_tet.vtu", "Density");
}

#[test]
#[ignore = "needs TETRALUX_DATA"]
fn post() {
    measure_file("post_tet.vtu", "StagnationEnergy");
}

#[test]
#[ignore = "takes a minute"]
fn two_million_cells() {
    measure("tangle", &meshes::sample(Sample::Tangle, 2_000_000), 3);
}
