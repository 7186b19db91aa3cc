//! Numbers of several rays at once, one a lane, by whatever instructions the processor has (crate `pulp`).

use std::ops::{Add, BitAnd, BitOr, Mul, Neg, Not, Sub};

use pulp::Simd;

/// No processor has more lanes of 32 bits.
pub const MOST_LANES: usize = 16;

/// What is added to it loses its fraction: its last digit is 1, and its last bits are those of the whole number.
const ROUNDS: f32 = 12_582_912.0;

/// One f32 a lane.
#[derive(Clone, Copy, Debug)]
pub struct Floats<S: Simd> {
    simd: S,
    lanes: S::f32s,
}

/// One u32 a lane.
#[derive(Clone, Copy, Debug)]
pub struct Words<S: Simd> {
    simd: S,
    lanes: S::u32s,
}

/// Some of the lanes.
#[derive(Clone, Copy, Debug)]
pub struct Mask<S: Simd> {
    simd: S,
    lanes: S::m32s,
}

impl<S: Simd> Floats<S> {
    /// The same in all lanes.
    #[inline(always)]
    pub fn splat(simd: S, value: f32) -> Self {
        Self { simd, lanes: simd.splat_f32s(value) }
    }

    /// The same in all lanes.
    #[inline(always)]
    pub fn all(self, value: f32) -> Self {
        Self::splat(self.simd, value)
    }

    /// Lane by lane.
    #[inline(always)]
    pub fn values(&self) -> &[f32] {
        bytemuck::cast_slice(std::slice::from_ref(&self.lanes))
    }

    /// Lane by lane.
    #[inline(always)]
    pub fn values_mut(&mut self) -> &mut [f32] {
        bytemuck::cast_slice_mut(std::slice::from_mut(&mut self.lanes))
    }

    /// `self * factor + term`, rounded once or twice.
    #[inline(always)]
    pub fn mul_add(self, factor: Self, term: Self) -> Self {
        self.map(self.simd.mul_add_e_f32s(self.lanes, factor.lanes, term.lanes))
    }

    /// `self * factor + term`, rounded once.
    #[inline(always)]
    pub fn fused(self, factor: Self, term: Self) -> Self {
        self.map(self.simd.mul_add_f32s(self.lanes, factor.lanes, term.lanes))
    }

    #[inline(always)]
    pub fn over(self, divisor: Self) -> Self {
        self.map(self.simd.div_f32s(self.lanes, divisor.lanes))
    }

    #[inline(always)]
    pub fn sqrt(self) -> Self {
        self.map(self.simd.sqrt_f32s(self.lanes))
    }

    /// To whole numbers; of numbers below 2^22.
    #[inline(always)]
    pub fn rounded(self) -> Self {
        (self + self.all(ROUNDS)) - self.all(ROUNDS)
    }

    /// By the whole power; neither the number nor the result is 0 or denormal.
    #[inline(always)]
    pub fn times_power_of_two(self, power: Self) -> Self {
        let simd = self.simd;
        let whole = simd.transmute_u32s_f32s((power + self.all(ROUNDS)).lanes);
        let exponent = simd.wrapping_dyn_shl_u32s(whole, simd.splat_u32s(23));
        let bits = simd.add_u32s(simd.transmute_u32s_f32s(self.lanes), exponent);
        self.map(simd.transmute_f32s_u32s(bits))
    }

    #[inline(always)]
    pub fn abs(self) -> Self {
        self.map(self.simd.abs_f32s(self.lanes))
    }

    #[inline(always)]
    pub fn min(self, other: Self) -> Self {
        self.map(self.simd.min_f32s(self.lanes, other.lanes))
    }

    #[inline(always)]
    pub fn max(self, other: Self) -> Self {
        self.map(self.simd.max_f32s(self.lanes, other.lanes))
    }

    #[inline(always)]
    pub fn above(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, lanes: self.simd.greater_than_f32s(self.lanes, other.lanes) }
    }

    /// A polynomial; the coefficients begin with the constant.
    #[inline(always)]
    pub fn polynomial<const N: usize>(self, coefficients: [f32; N]) -> Self {
        let mut sum = self.all(coefficients[N - 1]);
        for i in (0..N - 1).rev() {
            sum = sum.mul_add(self, self.all(coefficients[i]));
        }
        sum
    }

    /// Four numbers a lane, as the groups of four lie in `order` (see [`record_order`]).
    #[inline(always)]
    pub fn records(simd: S, records: &[[f32; 4]; MOST_LANES]) -> [Self; 4] {
        let mut packed = [simd.splat_f32s(0.0); 4];
        let floats: &mut [f32] = bytemuck::cast_slice_mut(&mut packed);
        floats.copy_from_slice(&records.as_flattened()[..4 * S::F32_LANES]);
        simd.deinterleave_shfl_f32s(packed).map(|lanes| Self { simd, lanes })
    }

    #[inline(always)]
    fn map(self, lanes: S::f32s) -> Self {
        Self { lanes, ..self }
    }
}

/// The group of [`Floats::records`] that each lane reads.
#[inline(always)]
pub fn record_order<S: Simd>(simd: S) -> [usize; MOST_LANES] {
    let [groups, ..] = Floats::records(simd, &std::array::from_fn(|i| [i as f32; 4]));
    let mut order = [0; MOST_LANES];
    for (place, group) in order.iter_mut().zip(groups.values()) {
        *place = *group as usize;
    }
    order
}

