//! Symmetric positive definite equations with an envelope: each row is stored from its first entry to the diagonal.
//!
//! Splines couple near poles only, so rows are short; those of a closed spline's last poles are long. Cholesky's method
//! fills the envelope and nothing else. No crate yet: up to 50 x 50 poles the natural order of the poles is as fast as faer, which
//! brings 56 crates; at 100 x 100 faer factors twice as fast, at 200 x 200 seven times (docs/fairing.md).
//!
//! Reference: George, Liu, *Computer Solution of Large Sparse Positive Definite Systems*, 1981, chapter 4.

use crate::error::Error;

/// The lower triangle of a symmetric matrix.
pub struct Envelope {
    /// First column of each row.
    first: Vec<usize>,
    /// Where each row begins; one more at the end.
    start: Vec<usize>,
    entries: Vec<f64>,
}

impl Envelope {
    /// Zeros, with room from column `first[i]` in row i.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new(first: Vec<usize>) -> Result<Self, Error> {
        let mut start = Vec::with_capacity(first.len() + 1);
        let mut total = 0usize;
        for (i, column) in first.iter().enumerate() {
            start.push(total);
            total = total.checked_add(i + 1 - column).ok_or(Error::OutOfMemory)?;
        }
        start.push(total);
        let mut entries = Vec::new();
        entries.try_reserve_exact(total).map_err(|_| Error::OutOfMemory)?;
        entries.resize(total, 0.0);
        Ok(Self { first, start, entries })
    }

    /// Adds to the entry (i, j) = (j, i), which lies in the envelope.
    pub fn add(&mut self, i: usize, j: usize, x: f64) {
        let (i, j) = if i >= j { (i, j) } else { (j, i) };
        self.entries[self.start[i] + j - self.first[i]] += x;
    }

    /// An entry of the diagonal.
    pub fn diagonal(&self, i: usize) -> f64 {
        self.entries[self.start[i + 1] - 1]
    }

    /// A copy.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn copied(&self) -> Result<Self, Error> {
        let mut copy = Self::new(self.first.clone())?;
        copy.entries.copy_from_slice(&self.entries);
        Ok(copy)
    }

    /// Adds `share` times the mean of the diagonal to the diagonal.
    pub fn add_ridge(&mut self, share: f64) {
        let n = self.first.len();
        let mean = (0..n).map(|i| self.diagonal(i)).sum::<f64>() / n as f64;
        for i in 0..n {
            self.entries[self.start[i + 1] - 1] += share * mean;
        }
    }

    /// Replaces the matrix by its Cholesky factor; false when it is not positive definite.
    pub fn factorise(&mut self) -> bool {
        for i in 0..self.first.len() {
            let (before, row) = self.entries.split_at_mut(self.start[i]);
            for j in self.first[i]..=i {
                let from = self.first[i].max(self.first[j]);
                let mine = &row[from - self.first[i]..j - self.first[i]];
                let sum: f64 = if j < i {
                    let at = self.start[j] + from - self.first[j];
                    product(mine, &before[at..at + mine.len()])
                } else {
                    product(mine, mine)
                };
                let place = j - self.first[i];
                let rest = row[place] - sum;
                if j < i {
                    row[place] = rest / before[self.start[j + 1] - 1];
                } else if rest > 0.0 && rest.is_finite() {
                    row[place] = rest.sqrt();
                } else {
                    return false;
                }
            }
        }
        true
    }

    /// Solves for the right-hand side in place, after [`Self::factorise`].
    pub fn solve(&self, b: &mut [f64]) {
        for i in 0..b.len() {
            let row = &self.entries[self.start[i]..self.start[i + 1]];
            let (diagonal, rest) = row.split_last().expect("a row has its diagonal");
            let sum = product(rest, &b[self.first[i]..i]);
            b[i] = (b[i] - sum) / diagonal;
        }
        for i in (0..b.len()).rev() {
            let row = &self.entries[self.start[i]..self.start[i + 1]];
            let (diagonal, rest) = row.split_last().expect("a row has its diagonal");
            b[i] /= diagonal;
            let x = b[i];
            for (a, y) in rest.iter().zip(&mut b[self.first[i]..i]) {
                *y -= a * x;
            }
        }
    }
}

/// The scalar product, eight sums at a time: in that order at every level of vector instructions.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0f64; 8];
    let (a_parts, b_parts) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a_parts.remainder().iter().zip(b_parts.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a_parts.zip(b_parts) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    let [a, b, c, d, e, f, g, h] = sums;
    ((a + e) + (c + g)) + ((b + f) + (d + h)) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solution_satisfies_its_equations() {
        // Second differences of six numbers in a ring, plus one.
        let first = vec![0, 0, 1, 2, 3, 0];
        let mut matrix = Envelope::new(first).unwrap();
        for i in 0..6 {
            matrix.add(i, i, 3.0);
            matrix.add(i, (i + 1) % 6, -1.0);
        }
        let mut factor = matrix.copied().unwrap();
        assert!(factor.factorise());
        let mut x = [1.0, 0.0, 2.0, -1.0, 0.5, 3.0];
        let wanted = x;
        factor.solve(&mut x);
        for i in 0..6 {
            let sum = 3.0 * x[i] - x[(i + 1) % 6] - x[(i + 5) % 6];
            assert!((sum - wanted[i]).abs() < 1e-14, "{i} {sum}");
        }
        matrix.add_ridge(-4.0);
        assert!(!matrix.factorise());
    }
}
