//! Splitting coefficients at the middle of one direction.
//!
//! Eight polynomials at a time are brought into lanes: columns of the array for direction s, rows for t. There the
//! algorithm of de Casteljau takes four levels in one pass, each row of lanes being loaded and stored once. A pass adds up
//! sixteenths and multiplies what it stores by powers of two: the bits are those of means.
#![allow(unsafe_code)]

use super::kernels::{eight, store};
use super::{Grid, LANES};
use crate::knots::MAX_DEGREE;
use crate::simd::{Kernel, Lanes, Simd};

/// A slot split at the middle of one direction.
pub struct Halve<'a> {
    pub grid: &'a Grid,
    pub direction: usize,
    pub low: &'a mut [f64],
    pub high: &'a mut [f64],
}

impl Kernel for Halve<'_> {
    type Out = [f64; 2];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [f64; 2] {
        let Self { grid, direction, low, high } = self;
        let stride = grid.stride;
        if grid.rational {
            array::<S>(grid, direction, &mut low[stride..], &mut high[stride..]);
        }
        array::<S>(grid, direction, &mut low[..stride], &mut high[..stride]);
        [least::<S>(grid, low), least::<S>(grid, high)]
    }
}

/// One array.
#[inline(always)]
fn array<S: Simd>(grid: &Grid, direction: usize, low: &mut [f64], high: &mut [f64]) {
    // Degrees of products are even, those of 1 to 4 the common ones.
    match if direction == 0 { grid.degree.s } else { grid.degree.t } {
        0 => high.copy_from_slice(low),
        2 => split::<S, 3>(grid, direction, low, high),
        4 => split::<S, 5>(grid, direction, low, high),
        6 => split::<S, 7>(grid, direction, low, high),
        8 => split::<S, 9>(grid, direction, low, high),
        1..16 => split::<S, 16>(grid, direction, low, high),
        16..32 => split::<S, 32>(grid, direction, low, high),
        _ => split::<S, MOST>(grid, direction, low, high),
    }
}

/// Most coefficients of a polynomial.
const MOST: usize = 2 * MAX_DEGREE + 1;

/// As [`array`], of at most `M` coefficients; of so many when `M` is odd and less than [`MOST`].
#[inline(always)]
fn split<S: Simd, const M: usize>(
    grid: &Grid,
    direction: usize,
    low: &mut [f64],
    high: &mut [f64],
) {
    let (columns, rows) = (grid.width(), grid.degree.s + 1);
    let length = if direction == 0 { rows } else { columns };
    let count = if M % 2 == 1 && M < MOST { M } else { length };
    assert!(low.len() >= grid.stride && high.len() >= grid.stride);
    assert!(count <= M && count == length && count > 0);
    let others = if direction == 0 { columns } else { rows };
    if direction == 1 && rows == 1 {
        let (mut b, mut ends) = ([0.0; M], [0.0; M]);
        b[..count].copy_from_slice(&low[LANES..LANES + count]);
        halve(&mut b, &mut ends, count);
        low[LANES..LANES + count].copy_from_slice(&b[..count]);
        high[LANES..LANES + count].copy_from_slice(&ends[..count]);
        return;
    }
    let mut first = 0;
    while first < others {
        let mut b = [S::F8::splat(0.0); M];
        let mut ends = [S::F8::splat(0.0); M];
        let lanes = (others - first).min(LANES);
        if direction == 0 {
            for (i, row) in b[..count].iter_mut().enumerate() {
                // SAFETY: the lengths were checked, and an array has room for a vector from any coefficient on.
                *row = unsafe { eight::<S>(low, LANES + i * columns + first) };
            }
            halve(&mut b, &mut ends, count);
            for i in 0..count {
                let at = LANES + i * columns + first;
                put::<S>(b[i], low, at, lanes, columns);
                put::<S>(ends[i], high, at, lanes, columns);
            }
        } else {
            for (j, column) in b[..count].iter_mut().enumerate() {
                let mut values = [0.0; LANES];
                for (k, value) in values.iter_mut().enumerate() {
                    // Lanes behind the last row take that again.
                    *value = low[LANES + (first + k.min(lanes - 1)) * columns + j];
                }
                *column = S::F8::load(&values);
            }
            halve(&mut b, &mut ends, count);
            for j in 0..count {
                let (a, b) = (b[j].array(), ends[j].array());
                for k in 0..lanes {
                    let at = LANES + (first + k) * columns + j;
                    (low[at], high[at]) = (a[k], b[k]);
                }
            }
        }
        first += LANES;
    }
}

/// Stores the first lanes at `at`, a part of a row; what is stored behind it belongs to later rows.
#[inline(always)]
fn put<S: Simd>(vector: S::F8, out: &mut [f64], at: usize, lanes: usize, columns: usize) {
    if lanes == LANES || columns <= LANES {
        // SAFETY: as for the loads.
        unsafe { store::<S>(vector, out, at) };
    } else {
        // Later rows have been filled there.
        out[at..at + lanes].copy_from_slice(&vector.array()[..lanes]);
    }
}

/// The first half of each lane's polynomial in place of it, the other half in `high`.
#[inline(always)]
fn halve<V: Lanes<N>, const N: usize, const M: usize>(
    b: &mut [V; M],
    high: &mut [V; M],
    count: usize,
) {
    let (sixteenth, half) = (V::splat(0.0625), V::splat(0.5));
    let (two, four, eight) = (V::splat(2.0), V::splat(4.0), V::splat(8.0));
    let last = count - 1;
    let mut level = 0;
    high[last] = b[last];
    while last - level >= 4 {
        let a = b[level] * sixteenth;
        let x = b[level + 1] * sixteenth;
        let (mut c0, mut c1) = (x, x + a);
        b[level + 1] = c1 * eight;
        let x = b[level + 2] * sixteenth;
        let y = x + c0;
        let mut c2 = y + c1;
        (c0, c1) = (x, y);
        b[level + 2] = c2 * four;
        let x = b[level + 3] * sixteenth;
        let y = x + c0;
        let z = y + c1;
        let mut c3 = z + c2;
        (c0, c1, c2) = (x, y, z);
        b[level + 3] = c3 * two;
        for row in &mut b[level + 4..count] {
            let x = *row * sixteenth;
            let y = x + c0;
            let z = y + c1;
            let w = z + c2;
            *row = w + c3;
            (c0, c1, c2, c3) = (x, y, z, w);
        }
        high[last - level - 1] = c1 * eight;
        high[last - level - 2] = c2 * four;
        high[last - level - 3] = c3 * two;
        high[last - level - 4] = b[last];
        level += 4;
    }
    while level < last {
        let mut before = b[level];
        for row in &mut b[level + 1..count] {
            let x = *row;
            *row = (before + x) * half;
            before = x;
        }
        level += 1;
        high[last - level] = b[last];
    }
}

/// The least coefficient.
#[inline(always)]
fn least<S: Simd>(grid: &Grid, array: &[f64]) -> f64 {
    let mut least = S::F8::splat(f64::INFINITY);
    let mut k = 0;
    while k < grid.count {
        // SAFETY: the length was checked; arrays and tables have room for whole vectors.
        unsafe {
            let x = eight::<S>(array, LANES + k);
            least = (x + eight::<S>(&grid.value, k)).min(least);
        }
        k += LANES;
    }
    least.least()
}
