//! One pole at a time, where it helps most.
//!
//! ```text
//!   energy   the pole goes to where the energy of the shape is least while the others stay
//!   knots    the pole in the middle of a knot's jump goes to where the jump vanishes: removing the knot
//!            and inserting it again does that to the poles
//! ```
//!
//! The pole goes on the straight line to that place, not beyond its ball, and only as far as the energy falls.

use super::LEAST_GAIN;
use super::rows::{Cell, Functional};
use super::solve::{Problem, State};
use crate::bounds::{Vector, add, dot, norm, scaled, sub};
use crate::error::Error;

/// One step at most for each pole and this many rounds.
const ROUNDS: usize = 8;

/// Where the line from `here` towards `goal` leaves the ball about `centre`; `goal` when it does not.
fn within(centre: Vector, radius: f64, here: Vector, goal: Vector) -> Vector {
    let (from, way) = (sub(here, centre), sub(goal, here));
    if norm(add(from, way)) <= radius {
        return goal;
    }
    // |from + t way| = radius.
    let (a, b, c) = (dot(way, way), dot(from, way), dot(from, from) - radius * radius);
    let root = (b * b - a * c).max(0.0).sqrt();
    let t = ((root - b) / a * (1.0 - 1e-12)).clamp(0.0, 1.0);
    add(here, scaled(way, t))
}

impl Problem<'_> {
    /// Moves the pole with the greatest gain, again and again. True when no pole gains any more.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub fn run_local(&mut self, state: &mut State, steps: usize) -> Result<bool, Error> {
        let diagonal = self.diagonal();
        let touching = touching(&self.energy, state.poles.len());
        let twins = self.twins();
        let mut gradient = self.energy.gradient(&state.poles);
        for _ in 0..steps.max(ROUNDS * self.count) {
            if (self.poll)() {
                return Err(Error::Cancelled);
            }
            let slopes = self.gather(&gradient);
            let goal = |k: usize| {
                if diagonal[k] <= 0.0 {
                    return None;
                }
                let (here, old) = (state.poles[twins[k][0]], state.old[twins[k][0]]);
                let goal =
                    within(old, self.radius, here, sub(here, scaled(slopes[k], 1.0 / diagonal[k])));
                let way = sub(goal, here);
                let gain = -2.0 * dot(slopes[k], way) - diagonal[k] * dot(way, way);
                // Energies near the least number say nothing.
                let is_number = goal.iter().chain(&[gain]).all(|x| x.is_finite());
                is_number.then_some((gain, k, goal))
            };
            let best = (0..self.count).filter_map(goal).max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((gain, k, goal)) = best else { return Ok(true) };
            let (before, here) = (state.last(), state.poles[twins[k][0]]);
            if gain <= LEAST_GAIN * before
                || !self.move_twins(state, &twins[k], goal, before - gain)
            {
                return Ok(true);
            }
            let way = sub(state.poles[twins[k][0]], here);
            for &i in &twins[k] {
                for &cell in &touching[i] {
                    push_gradient(&self.energy.0[cell], i, way, &mut gradient);
                }
            }
        }
        Ok(false)
    }

    /// Moves one pole, whose gain is known, or two that are one.
    fn move_twins(&self, state: &mut State, twins: &[usize], goal: Vector, energy: f64) -> bool {
        let mut poles = state.poles.clone();
        twins.iter().for_each(|&i| poles[i] = goal);
        if twins.len() > 1 || !(self.allowed)(&poles) {
            return self.advance(state, &poles) > 0.0;
        }
        state.poles = poles;
        state.energies.push(energy);
        true
    }

    /// The poles of each unknown: two where a closed spline repeats them.
    fn twins(&self) -> Vec<Vec<usize>> {
        let mut twins = vec![Vec::new(); self.count];
        for (i, unknown) in self.unknowns.iter().enumerate() {
            if let Some(k) = unknown {
                twins[*k].push(i);
            }
        }
        twins
    }

    /// Lets jumps vanish, the greatest first. `lines[k]` holds the cells of knot k in the energy, and for each the pole
    /// that closes it.
    ///
    /// # Errors
    /// [`Error::Cancelled`].
    pub fn run_knots(
        &mut self,
        state: &mut State,
        lines: &[Vec<usize>],
        steps: usize,
    ) -> Result<bool, Error> {
        let mut refused = vec![false; lines.len()];
        for _ in 0..steps.max(ROUNDS * lines.len()) {
            if (self.poll)() {
                return Err(Error::Cancelled);
            }
            let size = |k: usize| -> f64 {
                lines[k].iter().map(|&cell| jump(&self.energy.0[cell], &state.poles)).sum()
            };
            let open = (0..lines.len()).filter(|&k| !refused[k]);
            let Some(k) = open.max_by(|&a, &b| size(a).total_cmp(&size(b))) else {
                return Ok(true);
            };
            let before = state.last();
            let mut goal = state.poles.clone();
            for &cell in &lines[k] {
                self.close(&self.energy.0[cell], state, &mut goal);
            }
            self.advance(state, &goal);
            if state.last() < before * (1.0 - LEAST_GAIN) {
                refused.fill(false);
            } else {
                refused[k] = true;
            }
        }
        Ok(false)
    }

    /// Moves the pole with the greatest share in a jump to where the jump vanishes, within its ball.
    fn close(&self, cell: &Cell, state: &State, goal: &mut [Vector]) {
        let free = (0..cell.poles.len()).filter(|&a| self.unknowns[cell.poles[a]].is_some());
        let Some(a) = free.max_by(|&a, &b| cell.rows[a].abs().total_cmp(&cell.rows[b].abs()))
        else {
            return;
        };
        let greatest = cell.rows.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        // A pole far from the middle would have to move very far: the knot is at a kept end.
        if cell.rows[a].abs() < 0.1 * greatest {
            return;
        }
        let (i, jump) = (cell.poles[a], cell.apply(&cell.rows, &state.poles));
        let free = sub(state.poles[i], scaled(jump, 1.0 / cell.rows[a]));
        let place = within(state.old[i], self.radius, state.poles[i], free);
        self.twins_of(i).for_each(|i| goal[i] = place);
    }

    fn twins_of(&self, i: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.unknowns.len()).filter(move |&k| self.unknowns[k] == self.unknowns[i])
    }
}

/// Squared length of a jump.
fn jump(cell: &Cell, poles: &[Vector]) -> f64 {
    let jump = cell.apply(&cell.rows, poles);
    dot(jump, jump)
}

/// Which cells each pole is in.
fn touching(functional: &Functional, count: usize) -> Vec<Vec<usize>> {
    let mut touching = vec![Vec::new(); count];
    for (k, cell) in functional.0.iter().enumerate() {
        for &i in &cell.poles {
            touching[i].push(k);
        }
    }
    touching
}

/// What moving pole `moved` by `way` adds to the gradient of one cell.
fn push_gradient(cell: &Cell, moved: usize, way: Vector, gradient: &mut [Vector]) {
    let Some(a) = cell.poles.iter().position(|&i| i == moved) else { return };
    for row in cell.rows.chunks_exact(cell.poles.len()) {
        for (r, &i) in row.iter().zip(&cell.poles) {
            gradient[i] = add(gradient[i], scaled(way, r * row[a]));
        }
    }
}
