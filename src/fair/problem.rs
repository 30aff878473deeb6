//! What fairing makes small, and poles on their way to it.

use super::cells::Functional;
use super::length::LengthLimit;
use super::rows::hull_deviation;
use super::slope::Slope;
use crate::bounds::{Vector, sub};
use crate::curve::insertion::{collect, copy_of};
use crate::error::Error;

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
    pub kept: Functional,
    /// One row each: forms of the motion, over the poles, that may be as long as the radius; see [`Self::tube`].
    pub tubes: Functional,
    /// How far a form of the tube may move; of the other methods: a pole.
    pub radius: f64,
    /// What the arc length may be.
    pub length: Option<LengthLimit>,
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
    /// At the beginning.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn new(old: &[Vector], energy: f64) -> Result<Self, Error> {
        Ok(Self { old: copy_of(old)?, poles: copy_of(old)?, energies: copy_of(&[energy])? })
    }

    pub fn last(&self) -> f64 {
        self.energies[self.energies.len() - 1]
    }
}

/// Differences of two lists of points.
///
/// # Errors
/// [`Error::OutOfMemory`].
pub fn differences(a: &[Vector], b: &[Vector]) -> Result<Vec<Vector>, Error> {
    collect(a.len().min(b.len()), a.iter().zip(b).map(|(a, b)| sub(*a, *b)))
}

impl Problem<'_> {
    /// Energy and cost of moving.
    ///
    /// # Errors
    /// [`Error::OutOfMemory`].
    pub fn value(&self, poles: &[Vector], old: &[Vector]) -> Result<f64, Error> {
        let slope = self.slope.as_ref().map_or(0.0, |slope| slope.value(poles));
        let moved = if self.distance.len() > 0 { differences(poles, old)? } else { Vec::new() };
        Ok(self.energy.value(poles) + self.distance.value(&moved) + slope)
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
            let before = (copy_of(&state.poles)?, state.energies.len());
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
}
