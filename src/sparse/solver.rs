//! Analysis of a pattern, and its factors one after the other.

use super::factor::{Panel, Walk, factorise, solve};
use super::symmetric::Symmetric;
use crate::curve::insertion::{filled, room};
use crate::error::Error;
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};

/// Most entries of a factor: 2 GB.
const MOST_ENTRIES: usize = 1 << 28;

/// Solves with matrices of one pattern.
pub(crate) struct Solver {
    panels: Vec<Panel>,
    /// The patterns of all panels: rising columns of the factor.
    rows: Vec<usize>,
    /// The panel of each column.
    of_column: Vec<usize>,
    /// The unknown that is each column of the factor.
    unknowns: Vec<usize>,
    /// Where each entry of the matrix lies in the factor.
    places: Vec<usize>,
    values: Vec<f64>,
    /// Room of the walk over the panels.
    numbers: Vec<usize>,
    product: Vec<f64>,
}

/// Which unknown is eliminated when, and with which others.
fn analysed(matrix: &Symmetric) -> Result<SymbolicCholesky<usize>, Error> {
    let (starts, rows) = matrix.pattern();
    let count = matrix.count();
    let pattern = SymbolicSparseColMatRef::new_checked(count, count, starts, None, rows);
    // Below zero: matrices without any product too, such as one unknown.
    let parameters = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: faer::sparse::linalg::SupernodalThreshold(-1.0),
        ..Default::default()
    };
    factorize_symbolic_cholesky(pattern, faer::Side::Lower, SymmetricOrdering::Amd, parameters)
        .map_err(|_| Error::OutOfMemory)
}

impl Solver {
    /// For matrices of the pattern of `matrix`; nothing is factored yet.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], also for a factor of more than 2 GB.
    pub fn new(matrix: &Symmetric) -> Result<Self, Error> {
        let count = matrix.count();
        let symbolic = analysed(matrix)?;
        // Asked for by `parameters`.
        let SymbolicCholeskyRaw::Supernodal(nodes) = symbolic.raw() else {
            return Err(Error::OutOfMemory);
        };
        if nodes.len_val() > MOST_ENTRIES {
            return Err(Error::OutOfMemory);
        }
        let values = filled(nodes.len_val(), 0.0)?;
        let mut panels = room(nodes.n_supernodes())?;
        let (patterns, places) = (nodes.col_ptr_for_row_idx(), nodes.col_ptr_for_val());
        let mut of_column = filled(count, 0)?;
        for s in 0..nodes.n_supernodes() {
            let columns = nodes.supernode_begin()[s]..nodes.supernode_end()[s];
            of_column[columns.clone()].fill(s);
            let pattern = patterns[s]..patterns[s + 1];
            panels.push(Panel { columns, pattern, values: places[s]..places[s + 1] });
        }
        let mut rows = room(nodes.row_idx().len())?;
        rows.extend_from_slice(nodes.row_idx());
        let mut solver = Self {
            rows,
            of_column,
            unknowns: filled(count, 0)?,
            places: room(matrix.values().len())?,
            values,
            numbers: filled(count + 3 * panels.len(), 0)?,
            product: Vec::new(),
            panels,
        };
        let mut column_of = filled(count, 0)?;
        (0..count).for_each(|i| (solver.unknowns[i], column_of[i]) = (i, i));
        if let Some(order) = symbolic.perm() {
            let (unknowns, columns) = order.arrays();
            solver.unknowns.copy_from_slice(unknowns);
            column_of.copy_from_slice(columns);
        }
        solver.place(matrix, &column_of);
        solver.product = filled(solver.greatest_product(), 0.0)?;
        Ok(solver)
    }

    /// Where the entries of the matrix lie in the panels.
    fn place(&mut self, matrix: &Symmetric, column_of: &[usize]) {
        let (starts, rows) = matrix.pattern();
        for (j, columns) in starts.windows(2).enumerate() {
            for &i in &rows[columns[0]..columns[1]] {
                let (a, b) = (column_of[i], column_of[j]);
                let (row, column) = (a.max(b), a.min(b));
                let panel = &self.panels[self.of_column[column]];
                let inside = if row < panel.columns.end {
                    row - panel.columns.start
                } else {
                    let pattern = &self.rows[panel.pattern.clone()];
                    panel.width() + pattern.partition_point(|&x| x < row)
                };
                let start = panel.values.start + (column - panel.columns.start) * panel.height();
                self.places.push(start + inside);
            }
        }
    }

    /// Numbers of the greatest product of a panel with the part of it that another one takes.
    fn greatest_product(&self) -> usize {
        let mut most = 0;
        for panel in &self.panels {
            let pattern = &self.rows[panel.pattern.clone()];
            most = most.max(panel.height() * panel.width().min(super::factor::BLOCK));
            let mut from = 0;
            while from < pattern.len() {
                let end = self.panels[self.of_column[pattern[from]]].columns.end;
                let taken = pattern[from..].iter().take_while(|&&row| row < end).count();
                most = most.max((pattern.len() - from) * taken);
                from += taken;
            }
        }
        most
    }

