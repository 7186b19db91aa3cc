//! The cheapest integral that holds a tolerance: found by small pictures, tried in the order of what pictures cost.

use super::{Frame, Renderer, SegmentIntegral};
use crate::error::Result;
use crate::image::Comparison;
use crate::scene::TransferFunction;

/// What a picture may err by where nothing is said: half of what 8 bits tell apart.
pub const TOLERANCE: f64 = 1.0 / 512.0;
/// Tighter ones are not promised: f32 itself errs by up to 6e-4 in a pixel (thin bands on real meshes).
pub const LEAST_TOLERANCE: f64 = 1e-3;

/// Longest side of the pictures that are tried, pixels.
const SIDE: u32 = 96;
/// What is seen of errors there is at least such a share of what a large picture may show.
const SHARE: f64 = 0.5;
/// The reference among the pictures is so many times as exact as is asked for.
const REFERENCE: f64 = 100.0;

/// A choice and why.
#[derive(Clone, Debug, PartialEq)]
pub struct ChosenIntegral {
    /// Set in the renderer.
    pub integral: SegmentIntegral,
    /// One sentence.
    pub why: String,
}

/// Ways to integrate sums of widgets, the cheapest first. In the records (`bench/results`) means cost a quarter to a half of
/// an adaptive integral; the closed form a third, on llvmpipe no less than it.
const BY_COST: [SegmentIntegral; 9] = [
    SegmentIntegral::MeanScalar,
    SegmentIntegral::Analytic,
    SegmentIntegral::VertexLinear,
    SegmentIntegral::Adaptive { tolerance: 0.1 },
    SegmentIntegral::Adaptive { tolerance: 0.03 },
    SegmentIntegral::Adaptive { tolerance: 0.01 },
    SegmentIntegral::Adaptive { tolerance: 3e-3 },
    SegmentIntegral::Adaptive { tolerance: 1e-3 },
    SegmentIntegral::Adaptive { tolerance: 3e-4 },
];

/// Sets the cheapest integral whose pictures of the frame err by at most `tolerance` in every channel of every pixel.
///
/// Functions of the scalar alone are drawn band by band in closed form, which costs least and errs least. Of sums of
/// widgets, small pictures are compared with one of an integral that errs far less. The order of cells is not part of it:
/// the same cells are drawn in the same order.
///
/// # Errors
/// The renderer's.
pub fn choose_integral(renderer: &mut dyn Renderer, frame: &Frame<'_>, tolerance: f64) -> Result<ChosenIntegral> {
    let last = SegmentIntegral::Adaptive { tolerance: (tolerance / REFERENCE).clamp(1e-6, 1.0) };
    if let TransferFunction::Curve(_) = frame.transfer {
        let integral = SegmentIntegral::default();
        renderer.set_integral(integral);
        let why = "functions of the scalar alone are cheapest in closed form, band by band".into();
        return Ok(ChosenIntegral { integral, why });
    }
    let longest = frame.size.into_iter().max().unwrap_or(SIDE).max(SIDE);
    let small = frame.size.map(|side| (u64::from(side) * u64::from(SIDE)).div_ceil(u64::from(longest)) as u32);
    let frame = Frame { size: small, ..*frame };
    renderer.set_integral(last);
    let want = renderer.render(&frame, false)?.image;
    let mut cheaper = String::new();
    for integral in BY_COST {
        renderer.set_integral(integral);
        let error = Comparison::new(&renderer.render(&frame, false)?.image, &want)?.max;
        if error <= SHARE * tolerance {
            let [width, height] = small;
            let why = format!(
                "errs by {error:.1e} in a picture of {width}x{height} pixels, {tolerance:.1e} is asked for{cheaper}"
            );
            return Ok(ChosenIntegral { integral, why });
        }
        cheaper += &format!("; {integral} by {error:.1e}");
    }
    renderer.set_integral(last);
    Ok(ChosenIntegral { integral: last, why: format!("a part of {tolerance:.1e} is its own bound{cheaper}") })
}
