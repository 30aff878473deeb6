//! Bernstein coefficients of products on a box, tested and halved in vectors.
//!
//! The squared distance from a query is `N / C` with `N = |X - W p|^2`, `C = W^2`, both of twice the degree of the piece.
//! A *slot* holds the coefficients of N and, when rational, of C. Coefficient (i, j) is number `k = i * width + j`; the
//! array has room before and behind, so that whole vectors can be read at `k - width` and at `k + 2 width`:
//!
//! ```text
//!   |<-- 8 -->|<------- count ------->|<- to a multiple of 8 ->|     at least 7 behind the last coefficient
//!   0         c0  c1  ...                                            never NaN or infinite
//! ```
//!
//! Differences along s are those of flat arrays at `width` apart, along t at 1 apart; what crosses the end of a row is
//! masked by adding an infinity. Every function gives the same bits at every [`Level`].
//!
//! Reference: Farouki, Rajan, *Algorithms for polynomials in Bernstein form*, 1988.
#![allow(unsafe_code)]

use crate::bezier::{Bidegree, binomial};
use crate::bounds::Vector;
use crate::simd::{Kernel, Lanes, Level, Simd};

/// Lanes of a vector, and room before the first coefficient.
const LANES: usize = 8;

/// The shape of the coefficient arrays of one bidegree, with the tables that its kernels need.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Bidegree of the products.
    pub degree: Bidegree,
    /// Number of coefficients.
    pub count: usize,
    /// Doubles of one array, room included.
    pub stride: usize,
    /// Whether C is kept.
    pub rational: bool,
    /// Vector instructions.
    pub level: Level,
    /// Row and column of each coefficient; -1 behind the last.
    row: Vec<f64>,
    column: Vec<f64>,
    /// 0 where a value or difference counts, infinity elsewhere: values, first differences along t, second ones, mixed.
    value: Vec<f64>,
    along_t: Vec<f64>,
    twice_t: Vec<f64>,
    /// Binomials of the factors, reciprocals of those of the product.
    up: Vec<f64>,
    down: Vec<f64>,
}

/// Extremes of first and second differences of an array.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences {
    /// Least and greatest along s.
    pub s: [f64; 2],
    /// Least and greatest along t.
    pub t: [f64; 2],
    /// Least second difference along s.
    pub ss: f64,
    /// Least second difference along t.
    pub tt: f64,
    /// Greatest absolute mixed difference.
    pub st: f64,
}

impl Differences {
    /// Takes in the first differences of another array.
    pub fn include_first(&mut self, other: &Self) {
        let merged = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        self.s = merged(self.s, other.s);
        self.t = merged(self.t, other.t);
    }

    /// Greatest slope along s and along t, in the box's unit parameters.
    pub fn steepest(&self, degree: Bidegree) -> [f64; 2] {
        let size = |[low, high]: [f64; 2], n: usize| low.abs().max(high.abs()) * n as f64;
        [size(self.s, degree.s), size(self.t, degree.t)]
    }

    /// Lower bounds `a`, `c` of the two pure second derivatives and an upper bound `b` of the mixed one, in unit
    /// parameters, when `a c > b^2`: then the polynomial is convex. Every second difference may be off by `allowance`.
    pub fn convexity(&self, degree: Bidegree, allowance: f64) -> Option<[f64; 3]> {
        let (n, m) = (degree.s as f64, degree.t as f64);
        let a = n * (n - 1.0) * (self.ss - allowance);
        let b = n * m * (self.st + allowance);
        let c = m * (m - 1.0) * (self.tt - allowance);
        // The determinant must keep enough digits for the first-order bound that divides by it.
        (a > 0.0 && c > 0.0 && a * c * (1.0 - 1e-5) > b * b).then_some([a, b, c])
    }
}

/// Rounded up to whole vectors.
fn whole(count: usize) -> usize {
    count.div_ceil(LANES) * LANES
}

/// Doubles that hold `count` coefficients in whole vectors, without room before them: the form of tensors.
pub fn padded(count: usize) -> usize {
    whole(count)
}

/// Eight values from number `at` on.
///
/// # Safety
/// `at + 8` is at most the length: kernels check lengths once, not at every load.
#[inline(always)]
unsafe fn eight<S: Simd>(values: &[f64], at: usize) -> S::F8 {
    debug_assert!(at + LANES <= values.len());
    // SAFETY: the caller's.
    S::F8::load(unsafe { &*values.as_ptr().add(at).cast() })
}

