//! Bernstein polynomials with a bound of how far their coefficients may be off.
//!
//! Coefficients of a product are means of products of coefficients, so the greatest coefficients tell the rounding:
//! a product of f and g, off by e and d, is off by at most `e |g| + d |f| + e d` and its own rounding times `|f| |g|`.

use super::interval::Interval;
use super::slope::Slope;
use crate::bezier::{Bidegree, binomial, convolve, cut_2d, derivative, scale_down_2d, scale_up_2d};
use crate::bounds::{HALF_ULP, extent};
use crate::index::product_steps;

/// A polynomial in two parameters, or in t alone (degree 0 in s).
#[derive(Clone, Debug)]
pub(super) struct Polynomial {
    pub coefficients: Vec<f64>,
    pub degree: Bidegree,
    /// How far each coefficient may be off.
    pub error: f64,
}

impl Polynomial {
    pub fn new(coefficients: &[f64], degree: Bidegree, error: f64) -> Self {
        Self { coefficients: coefficients.to_vec(), degree, error }
    }

    /// Greatest absolute coefficient.
    pub fn size(&self) -> f64 {
        let (low, high) = extent(&self.coefficients);
        low.abs().max(high.abs())
    }

    /// The derivative in direction 0 (s) or 1 (t); zero when the degree is.
    pub fn derivative(&self, direction: usize) -> Self {
        let n = if direction == 0 { self.degree.s } else { self.degree.t };
        if n == 0 {
            let coefficients = vec![0.0; self.degree.count()];
            return Self { coefficients, degree: self.degree, error: 0.0 };
        }
        let mut coefficients = Vec::new();
        derivative(&self.coefficients, self.degree, direction, &mut coefficients);
        let error = 2.0 * n as f64 * (self.error + 2.0 * HALF_ULP * self.size());
        Self { coefficients, degree: self.degree.lowered(direction), error }
    }

    pub fn times(&self, other: &Self) -> Self {
        let degree = self.degree.times(other.degree);
        let (mut f, mut g) = (self.coefficients.clone(), other.coefficients.clone());
        let mut out = vec![0.0; degree.count()];
        scale_up_2d(&mut f, self.degree);
        scale_up_2d(&mut g, other.degree);
        convolve(&f, self.degree, &g, other.degree, 1.0, &mut out);
        scale_down_2d(&mut out, degree);
        let terms = self.degree.count().min(other.degree.count());
        let (a, b) = (self.size() + self.error, other.size() + other.error);
        let error = self.error * b + other.error * a + product_steps(terms) * a * b;
        Self { coefficients: out, degree, error: error * (1.0 + 16.0 * HALF_ULP) }
    }

    /// The same polynomial with at least these degrees.
    fn elevated(self, degree: Bidegree) -> Self {
        let ones = |s: usize, t: usize| {
            let degree = Bidegree { s, t };
            Self::new(&vec![1.0; degree.count()], degree, 0.0)
        };
        let (s, t) =
            (degree.s.saturating_sub(self.degree.s), degree.t.saturating_sub(self.degree.t));
        let along_s = if s > 0 { self.times(&ones(s, 0)) } else { self };
        if t > 0 { along_s.times(&ones(0, t)) } else { along_s }
    }

    /// `self + factor * other`.
    pub fn plus(self, factor: f64, other: &Self) -> Self {
        if self.degree != other.degree {
            // Derivatives of constants keep their degree; everything else has the same one.
            let other = other.clone().elevated(self.degree);
            return self.elevated(other.degree).plus(factor, &other);
        }
        let mut sum = self;
        for (x, y) in sum.coefficients.iter_mut().zip(&other.coefficients) {
            *x += factor * y;
        }
        let error = sum.error + factor.abs() * other.error + 4.0 * HALF_ULP * sum.size();
        sum.error = error + 4.0 * HALF_ULP * factor.abs() * other.size();
        sum
    }

    /// The scalar product of two vectors of polynomials.
    pub fn dot(a: [&Self; 3], b: [&Self; 3]) -> Self {
        let sum = a[0].times(b[0]).plus(1.0, &a[1].times(b[1]));
        sum.plus(1.0, &a[2].times(b[2]))
    }

