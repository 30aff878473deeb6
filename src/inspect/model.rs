//! Functions on a box as cubic polynomials with a bound of what they are off: Taylor models.
//!
//! ```text
//!   f(x, y) = c0 + c1 x + c2 y + c3 x^2 + c4 x y + c5 y^2 + c6 x^3 + ... + c9 y^3  +-  rest,     x, y in [-1, 1]
//! ```
//!
//! Products, quotients and roots of models are models: what intervals lose because the factors of a curvature vary together is of
//! the fourth order in the box's width here. Terms of degree four are not thrown away but replaced by the nearest ones
//! of lower degree (x^4 by x^2 - 1/8), which leaves an eighth or a quarter of them.
//!
//! Rounding: a coefficient of a product is a sum of at most 10 products; 16 half ulps of the product of the sums of
//! absolute coefficients hold all of it.
//!
//! References: Berz, Hoffstaetter, *Computation and application of Taylor polynomials with interval remainder bounds*, 1998;
//! Lanczos, *Applied Analysis*, 1956 (economization).

use super::chebyshev::{Expansion, ORDER};
use super::interval::Interval;
use crate::bounds::HALF_ULP;

/// Coefficients of a model.
const COUNT: usize = 10;

/// Rounding of a sum of products of coefficients, relative to the product of the sums of absolute ones.
const ROUNDING: f64 = 20.0 * HALF_ULP;

/// The bound itself is rounded.
const UP: f64 = 1.0 + 64.0 * HALF_ULP;

/// Greatest relative variation of a function of which a power is taken.
const MOST_VARIATION: f64 = 0.75;

/// A cubic polynomial in x and y from -1 to 1 and what it may be off.
#[derive(Clone, Copy, Debug)]
pub(super) struct Model {
    pub c: [f64; COUNT],
    pub rest: f64,
}

/// The cubic part of a sum of products of Chebyshev polynomials, and what the others may come to.
fn economised(at: &[[f64; ORDER]; ORDER]) -> ([f64; COUNT], f64) {
    let mut dropped = 0.0;
    for i in 0..ORDER {
        (ORDER - 1 - i..ORDER).for_each(|j| dropped += at[i][j].abs());
    }
    let c = [
        at[0][0] - at[2][0] - at[0][2],
        at[1][0] - 3.0 * at[3][0] - at[1][2],
        at[0][1] - 3.0 * at[0][3] - at[2][1],
        2.0 * at[2][0],
        at[1][1],
        2.0 * at[0][2],
        4.0 * at[3][0],
        2.0 * at[2][1],
        2.0 * at[1][2],
        4.0 * at[0][3],
    ];
    (c, dropped)
}

impl Model {
    pub const fn constant(x: f64) -> Self {
        Self { c: [x, 0., 0., 0., 0., 0., 0., 0., 0., 0.], rest: 0.0 }
    }

    /// The coordinate x (0) or y (1) from `low` to `high`.
    pub fn coordinate(axis: usize, [low, high]: [f64; 2]) -> Self {
        let mut model = Self::constant(0.5 * (low + high));
        model.c[1 + axis] = 0.5 * (high - low);
        model.rest = 4.0 * HALF_ULP * low.abs().max(high.abs());
        model
    }

    /// The cubic part of an expansion.
    pub fn of(expansion: &Expansion) -> Self {
        let (c, dropped) = economised(&expansion.at);
        Self { c, rest: (dropped + expansion.rest) * UP }
    }

    /// The sum of absolute coefficients of degree 0, 1, 2 and 3.
    fn sizes(&self) -> [f64; 4] {
        let c = self.c.map(f64::abs);
        [c[0], c[1] + c[2], c[3] + c[4] + c[5], (c[6] + c[7]) + (c[8] + c[9])]
    }

    /// The greatest absolute value that the coefficients allow.
    pub fn magnitude(&self) -> f64 {
        let [a, b, c, d] = self.sizes();
        (a + b + c + d + self.rest) * UP
    }

