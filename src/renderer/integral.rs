//! How one ray segment in one cell is integrated: the closed set of ways, and how they are written.

use std::fmt;
use std::str::FromStr;

use crate::error::Error;

/// How one ray segment in one cell is integrated. Written and read as on the command line: `vertex-linear`,
/// `mean-scalar`, `preintegrated[:N]`, `partial[:N]`, `partial-direct`, `analytic`, `segmented:N`, `adaptive[:TOL]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SegmentIntegral {
    /// Extinction and colour at entry and exit, averaged (Shirley & Tuchman 1990, on a segment's ends).
    VertexLinear,
    /// Extinction and colour at the mean of entry and exit: opacity `1 - exp(-extinction length)`.
    MeanScalar,
    /// 1D functions from a table over entry, exit and length (Röttger et al. 2000, Weiler et al. 2003).
    PreIntegrated {
        /// Nodes along each scalar axis.
        size: u32,
    },
    /// Linear extinction and colour between a function's special points; psi from a table (Moreland & Angel 2004).
    Partial {
        /// Nodes along each axis.
        size: u32,
    },
    /// The same with psi evaluated.
    PartialDirect,
    /// Closed-form optical depth; the colour exact for one colour, weighted by depth for several.
    Analytic,
    /// Pieces of equal length, extinction and emission linear in each (Song et al. 2009, section 5).
    Segmented {
        /// How many.
        pieces: u32,
    },
    /// Closed-form optical depth; the segment is cut until a bound of the colour's error is below the tolerance.
    Adaptive {
        /// Largest error of a colour channel in a cell, for colours up to 1.
        tolerance: f64,
    },
}

impl SegmentIntegral {
    /// Nodes of `preintegrated` where nothing is said.
    pub const PREINTEGRATED_SIZE: u32 = 128;
    /// Nodes of `partial` where nothing is said: psi errs by 2.1e-5.
    pub const PARTIAL_SIZE: u32 = 256;
    /// Tolerance of `adaptive` where nothing is said.
    pub const TOLERANCE: f64 = 1e-3;
    /// Most pieces of `segmented`.
    pub const MOST_PIECES: u32 = 4096;
}

impl Default for SegmentIntegral {
    fn default() -> Self {
        Self::Adaptive { tolerance: Self::TOLERANCE }
    }
}

impl fmt::Display for SegmentIntegral {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::VertexLinear => f.write_str("vertex-linear"),
            Self::MeanScalar => f.write_str("mean-scalar"),
            Self::PreIntegrated { size } => write!(f, "preintegrated:{size}"),
            Self::Partial { size } => write!(f, "partial:{size}"),
            Self::PartialDirect => f.write_str("partial-direct"),
            Self::Analytic => f.write_str("analytic"),
            Self::Segmented { pieces } => write!(f, "segmented:{pieces}"),
            Self::Adaptive { tolerance } => write!(f, "adaptive:{tolerance}"),
        }
    }
}

impl FromStr for SegmentIntegral {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let (name, value) = text.split_once(':').map_or((text, None), |(name, value)| (name, Some(value)));
        let number = |most: u32, least: u32| {
            let value = value.unwrap_or_default();
            value.parse::<u32>().ok().filter(|n| (least..=most).contains(n)).ok_or_else(|| {
                Error::Asked(format!("'{text}': what follows '{name}:' is a whole number from {least} to {most}"))
            })
        };
        let plain = |integral: Self| match value {
            None => Ok(integral),
            Some(_) => Err(Error::Asked(format!("'{text}': '{name}' takes no number"))),
        };
        match name {
            "vertex-linear" => plain(Self::VertexLinear),
            "mean-scalar" => plain(Self::MeanScalar),
            "partial-direct" => plain(Self::PartialDirect),
            "analytic" => plain(Self::Analytic),
            "preintegrated" if value.is_none() => Ok(Self::PreIntegrated { size: Self::PREINTEGRATED_SIZE }),
            "preintegrated" => Ok(Self::PreIntegrated { size: number(256, 2)? }),
            "partial" if value.is_none() => Ok(Self::Partial { size: Self::PARTIAL_SIZE }),
            "partial" => Ok(Self::Partial { size: number(2048, 2)? }),
            "segmented" => Ok(Self::Segmented { pieces: number(Self::MOST_PIECES, 1)? }),
            "adaptive" if value.is_none() => Ok(Self::default()),
            "adaptive" => {
                let tolerance = value.and_then(|v| v.parse::<f64>().ok()).filter(|t| (1e-6..=1.0).contains(t));
                let tolerance = tolerance.ok_or_else(|| {
                    Error::Asked(format!("'{text}': what follows 'adaptive:' is an error from 1e-6 to 1"))
                })?;
                Ok(Self::Adaptive { tolerance })
            }
            _ => Err(Error::Asked(format!(
                "'{text}' is no integral; there are vertex-linear, mean-scalar, preintegrated[:N], partial[:N], \
                 partial-direct, analytic, segmented:N and adaptive[:TOLERANCE]"
            ))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for text in [
            "vertex-linear",
            "mean-scalar",
            "preintegrated:64",
            "partial:512",
            "partial-direct",
            "analytic",
            "segmented:10",
            "adaptive:0.01",
        ] {
            let integral: SegmentIntegral = text.parse().expect(text);
            assert_eq!(integral.to_string(), text);
        }
        assert_eq!("adaptive".parse::<SegmentIntegral>().expect("a name"), SegmentIntegral::default());
        let size = SegmentIntegral::PARTIAL_SIZE;
        assert_eq!("partial".parse::<SegmentIntegral>().expect("a name"), SegmentIntegral::Partial { size });
    }

    #[test]
    fn nonsense_is_refused() {
        for text in [
            "",
            "Analytic",
            "analytic:3",
            "segmented",
            "segmented:0",
            "segmented:-1",
            "segmented:9999",
            "partial:1",
            "partial:",
            "preintegrated:4096",
            "adaptive:0",
            "adaptive:nan",
            "adaptive:2",
            "adaptive:-1",
        ] {
            let message = text.parse::<SegmentIntegral>().expect_err(text).to_string();
            assert!(message.contains(&format!("'{text}'")), "{message}");
        }
    }
}
