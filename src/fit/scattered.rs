//! Least squares of scattered points by a tensor-product spline: normal equations with a narrow band.
//!
//! ```text
//!   (A^T A + e R) x = A^T b      R: second differences of neighbouring poles, for the places where there are no points
//!   x += (A^T A + e R)^-1 A^T (b - A x)    repeated: what the points determine no longer depends on e, nor on squared rounding
//! ```
//!
//! Poles are numbered with the direction that has fewer of them running fastest. Cost of a solution: O(poles * band^2), and
//! O(points * order^2) to set up.
//!
//! Reference: Golub, Van Loan, *Matrix Computations*, 4th ed., sections 4.3.5 (band Cholesky) and 6.1.4 (ridge regression).

use super::triangle::zeros;
use crate::basis;
use crate::bounds::{Vector, norm, sub};
use crate::curve::insertion::{collect, filled};
use crate::error::Error;
use crate::knots::Knots;

/// Weight of the second differences beside the mean diagonal entry.
const RIDGE: f64 = 1e-8;
/// Corrections of the solution, at most, and the change of the poles, relative to their size, at which they end.
const CORRECTIONS: usize = 4;
const SETTLED: f64 = 1e-11;
/// Sums that are formed side by side.
const LANES: usize = 4;

/// The basis functions of the points.
pub(super) struct Design {
    knots: [Knots; 2],
    /// Distance in memory between neighbours in u and in v.
    strides: [usize; 2],
    /// Per point: first pole in u and in v, functions in u, functions in v.
    spans: Vec<[u32; 2]>,
    values: Vec<f64>,
}

/// A symmetric matrix with a band, lower half: row i holds the entries of columns i - band to i.
struct Band {
    band: usize,
    rows: Vec<f64>,
}

impl Design {
    pub fn new(knots: [Knots; 2], parameters: &[[f64; 2]]) -> Result<Self, Error> {
        let counts = [knots[0].pole_count(), knots[1].pole_count()];
        let strides = if counts[1] <= counts[0] { [counts[1], 1] } else { [1, counts[0]] };
        let orders = [knots[0].degree() + 1, knots[1].degree() + 1];
        let mut spans = Vec::new();
        spans.try_reserve_exact(parameters.len()).map_err(|_| Error::OutOfMemory)?;
        let mut values = zeros(parameters.len(), orders[0] + orders[1])?;
        for (at, row) in parameters.iter().zip(values.chunks_exact_mut(orders[0] + orders[1])) {
            let (row_u, row_v) = row.split_at_mut(orders[0]);
            let span = [knots[0].span(at[0]), knots[1].span(at[1])];
            basis::values(&knots[0], span[0], at[0], row_u);
            basis::values(&knots[1], span[1], at[1], row_v);
            spans.push([0, 1].map(|k| (span[k] + 1 - orders[k]) as u32));
        }
        Ok(Self { knots, strides, spans, values })
    }

    fn counts(&self) -> [usize; 2] {
        [self.knots[0].pole_count(), self.knots[1].pole_count()]
    }

    /// First unknown, functions in u and in v, of every point.
    fn rows(&self) -> impl Iterator<Item = (usize, &[f64], &[f64])> {
        let orders = [self.knots[0].degree() + 1, self.knots[1].degree() + 1];
        let rows = self.values.chunks_exact(orders[0] + orders[1]);
        self.spans.iter().zip(rows).map(move |(span, row)| {
            let first = span[0] as usize * self.strides[0] + span[1] as usize * self.strides[1];
            (first, &row[..orders[0]], &row[orders[0]..])
        })
    }

    /// The points of unknowns, at every parameter.
    pub fn points<'a>(&'a self, unknowns: &'a [Vector]) -> impl Iterator<Item = Vector> + 'a {
        self.rows().map(move |(first, row_u, row_v)| {
            let mut at = [0.0; 3];
            for (i, a) in row_u.iter().enumerate() {
                let start = first + i * self.strides[0];
                let mut inner = [0.0; 3];
                for (j, b) in row_v.iter().enumerate() {
                    let pole = &unknowns[start + j * self.strides[1]];
                    (0..3).for_each(|x| inner[x] += b * pole[x]);
                }
                (0..3).for_each(|x| at[x] += a * inner[x]);
            }
            at
        })
    }

    /// `A^T r`.
    fn gathered(&self, residuals: impl Iterator<Item = Vector>, out: &mut [Vector]) {
        out.fill([0.0; 3]);
        for ((first, row_u, row_v), r) in self.rows().zip(residuals) {
            for (i, a) in row_u.iter().enumerate() {
                let start = first + i * self.strides[0];
                for (j, b) in row_v.iter().enumerate() {
                    let (pole, factor) = (&mut out[start + j * self.strides[1]], a * b);
                    (0..3).for_each(|x| pole[x] += factor * r[x]);
                }
            }
        }
    }