    /// How much the coefficients say that it varies along x and along y.
    pub fn variation(&self) -> [f64; 2] {
        let c = self.c.map(f64::abs);
        let mixed = c[4] + c[7] + c[8];
        [c[1] + 2.0 * c[3] + 3.0 * c[6] + mixed, c[2] + 2.0 * c[5] + 3.0 * c[9] + mixed]
    }

    /// All values.
    pub fn range(&self) -> Interval {
        let c = &self.c;
        let along = |a: f64, b: f64| {
            // a x + b x^2 from -1 to 1: its ends and, when inside, its vertex.
            let (mut low, mut high) = ((b - a).min(b + a), (b - a).max(b + a));
            if a.abs() < 2.0 * b.abs() {
                let vertex = -a * a / (4.0 * b);
                (low, high) = (low.min(vertex), high.max(vertex));
            }
            (low, high)
        };
        let ((x0, x1), (y0, y1)) = (along(c[1], c[3]), along(c[2], c[5]));
        let [a, b, d, e] = self.sizes();
        let rounded = ROUNDING * (a + b + d + e);
        let other = (c[4].abs() + e + self.rest + rounded) * UP;
        let (low, high) = (c[0] + x0 + y0 - other, c[0] + x1 + y1 + other);
        if low.is_nan() || high.is_nan() {
            return Interval::ENTIRE;
        }
        Interval { low: low.next_down(), high: high.next_up() }
    }

    /// The value in the middle.
    pub fn middle(&self) -> Interval {
        Interval::around(self.c[0], self.rest)
    }

    pub fn plus(&self, other: &Self) -> Self {
        self.combined(1.0, other)
    }

    pub fn minus(&self, other: &Self) -> Self {
        self.combined(-1.0, other)
    }

    /// `self + factor * other`.
    pub fn combined(&self, factor: f64, other: &Self) -> Self {
        let mut c = self.c;
        let mut size = 0.0;
        for (x, y) in c.iter_mut().zip(&other.c) {
            let part = factor * y;
            size += x.abs() + part.abs();
            *x += part;
        }
        let rest = self.rest + factor.abs() * other.rest + 4.0 * HALF_ULP * size;
        Self { c, rest: rest * UP }
    }

    /// Times a number.
    pub fn scaled(&self, factor: f64) -> Self {
        Self::constant(0.0).combined(factor, self)
    }

    pub fn times(&self, other: &Self) -> Self {
        let (a, b) = (&self.c, &other.c);
        let mut c = [
            a[0] * b[0],
            a[0] * b[1] + a[1] * b[0],
            a[0] * b[2] + a[2] * b[0],
            a[0] * b[3] + a[1] * b[1] + a[3] * b[0],
            (a[0] * b[4] + a[1] * b[2]) + (a[2] * b[1] + a[4] * b[0]),
            a[0] * b[5] + a[2] * b[2] + a[5] * b[0],
            (a[0] * b[6] + a[1] * b[3]) + (a[3] * b[1] + a[6] * b[0]),
            (a[0] * b[7] + a[1] * b[4] + a[2] * b[3]) + (a[3] * b[2] + a[4] * b[1] + a[7] * b[0]),
            (a[0] * b[8] + a[1] * b[5] + a[2] * b[4]) + (a[4] * b[2] + a[5] * b[1] + a[8] * b[0]),
            (a[0] * b[9] + a[2] * b[5]) + (a[5] * b[2] + a[9] * b[0]),
        ];
        let fourth = [
            a[1] * b[6] + a[3] * b[3] + a[6] * b[1],
            (a[1] * b[7] + a[2] * b[6] + a[3] * b[4]) + (a[4] * b[3] + a[6] * b[2] + a[7] * b[1]),
            (a[1] * b[8] + a[2] * b[7] + a[3] * b[5])
                + a[4] * b[4]
                + (a[5] * b[3] + a[7] * b[2] + a[8] * b[1]),
            (a[1] * b[9] + a[2] * b[8] + a[4] * b[5]) + (a[5] * b[4] + a[8] * b[2] + a[9] * b[1]),
            a[2] * b[9] + a[5] * b[5] + a[9] * b[2],
        ];
        // x^4 = x^2 - 1/8 +- 1/8, x^3 y = 3/4 x y +- 1/4, x^2 y^2 = (x^2 + y^2) / 2 - 1/4 +- 1/4.
        c[0] -= 0.125 * (fourth[0] + fourth[4]) + 0.25 * fourth[2];
        c[3] += fourth[0] + 0.5 * fourth[2];
        c[4] += 0.75 * (fourth[1] + fourth[3]);
        c[5] += fourth[4] + 0.5 * fourth[2];
        let left = 0.125 * (fourth[0].abs() + fourth[4].abs())
            + 0.25 * (fourth[1].abs() + fourth[2].abs() + fourth[3].abs());
        let (n, m) = (self.sizes(), other.sizes());
        let (all, every) = (n[0] + n[1] + n[2] + n[3], m[0] + m[1] + m[2] + m[3]);
        let high = n[2] * m[3] + n[3] * m[2] + n[3] * m[3];
        let carried = self.rest * (every + other.rest) + all * other.rest;
        let rounded = ROUNDING * all * every;
        Self { c, rest: (left + high + carried + rounded) * UP }
    }

