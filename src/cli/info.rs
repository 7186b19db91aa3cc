//! `tetralux info`: what a mesh holds, and what became of its cells.

use std::fmt::Write as _;

use serde::Serialize;

use super::args::InfoArgs;
use super::{load, output, progress};
use crate::mesh::{ArrayChoice, Association, DataArray};
use crate::plan::order::{Inversions, PowerCensus, PowerOrder, sampled_inversions};
use crate::space::{Bounds, Interval};
use crate::tet::{Adjacency, Census, TetMesh, TopologyCensus};

pub(super) fn run(args: &InfoArgs) -> anyhow::Result<()> {
    let mesh = load::mesh(&args.source, ArrayChoice::All)?;
    let arrays: Vec<ArrayRange> = mesh.arrays.iter().map(ArrayRange::of).collect();
    let bounds = Bounds::of(mesh.points.iter().copied());
    let (tet_mesh, census) = load::cut(mesh, &args.source, args.field.as_deref())?;
    let (topology, power) = progress::step("examining", || {
        let adjacency = Adjacency::new(&tet_mesh);
        (Census::topology(&tet_mesh, &adjacency), PowerKey::new(&tet_mesh, &adjacency))
    });
    let report = Info::new(arrays, bounds, &tet_mesh, &census, (&topology, power));
    let text = if args.json { serde_json::to_string_pretty(&report)? } else { report.text() };
    output::say(&text)?;
    Ok(())
}

#[derive(Serialize)]
struct ArrayRange {
    name: String,
    /// `point` or `cell`.
    on: &'static str,
    components: usize,
    /// Of the values, or of the tuples' Euclidean norms; none where nothing is finite.
    min: Option<f64>,
    max: Option<f64>,
}

impl ArrayRange {
    fn of(array: &DataArray) -> Self {
        let tuples = array.values.chunks_exact(array.components);
        let range = match array.components {
            1 => Interval::of(array.values.iter().copied()),
            _ => Interval::of(tuples.map(|t| t.iter().map(|v| v * v).sum::<f64>().sqrt())),
        };
        let on = match array.association {
            Association::Point => "point",
            Association::Cell => "cell",
        };
        let finite = |v: f64| v.is_finite().then_some(v);
        Self {
            name: array.name.clone(),
            on,
            components: array.components,
            min: finite(range.min),
            max: finite(range.max),
        }
    }
}

/// What `--order power` is worth on this mesh.
#[derive(Clone, Copy, Serialize)]
struct PowerKey {
    /// The order is right for every eye.
    proved: bool,
    /// Seen from so many eyes around and inside.
    eyes: usize,
    /// Neighbours, eye by eye.
    pairs: u64,
    /// Those that the key puts in the wrong order.
    wrong: u64,
}

impl PowerKey {
    const EYES: usize = 8;

    fn new(mesh: &TetMesh, adjacency: &Adjacency) -> Self {
        let census = PowerCensus::new(mesh, adjacency);
        let order = PowerOrder::new(mesh, &census.metric);
        let of_eye = |camera: &_| order.order(mesh, camera);
        let Inversions { pairs, wrong } = sampled_inversions(mesh, adjacency, Self::EYES, of_eye);
        Self { proved: census.is_exact(), eyes: Self::EYES, pairs, wrong }
    }
}

#[derive(Serialize)]
struct Info<'a> {
    bounds: [[f64; 3]; 2],
    arrays: Vec<ArrayRange>,
    scalar_range: [f64; 2],
    gradient_range: [f64; 2],
    census: &'a Census,
    convex: bool,
    delaunay: bool,
    topology: &'a TopologyCensus,
    power_key: PowerKey,
}

impl<'a> Info<'a> {
    fn new(
        arrays: Vec<ArrayRange>,
        bounds: Bounds,
        mesh: &TetMesh,
        census: &'a Census,
        (topology, power_key): (&'a TopologyCensus, PowerKey),
    ) -> Self {
        let (s, g) = (mesh.scalar_range(), mesh.gradient_range());
        Self {
            bounds: [bounds.min.to_array(), bounds.max.to_array()],
            arrays,
            scalar_range: [s.min, s.max],
            gradient_range: [g.min, g.max],
            census,
            convex: topology.is_convex(),
            delaunay: topology.is_delaunay(),
            topology,
            power_key,
        }
    }

    fn text(&self) -> String {
        // Writing to a string does not fail.
        let mut text = String::new();
        let [[x0, y0, z0], [x1, y1, z1]] = self.bounds;
        let _ = writeln!(text, "bounds    x {x0} .. {x1}   y {y0} .. {y1}   z {z0} .. {z1}");
        for array in &self.arrays {
            let _ = write!(text, "array     {} ({}", array.name, array.on);
            let _ = match array.components {
                1 => write!(text, ")"),
                n => write!(text, ", {n} components, norms"),
            };
            let end = if array.components == 1 { "" } else { ")" };
            let _ = match (array.min, array.max) {
                (Some(min), Some(max)) => writeln!(text, "{end}  {min} .. {max}"),
                _ => writeln!(text, "{end}  nothing finite"),
            };
        }
        let _ = writeln!(text, "\n{}", self.census);
        let _ = writeln!(text, "scalar               {} .. {}", self.scalar_range[0], self.scalar_range[1]);
        let _ = writeln!(text, "gradient magnitude   {} .. {}\n", self.gradient_range[0], self.gradient_range[1]);
        let _ = writeln!(text, "{}", self.topology);
        let PowerKey { proved, eyes, pairs, wrong } = self.power_key;
        let share = 100.0 * wrong as f64 / pairs.max(1) as f64;
        let proved = if proved { "right for every eye" } else { "not known to be right" };
        let _ = write!(text, "--order power        {proved}; {share:.3} % of neighbours wrong from {eyes} eyes");
        text
    }
}
