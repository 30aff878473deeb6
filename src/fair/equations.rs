//! The equations of all poles at once: matrix and right-hand side of energy and distance, the penalty of the tube, the kept forms.

use super::cells::{Cell, Functional};
use super::problem::{Problem, State, differences};
use crate::bounds::{Vector, add, scaled};
use crate::curve::insertion::{append, filled};
use crate::error::Error;
use crate::sparse::{Groups, Solver, Symmetric};

/// Ridge on the matrix, as a share of its mean diagonal: energies do not see straight motions.
const RIDGE: f64 = 1e-13;

/// The equations, their factor with the tube, and the kept forms: rows, the matrix's solutions for them, and the factored products of both.
///
/// Coordinates are solved for apart (`width` 1) or together (3: unknown 3 k + axis), see [`Problem::width`].
pub struct Equations {
    width: usize,
    /// Of energy, distance and the model of the slope.
    matrix: Symmetric,
    /// Squares of the forms of the tube.
    tube: Symmetric,
    /// The sum of both, the tube times its penalty.
    whole: Symmetric,
    solver: Solver,
    /// The gradient that the solution takes away.
    pub pull: Vec<Vector>,
    rows: Vec<f64>,
    solved: Vec<f64>,
    schur: Option<(Symmetric, Solver)>,
    room: Vec<Vector>,
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A row over coordinates, applied.
pub fn across(row: &[f64], cell: Cell, by_pole: &[Vector]) -> f64 {
    row.iter().zip(cell.poles).map(|(x, &i)| x * by_pole[i / 3][i % 3]).sum()
}

impl Problem<'_> {
    /// Unknown numbers a pole that have equations in common: the slope of the curvature couples the coordinates.
    fn width(&self) -> usize {
        if self.slope.is_some() { 3 } else { 1 }
    }

    /// Adds the squares of the rows of a cell, whose entries have these unknown numbers.
    fn add_squares(cell: Cell, unknown: &dyn Fn(usize) -> Option<usize>, matrix: &mut Symmetric) {
        for (a, &first) in cell.poles.iter().enumerate() {
            for (b, &second) in cell.poles[..=a].iter().enumerate() {
                let (Some(i), Some(j)) = (unknown(first), unknown(second)) else { continue };
                let x: f64 = cell.each().map(|row| row[a] * row[b]).sum();
                // Two poles with one unknown meet on its diagonal twice.
                matrix.add(i, j, if a != b && i == j { 2.0 * x } else { x });
            }
        }
    }

