//! The kernels behind [`Grid`]: lengths are checked once at the head of each, loads and stores are not.
#![allow(unsafe_code)]

use super::{Differences, Grid, LANES, padded};
use crate::bounds::Vector;
use crate::knots::MAX_DEGREE;
use crate::simd::{Kernel, Lanes, Simd};

/// Eight values from number `at` on.
///
/// # Safety
/// `at + 8` is at most the length: kernels check lengths once, not at every load.
#[inline(always)]
pub(super) unsafe fn eight<S: Simd>(values: &[f64], at: usize) -> S::F8 {
    debug_assert!(at + LANES <= values.len());
    // SAFETY: the caller's.
    S::F8::load(unsafe { &*values.as_ptr().add(at).cast() })
}

/// Stores eight values from number `at` on.
///
/// # Safety
/// As [`eight`].
#[inline(always)]
pub(super) unsafe fn store<S: Simd>(vector: S::F8, values: &mut [f64], at: usize) {
    debug_assert!(at + LANES <= values.len());
    // SAFETY: the caller's.
    vector.store(unsafe { &mut *values.as_mut_ptr().add(at).cast() });
}

/// Coefficients from tensors.
pub struct Multiply<'a> {
    pub grid: &'a Grid,
    pub tensors: &'a [f64],
    pub p: Vector,
    pub square: f64,
    pub slot: &'a mut [f64],
}

impl Kernel for Multiply<'_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let (size, stride, rational) =
            (padded(self.grid.count), self.grid.stride, self.grid.rational);
        let (x, y) = (S::F8::splat(self.p[0]), S::F8::splat(self.p[1]));
        let (z, square) = (S::F8::splat(self.p[2]), S::F8::splat(self.square));
        let (tensors, slot) = (self.tensors, self.slot);
        assert!(tensors.len() >= size * if rational { 5 } else { 4 });
        assert!(slot.len() >= self.grid.slot());
        let mut k = 0;
        while k < size {
            // SAFETY: both lengths were checked, and an array of a slot has room for whole vectors.
            unsafe {
                let a = eight::<S>(tensors, k);
                let b_x = eight::<S>(tensors, size + k);
                let b_y = eight::<S>(tensors, 2 * size + k);
                let b_z = eight::<S>(tensors, 3 * size + k);
                let c =
                    if rational { eight::<S>(tensors, 4 * size + k) } else { S::F8::splat(1.0) };
                let n = a + (x * b_x + y * b_y) + (z * b_z + square * c);
                store::<S>(n, slot, LANES + k);
                if rational {
                    store::<S>(c, slot, stride + LANES + k);
                }
            }
            k += LANES;
        }
    }
}

/// Whether all `N > mu C` of what [`Multiply`] would make, and no C is less than `least_c`.
pub struct ProductBeyond<'a> {
    pub grid: &'a Grid,
    pub tensors: &'a [f64],
    pub p: Vector,
    pub square: f64,
    pub mu: f64,
    pub least_c: f64,
}

impl Kernel for ProductBeyond<'_> {
    type Out = bool;

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> bool {
        let Self { grid, tensors, .. } = self;
        let size = padded(grid.count);
        let (x, y) = (S::F8::splat(self.p[0]), S::F8::splat(self.p[1]));
        let (z, square) = (S::F8::splat(self.p[2]), S::F8::splat(self.square));
        let mu = S::F8::splat(self.mu);
        let [mut least, mut least_c] = [S::F8::splat(f64::INFINITY); 2];
        assert!(tensors.len() >= size * if grid.rational { 5 } else { 4 });
        let mut k = 0;
        while k < size {
            // SAFETY: the length was checked; tables have room for whole vectors.
            unsafe {
                let a = eight::<S>(tensors, k);
                let b_x = eight::<S>(tensors, size + k);
                let b_y = eight::<S>(tensors, 2 * size + k);
                let b_z = eight::<S>(tensors, 3 * size + k);
                let mask = eight::<S>(&grid.value, k);
                let c = if grid.rational {
                    eight::<S>(tensors, 4 * size + k)
                } else {
                    S::F8::splat(1.0)
                };
                let n = a + (x * b_x + y * b_y) + (z * b_z + square * c);
                least = (n - mu * c + mask).min(least);
                least_c = (c + mask).min(least_c);
            }
            k += LANES;
        }
        least.least() > 0.0 && least_c.least() >= self.least_c
    }
}

/// Whether all `N > mu C`, for two values of `mu`.
pub struct Beyond<'a> {
    pub grid: &'a Grid,
    pub slot: &'a [f64],
    pub mu: [f64; 2],
}

