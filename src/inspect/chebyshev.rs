//! Parts of Bernstein polynomials in Chebyshev's basis: values at his nodes, and the sums of cosines of them.
//!
//! ```text
//!   x_j = a + (b - a) cos^2(theta_j / 2)     theta_j = pi (j + 1/2) / (n + 1)
//!   coefficient i of the part on [a, b] = 2 / (n + 1) sum_j f(x_j) cos(i theta_j)        (half of it for i = 0)
//! ```
//!
//! exact for degree n. On a short part the coefficients fall fast: what is beyond the first few is small, and they are its bound.
//!
//! Rounding: nodes, their powers and the values are formed from positive numbers and keep their relative accuracy; what is
//! summed with signs is off by half ulps of sums of absolute values on the part itself: small where the polynomial is.
//!
//! Reference: Trefethen, *Approximation Theory and Approximation Practice*, chapter 3.

use super::net::Rounded;
use crate::bezier::{Bidegree, binomial};
use crate::bounds::HALF_ULP;
use crate::portable::SameDigits;
use std::f64::consts::PI;

/// Coefficients in each direction that are told one by one.
pub(super) const ORDER: usize = 5;

/// The nodes of a degree.
#[derive(Clone)]
pub(super) struct Nodes {
    /// cos^2 and sin^2 of half the angles.
    at: Vec<[f64; 2]>,
    binomials: Vec<f64>,
    /// `by[j * columns + i]`: weight of the value at node j in coefficient i.
    by: Vec<f64>,
    columns: usize,
}

/// The Bernstein polynomials of a degree on an interval.
#[derive(Clone, Default)]
pub(super) struct Part {
    /// `to[k * columns + i]`: coefficient i of polynomial k; columns without a coefficient are zero.
    to: Vec<f64>,
    columns: usize,
    /// Greatest values on the interval.
    peaks: Vec<f64>,
}

fn powers(x: f64, out: &mut [f64]) {
    let mut power = 1.0;
    for out in out {
        *out = power;
        power *= x;
    }
}

impl Nodes {
    pub fn new(n: usize) -> Self {
        let (count, columns) = (n + 1, (n + 1).max(ORDER));
        // cos(pi k / (2 count)).
        let cosine = |k: usize| (PI * (k % (4 * count)) as f64 / (2 * count) as f64).cosine();
        let square = |x: f64| x * x;
        let half = |k: usize| square((PI * k as f64 / (4 * count) as f64).cosine());
        let at = (0..count).map(|j| [half(2 * j + 1), half(2 * (count - j) - 1)]).collect();
        let mut by = vec![0.0; count * columns];
        for j in 0..count {
            for i in 0..count {
                let share = if i == 0 { 1.0 } else { 2.0 } / count as f64;
                by[j * columns + i] = share * cosine(i * (2 * j + 1));
            }
        }
        Self { at, binomials: (0..=n).map(|k| binomial(n, k)).collect(), by, columns }
    }

    /// The polynomials on [a, b]; `work` is scratch memory.
    pub fn part(&self, [a, b]: [f64; 2], work: &mut Vec<f64>, out: &mut Part) {
        let (count, columns) = (self.at.len(), self.columns);
        let n = count - 1;
        work.clear();
        work.resize(2 * count, 0.0);
        let (up, down) = work.split_at_mut(count);
        out.columns = columns;
        out.to.clear();
        out.to.resize(count * columns, 0.0);
        for (&[share, rest], by) in self.at.iter().zip(self.by.chunks_exact(columns)) {
            powers(a + (b - a) * share, up);
            powers((1.0 - b) + (b - a) * rest, down);
            for (k, row) in out.to.chunks_exact_mut(columns).enumerate() {
                let value = self.binomials[k] * up[k] * down[n - k];
                row.iter_mut().zip(by).for_each(|(x, weight)| *x += value * weight);
            }
        }
        out.peaks.clear();
        out.peaks.extend((0..count).map(|k| {
            let top = if n == 0 { a } else { (k as f64 / n as f64).clamp(a, b) };
            self.binomials[k] * top.powi(k as i32) * (1.0 - top).powi((n - k) as i32)
        }));
    }
}

