//! Coefficients of lower degree: on a small box a polynomial of high degree is nearly one of few coefficients.
//!
//! Along one direction the Bernstein coefficients of a polynomial of degree n are values at 0 .. n of a polynomial of that degree, and those
//! of Legendre's polynomials are the discrete orthogonal polynomials `t_k`. So least squares in the coefficients is least
//! squares of the function, and lowering to degree m keeps the first m + 1 Legendre coefficients:
//!
//! ```text
//!   shares: b'_j = sum_k t_k^m(j) <t_k^n, b> / <t_k^n, t_k^n>        k = 0 .. m
//!   back:   b''  = b' elevated to degree n                            the error is |b'' - b|, looked at for every coefficient
//!   probe:  <t_k^n, b> for k = m + 1, m + 2                           whether it is worth doing
//! ```
//!
//! The error is that of coefficients of degree n; see [`growth`] for what it is to differences of the lower ones.
//!
//! Reference: Lutterkort, Peters, Reif, *Polynomial degree reduction in the L2-norm equals best Euclidean approximation of
//! Bezier coefficients*, 1999.

use super::{Grid, LANES};
use crate::bezier::{Bidegree, binomial};
use crate::bounds::HALF_ULP;
use crate::knots::MAX_DEGREE;
use crate::simd::{Kernel, Lanes, Level, Simd};

/// Degrees to which products are lowered; those of nets are the halves.
const RUNGS: [usize; 2] = [12, 8];

/// Most coefficients of a strand, in whole blocks.
pub(super) const MOST: usize = (2 * MAX_DEGREE + 1).next_multiple_of(BLOCK);
/// Most of a lowered one.
const MOST_LOW: usize = (RUNGS[0] + 1).next_multiple_of(BLOCK);

/// Rows of a matrix that are worked on together.
const BLOCK: usize = 4;

/// An array that would have to be halved more often is not lowered.
const MOST_HALVINGS: u32 = 64;

/// A matrix in blocks of four rows, zeros behind the last.
#[derive(Clone, Debug)]
struct Matrix {
    columns: usize,
    blocks: Vec<[f64; BLOCK]>,
}

impl Matrix {
    fn new(rows: usize, columns: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let value = |i: usize, j: usize| if i < rows { entry(i, j) } else { 0.0 };
        let block = |k: usize| (0..columns).map(move |j| (k, j));
        let blocks = (0..rows.div_ceil(BLOCK)).flat_map(block);
        let blocks = blocks.map(|(k, j)| [0, 1, 2, 3].map(|i| value(BLOCK * k + i, j))).collect();
        Self { columns, blocks }
    }

    fn memory(&self) -> usize {
        self.blocks.capacity() * size_of::<[f64; BLOCK]>()
    }
}

/// Four rows of a matrix times a strand.
#[inline(always)]
fn four_rows<V: Lanes<N>, const N: usize>(rows: &[[f64; BLOCK]], strand: &[V]) -> [V; BLOCK] {
    let mut sums = [V::splat(0.0); BLOCK];
    for (row, x) in rows.iter().zip(strand) {
        sums[0] = sums[0] + V::splat(row[0]) * *x;
        sums[1] = sums[1] + V::splat(row[1]) * *x;
        sums[2] = sums[2] + V::splat(row[2]) * *x;
        sums[3] = sums[3] + V::splat(row[3]) * *x;
    }
    sums
}

/// From degree `from` to degree `to`, in one direction.
#[derive(Clone, Debug)]
struct Fall {
    from: usize,
    to: usize,
    shares: Matrix,
    back: Matrix,
    /// Two rows: what the first two neglected terms are at most in a coefficient.
    probe: Matrix,
}

