//! All poles at once: least energy with each pole in a ball about where it was.
//!
//! ```text
//!   minimise  E(P0 + D)   subject to  |D_i| <= r,  rows . D = 0
//!   solve     (K + diag m) D = -K P0       multipliers m: first one for all, so that the greatest |D_i| is r;
//!                                          then each by how far its pole goes beyond the ball, or stays inside
//!   step      from the present poles towards the solution, cut to the balls, to the least energy on the way
//! ```
//!
//! Balls and linear constraints are convex: every point of a step is allowed.

use super::LEAST_GAIN;
use super::envelope::Envelope;
use super::rows::{Cell, Functional, hull_deviation};
use crate::bounds::{Vector, add, dot, norm, scaled, sub};
use crate::error::Error;
use crate::portable::SameDigits;

/// Ridge on the matrix, as a share of its mean diagonal: energies do not see straight motions.
const RIDGE: f64 = 1e-13;

/// Solutions tried for one multiplier of all poles.
const UNIFORM_TRIES: usize = 14;

/// Steps in a row that may gain nothing before the search ends: multipliers take some to find their poles.
const PATIENCE: usize = 10;

/// Rounds in which the balls grow to what the proof leaves.
const ROUNDS: usize = 4;

/// What is to be made small, and what is allowed.
pub struct Problem<'a> {
    /// The energy of the shape.
    pub energy: Functional,
    /// What moving costs.
    pub distance: Functional,
    /// The unknown of each pole; none: it stays. Poles may share one.
    pub unknowns: Vec<Option<usize>>,
    /// Number of unknowns.
    pub count: usize,
    /// Linear forms of the motion that must vanish.
    pub kept: Vec<Cell>,
    /// How far a pole may move.
    pub radius: f64,
    /// Whether poles are allowed for other reasons.
    pub allowed: &'a dyn Fn(&[Vector]) -> bool,
    /// Asked between steps whether to stop.
    pub poll: &'a mut dyn FnMut() -> bool,
}

/// Poles on their way.
pub struct State {
    /// Where they were.
    pub old: Vec<Vector>,
    /// Where they are.
    pub poles: Vec<Vector>,
    /// The energy at the beginning and after each step.
    pub energies: Vec<f64>,
}

impl State {
    pub fn new(old: &[Vector], energy: f64) -> Self {
        Self { old: old.to_vec(), poles: old.to_vec(), energies: vec![energy] }
    }

    pub fn last(&self) -> f64 {
        self.energies[self.energies.len() - 1]
    }
}

/// Differences of two lists of points.
pub fn differences(a: &[Vector], b: &[Vector]) -> Vec<Vector> {
    a.iter().zip(b).map(|(a, b)| sub(*a, *b)).collect()
}

