//! Functions of two arguments that shaders look up: what they are, on which axes, and their committed samples.
//!
//! The files under `tables/` are made by `tetralux tables` ([`generate`]) and never edited; `tables/README.md` says what
//! each means and how far a look-up is from the truth. Nothing here integrates at run time but the generator.

mod compare;
mod generate;
mod lookup;
pub mod unweighted;

use std::sync::LazyLock;

use serde::Serialize;

pub use compare::Difference;
pub use generate::{generate, index};
pub use lookup::Interpolation;

use crate::error::{Error, Result};

/// Nodes along each axis of the committed tables.
pub const NODES: usize = 256;

/// Bytes of a committed table.
const BYTES: usize = NODES * NODES * 4;

/// Largest strength `P` or `a` that the tables of [`Kind::GaussianJ`], [`Kind::ArchK`] and [`Kind::CosineK`] hold.
pub const MOST_STRENGTH: f64 = 1e3;

/// Where the table of the Gaussian ends, in units of its `sqrt(2) sigma`: beyond, its tail is taken for nothing.
/// At the largest strength the tail's depth is `P erfc(4)` = 1.5e-5.
pub const GAUSSIAN_END: f64 = 4.0;

/// The committed tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// `psi(a, b) = int_0^1 exp(-(a x + (b - a) x^2 / 2)) dx`: the mean transmittance of a piece whose extinction runs
    /// linearly from `a` at its front to `b` at its back, both times its length (Moreland & Angel 2004).
    Psi,
    /// `J(P, v) = int_v^4 exp(-P (erf t - erf v)) dt`: the visible length of a Gaussian's profile from `v` on.
    GaussianJ,
    /// `K(a, u) = int_u^pi exp(-a (F(t) - F(u))) dt`, `F = -cos`: the same of the profile `sin t` on one arch.
    ArchK,
    /// The same up to `2 pi` with `F(t) = (t - sin t) / 2`: the profile `(1 - cos t) / 2` over one period.
    CosineK,
}

impl Kind {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Psi, Self::GaussianJ, Self::ArchK, Self::CosineK];

    /// Its name, and its file's without the ending `.f32`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Psi => "psi",
            Self::GaussianJ => "gaussian_j",
            Self::ArchK => "arch_k",
            Self::CosineK => "cosine_k",
        }
    }

    /// The axes of the first and the second argument.
    pub const fn axes(self) -> [Axis; 2] {
        use std::f64::consts::{PI, TAU};
        let strength = Axis::LogOnePlus { most: MOST_STRENGTH };
        match self {
            Self::Psi => [Axis::InverseFourthRoot; 2],
            Self::GaussianJ => [strength, Axis::Linear { from: -GAUSSIAN_END, to: GAUSSIAN_END }],
            Self::ArchK => [strength, Axis::Linear { from: 0.0, to: PI }],
            Self::CosineK => [strength, Axis::Linear { from: 0.0, to: TAU }],
        }
    }

    /// The formula, for the index beside the files.
    const fn meaning(self) -> &'static str {
        match self {
            Self::Psi => "psi(a, b) = int_0^1 exp(-(a x + (b - a) x^2 / 2)) dx",
            Self::GaussianJ => "J(P, v) = int_v^4 exp(-P (erf t - erf v)) dt",
            Self::ArchK => "K(a, u) = int_u^pi exp(-a (cos u - cos t)) dt",
            Self::CosineK => "K(a, u) = int_u^(2 pi) exp(-a ((t - sin t) - (u - sin u)) / 2) dt",
        }
    }

    /// The committed samples. The sizes of the files are checked at compile time.
    const fn bytes(self) -> &'static [u8; BYTES] {
        match self {
            Self::Psi => include_bytes!("../../tables/psi.f32"),
            Self::GaussianJ => include_bytes!("../../tables/gaussian_j.f32"),
            Self::ArchK => include_bytes!("../../tables/arch_k.f32"),
            Self::CosineK => include_bytes!("../../tables/cosine_k.f32"),
        }
    }

    /// The committed table, decoded once.
    pub fn table(self) -> &'static Table2 {
        static TABLES: LazyLock<[Table2; 4]> = LazyLock::new(|| Kind::ALL.map(Kind::decode));
        &TABLES[self as usize]
    }

    fn decode(self) -> Table2 {
        let (values, _) = self.bytes().as_chunks();
        let values = values.iter().map(|&value| f32::from_le_bytes(value)).collect();
        Table2 { name: self.name(), size: [NODES; 2], axes: self.axes(), values }
    }
}