impl Fall {
    fn new(from: usize, to: usize) -> Self {
        let (high, low) = (orthogonal(from), orthogonal(to));
        let squares: Vec<f64> =
            high.iter().map(|values| values.iter().map(|x| x * x).sum()).collect();
        let share =
            |j: usize, i: usize| (0..=to).map(|k| low[k][j] * high[k][i] / squares[k]).sum::<f64>();
        let elevated = |i: usize, j: usize| {
            let is_there = j <= i && i - j <= from - to;
            if is_there {
                binomial(to, j) * binomial(from - to, i - j) / binomial(from, i)
            } else {
                0.0
            }
        };
        let neglected = |row: usize, i: usize| {
            let k = to + 1 + row;
            if k > from {
                return 0.0;
            }
            let greatest = high[k].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            greatest * high[k][i] / squares[k]
        };
        Self {
            from,
            to,
            shares: Matrix::new(to + 1, from + 1, share),
            back: Matrix::new(from + 1, to + 1, elevated),
            probe: Matrix::new(2, from + 1, neglected),
        }
    }

    fn memory(&self) -> usize {
        self.shares.memory() + self.back.memory() + self.probe.memory()
    }

    /// The strand of lower degree in `low`; returns lane by lane how far the coefficients of the higher degree are off, at
    /// most.
    #[inline(always)]
    fn apply<V: Lanes<N>, const N: usize>(&self, strand: &[V], low: &mut [V; MOST_LOW]) -> V {
        let strand = &strand[..=self.from];
        let mut size = V::splat(0.0);
        for (block, rows) in self.shares.blocks.chunks_exact(self.shares.columns).enumerate() {
            let four = four_rows(rows, strand);
            for k in 0..BLOCK {
                low[BLOCK * block + k] = four[k];
                size = four[k].abs().max(size);
            }
        }
        let mut off = V::splat(0.0);
        for (block, rows) in self.back.blocks.chunks_exact(self.back.columns).enumerate() {
            let four = four_rows(rows, &low[..=self.to]);
            for k in 0..BLOCK {
                if let Some(x) = strand.get(BLOCK * block + k) {
                    off = (four[k] - *x).abs().max(off);
                }
            }
        }
        // The means themselves are rounded: products and sums of shares that add up to one.
        off + V::splat(2.0 * (self.to + 6) as f64 * HALF_ULP) * size
    }

    /// Lane by lane how far off [`Self::apply`] is likely to be.
    #[inline(always)]
    fn estimate<V: Lanes<N>, const N: usize>(&self, strand: &[V]) -> V {
        let [a, b, _, _] = four_rows(&self.probe.blocks, &strand[..=self.from]);
        a.abs() + b.abs()
    }
}

/// The discrete orthogonal polynomials on 0 .. n by degree, 1 at 0: Bernstein coefficients of Legendre's on [0, 1].
fn orthogonal(n: usize) -> Vec<Vec<f64>> {
    let mut all = vec![vec![1.0; n + 1]];
    for k in 0..n {
        let (a, b) = (((k + 1) * (n - k)) as f64, (k * (n + 1 + k)) as f64);
        let next = (0..=n).map(|i| {
            let slope = (2 * k + 1) as f64 * (n as f64 - 2.0 * i as f64);
            let before = if k > 0 { all[k - 1][i] } else { 0.0 };
            (slope * all[k][i] - b * before) / a
        });
        let next = next.collect();
        all.push(next);
    }
    all
}

/// How much more an error of the coefficients of degree `from` is to the second differences of degree `to`, taken times
/// `to (to - 1)` there and `from (from - 1)` here; to the first ones it is less.
fn growth(from: usize, to: usize) -> f64 {
    (from * (from - 1)) as f64 / (to * (to - 1)) as f64
}

/// The degrees along one direction.
#[derive(Clone, Debug)]
struct Rungs {
    /// Of products: the whole degree, then lower and lower.
    degrees: Vec<usize>,
    /// From rung i to rung j > i, those with the same i together.
    falls: Vec<Vec<Fall>>,
    /// Of nets: from the whole degree to half of that of rung 1, 2, ...
    nets: Vec<Fall>,
}