/// Stores eight values from number `at` on.
///
/// # Safety
/// As [`eight`].
#[inline(always)]
unsafe fn store<S: Simd>(vector: S::F8, values: &mut [f64], at: usize) {
    debug_assert!(at + LANES <= values.len());
    // SAFETY: the caller's.
    vector.store(unsafe { &mut *values.as_mut_ptr().add(at).cast() });
}

impl Grid {
    /// The arrays of products of two polynomials of bidegree `factor`.
    pub fn new(factor: Bidegree, rational: bool, level: Level) -> Self {
        let degree = factor.times(factor);
        let (count, width) = (degree.count(), degree.t + 1);
        let room = whole(count + LANES - 1);
        let table = |f: &dyn Fn(usize) -> f64| (0..room).map(f).collect::<Vec<f64>>();
        let mask = |counts: bool| if counts { 0.0 } else { f64::INFINITY };
        let column = |k: usize| if k < count { (k % width) as f64 } else { -1.0 };
        let binomials = |degree: Bidegree, k: usize| {
            let width = degree.t + 1;
            binomial(degree.s, k / width) * binomial(degree.t, k % width)
        };
        Self {
            degree,
            count,
            stride: LANES + room,
            rational,
            level,
            row: table(&|k| if k < count { (k / width) as f64 } else { -1.0 }),
            column: table(&column),
            value: table(&|k| mask(k < count)),
            along_t: table(&|k| mask(k < count && k % width + 1 < width)),
            twice_t: table(&|k| mask(k < count && k % width + 2 < width)),
            up: (0..factor.count()).map(|k| binomials(factor, k)).collect(),
            down: table(&|k| if k < count { 1.0 / binomials(degree, k) } else { 0.0 }),
        }
    }

    /// Doubles of a slot.
    pub fn slot(&self) -> usize {
        if self.rational { 2 * self.stride } else { self.stride }
    }

    /// Bytes held.
    pub fn memory(&self) -> usize {
        8 * (self.row.capacity()
            + self.column.capacity()
            + self.value.capacity()
            + self.along_t.capacity()
            + self.twice_t.capacity()
            + self.up.capacity()
            + self.down.capacity())
    }

    fn width(&self) -> usize {
        self.degree.t + 1
    }

    /// The coefficients of N in a slot.
    pub fn n<'a>(&self, slot: &'a [f64]) -> &'a [f64] {
        &slot[LANES..LANES + self.count]
    }

    /// The coefficients of C in a slot; empty when polynomial.
    pub fn c<'a>(&self, slot: &'a [f64]) -> &'a [f64] {
        if self.rational { &slot[self.stride + LANES..][..self.count] } else { &[] }
    }

    /// Fills a slot from tensors A, -2 B (three) and, when rational, C, each [`padded`]: `N = A - 2 p.B + |p|^2 C`.
    pub fn multiply(&self, tensors: &[f64], p: Vector, square: f64, slot: &mut [f64]) {
        self.level.run(Multiply { grid: self, tensors, p, square, slot });
    }

    /// Whether all `N > mu C`, for two values of `mu`.
    pub fn all_beyond(&self, slot: &[f64], mu: [f64; 2]) -> [bool; 2] {
        self.level.run(Beyond { grid: self, slot, mu })
    }

    /// Least ratio N / C, the first index that has it, and the greatest C.
    pub fn least_ratio(&self, slot: &[f64]) -> (f64, usize, f64) {
        self.level.run(Ratio { grid: self, slot })
    }

    /// Extremes of the differences of `N - mu C`; `h` has room for one array. Polynomial: of N, whatever `mu` is.
    pub fn differences(&self, slot: &[f64], mu: f64, h: &mut [f64]) -> Differences {
        self.level.run(Extremes { grid: self, slot, mu, h })
    }

    /// Splits a slot at the middle of direction 0 (s) or 1 (t): `low` becomes the first half, `high` the rest. Returns the
    /// least N of both.
    pub fn halve(&self, direction: usize, low: &mut [f64], high: &mut [f64]) -> [f64; 2] {
        self.level.run(Halve { grid: self, direction, low, high })
    }

    /// Coefficients of `|r|^2` and, when rational, `W^2` of a net of lanes `r`, `W`, which is used up.
    pub fn square(&self, net: &mut [[f64; 4]], slot: &mut [f64]) {
        self.level.run(Square { grid: self, net, slot });
    }
}

