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

mod halve;
mod kernels;
mod lower;
mod part;

use crate::bezier::{Bidegree, binomial};
use crate::bounds::Vector;
use crate::knots::MAX_DEGREE;
use crate::simd::Level;
use halve::Halve;
use kernels::{Beyond, Extremes, Multiply, ProductBeyond, Ratio, Square};
pub(crate) use lower::NetFalls;
pub use lower::{Ladder, Rung, Step};
use part::Part;

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
    /// parameters, when `a c > b^2`: then the polynomial is convex. The second differences may be off by `allowance` each.
    pub fn convexity(&self, degree: Bidegree, allowance: [f64; 3]) -> Option<[f64; 3]> {
        let (n, m) = (degree.s as f64, degree.t as f64);
        let a = n * (n - 1.0) * (self.ss - allowance[0]);
        let b = n * m * (self.st + allowance[1]);
        let c = m * (m - 1.0) * (self.tt - allowance[2]);
        // The determinant must keep enough digits for the first-order bound that divides by it.
        (a > 0.0 && c > 0.0 && a * c * (1.0 - 1e-5) > b * b).then_some([a, b, c])
    }
}

/// Most coefficients along one direction.
const MOST: usize = 2 * MAX_DEGREE + 1;

/// The Bernstein polynomials of a degree at x.
fn bernstein(degree: usize, x: f64, out: &mut [f64]) {
    let mut power = 1.0;
    for (k, value) in out[..=degree].iter_mut().enumerate() {
        *value = binomial(degree, k) * power;
        power *= x;
    }
    power = 1.0;
    for value in out[..=degree].iter_mut().rev() {
        *value *= power;
        power *= 1.0 - x;
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

/// A vertex within this share of a side is on it.
const AT_SIDE: f64 = 1e-9;

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

    /// Where the ratio N / C is likely least, when coefficient `place` has the least of the ratios of coefficients: in each
    /// direction the vertex of the parabola whose coefficients are the three around it (exact for a parabola of any
    /// degree), as a share of the box.
    pub fn vertex(&self, slot: &[f64], place: usize) -> [f64; 2] {
        let (n, c, width) = (self.n(slot), self.c(slot), self.width());
        let ratio = |k: usize| if c.is_empty() { n[k] } else { n[k] / c[k] };
        let along = |degree: usize, i: usize, step: usize| {
            if degree == 0 {
                return 0.0;
            }
            let middle = i.clamp(1, degree - 1);
            let k = place + middle * step - i * step;
            let (a, b, c) = (ratio(k - step), ratio(k), ratio(k + step));
            let bend = (a - b) + (c - b);
            let offset = if bend > 0.0 { 0.5 * (a - c) / bend } else { i as f64 - middle as f64 };
            let share = (middle as f64 + offset - 0.5) / (degree - 1) as f64;
            // What rounding leaves of a vertex on a side would stay there where the parameter does not move the point.
            if share < AT_SIDE {
                0.0
            } else if share > 1.0 - AT_SIDE {
                1.0
            } else {
                share
            }
        };
        [along(self.degree.s, place / width, width), along(self.degree.t, place % width, 1)]
    }

    /// The ratio N / C at a place of the box, but for rounding.
    pub fn ratio_at(&self, slot: &[f64], [s, t]: [f64; 2]) -> f64 {
        let (mut row, mut column) = ([0.0; MOST], [0.0; MOST]);
        bernstein(self.degree.t, t, &mut row);
        bernstein(self.degree.s, s, &mut column);
        let width = self.width();
        let value = |array: &[f64]| {
            let mut sum = 0.0;
            for (strand, share) in array.chunks_exact(width).zip(&column) {
                let along: f64 = strand.iter().zip(&row).map(|(x, y)| x * y).sum();
                sum += share * along;
            }
            sum
        };
        let n = value(self.n(slot));
        if self.rational { n / value(self.c(slot)) } else { n }
    }

    /// Fills a slot from tensors A, -2 B (three) and, when rational, C, each [`padded`]: `N = A - 2 p.B + |p|^2 C`.
    pub fn multiply(&self, tensors: &[f64], p: Vector, square: f64, slot: &mut [f64]) {
        self.level.run(Multiply { grid: self, tensors, p, square, slot });
    }

    /// Fills a slot with coefficients of N and, when rational, of C.
    pub fn fill(&self, n: &[f64], c: &[f64], slot: &mut [f64]) {
        slot[LANES..LANES + self.count].copy_from_slice(n);
        if self.rational {
            slot[self.stride + LANES..][..self.count].copy_from_slice(c);
        }
    }

    /// Whether all `N > mu C`, for two values of `mu`.
    pub fn all_beyond(&self, slot: &[f64], mu: [f64; 2]) -> [bool; 2] {
        self.level.run(Beyond { grid: self, slot, mu })
    }

    /// Whether all `N > mu C` of what [`Self::multiply`] would make, and no C is less than `least_c`; nothing is stored.
    pub fn product_beyond(
        &self,
        tensors: &[f64],
        p: Vector,
        square: f64,
        mu: f64,
        least_c: f64,
    ) -> bool {
        self.level.run(ProductBeyond { grid: self, tensors, p, square, mu, least_c })
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

    /// The part of a slot before a place of direction 0 (s) or 1 (t), given as a share of the box; or the rest.
    pub fn cut(&self, direction: usize, place: f64, keeps_rest: bool, slot: &mut [f64]) {
        self.level.run(Part { grid: self, direction, place, keeps_rest, slot });
    }

    /// Coefficients of `|r|^2` and, when rational, `W^2` of a net of lanes `r`, `W`, which is used up.
    pub fn square(&self, net: &mut [[f64; 4]], slot: &mut [f64]) {
        self.level.run(Square { grid: self, net, slot });
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
    fn parts_are_those_of_halving() {
        for grid in grids() {
            for direction in [0, 1] {
                let whole = filled(&grid, 11);
                let (mut low, mut high) = (whole.clone(), vec![0.0; grid.slot()]);
                grid.halve(direction, &mut low, &mut high);
                let (mut part, mut rest) = (whole.clone(), whole);
                grid.cut(direction, 0.5, false, &mut part);
                grid.cut(direction, 0.5, true, &mut rest);
                assert_eq!((grid.n(&part), grid.c(&part)), (grid.n(&low), grid.c(&low)));
                assert_eq!((grid.n(&rest), grid.c(&rest)), (grid.n(&high), grid.c(&high)));
                // A quarter of a quarter away from the end is the end of what two halvings leave.
                grid.cut(direction, 0.25, true, &mut high);
                let place = if direction == 0 { [0.625 - 0.5, 0.0] } else { [0.0, 0.625 - 0.5] };
                let value = grid.ratio_at(&rest, place.map(|x| 2.0 * x));
                assert!((grid.ratio_at(&high, [0.0; 2]) - value).abs() < 1e-9);
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
        assert_eq!(bowl.convexity(grid.degree, [0.0; 3]), Some([2.0, 0.0, 2.0]));
        assert_eq!(bowl.convexity(grid.degree, [1.0; 3]), None);
        assert_eq!(saddle.convexity(grid.degree, [0.0; 3]), None);
        assert_eq!(twisted.convexity(grid.degree, [0.0; 3]), None);
    }
}
