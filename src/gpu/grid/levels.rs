//! Samples that take few values, as most that were measured do: held as these values' numbers.

use std::collections::HashMap;

use rayon::prelude::*;

/// Values that are told apart by 16 bits.
const MOST_LEVELS: usize = 1 << 16;

/// Samples as the device holds them (`shared/grid.wgsl`).
pub struct Levels {
    /// Bits of a sample: 32 for its value, 8 or 16 for its number among the values.
    pub bits: u32,
    /// Samples, from the lowest bits on.
    pub words: Vec<u32>,
    /// Ascending; none where samples are values.
    pub values: Vec<f32>,
}

impl Levels {
    /// The least form that loses nothing.
    pub fn of(samples: &[f32]) -> Self {
        let values = distinct(samples).unwrap_or_default();
        let bits = if values.len() <= 256 { 8 } else { 16 };
        let needed = |bits: usize, values: usize| samples.len() * bits / 32 + values;
        if values.is_empty() || needed(bits as usize, values.len()) >= needed(32, 0) {
            return Self { bits: 32, words: bytemuck::cast_slice(samples).to_vec(), values: Vec::new() };
        }
        let number = |value: &f32| values.partition_point(|v| v.total_cmp(value).is_lt()) as u32;
        let word = |some: &[f32]| some.iter().rev().fold(0, |word, value| word << bits | number(value));
        let words = samples.par_chunks(32 / bits as usize).map(word).collect();
        Self { bits, words, values }
    }
}

/// What samples take, ascending; `None` if that is too much.
fn distinct(samples: &[f32]) -> Option<Vec<f32>> {
    let mut seen = HashMap::new();
    for value in samples {
        seen.insert(value.to_bits(), *value);
        if seen.len() > MOST_LEVELS {
            return None;
        }
    }
    let mut values: Vec<f32> = seen.into_values().collect();
    values.sort_unstable_by(f32::total_cmp);
    Some(values)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(levels: &Levels, at: usize) -> f32 {
        let per_word = 32 / levels.bits as usize;
        let shifted = levels.words[at / per_word] >> (at % per_word * levels.bits as usize);
        match levels.bits {
            32 => f32::from_bits(shifted),
            bits => levels.values[(shifted & ((1 << bits) - 1)) as usize],
        }
    }

    #[test]
    fn samples_are_read_as_they_were() {
        // Not a whole number of words; zeros of both signs.
        for (count, of, bits) in
            [(1_003, 256, 8), (1_003, 257, 16), (200_001, 1 << 16, 16), (200_001, (1 << 16) + 1, 32), (60, 60, 32)]
        {
            let samples: Vec<f32> =
                (0..count).map(|i| if i == 0 { -0.0 } else { (i * 7 % (of - 1)) as f32 / 3.0 }).collect();
            let levels = Levels::of(&samples);
            assert_eq!(levels.bits, bits, "{of} values");
            for (at, value) in samples.iter().enumerate() {
                assert_eq!(read(&levels, at).to_bits(), value.to_bits(), "{of} values, {at}");
            }
        }
    }
}