impl Kernel for Beyond<'_> {
    type Out = [bool; 2];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [bool; 2] {
        let Self { grid, slot, mu } = self;
        let [mut least, mut least_1] = [S::F8::splat(f64::INFINITY); 2];
        let (mu_0, mu_1) = (S::F8::splat(mu[0]), S::F8::splat(mu[1]));
        assert!(slot.len() >= grid.slot());
        let mut k = 0;
        while k < grid.count {
            // SAFETY: the length was checked; arrays and tables have room for whole vectors.
            unsafe {
                let n = eight::<S>(slot, LANES + k);
                let mask = eight::<S>(&grid.value, k);
                if grid.rational {
                    let c = eight::<S>(slot, grid.stride + LANES + k);
                    least = (n - mu_0 * c + mask).min(least);
                    least_1 = (n - mu_1 * c + mask).min(least_1);
                } else {
                    least = (n + mask).min(least);
                }
            }
            k += LANES;
        }
        if grid.rational {
            [least.least() > 0.0, least_1.least() > 0.0]
        } else {
            let least = least.least();
            [least > mu[0], least > mu[1]]
        }
    }
}

/// Least ratio, its index, greatest C.
pub struct Ratio<'a> {
    pub grid: &'a Grid,
    pub slot: &'a [f64],
}

impl Kernel for Ratio<'_> {
    type Out = (f64, usize, f64);

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> (f64, usize, f64) {
        let Self { grid, slot } = self;
        let mut least = S::F8::splat(f64::INFINITY);
        let mut place = S::F8::splat(0.0);
        let mut greatest = S::F8::splat(if grid.rational { 0.0 } else { 1.0 });
        let mut at = S::F8::load(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
        assert!(slot.len() >= grid.slot());
        let mut k = 0;
        while k < grid.count {
            // SAFETY: the length was checked; arrays and tables have room for whole vectors.
            let mask = unsafe { eight::<S>(&grid.value, k) };
            let mut ratio = unsafe { eight::<S>(slot, LANES + k) };
            if grid.rational {
                // SAFETY: as above.
                let c = unsafe { eight::<S>(slot, grid.stride + LANES + k) };
                ratio = ratio / c;
                greatest = (c - mask).max(greatest);
            }
            let ratio = ratio + mask;
            place = at.where_less(ratio, least, place);
            least = ratio.min(least);
            at = at + S::F8::splat(LANES as f64);
            k += LANES;
        }
        // The first index among the lanes that have the least value.
        let value = least.least();
        let none = S::F8::splat(f64::INFINITY);
        let first = none.where_less(S::F8::splat(value), least, place);
        (value, first.least() as usize, greatest.greatest())
    }
}

/// Extremes of differences of `N - mu C`.
pub struct Extremes<'a> {
    pub grid: &'a Grid,
    pub slot: &'a [f64],
    pub mu: f64,
    pub h: &'a mut [f64],
}

impl Extremes<'_> {
    #[inline(always)]
    fn form<S: Simd>(&mut self) {
        let (grid, slot, mu) = (self.grid, self.slot, S::F8::splat(self.mu));
        assert!(slot.len() >= grid.slot() && self.h.len() >= grid.stride);
        let mut k = 0;
        while k < grid.count {
            // SAFETY: the lengths were checked; arrays have room for whole vectors.
            unsafe {
                let n = eight::<S>(slot, LANES + k);
                let c = eight::<S>(slot, grid.stride + LANES + k);
                store::<S>(n - mu * c, self.h, LANES + k);
            }
            k += LANES;
        }
    }
}

