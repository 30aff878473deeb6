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
use crate::simd::{Kernel, Lanes, Level, Simd};
use std::f64::consts::PI;

/// Coefficients in each direction that are told one by one.
pub(super) const ORDER: usize = 5;

/// Coefficients that are summed at once.
const BLOCK: usize = 4;

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
        let (count, columns) = (n + 1, (n + 1).next_multiple_of(BLOCK));
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
    pub fn part(&self, [a, b]: [f64; 2], level: Level, work: &mut Vec<f64>, out: &mut Part) {
        let (count, columns) = (self.at.len(), self.columns);
        let n = count - 1;
        // Everything is written before it is read.
        let needed = (2 + count) * count;
        if work.len() < needed {
            work.resize(needed, 0.0);
        }
        let (up, rest) = work[..needed].split_at_mut(count);
        let (down, values) = rest.split_at_mut(count);
        for (j, &[share, rest]) in self.at.iter().enumerate() {
            powers(a + (b - a) * share, up);
            powers((1.0 - b) + (b - a) * rest, down);
            for k in 0..count {
                values[k * count + j] = self.binomials[k] * up[k] * down[n - k];
            }
        }
        out.columns = columns;
        out.to.resize(count * columns, 0.0);
        level.run(Cosines { nodes: self, values, to: &mut out.to });
        // Not below the greatest values in spite of rounding, nor are sums of products with them.
        let up = 1.0 + (8 * n + 64) as f64 * HALF_ULP;
        out.peaks.clear();
        out.peaks.extend((0..count).map(|k| {
            let top = if n == 0 { a } else { (k as f64 / n as f64).clamp(a, b) };
            up * self.binomials[k] * top.powi(k as i32) * (1.0 - top).powi((n - k) as i32)
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

/// Sums of Bernstein coefficients times their weights: the first coefficients in both directions, and the absolute values of
/// all others.
struct Sums<'a> {
    f: &'a [f64],
    along_s: &'a Part,
    along_t: &'a Part,
    work: &'a mut Vec<f64>,
}

impl Kernel for Sums<'_> {
    type Out = ([[f64; ORDER]; ORDER], f64);

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> Self::Out {
        let Self { f, along_s, along_t, work } = self;
        let (columns, rows) = (along_t.columns, along_s.columns);
        let count = along_t.peaks.len();
        let (by_s, _) = along_s.to.as_chunks::<BLOCK>();
        let (by_t, _) = along_t.to.as_chunks::<BLOCK>();
        let blocks = rows / BLOCK;
        if rows == BLOCK && columns == BLOCK {
            // Degrees up to 3: all of it in registers.
            let mut sums = [S::F4::splat(0.0); BLOCK];
            for (row, weights) in f.chunks_exact(count).zip(by_s) {
                let mut low = S::F4::splat(0.0);
                for (x, by) in row.iter().zip(by_t) {
                    low = low + S::F4::splat(*x) * S::F4::load(by);
                }
                let (low, weights) = (low.array(), S::F4::load(weights));
                for j in 0..BLOCK {
                    sums[j] = sums[j] + S::F4::splat(low[j]) * weights;
                }
            }
            let mut at = [[0.0; ORDER]; ORDER];
            for j in 0..BLOCK {
                let sum = sums[j].array();
                for i in 0..BLOCK {
                    at[i][j] = sum[i];
                }
            }
            return (at, 0.0);
        }
        // Coefficient j in t has its coefficients in s from `j * blocks` on.
        work.clear();
        work.resize(ORDER * rows, 0.0);
        let (sums, _) = work.as_chunks_mut::<BLOCK>();
        let mut beyond = 0.0;
        for (i, row) in f.chunks_exact(count).enumerate() {
            let mut low = [0.0; ORDER];
            let mut high = 0.0;
            for block in 0..columns / BLOCK {
                let mut sum = S::F4::splat(0.0);
                for (x, by) in row.iter().zip(by_t[block..].iter().step_by(columns / BLOCK)) {
                    sum = sum + S::F4::splat(*x) * S::F4::load(by);
                }
                let sum = sum.array();
                for k in 0..BLOCK {
                    if block * BLOCK + k < ORDER {
                        low[block * BLOCK + k] = sum[k];
                    } else {
                        high += sum[k].abs();
                    }
                }
            }
            beyond += along_s.peaks[i] * high;
            let weights = &by_s[i * blocks..(i + 1) * blocks];
            for j in 0..ORDER.min(columns) {
                let x = S::F4::splat(low[j]);
                for (sum, by) in sums[j * blocks..(j + 1) * blocks].iter_mut().zip(weights) {
                    (S::F4::load(sum) + x * S::F4::load(by)).store(sum);
                }
            }
        }
        let mut at = [[0.0; ORDER]; ORDER];
        for j in 0..ORDER {
            for (i, x) in work[j * rows..(j + 1) * rows].iter().enumerate() {
                if i < ORDER {
                    at[i][j] = *x;
                } else {
                    beyond += x.abs();
                }
            }
        }
        (at, beyond)
    }
}

/// Sums of values at nodes times cosines.
struct Cosines<'a> {
    nodes: &'a Nodes,
    /// By polynomial and node.
    values: &'a [f64],
    to: &'a mut [f64],
}

impl Kernel for Cosines<'_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let Self { nodes, values, to } = self;
        let (count, blocks) = (nodes.at.len(), nodes.columns / BLOCK);
        let (by, _) = nodes.by.as_chunks::<BLOCK>();
        let (to, _) = to.as_chunks_mut::<BLOCK>();
        for (row, to) in values.chunks_exact(count).zip(to.chunks_exact_mut(blocks)) {
            for (block, to) in to.iter_mut().enumerate() {
                let mut sum = S::F4::splat(0.0);
                for (x, by) in row.iter().zip(by[block..].iter().step_by(blocks)) {
                    sum = sum + S::F4::splat(*x) * S::F4::load(by);
                }
                sum.store(to);
            }
        }
    }
}

/// The part of a polynomial on a box; `work` is scratch memory.
///
/// Rounding: values and sums take 7 half ulps a degree and direction, cosines 16; relative to the mean of the absolute values at the
/// nodes, of which each coefficient has twice (the first of a direction: once) and which is at most `size`, the sum of absolute
/// coefficients at the polynomials' peaks.
pub(super) fn expansion(
    f: &Rounded,
    [along_s, along_t]: [&Part; 2],
    level: Level,
    work: &mut Vec<f64>,
) -> Expansion {
    let Bidegree { s: m, t: n } = f.degree;
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let size = sum(&f.rows, &along_s.peaks).min(sum(&f.columns, &along_t.peaks));
    let (at, beyond) = level.run(Sums { f: &f.coefficients, along_s, along_t, work });
    let (rows, columns) = ((m + 1) as f64, (n + 1) as f64);
    let [low, high] = [(2.0 * rows - 1.0) * (2.0 * columns - 1.0), 9.0 * (2.0 * rows - 1.0)];
    let shares =
        if m < ORDER && n < ORDER { low } else { high + 2.0 * columns * rows.max(columns) };
    let steps = (8.0 * (rows + columns) + 48.0) * shares;
    // What each Bernstein coefficient is off the polynomial is.
    Expansion { at, rest: beyond + f.error + steps * HALF_ULP * size }
}