/// How an argument becomes a position in [0, 1]. Node `i` of `n` lies at `i / (n - 1)`: the first and the last node are
/// the ends, so that an empty piece looks up exactly 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(tag = "map", rename_all = "snake_case")]
pub enum Axis {
    /// `(t - from) / (to - from)`.
    Linear {
        /// At position 0.
        from: f64,
        /// At position 1.
        to: f64,
    },
    /// `log(1 + t) / log(1 + most)`, t in [0, most].
    LogOnePlus {
        /// At position 1.
        most: f64,
    },
    /// `1 - (1 + t)^(-1/4)`, t in [0, inf]: `psi(0, b)` falls like `b^(-1/2)`, a parabola at this axis's end.
    InverseFourthRoot,
}

impl Axis {
    /// The position of an argument; beyond the ends it is that of the end. NaN gives NaN.
    pub fn position(self, argument: f64) -> f64 {
        let position = match self {
            Self::Linear { from, to } => (argument - from) / (to - from),
            Self::LogOnePlus { most } => argument.max(0.0).ln_1p() / most.ln_1p(),
            Self::InverseFourthRoot => 1.0 - (1.0 + argument.max(0.0)).powf(-0.25),
        };
        if argument.is_nan() { f64::NAN } else { position.clamp(0.0, 1.0) }
    }

    /// The same in f32, in the shader's words.
    pub fn position_f32(self, argument: f32) -> f32 {
        let position = match self {
            Self::Linear { from, to } => (argument - from as f32) / (to - from) as f32,
            Self::LogOnePlus { most } => (1.0 + argument.max(0.0)).ln() / most.ln_1p() as f32,
            Self::InverseFourthRoot => 1.0 - (-0.25 * (1.0 + argument.max(0.0)).log2()).exp2(),
        };
        if argument.is_nan() { f32::NAN } else { position.clamp(0.0, 1.0) }
    }

    /// The argument at a position in [0, 1].
    pub fn argument(self, position: f64) -> f64 {
        match self {
            Self::Linear { from, to } => from + (to - from) * position,
            Self::LogOnePlus { most } => (position * most.ln_1p()).exp_m1(),
            Self::InverseFourthRoot => (1.0 - position).powi(-4) - 1.0,
        }
    }
}

/// Samples of a function of two arguments at the nodes of two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Table2 {
    /// What it is called, in errors and in `tables/index.json`.
    pub name: &'static str,
    /// Nodes along the first and the second axis; at least 4 each.
    pub size: [usize; 2],
    /// Of the first and the second argument.
    pub axes: [Axis; 2],
    /// `values[i + size[0] * j]` belongs to node `i` of the first axis and `j` of the second.
    pub values: Vec<f32>,
}

impl Table2 {
    /// Samples `value(first argument, second argument)` at all nodes; `size` is at least 4 each way.
    ///
    /// # Errors
    /// A smaller size, which the cubic look-up cannot read.
    pub fn sample(
        name: &'static str,
        size: [usize; 2],
        axes: [Axis; 2],
        value: impl Fn(f64, f64) -> f64,
    ) -> Result<Self> {
        if size.iter().any(|&n| n < 4) {
            return Err(Error::Asked(format!("table {name}: {size:?} nodes are too few; at least 4 each way")));
        }
        let node = |axis: usize, i: usize| axes[axis].argument(i as f64 / (size[axis] - 1) as f64);
        let values = (0..size[1])
            .flat_map(|j| (0..size[0]).map(move |i| (i, j)))
            .map(|(i, j)| value(node(0, i), node(1, j)) as f32)
            .collect();
        Ok(Self { name, size, axes, values })
    }

    /// The samples as the files hold them: little-endian f32, the first axis fastest.
    pub fn bytes(&self) -> Vec<u8> {
        self.values.iter().flat_map(|v| v.to_le_bytes()).collect()
    }
}
