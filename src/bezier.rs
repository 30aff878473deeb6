//! Bezier segments and patches: the pieces between the knots, and their Bernstein algebra.
//!
//! A piece stores homogeneous poles component by component (all x, then y, z and w), recentred so that
//! products of small numbers stay small. Everything here is a convex combination of positive weights, so
//! every coefficient carries a *relative* rounding error against the sum of its absolute terms:
//!
//! | step | bound in units of 2^-53, degree p per direction |
//! |---|---|
//! | extraction matrix entry | 5 p |
//! | extraction applied | p + 1 more |
//! | cut to an interval | 4 p per end (3 p for the high one) |
//! | basis value | 3 p |
//!
//! References: Borden et al., *Isogeometric finite element data structures based on Bezier extraction*, 2011
//! (the matrix); Farouki, Rajan, *Algorithms for polynomials in Bernstein form*, 1988 (products).
//! Limit: degrees up to 31; products of two such factors have 63 coefficients a direction, of three 94.

use crate::knots::{Knots, MAX_DEGREE};
use crate::simd::Lanes;

/// Most coefficients of a product of two factors in one direction.
pub const MAX_PRODUCT: usize = 2 * MAX_DEGREE + 1;

/// Most coefficients of a product of three factors in one direction.
pub const MAX_TRIPLE: usize = 3 * MAX_DEGREE + 1;

/// Binomial coefficients `C(n, k)` for `n <= 93`, as doubles (each within one rounding of the integer).
static BINOMIAL: [[f64; MAX_TRIPLE]; MAX_TRIPLE] = binomials();

const fn binomials() -> [[f64; MAX_TRIPLE]; MAX_TRIPLE] {
    let mut table = [[0.0; MAX_TRIPLE]; MAX_TRIPLE];
    let mut exact = [[0u128; MAX_TRIPLE]; MAX_TRIPLE];
    let mut n = 0;
    while n < MAX_TRIPLE {
        exact[n][0] = 1;
        table[n][0] = 1.0;
        let mut k = 1;
        while k <= n {
            exact[n][k] = exact[n - 1][k - 1] + exact[n - 1][k];
            table[n][k] = exact[n][k] as f64;
            k += 1;
        }
        n += 1;
    }
    table
}

/// `C(n, k)`.
pub fn binomial(n: usize, k: usize) -> f64 {
    BINOMIAL[n][k]
}

/// The extraction matrix of an interval inside one span: Bezier pole `i` = sum over `j` of
/// `matrix[i * (p + 1) + j]` times spline pole `span - p + j`. All entries are >= 0 and every row sums to one.
///
/// The rows are the blossoms with `p - i` arguments at the interval's start and `i` at its end.
pub fn extraction(knots: &Knots, span: usize, [start, end]: [f64; 2], matrix: &mut [f64]) {
    let p = knots.degree();
    for i in 0..=p {
        let row = &mut matrix[i * (p + 1)..(i + 1) * (p + 1)];
        blossom_row(knots, span, |level| if level < p - i { start } else { end }, row);
    }
}

/// Coefficients of the spline poles in the blossom with argument `argument(level)` on each level.
///
/// Runs de Boor's triangle backwards, from the apex to the poles, so that one pass gives the whole row.
fn blossom_row(knots: &Knots, span: usize, argument: impl Fn(usize) -> f64, row: &mut [f64]) {
    let p = knots.degree();
    let t = knots.values();
    row.fill(0.0);
    row[p] = 1.0;
    for level in (1..=p).rev() {
        let a = argument(level - 1);
        for j in level..=p {
            let (low, high) = (t[span - p + j], t[span + 1 + j - level]);
            let weight = row[j];
            if j > level {
                row[j - 1] += weight * ((high - a) / (high - low));
            } else {
                row[j - 1] = weight * ((high - a) / (high - low));
            }
            row[j] = weight * ((a - low) / (high - low));
        }
    }
}

