//! In which order cells are drawn, and which order a scene needs.

use std::fmt;

use crate::plan::order::{PowerCensus, Proof};
use crate::scene::{EmissionModel, Optics, TransferFunction};

/// In which order cells are blended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OrderMethod {
    /// The cheapest that the function, the mesh and its census allow.
    #[default]
    Auto,
    /// View depth of the cell's centroid.
    Centroid,
    /// Power of the eye to the cells of a regular mesh (Max, Hanrahan & Crawfis 1990): exact where the census says so.
    Power,
    /// Every cell after its neighbours behind it, on the host (Williams 1992): exact for convex meshes.
    Mpvonc,
    /// The same, and across gaps along the picture's rays, on the host (after Cook, Max, Silva & Williams 2004).
    Exact,
    /// Each pixel's fragments by their own depth, whatever the order of cells: exact.
    PerPixel,
    /// As a grid's voxels lie around the eye: exact, and known without sorting.
    Structured,
}

impl fmt::Display for OrderMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::Centroid => "centroid",
            Self::Power => "power",
            Self::Mpvonc => "mpvonc",
            Self::Exact => "exact",
            Self::PerPixel => "per-pixel",
            Self::Structured => "structured",
        })
    }
}

/// Up to this optical depth, of the mesh's diagonal at the function's largest extinction, the order by centroids is taken.
///
/// Measured there, with thin bands on a mesh with 46 % of its neighbours in the wrong order: no pixel errs by more than 5e-5.
const THIN: f64 = 0.5;

/// An order, and why it was taken.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OrderChoice {
    /// Never [`OrderMethod::Auto`].
    pub method: OrderMethod,
    /// For people.
    pub why: String,
}

impl OrderChoice {
    /// What was asked for; of `Auto` the cheapest that keeps pixels within 1/512. `diagonal`: of the mesh, data units;
    /// `census` is asked only where it matters.
    pub fn new<'a>(
        asked: OrderMethod,
        transfer: &TransferFunction,
        optics: &Optics,
        diagonal: f64,
        census: impl Fn() -> &'a PowerCensus,
    ) -> Self {
        let of = |method, why: &str| Self { method, why: why.to_owned() };
        match asked {
            OrderMethod::Auto => {}
            OrderMethod::Power => {
                let why = match census().proof() {
                    Proof::Order => "asked for; exact",
                    Proof::Neighbors => "asked for; exact between neighbours, unknown across gaps",
                    Proof::Nothing => "asked for; not exact for this mesh",
                };
                return of(asked, why);
            }
            other => return of(other, "asked for"),
        }
        if has_one_color(transfer, optics) {
            return of(OrderMethod::Centroid, "all is of one colour, so that no order matters");
        }
        if largest_extinction(transfer) * diagonal <= THIN {
            return of(OrderMethod::Centroid, "the function is so thin that the order hardly matters");
        }
        if census().is_exact() {
            return of(OrderMethod::Power, "exact, as the mesh is regular and convex");
        }
        of(OrderMethod::PerPixel, "no order of cells is known to be right for this mesh")
    }
}

/// Where a segment's colour is its opacity times one colour, segments may be exchanged.
fn has_one_color(transfer: &TransferFunction, optics: &Optics) -> bool {
    let plain = optics.emission == EmissionModel::Weighted && !optics.uses_gradients();
    let colors: Vec<[f64; 3]> = match transfer {
        TransferFunction::Curve(curve) => curve.nodes.iter().map(|node| node.color).collect(),
        TransferFunction::Widgets(widgets) => widgets.iter().map(|widget| widget.color).collect(),
    };
    plain && colors.windows(2).all(|pair| pair[0] == pair[1])
}

/// At any point at most.
fn largest_extinction(transfer: &TransferFunction) -> f64 {
    match transfer {
        TransferFunction::Curve(curve) => curve.nodes.iter().map(|node| node.extinction).fold(0.0, f64::max),
        TransferFunction::Widgets(widgets) => widgets.iter().map(|widget| widget.extinction).sum(),
    }
}