    /// The matrix of the energy alone over the unknowns.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn energy_matrix(&self) -> Result<Symmetric, Error> {
        let mut groups = Groups::default();
        for cell in self.energy.cells() {
            groups.push(cell.poles.iter().filter_map(|&i| self.unknowns[i]))?;
        }
        let mut matrix = Symmetric::new(self.count, &groups)?;
        self.energy
            .cells()
            .for_each(|cell| Self::add_squares(cell, &|i| self.unknowns[i], &mut matrix));
        Ok(matrix)
    }

    /// A row over the poles as one over the unknown numbers of one axis, appended.
    fn append_row(&self, cell: Cell, axis: usize, rows: &mut Vec<f64>) -> Result<(), Error> {
        let (width, start) = (self.width(), rows.len());
        rows.try_reserve(self.count * width).map_err(|_| Error::OutOfMemory)?;
        rows.resize(start + self.count * width, 0.0);
        for (x, &i) in cell.rows.iter().zip(cell.poles) {
            if let Some(k) = self.unknowns[i] {
                rows[start + width * k + axis] += x;
            }
        }
        Ok(())
    }

    /// The equations with the pattern of everything that they may hold, at these poles.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn equations(
        &self,
        tube: &Functional,
        state: &State,
        held: f64,
    ) -> Result<Equations, Error> {
        let width = self.width();
        let mut groups = Groups::default();
        for axis in 0..width {
            let number = |k: usize| width * k + axis;
            for cell in self.energy.cells().chain(self.distance.cells()) {
                let unknowns = cell.poles.iter().filter_map(|&i| self.unknowns[i]);
                groups.push(unknowns.map(number))?;
            }
            for form in tube.cells().filter(|form| form.poles.len() > 1) {
                groups.push(form.poles.iter().map(|&k| number(k)))?;
            }
        }
        if let Some(slope) = &self.slope {
            for place in slope.places().cells() {
                let unknowns = place.poles.iter().filter_map(|&i| self.unknowns[i]);
                groups.push(unknowns.flat_map(|k| [3 * k, 3 * k + 1, 3 * k + 2]))?;
            }
        }
        let matrix = Symmetric::new(self.count * width, &groups)?;
        drop(groups);
        let (whole, solver) = (matrix.copied()?, Solver::new(&matrix)?);
        let mut squares = matrix.copied()?;
        for form in tube.cells() {
            for axis in 0..width {
                Self::add_squares(form, &|k| Some(width * k + axis), &mut squares);
            }
        }
        let mut rows = Vec::new();
        for axis in 0..width {
            for cell in self.kept.cells() {
                self.append_row(cell, axis, &mut rows)?;
            }
        }
        let solved = filled(rows.len(), 0.0)?;
        let kept = width * self.kept.len();
        let schur = if kept > 0 {
            let mut all = Groups::default();
            all.push(0..kept)?;
            let matrix = Symmetric::new(kept, &all)?;
            let solver = Solver::new(&matrix)?;
            Some((matrix, solver))
        } else {
            None
        };
        let room = filled(self.count, [0.0; 3])?;
        let pull = Vec::new();
        let mut equations = Equations {
            width,
            matrix,
            tube: squares,
            whole,
            solver,
            pull,
            rows,
            solved,
            schur,
            room,
        };
        self.renew(&mut equations, state, held)?;
        Ok(equations)
    }

    /// Matrix and right-hand side at these poles; `held` is the share of what holds the parameters.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn renew(&self, equations: &mut Equations, state: &State, held: f64) -> Result<(), Error> {
        let (width, matrix) = (equations.width, &mut equations.matrix);
        matrix.clear();
        for cell in self.energy.cells().chain(self.distance.cells()) {
            for axis in 0..width {
                Self::add_squares(cell, &|i| Some(width * self.unknowns[i]? + axis), matrix);
            }
        }
        let mut pull = self.energy.gradient(&state.old)?;
        if let Some(slope) = &self.slope {
            let moved = differences(&state.poles, &state.old)?;
            slope.add_gradient(&state.poles, &mut pull);
            let mut take = |cell: Cell| {
                Self::add_squares(cell, &|i| Some(3 * self.unknowns[i / 3]? + i % 3), matrix);
                for row in cell.each() {
                    let whole = across(row, cell, &moved);
                    for (x, &i) in row.iter().zip(cell.poles) {
                        pull[i / 3][i % 3] -= x * whole;
                    }
                }
            };
            slope.near(&state.poles)?.cells().for_each(&mut take);
            let root = held.sqrt();
            let mut squares = Functional::default();
            for cell in slope.model(&state.poles)?.cells() {
                for axis in 0..3 {
                    let mut row = [0.0; crate::knots::MAX_DEGREE + 1];
                    let row = &mut row[..cell.rows.len()];
                    row.iter_mut().zip(cell.rows).for_each(|(x, y)| *x = root * y);
                    squares.push(cell.poles.iter().map(|i| 3 * i + axis), row)?;
                }
            }
            squares.cells().for_each(&mut take);
        }
        equations.pull = self.gather(&pull)?;
        Ok(())
    }
}

impl Equations {
    /// Sum of the diagonal.
    pub fn trace(&self) -> f64 {
        (0..self.matrix.count()).map(|k| self.matrix.diagonal(k) / self.width as f64).sum()
    }

    /// Factors the matrix with the tube's penalty, and what keeps the kept forms; false when it is not definite.
    pub fn factorise(&mut self, penalty: f64) -> bool {
        self.whole.set_sum(&self.matrix, penalty, &self.tube);
        self.whole.add_ridge(RIDGE);
        if !self.solver.factorise(&self.whole) {
            return false;
        }
        let Some((schur, solver)) = &mut self.schur else { return true };
        let (kept, size) = (schur.count(), self.whole.count());
        self.solved.copy_from_slice(&self.rows);
        let room = self.room.as_flattened_mut().as_chunks_mut::<1>().0;
        for row in self.solved.chunks_exact_mut(size) {
            self.solver.solve(row.as_chunks_mut::<1>().0, &mut room[..size]);
        }
        schur.clear();
        for i in 0..kept {
            for j in 0..=i {
                let [a, b] = [&self.rows[i * size..][..size], &self.solved[j * size..][..size]];
                schur.add(i, j, product(a, b));
            }
        }
        solver.factorise(schur)
    }