    pub fn squared(&self) -> Self {
        self.times(self)
    }

    /// The power with a binomial series of which the absolute coefficients fall; none when the function varies too much or may not be
    /// positive.
    fn powered(&self, series: [f64; 7], power: impl Fn(f64) -> f64) -> Option<Self> {
        let Interval { low, high } = self.range();
        let base = 0.5 * (low + high);
        if low.is_nan()
            || low <= 0.0
            || !base.is_finite()
            || high - low > 2.0 * MOST_VARIATION * base
        {
            return None;
        }
        let x = self.scaled(1.0 / base).minus(&Self::constant(1.0));
        // The quotient is rounded once more than the model knows: 1 / base.
        let x = Self { rest: (x.rest + 4.0 * HALF_ULP * high / base) * UP, ..x };
        let most = (0.5 * (high - low) / base + 8.0 * HALF_ULP).max(0.0);
        let mut sum = Self::constant(series[5]);
        for k in (0..5).rev() {
            sum = sum.times(&x).plus(&Self::constant(series[k]));
        }
        let (square, tail) = (most * most, 1.0 - most);
        let left = series[6].abs() * square * square * square / tail;
        sum.rest = (sum.rest + left) * UP;
        let factor = power(base);
        // The power of the base is rounded, a few half ulps.
        let all = sum.scaled(factor);
        Some(Self { rest: (all.rest + 16.0 * HALF_ULP * all.magnitude()) * UP, ..all })
    }

    /// 1 / f for a positive function.
    pub fn reciprocal(&self) -> Option<Self> {
        self.powered([1.0, -1.0, 1.0, -1.0, 1.0, -1.0, 1.0], |x| 1.0 / x)
    }

    /// The root of a positive function.
    pub fn sqrt(&self) -> Option<Self> {
        let series = [1.0, 0.5, -0.125, 0.0625, -5.0 / 128.0, 7.0 / 256.0, -21.0 / 1024.0];
        self.powered(series, f64::sqrt)
    }

