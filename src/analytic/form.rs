//! Polynomials in Bernstein form whose coefficients carry a bound of their own rounding.
//!
//! Each operation adds what it rounds and passes on what was there (`docs/rounding.md`, section 16). Used while an index
//! is built, so clarity goes before speed.

use crate::bezier::{Bidegree, convolve, divided_by_side, elevated, scale_down_2d, scale_up_2d};
use crate::bounds::HALF_ULP;

/// Greatest degree of a direction: beyond it binomials are no doubles.
pub const MOST_DEGREE: usize = 56;

/// Coefficients below this may have lost digits to underflow; nothing is divided by them.
const LEAST_DIVISOR: f64 = 1e-250;

/// A polynomial in two parameters.
#[derive(Clone, Debug)]
pub struct Form {
    degree: Bidegree,
    value: Vec<f64>,
    error: Vec<f64>,
}

impl Form {
    /// Coefficients that are exact.
    pub fn exact(degree: Bidegree, value: Vec<f64>) -> Self {
        let error = vec![0.0; value.len()];
        Self { degree, value, error }
    }

    /// The product. Binomials are exact up to degree [`MOST_DEGREE`]; products of two of them have one rounding.
    pub fn times(&self, other: &Self) -> Self {
        let degree = self.degree.times(other.degree);
        debug_assert!(degree.s <= MOST_DEGREE && degree.t <= MOST_DEGREE);
        let raised = |x: &[f64], d: Bidegree| {
            let mut x = x.to_vec();
            scale_up_2d(&mut x, d);
            x
        };
        let absolute = |x: &[f64]| x.iter().map(|x| x.abs()).collect::<Vec<f64>>();
        let product = |f: &[f64], g: &[f64]| {
            let mut out = vec![0.0; degree.count()];
            let (f, g) = (raised(f, self.degree), raised(g, other.degree));
            convolve(&f, self.degree, &g, other.degree, 1.0, &mut out);
            scale_down_2d(&mut out, degree);
            out
        };
        let (f, g) = (absolute(&self.value), absolute(&other.value));
        let terms = self.value.len().min(other.value.len());
        // Scaling up 2 + 2, the product 1, the sum `terms - 1`, scaling down 3; doubled for the sums below.
        let steps = (2 * terms + 24) as f64 * HALF_ULP;
        let whole = product(&f, &g);
        let outer: Vec<f64> = g.iter().zip(&other.error).map(|(g, e)| g + e).collect();
        let passed = [product(&f, &other.error), product(&self.error, &outer)];
        let error = (0..whole.len())
            .map(|k| (passed[0][k] + passed[1][k] + steps * whole[k]) * (1.0 + 1e-9))
            .collect();
        Self { degree, value: product(&self.value, &other.value), error }
    }

