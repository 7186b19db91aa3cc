//! Meshes, cameras and functions that the cases are made of.

use std::sync::Arc;

use glam::DVec3;

use crate::error::Result;
use crate::mesh::{ArrayInfo, Association, CellKind, DataArray, Mesh, Topology, synth};
use crate::scene::{Camera, Curve, CurveNode, Projection, TransferFunction, Widget, WidgetShape};
use crate::space::Interval;
use crate::tet::{BuildOptions, FieldChoice, TetMesh};

/// Two colours that differ in all channels.
pub const ORANGE: [f64; 3] = [1.0, 0.6, 0.1];
/// See [`ORANGE`].
pub const BLUE: [f64; 3] = [0.1, 0.3, 1.0];
/// A third one.
pub const GREEN: [f64; 3] = [0.2, 0.9, 0.4];

/// Points, cells and a scalar at every point.
#[derive(Clone, Debug, Default)]
pub struct Cells {
    /// Data space.
    pub points: Vec<DVec3>,
    /// Four points each.
    pub tets: Vec<[u32; 4]>,
    /// One a point.
    pub values: Vec<f64>,
}

impl Cells {
    /// The box [-1, 1]^3 of `n^3` cubes, inner points moved by `jitter` of a cube.
    pub fn of_box(n: usize, jitter: f64, field: impl Fn(DVec3) -> f64) -> Self {
        let Mesh { points, topology, .. } = synth::tet_box(n, jitter, 1);
        let nodes = match topology {
            Topology::Cells { nodes, .. } => nodes,
            Topology::Structured { .. } => Vec::new(),
        };
        let tets = nodes.chunks_exact(4).map(|t| [t[0], t[1], t[2], t[3]]).collect();
        let values = points.iter().map(|&p| field(p)).collect();
        Self { points, tets, values }
    }

    /// The same in other places; the field stays with the points.
    #[must_use]
    pub fn moved(mut self, place: impl Fn(DVec3) -> DVec3) -> Self {
        self.points.iter_mut().for_each(|p| *p = place(*p));
        self
    }

    /// Without the cells whose centre is not kept.
    #[must_use]
    pub fn kept(mut self, keep: impl Fn(DVec3) -> bool) -> Self {
        let points = &self.points;
        self.tets.retain(|tet| keep(tet.iter().map(|&v| points[v as usize]).sum::<DVec3>() / 4.0));
        self
    }

    /// Every cell cut into four around a point of these weights in it: the same field in other cells.
    #[must_use]
    pub fn split(mut self, weights: [f64; 4]) -> Self {
        for [a, b, c, d] in std::mem::take(&mut self.tets) {
            let middle = self.points.len() as u32;
            let corners = [a, b, c, d].map(|v| v as usize);
            self.points.push((0..4).map(|k| weights[k] * self.points[corners[k]]).sum());
            self.values.push((0..4).map(|k| weights[k] * self.values[corners[k]]).sum());
            self.tets.extend([[middle, b, c, d], [a, middle, c, d], [a, b, middle, d], [a, b, c, middle]]);
        }
        self
    }

    /// As a file's mesh would be taken.
    pub fn mesh(self) -> Result<Arc<TetMesh>> {
        let available = vec![ArrayInfo { name: "s".into(), association: Association::Point, components: 1 }];
        let array = DataArray { name: "s".into(), association: Association::Point, components: 1, values: self.values };
        let topology =
            Topology::Cells { kinds: vec![CellKind::Tetrahedron; self.tets.len()], nodes: self.tets.concat() };
        let mesh = Mesh { points: self.points, topology, arrays: vec![array], available, notes: Vec::new() };
        Ok(Arc::new(TetMesh::new(mesh, &FieldChoice::parse("s"), BuildOptions::default())?.0))
    }
}

/// A smooth field without symmetry; its gradient is about 1.3.
pub fn hills(p: DVec3) -> f64 {
    p.x + 0.4 * (2.0 * p.y).sin() + 0.3 * p.z * p.z
}

/// From outside, all of it.
pub fn outside(mesh: &TetMesh) -> Camera {
    seen(mesh, Projection::Perspective { fov_y: 0.6 })
}

/// The same by another lens.
pub fn seen(mesh: &TetMesh, projection: Projection) -> Camera {
    Camera::fit(&mesh.bounds_in_data(), 1.0, [0.7, 0.45], 1.2, projection)
}

/// The mean range of the scalar in a cell.
pub fn cell_range(mesh: &TetMesh) -> f64 {
    let of = |tet: &[u32; 4]| Interval::of(tet.map(|v| mesh.scalar[v as usize])).length();
    mesh.tets.iter().map(of).sum::<f64>() / mesh.tets.len() as f64
}

/// A Gaussian over the scalar, so wide over the gradient that this counts for nothing.
pub fn gaussian(mesh: &TetMesh, center: f64, sigma: f64, color: [f64; 3], extinction: f64) -> Widget {
    let across = 1e3 * mesh.gradient_range().max.max(f64::MIN_POSITIVE);
    let shape = WidgetShape::Gaussian { center: [center, 0.0], sigma: [sigma, across], angle: 0.0 };
    Widget::new(shape, color, extinction)
}

/// Two Gaussians of two colours over the mesh's range. `depth`: about what a ray through all of the mesh has.
pub fn pair(mesh: &TetMesh, depth: f64) -> TransferFunction {
    let range = mesh.scalar_range();
    let extinction = 2.0 * depth / mesh.bounds_in_data().diagonal();
    let at = |share: f64| range.min + share * range.length();
    let widget = |share, color| gaussian(mesh, at(share), 0.13 * range.length(), color, extinction);
    TransferFunction::Widgets(vec![widget(0.31, ORANGE), widget(0.63, BLUE)])
}

/// Thin bands whose colours differ so much that any exchange of cells is seen. `depth` as for [`pair`].
pub fn bands(mesh: &TetMesh, count: u32, depth: f64) -> TransferFunction {
    let range = mesh.scalar_range();
    let (half_width, peak) = (0.1 / f64::from(count), 10.0 * depth / mesh.bounds_in_data().diagonal());
    let band = |i: u32| {
        let middle = (f64::from(i) + 0.5) / f64::from(count);
        let color = [ORANGE, BLUE, GREEN][i as usize % 3];
        [(-half_width, 0.0), (0.0, peak), (half_width, 0.0)].map(|(off, extinction)| CurveNode {
            scalar: range.min + (middle + off) * range.length(),
            color,
            extinction,
        })
    };
    TransferFunction::Curve(Curve { nodes: (0..count).flat_map(band).collect() })
}
