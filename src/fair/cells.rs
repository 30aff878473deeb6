//! Rows: linear forms in the poles, such as a derivative at a parameter, and energies made of them.

use crate::bounds::{Vector, add, dot, scaled};
use crate::curve::insertion::{append, append_all, filled};
use crate::error::Error;

/// Rows over the same poles, each `poles.len()` long.
#[derive(Clone, Copy, Debug)]
pub struct Cell<'a> {
    /// Indices of the poles.
    pub poles: &'a [usize],
    /// The coefficients, row after row.
    pub rows: &'a [f64],
}

/// A sum of squared lengths of rows applied to poles: cells in one list, so that memory is asked for, not piece by piece.
#[derive(Debug, Default)]
pub struct Functional {
    /// Where the poles and the coefficients of each cell end.
    ends: Vec<[usize; 2]>,
    poles: Vec<usize>,
    rows: Vec<f64>,
}

impl<'a> Cell<'a> {
    /// Its rows.
    pub fn each(&self) -> impl Iterator<Item = &'a [f64]> + use<'a> {
        self.rows.chunks_exact(self.poles.len())
    }

    /// Row `k`.
    pub fn row(&self, k: usize) -> &'a [f64] {
        let n = self.poles.len();
        &self.rows[k * n..(k + 1) * n]
    }

    /// One row applied to poles.
    pub fn apply(&self, row: &[f64], poles: &[Vector]) -> Vector {
        let mut sum = [0.0; 3];
        for (x, &i) in row.iter().zip(self.poles) {
            for k in 0..3 {
                sum[k] += x * poles[i][k];
            }
        }
        sum
    }

    /// Sum of the squared lengths of its rows applied to poles.
    pub fn value(&self, poles: &[Vector]) -> f64 {
        let length = |row: &[f64]| {
            let x = self.apply(row, poles);
            dot(x, x)
        };
        self.each().map(length).sum()
    }
}

impl Functional {
    /// One cell more.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn push(&mut self, poles: impl Iterator<Item = usize>, rows: &[f64]) -> Result<(), Error> {
        for pole in poles {
            append(&mut self.poles, pole)?;
        }
        append_all(&mut self.rows, rows)?;
        append(&mut self.ends, [self.poles.len(), self.rows.len()])
    }

    /// The cells of `other` too, their rows times `factor`.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn push_all(&mut self, other: &Self, factor: f64) -> Result<(), Error> {
        for cell in other.cells() {
            let start = self.rows.len();
            self.push(cell.poles.iter().copied(), cell.rows)?;
            self.rows[start..].iter_mut().for_each(|x| *x *= factor);
        }
        Ok(())
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Cell `k`.
    pub fn cell(&self, k: usize) -> Cell<'_> {
        let [pole, row] = if k == 0 { [0; 2] } else { self.ends[k - 1] };
        let end = self.ends[k];
        Cell { poles: &self.poles[pole..end[0]], rows: &self.rows[row..end[1]] }
    }

    /// All cells.
    pub fn cells(&self) -> impl Iterator<Item = Cell<'_>> {
        (0..self.len()).map(|k| self.cell(k))
    }

    /// Its value, never negative.
    pub fn value(&self, poles: &[Vector]) -> f64 {
        self.cells().map(|cell| cell.value(poles)).sum()
    }

    /// A copy.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn copied(&self) -> Result<Self, Error> {
        let mut copy = Self::default();
        copy.push_all(self, 1.0)?;
        Ok(copy)
    }

    /// The sum with `share` times another one.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn with(&self, share: f64, other: &Self) -> Result<Self, Error> {
        let mut sum = self.copied()?;
        sum.push_all(other, share.sqrt())?;
        Ok(sum)
    }

    /// Adds half its gradient.
    pub fn add_gradient(&self, poles: &[Vector], gradient: &mut [Vector]) {
        for cell in self.cells() {
            for row in cell.each() {
                let x = cell.apply(row, poles);
                for (r, &i) in row.iter().zip(cell.poles) {
                    gradient[i] = add(gradient[i], scaled(x, *r));
                }
            }
        }
    }

    /// Half its gradient.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn gradient(&self, poles: &[Vector]) -> Result<Vec<Vector>, Error> {
        let mut gradient = filled(poles.len(), [0.0; 3])?;
        self.add_gradient(poles, &mut gradient);
        Ok(gradient)
    }

    /// The cells that each of `count` poles is in: where they begin, and their numbers.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn touching(&self, count: usize) -> Result<Lists, Error> {
        let pairs = || {
            self.cells().enumerate().flat_map(|(k, cell)| cell.poles.iter().map(move |&i| (i, k)))
        };
        Lists::new(count, pairs)
    }
}