impl Kernel for Extremes<'_> {
    type Out = Differences;

    #[inline(always)]
    fn run<S: Simd>(mut self, _: S) -> Differences {
        if self.grid.rational {
            self.form::<S>();
        }
        let grid = self.grid;
        let (count, width) = (grid.count, grid.width());
        let h = if grid.rational { &*self.h } else { self.slot };
        assert!(h.len() >= grid.stride);
        let h = &h[LANES..];
        let infinity = S::F8::splat(f64::INFINITY);
        let nothing = S::F8::splat(f64::NEG_INFINITY);
        let [mut s0, mut t0, mut ss, mut tt] = [infinity; 4];
        let [mut s1, mut t1] = [nothing; 2];
        let mut st = S::F8::splat(0.0);
        let mut k = 0;
        while k + 1 < count {
            // SAFETY: a vector is read from number j < count only, and 7 doubles are behind the last coefficient, in
            // the array as in the tables.
            unsafe {
                let (here, next) = (eight::<S>(h, k), eight::<S>(h, k + 1));
                let mask = eight::<S>(&grid.along_t, k);
                let d = next - here;
                t0 = (d + mask).min(t0);
                t1 = (d - mask).max(t1);
                if k + 2 < count {
                    let dd = (eight::<S>(h, k + 2) - next) - d;
                    tt = (dd + eight::<S>(&grid.twice_t, k)).min(tt);
                }
                if k + width < count {
                    // Behind the last row: what is there belongs to no difference.
                    let behind = eight::<S>(&grid.value, k + width);
                    let above = eight::<S>(h, k + width);
                    let d_s = above - here;
                    s0 = (d_s + behind).min(s0);
                    s1 = (d_s - behind).max(s1);
                    if k + width + 1 < count {
                        let mixed = (eight::<S>(h, k + width + 1) - above) - d;
                        st = (mixed.abs() - mask - behind).max(st);
                    }
                    if k + 2 * width < count {
                        let behind = eight::<S>(&grid.value, k + 2 * width);
                        let dd = (eight::<S>(h, k + 2 * width) - above) - d_s;
                        ss = (dd + behind).min(ss);
                    }
                }
            }
            k += LANES;
        }
        Differences {
            s: [s0.least(), s1.greatest()],
            t: [t0.least(), t1.greatest()],
            ss: ss.least(),
            tt: tt.least(),
            st: st.greatest(),
        }
    }
}

/// Products of a net with itself.
pub struct Square<'a> {
    pub grid: &'a Grid,
    pub net: &'a mut [[f64; 4]],
    pub slot: &'a mut [f64],
}

/// Outputs that are formed together, and room for as many zeros less one on both sides of a row.
const BLOCK: usize = 4;
const ROOM: usize = BLOCK - 1;

/// Most coefficients of a row, and of a row of products, in whole blocks.
const MOST: usize = MAX_DEGREE + 1;
const MOST_PRODUCTS: usize = 2 * MOST + ROOM;

/// Adds the product of row `a`, taken `times`, and of a row of as many columns that has [`ROOM`] on both sides.
#[inline(always)]
fn add_product<S: Simd>(
    a: &[[f64; 4]],
    b: &[[f64; 4]; MOST + 2 * ROOM],
    times: f64,
    sums: &mut [S::F4; MOST_PRODUCTS],
) {
    let columns = a.len();
    let times = S::F4::splat(times);
    let mut n = 0;
    while n < 2 * columns - 1 {
        let (mut p, mut q) = (sums[n], sums[n + 1]);
        let (mut r, mut s) = (sums[n + 2], sums[n + 3]);
        let first = (n + 1).saturating_sub(columns);
        let last = (n + BLOCK).min(columns);
        for j in first..last {
            let x = S::F4::load(&a[j]) * times;
            // Column n - j of b.
            let b = &b[ROOM + n - j..];
            let b = &b[..BLOCK];
            p = p + x * S::F4::load(&b[0]);
            q = q + x * S::F4::load(&b[1]);
            r = r + x * S::F4::load(&b[2]);
            s = s + x * S::F4::load(&b[3]);
        }
        (sums[n], sums[n + 1]) = (p, q);
        (sums[n + 2], sums[n + 3]) = (r, s);
        n += BLOCK;
    }
}

impl Kernel for Square<'_> {
    type Out = ();

    #[inline(always)]
    fn run<S: Simd>(self, _: S) {
        let Self { grid, net, slot } = self;
        let (rows, columns) = (grid.degree.s / 2 + 1, grid.degree.t / 2 + 1);
        for (lane, up) in net.iter_mut().zip(&grid.up) {
            (S::F4::load(lane) * S::F4::splat(*up)).store(lane);
        }
        let mut sums = [S::F4::splat(0.0); MOST_PRODUCTS];
        let mut row = [[0.0; 4]; MOST + 2 * ROOM];
        let mut k = 0;
        for m in 0..=grid.degree.s {
            for sum in &mut sums[..grid.width()] {
                *sum = S::F4::splat(0.0);
            }
            // Pairs of rows whose numbers add up to m, the symmetric ones once.
            for i in m.saturating_sub(rows - 1)..=m / 2 {
                let (a, b) = (i * columns, (m - i) * columns);
                row[ROOM..ROOM + columns].copy_from_slice(&net[b..b + columns]);
                let times = if 2 * i == m { 1.0 } else { 2.0 };
                add_product::<S>(&net[a..a + columns], &row, times, &mut sums);
            }
            for sum in &sums[..grid.width()] {
                let [x, y, z, w] = (*sum * S::F4::splat(grid.down[k])).array();
                slot[LANES + k] = (x + y) + z;
                if grid.rational {
                    slot[grid.stride + LANES + k] = w;
                }
                k += 1;
            }
        }
    }
}