    /// `A^T A + e R`.
    fn normal(&self) -> Result<Band, Error> {
        let (counts, [su, sv]) = (self.counts(), self.strides);
        let reach = [0, 1].map(|k| self.knots[k].degree().max(2) * self.strides[k]);
        let count = counts[0] * counts[1];
        let band = (reach[0] + reach[1]).min(count - 1);
        let mut matrix = Band { band, rows: zeros(count, band + 1)? };
        self.add_products(&mut matrix)?;
        let trace: f64 = (0..count).map(|i| matrix.rows[i * (band + 1) + band]).sum();
        let weight = RIDGE * trace / count as f64;
        for i in 0..counts[0] {
            for j in 0..counts[1] {
                for (k, place) in [i, j].into_iter().enumerate() {
                    if place >= 2 {
                        matrix.add_difference(i * su + j * sv, self.strides[k], weight);
                    }
                }
            }
        }
        Ok(matrix)
    }

    /// `A^T A`: the products of the functions of points on one cell are summed up before they go to their places.
    fn add_products(&self, matrix: &mut Band) -> Result<(), Error> {
        let [su, sv] = self.strides;
        let order = [0, 1].map(|k| self.knots[k].degree() + 1);
        let (slow, fast, ss, sf) =
            if su >= sv { (order[0], order[1], su, sv) } else { (order[1], order[0], sv, su) };
        // In rising order of the unknowns.
        let place = |k: usize| k / fast * ss + k % fast * sf;
        let count = slow * fast;
        let width = count.next_multiple_of(LANES);
        let (mut own, mut sums) = (zeros(1, width)?, zeros(count, width)?);
        let mut cell = None;
        for (first, row_u, row_v) in self.rows() {
            if cell.is_some_and(|cell| cell != first) {
                matrix.take(cell.unwrap_or_default(), &place, &mut sums, width);
            }
            cell = Some(first);
            let (rows, along) = if su >= sv { (row_u, row_v) } else { (row_v, row_u) };
            for (own, a) in own.chunks_exact_mut(fast).zip(rows) {
                own.iter_mut().zip(along).for_each(|(own, b)| *own = a * b);
            }
            let (own, _) = own.as_chunks::<LANES>();
            for (k, row) in sums.chunks_exact_mut(width).enumerate() {
                let a = own[k / LANES][k % LANES];
                let (row, _) = row.as_chunks_mut::<LANES>();
                for (sum, b) in row[..=k / LANES].iter_mut().zip(own) {
                    *sum = [0, 1, 2, 3].map(|x| sum[x] + a * b[x]);
                }
            }
        }
        matrix.take(cell.unwrap_or_default(), &place, &mut sums, width);
        Ok(())
    }

    /// The poles (v runs fastest) nearest to `points`, relative to `center`, and how far the points are from their places.
    pub fn solve(
        &self,
        points: &[Vector],
        center: Vector,
    ) -> Result<(Vec<Vector>, Vec<f64>), Error> {
        let [count_u, count_v] = self.counts();
        let count = count_u * count_v;
        let factor = self.normal()?.factored().ok_or_else(|| {
            Error::InvalidArgument("parameters: they do not determine a surface".into())
        })?;
        let mut unknowns = filled(count, [0.0; 3])?;
        let mut step = filled(count, [0.0; 3])?;
        let mut before = 0.0;
        for correction in 0..CORRECTIONS {
            let from_center = points.iter().map(|point| sub(*point, center));
            if correction == 0 {
                self.gathered(from_center, &mut step);
            } else {
                let residuals = self.points(&unknowns).zip(from_center);
                self.gathered(residuals.map(|(at, point)| sub(point, at)), &mut step);
            }
            factor.solve(&mut step);
            let (mut moved, mut size) = (0.0f64, 0.0f64);
            for (x, dx) in unknowns.iter_mut().zip(&step) {
                for k in 0..3 {
                    x[k] += dx[k];
                    moved = moved.max(dx[k].abs());
                    size = size.max(x[k].abs());
                }
            }
            // The next one would be shorter by about as much again.
            if moved.is_nan() || moved * (moved / before).min(1.0) <= SETTLED * size {
                break;
            }
            before = moved;
        }
        let pole = |k: usize| {
            let [i, j] = [k / count_v, k % count_v];
            unknowns[i * self.strides[0] + j * self.strides[1]]
        };
        let away = self.points(&unknowns).zip(points);
        let away = away.map(|(at, point)| norm(sub(sub(*point, center), at)));
        Ok((collect(count, (0..count).map(pole))?, collect(points.len(), away)?))
    }
}

