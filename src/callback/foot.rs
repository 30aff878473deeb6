//! Records: a place on the shape with the flags that belong to it, and the local iteration that leads there.

use super::cell::Probe;
use crate::bounds::{Vector, norm, sub};
use crate::closest::{FootPoint, GREATEST_COORDINATE, Trace, flag};
use crate::refine::{Method, foot_on_curve, foot_on_surface};

/// A place, its point and the distance of the query.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Parameters.
    pub at: [f64; 2],
    /// The shape there.
    pub point: Vector,
    /// |query - point|.
    pub distance: f64,
}

/// Whether a query is one that gets [`FootPoint::bad_query`].
pub fn is_bad(query: Vector) -> bool {
    query.iter().any(|x| !x.is_finite() || x.abs() > GREATEST_COORDINATE)
}

impl Probe<'_> {
    /// The place at a pair of parameters; `None` where the function fails.
    pub fn place(&self, at: [f64; 2]) -> Option<Place> {
        let (point, distance) = self.reach(at)?;
        Some(Place { at, point, distance })
    }

    /// The local iteration from `start` inside `range`; the better of its ends, if there is a finite one.
    pub fn refined(
        &self,
        start: [f64; 2],
        range: [f64; 4],
        method: Method,
        trace: Option<Trace>,
    ) -> Option<Place> {
        let at = if self.shape.source.dims == 1 {
            let (u, _, _) = foot_on_curve(self, start[0], [range[0], range[1]], method, trace);
            [u, 0.0]
        } else {
            foot_on_surface(self, start, range, method, trace).0
        };
        let begin = [0, 1].map(|k| start[k].clamp(range[2 * k], range[2 * k + 1]));
        nearer(self.place(at), if at == begin { None } else { self.place(begin) })
    }

    /// The record of a place, without certificate. `range`: the box of parameters asked about.
    pub fn record(&self, place: Place, range: [f64; 4], canonical: bool) -> FootPoint {
        let (source, survey) = (&self.shape.source, &self.shape.survey);
        let mut place = place;
        for k in 0..source.dims {
            let [first, last] = [source.domain[2 * k], source.domain[2 * k + 1]];
            let seam = survey.closed[k] && place.at[k] == last && range[2 * k] == first;
            if canonical && seam {
                // The canonical parameter of a seam is the start, when it is as near.
                let mut at = place.at;
                at[k] = first;
                let slack = 4.0 * self.shape.rounding(place.point);
                let start = self.place(at).filter(|p| p.distance <= place.distance + slack);
                place = start.unwrap_or(place);
            }
        }
        FootPoint {
            u: place.at[0],
            v: place.at[1],
            point: place.point,
            distance: place.distance,
            lower_bound: 0.0,
            flags: self.place_flags(place.at),
            iterations: self.taken(),
        }
    }

    fn place_flags(&self, at: [f64; 2]) -> u32 {
        let (source, survey) = (&self.shape.source, &self.shape.survey);
        let on = |k: usize| [at[k] == source.domain[2 * k], at[k] == source.domain[2 * k + 1]];
        let (mut flags, mut ends) = (0, 0);
        for k in 0..source.dims {
            let [low, high] = on(k);
            if low || high {
                ends += 1;
                flags |= if survey.closed[k] { flag::SEAM } else { 0 };
            }
            if (low && survey.collapsed[2 * k]) || (high && survey.collapsed[2 * k + 1]) {
                flags |= flag::COLLAPSED;
            }
        }
        flags
            | match ends {
                0 => 0,
                1 => flag::EDGE,
                _ => flag::EDGE | flag::CORNER,
            }
    }

    /// Whether two places are different points.
    pub fn apart(&self, a: Vector, b: Vector) -> bool {
        norm(sub(a, b)) > 1e-6 * self.shape.survey.diagonal + 4.0 * self.shape.rounding(a)
    }
}

/// The nearer of two places; the first when they are equally near.
pub fn nearer(a: Option<Place>, b: Option<Place>) -> Option<Place> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b.distance < a.distance { b } else { a }),
        (a, b) => a.or(b),
    }
}
