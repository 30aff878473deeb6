//! Banded least squares by Givens rotations, one equation after the other.
//!
//! An equation touches `band` neighbouring unknowns. Rotations with the rows of the triangle above it take its entries
//! away from the left; what is left of its right side is the part that no solution meets.
//!
//! ```text
//!   triangle  x x x . . .          equations in the order of their first unknown need `band`
//!             . x x x . .          rotations each; in another order they run on to the end
//!             . . x x x .
//!   equation  . . y y y .
//! ```
//!
//! Nothing is squared: the digits lost are those of the equations, not of their normal equations.
//!
//! Reference: Dierckx, *Curve and Surface Fitting with Splines*, 1993, section 4.1.2.

use crate::error::Error;
use crate::portable::SameDigits;

/// A diagonal entry below this part of its column says that the unknown is not determined.
const RANK_TOLERANCE: f64 = 1e-14;

/// The triangle of the equations so far, each with `width` right sides.
pub(super) struct Triangle {
    band: usize,
    width: usize,
    rows: Vec<f64>,
    right: Vec<f64>,
}

/// A list of zeros, or the honest answer that there is no room.
pub(super) fn zeros(rows: usize, columns: usize) -> Result<Vec<f64>, Error> {
    let count = rows.checked_mul(columns).ok_or(Error::OutOfMemory)?;
    let mut list = Vec::new();
    list.try_reserve_exact(count).map_err(|_| Error::OutOfMemory)?;
    list.resize(count, 0.0);
    Ok(list)
}

impl Triangle {
    pub fn new(unknowns: usize, band: usize, width: usize) -> Result<Self, Error> {
        Ok(Self { band, width, rows: zeros(unknowns, band)?, right: zeros(unknowns, width)? })
    }

    /// Rotates one equation in: `row` has the factors of the unknowns from `first` on, zero beyond the last unknown.
    /// Afterwards `row` is zero and `right` holds what remains.
    pub fn add(&mut self, first: usize, row: &mut [f64], right: &mut [f64]) {
        let band = self.band;
        for i in first..self.rows.len() / band {
            let factor = row[0];
            if factor != 0.0 {
                let own = &mut self.rows[i * band..(i + 1) * band];
                let was_empty = own[0] == 0.0;
                let length = own[0].hypotenuse(factor);
                let turn = (own[0] / length, factor / length);
                rotate(own, row, turn);
                rotate(&mut self.right[i * self.width..(i + 1) * self.width], right, turn);
                if was_empty && row.iter().all(|x| *x == 0.0) {
                    return;
                }
            }
            row.copy_within(1.., 0);
            row[band - 1] = 0.0;
            if row.iter().all(|x| *x == 0.0) {
                return;
            }
        }
    }

    /// The unknowns, `width` values each, or the first that the equations leave open.
    pub fn solve(mut self) -> Result<Vec<f64>, usize> {
        let (band, width) = (self.band, self.width);
        let count = self.rows.len() / band;
        for i in 0..count {
            let column = (0..band.min(i + 1)).map(|k| self.rows[(i - k) * band + k]);
            let length = column.fold(0.0, |sum, x| sum + x * x).sqrt();
            let diagonal = self.rows[i * band].abs();
            if diagonal.is_nan() || diagonal <= RANK_TOLERANCE * length || length == 0.0 {
                return Err(i);
            }
        }
        for i in (0..count).rev() {
            let (head, tail) = self.right.split_at_mut((i + 1) * width);
            let own = &mut head[i * width..];
            for k in 1..band.min(count - i) {
                let factor = self.rows[i * band + k];
                let other = &tail[(k - 1) * width..k * width];
                own.iter_mut().zip(other).for_each(|(x, y)| *x -= factor * y);
            }
            let diagonal = self.rows[i * band];
            own.iter_mut().for_each(|x| *x /= diagonal);
        }
        Ok(self.right)
    }
}

/// Turns the pair of lists by the angle of which cosine and sine are given.
fn rotate(a: &mut [f64], b: &mut [f64], (cosine, sine): (f64, f64)) {
    for (x, y) in a.iter_mut().zip(b) {
        (*x, *y) = (cosine * *x + sine * *y, cosine * *y - sine * *x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three unknowns, band 2, more equations than unknowns, in a bad order.
    #[test]
    fn the_residual_is_orthogonal_to_every_column() {
        let equations = [
            (2, [3.0, 0.0], 1.0),
            (0, [1.0, 2.0], -1.0),
            (1, [4.0, -1.0], 2.0),
            (0, [-2.0, 1.0], 0.5),
            (1, [1.0, 1.0], 3.0),
        ];
        let mut triangle = Triangle::new(3, 2, 1).unwrap();
        for (first, row, right) in equations {
            triangle.add(first, &mut row.clone(), &mut [right]);
        }
        let x = triangle.solve().unwrap();
        let residual = |(first, row, right): (usize, [f64; 2], f64)| {
            row[0] * x[first] + if first < 2 { row[1] * x[first + 1] } else { 0.0 } - right
        };
        for column in 0..3 {
            let entry = |(first, row, _): (usize, [f64; 2], f64)| match column {
                c if c == first => row[0],
                c if c == first + 1 => row[1],
                _ => 0.0,
            };
            let product: f64 = equations.iter().map(|&e| entry(e) * residual(e)).sum();
            assert!(product.abs() < 1e-13, "column {column}: {product}");
        }
    }

    #[test]
    fn an_unknown_that_is_not_determined_is_named() {
        let mut triangle = Triangle::new(3, 2, 1).unwrap();
        triangle.add(0, &mut [1.0, 1.0], &mut [1.0]);
        triangle.add(0, &mut [2.0, 2.0], &mut [1.0]);
        triangle.add(2, &mut [1.0, 0.0], &mut [1.0]);
        assert_eq!(triangle.solve(), Err(1));
    }
}