/// The Bernstein polynomials of degree n at x.
pub(super) fn bernstein(n: usize, x: f64) -> Vec<f64> {
    let (mut up, mut down) = (vec![0.0; n + 1], vec![0.0; n + 1]);
    powers(x, &mut up);
    powers(1.0 - x, &mut down);
    (0..=n).map(|k| binomial(n, k) * up[k] * down[n - k]).collect()
}

/// A polynomial on a box in Chebyshev's basis.
pub(super) struct Expansion {
    pub at: [[f64; ORDER]; ORDER],
    /// Bound of everything else, rounding included.
    pub rest: f64,
}

/// The part of a polynomial on a box; `work` is scratch memory.
///
/// Rounding: values and sums take 7 half ulps a degree and direction, cosines 16; relative to the mean of the absolute values at the
/// nodes, of which each coefficient has twice (the first of a direction: once) and which is at most `size`, the sum of absolute
/// coefficients at the polynomials' peaks.
pub(super) fn expansion(
    f: &Rounded,
    [along_s, along_t]: [&Part; 2],
    work: &mut Vec<f64>,
) -> Expansion {
    let Bidegree { s: m, t: n } = f.degree;
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let size = sum(&f.rows, &along_s.peaks).min(sum(&f.columns, &along_t.peaks));
    let mut at = [[0.0; ORDER]; ORDER];
    let mut beyond = 0.0;
    let rows = f.coefficients.chunks_exact(n + 1);
    let is_low = m < ORDER && n < ORDER;
    if is_low {
        for (row, by_s) in rows.zip(along_s.to.chunks_exact(ORDER)) {
            let mut part = [0.0; ORDER];
            for (x, by_t) in row.iter().zip(along_t.to.chunks_exact(ORDER)) {
                part.iter_mut().zip(by_t).for_each(|(part, weight)| *part += x * weight);
            }
            for (at, weight) in at.iter_mut().zip(by_s) {
                at.iter_mut().zip(part).for_each(|(at, x)| *at += weight * x);
            }
        }
    } else {
        let columns = along_t.columns;
        work.clear();
        work.resize(columns + ORDER * along_s.columns, 0.0);
        let (part, all) = work.split_at_mut(columns);
        let by_rows = along_s.to.chunks_exact(along_s.columns);
        for ((row, by_s), peak) in rows.zip(by_rows).zip(&along_s.peaks) {
            let mut terms = row.iter().zip(along_t.to.chunks_exact(columns));
            if let Some((x, by_t)) = terms.next() {
                part.iter_mut().zip(by_t).for_each(|(part, weight)| *part = x * weight);
            }
            for (x, by_t) in terms {
                part.iter_mut().zip(by_t).for_each(|(part, weight)| *part += x * weight);
            }
            beyond += peak * part[ORDER..].iter().map(|x| x.abs()).sum::<f64>();
            let low: [f64; ORDER] = std::array::from_fn(|j| part[j]);
            for (all, weight) in all.chunks_exact_mut(ORDER).zip(by_s) {
                all.iter_mut().zip(low).for_each(|(all, x)| *all += weight * x);
            }
        }
        for (at, all) in at.iter_mut().zip(all.chunks_exact(ORDER)) {
            at.copy_from_slice(all);
        }
        beyond += all[ORDER * ORDER..].iter().map(|x| x.abs()).sum::<f64>();
    }
    let (rows, columns) = ((m + 1) as f64, (n + 1) as f64);
    let [low, high] = [(2.0 * rows - 1.0) * (2.0 * columns - 1.0), 9.0 * (2.0 * rows - 1.0)];
    let shares = if is_low { low } else { high + 2.0 * columns * rows.max(columns) };
    let steps = (8.0 * (rows + columns) + 48.0) * shares;
    // What each Bernstein coefficient is off the polynomial is.
    Expansion { at, rest: beyond + f.error + steps * HALF_ULP * size }
}
