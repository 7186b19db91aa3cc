//! Look-ups as the shaders do them (`shaders/math/unweighted.wgsl`), in f32 and in f64.

use super::Table2;

/// How values between nodes are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// From 2 x 2 nodes.
    Bilinear,
    /// Catmull-Rom from 4 x 4 nodes. Beyond an edge stands the parabola through the three nodes at it, so that parabolas
    /// are reproduced everywhere.
    Cubic,
}

/// The same code over two types of number.
macro_rules! lookup {
    ($module:ident, $number:ident) => {
        mod $module {
            use super::Interpolation;

            /// The first of four (two) nodes that are read, and their weights. `at` counts nodes, in [0, count - 1].
            pub fn stencil(at: $number, count: usize, interpolation: Interpolation) -> (usize, [$number; 4]) {
                match interpolation {
                    Interpolation::Bilinear => {
                        let start = (at as usize).min(count - 2);
                        let t = at - start as $number;
                        (start, [1.0 - t, t, 0.0, 0.0])
                    }
                    Interpolation::Cubic => {
                        let start = (at as usize).saturating_sub(1).min(count - 4);
                        (start, cubic_weights(at - start as $number))
                    }
                }
            }

            /// Weights of nodes 0, 1, 2, 3 for the value at `offset` in [0, 3].
            fn cubic_weights(offset: $number) -> [$number; 4] {
                let mirrored = offset > 2.0;
                let offset = if mirrored { 3.0 - offset } else { offset };
                let at_edge = offset < 1.0;
                let t = if at_edge { offset } else { offset - 1.0 };
                let before = t * (-0.5 + t * (1.0 - 0.5 * t));
                let start = 1.0 + t * t * (1.5 * t - 2.5);
                let end = t * (0.5 + t * (2.0 - 1.5 * t));
                let after = t * t * (0.5 * t - 0.5);
                let mut weights = if at_edge {
                    [start + 3.0 * before, end - 3.0 * before, after + before, 0.0]
                } else {
                    [before, start, end, after]
                };
                if mirrored {
                    weights.reverse();
                }
                weights
            }
        }
    };
}

lookup!(double, f64);
lookup!(single, f32);

impl Table2 {
    /// The value at two arguments; beyond an axis's end, the value at its end. NaN gives NaN.
    pub fn lookup(&self, arguments: [f64; 2], interpolation: Interpolation) -> f64 {
        let [(i, x), (j, y)] = [0, 1].map(|axis| {
            let at = self.axes[axis].position(arguments[axis]) * (self.size[axis] - 1) as f64;
            double::stencil(at, self.size[axis], interpolation)
        });
        let width = interpolation.width();
        let row = |r: usize| (0..width).map(|c| x[c] * f64::from(self.value(i + c, j + r))).sum::<f64>();
        (0..width).map(|r| y[r] * row(r)).sum()
    }

    /// The same in f32 throughout, as on a device.
    pub fn lookup_f32(&self, arguments: [f32; 2], interpolation: Interpolation) -> f32 {
        let [(i, x), (j, y)] = [0, 1].map(|axis| {
            let at = self.axes[axis].position_f32(arguments[axis]) * (self.size[axis] - 1) as f32;
            single::stencil(at, self.size[axis], interpolation)
        });
        let width = interpolation.width();
        let row = |r: usize| (0..width).map(|c| x[c] * self.value(i + c, j + r)).sum::<f32>();
        (0..width).map(|r| y[r] * row(r)).sum()
    }

    fn value(&self, i: usize, j: usize) -> f32 {
        self.values[i + self.size[0] * j]
    }
}

impl Interpolation {
    /// Nodes read along an axis.
    const fn width(self) -> usize {
        match self {
            Self::Bilinear => 2,
            Self::Cubic => 4,
        }
    }
}
