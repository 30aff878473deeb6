//! Intervals that hold every value that exact arithmetic could give: each bound is rounded outward.
//!
//! Reference: Moore, Kearfott, Cloud, *Introduction to Interval Analysis*, 2009.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// All numbers from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Least number.
    pub low: f64,
    /// Greatest number.
    pub high: f64,
}

impl Interval {
    /// Nothing is known.
    pub const ENTIRE: Self = Self { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// One number.
    pub const fn point(x: f64) -> Self {
        Self { low: x, high: x }
    }

    /// All numbers nearer to `x` than `error`.
    pub fn around(x: f64, error: f64) -> Self {
        Self::outward(x - error, x + error)
    }

    /// Rounded outward; what is no number tells nothing.
    fn outward(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self::ENTIRE;
        }
        Self { low: low.next_down(), high: high.next_up() }
    }

    /// The middle.
    pub fn middle(self) -> f64 {
        0.5 * self.low + 0.5 * self.high
    }

    /// Greatest absolute value.
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// Least absolute value.
    pub fn least_magnitude(self) -> f64 {
        if self.holds_zero() { 0.0 } else { self.low.abs().min(self.high.abs()) }
    }

    /// Whether zero is one of the numbers.
    pub fn holds_zero(self) -> bool {
        self.low <= 0.0 && self.high >= 0.0
    }

    /// What lies in both; `self` when rounding made them miss each other.
    pub fn and(self, other: Self) -> Self {
        let both = Self { low: self.low.max(other.low), high: self.high.min(other.high) };
        if both.low <= both.high { both } else { self }
    }

    /// The least interval that holds both.
    pub fn or(self, other: Self) -> Self {
        Self { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    /// All squares.
    pub fn squared(self) -> Self {
        let (low, high) = (self.least_magnitude(), self.magnitude());
        let squares = Self::outward(low * low, high * high);
        Self { low: squares.low.max(0.0), ..squares }
    }

    /// All roots of what is not negative.
    pub fn sqrt(self) -> Self {
        let roots = Self::outward(self.low.max(0.0).sqrt(), self.high.max(0.0).sqrt());
        Self { low: roots.low.max(0.0), ..roots }
    }

    /// Times a number.
    pub fn times(self, x: f64) -> Self {
        self * Self::point(x)
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::outward(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::outward(self.low - other.high, self.high - other.low)
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { low: -self.high, high: -self.low }
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let [a, b] = [self.low * other.low, self.low * other.high];
        let [c, d] = [self.high * other.low, self.high * other.high];
        if (a + b + c + d).is_nan() {
            return Self::ENTIRE;
        }
        Self::outward(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}

impl Div for Interval {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.holds_zero() {
            return Self::ENTIRE;
        }
        let [a, b] = [self.low / other.low, self.low / other.high];
        let [c, d] = [self.high / other.low, self.high / other.high];
        if (a + b + c + d).is_nan() {
            return Self::ENTIRE;
        }
        Self::outward(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn operations_hold_the_results_of_their_numbers() {
        let pairs =
            [(-2.0, 3.0), (0.5, 0.7), (-4.0, -1.0)].map(|(low, high)| Interval { low, high });
        for x in pairs {
            for y in pairs {
                for i in 0..=4 {
                    for j in 0..=4 {
                        let a = x.low + (x.high - x.low) * i as f64 / 4.0;
                        let b = y.low + (y.high - y.low) * j as f64 / 4.0;
                        let holds = |z: Interval, c: f64| z.low <= c && c <= z.high;
                        assert!(holds(x + y, a + b) && holds(x - y, a - b) && holds(x * y, a * b));
                        assert!(holds(x / y, a / b) && holds(x.squared(), a * a));
                        assert!(a < 0.0 || holds(x.sqrt(), a.sqrt()));
                    }
                }
            }
        }
    }

    #[test]
    fn what_is_no_number_tells_nothing() {
        assert_eq!(Interval::point(1.0) / Interval { low: -1.0, high: 1.0 }, Interval::ENTIRE);
        assert_eq!(Interval::ENTIRE * Interval::point(0.0), Interval::ENTIRE);
        assert_eq!(Interval::ENTIRE - Interval::ENTIRE, Interval::ENTIRE);
        let third = Interval::point(1.0) / Interval::point(3.0);
        assert!(third.low < third.high && (third.times(3.0) - Interval::point(1.0)).holds_zero());
    }
}
