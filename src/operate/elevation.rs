//! Degree elevation: the same spline, written with a higher degree.
//!
//! Every knot is repeated once more a degree, so that the spline stays as smooth as it is and no smoother. Poles of an unclamped
//! vector that act nowhere in the domain are dropped.

use super::map::Map;
use super::{Direction, Surface};
use crate::curve::Curve;
use crate::curve::insertion::spare;
use crate::error::Error;
use crate::knots::{KnotError, MAX_DEGREE};

/// Bytes of a copy for each pole: pole, weight, knots.
const COPY: usize = 64;

impl Curve {
    /// The same curve with a degree higher by `by`. Exact. Cost: O(n p^3) a degree.
    ///
    /// # Errors
    /// A degree beyond [`MAX_DEGREE`]; memory that could not be had.
    pub fn elevate(&self, by: usize) -> Result<Self, Error> {
        check(self.degree(), by, "")?;
        spare(self.poles().len(), COPY)?;
        let mut curve = self.clone();
        for _ in 0..by {
            curve = curve.mapped(&Map::elevation(curve.knots())?)?;
        }
        Ok(curve)
    }
}

impl Surface {
    /// The same surface with a degree higher by `by` in a direction. Exact.
    ///
    /// # Errors
    /// A degree beyond [`MAX_DEGREE`]; memory that could not be had.
    pub fn elevate(&self, direction: Direction, by: usize) -> Result<Self, Error> {
        check(self.knots(direction).degree(), by, direction.suffix())?;
        spare(self.poles().len(), COPY)?;
        let mut surface = self.clone();
        for _ in 0..by {
            surface = surface.mapped(direction, &Map::elevation(surface.knots(direction))?)?;
        }
        Ok(surface)
    }
}

fn check(degree: usize, by: usize, suffix: &str) -> Result<(), Error> {
    match degree.checked_add(by) {
        Some(found) if found <= MAX_DEGREE => Ok(()),
        found => Err(KnotError::Degree { found: found.unwrap_or(usize::MAX) }.named(suffix)),
    }
}