impl Problem<'_> {
    /// Energy and cost of moving.
    pub fn value(&self, poles: &[Vector], old: &[Vector]) -> f64 {
        self.energy.value(poles) + self.distance.value(&differences(poles, old))
    }

    /// Calls `run`, and again with larger balls while `proven`, the deviation that is proven, leaves room: the balls alone
    /// bound it, but more than it is. Gives what the last run gave, and the deviation.
    ///
    /// # Errors
    /// Those of `run` and `proven`.
    pub fn in_rounds(
        &mut self,
        state: &mut State,
        deviation: f64,
        run: &mut dyn FnMut(&mut Self, &mut State) -> Result<bool, Error>,
        proven: &dyn Fn(&[Vector]) -> Result<f64, Error>,
    ) -> Result<(bool, f64), Error> {
        let mut best = (false, 0.0);
        for _ in 0..ROUNDS {
            let before = (state.poles.clone(), state.energies.len());
            let converged = run(self, state)?;
            let found = proven(&state.poles)?;
            if found > deviation {
                state.poles = before.0;
                state.energies.truncate(before.1);
                break;
            }
            best = (converged, found);
            let most = hull_deviation(&state.poles, &state.old);
            if most < 0.9 * self.radius || found > 0.97 * deviation || found == 0.0 {
                break;
            }
            self.radius *= (deviation / found).min(2.0) * (1.0 - 1e-9);
        }
        Ok(best)
    }

    /// Runs at most `steps` steps; true when the last ones gained nothing.
    ///
    /// # Errors
    /// Memory that could not be had; [`Error::Cancelled`].
    pub fn run(&mut self, state: &mut State, steps: usize) -> Result<bool, Error> {
        if self.count == 0 {
            return Ok(true);
        }
        let matrix = self.matrix()?;
        let pull = self.gather(&self.energy.gradient(&state.old));
        let diagonal = self.diagonal();
        let mean = diagonal.iter().sum::<f64>() / self.count as f64;
        let (mut low, mut high) = (-14.0, 8.0);
        let mut multipliers = vec![0.0; self.count];
        for k in 0..steps.min(UNIFORM_TRIES) {
            let exponent = if k == 0 { low } else { 0.5 * (low + high) };
            for (m, d) in multipliers.iter_mut().zip(&diagonal) {
                *m = d.max(1e-6 * mean) * 10f64.power(exponent);
            }
            let reach = self.step(&matrix, &pull, &multipliers, state)?.1;
            if reach <= 1.0 {
                high = exponent
            } else {
                low = exponent
            }
            if k == 0 && reach <= 1.0 {
                break;
            }
        }
        let mut idle = 0;
        for _ in UNIFORM_TRIES..steps {
            let before = state.last();
            let (motions, _) = self.step(&matrix, &pull, &multipliers, state)?;
            for (m, d) in multipliers.iter_mut().zip(&motions) {
                let ratio = (norm(*d) / self.radius).clamp(0.05, 20.0);
                *m = (*m * ratio).max(mean * 1e-16);
            }
            idle = if before - state.last() > LEAST_GAIN * before { 0 } else { idle + 1 };
            if idle >= PATIENCE {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// One solution and the step towards it: the motions of the unknowns, and the greatest one in radii.
    fn step(
        &mut self,
        matrix: &Envelope,
        pull: &[Vector],
        multipliers: &[f64],
        state: &mut State,
    ) -> Result<(Vec<Vector>, f64), Error> {
        if (self.poll)() {
            return Err(Error::Cancelled);
        }
        let Some(motions) = self.solution(matrix, pull, multipliers)? else {
            return Ok((vec![[0.0; 3]; self.count], f64::INFINITY));
        };
        let reach = motions.iter().map(|d| norm(*d)).fold(0.0, f64::max) / self.radius;
        let cut = |d: Vector| {
            let far = if self.kept.is_empty() { norm(d) / self.radius } else { reach };
            if far > 1.0 { scaled(d, (1.0 - 1e-12) / far) } else { d }
        };
        let goal: Vec<Vector> = (0..state.old.len())
            .map(|i| match self.unknowns[i] {
                Some(k) => add(state.old[i], cut(motions[k])),
                None => state.old[i],
            })
            .collect();
        self.advance(state, &goal);
        Ok((motions, reach))
    }

    /// Goes from the present poles towards `goal`, to the least energy on the way; nowhere, and false, when it would rise.
    pub fn advance(&self, state: &mut State, goal: &[Vector]) -> bool {
        let way = differences(goal, &state.poles);
        let pairs =
            |a: &[Vector], b: &[Vector]| -> f64 { a.iter().zip(b).map(|(a, b)| dot(*a, *b)).sum() };
        let moved = differences(&state.poles, &state.old);
        let slope = pairs(&self.energy.gradient(&state.poles), &way)
            + pairs(&self.distance.gradient(&moved), &way);
        let bend = self.energy.value(&way) + self.distance.value(&way);
        let mut share = if bend > 0.0 { (-slope / bend).clamp(0.0, 1.0) } else { 1.0 };
        for _ in 0..30 {
            if share <= 0.0 || share.is_nan() {
                return false;
            }
            let at = |(p, d): (&Vector, &Vector)| add(*p, scaled(*d, share));
            let poles: Vec<Vector> = state.poles.iter().zip(&way).map(at).collect();
            let value = self.value(&poles, &state.old);
            if value < state.last() && (self.allowed)(&poles) {
                state.poles = poles;
                state.energies.push(value);
                return true;
            }
            share *= 0.5;
        }
        false
    }

    /// The motions for given multipliers; none when the matrix is not definite.
    fn solution(
        &self,
        matrix: &Envelope,
        pull: &[Vector],
        multipliers: &[f64],
    ) -> Result<Option<Vec<Vector>>, Error> {
        let mut factor = matrix.with_diagonal(multipliers, RIDGE)?;
        if !factor.factorise() {
            return Ok(None);
        }
        let mut motions = vec![[0.0; 3]; self.count];
        for axis in 0..3 {
            let mut b: Vec<f64> = pull.iter().map(|g| -g[axis]).collect();
            factor.solve(&mut b);
            for (motion, x) in motions.iter_mut().zip(b) {
                motion[axis] = x;
            }
        }
        Ok(if self.keep(&factor, &mut motions) { Some(motions) } else { None })
    }

    /// Makes the kept linear forms of the motion vanish, at the least cost in the norm of the factored matrix.
    fn keep(&self, factor: &Envelope, motions: &mut [Vector]) -> bool {
        let rows: Vec<Vec<f64>> = self.kept.iter().map(|cell| self.row(cell)).collect();
        let mut solved = rows.clone();
        solved.iter_mut().for_each(|row| factor.solve(row));
        let n = rows.len();
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let Ok(mut schur) = Envelope::new(vec![0; n]) else { return false };
        for i in 0..n {
            for j in 0..=i {
                schur.add(i, j, product(&rows[i], &solved[j]));
            }
        }
        if !schur.factorise() {
            return false;
        }
        for axis in 0..3 {
            let along: Vec<f64> = motions.iter().map(|d| d[axis]).collect();
            let mut b: Vec<f64> = rows.iter().map(|row| product(row, &along)).collect();
            schur.solve(&mut b);
            for (row, x) in solved.iter().zip(&b) {
                motions.iter_mut().zip(row).for_each(|(d, r)| d[axis] -= r * x);
            }
        }
        true
    }

    /// A row over the poles as one over the unknowns.
    fn row(&self, cell: &Cell) -> Vec<f64> {
        let mut row = vec![0.0; self.count];
        for (x, &i) in cell.rows.iter().zip(&cell.poles) {
            if let Some(k) = self.unknowns[i] {
                row[k] += x;
            }
        }
        row
    }

    /// Sums over the poles of each unknown.
    pub fn gather(&self, by_pole: &[Vector]) -> Vec<Vector> {
        let mut sums = vec![[0.0; 3]; self.count];
        for (x, unknown) in by_pole.iter().zip(&self.unknowns) {
            if let Some(k) = unknown {
                sums[*k] = add(sums[*k], *x);
            }
        }
        sums
    }

    /// Half the second derivative by each unknown, but for what two poles of one have in common.
    pub fn diagonal(&self) -> Vec<f64> {
        let mut sums = vec![0.0; self.count];
        for functional in [&self.energy, &self.distance] {
            for (x, unknown) in functional.diagonal(self.unknowns.len()).iter().zip(&self.unknowns)
            {
                if let Some(k) = unknown {
                    sums[*k] += x;
                }
            }
        }
        sums
    }

    /// The matrix of energy and distance over the unknowns.
    fn matrix(&self) -> Result<Envelope, Error> {
        let cells = || self.energy.0.iter().chain(&self.distance.0);
        let mut first: Vec<usize> = (0..self.count).collect();
        for cell in cells() {
            let unknowns = || cell.poles.iter().filter_map(|&i| self.unknowns[i]);
            let Some(least) = unknowns().min() else { continue };
            unknowns().for_each(|k| first[k] = first[k].min(least));
        }
        let mut matrix = Envelope::new(first)?;
        for cell in cells() {
            let n = cell.poles.len();
            for a in 0..n {
                for b in 0..=a {
                    let (Some(i), Some(j)) =
                        (self.unknowns[cell.poles[a]], self.unknowns[cell.poles[b]])
                    else {
                        continue;
                    };
                    let x: f64 = cell.rows.chunks_exact(n).map(|row| row[a] * row[b]).sum();
                    // Two poles with one unknown meet on its diagonal twice.
                    matrix.add(i, j, if a != b && i == j { 2.0 * x } else { x });
                }
            }
        }
        Ok(matrix)
    }
}