impl Rungs {
    fn new(factor: usize) -> Self {
        let mut degrees = vec![2 * factor];
        // Lower nets lie farther from the surface, and more boxes are halved: they must be far smaller.
        degrees.extend(RUNGS.into_iter().filter(|degree| 3 * degree <= 4 * factor));
        let falls = |(i, from): (usize, &usize)| {
            degrees[i + 1..].iter().map(|to| Fall::new(*from, *to)).collect()
        };
        let falls = degrees.iter().enumerate().map(falls).collect();
        let nets = degrees[1..].iter().map(|degree| Fall::new(factor, degree / 2)).collect();
        Self { degrees, falls, nets }
    }

    fn memory(&self) -> usize {
        self.degrees.capacity() * size_of::<usize>()
            + self.falls.iter().flatten().chain(&self.nets).map(Fall::memory).sum::<usize>()
            + (self.falls.iter().map(Vec::capacity).sum::<usize>() + self.nets.capacity())
                * size_of::<Fall>()
            + self.falls.capacity() * size_of::<Vec<Fall>>()
    }
}

/// Which degrees an array has: 0 the whole ones.
pub type Rung = [u8; 2];

/// Grids of all degrees to which products are lowered, and the way there.
#[derive(Clone, Debug)]
pub struct Ladder {
    rungs: [Rungs; 2],
    /// (i, j) at i times the number of j; the first has the whole degrees.
    grids: Vec<Grid>,
}

/// How an array may be lowered in one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// To this rung, which may be where it is.
    pub to: u8,
    /// After so many halvings in this direction it may go on from there.
    pub later: u32,
}

impl Ladder {
    /// Of products of two polynomials of bidegree `factor`.
    pub fn new(factor: Bidegree, rational: bool, level: Level) -> Self {
        let rungs = [Rungs::new(factor.s), Rungs::new(factor.t)];
        let pairs = rungs[0].degrees.iter().flat_map(|s| rungs[1].degrees.iter().map(|t| (*s, *t)));
        let half = |(s, t): (usize, usize)| Bidegree { s: s / 2, t: t / 2 };
        let grids = pairs.map(|pair| Grid::new(half(pair), rational, level)).collect();
        Self { rungs, grids }
    }

    /// The arrays of the whole degrees.
    pub fn whole(&self) -> &Grid {
        &self.grids[0]
    }

    /// The arrays of a rung.
    pub fn grid(&self, rung: Rung) -> &Grid {
        &self.grids[rung[0] as usize * self.rungs[1].degrees.len() + rung[1] as usize]
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        self.rungs.iter().map(Rungs::memory).sum::<usize>()
            + self.grids.iter().map(Grid::memory).sum::<usize>()
            + self.grids.capacity() * size_of::<Grid>()
    }

    /// Whether there are lower degrees in direction `k`.
    pub fn has_lower(&self, rung: Rung, k: usize) -> bool {
        rung[k] as usize + 1 < self.rungs[k].degrees.len()
    }

    /// How much more an error of coefficients of one rung is to the differences of another one, lower in direction `k`.
    pub fn growth(&self, rung: Rung, k: usize, to: u8) -> f64 {
        let degrees = &self.rungs[k].degrees;
        growth(degrees[rung[k] as usize], degrees[to as usize])
    }

    /// How a slot may be lowered in direction `k` so that N less `mu` C is likely not off by more than `tolerance`.
    pub fn step(&self, rung: Rung, k: usize, slot: &[f64], mu: f64, tolerance: f64) -> Step {
        let grid = self.grid(rung);
        let falls = &self.rungs[k].falls[rung[k] as usize];
        let estimates = grid.level.run(Estimate { grid, falls, direction: k, slot, mu });
        choose(falls, &estimates, tolerance, rung[k])
    }

    /// Lowers a slot in direction `k`; returns how far N and C are off at most, as coefficients of the degree before.
    pub fn lower(&self, rung: Rung, k: usize, to: u8, slot: &mut [f64]) -> [f64; 2] {
        let grid = self.grid(rung);
        let fall = &self.rungs[k].falls[rung[k] as usize][usize::from(to - rung[k]) - 1];
        let mut lower = rung;
        lower[k] = to;
        let stride = self.grid(lower).stride;
        grid.level.run(Lower { grid, fall, direction: k, slot, stride })
    }