struct Multiply<'a> {
    grid: &'a Grid,
    tensors: &'a [f64],
    p: Vector,
    square: f64,
    slot: &'a mut [f64],
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

struct Beyond<'a> {
    grid: &'a Grid,
    slot: &'a [f64],
    mu: [f64; 2],
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

struct Ratio<'a> {
    grid: &'a Grid,
    slot: &'a [f64],
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

struct Extremes<'a> {
    grid: &'a Grid,
    slot: &'a [f64],
    mu: f64,
    h: &'a mut [f64],
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

struct Halve<'a> {
    grid: &'a Grid,
    direction: usize,
    low: &'a mut [f64],
    high: &'a mut [f64],
}

impl Halve<'_> {
    /// One array; returns the least of both halves.
    #[inline(always)]
    fn array<S: Simd>(
        grid: &Grid,
        direction: usize,
        low: &mut [f64],
        high: &mut [f64],
    ) -> [f64; 2] {
        let (count, width) = (grid.count, grid.width());
        let half = S::F8::splat(0.5);
        let (n, back) = if direction == 0 { (grid.degree.s, width) } else { (grid.degree.t, 1) };
        let rank = if direction == 0 { &grid.row } else { &grid.column };
        assert!(low.len() >= grid.stride && high.len() >= grid.stride);
        for level in 0..n {
            Self::keep(grid, direction, n - level, low, high);
            let first = if direction == 0 { (level + 1) * width / LANES * LANES } else { 0 };
            let reached = S::F8::splat(level as f64);
            // From the end, so that what a vector reads before itself is of the level before.
            let mut k = padded(count);
            while k > first {
                k -= LANES;
                // SAFETY: the lengths were checked. Along s, k >= first > width - 8, so that nothing is read before the
                // room in front.
                unsafe {
                    let x = eight::<S>(low, LANES + k);
                    let y = eight::<S>(low, LANES + k - back);
                    let rank = eight::<S>(rank, k);
                    let mean = (half * (x + y)).where_less(reached, rank, x);
                    store::<S>(mean, low, LANES + k);
                }
            }
        }
        Self::keep(grid, direction, 0, low, high);
        [Self::least::<S>(grid, low), Self::least::<S>(grid, high)]
    }

    #[inline(always)]
    fn least<S: Simd>(grid: &Grid, array: &[f64]) -> f64 {
        let mut least = S::F8::splat(f64::INFINITY);
        let mut k = 0;
        while k < grid.count {
            // SAFETY: the caller has checked the length.
            unsafe {
                let x = eight::<S>(array, LANES + k);
                least = (x + eight::<S>(&grid.value, k)).min(least);
            }
            k += LANES;
        }
        least.least()
    }

    /// The last row or column of `low` becomes number `place` of `high`.
    #[inline(always)]
    fn keep(grid: &Grid, direction: usize, place: usize, low: &[f64], high: &mut [f64]) {
        let width = grid.width();
        if direction == 0 {
            let last = LANES + grid.degree.s * width;
            let to = LANES + place * width;
            high[to..to + width].copy_from_slice(&low[last..last + width]);
        } else {
            let (last, size) = (grid.degree.t, grid.count);
            let (low, high) = (&low[LANES..][..size], &mut high[LANES..][..size]);
            for (to, from) in high.chunks_exact_mut(width).zip(low.chunks_exact(width)) {
                to[place] = from[last];
            }
        }
    }
}

impl Kernel for Halve<'_> {
    type Out = [f64; 2];

    #[inline(always)]
    fn run<S: Simd>(self, _: S) -> [f64; 2] {
        let stride = self.grid.stride;
        if self.grid.rational {
            let (low, high) = (&mut self.low[stride..], &mut self.high[stride..]);
            Self::array::<S>(self.grid, self.direction, low, high);
        }
        let (low, high) = (&mut self.low[..stride], &mut self.high[..stride]);
        Self::array::<S>(self.grid, self.direction, low, high)
    }
}

struct Square<'a> {
    grid: &'a Grid,
    net: &'a mut [[f64; 4]],
    slot: &'a mut [f64],
}