/// Replaces the polynomial of `poles` (any number of interleaved strands) by its part on `[a, b]` of `[0, 1]`.
///
/// `poles[k * stride + c]` is coefficient `k` of strand `c`, for `c < strands`. Both factors of every step are formed
/// from differences that keep their relative accuracy: `(b - a) / b`, not `1 - a / b`.
pub fn cut(poles: &mut [f64], degree: usize, stride: usize, strands: usize, a: f64, b: f64) {
    if b < 1.0 {
        let (x, y) = (b, 1.0 - b);
        for level in 1..=degree {
            for k in (level..=degree).rev() {
                blend(poles, [(k - 1) * stride, k * stride], k * stride, strands, [y, x]);
            }
        }
    }
    if a > 0.0 {
        let (x, y) = (a / b, (b - a) / b);
        for level in 1..=degree {
            for k in 0..=degree - level {
                blend(poles, [k * stride, (k + 1) * stride], k * stride, strands, [y, x]);
            }
        }
    }
}

fn blend(poles: &mut [f64], from: [usize; 2], out: usize, strands: usize, [y, x]: [f64; 2]) {
    for c in 0..strands {
        poles[out + c] = poles[from[0] + c] * y + poles[from[1] + c] * x;
    }
}

/// Bernstein basis of degree `p` at `s` and its first two derivatives, each `p + 1` long and at most `LEN`, from the powers
/// of `s` and `1 - s`: O(p), and no step of a row waits for the one before.
#[inline(always)]
pub fn basis<V: Lanes<W>, const W: usize, const LEN: usize>(
    p: usize,
    s: V,
    values: &mut [V],
    first: &mut [V],
    second: &mut [V],
) {
    let (zero, one, two) = (V::splat(0.0), V::splat(1.0), V::splat(2.0));
    let (mut up, mut down) = ([one; LEN], [one; LEN]);
    // The power i of 1 - s is number LEN - 1 - i: a row then runs through both tables forwards.
    for i in 1..=p {
        up[i] = up[i - 1] * s;
        down[LEN - 1 - i] = down[LEN - i] * (one - s);
    }
    row(p, &up, &down[LEN - 1 - p..], values);
    let (n, m) = (V::splat(p as f64), V::splat(p as f64 * (p as f64 - 1.0)));
    let mut lower = [zero; LEN];
    if p > 0 {
        row(p - 1, &up, &down[LEN - p..], &mut lower);
    }
    first[0] = V::splat(-(p as f64)) * lower[0];
    for i in 1..=p {
        first[i] = n * (lower[i - 1] - lower[i]);
    }
    lower = [zero; LEN];
    if p > 1 {
        row(p - 2, &up, &down[LEN + 1 - p..], &mut lower);
    }
    second[0] = m * lower[0];
    if p > 0 {
        second[1] = m * (lower[1] - two * lower[0]);
    }
    for i in 2..=p {
        second[i] = m * (lower[i - 2] - two * lower[i - 1] + lower[i]);
    }
}

/// The Bernstein basis of degree `n` from rising and falling powers.
#[inline(always)]
fn row<V: Lanes<W>, const W: usize>(n: usize, up: &[V], down: &[V], out: &mut [V]) {
    let (binomial, up, down, out) =
        (&BINOMIAL[n][..n + 1], &up[..n + 1], &down[..n + 1], &mut out[..n + 1]);
    for i in 0..n + 1 {
        out[i] = V::splat(binomial[i]) * up[i] * down[i];
    }
}

/// Weights that turn a product of Bernstein forms into a plain convolution:
/// `scale[i] = C(n, i)` before, `1 / C(n + m, k)` after.
pub fn scale_up(coefficients: &mut [f64], n: usize, stride: usize, strands: usize) {
    for i in 0..=n {
        let b = BINOMIAL[n][i];
        for c in 0..strands {
            coefficients[i * stride + c] *= b;
        }
    }
}

