//! In which order cells are drawn, and which order a scene needs.

use std::fmt;

use crate::plan::order::{PowerCensus, Proof};
use crate::renderer::Settings;
use crate::scene::{EmissionModel, Optics, TransferFunction};

/// In which order cells are blended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OrderMethod {
    /// What is right for every eye, as far as the function, the mesh and its census tell: [`OrderChoice::new`].
    #[default]
    Auto,
    /// View depth of the cell's centroid.
    Centroid,
    /// Power of the eye to the cells of a regular mesh (Max, Hanrahan & Crawfis 1990): exact where the mesh is convex,
    /// too, but for the rounding of keys to f32 (3e-6 of all neighbours of Delaunay meshes).
    Power,
    /// Every cell after its neighbours behind it, on the host (Williams 1992): exact for convex meshes where no cells
    /// hide one another in a circle.
    Mpvonc,
    /// The same, and across gaps along the picture's rays, on the host (after Cook, Max, Silva & Williams 2004): exact
    /// where there are no circles and no parts that lie in each other.
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

/// Of a tolerance, what the order of cells may take before it has to be right.
const SHARE: f64 = 0.5;

/// An order, and why it was taken.
#[derive(Clone, Debug, PartialEq)]
pub struct OrderChoice {
    /// Never [`OrderMethod::Auto`].
    pub method: OrderMethod,
    /// For people.
    pub why: String,
    /// By how much a channel may be wrong, where the order asked for is not known to be right; infinite where nothing
    /// is known.
    pub doubt: Option<f64>,
}

impl OrderChoice {
    /// What was asked for; of `Auto`: by centroids where no order changes a pixel by more than half of the
    /// tolerance (in meshes whose
    /// parts do not lie in each other); by powers where the census proves them; else pixel by pixel, though a cheaper
    /// order may be right for one eye, which is known only when it has been tried.
    ///
    /// `diagonal`: of the mesh, data units; `census` is asked only where it matters.
    pub fn new<'a>(
        settings: &Settings,
        transfer: &TransferFunction,
        optics: &Optics,
        diagonal: f64,
        census: impl Fn() -> &'a PowerCensus,
    ) -> Self {
        let of = |method, why: &str| Self { method, why: why.to_owned(), doubt: None };
        let (asked, least_change) = (settings.order, SHARE * settings.tolerance);
        let change = largest_change(transfer, optics, diagonal);
        let asked_for = |why: &str, is_right: bool| Self {
            doubt: (!is_right && change > least_change).then_some(change),
            ..of(asked, why)
        };
        match asked {
            OrderMethod::Auto => {}
            OrderMethod::Power => {
                let proof = census().proof();
                let why = match proof {
                    Proof::Order => "asked for; exact",
                    Proof::Neighbors => "asked for; exact between neighbours, unknown across gaps",
                    Proof::Nothing => "asked for; not exact for this mesh",
                };
                return asked_for(why, proof == Proof::Order);
            }
            OrderMethod::Centroid => return asked_for("asked for", false),
            OrderMethod::Mpvonc => {
                let c = census();
                let has_gaps = !c.is_convex_mesh || c.overlapping_pairs + c.overfull_faces > 0;
                return asked_for("asked for", !has_gaps);
            }
            other => return of(other, "asked for"),
        }
        if change == 0.0 {
            return of(OrderMethod::Centroid, "all is of one colour, so that no order matters");
        }
        if change <= least_change {
            let why = format!("the function is so thin that no order changes more than {least_change:.1e}");
            return of(OrderMethod::Centroid, &why);
        }
        if census().is_exact() {
            return of(OrderMethod::Power, "exact, as the mesh is regular and convex");
        }
        of(OrderMethod::PerPixel, "no order of cells is known to be right for this mesh")
    }
}