impl Band {
    /// Adds the lower half of `sums` at the places of a cell, and clears it.
    fn take(
        &mut self,
        cell: usize,
        place: &dyn Fn(usize) -> usize,
        sums: &mut [f64],
        width: usize,
    ) {
        for (k, row) in sums.chunks_exact_mut(width).enumerate() {
            let own = cell + place(k);
            let start = own * (self.band + 1) + self.band - own + cell;
            for (l, sum) in row[..=k].iter().enumerate() {
                self.rows[start + place(l)] += sum;
            }
            row.fill(0.0);
        }
    }

    /// Adds `weight` times the square of `x(end) - 2 x(end - stride) + x(end - 2 stride)`.
    fn add_difference(&mut self, end: usize, stride: usize, weight: f64) {
        let factors = [1.0, -2.0, 1.0];
        for (k, a) in factors.iter().enumerate() {
            for (l, b) in factors.iter().enumerate().skip(k) {
                let (row, column) = (end - k * stride, end - l * stride);
                self.rows[row * (self.band + 1) + self.band - row + column] += weight * a * b;
            }
        }
    }

    /// Cholesky's factor in place of the matrix; nothing when it is not positive definite.
    fn factored(mut self) -> Option<Self> {
        let (band, width) = (self.band, self.band + 1);
        for i in 0..self.rows.len() / width {
            let (above, own) = self.rows.split_at_mut(i * width);
            let own = &mut own[..width];
            let first = i.saturating_sub(band);
            for j in first..i {
                let other = &above[j * width..(j + 1) * width];
                let start = first.max(j.saturating_sub(band));
                let length = j - start;
                let a = &own[start + band - i..][..length];
                let b = &other[start + band - j..][..length];
                own[j + band - i] = (own[j + band - i] - dot(a, b)) / other[band];
            }
            let used = &own[first + band - i..band];
            let rest = own[band] - dot(used, used);
            if rest.is_nan() || rest <= 0.0 {
                return None;
            }
            own[band] = rest.sqrt();
        }
        Some(self)
    }

    /// Solves with the factor, in place.
    fn solve(&self, x: &mut [Vector]) {
        let (band, width) = (self.band, self.band + 1);
        for i in 0..x.len() {
            let first = i.saturating_sub(band);
            let row = &self.rows[i * width..(i + 1) * width];
            let mut sum = x[i];
            for (factor, known) in row[first + band - i..band].iter().zip(&x[first..i]) {
                (0..3).for_each(|k| sum[k] -= factor * known[k]);
            }
            x[i] = sum.map(|s| s / row[band]);
        }
        for i in (0..x.len()).rev() {
            let first = i.saturating_sub(band);
            let row = &self.rows[i * width..(i + 1) * width];
            x[i] = x[i].map(|s| s / row[band]);
            let known = x[i];
            for (factor, other) in row[first + band - i..band].iter().zip(&mut x[first..i]) {
                (0..3).for_each(|k| other[k] -= factor * known[k]);
            }
        }
    }
}

/// The scalar product, in eight sums.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (blocks_a, blocks_b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest = blocks_a.remainder().iter().zip(blocks_b.remainder());
    let rest: f64 = rest.map(|(x, y)| x * y).sum();
    for (x, y) in blocks_a.zip(blocks_b) {
        (0..8).for_each(|k| sums[k] += x[k] * y[k]);
    }
    sums.iter().sum::<f64>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_solves_its_matrix() {
        // Rows of a band matrix that is positive definite by its diagonal.
        let (count, band) = (30, 11);
        let mut rows = vec![0.0; count * (band + 1)];
        for i in 0..count {
            for k in 0..band {
                if i + k >= band {
                    rows[i * (band + 1) + k] = ((i * 7 + k * 3) as f64).sin();
                }
            }
            rows[i * (band + 1) + band] = 40.0;
        }
        let entry = |i: usize, j: usize| {
            let (i, j) = (i.max(j), i.min(j));
            if i - j <= band { rows[i * (band + 1) + band - (i - j)] } else { 0.0 }
        };
        let truth: Vec<Vector> = (0..count).map(|i| [i as f64, 1.0, -(i as f64).cos()]).collect();
        let product = |i: usize| {
            let mut sum = [0.0; 3];
            for (j, x) in truth.iter().enumerate() {
                (0..3).for_each(|k| sum[k] += entry(i, j) * x[k]);
            }
            sum
        };
        let mut x: Vec<Vector> = (0..count).map(product).collect();
        Band { band, rows: rows.clone() }.factored().unwrap().solve(&mut x);
        for (x, y) in x.iter().zip(&truth) {
            assert!((0..3).all(|k| (x[k] - y[k]).abs() < 1e-12));
        }
        rows[7 * (band + 1) + band] = -1.0;
        assert!(Band { band, rows }.factored().is_none());
    }
}
