//! Vectors of eight doubles in one AVX-512 register, of four in one AVX register.
//!
//! Every intrinsic here needs AVX-512 F; a value of [`Avx512`] is made only where it was detected, and the vectors are used
//! by kernels only, which get such a value.
#![allow(unsafe_code)]

use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Sub};

use super::avx2::Four;
use super::{Kernel, Lanes, Simd};

/// The proof that AVX-512 F, VL and DQ are there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Avx512(());

/// Eight doubles.
#[derive(Clone, Copy, Debug)]
pub struct Eight(__m512d);

impl Simd for Avx512 {
    type F4 = Four;
    type F8 = Eight;
}

impl Avx512 {
    /// A value, if the machine has the instructions.
    pub fn detect() -> Option<Self> {
        let all = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512dq");
        all.then_some(Self(()))
    }

    #[inline(always)]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Out {
        #[target_feature(enable = "avx2,avx512f,avx512vl,avx512dq")]
        fn inner<K: Kernel>(kernel: K, simd: Avx512) -> K::Out {
            kernel.run(simd)
        }
        // SAFETY: `self` exists, so the instructions are there.
        unsafe { inner(kernel, self) }
    }
}

macro_rules! operations {
    ($($operation:ident, $name:ident, $intrinsic:ident;)*) => {
        $(impl $operation for Eight {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: vectors exist only where AVX-512 does.
                Self(unsafe { $intrinsic(self.0, other.0) })
            }
        })*
    };
}

operations! {
    Add, add, _mm512_add_pd;
    Sub, sub, _mm512_sub_pd;
    Mul, mul, _mm512_mul_pd;
    Div, div, _mm512_div_pd;
}

impl Lanes<8> for Eight {
    #[inline(always)]
    fn load(values: &[f64; 8]) -> Self {
        // SAFETY: eight doubles are readable; vectors are made only where AVX-512 is.
        Self(unsafe { _mm512_loadu_pd(values.as_ptr()) })
    }

    #[inline(always)]
    fn store(self, out: &mut [f64; 8]) {
        // SAFETY: eight doubles are writable; vectors exist only where AVX-512 does.
        unsafe { _mm512_storeu_pd(out.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn splat(value: f64) -> Self {
        // SAFETY: vectors are made only where AVX-512 is.
        Self(unsafe { _mm512_set1_pd(value) })
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: vectors exist only where AVX-512 does.
        Self(unsafe { _mm512_min_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: vectors exist only where AVX-512 does.
        Self(unsafe { _mm512_max_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: vectors exist only where AVX-512 does.
        Self(unsafe { _mm512_abs_pd(self.0) })
    }

    #[inline(always)]
    fn where_less(self, a: Self, b: Self, other: Self) -> Self {
        // SAFETY: vectors exist only where AVX-512 does.
        Self(unsafe {
            let less = _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a.0, b.0);
            _mm512_mask_blend_pd(less, other.0, self.0)
        })
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: vectors exist only where AVX-512 does.
        Self(unsafe { _mm512_sqrt_pd(self.0) })
    }

    #[inline(always)]
    fn less(self, other: Self) -> u32 {
        // SAFETY: vectors exist only where AVX-512 does.
        let bits = unsafe { _mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.0, other.0) };
        u32::from(bits)
    }
}