    /// The falls of nets in direction `k`.
    pub(crate) fn net(&self, k: usize) -> NetFalls<'_> {
        NetFalls { falls: &self.rungs[k].nets }
    }
}

/// The lowest rung that will do, and how long to wait for the next one: halving divides what is neglected by two to the power
/// of its degree.
fn choose(falls: &[Fall], estimates: &[f64; RUNGS.len()], tolerance: f64, rung: u8) -> Step {
    let fitting = (0..falls.len()).rev().find(|k| estimates[*k] <= tolerance);
    let next = fitting.map_or(0, |k| k + 1);
    let to = rung + next as u8;
    let Some(fall) = falls.get(next) else { return Step { to, later: u32::MAX } };
    let (mut rest, drop) = (estimates[next] / tolerance, (1u64 << (fall.to + 1)) as f64);
    let mut halvings = 0;
    while rest > 1.0 && halvings < MOST_HALVINGS {
        (rest, halvings) = (rest / drop, halvings + 1);
    }
    Step { to, later: halvings.max(1) }
}

/// How nets are lowered in one direction, from the whole degree.
#[derive(Clone, Copy)]
pub(crate) struct NetFalls<'a> {
    falls: &'a [Fall],
}

impl NetFalls<'_> {
    /// The lowest rung to which strands may be lowered: every coordinate is likely off by no more than a tolerance, weights
    /// counting `scale` times. Strand k begins at pole `k * starts`, its poles are `step` apart.
    #[inline(always)]
    pub(crate) fn choose<S: Simd>(
        &self,
        lanes: &[[f64; 4]],
        [count, starts, step]: [usize; 3],
        scale: f64,
        tolerance: f64,
    ) -> u8 {
        let Some(first) = self.falls.first() else { return 0 };
        let mut strand = [S::F4::splat(0.0); MAX_DEGREE + 1];
        let mut most = [S::F4::splat(0.0); RUNGS.len()];
        for k in 0..count {
            for i in 0..=first.from {
                strand[i] = S::F4::load(&lanes[k * starts + i * step]);
            }
            for (most, fall) in most.iter_mut().zip(self.falls) {
                *most = fall.estimate(&strand).max(*most);
            }
        }
        let mut rung = 0;
        for k in 0..self.falls.len() {
            let [x, y, z, w] = most[k].array();
            if x.max(y).max(z).max(w * scale) <= tolerance {
                rung = k as u8 + 1;
            }
        }
        rung
    }

    /// Lowers strands to a rung; the lower poles of strand k begin at `k * to_starts` and are `to_step` apart. Returns how far coordinates are off.
    #[inline(always)]
    pub(crate) fn lower<S: Simd>(
        &self,
        rung: u8,
        lanes: &mut [[f64; 4]],
        [count, starts, step]: [usize; 3],
        [to_starts, to_step]: [usize; 2],
    ) -> [f64; 4] {
        let fall = &self.falls[rung as usize - 1];
        let mut strand = [S::F4::splat(0.0); MAX_DEGREE + 1];
        let mut low = [S::F4::splat(0.0); MOST_LOW];
        let mut off = S::F4::splat(0.0);
        for k in 0..count {
            for i in 0..=fall.from {
                strand[i] = S::F4::load(&lanes[k * starts + i * step]);
            }
            off = fall.apply(&strand, &mut low).max(off);
            for i in 0..=fall.to {
                low[i].store(&mut lanes[k * to_starts + i * to_step]);
            }
        }
        off.array()
    }

    /// Degree of products at a rung other than 0, halved.
    pub(crate) fn degree(&self, rung: u8) -> usize {
        self.falls[rung as usize - 1].to
    }
}

