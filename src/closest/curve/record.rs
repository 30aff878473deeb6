//! The record at a parameter: point, distance, and the flags of the place; what its proof adds.

use super::LEAST_CREASE;
use crate::bounds::{Vector, cross, dot, norm};
use crate::closest::elementary::raise;
use crate::closest::sought::Sought;
use crate::closest::{
    FootPoint, QueryOptions, certify, distance, flag, grained, rounding_floor, ulp,
};
use crate::index::{CurveIndex, IndexedCurve};

impl IndexedCurve {
    /// Completes the record of a place that was found.
    pub(super) fn record(
        &self,
        index: &CurveIndex,
        query: Vector,
        options: &QueryOptions,
        sought: &Sought<f64>,
        mut foot: FootPoint,
    ) -> FootPoint {
        let (frame, allowed) = (&index.frame, sought.allowed);
        certify(&mut foot, sought.certificate, frame, allowed);
        if foot.flags & flag::NOT_PROVEN != 0 {
            let q = frame.enter(query);
            raise(&mut foot, index.analytic.as_deref(), q, frame.scale, allowed);
        }
        if foot.flags & flag::NOT_PROVEN != 0 {
            self.settle_grain(index, query, self.range(options), &mut foot, sought);
        }
        foot.flags |= sought.flags;
        foot.iterations = sought.evaluations;
        foot
    }

    /// A foot that is not proven because no double is nearer to its parameter: takes the best of the neighbours, and
    /// lets the grain of the parameter count as rounding.
    fn settle_grain(
        &self,
        index: &CurveIndex,
        query: Vector,
        range: [f64; 2],
        foot: &mut FootPoint,
        sought: &Sought<f64>,
    ) {
        let mut jet = [[0.0; 3]; 2];
        self.curve().derivatives(foot.u, 1, &mut jet);
        let (grain, allowed) = (norm(jet[1]) * ulp(foot.u), sought.allowed);
        if grain.is_nan() || grain < 0.01 * allowed {
            return;
        }
        let mut best = *foot;
        for u in [foot.u.next_down(), foot.u.next_up()] {
            let near = self.foot_at(index, query, u.clamp(range[0], range[1]), range);
            if near.distance < best.distance {
                best = near;
            }
        }
        *foot = best;
        let allowed = grained(allowed, grain, &index.frame);
        certify(foot, sought.certificate, &index.frame, allowed);
    }

    /// The record at a parameter, with the flags of the place.
    pub(crate) fn foot_at(
        &self,
        index: &CurveIndex,
        query: Vector,
        u: f64,
        range: [f64; 2],
    ) -> FootPoint {
        self.foot_with(index, query, u, self.curve().evaluate(u), range)
    }

    /// As [`Self::foot_at`], where the point there is known.
    pub(super) fn foot_with(
        &self,
        index: &CurveIndex,
        query: Vector,
        mut u: f64,
        mut point: Vector,
        range: [f64; 2],
    ) -> FootPoint {
        let (first, last) = self.curve().domain();
        let mut flags = 0;
        let closed = index.closed;
        if closed && u == last && range[0] == first {
            // The canonical parameter of a seam is the start, when it is as near.
            let start = self.curve().evaluate(first);
            let floor = rounding_floor(&index.frame, query, 0.0);
            if distance(query, start) <= distance(query, point) + floor {
                (u, point) = (first, start);
            }
        }
        if u == first || u == last {
            flags |= flag::EDGE | if closed { flag::SEAM } else { 0 };
        }
        if self.is_crease(index, u) {
            flags |= flag::CREASE;
        }
        FootPoint {
            u,
            v: 0.0,
            point,
            distance: distance(query, point),
            lower_bound: 0.0,
            flags,
            iterations: 0,
        }
    }

    /// Whether the tangent breaks at `u`: a knot of multiplicity >= degree where the one-sided tangents differ.
    fn is_crease(&self, index: &CurveIndex, u: f64) -> bool {
        let curve = self.curve();
        let (first, last) = curve.domain();
        let at_seam = u == first || u == last;
        if at_seam && !index.closed || !at_seam && !curve.knots().breaks_at(u) {
            return false;
        }
        let after = index.segments.partition_point(|s| s.u.ends[0] < u);
        let begins = index.segments.get(after).is_some_and(|s| s.u.ends[0] == u);
        let (before, after) = match begins.then_some(after) {
            Some(k) if k > 0 => (k - 1, k),
            _ if at_seam => (index.segments.len() - 1, 0),
            _ => return false,
        };
        let (a, b) =
            (index.net(before).jet(1.0, [0.0; 3]).s, index.net(after).jet(0.0, [0.0; 3]).s);
        let size = norm(a) * norm(b);
        size > 0.0 && (norm(cross(a, b)) > LEAST_CREASE * size || dot(a, b) < 0.0)
    }
}
