//! Sums of two doubles: 106 bits, so that a verdict does not hang on rounding.
//!
//! References: Dekker, *A floating-point technique for extending the available precision*, 1971; Knuth, *The Art of
//! Computer Programming*, vol. 2, 4.2.2. Limit: factors beyond 1e300 overflow when they are split.

#![allow(dead_code, reason = "each program uses its own part")]

/// The unevaluated sum of a double and a much smaller one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Double(pub f64, pub f64);

/// The two halves of a double's digits.
fn split(a: f64) -> [f64; 2] {
    let c = 134_217_729.0 * a;
    let high = c - (c - a);
    [high, a - high]
}

impl Double {
    pub const ZERO: Self = Self(0.0, 0.0);

    /// `a + b`, exactly.
    pub fn sum(a: f64, b: f64) -> Self {
        let s = a + b;
        let t = s - a;
        Self(s, (a - (s - t)) + (b - t))
    }

    /// `a b`, exactly.
    pub fn product(a: f64, b: f64) -> Self {
        let p = a * b;
        let ([a0, a1], [b0, b1]) = (split(a), split(b));
        Self(p, ((a0 * b0 - p) + a0 * b1 + a1 * b0) + a1 * b1)
    }

    pub fn of(a: f64) -> Self {
        Self(a, 0.0)
    }

    pub fn value(self) -> f64 {
        self.0 + self.1
    }

    pub fn plus(self, b: Self) -> Self {
        let Self(s, e) = Self::sum(self.0, b.0);
        Self::sum(s, e + (self.1 + b.1))
    }

    pub fn minus(self, b: Self) -> Self {
        self.plus(Self(-b.0, -b.1))
    }

    pub fn times(self, b: Self) -> Self {
        let Self(p, e) = Self::product(self.0, b.0);
        Self::sum(p, e + (self.0 * b.1 + self.1 * b.0))
    }

    pub fn over(self, b: Self) -> Self {
        let q = self.0 / b.0;
        let rest = self.minus(b.times(Self::of(q)));
        Self::sum(q, (rest.0 + rest.1) / b.0)
    }

    pub fn is_less(self, b: Self) -> bool {
        self.minus(b).value() < 0.0
    }

    /// The nearest of the numbers from `low` to `high`.
    pub fn clamp(self, low: f64, high: f64) -> Self {
        if self.is_less(Self::of(low)) {
            Self::of(low)
        } else if Self::of(high).is_less(self) {
            Self::of(high)
        } else {
            self
        }
    }
}