    /// Factors a matrix of the pattern; false when it is not positive definite.
    pub fn factorise(&mut self, matrix: &Symmetric) -> bool {
        self.values.fill(0.0);
        self.places.iter().zip(matrix.values()).for_each(|(&place, x)| self.values[place] += x);
        let (local, rest) = self.numbers.split_at_mut(self.unknowns.len());
        let (head, rest) = rest.split_at_mut(self.panels.len());
        let (next, done) = rest.split_at_mut(self.panels.len());
        let (of_column, product) = (&self.of_column[..], &mut self.product[..]);
        let walk = Walk { of_column, local, head, next, done, product };
        factorise(&self.panels, &self.rows, &mut self.values, walk)
    }

    /// Solves in place, after [`Self::factorise`]; `room` is as long and need not be anything.
    pub fn solve<const N: usize>(&self, x: &mut [[f64; N]], room: &mut [[f64; N]]) {
        room.iter_mut().zip(&self.unknowns).for_each(|(y, &i)| *y = x[i]);
        solve(&self.panels, &self.rows, &self.values, room);
        room.iter().zip(&self.unknowns).for_each(|(y, &i)| x[i] = *y);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sparse::Groups;

    /// A sheet of n x n unknowns that meet when they are at most two apart, and its last one meets the first.
    fn sheet(n: usize) -> Symmetric {
        let mut groups = Groups::default();
        for i in 0..n - 2 {
            for j in 0..n - 2 {
                groups.push((0..9).map(|k| (i + k / 3) * n + j + k % 3)).unwrap();
            }
        }
        groups.push([0, n * n - 1].into_iter()).unwrap();
        let mut matrix = Symmetric::new(n * n, &groups).unwrap();
        let (starts, rows) = matrix.pattern();
        let entries: Vec<[usize; 2]> = (0..n * n)
            .flat_map(|j| rows[starts[j]..starts[j + 1]].iter().map(move |&i| [i, j]))
            .collect();
        for [i, j] in entries {
            let x = if i == j { 30.0 } else { ((i * 7 + j * 3) as f64).sin() };
            matrix.add(j, i, x);
        }
        matrix
    }

    #[test]
    fn solutions_satisfy_their_equations() {
        for n in [3, 4, 9, 30] {
            let matrix = sheet(n);
            let whole = matrix.whole().unwrap();
            let truth: Vec<[f64; 3]> =
                (0..n * n).map(|i| [i as f64, 1.0, (i as f64).cos()]).collect();
            let product = |i: usize| {
                let terms = whole.row(i).iter();
                terms.fold([0.0; 3], |sum, &(j, a)| [0, 1, 2].map(|k| sum[k] + a * truth[j][k]))
            };
            let mut x: Vec<[f64; 3]> = (0..n * n).map(product).collect();
            let mut solver = Solver::new(&matrix).unwrap();
            // Twice: a factor leaves nothing behind.
            for _ in 0..2 {
                assert!(solver.factorise(&matrix));
            }
            let mut single: Vec<[f64; 1]> = x.iter().map(|x| [x[2]]).collect();
            solver.solve(&mut x, &mut vec![[0.0; 3]; n * n]);
            solver.solve(&mut single, &mut vec![[0.0]; n * n]);
            for ((x, y), z) in x.iter().zip(&truth).zip(&single) {
                assert!(
                    (0..3).all(|k| (x[k] - y[k]).abs() < 1e-11 * (n * n) as f64),
                    "{x:?} {y:?}"
                );
                assert_eq!(x[2].to_bits(), z[0].to_bits());
            }
        }
    }

    #[test]
    fn a_matrix_that_is_not_positive_definite_is_told() {
        let mut matrix = sheet(9);
        let mut solver = Solver::new(&matrix).unwrap();
        matrix.add(40, 40, -60.0);
        assert!(!solver.factorise(&matrix));
        matrix.add(40, 40, f64::NAN);
        assert!(!solver.factorise(&matrix));
        assert!(solver.factorise(&sheet(9)));
    }

    #[test]
    fn one_unknown_full_and_diagonal_matrices_are_solved() {
        for (n, is_full) in [(1, true), (2, true), (5, true), (40, true), (7, false)] {
            let mut groups = Groups::default();
            if is_full {
                groups.push(0..n).unwrap();
            }
            let mut matrix = Symmetric::new(n, &groups).unwrap();
            let off = f64::from(u8::from(is_full));
            (0..n).for_each(|i| (0..=i).for_each(|j| matrix.add(i, j, off)));
            (0..n).for_each(|i| matrix.add(i, i, 1.0 + i as f64));
            let mut solver = Solver::new(&matrix).unwrap();
            assert!(solver.factorise(&matrix));
            let whole = matrix.whole().unwrap();
            let mut x: Vec<[f64; 1]> =
                (0..n).map(|i| [whole.row(i).iter().map(|(j, a)| a * *j as f64).sum()]).collect();
            solver.solve(&mut x, &mut vec![[0.0]; n]);
            assert!(x.iter().enumerate().all(|(i, x)| (x[0] - i as f64).abs() < 1e-11), "{x:?}");
        }
    }
}
