//! All poles at once: least energy within a tube about the shape as it was.
//!
//! ```text
//!   minimise  E(P0 + D)   subject to  |R_k D| <= r,  rows . D = 0      R_k D: poles of the motion over refined knots
//!   repeat    (K + c R^T R) D = -K P0 + c R^T (z - y)                  one factor for many right-hand sides
//!             z = R D + y, cut to the tube;   y = y + R D - z
//!   step      from the present poles towards the solution, shrunk into the tube, to the least energy on the way
//! ```
//!
//! Tube and linear constraints are convex: every point of a step is allowed. With an energy that is no square (the slope of the
//! curvature) K is a model of it at the present poles, and -K P0 becomes K D - gradient there.
//!
//! Reference: Boyd, Parikh, Chu, Peleato, Eckstein, *Distributed optimization and statistical learning via the alternating direction
//! method of multipliers*, 2011, chapters 3 and 5.

use super::LEAST_GAIN;
use super::envelope::Envelope;
use super::length::LengthLimit;
use super::rows::{Cell, Functional, hull_deviation};
use super::slope::Slope;
use crate::bounds::{Vector, add, dot, norm, scaled, sub};
use crate::error::Error;

/// Ridge on the matrix, as a share of its mean diagonal: energies do not see straight motions.
const RIDGE: f64 = 1e-13;

/// Solutions between two steps.
const EVERY: usize = 5;

/// Solutions between two looks at the penalty.
const BALANCED: usize = 10;

/// Steps in a row that may gain nothing before the search ends.
const PATIENCE: usize = 6;

/// Share of the parameters' hold in the matrix of the slope: least, first and most.
const HELD: [f64; 3] = [1e-6, 1e-1, 1e2];

/// Over-relaxation of the solutions.
const RELAXED: f64 = 1.6;

/// Rounds in which the balls grow to what the proof leaves.
const ROUNDS: usize = 4;

/// What is to be made small, and what is allowed.
pub struct Problem<'a> {
    /// The energy of the shape.
    pub energy: Functional,
    /// What moving costs.
    pub distance: Functional,
    /// An energy that is no square.
    pub slope: Option<Slope>,
    /// The unknown of each pole; none: it stays. Poles may share one.
    pub unknowns: Vec<Option<usize>>,
    /// Number of unknowns.
    pub count: usize,
    /// Linear forms of the motion that must vanish.
    pub kept: Vec<Cell>,
    /// One row each: forms of the motion, over the poles, that may be as long as the radius; see [`Self::tube`].
    pub tubes: Vec<Cell>,
    /// How far a form of the tube may move; of the other methods: a pole.
    pub radius: f64,
    /// What the arc length may be.
    pub length: Option<LengthLimit>,
    /// Whether poles are allowed for other reasons.
    pub allowed: &'a dyn Fn(&[Vector]) -> bool,
    /// Asked between steps whether to stop.
    pub poll: &'a mut dyn FnMut() -> bool,
}

/// A factored matrix with the kept forms: rows, the matrix's solutions for them, and the factored products of both.
///
/// Coordinates are solved for apart (`width` 1) or together (3: unknown 3 k + axis), see [`Problem::width`].
struct Factor {
    width: usize,
    factor: Envelope,
    rows: Vec<Vec<f64>>,
    solved: Vec<Vec<f64>>,
    schur: Envelope,
}

/// The arc length, linear in the motions: `gradient . motions + at`, and what it may be.
struct Length {
    gradient: Vec<Vector>,
    at: f64,
    range: [f64; 2],
    /// The motions that change it at the least cost.
    way: Vec<Vector>,
}