impl<S: Simd> Words<S> {
    /// The same in all lanes.
    #[inline(always)]
    pub fn splat(simd: S, value: u32) -> Self {
        Self { simd, lanes: simd.splat_u32s(value) }
    }

    /// Lane by lane.
    #[inline(always)]
    pub fn values(&self) -> &[u32] {
        bytemuck::cast_slice(std::slice::from_ref(&self.lanes))
    }

    /// Lane by lane.
    #[inline(always)]
    pub fn values_mut(&mut self) -> &mut [u32] {
        bytemuck::cast_slice_mut(std::slice::from_mut(&mut self.lanes))
    }

    #[inline(always)]
    pub fn equals(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, lanes: self.simd.equal_u32s(self.lanes, other.lanes) }
    }

    /// The same in all lanes.
    #[inline(always)]
    pub fn all(self, value: u32) -> Self {
        Self::splat(self.simd, value)
    }

    #[inline(always)]
    pub fn shifted_right(self, bits: u32) -> Self {
        Self { lanes: self.simd.wrapping_dyn_shr_u32s(self.lanes, self.all(bits).lanes), ..self }
    }
}

impl<S: Simd> Mask<S> {
    #[inline(always)]
    pub fn none(simd: S) -> Self {
        Words::splat(simd, 0).equals(Words::splat(simd, 1))
    }

    #[inline(always)]
    pub fn floats(self, inside: Floats<S>, outside: Floats<S>) -> Floats<S> {
        inside.map(self.simd.select_f32s(self.lanes, inside.lanes, outside.lanes))
    }

    #[inline(always)]
    pub fn words(self, inside: Words<S>, outside: Words<S>) -> Words<S> {
        Words { lanes: self.simd.select_u32s(self.lanes, inside.lanes, outside.lanes), ..inside }
    }

    /// Whether any lane is in it.
    #[inline(always)]
    pub fn any(self) -> bool {
        bytemuck::bytes_of(&self.lanes).iter().fold(0, |all, byte| all | byte) != 0
    }

    /// One bit a lane, the first lowest.
    #[inline(always)]
    pub fn bits(self) -> u32 {
        let ones = self.words(Words::splat(self.simd, 1), Words::splat(self.simd, 0));
        let mut bits = 0;
        for (lane, one) in ones.values().iter().enumerate() {
            bits |= one << lane;
        }
        bits
    }

    /// From one bit a lane, the first lowest.
    #[inline(always)]
    pub fn from_bits(simd: S, bits: u32) -> Self {
        let mut ones = Words::splat(simd, 0);
        for (lane, one) in ones.values_mut().iter_mut().enumerate() {
            *one = bits >> lane & 1;
        }
        ones.equals(Words::splat(simd, 1))
    }

    /// The lanes in it, in ascending order.
    #[inline(always)]
    pub fn lanes(self) -> impl Iterator<Item = usize> {
        let mut bits = self.bits();
        std::iter::from_fn(move || {
            let lane = (bits != 0).then_some(bits.trailing_zeros() as usize);
            bits &= bits.wrapping_sub(1);
            lane
        })
    }
}

macro_rules! operator {
    ($type:ident, $trait:ident, $name:ident, $with:ident) => {
        impl<S: Simd> $trait for $type<S> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self { lanes: self.simd.$with(self.lanes, other.lanes), ..self }
            }
        }
    };
}

operator!(Floats, Add, add, add_f32s);
operator!(Floats, Sub, sub, sub_f32s);
operator!(Floats, Mul, mul, mul_f32s);
operator!(Words, Add, add, add_u32s);
operator!(Words, BitAnd, bitand, and_u32s);
operator!(Mask, BitAnd, bitand, and_m32s);
operator!(Mask, BitOr, bitor, or_m32s);

impl<S: Simd> Neg for Floats<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        self.map(self.simd.neg_f32s(self.lanes))
    }
}

impl<S: Simd> Not for Mask<S> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self { lanes: self.simd.not_m32s(self.lanes), ..self }
    }
}

#[cfg(test)]
mod tests {
    use pulp::{Arch, Scalar, WithSimd};

    use super::*;

    struct Check;

    impl WithSimd for Check {
        type Output = ();

        fn with_simd<S: Simd>(self, simd: S) {
            let lanes = S::F32_LANES;
            assert!(lanes <= MOST_LANES);
            for bits in [0, 1, 1 << (lanes - 1), (1 << lanes) - 1, 0b1010_0110_1100_0101 & ((1 << lanes) - 1)] {
                let mask = Mask::from_bits(simd, bits);
                assert_eq!((mask.bits(), mask.any()), (bits, bits != 0));
                assert_eq!(mask.lanes().fold(0, |sum, lane| sum | 1 << lane), bits);
            }
            let (order, mut records) = (record_order(simd), [[0.0; 4]; MOST_LANES]);
            for lane in 0..lanes {
                records[order[lane]] = [0.0, 0.25, 0.5, 0.75].map(|part| lane as f32 + part);
            }
            for (part, lanes) in [0.0, 0.25, 0.5, 0.75].into_iter().zip(Floats::records(simd, &records)) {
                for (lane, &value) in lanes.values().iter().enumerate() {
                    assert_eq!(value, lane as f32 + part);
                }
            }
            let x = Floats::splat(simd, 0.5).polynomial([1.0, 2.0, 4.0]);
            assert!(x.values().iter().all(|&x| x == 3.0));
        }
    }

    #[test]
    fn lanes_are_where_they_are_said_to_be() {
        Arch::new().dispatch(Check);
        Check.with_simd(Scalar);
    }
}