    /// 1 / root of a positive function.
    pub fn reciprocal_sqrt(&self) -> Option<Self> {
        let series = [1.0, -0.5, 0.375, -0.3125, 35.0 / 128.0, -63.0 / 256.0, 231.0 / 1024.0];
        self.powered(series, |x| 1.0 / x.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::{Bidegree, binomial};
    use crate::inspect::chebyshev::{Nodes, Part, expansion};
    use crate::inspect::doubled::Doubled;
    use crate::inspect::net::Exact;
    use crate::simd::Level;

    /// The model on a box of a polynomial with Bernstein coefficients `f`.
    fn made(f: &[f64], degree: Bidegree, ends: [[f64; 2]; 2]) -> Model {
        let coefficients = f.iter().map(|x| Doubled::new(*x)).collect();
        let rounded = Exact { coefficients, degree, error: 0.0 }.rounded();
        let mut work = Vec::new();
        let [along_s, along_t] = [0, 1].map(|k| {
            let mut part = Part::default();
            Nodes::new([degree.s, degree.t][k]).part(
                ends[k],
                Level::detect(),
                &mut work,
                &mut part,
            );
            part
        });
        Model::of(&expansion(&rounded, [&along_s, &along_t], Level::detect(), &mut Vec::new()))
    }

    fn dot(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(x, y)| x * y).sum()
    }

    fn at(model: &Model, x: f64, y: f64) -> f64 {
        let m = [1.0, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y];
        dot(&model.c, &m)
    }

    fn bernstein(f: &[f64], degree: Bidegree, s: f64, t: f64) -> f64 {
        let one = |n: usize, k: usize, x: f64| {
            binomial(n, k) * x.powi(k as i32) * (1.0 - x).powi((n - k) as i32)
        };
        let term = |k: usize| {
            let (i, j) = (k / (degree.t + 1), k % (degree.t + 1));
            f[k] * one(degree.s, i, s) * one(degree.t, j, t)
        };
        (0..f.len()).map(term).sum()
    }

    #[test]
    fn models_of_nets_and_their_products_hold_all_values() {
        let mut seed = 12345u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        };
        for round in 0..200 {
            let degree = Bidegree { s: round % 9, t: (round * 7) % 12 };
            let ends = [[0.0, 1.0], [0.25, 0.5], [0.0, 0.125]][round % 3];
            let ends = [ends, [0.0, 1.0 - 0.5 * (round % 2) as f64]];
            let mut net = || (0..degree.count()).map(|_| random()).collect::<Vec<f64>>();
            let (f, mut g) = (net(), net());
            g.iter_mut().for_each(|x| *x = 2.0 + 0.6 * *x);
            let make = |f: &[f64]| made(f, degree, ends);
            let (a, b) = (make(&f), make(&g));
            let product = a.times(&b);
            let powers = [b.reciprocal(), b.sqrt(), b.reciprocal_sqrt()].map(Option::unwrap);
            for i in 0..=8 {
                for j in 0..=8 {
                    let (s, t) = (i as f64 / 8.0, j as f64 / 8.0);
                    let (x, y) = (2.0 * s - 1.0, 2.0 * t - 1.0);
                    let on = |[a, b]: [f64; 2], share: f64| a + (b - a) * share;
                    let (s, t) = (on(ends[0], s), on(ends[1], t));
                    let (u, v) = (bernstein(&f, degree, s, t), bernstein(&g, degree, s, t));
                    let holds = |model: &Model, value: f64| {
                        let gap = (at(model, x, y) - value).abs();
                        assert!(gap <= model.rest + 1e-14, "{degree:?} {gap} {model:?}");
                        let Interval { low, high } = model.range();
                        assert!(low - 1e-14 <= value && value <= high + 1e-14);
                    };
                    holds(&a, u);
                    holds(&product, u * v);
                    holds(&powers[0], 1.0 / v);
                    holds(&powers[1], v.sqrt());
                    holds(&powers[2], 1.0 / v.sqrt());
                }
            }
        }
    }

    #[test]
    fn what_is_cubic_has_no_rest() {
        let degree = Bidegree { s: 2, t: 1 };
        let f = [1.0, 2.0, -1.0, 0.5, 3.0, 1.0];
        let model = made(&f, degree, [[0.0, 1.0]; 2]);
        assert!(model.rest < 1e-12, "{model:?}");
        let middle = bernstein(&f, degree, 0.5, 0.5);
        assert!((model.c[0] - middle).abs() < 1e-15);
    }
}