impl OrderChoice {
    /// What is to be said of the doubt.
    pub fn warning(&self) -> Option<String> {
        let most = self.doubt?;
        let by = if most.is_finite() { format!("by up to {most:.2}") } else { "by an unknown amount".to_owned() };
        Some(format!(
            "--order {} is not known to be right for this mesh, and channels may be wrong {by}: --order per-pixel and \
             --method raycast are exact, and --explain counts the neighbours in the wrong order",
            self.method
        ))
    }
}

/// How much of a channel any order of a ray's segments may change, at most.
///
/// Two neighbours of optical depths a and b, exchanged, change `(1 - e^-a) (1 - e^-b)` of the difference of their
/// colours. Of a whole ray of depth d, worst is one colour before another, each half of the depth, turned around:
/// `(1 - e^(-d / 2))^2` of the difference. (Any order moves colours along the depth as they are, and they are sums of
/// layers from the front on: one of depth m changes at most `(1 - e^-m) (1 - e^(m - d))`.)
///
/// That takes segments whose colour is their opacity times a mean of the function's colours: weighted and unlit. Of
/// others nothing is known.
fn largest_change(transfer: &TransferFunction, optics: &Optics, diagonal: f64) -> f64 {
    if optics.emission != EmissionModel::Weighted || optics.uses_gradients() {
        return f64::INFINITY;
    }
    let half = -(-0.5 * largest_extinction(transfer) * diagonal).exp_m1();
    largest_difference(transfer) * half * half
}