    /// `self + factor * other`; the factor may be off by two half ulps.
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        debug_assert!(self.degree == other.degree);
        let size = factor.abs() * (1.0 + 4.0 * HALF_ULP);
        let value: Vec<f64> =
            self.value.iter().zip(&other.value).map(|(x, y)| x + factor * y).collect();
        let error = (0..value.len())
            .map(|k| {
                let terms = self.value[k].abs() + size * other.value[k].abs();
                (self.error[k] + size * other.error[k] + 6.0 * HALF_ULP * terms) * (1.0 + 1e-9)
            })
            .collect();
        Self { degree: self.degree, value, error }
    }

    /// `factor * self`; the factor may be off by two half ulps.
    pub fn scaled(&self, factor: f64) -> Self {
        let zero = Self::exact(self.degree, vec![0.0; self.value.len()]);
        zero.plus(factor, self)
    }

    /// The sum of the squares of forms of one bidegree.
    pub fn sum_of_squares(forms: &[&Self]) -> Self {
        let squares: Vec<Self> = forms.iter().map(|form| form.times(form)).collect();
        squares[1..].iter().fold(squares[0].clone(), |sum, square| sum.plus(1.0, square))
    }

    /// The same polynomial with the degree one higher in direction 0 or 1.
    pub fn elevated(&self, direction: usize) -> Self {
        let mut degree = self.degree;
        if direction == 0 {
            degree.s += 1
        } else {
            degree.t += 1
        };
        let absolute: Vec<f64> = self.value.iter().map(|x| x.abs()).collect();
        let own = elevated(&absolute, self.degree, direction);
        let passed = elevated(&self.error, self.degree, direction);
        let error =
            own.iter().zip(&passed).map(|(x, e)| (e + 8.0 * HALF_ULP * x) * (1.0 + 1e-9)).collect();
        Self { degree, value: elevated(&self.value, self.degree, direction), error }
    }

    /// `self / x` with x = s, 1 - s, t or 1 - t; the coefficients on that side count as zero.
    pub fn divided_by_side(&self, side: usize) -> Self {
        let value = divided_by_side(&self.value, self.degree, side);
        let passed = divided_by_side(&self.error, self.degree, side);
        let error =
            value.iter().zip(&passed).map(|(x, e)| 2.0 * e + 4.0 * HALF_ULP * x.abs()).collect();
        Self { degree: self.degree.lowered(side / 2), value, error }
    }

    /// The greatest `|self| / divisor`; none when the divisor is not proven positive.
    pub fn most_over(&self, divisor: &Self) -> Option<f64> {
        self.range_over(divisor).map(|[low, high]| high.max(-low))
    }

    /// Numbers between which `self / divisor` lies; none when the divisor is not proven positive.
    pub fn range_over(&self, divisor: &Self) -> Option<[f64; 2]> {
        debug_assert!(self.degree == divisor.degree);
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for k in 0..self.value.len() {
            let (x, e) = (divisor.value[k], divisor.error[k]);
            let below = (x - e) * (1.0 - 4.0 * HALF_ULP);
            let above = (x + e) * (1.0 + 4.0 * HALF_ULP);
            if below.is_nan() || below < LEAST_DIVISOR {
                return None;
            }
            let (low, high) = (self.value[k] - self.error[k], self.value[k] + self.error[k]);
            range[0] = range[0].min(low / if low < 0.0 { below } else { above });
            range[1] = range[1].max(high / if high < 0.0 { above } else { below });
        }
        let grown = |x: f64, outward: f64| x + outward * 8.0 * HALF_ULP * x.abs();
        let range = [grown(range[0], -1.0), grown(range[1], 1.0)];
        range.iter().all(|x| x.is_finite()).then_some(range)
    }

    /// Whether all of it is proven positive.
    pub fn is_positive(&self) -> bool {
        self.value.iter().zip(&self.error).all(|(x, e)| *x > 2.0 * e)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_of_a_difference_of_squares_covers_what_is_left() {
        // (s + c)^2 - s^2 - 2 c s - c^2 = 0 in exact arithmetic.
        let degree = Bidegree { s: 1, t: 0 };
        let c = 1.0 / 3.0;
        let shifted = Form::exact(degree, vec![c, 1.0 + c]);
        let s = Form::exact(degree, vec![0.0, 1.0]);
        let one = Form::exact(degree, vec![1.0, 1.0]);
        let rest = shifted
            .times(&shifted)
            .plus(-1.0, &s.times(&s))
            .plus(-2.0 * c, &s.times(&one))
            .plus(-c * c, &one.times(&one));
        let most = rest.most_over(&one.times(&one)).unwrap();
        assert!((0.0..1e-13).contains(&most), "{most:e}");
        for (x, e) in rest.value.iter().zip(&rest.error) {
            assert!(x.abs() <= *e, "{x:e} {e:e}");
        }
    }

    #[test]
    fn dividing_and_multiplying_by_a_side_is_no_change() {
        let degree = Bidegree { s: 2, t: 1 };
        let f = Form::exact(degree, vec![0.0, 0.0, 1.0, -2.0, 3.0, 5.0]);
        let s = Form::exact(Bidegree { s: 1, t: 0 }, vec![0.0, 1.0]);
        let back = f.divided_by_side(0).times(&s);
        for (x, y) in back.value.iter().zip(&f.value) {
            assert!((x - y).abs() < 1e-15);
        }
    }

    #[test]
    fn nothing_is_divided_by_what_may_be_zero() {
        let degree = Bidegree { s: 1, t: 0 };
        let f = Form::exact(degree, vec![1.0, 1.0]);
        assert_eq!(f.most_over(&Form::exact(degree, vec![1.0, 0.0])), None);
        assert!(f.most_over(&Form::exact(degree, vec![2.0, 4.0])).unwrap() >= 0.5);
    }
}
