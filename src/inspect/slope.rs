//! Functions on a box, each known by three intervals: at the middle, over the box, and its gradient over the box.
//!
//! ```text
//!   f(x)  lies in  f(middle) + gradient * (x - middle)      and in what interval arithmetic says
//! ```
//!
//! The first form errs by the square of the box's width, the second by the width; the range is what both allow. Local
//! parameters run from 0 to 1.
//!
//! Reference: Neumaier, *Interval Methods for Systems of Equations*, 1990, section 2.3.

use super::interval::Interval;
use std::ops::{Add, Div, Mul, Sub};

/// A function of `N` parameters on a box.
#[derive(Clone, Copy, Debug)]
pub struct Slope<const N: usize> {
    /// At the middle of the box.
    pub middle: Interval,
    /// Over the box.
    pub range: Interval,
    /// Derivatives in the local parameters, over the box.
    pub gradient: [Interval; N],
}

impl<const N: usize> Slope<N> {
    /// A function of which the range is known one way; the other way may make it narrower.
    pub fn new(middle: Interval, range: Interval, gradient: [Interval; N]) -> Self {
        let half = Interval { low: -0.5, high: 0.5 };
        let moved = gradient.iter().fold(middle, |sum, &slope| sum + slope * half);
        Self { middle, range: range.and(moved), gradient }
    }

    /// The square.
    pub fn squared(self) -> Self {
        let twice = self.range.times(2.0);
        let gradient = self.gradient.map(|slope| slope * twice);
        Self::new(self.middle.squared(), self.range.squared(), gradient)
    }

    /// The root of a function that is not negative.
    pub fn sqrt(self) -> Self {
        let root = self.range.sqrt();
        let gradient = self.gradient.map(|slope| slope / root.times(2.0));
        Self::new(self.middle.sqrt(), root, gradient)
    }

    /// Times a number.
    pub fn times(self, x: f64) -> Self {
        let gradient = self.gradient.map(|slope| slope.times(x));
        Self { middle: self.middle.times(x), range: self.range.times(x), gradient }
    }
}

impl<const N: usize> Add for Slope<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let gradient = std::array::from_fn(|k| self.gradient[k] + other.gradient[k]);
        Self::new(self.middle + other.middle, self.range + other.range, gradient)
    }
}

impl<const N: usize> Sub for Slope<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        let gradient = std::array::from_fn(|k| self.gradient[k] - other.gradient[k]);
        Self::new(self.middle - other.middle, self.range - other.range, gradient)
    }
}

impl<const N: usize> Mul for Slope<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let slope = |k: usize| self.gradient[k] * other.range + other.gradient[k] * self.range;
        let gradient = std::array::from_fn(slope);
        Self::new(self.middle * other.middle, self.range * other.range, gradient)
    }
}

impl<const N: usize> Div for Slope<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let range = self.range / other.range;
        let slope = |k: usize| (self.gradient[k] - range * other.gradient[k]) / other.range;
        let gradient = std::array::from_fn(slope);
        Self::new(self.middle / other.middle, range, gradient)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The parameter x on [low, high].
    fn parameter(low: f64, high: f64) -> Slope<1> {
        let middle = Interval::point(0.5 * (low + high));
        Slope::new(middle, Interval { low, high }, [Interval::around(high - low, 1e-15)])
    }

    #[test]
    fn ranges_hold_all_values_and_err_by_the_square_of_the_width() {
        // f(x) = sqrt(x^2 + 1) / x - x * x
        let f = |x: f64| (x * x + 1.0).sqrt() / x - x * x;
        let mut before = f64::INFINITY;
        for k in 2..10 {
            let width = 0.5f64.powi(k);
            let x = parameter(1.0, 1.0 + width);
            let one = Slope {
                middle: Interval::point(1.0),
                range: Interval::point(1.0),
                gradient: [Interval::point(0.0)],
            };
            let value = (x.squared() + one).sqrt() / x - x * x;
            for i in 0..=16 {
                let y = f(1.0 + width * i as f64 / 16.0);
                assert!(value.range.low <= y && y <= value.range.high);
            }
            let excess = (value.range.high - value.range.low) - (f(1.0) - f(1.0 + width)).abs();
            assert!(excess < 0.3 * before, "{excess} after {before}");
            before = excess;
        }
    }
}
