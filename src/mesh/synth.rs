//! Procedural meshes with analytic fields: `(value, gradient)` is known everywhere, so reconstruction can be measured.
//!
//! Everything is deterministic: the same request gives the same bits on every machine's f64.

mod field;
mod shape;

use std::str::FromStr;

use glam::DVec3;

use super::{ArrayInfo, Association, DataArray, Mesh};
use crate::error::{Error, Result};

pub use shape::{box_grid, tet_box};

/// A named procedural mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sample {
    /// Marschner and Lobb's test signal (1994: fM = 6, alpha = 0.25) on a jittered tetrahedral box [-1, 1]^3; array `ml`.
    MarschnerLobb,
    /// Density of hydrogen's 3d (m = 0) orbital over its maximum, on a jittered tetrahedral box of half-width 18 Bohr
    /// radii; array `density`.
    Hydrogen,
    /// Potential flow along x past the unit sphere, on hexahedra between the sphere and radius 8, finer near the
    /// sphere; arrays `cp` (pressure coefficient, the analytic field) and `U` (velocity over the free stream's).
    SphereFlow,
    /// The tangle quartic `sum(x^4 - 5 x^2) + 11.8` on a jittered tetrahedral box [-3, 3]^3; array `tangle`.
    Tangle,
}

impl Sample {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::MarschnerLobb, Self::Hydrogen, Self::SphereFlow, Self::Tangle];

    /// What users call it; [`FromStr`] reads it back.
    pub const fn name(self) -> &'static str {
        match self {
            Self::MarschnerLobb => "marschner-lobb",
            Self::Hydrogen => "hydrogen",
            Self::SphereFlow => "sphere-flow",
            Self::Tangle => "tangle",
        }
    }

    /// Name of the array that holds [`Sample::field`].
    pub const fn array(self) -> &'static str {
        match self {
            Self::MarschnerLobb => "ml",
            Self::Hydrogen => "density",
            Self::SphereFlow => "cp",
            Self::Tangle => "tangle",
        }
    }

    /// The mesh nearest to `tets` tetrahedra that the construction allows (hexahedra count six), with its point arrays.
    pub fn mesh(self, tets: usize) -> Mesh {
        let mut mesh = match self {
            Self::SphereFlow => shape::sphere_shell(shape::per_axis(tets, 36), field::FLOW_RADIUS),
            _ => self.jittered_box(tets),
        };
        let values = mesh.points.iter().map(|&p| self.field(p).0).collect();
        add_point_array(&mut mesh, self.array(), 1, values);
        if self == Self::SphereFlow {
            let velocity = mesh.points.iter().flat_map(|&p| field::flow_velocity(p).to_array()).collect();
            add_point_array(&mut mesh, "U", 3, velocity);
        }
        mesh
    }

    /// Value and gradient (per unit of data length) of the array [`Sample::array`] at `p`, data space.
    ///
    /// [`Sample::SphereFlow`] is defined outside the unit sphere.
    pub fn field(self, p: DVec3) -> (f64, DVec3) {
        match self {
            Self::MarschnerLobb => field::marschner_lobb(p),
            Self::Hydrogen => field::hydrogen(p),
            Self::SphereFlow => field::flow_pressure(p),
            Self::Tangle => field::tangle(p),
        }
    }

    fn jittered_box(self, tets: usize) -> Mesh {
        let half_width = match self {
            Self::Hydrogen => 18.0,
            Self::Tangle => 3.0,
            _ => 1.0,
        };
        let mut mesh = tet_box(shape::per_axis(tets, 6), 0.15, 1);
        mesh.points.iter_mut().for_each(|p| *p *= half_width);
        mesh.arrays.clear();
        mesh.available.clear();
        mesh
    }
}

impl FromStr for Sample {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        Self::ALL.into_iter().find(|s| s.name() == name).ok_or_else(|| {
            let names: Vec<_> = Self::ALL.iter().map(|s| s.name()).collect();
            Error::Asked(format!("no sample mesh is called {name:?}: there are {}", names.join(", ")))
        })
    }
}

fn add_point_array(mesh: &mut Mesh, name: &str, components: usize, values: Vec<f64>) {
    mesh.available.push(ArrayInfo { name: name.into(), association: Association::Point, components });
    mesh.arrays.push(DataArray { name: name.into(), association: Association::Point, components, values });
}
