//! Closed directions unrolled: parameters that go on counting past the seam, and paths of feet.
//!
//! A foot on a closed direction has its canonical parameter in the domain; every whole number of turns (domain lengths)
//! more is the same place. Along a path the turn is chosen that is nearest to the parameter before:
//!
//! ```text
//!   domain   |-----------|                 canonical     0.1  0.5  0.9  0.3  0.7
//!   unrolled |-----------|-----------|     unwrapped     0.1  0.5  0.9  1.3  1.7      (period 1)
//! ```
//!
//! Limits: a step of half a turn or more is not known from a step the other way round; a path must be sampled finer.

mod cells;

mod ground;

mod path;

pub use path::{PathOutput, Poll};

mod trail;

use crate::error::Error;
use crate::index::{IndexedCurve, IndexedSurface};

/// Bits of the changes along a path.
pub mod change {
    /// The foot went to another branch of the shape: it does not follow from the foot before.
    pub const JUMP: u32 = 1;
    /// The number of turns changed in a closed direction.
    pub const SEAM_CROSSED: u32 = 2;
    /// The path touches or passes a collapsed edge here.
    pub const THROUGH_COLLAPSED: u32 = 4;
    /// Another foot is as near; the one that continues the path was taken.
    pub const TIE: u32 = 8;
}

/// Turns beyond which parameters have no digits left.
const MOST_TURNS: f64 = 1e9;

/// Whole turns that bring `u` nearest to `previous`; of two as near, the fewer (in the sense of the sign).
fn turns(previous: f64, u: f64, [low, high]: [f64; 2]) -> f64 {
    ((previous - u) / (high - low) - 0.5).ceil()
}

/// `u` plus whole turns of the domain.
fn turned(u: f64, turns: f64, [low, high]: [f64; 2]) -> f64 {
    if turns == 0.0 { u } else { u + turns * (high - low) }
}

/// One parameter unrolled next to `previous`, with every argument checked.
fn unwrapped(
    [name, previous_name]: [&str; 2],
    previous: f64,
    u: f64,
    ends: [f64; 2],
    closed: bool,
) -> Result<f64, Error> {
    let refuse = |text: String| Err(Error::InvalidArgument(text));
    if !(ends[0]..=ends[1]).contains(&u) {
        return refuse(format!(
            "{name}: {u:?} is outside the domain {:?} to {:?}",
            ends[0], ends[1]
        ));
    }
    if !previous.is_finite() {
        return refuse(format!("{previous_name}: {previous} is not finite"));
    }
    if !closed {
        return Ok(u);
    }
    let turns = turns(previous, u, ends);
    if turns.abs() > MOST_TURNS {
        return refuse(format!("{previous_name}: {previous:?} is more than 1e9 turns away"));
    }
    Ok(turned(u, turns, ends))
}

impl IndexedCurve {
    /// `u` plus the whole number of turns that brings it nearest to `previous`, when the curve is closed; `u` itself
    /// when it is not. Of two that are as near, the lesser.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for `u` outside the domain, `previous` not finite or more than 1e9 turns away;
    /// [`Error::OutOfMemory`] for the index.
    pub fn unwrap(&self, previous: f64, u: f64) -> Result<f64, Error> {
        let closed = self.index(&mut || false)?.closed;
        unwrapped(["u", "previous"], previous, u, self.curve().domain().into(), closed)
    }
}

impl IndexedSurface {
    /// As [`IndexedCurve::unwrap`], each parameter for itself.
    ///
    /// # Errors
    /// As [`IndexedCurve::unwrap`].
    pub fn unwrap(&self, previous: [f64; 2], uv: [f64; 2]) -> Result<[f64; 2], Error> {
        let closed = self.index(&mut || false)?.closed;
        let [u0, u1, v0, v1] = self.surface().domain();
        let names = [["uv: entry 0", "previous: entry 0"], ["uv: entry 1", "previous: entry 1"]];
        let one = |k: usize, ends| unwrapped(names[k], previous[k], uv[k], ends, closed[k]);
        Ok([one(0, [u0, u1])?, one(1, [v0, v1])?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_turn_is_taken_and_of_two_the_lesser() {
        let one = |previous: f64, u: f64| unwrapped(["", ""], previous, u, [2.0, 6.0], true);
        assert_eq!(one(5.75, 2.25), Ok(6.25));
        assert_eq!(one(2.25, 5.75), Ok(1.75));
        assert_eq!(one(102.0, 3.0), Ok(103.0));
        assert_eq!(one(5.0, 3.0), Ok(3.0));
        assert_eq!(one(3.0, 5.0), Ok(1.0));
        assert_eq!(unwrapped(["", ""], 100.0, 3.0, [2.0, 6.0], false), Ok(3.0));
    }

    #[test]
    fn what_is_no_parameter_is_refused_by_name() {
        let text = |previous, u| {
            unwrapped(["u", "previous"], previous, u, [0.0, 1.0], true).unwrap_err().to_string()
        };
        assert_eq!(text(0.0, 1.5), "u: 1.5 is outside the domain 0.0 to 1.0");
        assert_eq!(text(f64::NAN, 0.5), "previous: NaN is not finite");
        assert_eq!(text(-1e10, 0.5), "previous: -10000000000.0 is more than 1e9 turns away");
    }
}
