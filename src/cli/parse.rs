//! Values as they are typed: sizes, vectors, colours, assignments.

use crate::renderer::LEAST_TOLERANCE;

/// `800x600`.
pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    counts(text, "WIDTHxHEIGHT, as 800x600")
}

/// `256x256`, at most 4096 each.
pub(super) fn bins(text: &str) -> Result<[u32; 2], String> {
    let bins: [u32; 2] = counts(text, "WIDTHxHEIGHT, as 256x256")?;
    match bins.iter().all(|n| *n <= 4096) {
        true => Ok(bins),
        false => Err("at most 4096 bins along each axis".into()),
    }
}

/// `64x64x32`.
pub(super) fn dims(text: &str) -> Result<[usize; 3], String> {
    counts(text, "AxBxC, as 64x64x32")
}

/// Positive numbers joined by `x`.
fn counts<T: std::str::FromStr + PartialOrd + From<u8>, const N: usize>(
    text: &str,
    form: &str,
) -> Result<[T; N], String> {
    let numbers: Option<Vec<T>> = text.split(['x', 'X']).map(|part| part.parse().ok()).collect();
    let numbers: Option<[T; N]> = numbers.and_then(|n| n.try_into().ok());
    numbers.filter(|n| n.iter().all(|v| *v >= T::from(1))).ok_or_else(|| format!("write it as {form}, each above 0"))
}

/// `1,-2,0.5`.
pub(super) fn vector(text: &str) -> Result<[f64; 3], String> {
    numbers(text).and_then(|n| n.try_into().ok()).ok_or_else(|| "write three finite numbers as 1,-2,0.5".into())
}

/// Two corners of a box: `0,0,0,1,1,1`.
pub(super) fn corners(text: &str) -> Result<[f64; 6], String> {
    let corners: Option<[f64; 6]> = numbers(text).and_then(|n| n.try_into().ok());
    corners
        .filter(|c| (0..3).all(|axis| c[axis] < c[axis + 3]))
        .ok_or_else(|| "write a lower and a higher corner as X0,Y0,Z0,X1,Y1,Z1".into())
}

/// `1,1,2`, each above 0.
pub(super) fn spacing(text: &str) -> Result<[f64; 3], String> {
    vector(text).and_then(|v| match v.iter().all(|n| *n > 0.0) {
        true => Ok(v),
        false => Err("each must be above 0".into()),
    })
}

fn numbers(text: &str) -> Option<Vec<f64>> {
    text.split(',').map(|part| part.trim().parse::<f64>().ok().filter(|v| v.is_finite())).collect()
}

/// A colour as a TOML value: `0,0.5,1` and `0,0.5,1,1` become lists, anything else a string.
pub(super) fn color(text: &str) -> Result<String, String> {
    match numbers(text) {
        Some(channels) if (3..=4).contains(&channels.len()) => Ok(format!("{channels:?}")),
        None if text.starts_with('#') => Ok(toml::Value::from(text).to_string()),
        _ => Err("write it as R,G,B or R,G,B,A (linear, 0..1) or #rrggbb (sRGB)".into()),
    }
}

/// A number from 0 to 1.
pub(super) fn share(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|v| (0.0..=1.0).contains(v));
    number.ok_or_else(|| "write a number from 0 to 1, as 1e-5".into())
}

/// What a channel may err by.
pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    let number = text.trim().parse().ok().filter(|v| (LEAST_TOLERANCE..=1.0).contains(v));
    number.ok_or_else(|| format!("write a number from {LEAST_TOLERANCE} to 1: more exact pictures are not promised"))
}

/// `key=value`.
pub(super) fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().into(), value.trim().into())),
        _ => Err("write it as KEY=VALUE, as transfer.widget.0.extinction=3".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_vectors() {
        assert_eq!(size("800x600"), Ok([800, 600]));
        assert_eq!(dims("2X3x4"), Ok([2, 3, 4]));
        assert_eq!(vector("1, -2,.5"), Ok([1.0, -2.0, 0.5]));
        for bad in ["", "800", "800x", "0x600", "-1x5", "1x2x3", "99999999999x1"] {
            assert!(size(bad).is_err(), "{bad}");
        }
        for bad in ["1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "a,b,c"] {
            assert!(vector(bad).is_err(), "{bad}");
        }
        assert!(spacing("1,0,1").is_err() && bins("5000x5").is_err());
    }

    #[test]
    fn colors_become_toml() {
        assert_eq!(color("0,0.5,1").as_deref(), Ok("[0.0, 0.5, 1.0]"));
        assert_eq!(color("#102030").as_deref(), Ok("\"#102030\""));
        assert!(color("red").is_err() && color("1,2").is_err());
    }
}
