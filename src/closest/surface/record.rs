//! The record at a parameter pair: point, distance, and the flags of the place; what its proof adds.

use crate::bounds::{Vector, cross, dot, norm};
use crate::closest::curve::LEAST_CREASE;
use crate::closest::elementary::raise;
use crate::closest::sought::Sought;
use crate::closest::{
    FootPoint, QueryOptions, certify, distance, flag, grained, rounding_floor, ulp,
};
use crate::index::{IndexedSurface, SurfaceIndex};
use crate::knots::Knots;

impl IndexedSurface {
    /// Completes the record of a place that was found.
    pub(super) fn record(
        &self,
        index: &SurfaceIndex,
        query: Vector,
        options: &QueryOptions,
        sought: &Sought<[f64; 2]>,
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

    /// A foot that is not proven because no doubles are nearer to its parameters: takes the best of the neighbours, and
    /// lets the grain of the parameters count as rounding.
    fn settle_grain(
        &self,
        index: &SurfaceIndex,
        query: Vector,
        r: [f64; 4],
        foot: &mut FootPoint,
        sought: &Sought<[f64; 2]>,
    ) {
        let mut jet = [[0.0; 3]; 3];
        self.surface().partials(foot.u, foot.v, 1, &mut jet);
        let grain = norm(jet[1]) * ulp(foot.u) + norm(jet[2]) * ulp(foot.v);
        let allowed = sought.allowed;
        if grain.is_nan() || grain < 0.01 * allowed {
            return;
        }
        let mut best = *foot;
        for u in [foot.u.next_down(), foot.u, foot.u.next_up()] {
            for v in [foot.v.next_down(), foot.v, foot.v.next_up()] {
                let at = [u.clamp(r[0], r[1]), v.clamp(r[2], r[3])];
                let near = self.foot_at(index, query, at, r);
                if near.distance < best.distance {
                    best = near;
                }
            }
        }
        *foot = best;
        let allowed = grained(allowed, grain, &index.frame);
        certify(foot, sought.certificate, &index.frame, allowed);
    }

    /// The record at a parameter pair, with the flags of the place.
    pub(crate) fn foot_at(
        &self,
        index: &SurfaceIndex,
        query: Vector,
        at: [f64; 2],
        range: [f64; 4],
    ) -> FootPoint {
        let point = self.surface().evaluate(at[0], at[1]);
        self.foot_with(index, query, at, point, range)
    }

    /// As [`Self::foot_at`], where the point there is known.
    pub(super) fn foot_with(
        &self,
        index: &SurfaceIndex,
        query: Vector,
        mut at: [f64; 2],
        mut point: Vector,
        range: [f64; 4],
    ) -> FootPoint {
        let surface = self.surface();
        let [u0, u1, v0, v1] = surface.domain();
        let closed = index.closed;
        let (first, last) = ([u0, v0], [u1, v1]);
        for k in 0..2 {
            if closed[k] && at[k] == last[k] && range[2 * k] == first[k] {
                // The canonical parameter of a seam is the start, when it is as near.
                let mut start = at;
                start[k] = first[k];
                let there = surface.evaluate(start[0], start[1]);
                let floor = rounding_floor(&index.frame, query, 0.0);
                if distance(query, there) <= distance(query, point) + floor {
                    (at, point) = (start, there);
                }
            }
        }
        let on = [at[0] == u0, at[0] == u1, at[1] == v0, at[1] == v1];
        FootPoint {
            u: at[0],
            v: at[1],
            point,
            distance: distance(query, point),
            lower_bound: 0.0,
            flags: place_flags(on, closed, index.collapsed) | self.crease_flag(index, at, closed),
            iterations: 0,
        }
    }

    /// [`flag::CREASE`] where the tangent plane breaks across a knot line of multiplicity >= degree, or across a
    /// seam.
    fn crease_flag(&self, index: &SurfaceIndex, at: [f64; 2], closed: [bool; 2]) -> u32 {
        let surface = self.surface();
        let [u0, u1, v0, v1] = surface.domain();
        let breaks = |knots: &Knots, x: f64, ends: [f64; 2], closed: bool| {
            let at_end = x == ends[0] || x == ends[1];
            if at_end { closed } else { knots.breaks_at(x) }
        };
        let in_u = breaks(surface.knots_u(), at[0], [u0, u1], closed[0]);
        let in_v = breaks(surface.knots_v(), at[1], [v0, v1], closed[1]);
        let bent = (in_u && index.normals_differ(at, 0)) || (in_v && index.normals_differ(at, 1));
        if bent { flag::CREASE } else { 0 }
    }
}

fn place_flags(on: [bool; 4], closed: [bool; 2], collapsed: [bool; 4]) -> u32 {
    let (in_u, in_v) = (on[0] || on[1], on[2] || on[3]);
    let mut flags = 0;
    if in_u || in_v {
        flags |= flag::EDGE;
    }
    if in_u && in_v {
        flags |= flag::CORNER;
    }
    if (in_u && closed[0]) || (in_v && closed[1]) {
        flags |= flag::SEAM;
    }
    if (0..4).any(|k| on[k] && collapsed[k]) {
        flags |= flag::COLLAPSED;
    }
    flags
}

impl SurfaceIndex {
    /// The pieces before and after `x` in direction `k`, of those that hold the other parameter; across the seam
    /// at the ends of the domain.
    fn normals_differ(&self, at: [f64; 2], k: usize) -> bool {
        let span = |piece: usize, k: usize| {
            if k == 0 { self.patches[piece].u } else { self.patches[piece].v }
        };
        let (rows, columns) = (self.patches.len() / self.columns, self.columns);
        let stride = [columns, 1][k];
        let count = [rows, columns][k];
        let base = self.strip(1 - k, at[1 - k]) * [columns, 1][1 - k];
        let after = self.strip(k, at[k]);
        let begins = span(base + after * stride, k).ends[0] == at[k];
        let (before, after) = if begins && after > 0 { (after - 1, after) } else { (count - 1, 0) };
        let normal = |piece: usize, y: f64| {
            let x = span(piece, 1 - k).local(at[1 - k]);
            let (s, t) = if k == 0 { (y, x) } else { (x, y) };
            let jet = self.net(piece).jet(s, t, [0.0; 3]);
            cross(jet.s, jet.t)
        };
        let a = normal(base + before * stride, 1.0);
        let b = normal(base + after * stride, 0.0);
        let size = norm(a) * norm(b);
        size > 0.0 && (norm(cross(a, b)) > LEAST_CREASE * size || dot(a, b) < 0.0)
    }
}