fn pairs(a: &[Vector], b: &[Vector]) -> f64 {
    a.iter().zip(b).map(|(a, b)| dot(*a, *b)).sum()
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Length {
    /// Moves the motions to the nearest ones whose length is in the range.
    fn hold(&self, motions: &mut [Vector]) {
        let length = self.at + pairs(&self.gradient, motions);
        let excess = length - length.clamp(self.range[0], self.range[1]);
        let slope = pairs(&self.gradient, &self.way);
        if excess != 0.0 && slope > 0.0 {
            let share = -excess / slope;
            motions
                .iter_mut()
                .zip(&self.way)
                .for_each(|(x, way)| *x = add(*x, scaled(*way, share)));
        }
    }
}

/// A row over coordinates, applied.
fn across(row: &[f64], cell: &Cell, by_pole: &[Vector]) -> f64 {
    row.iter().zip(&cell.poles).map(|(x, &i)| x * by_pole[i / 3][i % 3]).sum()
}

/// A linear form: unknowns and their factors.
type Form = Vec<(usize, f64)>;

fn applied(form: &Form, motions: &[Vector]) -> Vector {
    form.iter().fold([0.0; 3], |sum, &(k, x)| add(sum, scaled(motions[k], x)))
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
        let slope = self.slope.as_ref().map_or(0.0, |slope| slope.value(poles));
        self.energy.value(poles) + self.distance.value(&differences(poles, old)) + slope
    }

    /// Unknown numbers a pole that have equations in common: the slope of the curvature couples the coordinates.
    fn width(&self) -> usize {
        if self.slope.is_some() { 3 } else { 1 }
    }

    /// The squares that stand for the slope at these poles, over coordinates; `held` is the share of what holds the parameters.
    fn model(&self, poles: &[Vector], held: f64) -> Vec<Cell> {
        let Some(slope) = &self.slope else { return Vec::new() };
        let mut cells = slope.near(poles);
        let root = held.sqrt();
        for cell in slope.model(poles).0 {
            cells.extend((0..3).map(|axis| Cell {
                poles: cell.poles.iter().map(|i| 3 * i + axis).collect(),
                rows: cell.rows.iter().map(|x| root * x).collect(),
            }));
        }
        cells
    }

    /// The equations at the present poles: matrix and right-hand side.
    fn equations(&self, state: &State, held: f64) -> Result<(Envelope, Vec<Vector>), Error> {
        let model = self.model(&state.poles, held);
        let mut pull = self.energy.gradient(&state.old);
        if let Some(slope) = &self.slope {
            let moved = differences(&state.poles, &state.old);
            let own = slope.gradient(&state.poles);
            pull.iter_mut().zip(own).for_each(|(x, a)| *x = add(*x, a));
            for cell in &model {
                for row in cell.rows.chunks_exact(cell.poles.len()) {
                    let whole = across(row, cell, &moved);
                    for (x, &i) in row.iter().zip(&cell.poles) {
                        pull[i / 3][i % 3] -= x * whole;
                    }
                }
            }
        }
        Ok((self.matrix(&model)?, self.gather(&pull)))
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

    /// Solves at most `steps` times; true when the last steps gained nothing.
    ///
    /// # Errors
    /// Memory that could not be had; [`Error::Cancelled`].
    pub fn run(&mut self, state: &mut State, steps: usize) -> Result<bool, Error> {
        if self.count == 0 {
            return Ok(true);
        }
        let tube = self.tube();
        let (mut held, width) = (HELD[1], self.width());
        let mut equations = self.equations(state, held)?;
        let diagonal = |k| equations.0.diagonal(k) / width as f64;
        let stiff: f64 = (0..self.count * width).map(diagonal).sum();
        let squares: f64 = tube.iter().flatten().map(|(_, x)| x * x).sum();
        let mut penalty = 1e-3 * stiff / squares.max(f64::MIN_POSITIVE);
        let Some(mut factor) = self.factor(&equations.0, &tube, penalty)? else { return Ok(false) };
        let mut length = self.length(state, &factor, 0);
        let present = self.gather_mean(&differences(&state.poles, &state.old));
        let mut inside: Vec<Vector> = tube.iter().map(|form| applied(form, &present)).collect();
        let mut shift = vec![[0.0; 3]; tube.len()];
        let mut idle = 0;
        for k in 1..=steps {
            if (self.poll)() {
                return Err(Error::Cancelled);
            }
            let targets: Vec<Vector> = differences(&inside, &shift);
            let mut motions = self.solution(&factor, &equations.1, (&tube, &targets), penalty);
            if let Some(length) = &length {
                length.hold(&mut motions);
            }
            let (mut primal, mut dual) = ([0.0f64; 2], [0.0f64; 2]);
            let mut reach = 0.0f64;
            for ((form, z), y) in tube.iter().zip(&mut inside).zip(&mut shift) {
                let here = applied(form, &motions);
                let relaxed = add(scaled(here, RELAXED), scaled(*z, 1.0 - RELAXED));
                let free = add(relaxed, *y);
                let far = norm(free) / self.radius;
                let cut = if far > 1.0 { scaled(free, 1.0 / far) } else { free };
                primal = [primal[0].max(norm(sub(here, cut))), primal[1].max(norm(here))];
                dual = [dual[0].max(norm(sub(cut, *z))), dual[1].max(norm(sub(free, cut)))];
                (*y, *z) = (sub(free, cut), cut);
                reach = reach.max(norm(here) / self.radius);
            }
            if k % EVERY == 0 || k == steps {
                let before = state.last();
                let share = self.go(state, &motions, reach);
                let is_idle = before - state.last() <= LEAST_GAIN * before;
                idle = if is_idle { idle + 1 } else { 0 };
                if idle >= PATIENCE {
                    return Ok(true);
                }
                if self.slope.is_some() {
                    let change = if share > 0.5 { 0.2 } else { 4.0 };
                    held = (held * change).clamp(HELD[0], HELD[2]);
                    equations = self.equations(state, held)?;
                }
            }
            let is_new = k % EVERY == 0 && self.slope.is_some();
            let share = |[a, b]: [f64; 2]| if b > 0.0 { a / b } else { 0.0 };
            // Where the tube holds nothing back, its penalty does and must go.
            let is_free = dual[1] == 0.0;
            let ratio =
                if is_free { 0.0 } else { (share(primal) / share(dual).max(1e-300)).sqrt() };
            let is_unbalanced =
                k % BALANCED == 0 && ratio.is_finite() && !(0.4..=2.5).contains(&ratio);
            if is_unbalanced {
                let change = ratio.clamp(0.05, 20.0);
                penalty *= change;
                shift.iter_mut().for_each(|y| *y = scaled(*y, 1.0 / change));
            }
            if is_new || is_unbalanced {
                let Some(next) = self.factor(&equations.0, &tube, penalty)? else {
                    return Ok(false);
                };
                factor = next;
            }
            if k % EVERY == 0 || is_unbalanced {
                length = self.length(state, &factor, k / EVERY);
            }
        }
        Ok(false)
    }

    /// The arc length about the present poles. It is no linear function: the range is narrower, and less so after each step.
    fn length(&self, state: &State, factor: &Factor, steps: usize) -> Option<Length> {
        let limit = self.length.as_ref()?;
        let (now, gradient) = limit.with_gradient(&state.poles);
        let moved = differences(&state.poles, &state.old);
        let at = now - pairs(&gradient, &moved);
        let [low, high] = limit.range;
        let margin = 0.2 * (high - low) * 0.7f64.powi(steps.min(60) as i32);
        let gradient = self.gather(&gradient);
        let way = self.applied(factor, &gradient);
        Some(Length { gradient, at, range: [low + margin, high - margin], way })
    }

    /// Goes towards the poles with these motions, shrunk into the tube; gives the share of the way.
    fn go(&self, state: &mut State, motions: &[Vector], reach: f64) -> f64 {
        let share = if reach > 1.0 { (1.0 - 1e-12) / reach } else { 1.0 };
        let goal: Vec<Vector> = (0..state.old.len())
            .map(|i| match self.unknowns[i] {
                Some(k) => add(state.old[i], scaled(motions[k], share)),
                None => state.old[i],
            })
            .collect();
        self.advance(state, &goal)
    }

    /// Goes from the present poles towards `goal`, to the least energy on the way; gives the share of it, 0 when the energy would rise.
    pub fn advance(&self, state: &mut State, goal: &[Vector]) -> f64 {
        let way = differences(goal, &state.poles);
        let moved = differences(&state.poles, &state.old);
        let mut slope = pairs(&self.energy.gradient(&state.poles), &way)
            + pairs(&self.distance.gradient(&moved), &way);
        let mut bend = self.energy.value(&way) + self.distance.value(&way);
        if let Some(energy) = &self.slope {
            slope += pairs(&energy.gradient(&state.poles), &way);
            let square = |cell: &Cell| -> f64 {
                let rows = cell.rows.chunks_exact(cell.poles.len());
                rows.map(|row| across(row, cell, &way)).map(|x| x * x).sum()
            };
            bend += energy.near(&state.poles).iter().map(square).sum::<f64>();
        }
        let mut share = if bend > 0.0 { (-slope / bend).clamp(0.0, 1.0) } else { 1.0 };
        for _ in 0..30 {
            if share <= 0.0 || share.is_nan() {
                return 0.0;
            }
            let at = |(p, d): (&Vector, &Vector)| add(*p, scaled(*d, share));
            let poles: Vec<Vector> = state.poles.iter().zip(&way).map(at).collect();
            let value = self.value(&poles, &state.old);
            let is_regular = self.slope.as_ref().is_none_or(|slope| slope.is_regular(&poles));
            if value < state.last() && is_regular && (self.allowed)(&poles) {
                state.poles = poles;
                state.energies.push(value);
                return share;
            }
            share *= 0.5;
        }
        0.0
    }

    /// The factored matrix with the penalty, and what keeps the kept forms; none when it is not definite.
    fn factor(
        &self,
        matrix: &Envelope,
        tube: &[Form],
        penalty: f64,
    ) -> Result<Option<Factor>, Error> {
        let width = self.width();
        let mut factor = matrix.copied()?;
        for form in tube {
            for (n, &(i, x)) in form.iter().enumerate() {
                for &(j, y) in &form[..=n] {
                    for axis in 0..width {
                        factor.add(width * i + axis, width * j + axis, penalty * x * y);
                    }
                }
            }
        }
        factor.add_ridge(RIDGE);
        if !factor.factorise() {
            return Ok(None);
        }
        let axes = (0..width).flat_map(|axis| self.kept.iter().map(move |cell| (cell, axis)));
        let rows: Vec<Vec<f64>> = axes.map(|(cell, axis)| self.row(cell, axis)).collect();
        let mut solved = rows.clone();
        solved.iter_mut().for_each(|row| factor.solve(row));
        let mut schur = Envelope::new(vec![0; rows.len()])?;
        for i in 0..rows.len() {
            for j in 0..=i {
                schur.add(i, j, product(&rows[i], &solved[j]));
            }
        }
        if !schur.factorise() {
            return Ok(None);
        }
        Ok(Some(Factor { width, factor, rows, solved, schur }))
    }

    /// The motions for the present targets of the tube; the kept forms of them vanish, at the least cost.
    fn solution(
        &self,
        factor: &Factor,
        pull: &[Vector],
        (tube, targets): (&[Form], &[Vector]),
        penalty: f64,
    ) -> Vec<Vector> {
        let mut right: Vec<Vector> = pull.iter().map(|g| scaled(*g, -1.0)).collect();
        for (form, target) in tube.iter().zip(targets) {
            for &(k, x) in form {
                right[k] = add(right[k], scaled(*target, penalty * x));
            }
        }
        self.applied(factor, &right)
    }

    /// The factored equations solved for a right-hand side; the kept forms of the motions vanish, at the least cost.
    fn applied(&self, factor: &Factor, right: &[Vector]) -> Vec<Vector> {
        let mut motions = vec![[0.0; 3]; self.count];
        let width = factor.width;
        for first in (0..3).step_by(width) {
            let mut b: Vec<f64> =
                right.iter().flat_map(|g| &g[first..first + width]).copied().collect();
            factor.factor.solve(&mut b);
            let mut excess: Vec<f64> = factor.rows.iter().map(|row| product(row, &b)).collect();
            factor.schur.solve(&mut excess);
            for (row, x) in factor.solved.iter().zip(&excess) {
                b.iter_mut().zip(row).for_each(|(d, r)| *d -= r * x);
            }
            for (motion, x) in motions.iter_mut().zip(b.chunks_exact(width)) {
                motion[first..first + width].copy_from_slice(x);
            }
        }
        motions
    }

    /// The forms of the tube over the unknowns; those of poles that stay have none.
    fn tube(&self) -> Vec<Form> {
        let form = |cell: &Cell| {
            let mut form: Form = Vec::with_capacity(cell.poles.len());
            for (&x, &i) in cell.rows.iter().zip(&cell.poles) {
                let Some(k) = self.unknowns[i].filter(|_| x != 0.0) else { continue };
                match form.iter_mut().find(|entry| entry.0 == k) {
                    Some(entry) => entry.1 += x,
                    None => form.push((k, x)),
                }
            }
            form
        };
        self.tubes.iter().map(form).filter(|form| !form.is_empty()).collect()
    }

    /// A row over the poles as one over the unknown numbers of one axis.
    fn row(&self, cell: &Cell, axis: usize) -> Vec<f64> {
        let width = self.width();
        let mut row = vec![0.0; self.count * width];
        for (x, &i) in cell.rows.iter().zip(&cell.poles) {
            if let Some(k) = self.unknowns[i] {
                row[width * k + axis] += x;
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

    /// The motion of each unknown: its poles have the same.
    fn gather_mean(&self, by_pole: &[Vector]) -> Vec<Vector> {
        let mut motions = vec![[0.0; 3]; self.count];
        for (x, unknown) in by_pole.iter().zip(&self.unknowns) {
            if let Some(k) = unknown {
                motions[*k] = *x;
            }
        }
        motions
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

    /// The matrix of energy, distance and the model of the slope over the unknown numbers.
    fn matrix(&self, model: &[Cell]) -> Result<Envelope, Error> {
        let width = self.width();
        let cells = || self.energy.0.iter().chain(&self.distance.0);
        let mut first: Vec<usize> = (0..self.count).collect();
        let mut reach = |poles: &mut dyn Iterator<Item = usize>| {
            let unknowns: Vec<usize> = poles.filter_map(|i| self.unknowns[i]).collect();
            let Some(&least) = unknowns.iter().min() else { return };
            unknowns.iter().for_each(|&k| first[k] = first[k].min(least));
        };
        cells().chain(&self.tubes).for_each(|cell| reach(&mut cell.poles.iter().copied()));
        model.iter().for_each(|cell| reach(&mut cell.poles.iter().map(|i| i / 3)));
        let first = first.iter().flat_map(|k| vec![width * k; width]).collect();
        let mut matrix = Envelope::new(first)?;
        for cell in cells() {
            for axis in 0..width {
                Self::add_squares(cell, &|i| Some(width * self.unknowns[i]? + axis), &mut matrix);
            }
        }
        for cell in model {
            Self::add_squares(cell, &|i| Some(3 * self.unknowns[i / 3]? + i % 3), &mut matrix);
        }
        Ok(matrix)
    }

    /// Adds the squares of the rows of a cell, whose entries have these unknown numbers.
    fn add_squares(cell: &Cell, unknown: &dyn Fn(usize) -> Option<usize>, matrix: &mut Envelope) {
        let n = cell.poles.len();
        let places: Vec<Option<usize>> = cell.poles.iter().map(|&i| unknown(i)).collect();
        for a in 0..n {
            for b in 0..=a {
                let (Some(i), Some(j)) = (places[a], places[b]) else { continue };
                let x: f64 = cell.rows.chunks_exact(n).map(|row| row[a] * row[b]).sum();
                // Two poles with one unknown meet on its diagonal twice.
                matrix.add(i, j, if a != b && i == j { 2.0 * x } else { x });
            }
        }
    }
}
