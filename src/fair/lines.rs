//! One knot (of surfaces: knot line) at a time: the poles in the middle of its jumps go to where these vanish. Removing the knot and inserting
//! it again does that to the poles.
//!
//! The jumps are kept, and those that a step changes are taken anew: a step costs what the poles of a line touch, and one sum over the jumps.
//!
//! Reference: Farin, Sapidis, *Curvature and the fairness of curves and surfaces*, 1989.

use super::LEAST_GAIN;
use super::cells::{Cell, Lists};
use super::local::{ROUNDS, within};
use super::problem::{Problem, State};
use crate::bounds::{Vector, add, dot, scaled, sub};
use crate::curve::insertion::{append, filled};
use crate::error::Error;
use std::ops::Range;

/// A step on its way: lists that are as long as the shape.
struct Step {
    /// The way of each unknown, and the unknowns that have one.
    ways: Vec<Vector>,
    moved: Vec<usize>,
    /// Cells with a pole that moves; which ones are listed; their jumps before.
    cells: Vec<usize>,
    is_listed: Vec<bool>,
    before: Vec<f64>,
}

impl Problem<'_> {
    /// Lets jumps vanish, the greatest first. `lines[k]` holds the cells of knot k in the energy.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`], [`Error::Cancelled`].
    pub fn run_knots(
        &mut self,
        state: &mut State,
        lines: &[Range<usize>],
        steps: usize,
    ) -> Result<bool, Error> {
        let (touching, twins) = (self.energy.touching(state.poles.len())?, self.twins()?);
        let mut jumps = filled(self.energy.len(), 0.0)?;
        jumps
            .iter_mut()
            .zip(self.energy.cells())
            .for_each(|(x, cell)| *x = cell.value(&state.poles));
        let mut step = Step {
            ways: filled(self.count, [0.0; 3])?,
            moved: Vec::new(),
            cells: Vec::new(),
            is_listed: filled(self.energy.len(), false)?,
            before: Vec::new(),
        };
        let mut refused = filled(lines.len(), false)?;
        for _ in 0..steps.max(ROUNDS * lines.len()) {
            if (self.poll)() {
                return Err(Error::Cancelled);
            }
            let size = |k: usize| -> f64 { jumps[lines[k].clone()].iter().sum() };
            let mut best: Option<(f64, usize)> = None;
            for k in (0..lines.len()).filter(|&k| !refused[k]) {
                let size = size(k);
                if best.is_none_or(|best| size.total_cmp(&best.0).is_ge()) {
                    best = Some((size, k));
                }
            }
            let Some((_, k)) = best else { return Ok(true) };
            let before = state.last();
            for n in lines[k].clone() {
                self.close(self.energy.cell(n), state, &twins, &mut step)?;
            }
            self.list(&touching, &twins, &mut step)?;
            self.take(state, &twins, &mut jumps, &mut step)?;
            step.moved.drain(..).for_each(|k| step.ways[k] = [0.0; 3]);
            step.cells.iter().for_each(|&n| step.is_listed[n] = false);
            if state.last() < before * (1.0 - LEAST_GAIN) {
                refused.fill(false);
            } else {
                refused[k] = true;
            }
        }
        Ok(false)
    }

    /// The way of the pole with the greatest share in a jump to where the jump vanishes, within its ball.
    fn close(
        &self,
        cell: Cell,
        state: &State,
        twins: &Lists,
        step: &mut Step,
    ) -> Result<(), Error> {
        let free = (0..cell.poles.len()).filter(|&a| self.unknowns[cell.poles[a]].is_some());
        let Some(a) = free.max_by(|&a, &b| cell.rows[a].abs().total_cmp(&cell.rows[b].abs()))
        else {
            return Ok(());
        };
        let greatest = cell.rows.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        // A pole far from the middle would have to move very far: the knot is at a kept end.
        if cell.rows[a].abs() < 0.1 * greatest {
            return Ok(());
        }
        let Some(k) = self.unknowns[cell.poles[a]] else { return Ok(()) };
        let (i, jump) = (twins.of(k)[0], cell.apply(cell.rows, &state.poles));
        let free = sub(state.poles[i], scaled(jump, 1.0 / cell.rows[a]));
        let place = within(state.old[i], self.radius, state.poles[i], free);
        let way = sub(place, state.poles[i]);
        // Energies near the least number say nothing.
        if way.iter().all(|x| x.is_finite()) {
            step.ways[k] = way;
            append(&mut step.moved, k)?;
        }
        Ok(())
    }

    /// Lists the cells that the step changes.
    fn list(&self, touching: &Lists, twins: &Lists, step: &mut Step) -> Result<(), Error> {
        step.cells.clear();
        for &k in &step.moved {
            for n in twins.of(k).iter().flat_map(|&i| touching.of(i)) {
                if !step.is_listed[*n] {
                    step.is_listed[*n] = true;
                    append(&mut step.cells, *n)?;
                }
            }
        }
        Ok(())
    }

    /// Goes the way of a step to the least energy on it, if that is less than before.
    fn take(
        &self,
        state: &mut State,
        twins: &Lists,
        jumps: &mut [f64],
        step: &mut Step,
    ) -> Result<(), Error> {
        let (mut slope, mut bend) = (0.0, 0.0);
        step.before.clear();
        for &n in &step.cells {
            let cell = self.energy.cell(n);
            let here = cell.apply(cell.rows, &state.poles);
            let way = cell.rows.iter().zip(cell.poles).fold([0.0; 3], |sum, (x, &i)| {
                self.unknowns[i].map_or(sum, |k| add(sum, scaled(step.ways[k], *x)))
            });
            slope += dot(here, way);
            bend += dot(way, way);
            append(&mut step.before, jumps[n])?;
        }
        let mut share = if bend > 0.0 { (-slope / bend).clamp(0.0, 1.0) } else { 1.0 };
        let mut starts = Vec::new();
        for &k in &step.moved {
            append(&mut starts, state.poles[twins.of(k)[0]])?;
        }
        let place = |state: &mut State, share: f64| {
            for (&k, start) in step.moved.iter().zip(&starts) {
                let goal = add(*start, scaled(step.ways[k], share));
                twins.of(k).iter().for_each(|&i| state.poles[i] = goal);
            }
        };
        for _ in 0..30 {
            if share <= 0.0 || share.is_nan() {
                break;
            }
            place(state, share);
            for &n in &step.cells {
                jumps[n] = self.energy.cell(n).value(&state.poles);
            }
            let value: f64 = jumps.iter().sum();
            if value < state.last() && (self.allowed)(&state.poles) {
                return append(&mut state.energies, value);
            }
            share *= 0.5;
        }
        place(state, 0.0);
        step.cells.iter().zip(&step.before).for_each(|(&n, x)| jumps[n] = *x);
        Ok(())
    }
}