impl Square<'_> {
    /// The sum over all pairs of poles whose indices add up to (m, n), the symmetric ones once.
    #[inline(always)]
    fn sum<S: Simd>(net: &[[f64; 4]], rows: usize, columns: usize, m: usize, n: usize) -> S::F4 {
        let mut sum = S::F4::splat(0.0);
        let first = n.saturating_sub(columns - 1);
        for i in m.saturating_sub(rows - 1)..=m / 2 {
            let (a, b) = (i * columns, (m - i) * columns);
            let last = if 2 * i == m { n.div_ceil(2) } else { n.min(columns - 1) + 1 };
            let mut part = S::F4::splat(0.0);
            let (a, b) = (&net[a + first..a + last.max(first)], &net[b..b + n - first + 1]);
            for (x, y) in a.iter().zip(b.iter().rev()) {
                part = part + S::F4::load(x) * S::F4::load(y);
            }
            sum = sum + (part + part);
            if 2 * i == m && n % 2 == 0 {
                let middle = S::F4::load(&net[i * columns + n / 2]);
                sum = sum + middle * middle;
            }
        }
        sum
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
        let mut k = 0;
        for m in 0..=grid.degree.s {
            for n in 0..=grid.degree.t {
                let sum = Self::sum::<S>(net, rows, columns, m, n);
                let [x, y, z, w] = (sum * S::F4::splat(grid.down[k])).array();
                slot[LANES + k] = (x + y) + z;
                if grid.rational {
                    slot[grid.stride + LANES + k] = w;
                }
                k += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::{convolve_square, halve_s, halve_t, scale_down_2d, scale_up_2d};

    const FACTORS: [Bidegree; 6] = [
        Bidegree { s: 1, t: 1 },
        Bidegree { s: 3, t: 3 },
        Bidegree { s: 2, t: 4 },
        Bidegree { s: 5, t: 1 },
        Bidegree { s: 0, t: 3 },
        Bidegree { s: 7, t: 6 },
    ];

    fn value(seed: usize, k: usize) -> f64 {
        ((seed * 977 + k * 7919) % 1009) as f64 / 97.0 - 4.0
    }

    /// A slot with values everywhere, also where they do not belong to coefficients.
    fn filled(grid: &Grid, seed: usize) -> Vec<f64> {
        let mut slot: Vec<f64> = (0..grid.slot()).map(|k| value(seed, k)).collect();
        if grid.rational {
            slot[grid.stride..].iter_mut().for_each(|c| *c = c.abs() + 0.5);
        }
        slot
    }

    fn grids() -> impl Iterator<Item = Grid> {
        let levels = Level::available().into_iter();
        levels.flat_map(|level| {
            FACTORS.into_iter().flat_map(move |factor| {
                [false, true].map(|rational| Grid::new(factor, rational, level))
            })
        })
    }

    #[test]
    fn ratios_and_tests_see_the_coefficients_and_nothing_else() {
        for grid in grids() {
            let slot = filled(&grid, 5);
            let c = |k: usize| if grid.rational { grid.c(&slot)[k] } else { 1.0 };
            let ratios: Vec<f64> = (0..grid.count).map(|k| grid.n(&slot)[k] / c(k)).collect();
            let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
            let greatest = (0..grid.count).map(c).fold(0.0, f64::max);
            let place = ratios.iter().position(|&x| x == least).unwrap();
            assert_eq!(grid.least_ratio(&slot), (least, place, greatest));
            for mu in [least - 0.01, least + 0.01] {
                let expected = (0..grid.count).all(|k| grid.n(&slot)[k] > mu * c(k));
                assert_eq!(grid.all_beyond(&slot, [mu, mu]), [expected; 2], "{:?}", grid.degree);
            }
        }
    }

    #[test]
    fn differences_stay_inside_rows_and_columns() {
        for grid in grids() {
            let (slot, mut h) = (filled(&grid, 3), vec![0.0; grid.stride]);
            let found = grid.differences(&slot, 0.75, &mut h);
            let width = grid.degree.t + 1;
            let f = |i: usize, j: usize| {
                let k = i * width + j;
                if grid.rational {
                    grid.n(&slot)[k] - 0.75 * grid.c(&slot)[k]
                } else {
                    grid.n(&slot)[k]
                }
            };
            let (rows, columns) = (grid.degree.s + 1, width);
            let mut expected = Differences {
                s: [f64::INFINITY, f64::NEG_INFINITY],
                t: [f64::INFINITY, f64::NEG_INFINITY],
                ss: f64::INFINITY,
                tt: f64::INFINITY,
                st: 0.0,
            };
            for (i, j) in (0..rows * columns).map(|k| (k / columns, k % columns)) {
                if i + 1 < rows {
                    let d = f(i + 1, j) - f(i, j);
                    expected.s = [expected.s[0].min(d), expected.s[1].max(d)];
                }
                if j + 1 < columns {
                    let d = f(i, j + 1) - f(i, j);
                    expected.t = [expected.t[0].min(d), expected.t[1].max(d)];
                }
                if i + 2 < rows {
                    let d = (f(i + 2, j) - f(i + 1, j)) - (f(i + 1, j) - f(i, j));
                    expected.ss = expected.ss.min(d);
                }
                if j + 2 < columns {
                    let d = (f(i, j + 2) - f(i, j + 1)) - (f(i, j + 1) - f(i, j));
                    expected.tt = expected.tt.min(d);
                }
                if i + 1 < rows && j + 1 < columns {
                    let d = (f(i + 1, j + 1) - f(i + 1, j)) - (f(i, j + 1) - f(i, j));
                    expected.st = expected.st.max(d.abs());
                }
            }
            assert_eq!(found, expected, "{:?} {}", grid.degree, grid.rational);
        }
    }

    #[test]
    fn halves_are_those_of_de_casteljau_bit_for_bit() {
        for grid in grids() {
            for direction in [0, 1] {
                let mut low = filled(&grid, 11);
                let mut high = vec![0.0; grid.slot()];
                let halved = |mut low: Vec<f64>| {
                    let mut high = low.clone();
                    let halve = if direction == 0 { halve_s } else { halve_t };
                    halve(&mut low, &mut high, grid.degree);
                    (low, high)
                };
                let (n, n_high) = halved(grid.n(&low).to_vec());
                let (c, c_high) =
                    if grid.rational { halved(grid.c(&low).to_vec()) } else { Default::default() };
                let least = grid.halve(direction, &mut low, &mut high);
                assert_eq!((grid.n(&low), grid.n(&high)), (&n[..], &n_high[..]));
                assert_eq!((grid.c(&low), grid.c(&high)), (&c[..], &c_high[..]));
                let least_of = |x: &[f64]| x.iter().copied().fold(f64::INFINITY, f64::min);
                assert_eq!(least, [least_of(&n), least_of(&n_high)]);
            }
        }
    }

    #[test]
    fn squares_are_the_products() {
        for grid in grids() {
            let factor = Bidegree { s: grid.degree.s / 2, t: grid.degree.t / 2 };
            let count = factor.count();
            let mut net: Vec<[f64; 4]> =
                (0..count).map(|k| [0, 1, 2, 3].map(|c| value(c, k))).collect();
            let mut expected = vec![vec![0.0; grid.count]; 2];
            for c in 0..4 {
                let mut f: Vec<f64> = net.iter().map(|lane| lane[c]).collect();
                scale_up_2d(&mut f, factor);
                convolve_square(&f, factor, 1.0, &mut expected[c / 3]);
            }
            expected.iter_mut().for_each(|product| scale_down_2d(product, grid.degree));
            let mut slot = vec![0.0; grid.slot()];
            grid.square(&mut net, &mut slot);
            let close = |a: &[f64], b: &[f64]| {
                a.iter().zip(b).for_each(|(a, b)| assert!((a - b).abs() < 1e-12, "{a} {b}"));
            };
            close(grid.n(&slot), &expected[0]);
            close(grid.c(&slot), &expected[1]);
        }
    }

    #[test]
    fn a_bowl_is_convex_and_a_saddle_is_not() {
        // s^2 + t^2 and s^2 - t^2, Bernstein coefficients of degree 2.
        let grid = Grid::new(Bidegree { s: 1, t: 1 }, false, Level::detect());
        let of = |f: [f64; 9]| {
            let mut slot = vec![0.0; grid.slot()];
            slot[LANES..LANES + 9].copy_from_slice(&f);
            grid.differences(&slot, 0.0, &mut [])
        };
        let bowl = of([0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0]);
        let saddle = of([0.0, 0.0, -1.0, 0.0, 0.0, -1.0, 1.0, 1.0, 0.0]);
        // |(s, t, 4 s t)|^2 around the query (0.5, 0.5, -1), two minima: the mixed difference decides.
        let twisted = of([0.5, 0.0, 0.5, 0.0, 2.0, 0.0, 0.5, 0.0, 0.5]);
        assert_eq!(bowl.convexity(grid.degree, 0.0), Some([2.0, 0.0, 2.0]));
        assert_eq!(bowl.convexity(grid.degree, 1.0), None);
        assert_eq!(saddle.convexity(grid.degree, 0.0), None);
        assert_eq!(twisted.convexity(grid.degree, 0.0), None);
    }
}