/// The inverse of [`scale_up`].
pub fn scale_down(coefficients: &mut [f64], n: usize, stride: usize, strands: usize) {
    for i in 0..=n {
        let b = BINOMIAL[n][i];
        for c in 0..strands {
            coefficients[i * stride + c] /= b;
        }
    }
}

/// Size of a two-direction coefficient array: degree `m` in s (rows) and `n` in t (fastest).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Bidegree {
    /// Degree in s.
    pub s: usize,
    /// Degree in t.
    pub t: usize,
}

impl Bidegree {
    /// Number of coefficients.
    pub fn count(self) -> usize {
        (self.s + 1) * (self.t + 1)
    }

    /// The bidegree of the product with `other`.
    pub fn times(self, other: Self) -> Self {
        Self { s: self.s + other.s, t: self.t + other.t }
    }

    /// One less in direction 0 (s) or 1 (t): the bidegree of a derivative.
    pub fn lowered(self, direction: usize) -> Self {
        if direction == 0 { Self { s: self.s - 1, ..self } } else { Self { t: self.t - 1, ..self } }
    }
}

/// Multiplies both directions of a coefficient array by their binomials (see [`scale_up`]).
pub fn scale_up_2d(coefficients: &mut [f64], degree: Bidegree) {
    let width = degree.t + 1;
    for i in 0..=degree.s {
        let row = &mut coefficients[i * width..(i + 1) * width];
        let b = BINOMIAL[degree.s][i];
        for (j, x) in row.iter_mut().enumerate() {
            *x *= b * BINOMIAL[degree.t][j];
        }
    }
}

/// The inverse of [`scale_up_2d`].
pub fn scale_down_2d(coefficients: &mut [f64], degree: Bidegree) {
    let width = degree.t + 1;
    for i in 0..=degree.s {
        let row = &mut coefficients[i * width..(i + 1) * width];
        let b = BINOMIAL[degree.s][i];
        for (j, x) in row.iter_mut().enumerate() {
            *x /= b * BINOMIAL[degree.t][j];
        }
    }
}

/// `out += sign * f * g` for scaled coefficient arrays (see [`scale_up_2d`]); `out` has the summed bidegree.
///
/// Cost: `f.count() * g.count()` multiplications. The sum in one output coefficient has at most
/// `min(f.count(), g.count())` terms.
pub fn convolve(f: &[f64], df: Bidegree, g: &[f64], dg: Bidegree, sign: f64, out: &mut [f64]) {
    let (wf, wg, wo) = (df.t + 1, dg.t + 1, df.t + dg.t + 1);
    for i in 0..=df.s {
        for k in 0..=dg.s {
            let g_row = &g[k * wg..(k + 1) * wg];
            let out_row = &mut out[(i + k) * wo..(i + k + 1) * wo];
            for j in 0..wf {
                let x = sign * f[i * wf + j];
                for (o, y) in out_row[j..j + wg].iter_mut().zip(g_row) {
                    *o += x * y;
                }
            }
        }
    }
}

/// `out += sign * f * f`, with the symmetric terms taken once: half the cost of [`convolve`].
pub fn convolve_square(f: &[f64], degree: Bidegree, sign: f64, out: &mut [f64]) {
    let (w, wo) = (degree.t + 1, 2 * degree.t + 1);
    for i in 0..=degree.s {
        let row = &f[i * w..(i + 1) * w];
        for k in i..=degree.s {
            let factor = if k == i { sign } else { 2.0 * sign };
            let other = &f[k * w..(k + 1) * w];
            let out_row = &mut out[(i + k) * wo..(i + k + 1) * wo];
            for (j, x) in row.iter().enumerate() {
                let x = factor * x;
                for (o, y) in out_row[j..j + w].iter_mut().zip(other) {
                    *o += x * y;
                }
            }
        }
    }
}

/// As [`cut`] in both directions.
pub fn cut_2d(coefficients: &mut [f64], degree: Bidegree, s: [f64; 2], t: [f64; 2]) {
    let width = degree.t + 1;
    cut(coefficients, degree.s, width, width, s[0], s[1]);
    for row in coefficients.chunks_exact_mut(width) {
        cut(row, degree.t, 1, 1, t[0], t[1]);
    }
}