    /// The motions for the present targets of the tube; the kept forms of them vanish, at the least cost.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn solution(
        &mut self,
        tube: &Functional,
        targets: impl Iterator<Item = Vector>,
        penalty: f64,
        motions: &mut [Vector],
    ) -> Result<(), Error> {
        motions.iter_mut().zip(&self.pull).for_each(|(x, g)| *x = scaled(*g, -1.0));
        for (form, target) in tube.cells().zip(targets) {
            for (x, &k) in form.rows.iter().zip(form.poles) {
                motions[k] = add(motions[k], scaled(target, penalty * x));
            }
        }
        self.apply(motions)
    }

    /// Solves the factored equations in place; the kept forms of the motions vanish, at the least cost.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn apply(&mut self, motions: &mut [Vector]) -> Result<(), Error> {
        let mut room = std::mem::take(&mut self.room);
        let done = if self.width == 1 {
            self.solve(motions, &mut room)
        } else {
            let [x, room] =
                [motions, &mut room[..]].map(|list| list.as_flattened_mut().as_chunks_mut::<1>().0);
            self.solve(x, room)
        };
        self.room = room;
        done
    }

    fn solve<const N: usize>(
        &self,
        x: &mut [[f64; N]],
        room: &mut [[f64; N]],
    ) -> Result<(), Error> {
        self.solver.solve(x, room);
        let Some((schur, solver)) = &self.schur else { return Ok(()) };
        let size = x.len();
        let mut excess: Vec<[f64; N]> = Vec::new();
        for row in self.rows.chunks_exact(size) {
            let mut sum = [0.0; N];
            for (a, x) in row.iter().zip(x.iter()) {
                (0..N).for_each(|k| sum[k] += a * x[k]);
            }
            append(&mut excess, sum)?;
        }
        solver.solve(&mut excess, &mut filled(schur.count(), [0.0; N])?);
        for (row, share) in self.solved.chunks_exact(size).zip(&excess) {
            for (a, x) in row.iter().zip(x.iter_mut()) {
                (0..N).for_each(|k| x[k] -= a * share[k]);
            }
        }
        Ok(())
    }
}

impl Problem<'_> {
    /// The forms of the tube over the unknowns; those of poles that stay have none.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn tube(&self) -> Result<Functional, Error> {
        let mut tube = Functional::default();
        for cell in self.tubes.cells() {
            let (mut unknowns, mut row) = (Vec::new(), Vec::new());
            for (&x, &i) in cell.rows.iter().zip(cell.poles) {
                let Some(k) = self.unknowns[i].filter(|_| x != 0.0) else { continue };
                match unknowns.iter().position(|&other| other == k) {
                    Some(place) => row[place] += x,
                    None => {
                        unknowns.push(k);
                        row.push(x);
                    }
                }
            }
            if !unknowns.is_empty() {
                tube.push(unknowns.into_iter(), &row)?;
            }
        }
        Ok(tube)
    }

    /// Sums over the poles of each unknown.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn gather(&self, by_pole: &[Vector]) -> Result<Vec<Vector>, Error> {
        let mut sums = filled(self.count, [0.0; 3])?;
        for (x, unknown) in by_pole.iter().zip(&self.unknowns) {
            if let Some(k) = unknown {
                sums[*k] = add(sums[*k], *x);
            }
        }
        Ok(sums)
    }

    /// The motion of each unknown: its poles have the same.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn gather_mean(&self, by_pole: &[Vector]) -> Result<Vec<Vector>, Error> {
        let mut motions = filled(self.count, [0.0; 3])?;
        for (x, unknown) in by_pole.iter().zip(&self.unknowns) {
            if let Some(k) = unknown {
                motions[*k] = *x;
            }
        }
        Ok(motions)
    }
}
