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
use super::cells::Cell;
use super::equations::{Equations, across};
use super::problem::{Problem, State, differences};
use crate::bounds::{Vector, add, dot, norm, scaled, sub};
use crate::curve::insertion::{append, collect, copy_of, filled};
use crate::error::Error;

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

impl Problem<'_> {
    /// Solves at most `steps` times; true when the last steps gained nothing.
    ///
    /// # Errors
    /// Memory that could not be had; [`Error::Cancelled`].
    pub fn run(&mut self, state: &mut State, steps: usize) -> Result<bool, Error> {
        if self.count == 0 {
            return Ok(true);
        }
        let tube = self.tube()?;
        let mut held = HELD[1];
        let mut equations = self.equations(&tube, state, held)?;
        let squares: f64 = tube.cells().flat_map(|form| form.rows).map(|x| x * x).sum();
        let mut penalty = 1e-3 * equations.trace() / squares.max(f64::MIN_POSITIVE);
        if !equations.factorise(penalty) {
            return Ok(false);
        }
        let mut length = self.length(state, &mut equations, 0)?;
        let mut motions = self.gather_mean(&differences(&state.poles, &state.old)?)?;
        let forms = tube.cells().map(|form| form.apply(form.rows, &motions));
        let mut inside: Vec<Vector> = collect(tube.len(), forms)?;
        let mut shift = filled(tube.len(), [0.0; 3])?;
        let mut idle = 0;
        for k in 1..=steps {
            if (self.poll)() {
                return Err(Error::Cancelled);
            }
            let targets = inside.iter().zip(&shift).map(|(z, y)| sub(*z, *y));
            equations.solution(&tube, targets, penalty, &mut motions)?;
            if let Some(length) = &length {
                length.hold(&mut motions);
            }
            let (mut primal, mut dual) = ([0.0f64; 2], [0.0f64; 2]);
            let mut reach = 0.0f64;
            for ((form, z), y) in tube.cells().zip(&mut inside).zip(&mut shift) {
                let here = form.apply(form.rows, &motions);
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
                let share = self.go(state, &motions, reach)?;
                let is_idle = before - state.last() <= LEAST_GAIN * before;
                idle = if is_idle { idle + 1 } else { 0 };
                if idle >= PATIENCE {
                    return Ok(true);
                }
                if self.slope.is_some() {
                    let change = if share > 0.5 { 0.2 } else { 4.0 };
                    held = (held * change).clamp(HELD[0], HELD[2]);
                    self.renew(&mut equations, state, held)?;
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
            if (is_new || is_unbalanced) && !equations.factorise(penalty) {
                return Ok(false);
            }
            if k % EVERY == 0 || is_unbalanced {
                length = self.length(state, &mut equations, k / EVERY)?;
            }
        }
        Ok(false)
    }

    /// The arc length about the present poles. It is no linear function: the range is narrower, and less so after each step.
    fn length(
        &self,
        state: &State,
        equations: &mut Equations,
        steps: usize,
    ) -> Result<Option<Length>, Error> {
        let Some(limit) = &self.length else { return Ok(None) };
        let (now, gradient) = limit.with_gradient(&state.poles)?;
        let moved = differences(&state.poles, &state.old)?;
        let at = now - pairs(&gradient, &moved);
        let [low, high] = limit.range;
        let margin = 0.2 * (high - low) * 0.7f64.powi(steps.min(60) as i32);
        let gradient = self.gather(&gradient)?;
        let mut way = copy_of(&gradient)?;
        equations.apply(&mut way)?;
        Ok(Some(Length { gradient, at, range: [low + margin, high - margin], way }))
    }

    /// Goes towards the poles with these motions, shrunk into the tube; gives the share of the way.
    fn go(&self, state: &mut State, motions: &[Vector], reach: f64) -> Result<f64, Error> {
        let share = if reach > 1.0 { (1.0 - 1e-12) / reach } else { 1.0 };
        let goal = |(old, unknown): (&Vector, &Option<usize>)| {
            unknown.map_or(*old, |k| add(*old, scaled(motions[k], share)))
        };
        let goals = state.old.iter().zip(&self.unknowns).map(goal);
        let goals = collect(state.old.len(), goals)?;
        self.advance(state, &goals)
    }

    /// Goes from the present poles towards `goal`, to the least energy on the way; gives the share of it, 0 when the energy would rise.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn advance(&self, state: &mut State, goal: &[Vector]) -> Result<f64, Error> {
        let way = differences(goal, &state.poles)?;
        let mut gradient = self.energy.gradient(&state.poles)?;
        let mut slope = pairs(&gradient, &way);
        let mut bend = self.energy.value(&way) + self.distance.value(&way);
        if self.distance.len() > 0 {
            gradient.fill([0.0; 3]);
            self.distance.add_gradient(&differences(&state.poles, &state.old)?, &mut gradient);
            slope += pairs(&gradient, &way);
        }
        if let Some(energy) = &self.slope {
            gradient.fill([0.0; 3]);
            energy.add_gradient(&state.poles, &mut gradient);
            slope += pairs(&gradient, &way);
            let square = |cell: Cell| -> f64 {
                cell.each().map(|row| across(row, cell, &way)).map(|x| x * x).sum()
            };
            bend += energy.near(&state.poles)?.cells().map(square).sum::<f64>();
        }
        let mut share = if bend > 0.0 { (-slope / bend).clamp(0.0, 1.0) } else { 1.0 };
        let mut poles = copy_of(&state.poles)?;
        for _ in 0..30 {
            if share <= 0.0 || share.is_nan() {
                return Ok(0.0);
            }
            for ((pole, from), d) in poles.iter_mut().zip(&state.poles).zip(&way) {
                *pole = add(*from, scaled(*d, share));
            }
            let value = self.value(&poles, &state.old)?;
            let is_regular = self.slope.as_ref().is_none_or(|slope| slope.is_regular(&poles));
            if value < state.last() && is_regular && (self.allowed)(&poles) {
                state.poles = poles;
                append(&mut state.energies, value)?;
                return Ok(share);
            }
            share *= 0.5;
        }
        Ok(0.0)
    }
}