/// Coefficients of the isocurve at `x` of s (when `across_s`) or of t; `work` holds the array and is used up.
pub fn isocurve(work: &mut [f64], degree: Bidegree, across_s: bool, x: f64, out: &mut [f64]) {
    let width = degree.t + 1;
    let end = if x > 0.0 { x } else { 1.0 };
    if across_s {
        cut(work, degree.s, width, width, 0.0, end);
        let row = if x > 0.0 { degree.s } else { 0 };
        out.copy_from_slice(&work[row * width..(row + 1) * width]);
    } else {
        for (row, coefficient) in work.chunks_exact_mut(width).zip(out) {
            cut(row, degree.t, 1, 1, 0.0, end);
            *coefficient = row[if x > 0.0 { degree.t } else { 0 }];
        }
    }
}

/// Splits a coefficient array at the middle of s: `low` becomes the part `[0, 1/2]`, `high` the rest.
pub fn halve_s(low: &mut [f64], high: &mut [f64], degree: Bidegree) {
    let w = degree.t + 1;
    let n = degree.s;
    for k in 0..n {
        high[(n - k) * w..(n - k + 1) * w].copy_from_slice(&low[n * w..(n + 1) * w]);
        // After this pass row i holds level k + 1, for i > k.
        for i in (k + 1..=n).rev() {
            let (before, row) = low.split_at_mut(i * w);
            for (x, y) in row[..w].iter_mut().zip(&before[(i - 1) * w..]) {
                *x = 0.5 * (*x + y);
            }
        }
    }
    high[..w].copy_from_slice(&low[n * w..(n + 1) * w]);
}

/// Splits a coefficient array at the middle of t: `low` becomes the part `[0, 1/2]`, `high` the rest.
pub fn halve_t(low: &mut [f64], high: &mut [f64], degree: Bidegree) {
    let n = degree.t;
    for (row, out) in low.chunks_exact_mut(n + 1).zip(high.chunks_exact_mut(n + 1)) {
        for k in 0..n {
            out[n - k] = row[n];
            for i in (k + 1..=n).rev() {
                row[i] = 0.5 * (row[i] + row[i - 1]);
            }
        }
        out[0] = row[n];
    }
}

/// Appends the coefficients of the derivative in direction 0 (s) or 1 (t) to `out`.
pub fn derivative(f: &[f64], degree: Bidegree, direction: usize, out: &mut Vec<f64>) {
    let width = degree.t + 1;
    if direction == 0 {
        out.extend(f.iter().zip(&f[width..]).map(|(a, b)| degree.s as f64 * (b - a)));
        return;
    }
    for row in f.chunks_exact(width) {
        out.extend(row.windows(2).map(|pair| degree.t as f64 * (pair[1] - pair[0])));
    }
}

/// The same polynomial with the degree one higher in direction 0 (s) or 1 (t).
pub fn elevated(f: &[f64], degree: Bidegree, direction: usize) -> Vec<f64> {
    let (rows, width) = (degree.s + 1, degree.t + 1);
    let mix = |n: usize, k: usize, before: f64, here: f64| {
        let share = k as f64 / n as f64;
        share * before + (n - k) as f64 / n as f64 * here
    };
    if direction == 0 {
        let at = |i: usize, j: usize| if i < rows { f[i * width + j] } else { 0.0 };
        let entry = |i: usize, j: usize| mix(rows, i, at(i.max(1) - 1, j), at(i, j));
        return (0..(rows + 1) * width).map(|k| entry(k / width, k % width)).collect();
    }
    let at = |i: usize, j: usize| if j < width { f[i * width + j] } else { 0.0 };
    let entry = |i: usize, j: usize| mix(width, j, at(i, j.max(1) - 1), at(i, j));
    (0..rows * (width + 1)).map(|k| entry(k / (width + 1), k % (width + 1))).collect()
}

