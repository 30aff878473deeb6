//! Sums of two doubles: some 31 digits, for differences of poles that rounding would hide.
//!
//! Operations of few roundings each, relative error at most 16 x 2^-106 while nothing over- or underflows.
//!
//! Reference: Dekker, *A floating-point technique for extending the available precision*, 1971.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Relative error of an operation, with room: 2^-101.
pub(super) const UNIT: f64 = 1.0 / (1u128 << 101) as f64;

/// `high + low`, with `low` at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Doubled {
    pub high: f64,
    pub low: f64,
}

/// The sum and what it is off.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The same when `a` is not the smaller one.
fn quick(a: f64, b: f64) -> Doubled {
    let high = a + b;
    Doubled { high, low: b - (high - a) }
}

/// Two halves of 26 bits.
fn split(a: f64) -> (f64, f64) {
    let far = 134_217_729.0 * a;
    let high = far - (far - a);
    (high, a - high)
}

/// The product and what it is off.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    (product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
}

impl Doubled {
    pub const fn one() -> Self {
        Self { high: 1.0, low: 0.0 }
    }

    pub fn new(x: f64) -> Self {
        Self { high: x, low: 0.0 }
    }

    /// `a - b`, exactly.
    pub fn difference(a: f64, b: f64) -> Self {
        let (high, low) = two_sum(a, -b);
        Self { high, low }
    }

    /// Times a power of two.
    pub fn scaled(self, factor: f64) -> Self {
        Self { high: self.high * factor, low: self.low * factor }
    }

    /// Nearest double.
    pub fn rounded(self) -> f64 {
        self.high + self.low
    }

    pub fn is_zero(self) -> bool {
        self.high == 0.0 && self.low == 0.0
    }
}

impl Add for Doubled {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let (high, low) = two_sum(self.high, other.high);
        let (more, least) = two_sum(self.low, other.low);
        let sum = quick(high, low + more);
        quick(sum.high, sum.low + least)
    }
}

impl Neg for Doubled {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for Doubled {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Doubled {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (high, low) = two_product(self.high, other.high);
        quick(high, low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for Doubled {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * Self::new(first);
        let second = rest.high / other.high;
        let rest = rest - other * Self::new(second);
        quick(first, second) + Self::new(rest.high / other.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_third_has_thirty_digits() {
        let third = Doubled::one() / Doubled::new(3.0);
        let rest = third * Doubled::new(3.0) - Doubled::one();
        assert!(rest.rounded().abs() < UNIT, "{rest:?}");
        let tiny = Doubled::difference(1.0, 1e-20);
        assert_eq!((Doubled::one() - tiny).rounded(), 1e-20);
        let square = tiny * tiny;
        assert!(((Doubled::one() - square).rounded() / 2e-20 - 1.0).abs() < 1e-10);
    }
}
