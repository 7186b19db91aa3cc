//! How far two tables of one kind are apart.

use super::Table2;
use crate::error::{Error, Result};

/// What differs between two sets of samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Values that are not bit for bit the same.
    pub values: usize,
    /// The largest distance, in units in the last place: how many f32 numbers lie from one to the other. Infinite and
    /// NaN values that differ count as `u32::MAX`.
    pub units: u32,
    /// Node of the first and the second axis where it is.
    pub node: [usize; 2],
}

impl Difference {
    /// One unit is what two mathematical libraries may differ by: their `exp` and `sin` agree to an f64's last bit or two,
    /// which moves an f32 by one unit where the value lies halfway between two of them.
    pub const TOLERATED: u32 = 1;
}

impl Table2 {
    /// Compares the samples with those of a file's bytes.
    ///
    /// # Errors
    /// A file of another length.
    pub fn compare(&self, bytes: &[u8]) -> Result<Difference> {
        let (found, rest) = bytes.as_chunks();
        if found.len() != self.values.len() || !rest.is_empty() {
            return Err(Error::Asked(format!(
                "table {}: the file has {} bytes instead of {}",
                self.name,
                bytes.len(),
                4 * self.values.len()
            )));
        }
        let mut difference = Difference { values: 0, units: 0, node: [0; 2] };
        for (at, (&want, &found)) in self.values.iter().zip(found).enumerate() {
            let units = distance(want, f32::from_le_bytes(found));
            difference.values += usize::from(units > 0);
            if units > difference.units {
                difference = Difference { units, node: [at % self.size[0], at / self.size[0]], ..difference };
            }
        }
        Ok(difference)
    }
}

fn distance(a: f32, b: f32) -> u32 {
    if a.to_bits() == b.to_bits() {
        return 0;
    }
    if !(a.is_finite() && b.is_finite()) {
        return u32::MAX;
    }
    // Numbers of both signs on one line; the two zeros lie beside each other.
    let line = |x: f32| {
        let bits = i64::from(x.to_bits() & 0x7fff_ffff);
        if x.is_sign_negative() { -1 - bits } else { bits }
    };
    line(a).abs_diff(line(b)).try_into().unwrap_or(u32::MAX)
}