/// A list of numbers for each of several things.
pub struct Lists {
    starts: Vec<usize>,
    numbers: Vec<usize>,
}

impl Lists {
    /// From pairs: thing, number.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new<I: Iterator<Item = (usize, usize)>>(
        count: usize,
        pairs: impl Fn() -> I,
    ) -> Result<Self, Error> {
        // Two entries ahead, so that filling leaves the starts where they belong.
        let mut starts = filled(count + 2, 0)?;
        pairs().for_each(|(i, _)| starts[i + 2] += 1);
        (2..count + 2).for_each(|i| starts[i] += starts[i - 1]);
        let mut numbers = filled(starts[count + 1], 0)?;
        for (i, k) in pairs() {
            numbers[starts[i + 1]] = k;
            starts[i + 1] += 1;
        }
        Ok(Self { starts, numbers })
    }

    /// The numbers of one thing, in the order of the pairs.
    pub fn of(&self, i: usize) -> &[usize] {
        &self.numbers[self.starts[i]..self.starts[i + 1]]
    }
}

/// Replaces rows by at most `width` ones with the same sum of squares for all poles: the triangle of Householder's reflections. Gives
/// how many numbers are left.
///
/// Reference: Golub, Van Loan, *Matrix Computations*, 4th ed., section 5.2.1.
pub fn condense(rows: &mut [f64], width: usize) -> usize {
    let count = rows.len() / width;
    let most = rows.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    if count <= width || most == 0.0 || !most.is_finite() {
        return rows.len();
    }
    rows.iter_mut().for_each(|x| *x /= most);
    for k in 0..width {
        let column = |rows: &[f64], j: usize, from: usize| -> f64 {
            (from..count).map(|i| rows[i * width + k] * rows[i * width + j]).sum()
        };
        let size = column(rows, k, k).sqrt();
        if size == 0.0 {
            continue;
        }
        let head = rows[k * width + k];
        let end = if head > 0.0 { -size } else { size };
        rows[k * width + k] = head - end;
        // Half the squared length of the mirror's normal.
        let half = size * (size + head.abs());
        for j in k + 1..width {
            let share = column(rows, j, k) / half;
            (k..count).for_each(|i| rows[i * width + j] -= share * rows[i * width + k]);
        }
        rows[k * width + k] = end;
        (k + 1..count).for_each(|i| rows[i * width + k] = 0.0);
    }
    rows[..width * width].iter_mut().for_each(|x| *x *= most);
    width * width
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fewer_rows_have_the_same_energy() {
        for (count, scale) in [(3, 1.0), (4, 1.0), (9, 1e-160), (30, 1e150)] {
            let mut rows: Vec<f64> =
                (0..4 * count).map(|i| scale * ((i * i) as f64).sin()).collect();
            let cell =
                |rows: &[f64], poles: &[Vector]| Cell { poles: &[0, 1, 2, 3], rows }.value(poles);
            let poles: Vec<Vector> =
                (0..4).map(|i| [(i as f64).cos(), i as f64, 1.0].map(|x| x / scale)).collect();
            let before = cell(&rows, &poles);
            let left = condense(&mut rows, 4);
            assert!(left <= 16.max(4 * count.min(4)));
            let after = cell(&rows[..left], &poles);
            assert!((before - after).abs() <= 1e-13 * before, "{count} {before} {after}");
        }
    }
}
