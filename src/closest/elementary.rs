//! Elementary shapes answered in closed form: what a carrier proves about a query.
//!
//! ```text
//!   distance to the carrier, less deviation and rounding    <=   distance to anything on the shape
//!   carrier's nearest place -> piece, parameters -> a Newton step or two -> a foot that attains it
//! ```
//!
//! A foot that attains the bound is the nearest point, whatever was trimmed away. What else is as near lies around it; or, on
//! an axis and in a centre, the distance is the same along the flat direction: a continuum. Where no foot attains the bound (the
//! carrier's place is trimmed away), or where another could tie (the query is near an axis or a centre, but not on it), the
//! general search answers.

use super::proof::{Proof, Site};
use super::{FootPoint, flag};
use crate::analytic::{Analytic, Place};
use crate::bounds::{Vector, norm};
use crate::jet::Jet1;

/// Queries farther than this are left to the general search: the place has few digits left.
const FAR: f64 = 1e6;
/// Newton steps from the table's parameters; where they have all digits one is enough.
pub const STEPS: usize = 6;
/// A step of the local parameters below this is the last one: the next would be below its square.
pub const LAST_STEP: f64 = 3e-9;
/// How far a step may lead over the line to the next piece and still end on it.
pub const OVER: f64 = 1e-13;
/// Parameters nearer to the side of a piece than this are on it: points are not known better than to a dozen half ulps of
/// the shape, and a foot on a seam or border should say so.
pub const ON_SIDE: f64 = 2e-15;
/// Local parameters nearer to a collapsed edge than this are left to the general search, which treats it as a point: the
/// parameter along it has lost too many digits there.
pub const BESIDE_EDGE: f64 = 1e-6;
/// Nearer than this they are on the edge.
pub const ON_EDGE: f64 = 1e-13;

/// What the carrier says about a query.
pub struct Prospect {
    /// Nothing on the shape is nearer.
    pub lower: f64,
    /// Where a foot should be.
    pub piece: usize,
    /// Its local parameters, nearly.
    pub at: [f64; 2],
    place: Place,
    deviation: f64,
}

impl Prospect {
    /// What the carrier says about a query, in the index's coordinates.
    pub fn new(analytic: &Analytic, query: Vector) -> Option<Self> {
        let size = norm(query);
        if size.is_nan() || size > FAR {
            return None;
        }
        let carrier = &analytic.carrier;
        let place = carrier.nearest(query);
        let lower = place.distance - carrier.deviation - carrier.rounding(size);
        let (piece, at) = analytic.locate(&place);
        let deviation = carrier.deviation;
        lower.is_finite().then_some(Self { lower: lower.max(0.0), piece, at, place, deviation })
    }

    /// Whether a foot at distance `best` is the nearest point, by a proof with this gap.
    pub fn proves(&self, best: f64, gap: f64) -> bool {
        best <= gap || best - gap <= self.lower
    }

    /// Whether no other foot ties with one that [`Self::proves`] holds of: what lies within the window of its distance lies
    /// around it.
    ///
    /// Points of the shape within the reach, and the foot itself, are within the deviation of points of the carrier that
    /// are around its place; a quarter of the window covers how far distances may be off.
    pub fn is_alone(&self, best: f64, gap: f64) -> bool {
        if best <= gap {
            return true;
        }
        let window = 2.0 * gap;
        let reach = best + window;
        let around = |distance: f64| {
            let most = distance + self.deviation + 0.25 * window;
            (self.place.spread * (most - self.lower) * (most + self.lower)).sqrt()
        };
        let apart = around(reach) + around(best) + 2.0 * self.deviation;
        apart < 0.999 * 8.0 * (window * reach).sqrt()
    }

    /// The proof of a foot, `d` from the query, as the search for a continuum asks it.
    pub fn proof(site: Site, d: Vector, gap: f64, flat: Option<[f64; 2]>) -> Proof<'static> {
        let mut proof = Proof::new(gap, 0, None);
        proof.offer(site, d, || flat);
        proof
    }

    /// Puts the bound into a record, when the gap is allowed.
    pub fn certify(&self, foot: &mut FootPoint, scale: f64, allowed: f64) -> bool {
        foot.lower_bound = (self.lower / scale).min(foot.distance);
        foot.distance - foot.lower_bound <= allowed
    }
}

/// Raises the bound of a foot that is not proven to that of the carrier: near a centre the search may end before it.
pub fn raise(
    foot: &mut FootPoint,
    analytic: Option<&Analytic>,
    query: Vector,
    scale: f64,
    allowed: f64,
) {
    let Some(prospect) = analytic.and_then(|analytic| Prospect::new(analytic, query)) else {
        return;
    };
    foot.lower_bound = foot.lower_bound.max((prospect.lower / scale).min(foot.distance));
    if foot.distance - foot.lower_bound <= allowed {
        foot.flags &= !flag::NOT_PROVEN;
    }
}

/// Whether a direction is flat, and the derivative along it nothing but rounding: no step along it leads nearer. `noise`:
/// how far distances may be off.
pub fn is_level(jet: &Jet1, noise: f64) -> bool {
    jet.is_flat() && jet.gradient().abs() <= noise * norm(jet.s)
}

/// A parameter that is within rounding of a side is on it.
pub fn settled(x: f64) -> f64 {
    if x <= ON_SIDE {
        0.0
    } else if x >= 1.0 - ON_SIDE {
        1.0
    } else {
        x
    }
}
