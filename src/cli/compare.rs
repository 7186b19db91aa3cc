//! `tetralux compare`: two pictures turned into numbers.

use super::args::CompareArgs;
use super::output;
use crate::error::Error;
use crate::image::{Comparison, Image, PngEncoding};

pub(super) fn run(args: &CompareArgs) -> anyhow::Result<()> {
    if let Some(output) = &args.output {
        output::check_picture(output)?;
    }
    if args.max_error.is_some_and(|limit| limit.is_nan() || limit < 0.0) {
        return Err(Error::Asked("--max-error must not be negative".into()).into());
    }
    if !(args.scale.is_finite() && args.scale > 0.0) {
        return Err(Error::Asked("--scale must be above 0 and finite".into()).into());
    }
    let comparison = Comparison::new(&Image::read(&args.got)?, &Image::read(&args.want)?)?;
    if let Some(output) = &args.output {
        comparison.difference_picture(args.scale).write(output, PngEncoding::Srgb)?;
    }
    let text = if args.json { serde_json::to_string(&comparison)? } else { comparison.to_string() };
    output::say(&text)?;
    match args.max_error {
        Some(limit) if comparison.max.is_nan() || comparison.max > limit => {
            anyhow::bail!("the pictures differ by {:.3e}, more than {limit:e}", comparison.max)
        }
        _ => Ok(()),
    }
}
