//! Lower bounds of distances: boxes, separating planes, and the rounding each carries.
//!
//! All rounding here is a-priori: every bound is a number of half ulps (`HALF_ULP` = 2^-53) times a length that
//! dominates all terms. `docs/rounding.md` derives the counts.
//!
//! References: Higham, *Accuracy and Stability of Numerical Algorithms*, chapter 3.

use crate::simd::Lanes;

/// Unit roundoff of a double.
pub const HALF_ULP: f64 = 1.110_223_024_625_156_5e-16;

/// A point or vector in space.
pub type Vector = [f64; 3];

/// `a . b`.
#[inline(always)]
pub fn dot<V: Lanes<N>, const N: usize>(a: [V; 3], b: [V; 3]) -> V {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `a - b`.
pub fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// `a + b`.
pub fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `x * a`.
pub fn scaled(a: Vector, x: f64) -> Vector {
    [a[0] * x, a[1] * x, a[2] * x]
}

/// `a x b`.
#[inline(always)]
pub fn cross<V: Lanes<N>, const N: usize>(a: [V; 3], b: [V; 3]) -> [V; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `|a|`.
#[inline(always)]
pub fn norm<V: Lanes<N>, const N: usize>(a: [V; 3]) -> V {
    dot(a, a).sqrt()
}

/// An axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Least coordinates.
    pub low: Vector,
    /// Greatest coordinates.
    pub high: Vector,
}

impl Aabb {
    /// The box that holds nothing.
    pub const EMPTY: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    /// Grows to hold `point`.
    pub fn include(&mut self, point: Vector) {
        for k in 0..3 {
            self.low[k] = self.low[k].min(point[k]);
            self.high[k] = self.high[k].max(point[k]);
        }
    }

    /// The least box that holds both.
    pub fn union(mut self, other: Self) -> Self {
        self.include(other.low);
        self.include(other.high);
        self
    }

    /// The box grown by `margin` on every side, rounded outward.
    pub fn grown(self, margin: f64) -> Self {
        Self {
            low: self.low.map(|x| (x - margin).next_down()),
            high: self.high.map(|x| (x + margin).next_up()),
        }
    }

    /// Length of the diagonal.
    pub fn diagonal(&self) -> f64 {
        norm(sub(self.high, self.low))
    }
}

/// Least value of a slice; the values are finite (checked where they are made).
///
/// Four lanes, so that the compiler can use vector minima.
pub fn least(values: &[f64]) -> f64 {
    let mut lanes = [f64::INFINITY; 8];
    let chunks = values.chunks_exact(8);
    for &x in chunks.remainder() {
        lanes[0] = if x < lanes[0] { x } else { lanes[0] };
    }
    for chunk in chunks {
        for k in 0..8 {
            lanes[k] = if chunk[k] < lanes[k] { chunk[k] } else { lanes[k] };
        }
    }
    lanes.iter().fold(f64::INFINITY, |a, &b| if b < a { b } else { a })
}

/// Least and greatest value of a slice of finite values.
pub fn extent(values: &[f64]) -> (f64, f64) {
    let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
    let chunks = values.chunks_exact(4);
    for &x in chunks.remainder() {
        low[0] = if x < low[0] { x } else { low[0] };
        high[0] = if x > high[0] { x } else { high[0] };
    }
    for chunk in chunks {
        for k in 0..4 {
            low[k] = if chunk[k] < low[k] { chunk[k] } else { low[k] };
            high[k] = if chunk[k] > high[k] { chunk[k] } else { high[k] };
        }
    }
    let least = low.iter().fold(f64::INFINITY, |a, &b| if b < a { b } else { a });
    (least, high.iter().fold(f64::NEG_INFINITY, |a, &b| if b > a { b } else { a }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extent_sees_every_element() {
        for n in 1..20 {
            for k in 0..n {
                let mut values = vec![0.5; n];
                values[k] = -3.0;
                assert_eq!((extent(&values).0, least(&values)), (-3.0, -3.0));
                values[k] = 7.0;
                assert_eq!(extent(&values).1, 7.0);
            }
        }
    }

    #[test]
    fn a_grown_box_holds_its_margin() {
        let mut b = Aabb::EMPTY;
        b.include([1.0, 2.0, 3.0]);
        let g = b.grown(1e-20);
        assert!(g.low[0] < 1.0 && g.high[2] > 3.0);
        assert_eq!(b.union(Aabb { low: [0.0; 3], high: [9.0; 3] }).diagonal(), norm([9.0; 3]));
    }
}