/// `f / x` where x is s, 1 - s, t or 1 - t (`side` as in `index::side`): the coefficients on that side vanish and are
/// left out. Errors of coefficients grow by the degree at most.
pub fn divided_by_side(f: &[f64], degree: Bidegree, side: usize) -> Vec<f64> {
    let (rows, width) = (degree.s + 1, degree.t + 1);
    let (n, along_s) = if side < 2 { (degree.s, true) } else { (degree.t, false) };
    let factor =
        |k: usize| n as f64 / if side.is_multiple_of(2) { k as f64 } else { (n - k) as f64 };
    let left_out = if side.is_multiple_of(2) { 0 } else { n };
    let keep = |k: usize| k != left_out;
    let mut out = Vec::with_capacity(f.len());
    for i in 0..rows {
        for j in 0..width {
            let k = if along_s { i } else { j };
            if keep(k) {
                out.push(f[i * width + j] * factor(k));
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bernstein(coefficients: &[f64], s: f64) -> f64 {
        let mut c = coefficients.to_vec();
        cut(&mut c, coefficients.len() - 1, 1, 1, 0.0, s.max(1e-300));
        c[coefficients.len() - 1]
    }

    #[test]
    fn extraction_rows_sum_to_one_and_give_the_spline() {
        let knots = Knots::new(&[-1., 0., 0., 0.5, 2., 2., 3., 4., 4.5], 3, 5).unwrap();
        for span in knots.spans() {
            let mut matrix = [0.0; 16];
            let (a, b) = (knots.values()[span], knots.values()[span + 1]);
            extraction(&knots, span, [a, b], &mut matrix);
            for row in matrix.chunks(4) {
                assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-15);
                assert!(row.iter().all(|&x| x >= 0.0));
            }
            for s in [0.0, 0.25, 0.7] {
                let mut n = [0.0; 4];
                crate::basis::values(&knots, span, a + s * (b - a), &mut n);
                for (j, expected) in n.iter().enumerate() {
                    let column: Vec<f64> = (0..4).map(|i| matrix[i * 4 + j]).collect();
                    assert!((bernstein(&column, s) - expected).abs() < 1e-14, "span {span} s {s}");
                }
            }
        }
    }

    #[test]
    fn a_cut_is_the_polynomial_on_the_interval() {
        let f = [1.0, -2.0, 0.5, 3.0, 0.25];
        let mut part = f;
        cut(&mut part, 4, 1, 1, 0.25, 0.75);
        for k in 0..=8 {
            let x = k as f64 / 8.0;
            assert!((bernstein(&part, x) - bernstein(&f, 0.25 + 0.5 * x)).abs() < 1e-14);
        }
    }

    #[test]
    fn a_cut_near_the_end_keeps_the_digits_of_small_weights() {
        // Weights 1 and 1e-12 on [1 - 2^-29, 1 - 2^-30]: w(s) = (1 - s) + 1e-12 s, formed without cancellation.
        let (left, right) = (2f64.powi(-29), 2f64.powi(-30));
        let mut weights = [1.0, 1e-12];
        cut(&mut weights, 1, 1, 1, 1.0 - left, 1.0 - right);
        for (w, rest) in weights.into_iter().zip([left, right]) {
            let expected = rest + 1e-12 * (1.0 - rest);
            assert!((w - expected).abs() <= 4.0 * f64::EPSILON * expected, "{w:e} {expected:e}");
        }
    }

    #[test]
    fn basis_derivatives_agree_with_differences() {
        for p in 1..=9 {
            let h = 1e-5;
            let at = |s: f64| {
                let (mut v, mut d, mut e) = ([0.0; 10], [0.0; 10], [0.0; 10]);
                basis::<f64, 1, 10>(p, s, &mut v, &mut d, &mut e);
                (v, d, e)
            };
            let (low, mid, high) = (at(0.3 - h), at(0.3), at(0.3 + h));
            assert!((mid.0.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            for i in 0..=p {
                let first = (high.0[i] - low.0[i]) / (2.0 * h);
                let second = (high.0[i] - 2.0 * mid.0[i] + low.0[i]) / (h * h);
                assert!((first - mid.1[i]).abs() < 1e-7, "p {p} i {i}");
                assert!((second - mid.2[i]).abs() < 2e-4, "p {p} i {i}");
            }
        }
    }

    #[test]
    fn elevation_keeps_the_polynomial_and_division_undoes_a_factor() {
        let degree = Bidegree { s: 2, t: 1 };
        let f = [1.0, -2.0, 0.5, 3.0, 0.25, 4.0];
        let eval = |c: &[f64], d: Bidegree, s: f64, t: f64| {
            let rows: Vec<f64> = c.chunks(d.t + 1).map(|row| bernstein(row, t)).collect();
            bernstein(&rows, s)
        };
        for (s, t) in [(0.2, 0.9), (0.7, 0.4)] {
            for (direction, high) in [(0, Bidegree { s: 3, t: 1 }), (1, Bidegree { s: 2, t: 2 })] {
                let g = elevated(&f, degree, direction);
                assert!((eval(&g, high, s, t) - eval(&f, degree, s, t)).abs() < 1e-14);
            }
        }
        // s times f, t times f and so on, each divided again.
        for side in 0..4 {
            let high = if side < 2 { Bidegree { s: 3, t: 1 } } else { Bidegree { s: 2, t: 2 } };
            let x: [f64; 2] = if side % 2 == 0 { [0.0, 1.0] } else { [1.0, 0.0] };
            let one = if side < 2 { Bidegree { s: 1, t: 0 } } else { Bidegree { s: 0, t: 1 } };
            let (mut a, mut product) = (f.to_vec(), vec![0.0; high.count()]);
            scale_up_2d(&mut a, degree);
            convolve(&a, degree, &x, one, 1.0, &mut product);
            scale_down_2d(&mut product, high);
            let back = divided_by_side(&product, high, side);
            assert!(back.iter().zip(&f).all(|(a, b)| (a - b).abs() < 1e-14), "{side} {back:?}");
        }
    }

    #[test]
    fn a_square_is_the_product_and_halves_are_its_parts() {
        let degree = Bidegree { s: 2, t: 3 };
        let f: Vec<f64> = (0..12).map(|k| ((k * 7 + 3) % 11) as f64 - 5.0).collect();
        let mut scaled = f.clone();
        scale_up_2d(&mut scaled, degree);
        let twice = degree.times(degree);
        let (mut a, mut b) = (vec![0.0; twice.count()], vec![0.0; twice.count()]);
        convolve(&scaled, degree, &scaled, degree, 1.0, &mut a);
        convolve_square(&scaled, degree, 1.0, &mut b);
        scale_down_2d(&mut a, twice);
        scale_down_2d(&mut b, twice);
        let eval = |c: &[f64], d: Bidegree, s: f64, t: f64| {
            let rows: Vec<f64> = c.chunks(d.t + 1).map(|row| bernstein(row, t)).collect();
            bernstein(&rows, s)
        };
        let mut high = a.clone();
        let mut low = a.clone();
        halve_s(&mut low, &mut high, twice);
        let (mut low_t, mut high_t) = (high.clone(), high.clone());
        halve_t(&mut low_t, &mut high_t, twice);
        for (s, t) in [(0.0, 1.0), (0.3, 0.6), (0.9, 0.2)] {
            let expected = eval(&f, degree, s, t).powi(2);
            assert!((eval(&a, twice, s, t) - expected).abs() < 1e-12);
            assert!((eval(&b, twice, s, t) - expected).abs() < 1e-12);
            assert!((eval(&low, twice, s, t) - eval(&a, twice, s / 2.0, t)).abs() < 1e-12);
            let quarter = eval(&high_t, twice, s, t);
            assert!((quarter - eval(&a, twice, 0.5 + s / 2.0, 0.5 + t / 2.0)).abs() < 1e-12);
        }
    }
}
