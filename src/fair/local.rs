//! One pole at a time, where it helps most: to where the energy of the shape is least while the others stay.
//!
//! The pole goes on the straight line to that place, not beyond its ball. What each pole would gain is kept in a tree, so that a step costs
//! as much as the poles have that the moved one shares a row with.
//!
//! Reference: Eck, Hadenfeld, *Local energy fairing of B-spline curves*, 1995.

use super::LEAST_GAIN;
use super::cells::Lists;
use super::problem::{Problem, State};
use crate::bounds::{Vector, add, dot, norm, scaled, sub};
use crate::curve::insertion::{append, collect, copy_of, filled};
use crate::error::Error;

/// One step at most for each pole and this many rounds.
pub(super) const ROUNDS: usize = 8;

/// Where the line from `here` towards `goal` leaves the ball about `centre`; `goal` when it does not.
pub(super) fn within(centre: Vector, radius: f64, here: Vector, goal: Vector) -> Vector {
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

/// The greatest of many numbers that change one by one.
struct Tree {
    /// The numbers of the leaves.
    gains: Vec<f64>,
    /// The leaf with the greatest number below each inner node; node 1 is the root, and leaf k is node `leaves + k`.
    best: Vec<usize>,
}

impl Tree {
    /// All numbers are minus infinity.
    fn new(count: usize) -> Result<Self, Error> {
        let gains = filled(count, f64::NEG_INFINITY)?;
        let mut best = filled(count.max(1), 0)?;
        for node in (1..count).rev() {
            best[node] = if 2 * node >= count { 2 * node - count } else { best[2 * node] };
        }
        Ok(Self { gains, best })
    }

    fn set(&mut self, k: usize, gain: f64) {
        let count = self.gains.len();
        self.gains[k] = gain;
        let mut node = (count + k) / 2;
        while node >= 1 {
            let leaf = |node: usize| if node >= count { node - count } else { self.best[node] };
            let (a, b) = (leaf(2 * node), leaf(2 * node + 1));
            // Of equal ones the lower number.
            let is_first = match self.gains[a].total_cmp(&self.gains[b]) {
                std::cmp::Ordering::Equal => a < b,
                order => order.is_gt(),
            };
            self.best[node] = if is_first { a } else { b };
            node /= 2;
        }
    }

    fn greatest(&self) -> usize {
        if self.gains.len() > 1 { self.best[1] } else { 0 }
    }
}

impl Problem<'_> {
    /// The poles of each unknown: two where a closed spline repeats them.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn twins(&self) -> Result<Lists, Error> {
        let unknowns = || self.unknowns.iter().enumerate();
        Lists::new(self.count, || unknowns().filter_map(|(i, k)| k.map(|k| (k, i))))
    }

    /// Moves the pole with the greatest gain, again and again. True when no pole gains any more.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Cancelled`].
    pub fn run_local(&mut self, state: &mut State, steps: usize) -> Result<bool, Error> {
        if self.count == 0 {
            return Ok(true);
        }
        let matrix = self.energy_matrix()?;
        let diagonals = collect(self.count, (0..self.count).map(|k| matrix.diagonal(k)))?;
        let matrix = matrix.whole()?;
        let twins = self.twins()?;
        let mut slopes = self.gather(&self.energy.gradient(&state.poles)?)?;
        // Where an unknown goes, and what that gains.
        let goal = |k: usize, state: &State, slopes: &[Vector]| {
            let (diagonal, pole) = (diagonals[k], twins.of(k)[0]);
            let (here, old) = (state.poles[pole], state.old[pole]);
            let free = sub(here, scaled(slopes[k], 1.0 / diagonal));
            let goal = within(old, self.radius, here, free);
            let way = sub(goal, here);
            let gain = -2.0 * dot(slopes[k], way) - diagonal * dot(way, way);
            // Energies near the least number say nothing.
            let is_number = diagonal > 0.0 && goal.iter().chain(&[gain]).all(|x| x.is_finite());
            (if is_number { gain } else { f64::NEG_INFINITY }, goal)
        };
        let mut tree = Tree::new(self.count)?;
        (0..self.count).for_each(|k| tree.set(k, goal(k, state, &slopes).0));
        for _ in 0..steps.max(ROUNDS * self.count) {
            if (self.poll)() {
                return Err(Error::Cancelled);
            }
            let k = tree.greatest();
            let (gain, place) = goal(k, state, &slopes);
            let (before, here) = (state.last(), state.poles[twins.of(k)[0]]);
            if gain <= LEAST_GAIN * before {
                return Ok(true);
            }
            if !self.move_twins(state, twins.of(k), place, before - gain)? {
                return Ok(true);
            }
            let way = sub(state.poles[twins.of(k)[0]], here);
            for &(j, x) in matrix.row(k) {
                slopes[j] = add(slopes[j], scaled(way, x));
            }
            for &(j, _) in matrix.row(k) {
                tree.set(j, goal(j, state, &slopes).0);
            }
        }
        Ok(false)
    }

    /// Moves the poles of one unknown, whose gain is known.
    fn move_twins(
        &self,
        state: &mut State,
        twins: &[usize],
        goal: Vector,
        energy: f64,
    ) -> Result<bool, Error> {
        let here = state.poles[twins[0]];
        twins.iter().for_each(|&i| state.poles[i] = goal);
        if (self.allowed)(&state.poles) {
            append(&mut state.energies, energy)?;
            return Ok(true);
        }
        let goals = copy_of(&state.poles)?;
        twins.iter().for_each(|&i| state.poles[i] = here);
        Ok(self.advance(state, &goals)? > 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tree_knows_the_greatest_number() {
        for count in 1..20 {
            let mut tree = Tree::new(count).unwrap();
            let mut all = vec![f64::NEG_INFINITY; count];
            for step in 0..200 {
                let (k, x) = (step * 7 % count, ((step * step) as f64).sin());
                all[k] = if step % 11 == 0 { f64::NEG_INFINITY } else { x };
                tree.set(k, all[k]);
                let most = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                assert_eq!(tree.gains[tree.greatest()], most);
            }
        }
    }
}
