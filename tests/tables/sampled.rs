//! The committed samples are those of the generator, and look-ups read them right.

use std::path::Path;

use tetralux::tables::{Axis, Difference, Interpolation, Kind, Table2, generate, index};

fn file(name: &str) -> Vec<u8> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tables").join(name);
    std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

#[test]
fn files_are_what_is_generated() {
    for kind in Kind::ALL {
        let generated = generate(kind);
        let difference = generated.compare(&file(&format!("{}.f32", kind.name()))).expect("a file of this size");
        println!("{}: {difference:?}", kind.name());
        assert!(difference.units <= Difference::TOLERATED, "{}: {difference:?}", kind.name());
        // On one machine every run gives the same bytes, in whatever order threads finish.
        assert_eq!(generated.bytes(), generate(kind).bytes(), "{}", kind.name());
        // What is built in is the file.
        assert_eq!(kind.table().compare(&file(&format!("{}.f32", kind.name()))).expect("a file").values, 0);
    }
    assert_eq!(String::from_utf8(file("index.json")).expect("text"), index());
}

#[test]
fn planted_differences_are_found() {
    let table = Kind::ArchK.table();
    let at = 1234;
    let with = |value: f32| Table2 {
        values: table.values.iter().enumerate().map(|(i, &v)| if i == at { value } else { v }).collect(),
        ..table.clone()
    };
    let old = table.values[at];
    for (new, units) in [(old.next_up(), 1), (old.next_down(), 1), (old.next_up().next_up(), 2), (f32::NAN, u32::MAX)] {
        let found = table.compare(&with(new).bytes()).expect("the same size");
        assert_eq!(found, Difference { values: 1, units, node: [at % 256, at / 256] });
        assert_eq!(units > Difference::TOLERATED, units > 1);
    }
    // From the one sign to the other, over both zeros.
    let (plus, minus) = (with(f32::from_bits(2)), with(-f32::from_bits(3)));
    assert_eq!(plus.compare(&minus.bytes()).expect("the same size").units, 6);
    assert_eq!(table.compare(&table.bytes()).expect("the same size").values, 0);
    for bytes in [&table.bytes()[1..], &table.bytes()[4..], &[]] {
        let message = table.compare(bytes).expect_err("another size").to_string();
        assert!(message.contains("arch_k") && message.contains("262144"), "{message}");
    }
    // A wrong formula would be seen as well.
    let other = Kind::CosineK.table().bytes();
    assert!(table.compare(&other).expect("the same size").values > 60_000);
}

#[test]
fn axes_are_inverted_by_their_positions() {
    let mut single = 0.0f64;
    for axis in [
        Axis::Linear { from: -4.0, to: 4.0 },
        Axis::LogOnePlus { most: 1e3 },
        Axis::InverseFourthRoot,
        Axis::Linear { from: 0.0, to: 1e-3 },
    ] {
        for i in 0..=1000 {
            let position = f64::from(i) / 1000.0;
            let argument = axis.argument(position);
            let error = (axis.position(argument) - position).abs();
            assert!(error <= 1e-15, "{axis:?} {position} {error:e}");
            single = single.max((f64::from(axis.position_f32(argument as f32)) - position).abs());
        }
        assert!(axis.position(f64::NAN).is_nan() && axis.position_f32(f32::NAN).is_nan());
        assert_eq!([axis.position(-1e30), axis.position(f64::INFINITY)], [0.0, 1.0]);
        assert_eq!([axis.position_f32(-1e30), axis.position_f32(f32::INFINITY)], [0.0, 1.0]);
    }
    println!("positions in f32: {single:.1e}");
    // Measured: 9.9e-8.
    assert!(single <= 1.5e-7, "{single:e}");
}

/// A polynomial over [0, 1]^2 sampled on a small table, and its largest error between nodes.
fn worst(f: impl Fn(f64, f64) -> f64, interpolation: Interpolation) -> f64 {
    let unit = Axis::Linear { from: 0.0, to: 1.0 };
    let table = Table2::sample("polynomial", [7, 5], [unit; 2], &f).expect("enough nodes");
    let mut worst = 0.0f64;
    for i in 0..=60 {
        for j in 0..=60 {
            let (x, y) = (f64::from(i) / 60.0, f64::from(j) / 60.0);
            let exact = (table.lookup([x, y], interpolation) - f(x, y)).abs();
            let single = (f64::from(table.lookup_f32([x as f32, y as f32], interpolation)) - f(x, y)).abs();
            worst = worst.max(exact).max(single);
        }
    }
    worst
}

#[test]
fn lookups_reproduce_the_polynomials_they_should() {
    // Values are f32 of size 4 at most; measured: 5.7e-7.
    let rounding = 1e-6;
    let bilinear = |x: f64, y: f64| 1.0 + x - 2.0 * y + 0.5 * x * y;
    let parabola = |x: f64, y: f64| bilinear(x, y) + x * x - 0.7 * y * y + x * x * y * y;
    println!(
        "rounding: {:.1e} {:.1e}",
        worst(bilinear, Interpolation::Bilinear),
        worst(parabola, Interpolation::Cubic)
    );
    assert!(worst(bilinear, Interpolation::Bilinear) < rounding);
    assert!(worst(parabola, Interpolation::Cubic) < rounding);
    // And no more than these.
    assert!(worst(parabola, Interpolation::Bilinear) > 1e-3);
    assert!(worst(|x, _| x * x * x, Interpolation::Cubic) > 1e-4);
}

#[test]
fn ends_of_the_tables_are_exact() {
    for interpolation in [Interpolation::Bilinear, Interpolation::Cubic] {
        // An empty cell is clear; an infinitely dense end hides all; a piece beyond an axis is that at its end.
        let psi = Kind::Psi.table();
        assert_eq!(psi.lookup_f32([0.0; 2], interpolation), 1.0);
        for dense in [[f32::INFINITY, 0.0], [0.0, f32::INFINITY], [f32::INFINITY; 2]] {
            assert_eq!(psi.lookup_f32(dense, interpolation), 0.0, "{dense:?}");
        }
        assert!(psi.lookup([f64::NAN, 0.0], interpolation).is_nan());
        let gaussian = Kind::GaussianJ.table();
        assert_eq!(gaussian.lookup_f32([0.0, -4.0], interpolation), 8.0);
        assert_eq!(gaussian.lookup_f32([1e3, 9.0], interpolation), gaussian.lookup_f32([1e3, 4.0], interpolation));
        for kind in [Kind::GaussianJ, Kind::ArchK, Kind::CosineK] {
            let Axis::Linear { to, .. } = kind.axes()[1] else { panic!("{kind:?}") };
            for strength in [0.0, 1.0, 1e3] {
                assert_eq!(kind.table().lookup_f32([strength, to as f32], interpolation), 0.0, "{kind:?}");
            }
        }
    }
    Table2::sample("few", [3, 9], [Axis::InverseFourthRoot; 2], |_, _| 0.0).expect_err("too few for a cubic");
}
