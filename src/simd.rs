//! Vector instructions, chosen at run time.
//!
//! A kernel is one body, generic over the vectors of a [`Simd`]; [`Level::run`] compiles it once for each level and calls
//! the one that the machine has.
//!
//! ```text
//!   body (inline) --+-- portable          arrays; SSE2 on x86-64, NEON on aarch64
//!                   +-- AVX2              4 doubles a register
//!                   '-- AVX-512 F, VL, DQ 8 doubles
//! ```
//!
//! The bits are the same on every path: lanes never meet but in [`Lanes::least`] and [`Lanes::greatest`], whose order is fixed, no operation is
//! fused, and `min` and `max` return their second argument when neither is less or greater. `tests/levels.rs` compares
//! whole answers.
//!
//! Limit: other machines than x86-64 have the portable level only.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod portable;

use std::ops::{Add, Div, Mul, Sub};

pub use portable::Portable;

/// Items that are worked on together, one a lane.
pub const WIDTH: usize = 8;

/// Highest degree of shapes whose queries are.
pub const MOST_DEGREE: usize = 9;

/// A number of each of them.
pub type Row = [f64; WIDTH];

/// A vector of `N` doubles; a double is one of one.
pub trait Lanes<const N: usize>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    /// From memory.
    fn load(values: &[f64; N]) -> Self;
    /// To memory.
    fn store(self, out: &mut [f64; N]);
    /// The same value in every lane.
    fn splat(value: f64) -> Self;
    /// Lane by lane `if self < other { self } else { other }`.
    fn min(self, other: Self) -> Self;
    /// Lane by lane `if self > other { self } else { other }`.
    fn max(self, other: Self) -> Self;
    /// Lane by lane without the sign.
    fn abs(self) -> Self;
    /// Lane by lane `if a < b { self } else { other }`.
    fn where_less(self, a: Self, b: Self, other: Self) -> Self;
    /// Lane by lane the square root.
    fn sqrt(self) -> Self;
    /// Where `self < other`: bit k is lane k.
    fn less(self, other: Self) -> u32;

    /// The lanes as an array.
    #[inline(always)]
    fn array(self) -> [f64; N] {
        let mut out = [0.0; N];
        self.store(&mut out);
        out
    }

    /// The least lane; halves are compared first: lane 0 meets lane N/2.
    #[inline(always)]
    fn least(self) -> f64 {
        let mut x = self.array();
        let mut n = N / 2;
        while n > 0 {
            for k in 0..n {
                x[k] = if x[k + n] < x[k] { x[k + n] } else { x[k] };
            }
            n /= 2;
        }
        x[0]
    }

    /// The greatest lane, as [`Self::least`].
    #[inline(always)]
    fn greatest(self) -> f64 {
        let mut x = self.array();
        let mut n = N / 2;
        while n > 0 {
            for k in 0..n {
                x[k] = if x[k + n] > x[k] { x[k + n] } else { x[k] };
            }
            n /= 2;
        }
        x[0]
    }
}

/// Numbers of up to [`WIDTH`] items, lane by lane; of fewer, the first fills the rest.
#[inline]
pub fn row<T>(items: &[T], number: impl Fn(&T) -> f64) -> Row {
    let mut row = [number(&items[0]); WIDTH];
    for (lane, item) in row.iter_mut().zip(items) {
        *lane = number(item);
    }
    row
}

/// The vectors of a level. A value of such a type is the proof that the instructions are there.
pub trait Simd: Copy {
    /// Four doubles.
    type F4: Lanes<4>;
    /// Eight doubles.
    type F8: Lanes<8>;
}

/// One computation, compiled for every level. `run` must be `#[inline(always)]`, and so must what it calls: no closures,
/// which cannot be marked so, and no `map` of arrays.
pub trait Kernel {
    /// What it returns.
    type Out;
    /// The body.
    fn run<S: Simd>(self, simd: S) -> Self::Out;
}

/// How wide a machine's vectors are. Values come from [`Level::detect`] and [`Level::available`] only, so a level that
/// exists can be run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level(Width);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Width {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2(avx2::Avx2),
    #[cfg(target_arch = "x86_64")]
    Avx512(avx512::Avx512),
}

impl Default for Level {
    fn default() -> Self {
        Self::detect()
    }
}

impl Level {
    /// What every machine has.
    pub const PORTABLE: Self = Self(Width::Portable);

    /// The widest level of this machine.
    pub fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(simd) = avx512::Avx512::detect() {
                return Self(Width::Avx512(simd));
            }
            if let Some(simd) = avx2::Avx2::detect() {
                return Self(Width::Avx2(simd));
            }
        }
        Self::PORTABLE
    }

    /// All levels of this machine, the narrowest first.
    pub fn available() -> Vec<Self> {
        #[cfg(target_arch = "x86_64")]
        let wider = [
            avx2::Avx2::detect().map(|simd| Self(Width::Avx2(simd))),
            avx512::Avx512::detect().map(|simd| Self(Width::Avx512(simd))),
        ];
        #[cfg(not(target_arch = "x86_64"))]
        let wider: [Option<Self>; 0] = [];
        std::iter::once(Self::PORTABLE).chain(wider.into_iter().flatten()).collect()
    }

    /// Runs a kernel with the instructions of this level.
    #[inline(always)]
    pub fn run<K: Kernel>(self, kernel: K) -> K::Out {
        match self.0 {
            Width::Portable => portable::run(kernel),
            #[cfg(target_arch = "x86_64")]
            Width::Avx2(simd) => simd.run(kernel),
            #[cfg(target_arch = "x86_64")]
            Width::Avx512(simd) => simd.run(kernel),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Everything<'a>(&'a [[f64; 8]]);

    impl Kernel for Everything<'_> {
        type Out = [f64; 12];

        #[inline(always)]
        fn run<S: Simd>(self, _: S) -> [f64; 12] {
            let (mut sum, mut low) = (S::F8::splat(1.0), S::F8::splat(f64::INFINITY));
            let mut four = S::F4::splat(0.5);
            for x in self.0 {
                let y = S::F8::load(x);
                sum = (sum + y * y).where_less(low, y, sum / y);
                low = low.min(y - sum.max(S::F8::splat(0.25)).abs());
                let z = S::F4::load(&[x[1], x[2], x[3], x[5]]);
                four = (four * z - z).max(z).where_less(four, z, four / z).abs().min(z + z);
                let bits = y.less(low) | four.less(z) << 8;
                sum = sum + y.abs().sqrt() * S::F8::splat(f64::from(bits));
                four = four + z.abs().sqrt();
            }
            let (a, b) = (sum.array(), four.array());
            let mut out = [0.0; 12];
            out[..8].copy_from_slice(&a);
            out[8..].copy_from_slice(&b);
            out[0] += low.least() + four.greatest();
            out
        }
    }

    #[test]
    fn every_level_gives_the_same_bits() {
        let value = |i: usize, k: usize| ((i * 37 + k * 11) % 101) as f64 / 7.0 - 3.1;
        let values: Vec<[f64; 8]> =
            (0..100).map(|i| std::array::from_fn(|k| value(i, k))).collect();
        let expected = Level::PORTABLE.run(Everything(&values)).map(f64::to_bits);
        for level in Level::available() {
            assert_eq!(level.run(Everything(&values)).map(f64::to_bits), expected, "{level:?}");
        }
    }
}
