//! The nearest point of a shape, if it is nearer than what is known from another one.
//!
//! A search over many shapes has a foot already when it comes to the next of them. That foot's distance closes boxes from
//! the beginning, and so does the plane through it; most shapes are left after a look at the root of their tree.

use super::lockstep::Begin;
use super::proof::Proof;
use super::{FootPoint, QueryOptions, Workspace, flag, rounding_floor};
use crate::bounds::{Vector, dot};
use crate::index::{Frame, IndexedCurve, IndexedSurface};

/// Square of a query's length, in the index's coordinates, beyond which nothing is left out: squares may overflow.
const FARTHEST_SQUARED: f64 = 1e200;

/// A foot on another shape.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Within {
    /// Its distance from the query, in the caller's lengths.
    pub distance: f64,
    /// The unit vector from the query to it.
    pub direction: Vector,
}

/// What a shape gives to a search over many.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    /// The foot, or the record of nothing: NaN with `lower_bound`, nothing on the shape is nearer than that.
    pub foot: FootPoint,
    /// The accuracy, or what rounding leaves of it on this shape.
    pub window: f64,
    /// The gap that counts as proven; parameters with a coarse grain may allow more.
    pub allowed: f64,
}

/// The record of a search that began with another shape's foot and found nothing nearer.
pub(super) fn nothing_within(proof: &Proof, frame: &Frame) -> FootPoint {
    FootPoint {
        lower_bound: proof.proven() / frame.scale,
        flags: if proof.exhausted { flag::BUDGET } else { 0 },
        iterations: proof.evaluations,
        ..FootPoint::unreached()
    }
}

/// The other shape's foot as the search takes it: two windows farther, so that a foot that ties with it is found.
fn widened(within: Option<Within>, window: f64, frame: &Frame, query: Vector) -> Option<Within> {
    let place = frame.enter(query);
    within
        .filter(|_| dot(place, place) <= FARTHEST_SQUARED)
        .map(|within| Within { distance: within.distance + 2.0 * window, ..within })
}

impl IndexedCurve {
    /// The nearest point if it is nearer than `within` and two windows; `options` ask for a global answer and name the
    /// accuracy.
    pub(crate) fn closest_within(
        &self,
        query: Vector,
        hint: Option<f64>,
        within: Option<Within>,
        options: &QueryOptions,
        workspace: &mut Workspace,
    ) -> Found {
        let Ok(index) = self.index(&mut || false) else {
            return Found { foot: FootPoint::unreached(), window: 0.0, allowed: 0.0 };
        };
        let (frame, floor) = (&index.frame, Self::floor(index, query));
        let window = options.accuracy(frame).max(floor);
        let allowed = window.max(floor + rounding_floor(frame, query, 0.0));
        let within = widened(within, window, frame, query);
        let foot = self.global(index, query, Begin::at(hint), within, options, workspace, None);
        Found { foot, window, allowed }
    }
}

impl IndexedSurface {
    /// The nearest point if it is nearer than `within` and two windows; `options` ask for a global answer and name the
    /// accuracy.
    pub(crate) fn closest_within(
        &self,
        query: Vector,
        hint: Option<[f64; 2]>,
        within: Option<Within>,
        options: &QueryOptions,
        workspace: &mut Workspace,
    ) -> Found {
        let Ok(index) = self.index(&mut || false) else {
            return Found { foot: FootPoint::unreached(), window: 0.0, allowed: 0.0 };
        };
        let (frame, floor) = (&index.frame, Self::floor(index, query));
        let window = options.accuracy(frame).max(floor);
        let allowed = window.max(floor + rounding_floor(frame, query, 0.0));
        let within = widened(within, window, frame, query);
        let foot = self.global(index, query, Begin::at(hint), within, options, workspace, None);
        Found { foot, window, allowed }
    }
}
