//! Vectors as arrays, for every machine.

use std::ops::{Add, Div, Mul, Sub};

use super::{Kernel, Lanes, Simd};

/// The level that every machine has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Portable;

/// An array that computes lane by lane.
#[derive(Clone, Copy, Debug)]
pub struct Array<const N: usize>([f64; N]);

impl Simd for Portable {
    type F4 = Array<4>;
    type F8 = Array<8>;
}

#[inline(never)]
pub fn run<K: Kernel>(kernel: K) -> K::Out {
    kernel.run(Portable)
}

macro_rules! lanewise {
    ($($operation:ident, $name:ident, $sign:tt;)*) => {
        $(impl<const N: usize> $operation for Array<N> {
            type Output = Self;

            #[inline(always)]
            fn $name(mut self, other: Self) -> Self {
                for k in 0..N {
                    let (a, b) = (self.0[k], other.0[k]);
                    self.0[k] = a $sign b;
                }
                self
            }
        })*
    };
}

lanewise! { Add, add, +; Sub, sub, -; Mul, mul, *; Div, div, /; }

/// One double: what single queries and what lanes of many compute is one body.
impl Lanes<1> for f64 {
    #[inline(always)]
    fn load(values: &[f64; 1]) -> Self {
        values[0]
    }

    #[inline(always)]
    fn store(self, out: &mut [f64; 1]) {
        out[0] = self;
    }

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }

    #[inline(always)]
    fn where_less(self, a: Self, b: Self, other: Self) -> Self {
        if a < b { self } else { other }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn less(self, other: Self) -> u32 {
        u32::from(self < other)
    }
}

impl<const N: usize> Lanes<N> for Array<N> {
    #[inline(always)]
    fn load(values: &[f64; N]) -> Self {
        Self(*values)
    }

    #[inline(always)]
    fn store(self, out: &mut [f64; N]) {
        *out = self.0;
    }

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; N])
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.where_less(self, other, other)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.where_less(other, self, other)
    }

    #[inline(always)]
    fn abs(mut self) -> Self {
        for k in 0..N {
            self.0[k] = self.0[k].abs();
        }
        self
    }

    #[inline(always)]
    fn where_less(mut self, a: Self, b: Self, other: Self) -> Self {
        for k in 0..N {
            self.0[k] = if a.0[k] < b.0[k] { self.0[k] } else { other.0[k] };
        }
        self
    }

    #[inline(always)]
    fn sqrt(mut self) -> Self {
        for k in 0..N {
            self.0[k] = self.0[k].sqrt();
        }
        self
    }

    #[inline(always)]
    fn less(self, other: Self) -> u32 {
        let mut bits = 0;
        for k in 0..N {
            bits |= u32::from(self.0[k] < other.0[k]) << k;
        }
        bits
    }
}
