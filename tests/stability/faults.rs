//! What the suite has to catch: an integral 1 % wrong, an order reversed, a cell dropped, a picture that is none.

use std::sync::Arc;

use glam::DVec3;
use tetralux::image::Image;
use tetralux::oracle::Oracle;
use tetralux::plan::order::centroid_depth;
use tetralux::renderer::OrderMethod;
use tetralux::report::stability::{Case, Entrant, Shot, Trial, Verdict, cases};
use tetralux::scene::TransferFunction;
use tetralux::tet::TetMesh;

const CPU: Entrant = Entrant::Cpu(tetralux::renderer::SegmentIntegral::Adaptive { tolerance: 1e-3 });

fn case(name: &str) -> Case {
    cases::all().into_iter().find(|case| case.name == name).unwrap_or_else(|| panic!("no case {name}"))
}

/// Whether a fault in what is drawn is caught at one of the case's values, the middle ones first.
fn is_caught(case: &Case, fault: impl Fn(&Shot) -> Shot) -> bool {
    let mut values: Vec<(usize, f64)> = case.values.iter().copied().enumerate().collect();
    values.sort_by_key(|(i, _)| i.abs_diff(case.values.len() / 2));
    values.into_iter().any(|(_, value)| {
        let trial = Trial::new(case, value).expect("a trial");
        let got = CPU.draw(&fault(&trial.shot), None);
        matches!(trial.judge(CPU, &got).verdict, Verdict::Fails { .. })
    })
}

fn denser(shot: &Shot) -> Shot {
    let mut transfer = shot.transfer.clone();
    match &mut transfer {
        TransferFunction::Widgets(widgets) => widgets.iter_mut().for_each(|widget| widget.extinction *= 1.01),
        TransferFunction::Curve(curve) => curve.nodes.iter_mut().for_each(|node| node.extinction *= 1.01),
    }
    Shot { transfer, ..shot.clone() }
}

#[test]
fn an_integral_one_percent_wrong_is_caught_in_every_case() {
    for case in cases::all() {
        assert!(is_caught(&case, denser), "{}", case.name);
    }
}

/// Without the cell that lies nearest to a place between the eye and the middle of what is seen.
fn without_a_cell(shot: &Shot) -> Shot {
    let mut mesh = TetMesh::clone(&shot.mesh);
    let bounds = mesh.bounds_in_data();
    let towards = (shot.camera.eye - bounds.center()).clamp_length_max(0.25 * bounds.diagonal());
    let place = mesh.mesh_from_data(bounds.center() + towards);
    let middle = |tet: &[u32; 4]| tet.map(|v| mesh.vertices[v as usize]).iter().sum::<DVec3>() / 4.0;
    let far = |i: &usize| middle(&mesh.tets[*i]).distance(place);
    let nearest = (0..mesh.tets.len()).min_by(|i, j| far(i).total_cmp(&far(j))).expect("cells");
    Arc::make_mut(&mut mesh.tets).swap_remove(nearest);
    Shot { mesh: Arc::new(mesh), ..shot.clone() }
}

#[test]
fn a_dropped_cell_is_caught() {
    for name in [
        "narrow-gaussian",
        "narrow-tent",
        "optical-depth",
        "optical-depth-colours",
        "entry-is-exit",
        "slivers",
        "needles",
        "eye-at-face",
        "eye-far",
        "offset",
        "scalars",
        "tunnels",
        "cycle",
        "perspective",
    ] {
        assert!(is_caught(&case(name), without_a_cell), "{name}");
    }
}

#[test]
fn a_reversed_order_is_caught() {
    for name in ["tunnels", "cycle", "narrow-gaussian", "layers", "offset"] {
        let case = case(name);
        let trial = Trial::new(&case, case.values[0]).expect("a trial");
        let (mesh, frame) = (&trial.shot.mesh, trial.shot.frame());
        let keys: Vec<f64> = centroid_depth(mesh, &trial.shot.camera).into_iter().map(|depth| -depth).collect();
        let reversed = Oracle::new(Arc::clone(mesh)).render_in_order(&frame, &keys);
        let entrant = Entrant::Project(OrderMethod::Auto);
        let outcome = trial.judge(entrant, &reversed);
        assert!(matches!(outcome.verdict, Verdict::Fails { .. }), "{name}: {outcome:?}");
    }
}

/// Whatever is known of a case excuses neither.
#[test]
fn pictures_that_are_none_are_caught() {
    for case in cases::all() {
        let trial = Trial::new(&case, case.values[0]).expect("a trial");
        let mut spoilt = trial.want.clone();
        let middle = spoilt.pixels.len() / 2;
        spoilt.pixels[middle][0] = f32::NAN;
        let black = Image::new(trial.want.width, trial.want.height);
        for entrant in Entrant::on_host(&[]).expect("one").into_iter().chain(Entrant::ON_DEVICE) {
            for got in [&spoilt, &black] {
                let verdict = trial.judge(entrant, &Ok(got.clone())).verdict;
                assert!(matches!(verdict, Verdict::Fails { .. }), "{}, {entrant}: {verdict}", case.name);
            }
            assert_eq!(trial.judge(entrant, &Ok(trial.want.clone())).verdict, Verdict::Pass);
        }
    }
}
