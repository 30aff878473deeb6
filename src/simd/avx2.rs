//! Vectors of four doubles in one AVX register, of eight in two.
//!
//! Every intrinsic here needs AVX2; a value of [`Avx2`] is made only where it was detected, and the vectors are used by
//! kernels only, which get such a value.
#![allow(unsafe_code)]

use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Sub};

use super::{Kernel, Lanes, Simd};

/// The proof that AVX2 is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Avx2(());

/// Four doubles.
#[derive(Clone, Copy, Debug)]
pub struct Four(__m256d);

/// Eight doubles.
#[derive(Clone, Copy, Debug)]
pub struct Eight([Four; 2]);

impl Simd for Avx2 {
    type F4 = Four;
    type F8 = Eight;
}

impl Avx2 {
    /// A value, if the machine has the instructions.
    pub fn detect() -> Option<Self> {
        is_x86_feature_detected!("avx2").then_some(Self(()))
    }

    #[inline(always)]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Out {
        #[target_feature(enable = "avx2")]
        fn inner<K: Kernel>(kernel: K, simd: Avx2) -> K::Out {
            kernel.run(simd)
        }
        // SAFETY: `self` exists, so AVX2 is there.
        unsafe { inner(kernel, self) }
    }
}

macro_rules! operations {
    ($($operation:ident, $name:ident, $intrinsic:ident;)*) => {
        $(impl $operation for Four {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: vectors exist only where AVX2 does.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        }

        impl $operation for Eight {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                let ([a, b], [c, d]) = (self.0, other.0);
                Self([$operation::$name(a, c), $operation::$name(b, d)])
            }
        })*
    };
}

operations! {
    Add, add, _mm256_add_pd;
    Sub, sub, _mm256_sub_pd;
    Mul, mul, _mm256_mul_pd;
    Div, div, _mm256_div_pd;
}

impl Lanes<4> for Four {
    #[inline(always)]
    fn load(values: &[f64; 4]) -> Self {
        // SAFETY: four doubles are readable; vectors are made only where AVX2 is.
        Self(unsafe { _mm256_loadu_pd(values.as_ptr()) })
    }

    #[inline(always)]
    fn store(self, out: &mut [f64; 4]) {
        // SAFETY: four doubles are writable; vectors exist only where AVX2 does.
        unsafe { _mm256_storeu_pd(out.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: vectors are made only where AVX2 is.
        Self(unsafe { _mm256_set1_pd(value) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: vectors exist only where AVX2 does.
        Self(unsafe { _mm256_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: vectors exist only where AVX2 does.
        Self(unsafe { _mm256_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: vectors exist only where AVX2 does.
        Self(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }

    #[inline(always)]
    fn where_less(self, a: Self, b: Self, other: Self) -> Self {
        // SAFETY: vectors exist only where AVX2 does.
        Self(unsafe { _mm256_blendv_pd(other.0, self.0, _mm256_cmp_pd::<_CMP_LT_OQ>(a.0, b.0)) })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: vectors exist only where AVX2 does.
        Self(unsafe { _mm256_sqrt_pd(self.0) })
    }

    #[inline(always)]
    fn less(self, other: Self) -> u32 {
        // SAFETY: vectors exist only where AVX2 does.
        let bits = unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0)) };
        bits as u32
    }
}

#[inline(always)]
fn halves(values: &[f64; 8]) -> [&[f64; 4]; 2] {
    // SAFETY: the first and the last four of eight doubles.
    unsafe { [&*values.as_ptr().cast(), &*values.as_ptr().add(4).cast()] }
}

impl Lanes<8> for Eight {
    #[inline(always)]
    fn load(values: &[f64; 8]) -> Self {
        let [a, b] = halves(values);
        Self([Four::load(a), Four::load(b)])
    }

    #[inline(always)]
    fn store(self, out: &mut [f64; 8]) {
        // SAFETY: the first and the last four of eight doubles.
        unsafe {
            self.0[0].store(&mut *out.as_mut_ptr().cast());
            self.0[1].store(&mut *out.as_mut_ptr().add(4).cast());
        }
    }

    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([Four::splat(value); 2])
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        let ([a, b], [c, d]) = (self.0, other.0);
        Self([a.min(c), b.min(d)])
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        let ([a, b], [c, d]) = (self.0, other.0);
        Self([a.max(c), b.max(d)])
    }

    #[inline(always)]
    fn abs(self) -> Self {
        let [a, b] = self.0;
        Self([a.abs(), b.abs()])
    }

    #[inline(always)]
    fn where_less(self, a: Self, b: Self, other: Self) -> Self {
        let ([x, y], [z, w]) = (self.0, other.0);
        Self([x.where_less(a.0[0], b.0[0], z), y.where_less(a.0[1], b.0[1], w)])
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        let [a, b] = self.0;
        Self([a.sqrt(), b.sqrt()])
    }

    #[inline(always)]
    fn less(self, other: Self) -> u32 {
        let ([a, b], [c, d]) = (self.0, other.0);
        a.less(c) | b.less(d) << 4
    }
}