/// Of the function's colours, in any channel.
fn largest_difference(transfer: &TransferFunction) -> f64 {
    let colors: Vec<[f64; 3]> = match transfer {
        TransferFunction::Curve(curve) => curve.nodes.iter().map(|node| node.color).collect(),
        TransferFunction::Widgets(widgets) => widgets.iter().map(|widget| widget.color).collect(),
    };
    let of_channel = |c: usize| {
        let values = || colors.iter().map(|color| color[c]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    (0..3).map(of_channel).fold(0.0, f64::max)
}

/// At any point at most.
fn largest_extinction(transfer: &TransferFunction) -> f64 {
    match transfer {
        TransferFunction::Curve(curve) => curve.nodes.iter().map(|node| node.extinction).fold(0.0, f64::max),
        TransferFunction::Widgets(widgets) => widgets.iter().map(|widget| widget.extinction).sum(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::order::Metric;
    use crate::renderer::TOLERANCE;
    use crate::scene::{Curve, CurveNode, Silhouette, SilhouetteMode};
    use crate::tet::Finding;

    /// Thin enough, or not, by these colours and this optical depth over the diagonal.
    fn curve(colors: &[[f64; 3]], depth: f64) -> TransferFunction {
        let node = |(scalar, &color): (u32, &[f64; 3])| CurveNode { scalar: scalar.into(), color, extinction: depth };
        TransferFunction::Curve(Curve { nodes: (0..).zip(colors).map(node).collect() })
    }

    const RED_BLUE: [[f64; 3]; 2] = [[1.0, 0.2, 0.0], [0.0, 0.2, 1.0]];

    /// One channel of segments (optical depth, colour), front to back.
    fn composed(segments: &[(f64, f64)]) -> f64 {
        let add = |(sum, transmittance): (f64, f64), &(depth, color): &(f64, f64)| {
            (sum + transmittance * -(-depth).exp_m1() * color, transmittance * (-depth).exp())
        };
        segments.iter().fold((0.0, 1.0), add).0
    }

    #[test]
    fn no_order_changes_more_than_is_said_and_one_as_much() {
        let mut state = 9_u64;
        let mut unit = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24)
        };
        for depth in [0.01, 0.09, 1.0, 10.0] {
            let said = largest_change(&curve(&RED_BLUE, depth), &Optics::PLAIN, 1.0);
            let change = |segments: &mut [(f64, f64)]| {
                segments.sort_by(|a, b| a.1.total_cmp(&b.1));
                let rising = composed(segments);
                segments.reverse();
                (composed(segments) - rising).abs()
            };
            for count in [2, 3, 10, 100] {
                let mut segments: Vec<_> = (0..count).map(|_| (unit(), unit())).collect();
                let sum: f64 = segments.iter().map(|s| s.0).sum();
                segments.iter_mut().for_each(|s| s.0 *= depth / sum);
                assert!(change(&mut segments) <= said, "{count} segments of depth {depth}");
            }
            let most = change(&mut [(0.5 * depth, 0.0), (0.5 * depth, 1.0)]);
            assert!((most - said).abs() <= 1e-12 * said, "{most:e} of {said:e}");
        }
    }

    #[test]
    fn orders_that_may_be_wrong_say_by_how_much() {
        let census = |is_convex_mesh: bool, count: u64| PowerCensus {
            metric: Metric::IDENTITY,
            interior_faces: 9,
            overlapping_pairs: 0,
            overfull_faces: 0,
            not_convex: Finding { count, first: None },
            ties: Finding::default(),
            is_convex_mesh,
        };
        let (regular, dented) = (census(true, 0), census(false, 3));
        let (thin, thick) = (curve(&RED_BLUE, 0.01), curve(&RED_BLUE, 10.0));
        let by = |order| Settings { order, ..Settings::default() };
        let choice = |asked, transfer, census| OrderChoice::new(&by(asked), transfer, &Optics::PLAIN, 1.0, || census);
        for asked in [OrderMethod::Centroid, OrderMethod::Power, OrderMethod::Mpvonc] {
            let doubtful = choice(asked, &thick, &dented);
            assert!(doubtful.doubt.is_some_and(|most| (0.9..1.0).contains(&most)), "{doubtful:?}");
            let warning = doubtful.warning().expect("a warning");
            assert!(warning.contains(&format!("--order {asked}")) && warning.contains("by up to 0.99"), "{warning}");
            assert_eq!(choice(asked, &thin, &dented).warning(), None, "{asked}: no order changes anything");
            let is_right = asked != OrderMethod::Centroid;
            assert_eq!(choice(asked, &thick, &regular).doubt.is_none(), is_right, "{asked}");
        }
        for asked in [OrderMethod::Auto, OrderMethod::Exact, OrderMethod::PerPixel] {
            assert_eq!(choice(asked, &thick, &dented).warning(), None, "{asked}");
        }
        let unweighted = Optics { emission: EmissionModel::Unweighted, ..Optics::PLAIN };
        let unknown = OrderChoice::new(&by(OrderMethod::Centroid), &thick, &unweighted, 1.0, || &regular);
        assert!(unknown.warning().is_some_and(|text| text.contains("unknown amount")), "{unknown:?}");
    }

    #[test]
    fn thin_functions_are_told_by_depth_color_and_light() {
        let change = |transfer: &TransferFunction, optics: &Optics| largest_change(transfer, optics, 1.0);
        let is_thin = |colors: &[[f64; 3]], depth| change(&curve(colors, depth), &Optics::PLAIN) <= SHARE * TOLERANCE;
        assert!(is_thin(&RED_BLUE, 0.063) && !is_thin(&RED_BLUE, 0.064));
        // Four times as bright: half as much of each half.
        let bright = RED_BLUE.map(|color| color.map(|c| 4.0 * c));
        assert!(is_thin(&bright, 0.031) && !is_thin(&bright, 0.032));
        assert!(is_thin(&[[0.5; 3], [0.6; 3]], 0.2));
        assert_eq!(change(&curve(&[[3.0; 3]; 2], 1e3), &Optics::PLAIN), 0.0);
        let thin = curve(&RED_BLUE, 1e-6);
        let silhouette = Silhouette { exponent: 1.0, strength: 0.5, mode: SilhouetteMode::Depth };
        let outlined = Optics { silhouette: Some(silhouette), ..Optics::PLAIN };
        let unweighted = Optics { emission: EmissionModel::Unweighted, ..Optics::PLAIN };
        assert!([outlined, unweighted].iter().all(|optics| change(&thin, optics).is_infinite()));
    }
}