/// Eight strands of an array: columns for direction s, rows for t. Lanes behind the last row take that again.
#[inline(always)]
pub(super) fn strands<S: Simd>(
    grid: &Grid,
    array: &[f64],
    direction: usize,
    first: usize,
    out: &mut [S::F8; MOST],
) {
    let columns = grid.width();
    if direction == 0 {
        for i in 0..=grid.degree.s {
            let at = LANES + i * columns + first;
            let mut values = [0.0; LANES];
            values.copy_from_slice(&array[at..at + LANES]);
            out[i] = S::F8::load(&values);
        }
    } else {
        let last = grid.degree.s - first;
        for j in 0..columns {
            let mut values = [0.0; LANES];
            for (k, value) in values.iter_mut().enumerate() {
                *value = array[LANES + (first + k.min(last)) * columns + j];
            }
            out[j] = S::F8::load(&values);
        }
    }
}

/// The greatest of the first lanes.
#[inline(always)]
fn greatest<V: Lanes<LANES>>(values: V, lanes: usize) -> f64 {
    values.array()[..lanes.min(LANES)].iter().fold(0.0, |most, x| if *x > most { *x } else { most })
}

/// How far off N less `mu` C is likely, for each fall.
struct Estimate<'a> {
    grid: &'a Grid,
    falls: &'a [Fall],
    direction: usize,
    slot: &'a [f64],
    mu: f64,
}

impl Kernel for Estimate<'_> {
    type Out = [f64; RUNGS.len()];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> Self::Out {
        let Self { grid, falls, direction, slot, mu } = self;
        let others = if direction == 0 { grid.width() } else { grid.degree.s + 1 };
        let mut out = [0.0; RUNGS.len()];
        let mut strand = [S::F8::splat(0.0); MOST];
        let arrays = [(&slot[..grid.stride], 1.0), (&slot[grid.stride..], mu)];
        for (array, times) in &arrays[..=usize::from(grid.rational)] {
            let mut most = [0.0_f64; RUNGS.len()];
            let mut first = 0;
            while first < others {
                strands::<S>(grid, array, direction, first, &mut strand);
                for (most, fall) in most.iter_mut().zip(falls) {
                    *most = most.max(greatest(fall.estimate(&strand), others - first));
                }
                first += LANES;
            }
            for (out, most) in out.iter_mut().zip(most) {
                *out += *times * most;
            }
        }
        out
    }
}

/// A slot of lower degree in place of the slot; C moves to `stride`.
struct Lower<'a> {
    grid: &'a Grid,
    fall: &'a Fall,
    direction: usize,
    slot: &'a mut [f64],
    stride: usize,
}

impl Kernel for Lower<'_> {
    type Out = [f64; 2];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [f64; 2] {
        let Self { grid, fall, direction, slot, stride } = self;
        let n = array::<S>(grid, fall, direction, &mut slot[..grid.stride]);
        if !grid.rational {
            return [n, 0.0];
        }
        let c = array::<S>(grid, fall, direction, &mut slot[grid.stride..]);
        slot.copy_within(grid.stride..grid.stride + stride, stride);
        [n, c]
    }
}

/// One array.
#[inline(always)]
fn array<S: Simd>(grid: &Grid, fall: &Fall, direction: usize, array: &mut [f64]) -> f64 {
    let columns = grid.width();
    let others = if direction == 0 { columns } else { grid.degree.s + 1 };
    let mut strand = [S::F8::splat(0.0); MOST];
    let mut low = [S::F8::splat(0.0); MOST_LOW];
    let mut off = 0.0_f64;
    let mut first = 0;
    while first < others {
        let lanes = (others - first).min(LANES);
        strands::<S>(grid, array, direction, first, &mut strand);
        off = off.max(greatest(fall.apply(&strand, &mut low), lanes));
        // What is stored lies before what is still to be loaded.
        for k in 0..=fall.to {
            let values = low[k].array();
            if direction == 0 {
                let at = LANES + k * columns + first;
                array[at..at + lanes].copy_from_slice(&values[..lanes]);
            } else {
                for (i, value) in values[..lanes].iter().enumerate() {
                    array[LANES + (first + i) * (fall.to + 1) + k] = *value;
                }
            }
        }
        first += LANES;
    }
    off
}

#[cfg(test)]
mod tests;