    /// The vector product.
    pub fn cross(a: [&Self; 3], b: [&Self; 3]) -> [Self; 3] {
        [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            a[i].times(b[j]).plus(-1.0, &a[j].times(b[i]))
        })
    }

    /// Its values and slopes on a box, in the box's own parameters; `work` is scratch memory.
    pub fn on(&self, s: [f64; 2], t: [f64; 2], work: &mut Vec<f64>) -> Slope<2> {
        let Bidegree { s: m, t: n } = self.degree;
        work.clear();
        work.extend_from_slice(&self.coefficients);
        cut_2d(work, self.degree, s, t);
        let (low, high) = extent(work);
        let cut_error = (16 * (m + n) + 8) as f64 * HALF_ULP * self.size();
        let error = self.error + cut_error;
        let range = Interval { low: (low - error).next_down(), high: (high + error).next_up() };
        let rounded = (m + n + 8) as f64 * 2.0 * HALF_ULP * low.abs().max(high.abs());
        let middle = Interval::around(middle(work, self.degree), error + rounded);
        let slope = |low: f64, high: f64, n: usize| {
            let (n, error) = (n as f64, 2.0 * error + 2.0 * HALF_ULP * self.size());
            Interval { low: (n * (low - error)).next_down(), high: (n * (high + error)).next_up() }
        };
        let (mut along_s, mut along_t) = ((0.0f64, 0.0f64), (0.0f64, 0.0f64));
        let width = n + 1;
        if m > 0 {
            along_s = differences(work.iter().zip(&work[width..]));
        }
        if n > 0 {
            let nothing = (f64::INFINITY, f64::NEG_INFINITY);
            along_t = work.chunks_exact(width).fold(nothing, |all, row| {
                let (low, high) = differences(row.iter().zip(&row[1..]));
                (all.0.min(low), all.1.max(high))
            });
        }
        let gradient = [slope(along_s.0, along_s.1, m), slope(along_t.0, along_t.1, n)];
        Slope::new(middle, range, gradient)
    }
}

fn differences<'a>(pairs: impl Iterator<Item = (&'a f64, &'a f64)>) -> (f64, f64) {
    pairs.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (a, b)| {
        let x = b - a;
        (if x < low { x } else { low }, if x > high { x } else { high })
    })
}

/// The value at (1/2, 1/2).
fn middle(f: &[f64], degree: Bidegree) -> f64 {
    let share = |n: usize, k: usize| binomial(n, k) * 0.5f64.powi(n as i32);
    let mut along = [0.0; crate::bezier::MAX_TRIPLE];
    for (j, x) in along[..=degree.t].iter_mut().enumerate() {
        *x = share(degree.t, j);
    }
    let row = |row: &[f64]| row.iter().zip(&along).map(|(x, b)| x * b).sum::<f64>();
    let rows = f.chunks_exact(degree.t + 1).enumerate();
    rows.map(|(i, values)| share(degree.s, i) * row(values)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_and_slopes_hold_the_values() {
        let degree = Bidegree { s: 2, t: 1 };
        let f = Polynomial::new(&[1.0, 2.0, -1.0, 0.5, 3.0, 1.0], degree, 0.0);
        let g = Polynomial::new(&[0.5, -2.0, 1.0, 1.5, 0.0, 1.0], degree, 0.0);
        let h = f.times(&g).plus(-2.0, &g.times(&g));
        let at = |p: &Polynomial, s: f64, t: f64| {
            let mut work = Vec::new();
            p.on([s, s], [t, t], &mut work).middle.middle()
        };
        let mut work = Vec::new();
        let on = h.on([0.25, 0.5], [0.5, 0.75], &mut work);
        for i in 1..=8 {
            let (s, t) = (0.25 + 0.25 * i as f64 / 8.0, 0.5 + 0.03 * i as f64);
            let value = at(&f, s, t) * at(&g, s, t) - 2.0 * at(&g, s, t).powi(2);
            assert!((at(&h, s, t) - value).abs() < 1e-13);
            assert!(on.range.low <= value + 1e-13 && value <= on.range.high + 1e-13);
            let slope = 0.25 * at(&h.derivative(0), s, t);
            assert!(on.gradient[0].low <= slope + 1e-13 && slope <= on.gradient[0].high + 1e-13);
        }
    }
}
